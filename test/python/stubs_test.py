"""The stubs have all that the package has, and everything has a docstring."""

import ast
import inspect
import pathlib
import unittest

import croon

STUBS = ast.parse(pathlib.Path(croon.__file__).with_suffix(".pyi").read_text())


def is_public(name):
    return not name.startswith("_") or name in ("__init__", "__len__")


def members_in_stubs(body):
    """Functions, classes and annotated names by name."""
    found = {}
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found[node.name] = node
        elif isinstance(node, ast.AnnAssign):
            found[node.target.id] = node
    return {name: node for name, node in found.items() if is_public(name)}


def members_of(cls):
    """The public members that a class of croon has of its own or of a base in croon."""
    names = set(getattr(cls, "__annotations__", {}))
    for base in cls.__mro__:
        if base.__module__.split(".")[0] == "croon":
            names.update(name for name, member in vars(base).items() if name not in ("__init__",))
    return {name for name in names if is_public(name) and not hasattr(tuple, name) or name == "__len__" and "__len__" in vars(cls)}


class Stubs(unittest.TestCase):
    def test_have_every_name(self):
        self.assertEqual(set(members_in_stubs(STUBS.body)), set(croon.__all__))
        self.assertEqual(sorted(croon.__all__), [name for name in croon.__all__])
        self.assertTrue(pathlib.Path(croon.__file__).with_name("py.typed").exists())

    def test_have_every_member(self):
        for name, node in members_in_stubs(STUBS.body).items():
            cls = getattr(croon, name)
            if not isinstance(node, ast.ClassDef):
                continue
            stubs = set(members_in_stubs(node.body)) - {"__init__"}
            instance = {"faults", "folder", "complaints"}
            with self.subTest(cls=name):
                self.assertEqual(stubs - instance, members_of(cls) - instance)

    def test_have_the_parameters(self):
        def parameters(function):
            return [(p.name, p.default is not inspect.Parameter.empty, p.kind.name)
                    for p in inspect.signature(function).parameters.values()]

        for name, node in members_in_stubs(STUBS.body).items():
            functions = [(name, getattr(croon, name), node)] if isinstance(node, ast.FunctionDef) else [
                (f"{name}.{member}", getattr(getattr(croon, name), member), of_member)
                for member, of_member in members_in_stubs(getattr(node, "body", [])).items()
                if inspect.isfunction(getattr(getattr(croon, name), member, None))]
            for where, function, stub in functions:
                scope = {"numpy": __import__("numpy")}
                head = ast.Module([ast.FunctionDef("f", _without_annotations(stub.args), [ast.Pass()], [])], [])
                exec(compile(ast.fix_missing_locations(head), "stub", "exec"), scope)
                with self.subTest(function=where):
                    self.assertEqual(parameters(scope["f"]), parameters(function))

    def test_are_not_all_there_is_to_read(self):
        for name in croon.__all__:
            thing = getattr(croon, name)
            self.assertTrue(thing.__doc__, name)
            if not isinstance(thing, type) or not members_of(thing):
                continue
            for member in members_of(thing) - {"__len__", "kind"} - set(getattr(thing, "__annotations__", {})):
                self.assertTrue(inspect.getattr_static(thing, member).__doc__, f"{name}.{member}")


def _without_annotations(arguments):
    for argument in [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs, arguments.kwarg]:
        if argument is not None:
            argument.annotation = None
    return arguments


if __name__ == "__main__":
    unittest.main()
