# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""The package itself: stubs, docstrings, examples, data."""
import ast
import importlib.util
import inspect
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import unittest

import vsasim
from support import SOURCE

PACKAGE = pathlib.Path(vsasim.__file__).parent
MODULES = {"__init__": vsasim, "study": vsasim.study, "identify": vsasim.identify}
TOLD = {"__getitem__", "__setitem__", "__len__", "__enter__", "__exit__"}  # of the special methods, those that stubs tell


def stub_names(body):
    """name → node of what a stub's body declares for its reader."""
    out = {}
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            out[node.name] = node
        elif isinstance(node, ast.AnnAssign):
            out[node.target.id] = node
        elif isinstance(node, ast.ImportFrom):
            out.update({a.asname: node for a in node.names if a.asname})
    return out


def public(thing):
    return {n for n in dir(thing) if not n.startswith("_")}


class Unmade(unittest.TestCase):
    def test_what_was_never_made_raises_whatever_is_asked_of_it(self):
        compiled = vsasim._vsasim
        classes = [c for m in (compiled, compiled.study, compiled.identify) for c in vars(m).values() if isinstance(c, type)]
        self.assertGreater(len(classes), 12)
        for of in classes:
            if issubclass(of, Exception):
                continue
            for name in dir(of):
                if name.startswith("__") and name not in TOLD | {"__repr__"}:
                    continue
                static = inspect.getattr_static(of, name)
                if isinstance(static, staticmethod) or "static" in type(static).__name__:
                    continue
                unmade = of.__new__(of)
                with self.assertRaises((TypeError, RuntimeError), msg=f"{of.__name__}.{name}"):
                    value = getattr(unmade, name)
                    for n in range(5) if callable(value) else ():
                        try:
                            value(*[0] * n)
                        except TypeError as error:
                            if "isn't made" in str(error):
                                raise
                    raise TypeError("no count of arguments fits")
        with self.assertRaisesRegex(TypeError, "isn't made yet"):
            vsasim.World.__new__(vsasim.World).step()

    def test_nor_does_one_whose_init_failed(self):
        unmade = vsasim.Unit.__new__(vsasim.Unit)
        with self.assertRaises(TypeError):
            unmade.__init__("no type")
        with self.assertRaisesRegex(TypeError, "isn't made yet"):
            unmade.readings()


class Errors(unittest.TestCase):
    def test_a_file_name_that_isnt_utf8_is_told_as_python_has_it(self):
        name = os.fsdecode(b"nowhere\xff.sdf")
        with self.assertRaisesRegex(vsasim.InputError, r"nowhere\\xff.sdf.*no such file") as caught:
            vsasim.World.load(pathlib.Path(name))
        self.assertIn(name, [text for p in caught.exception.problems for text in p.values()])


class Stubs(unittest.TestCase):
    def test_they_name_every_public_name_and_no_other(self):
        for name, module in MODULES.items():
            stub = stub_names(ast.parse((PACKAGE / (name + ".pyi")).read_text(encoding="utf-8")).body)
            self.assertEqual({n for n in stub if not n.startswith("_")}, set(module.__all__), name)
            for class_name, node in stub.items():
                if not isinstance(node, ast.ClassDef) or class_name.endswith("Error"):
                    continue
                made = getattr(module, class_name)
                told = set(stub_names(node.body)) - {"__init__"}
                self.assertEqual(told, public(made) | {n for n in vars(made) if n in TOLD}, class_name)

    def test_parameters_have_the_names_of_the_functions_own(self):
        for name, module in MODULES.items():
            stub = stub_names(ast.parse((PACKAGE / (name + ".pyi")).read_text(encoding="utf-8")).body)
            functions = {n: (getattr(module, n), f) for n, f in stub.items() if isinstance(f, ast.FunctionDef)}
            for class_name, node in stub.items():
                if isinstance(node, ast.ClassDef) and not class_name.endswith("Error"):
                    for n, f in stub_names(node.body).items():
                        if isinstance(f, ast.FunctionDef) and not n.startswith("__") and not isinstance(
                            inspect.getattr_static(getattr(module, class_name), n), property
                        ):
                            functions[class_name + "." + n] = (getattr(getattr(module, class_name), n), f)
            for where, (function, node) in functions.items():
                arguments = [a.arg for a in node.args.args + node.args.kwonlyargs if a.arg != "self"]
                signature = function.__doc__.splitlines()[0]
                self.assertEqual([a for a in re.findall(r"[(,] ?(\w+): ", signature) if a != "self"], arguments, where)

    def test_the_package_says_that_it_is_typed(self):
        self.assertTrue((PACKAGE / "py.typed").exists())


