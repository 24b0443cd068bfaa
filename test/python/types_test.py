"""Everything in the package has types and a docstring."""

import ast
import inspect
import pathlib
import unittest

import croon

PACKAGE = pathlib.Path(croon.__file__).parent
COMPILED = {node.name: node for node in ast.parse((PACKAGE / "_core.pyi").read_text()).body if isinstance(node, ast.ClassDef)}


def members_in_stubs(cls):
    return {node.target.id if isinstance(node, ast.AnnAssign) else node.name for node in cls.body}


def members_of(cls):
    """The public members that a class of croon has of its own or of a base in croon."""
    names = set(getattr(cls, "__annotations__", {}))
    for base in cls.__mro__:
        if base.__module__.split(".")[0] == "croon":
            names.update(vars(base))
    return {name for name in names if not name.startswith("_") and not hasattr(tuple, name)
            or name == "__len__" and "__len__" in vars(cls)}


def functions():
    """The functions in Python, methods and properties included, by name."""
    for name in croon.__all__:
        thing = getattr(croon, name)
        members = vars(thing).items() if isinstance(thing, type) and name not in COMPILED else [("", thing)]
        for member, function in members:
            function = getattr(function, "fget", None) or getattr(function, "func", None) or function
            is_public = not member.startswith("_") or member == "__init__" and thing is croon.Pipeline
            if is_public and inspect.isfunction(function):
                yield f"{name}.{member}", function


class Types(unittest.TestCase):
    def test_are_those_of_every_name(self):
        self.assertTrue((PACKAGE / "py.typed").exists())
        self.assertEqual(len(set(croon.__all__)), len(croon.__all__))
        self.assertEqual({name for name in vars(croon) if not name.startswith("_")}, set(croon.__all__))

    def test_are_those_of_every_compiled_member(self):
        self.assertEqual(set(COMPILED), {"Cloud", "Estimate", "RigEstimate", "Rng"})
        for name, stub in COMPILED.items():
            self.assertEqual(members_in_stubs(stub), members_of(getattr(croon, name)), name)

    def test_are_those_of_every_parameter_and_result(self):
        self.assertGreater(len(list(functions())), 60)
        for name, function in functions():
            signature = inspect.signature(function)
            self.assertIsNot(signature.return_annotation, inspect.Signature.empty, name)
            for parameter in signature.parameters.values():
                self.assertTrue(parameter.name == "self" or parameter.annotation is not inspect.Parameter.empty, name)


class Docstrings(unittest.TestCase):
    def test_are_everywhere(self):
        for name in croon.__all__:
            thing = getattr(croon, name)
            self.assertTrue(thing.__doc__, name)
            for member in members_of(thing) - {"__len__", "kind"} if isinstance(thing, type) else ():
                if member not in getattr(thing, "__annotations__", {}):
                    self.assertTrue(inspect.getattr_static(thing, member).__doc__, f"{name}.{member}")


if __name__ == "__main__":
    unittest.main()
