"""What the solvers for one processor leave to the linker."""
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.environ["RUBATLAS_SOURCE_DIR"], "tests", "support"))
from symbols import ForOneProcessor  # noqa: E402


class CollocationSymbols(ForOneProcessor):
    def test_no_function_for_one_processor_is_linked_in_where_another_source_calls_it(self):
        self.expect_nothing_shared(os.environ["RUBATLAS_COLLOCATION"],
                                   {"solve_avx2.cpp": "solve_avx2", "solve_avx512.cpp": "solve_avx512"})


if __name__ == "__main__":
    unittest.main()
