"""What the lanes for one processor leave to the linker."""
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.environ["RUBATLAS_SOURCE_DIR"], "tests", "support"))
from symbols import ForOneProcessor  # noqa: E402


class LaneSymbols(ForOneProcessor):
    def test_no_function_for_one_processor_is_linked_in_where_another_source_calls_it(self):
        self.expect_nothing_shared(os.environ["RUBATLAS_LANES"],
                                   {"lanes_avx2.cpp": "attempt_avx2", "lanes_avx512.cpp": "attempt_avx512"},
                                   may_be_shared=["std::experimental"])


if __name__ == "__main__":
    unittest.main()