class Docstrings(unittest.TestCase):
    def test_everything_public_has_one(self):
        things = [(n, getattr(m, n)) for m in MODULES.values() for n in m.__all__]
        for name, thing in list(things):
            if inspect.isclass(thing) and not issubclass(thing, BaseException):
                things += [(name + "." + n, inspect.getattr_static(thing, n)) for n in public(thing)]
        for name, thing in things:
            thing = getattr(thing, "__func__", thing)
            lines = (thing.__doc__ or "").strip().splitlines()
            if lines and "(" in lines[0] and "->" in lines[0]:
                lines = lines[1:]  # pybind11's signature
            self.assertTrue("".join(lines).strip(), name + " has no docstring")


class Examples(unittest.TestCase):
    def test_each_runs_and_says_something(self):
        examples = sorted((SOURCE / "examples" / "python").glob("*.py"))
        self.assertGreaterEqual(len(examples), 2)
        for example in examples:
            with self.subTest(example.name), tempfile.TemporaryDirectory() as folder:
                done = subprocess.run([sys.executable, str(example)], cwd=folder, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertTrue(done.stdout.strip())


class Data(unittest.TestCase):
    def test_the_package_finds_its_own_data_and_vsa_data_dir_comes_first(self):
        program = "import vsasim; print(vsasim.ActuatorType.load('qbmove_maker_pro').file)"
        without = {k: v for k, v in os.environ.items() if not k.startswith("VSA_")}
        own = subprocess.run([sys.executable, "-c", program], env=without, capture_output=True, text=True, check=True)
        self.assertIn("vsasim", own.stdout)
        other = subprocess.run([sys.executable, "-c", program], env={**without, "VSA_DATA_DIR": "/nowhere"}, capture_output=True, text=True)
        self.assertIn("InputError", other.stderr)

    def test_the_how_tos_blocks_run_as_they_stand(self):
        text = (SOURCE / "docs/howto/python.md").read_text(encoding="utf-8")
        blocks = text.split("```python\n")[1:]
        self.assertGreater(len(blocks), 4)
        program = "\n".join(b.split("```")[0] for b in blocks)
        with tempfile.TemporaryDirectory() as folder:
            ran = subprocess.run([sys.executable, "-c", program], cwd=folder, capture_output=True, text=True)
        self.assertEqual(ran.returncode, 0, ran.stderr)


@unittest.skipIf(importlib.util.find_spec("setuptools") is None, "setuptools isn't installed")
class Setup(unittest.TestCase):
    def built(self, folder, *modules, **environment):
        """setup.py on a tree of these modules, which cmake, one that does nothing, finds up to date."""
        (folder / "bin").mkdir()
        (folder / "bin" / "cmake").write_text("#!/bin/sh\n")
        (folder / "bin" / "cmake").chmod(0o700)
        package = folder / "tree" / "python" / "vsasim"
        package.mkdir(parents=True)
        for module in modules:
            (package / module).touch()
        given = {**os.environ, "PATH": f"{folder}/bin:{os.environ['PATH']}", "VSA_BUILD_DIR": str(folder / "tree"), "CMAKE_ARGS": "", **environment}
        return subprocess.run([sys.executable, SOURCE / "setup.py", "-q", "build_ext", "--build-lib", "lib", "--build-temp", "temp"],
                              cwd=folder, env=given, capture_output=True, text=True)

    def test_the_module_is_this_pythons_and_no_other_comes_along(self):
        own, other = "_vsasim" + sysconfig.get_config_var("EXT_SUFFIX"), "_vsasim.cpython-20-x86_64-linux-gnu.so"
        with tempfile.TemporaryDirectory() as folder:
            done = self.built(pathlib.Path(folder), own, other)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual([file.name for file in (pathlib.Path(folder) / "lib" / "vsasim").iterdir()], [own])
        with tempfile.TemporaryDirectory() as folder:
            done = self.built(pathlib.Path(folder), other)
            self.assertEqual(done.returncode, 1)
            self.assertIn(f"has the module of another Python, {other}: {sys.executable} loads {own}", done.stderr)

    def test_flags_for_a_tree_that_is_configured_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.built(pathlib.Path(folder), CMAKE_ARGS="-DVSA_TOPICS=OFF")
            self.assertEqual(done.returncode, 1)
            self.assertIn("CMAKE_ARGS = -DVSA_TOPICS=OFF: VSA_BUILD_DIR = ", done.stderr)


if __name__ == "__main__":
    unittest.main()
