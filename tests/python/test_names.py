"""Names that scripts rely on: all are typed, explained and on the page."""

import ast
import inspect
import re
import unittest

import vehd
from helpers import SOURCE
from vehd import _core


def public(names):
    return {name for name in names if not name.startswith("_")}


def stated_names(body):
    """Of classes, functions and attributes of a stub, with what the classes hold."""
    names = {}
    for node in body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            names[node.name] = stated_names(node.body) if isinstance(node, ast.ClassDef) else {}
        elif isinstance(node, ast.AnnAssign):
            names[node.target.id] = {}
        elif isinstance(node, ast.Assign):
            names[node.targets[0].id] = {}
    return names


class Names(unittest.TestCase):
    def test_type_hints_of_the_compiled_part_are_its_names(self):
        stub = stated_names(ast.parse((SOURCE / "bie/python/vehd/_core.pyi").read_text()).body)
        self.assertEqual(public(stub), public(vars(_core)))
        for name, members in stub.items():
            found = getattr(_core, name)
            if inspect.isclass(found) and not issubclass(found, BaseException):
                # Enumerations have a name and a value for each of theirs.
                self.assertEqual(public(members), public(vars(found)) - {"name", "value"}, name)

    def test_every_name_has_its_docstring_and_its_types(self):
        for name in vehd.__all__:
            thing = getattr(vehd, name)
            if inspect.isclass(thing) and issubclass(thing, Exception):
                continue  # the page says when each is raised
            self.assertTrue(inspect.getdoc(thing), name)
            parts = {name: thing}
            if inspect.isclass(thing):
                parts = {f"{name}.{key}": value for key, value in vars(thing).items() if not key.startswith("_")}
            elif inspect.ismodule(thing):
                parts = {f"{name}.{key}": value for key, value in vars(thing).items()
                         if inspect.isfunction(value) and not key.startswith("_")}
            for part, value in parts.items():
                function = getattr(value, "fget", getattr(value, "__func__", value))
                self.assertTrue(inspect.getdoc(function), part)
                if inspect.isfunction(function):
                    self.assertIn("return", function.__annotations__, part)

    def test_every_name_is_on_the_page(self):
        page = (SOURCE / "docs/python.md").read_text()
        for name in vehd.__all__:
            self.assertTrue(re.search(rf"\b{name}\b", page), name)

    def test_every_name_is_on_the_page_of_the_site(self):
        page = (SOURCE / "docs/site/python_api.rst").read_text()
        self.assertEqual(sorted(re.findall(r"^\.\. \S+:: vehd\.(\w+)", page, re.M)), sorted(vehd.__all__))


class OtherLibraries(unittest.TestCase):
    def test_no_name_is_used_that_newer_releases_have_removed(self):
        # Of NumPy 2 and of SciPy 1.14.
        removed = re.compile(r"\bnp\.(trapz|in1d|product|cumproduct|sometrue|alltrue|float_|complex_|unicode_|string_|Inf|"
                             r"Infinity|NaN|NAN|infty|PINF|NINF|row_stack|msort|asfarray|find_common_type|cast|sctypes|"
                             r"round_|issubclass_|set_string_function)\b|\bnumpy\.(trapz|in1d|product)\b|"
                             r"\b(simps|cumtrapz|sph_harm|interp2d)\(|\bgmres\([^)]*\btol=")
        for folder, pattern in (("bie/python", "**/*.py"), ("docs", "**/*.py"), ("docs", "**/*.ipynb"),
                                ("docs", "**/*.md"), ("tests", "**/*.py")):
            for file in (SOURCE / folder).glob(pattern):
                if file.name == "test_names.py":
                    continue
                found = removed.search(file.read_text())
                self.assertIsNone(found, f"{file}: {found and found.group()}")


if __name__ == "__main__":
    unittest.main()
