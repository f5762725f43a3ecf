"""What the solvers for one processor leave to the linker."""
import os
import re
import subprocess
import unittest


class CollocationSymbols(unittest.TestCase):
    def test_no_function_for_one_processor_is_linked_in_where_another_source_calls_it(self):
        listing = subprocess.run(["nm", "--defined-only", "--demangle", os.environ["RUBATLAS_COLLOCATION"]], check=True,
                                 capture_output=True, text=True).stdout
        members = {name: text for name, text in re.findall(r"^(\S+)\.o:\n((?:.+\n)*)", listing, re.MULTILINE)}
        for function in ("solver_avx2", "solver_avx512"):
            with self.subTest(function):
                # Undefined where another source has them; local (t) where nobody else sees them.
                symbols = members[f"{function}.cpp"]
                shared = re.findall(r"^\w+ ([A-Zuvw]) (.+)$", symbols, re.MULTILINE)
                self.assertTrue(any(function in name for _, name in shared))
                self.assertEqual([name for _, name in shared
                                  if function not in name and not name.startswith("DW.ref.")], [])
                # What runs before main runs on every processor.
                self.assertNotIn("_GLOBAL__sub_I", symbols)


if __name__ == "__main__":
    unittest.main()
