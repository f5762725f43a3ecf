"""What the sources of a library that are compiled for one processor leave to the linker."""
import re
import subprocess
import unittest


class ForOneProcessor(unittest.TestCase):
    def expect_nothing_shared(self, library, processors, may_be_shared=()):
        """`library`: the archive; `processors`: for each source of its own, the function that it is for."""
        listing = subprocess.run(["nm", "--defined-only", "--demangle", library], check=True, capture_output=True,
                                 text=True).stdout
        members = {name: text for name, text in re.findall(r"^(\S+)\.o:\n((?:.+\n)*)", listing, re.MULTILINE)}
        for source, function in processors.items():
            with self.subTest(source):
                # Undefined where another source has them; local (t) where nobody else sees them.
                shared = re.findall(r"^\w+ ([A-Zuvw]) (.+)$", members[source], re.MULTILINE)
                self.assertTrue(any(function in name for _, name in shared))
                self.assertEqual([name for _, name in shared
                                  if function not in name and not name.startswith("DW.ref.")
                                  and not any(allowed in name for allowed in may_be_shared)], [])
                # What runs before main runs on every processor.
                self.assertNotIn("_GLOBAL__sub_I", members[source])
