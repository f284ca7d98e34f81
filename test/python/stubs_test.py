# SPDX-License-Identifier: MIT
"""rovernet/_core.pyi says what the module has: the same names, with the same parameters."""
import ast
import re
import unittest
from pathlib import Path

import rovernet
from rovernet import _core


def parameters_in_stub(function):
    every = function.args.posonlyargs + function.args.args + function.args.kwonlyargs
    return [each.arg for each in every]


def parameters_in_module(function):
    """Names in the first line of a docstring, as pybind11 writes it: name(self: T, robot: str) -> None"""
    inside = re.match(r"\w+\((.*)\) -> ", function.__doc__.split("\n")[0])[1]
    return re.findall(r"(?:^|, )(\w+)(?=:)", re.sub(r"\[[^\[\]]*\]", "", re.sub(r"\[[^\[\]]*\]", "", inside)))


class Stubs(unittest.TestCase):
    def setUp(self):
        self.stub = ast.parse((Path(rovernet.__file__).parent / "_core.pyi").read_text())

    def classes(self):
        return {each.name: each for each in self.stub.body if isinstance(each, ast.ClassDef)}

    def test_the_stub_has_the_classes_and_functions_of_the_module(self):
        functions = {each.name for each in self.stub.body if isinstance(each, ast.FunctionDef)}
        public = {name for name in vars(_core) if not name.startswith("_")}
        self.assertEqual(functions | set(self.classes()), public)
        self.assertEqual(public | {"Env", "ParallelEnv", "spaces", "__version__"}, set(rovernet.__all__))

    def test_the_stub_has_the_members_and_parameters_of_each_class(self):
        for name in "Heard", "Run", "Session":
            real, stub = getattr(_core, name), self.classes()[name]
            members = {each.name: each for each in stub.body if isinstance(each, ast.FunctionDef)}
            public = {key for key in vars(real) if not key.startswith("_")}
            self.assertEqual({key for key in members if not key.startswith("_")}, public, name)
            for key in public:
                is_property = bool(members[key].decorator_list)
                self.assertEqual(is_property, isinstance(vars(real)[key], property), key)
                if not is_property:
                    self.assertEqual(parameters_in_stub(members[key]), parameters_in_module(vars(real)[key]), key)

    def test_every_public_member_has_a_docstring(self):
        for name in "Heard", "Run", "Session":
            for key, member in vars(getattr(_core, name)).items():
                if not key.startswith("_"):
                    self.assertGreater(len((member.__doc__ or "").split("\n", 1)[-1]), 5, f"{name}.{key}")

    def test_the_package_contains_py_typed(self):
        self.assertTrue((Path(rovernet.__file__).parent / "py.typed").exists())


if __name__ == "__main__":
    unittest.main()
