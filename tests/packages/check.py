# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""What must be true of the Debian packages in a folder, as far as no root is needed: check.py PACKAGES [--skip-use]

contents      every package has its files where Debian wants them, owned by root, none in two packages, none elsewhere
dependencies  ours on each other at the same version; each shared library that a program needs is of a package it depends on
paths         nothing names the tree or the folder that it was built in
scripts       only the Python package has maintainer scripts
use           unpacked into a folder, the command runs a shipped world, a C++ program is built with find_package, Python imports the module
lintian       nothing to say, where it is installed

Prints what is wrong, a line each; exit code 1 where anything is.
"""
import argparse
import gzip
import hashlib
import os
import pathlib
import re
import shutil
import stat
import subprocess
import sys
import tarfile
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
ALWAYS = ["libvsasim-dev", "vsasim", "vsasim-data", "vsasim-doc", "vsasim-doctor"]
# Files that tell a package's purpose; ARCH is the multiarch folder or nothing.
HAS = {
    "vsasim": ["usr/bin/vsa", "usr/share/man/man1/vsa.1.gz", "usr/share/bash-completion/completions/vsa",
               "usr/lib/vsasim/fmu/libvsa-fmu.so", "usr/lib/vsasim/fmu/libvsa-fmu-world.so"],
    "vsasim-data": ["usr/share/vsa/actuators/qbmove_maker_pro.toml", "usr/share/vsa/models/worlds/snake_rubble.sdf",
                    "usr/share/vsa/data/README.md", "usr/share/vsa/web/replay.html", "usr/share/vsa/LICENSE"],
    "vsasim-doctor": ["usr/bin/vsa-doctor", "usr/share/man/man1/vsa-doctor.1.gz", "usr/share/vsa/setup.sh"],
    "libvsasim-dev": ["usr/include/vsa/engine/world.hpp", "usr/libARCH/libvsa_engine.a", "usr/libARCH/cmake/vsasim/vsasimConfig.cmake",
                      "usr/libARCH/cmake/vsasim/vsasimConfigVersion.cmake", "usr/libARCH/cmake/vsasim/installed_data.cpp"],
    "python3-vsasim": ["usr/lib/python3/dist-packages/vsasim/__init__.py", "usr/lib/python3/dist-packages/vsasim/py.typed"],
    "vsasim-doc": ["usr/share/doc/vsasim-doc/README.md", "usr/share/doc/vsasim-doc/docs/README.md",
                   "usr/share/doc/vsasim-doc/examples/library/CMakeLists.txt"],
    "vsasim-mpi": ["usr/bin/vsa-mpi", "usr/share/man/man1/vsa-mpi.1.gz"],
    "gazebo11-plugin-vsasim": ["usr/libARCH/gazebo-11/plugins/libvsa-robot.so"],
    "gz-sim-plugin-vsasim": ["usr/libARCH/gz-sim/plugins/libvsa-robot.so"],
}
MAY_BE_IN = re.compile(r"^usr/(bin|include/vsa|lib|share/(bash-completion/completions|doc|lintian/overrides|man/man1|vsa))(/|$)")
WITH_SCRIPTS = {"python3-vsasim": {"postinst", "prerm"}}
problems = []


def wrong(what):
    problems.append(what)
    print(what)


def output(*command, **more):
    return subprocess.run(command, check=True, capture_output=True, text=True, **more).stdout


class Package:
    def __init__(self, file, folder):
        self.file = file
        fields = output("dpkg-deb", "-f", file)
        self.fields = dict(re.findall(r"^(\S+): (.*(?:\n .*)*)$", fields, re.M))
        self.name, self.version = self.fields["Package"], self.fields["Version"]
        self.depends = [d.strip() for d in self.fields.get("Depends", "").split(",") if d.strip()]
        self.tree = folder / self.name
        subprocess.run(["dpkg-deb", "-R", file, self.tree], check=True)
        control = self.tree / "DEBIAN"
        self.scripts = {p.name for p in control.iterdir()} - {"control", "md5sums"}
        self.md5sums = dict(reversed(line.split("  ", 1)) for line in (control / "md5sums").read_text(encoding="utf-8").splitlines())
        shutil.rmtree(control)
        data = subprocess.run(["dpkg-deb", "--fsys-tarfile", file], check=True, capture_output=True).stdout
        (self.tree.parent / (self.name + ".tar")).write_bytes(data)
        with tarfile.open(self.tree.parent / (self.name + ".tar")) as tar:
            self.members = tar.getmembers()

    def files(self):
        return [m.name.removeprefix("./") for m in self.members if not m.isdir()]


def check_contents(p):
    for m in p.members:
        name = m.name.removeprefix("./").rstrip("/")
        if name in (".", "", "usr", "usr/share", "usr/include", "usr/share/man", "usr/share/lintian", "usr/share/bash-completion"):
            continue
        if not MAY_BE_IN.match(name):
            wrong(f"{p.name}: {name} is where nothing of ours belongs")
        if (m.uid, m.gid) != (0, 0):
            wrong(f"{p.name}: {name} is of {m.uname}, not of root")
        program = name.startswith("usr/bin/") or m.isdir()
        if not m.issym() and stat.S_IMODE(m.mode) != (0o755 if program else 0o644):
            wrong(f"{p.name}: {name} has mode {stat.S_IMODE(m.mode):o}")
    files = p.files()
    for wanted in HAS.get(p.name, []):
        if not any(re.fullmatch(re.escape(wanted).replace("ARCH", r"(/[a-z0-9_]+-linux-gnu[a-z0-9]*)?"), f) for f in files):
            wrong(f"{p.name}: has no {wanted}")
    for f in files:
        if f.startswith("usr/bin/") and f"usr/share/man/man1/{pathlib.Path(f).name}.1.gz" not in files:
            wrong(f"{p.name}: {f} has no man page")
        digest = hashlib.md5((p.tree / f).read_bytes()).hexdigest() if not (p.tree / f).is_symlink() else None
        if digest and p.md5sums.get(f) != digest:
            wrong(f"{p.name}: md5sums has another sum for {f}")


def check_documents(p, version):
    doc = p.tree / "usr/share/doc" / p.name
    if "License: Apache-2.0" not in (doc / "copyright").read_text(encoding="utf-8"):
        wrong(f"{p.name}: copyright doesn't tell the licence")
    changes = gzip.decompress((doc / "changelog.Debian.gz").read_bytes()).decode()
    if not changes.startswith(f"vsasim ({version}) "):
        wrong(f"{p.name}: changelog.Debian.gz begins with another version")
    if b"## [" + version.rsplit("-", 1)[0].encode() + b"]" not in gzip.decompress((doc / "changelog.gz").read_bytes()):
        wrong(f"{p.name}: changelog.gz doesn't know version {version}")
    for f in p.tree.rglob("*.gz"):
        head = f.read_bytes()[:10]
        if head[3] & 0x08 or head[4:8] != b"\0\0\0\0":
            wrong(f"{p.name}: {f.relative_to(p.tree)} holds a name or a time")


def check_dependencies(p, packages):
    for field in ("Depends", "Recommends", "Pre-Depends"):
        for one in p.fields.get(field, "").split(","):
            name = one.split()[0] if one.split() else ""
            if name in packages and one.strip() != f"{name} (= {packages[name].version})":
                wrong(f"{p.name}: {field} of {one.strip()}, not of the same version")
            if re.match(r"(vsasim|libvsasim|python3-vsasim)", name) and name not in packages:
                wrong(f"{p.name}: depends on {name}, which isn't here")
    known = {alternative.split()[0] for d in p.depends for alternative in d.split("|")}
    for f in p.files():
        path = p.tree / f
        if path.is_symlink() or path.read_bytes()[:4] != b"\x7fELF":
            continue
        if b"RUNPATH" in subprocess.run(["readelf", "-d", path], capture_output=True, check=True).stdout:
            wrong(f"{p.name}: {f} has a path for libraries in it")
        # Asked of the loader and the package manager, not of dpkg-shlibdeps, which wrote the dependencies.
        needed = re.findall(r"\(NEEDED\).*\[(.*)\]", output("readelf", "-d", path))
        places = dict(re.findall(r"^\s*(\S+) => (\S+) ", output("ldd", path), re.M))
        for library in needed:
            if library not in places or library.startswith("ld-linux"):
                continue
            # /lib is a link to /usr/lib where dpkg may know either.
            real = os.path.realpath(places[library])
            names = [real, real.removeprefix("/usr"), places[library], "/usr" + places[library]]
            found = [subprocess.run(["dpkg-query", "-S", n], capture_output=True, text=True).stdout for n in names]
            owners = {line.split(":")[0] for out in found for line in out.splitlines()}
            provides = {w.strip().split()[0] for o in owners
                        for w in output("dpkg-query", "-W", "-f", "${Provides}", o).split(",") if w.strip()}
            if owners and not (owners | provides) & known:
                wrong(f"{p.name}: {f} needs {library} of {', '.join(sorted(owners))}, on which it doesn't depend")


def check_paths(p, secret):
    for f in p.files():
        path = p.tree / f
        if path.is_symlink():
            continue
        data = path.read_bytes()
        for s in secret:
            if s in data:
                wrong(f"{p.name}: {f} names {s.decode()}")


def check_use(packages, folder):
    everything = folder / "system"
    for p in packages.values():
        shutil.copytree(p.tree, everything, dirs_exist_ok=True, symlinks=True)
    env = {k: v for k, v in os.environ.items() if not k.startswith("VSA_")}
    work = folder / "work"
    work.mkdir()

    def run(*command, **more):
        done = subprocess.run([str(c) for c in command], cwd=work, capture_output=True, text=True, env={**env, **more.get("env", {})})
        if done.returncode != 0:
            wrong(f"use: {' '.join(map(str, command))}: exit code {done.returncode}: {(done.stderr or done.stdout).strip()[-400:]}")
        return done.stdout

    (everything / "usr/bin/vsa").chmod(0o755)
    run(everything / "usr/bin/vsa", "run", "snake_rubble", "--gait", "climb", "--duration-s", "2", "--record", "out", "--no-topics")
    if not (work / "out/replay.html").exists():
        wrong("use: the run has no page")
    run(everything / "usr/bin/vsa", "export", "--fmu", "qbmove_maker_pro_6_1", "--out", "unit.fmu")
    if "python3-vsasim" in packages:
        run("/usr/bin/python3", "-c", "import vsasim; w = vsasim.World.load('bench_free'); w.run(0.1)",
            env={"PYTHONPATH": str(everything / "usr/lib/python3/dist-packages"), "PYTHONDONTWRITEBYTECODE": "1"})
    run("cmake", "-S", everything / "usr/share/doc/vsasim-doc/examples/library", "-B", work / "build", "-DCMAKE_BUILD_TYPE=Release",
        f"-DCMAKE_PREFIX_PATH={everything}/usr", "-Wno-dev")
    run("cmake", "--build", work / "build", "--target", "move_a_joint")
    if (work / "build/move_a_joint").exists() and not re.search(r"^shaft (0\.9|1\.0)", run(work / "build/move_a_joint"), re.M):
        wrong("use: a program with find_package(vsasim) doesn't move its joint")
    later = folder / "later"
    later.mkdir()
    (later / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.18)\nproject(later CXX)\nfind_package(vsasim 0.99 REQUIRED)\n")
    done = subprocess.run(["cmake", "-S", later, "-B", later / "build", f"-DCMAKE_PREFIX_PATH={everything}/usr"], capture_output=True, text=True)
    if done.returncode == 0 or "version: " not in done.stderr:
        wrong("use: find_package(vsasim 0.99) takes this version")


def check_lintian(files):
    if not shutil.which("lintian"):
        print("lintian left out: it isn't installed (sh scripts/setup.sh packages)")
        return
    done = subprocess.run(["lintian", *files], capture_output=True, text=True)
    for line in done.stdout.splitlines():
        if line[:2] in ("E:", "W:"):
            wrong("lintian: " + line)
    if done.returncode not in (0, 1, 2):
        wrong(f"lintian ended with {done.returncode}: {done.stderr.strip()}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("packages", type=pathlib.Path)
    parser.add_argument("--skip-use", action="store_true", help="contents only")
    parser.add_argument("--built-in", type=pathlib.Path, action="append", default=[], help="a folder that nothing may name, besides this tree")
    given = parser.parse_args()
    files = sorted(given.packages.glob("*.deb"))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        packages = {p.name: p for p in (Package(f, folder) for f in files)}
        for wanted in ALWAYS:
            if wanted not in packages:
                wrong(f"there is no package {wanted}")
        versions = {p.version for p in packages.values()}
        if len(versions) != 1:
            wrong(f"packages have different versions: {sorted(versions)}")
        owner = {}
        secret = [str(p).encode() for p in [ROOT, *given.built_in]]
        for p in packages.values():
            check_contents(p)
            check_documents(p, p.version)
            check_dependencies(p, packages)
            check_paths(p, secret)
            if p.scripts != WITH_SCRIPTS.get(p.name, set()):
                wrong(f"{p.name}: has maintainer scripts {sorted(p.scripts)}")
            for f in p.files():
                if owner.setdefault(f, p.name) != p.name:
                    wrong(f"{f} is of {owner[f]} and of {p.name}")
        if not given.skip_use and not problems:
            check_use(packages, folder)
        check_lintian(files)
        files_of_all = sum(len(p.files()) for p in packages.values())
    print(f"packages: {len(files)} with {files_of_all} files: {len(problems)} problem{'s' * (len(problems) != 1)}")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
