# SPDX-License-Identifier: MIT
"""Scenarios and files that the tests of the Python package share."""
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

COMMAND = os.environ["ROVERNET_COMMAND"]
TREE = Path(__file__).resolve().parents[2]
RESCUE = TREE / "examples/rescue/rescue.toml"
SEARCH = TREE / "examples/search/search.toml"
STOREYS = TREE / "examples/storeys/storeys.toml"

ROW = {
    "scenario": {"name": "row", "duration": "2 s"},
    "propagation": {"model": "friis"},
    "radio": {"sensitivity": "-70 dBm"},
    "robot": [{"name": name, "at": [150 * i, 0]} for i, name in enumerate("ABC")],
    "traffic": [{"from": "A", "payload": "tick", "start": "0.5 s", "every": "1 s"}],
}
"""Three robots in a row, of which neighbours hear one another; A says something now and then."""


def still(count, duration="100 s"):
    """Robots that stand 10 m apart in an open field, and say nothing."""
    return {"scenario": {"duration": duration}, "robot": [{"name": f"r{i}", "at": [10 * i, 0]} for i in range(count)]}


def command(*arguments, folder=None):
    """What the rovernet command prints, (code, standard output, standard error)."""
    result = subprocess.run([COMMAND, *map(str, arguments)], cwd=folder, text=True, capture_output=True,
                            stdin=subprocess.DEVNULL, timeout=120)
    return result.returncode, result.stdout, result.stderr


class FolderTest(unittest.TestCase):
    """Tests in a folder of their own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name
