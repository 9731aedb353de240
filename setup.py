# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""For pip: CMake builds the module and puts its package together in build/pip, and this takes it from there.

VSA_BUILD_DIR names a build tree that is taken instead, build/release say; it is brought up to date first. CMAKE_ARGS are given to
CMake when it configures, which it doesn't with VSA_BUILD_DIR. The replay page's template needs npm and the network once, so it comes
along only where that tree has it.
"""
import os
import pathlib
import shlex
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


def build_step(*command):
    """What went wrong was told by the command itself; of our own there is a line, no traceback."""
    try:
        subprocess.run(command, check=True)
    except OSError as error:
        raise SystemExit(f"setup.py: {command[0]}: {error.strerror}") from None
    except subprocess.CalledProcessError as error:
        raise SystemExit(f"setup.py: {shlex.join(command)}: exit code {error.returncode}") from None


class CMakeBuild(build_ext):
    def run(self):
        given = os.environ.get("VSA_BUILD_DIR")
        tree = pathlib.Path(given).resolve() if given else ROOT / "build" / "pip"
        arguments = shlex.split(os.environ.get("CMAKE_ARGS", ""))
        if given and arguments:
            raise SystemExit(f"setup.py: CMAKE_ARGS = {shlex.join(arguments)}: VSA_BUILD_DIR = {given} is configured already "
                             "(allowed: one of the two)")
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DVSA_TESTS=OFF", "-DVSA_BENCH=OFF", "-DVSA_PYTHON=ON"]
        options += [f"-DPython3_EXECUTABLE={sys.executable}", *arguments]
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        if not given:
            build_step("cmake", "-S", str(ROOT), "-B", str(tree), *generator, *options)
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
        build_step("cmake", "--build", str(tree), "--parallel", jobs, "--target", "vsasim_python")
        module = pathlib.Path(self.get_ext_fullpath("vsasim._vsasim"))
        package = module.parent
        modules = {file.name for file in (tree / "python" / "vsasim").glob("_vsasim*")}
        if module.name not in modules:
            raise SystemExit(f"setup.py: {tree} has the module of another Python, {', '.join(sorted(modules)) or 'none'}: "
                             f"{sys.executable} loads {module.name}")
        if package.exists():
            shutil.rmtree(package)
        skipped = shutil.ignore_patterns("package.stamp", "__pycache__", *(modules - {module.name}))
        # Links become files; one that leads nowhere (the page's template, not built) is left out.
        shutil.copytree(tree / "python" / "vsasim", package, ignore=skipped, ignore_dangling_symlinks=True)


setup(packages=[], ext_modules=[Extension("vsasim._vsasim", [])], cmdclass={"build_ext": CMakeBuild})
