# SPDX-License-Identifier: MIT
"""Examples that import rovernet print what the .expected file beside them says."""
import subprocess
import sys
import unittest

from scenes import TREE


class Examples(unittest.TestCase):
    def test_each_example_prints_its_expected_output(self):
        programs = [path for path in TREE.glob("examples/*/*.py") if "import rovernet" in path.read_text()]
        self.assertTrue(programs)
        for program in programs:
            result = subprocess.run([sys.executable, program], text=True, capture_output=True, timeout=300)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(result.stdout, program.with_suffix(".expected").read_text(), program)


if __name__ == "__main__":
    unittest.main()
