# SPDX-License-Identifier: MIT
"""What pip runs: the Python package is that of CMake, for the Python which pip belongs to."""
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

tree = Path(__file__).resolve().parent
version = re.search(r"project\(rovernet VERSION ([\d.]+)", (tree / "CMakeLists.txt").read_text())[1]


class BuildByCMake(build_ext):
    def build_extension(self, extension):
        folder = Path(self.build_temp).resolve()
        subprocess.run(["cmake", "--preset", "release", "-B", folder, f"-DPython_EXECUTABLE={sys.executable}",
                        "-DROVERNET_PYTHON=ON", "-DROVERNET_TESTS=OFF"], cwd=tree, check=True)
        subprocess.run(["cmake", "--build", folder, "--target", "rovernet_python"], check=True)
        built = next((folder / "python/rovernet").glob("_core*"))
        self.copy_file(built, self.get_ext_fullpath(extension.name))


setup(version=version, ext_modules=[Extension("rovernet._core", [])], cmdclass={"build_ext": BuildByCMake})
