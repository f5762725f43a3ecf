"""What the compiler makes of the solvers for one processor."""
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

    @unittest.skipUnless(os.uname().machine == "x86_64", "instructions by their names there")
    def test_no_multiplication_is_fused_with_an_addition(self):
        listing = subprocess.run(["objdump", "--disassemble", "--no-show-raw-insn", os.environ["RUBATLAS_COLLOCATION"]],
                                 check=True, capture_output=True, text=True).stdout
        instructions = set(re.findall(r"^ +[0-9a-f]+:\t(\w+)", listing, re.MULTILINE))
        self.assertIn("vmulpd", instructions)
        self.assertEqual([name for name in instructions if re.match("vfn?m(add|sub)", name)], [])


if __name__ == "__main__":
    unittest.main()
