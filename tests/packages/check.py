# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""What must be true of the Debian packages in a folder, as far as no root is needed: check.py PACKAGES [--skip-use]

contents      every package has its files where Debian wants them, owned by root, none in two packages, none elsewhere
dependencies  ours on each other at the same version; each shared library that a program needs is of a package it depends on
links         of the manual lead to what a package has
paths         nothing names the tree or the folder that it was built in
scripts       only the Python package has maintainer scripts
use           unpacked into a folder, the command runs a shipped world, a C++ program is built with find_package, Python imports the module
sbom          the SPDX document is of these packages, and tells what their programs show of other projects' code
lintian       nothing to say, where it is installed

Prints what is wrong, a line each; exit code 1 where anything is.
"""
import argparse
import functools
import gzip
import hashlib
import json
import os
import pathlib
import re
import shutil
import stat
import subprocess
import sys
import tarfile
import tempfile

sys.dont_write_bytecode = True
import links  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
ABI = ".".join(re.search(r"^project\(vsasim VERSION (\d+)\.(\d+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.M).groups())
ALWAYS = ["libvsasim-dev", "libvsasim" + ABI, "vsasim", "vsasim-data", "vsasim-doc", "vsasim-doctor"]
# Files that tell a package's purpose; ARCH is the multiarch folder or nothing.
HAS = {
    "vsasim": ["usr/bin/vsa", "usr/share/man/man1/vsa.1.gz", "usr/share/bash-completion/completions/vsa",
               "usr/lib/vsasim/fmu/libvsa-fmu.so", "usr/lib/vsasim/fmu/libvsa-fmu-world.so"],
    "vsasim-data": ["usr/share/vsa/actuators/qbmove_maker_pro.toml", "usr/share/vsa/models/worlds/snake_rubble.sdf",
                    "usr/share/vsa/data/README.md", "usr/share/vsa/web/replay.html", "usr/share/vsa/LICENSE"],
    "vsasim-doctor": ["usr/bin/vsa-doctor", "usr/share/man/man1/vsa-doctor.1.gz", "usr/share/vsa/setup.sh"],
    "libvsasim-dev": ["usr/include/vsa/engine/world.hpp", "usr/libARCH/libvsa_engine.a", "usr/libARCH/cmake/vsasim/vsasimConfig.cmake",
                      "usr/libARCH/libvsasim.so", "usr/libARCH/cmake/vsasim/vsasimConfigVersion.cmake", "usr/libARCH/cmake/vsasim/installed_data.cpp"],
    "libvsasim" + ABI: [f"usr/libARCH/libvsasim.so.{ABI}"],
    "python3-vsasim": ["usr/lib/python3/dist-packages/vsasim/__init__.py", "usr/lib/python3/dist-packages/vsasim/py.typed"],
    "vsasim-doc": ["usr/share/doc/vsasim-doc/README.md", "usr/share/doc/vsasim-doc/docs/README.md",
                   "usr/share/doc/vsasim-doc/examples/library/CMakeLists.txt"],
    "vsasim-mpi": ["usr/bin/vsa-mpi", "usr/share/man/man1/vsa-mpi.1.gz"],
    "gazebo11-plugin-vsasim": ["usr/libARCH/gazebo-11/plugins/libvsa-robot.so"],
    "gz-sim-plugin-vsasim": ["usr/libARCH/gz-sim/plugins/libvsa-robot.so"],
}
MAY_BE_IN = re.compile(r"^usr/(bin|include/vsa|lib|share/(bash-completion/completions|doc|lintian/overrides|man/man1|vsa))(/|$)")
WITH_SCRIPTS = {"python3-vsasim": {"postinst", "prerm"}, "libvsasim" + ABI: {"postinst", "postrm", "shlibs", "triggers"}}
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


def check_links(p, packages):
    """Of the manual, to what any of the packages has."""
    count, dead = links.dead_links(p.tree / links.PAGES, lambda path: any((q.tree / path).exists() for q in packages.values()))
    for line in dead:
        wrong(f"{p.name}: {line}")
    if count < 300:
        wrong(f"{p.name}: the manual has {count} links, which is too few to be all")


@functools.lru_cache(maxsize=None)
def owners_of(library):
    """The packages that this library is of, and what these provide."""
    # /lib is a link to /usr/lib, and dpkg may know either.
    real = os.path.realpath(library)
    found = subprocess.run(["dpkg-query", "-S", real, real.removeprefix("/usr"), library, "/usr" + library], capture_output=True, text=True)
    owners = {line.split(":")[0] for line in found.stdout.splitlines()}
    if not owners:
        return owners
    provided = output("dpkg-query", "-W", "-f", "${Provides},", *owners).split(",")
    return owners | {w.split()[0] for w in provided if w.strip()}


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
            owners = owners_of(places[library])
            if owners and not owners & known:
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


# What a library leaves in a program even when it is stripped: names of its types, of its functions or texts of its own.
MARKS = {
    "libeigen3-dev": rb"N5Eigen\d", "libceres-dev": rb"N5ceres\d", "nlohmann-json3-dev": rb"N8nlohmann", "libcli11-dev": rb"N3CLI\d",
    "libfmt-dev": rb"N3fmt2v\d|invalid format string", "libtomlplusplus-dev": rb"N4toml2v\d", "pybind11-dev": rb"pybind11_",
    r"libboost[0-9.]*-dev": rb"N5boost\d", "libpagmo-dev": rb"N5pagmo\d",
}


def check_sbom(packages, folder, files):
    """The SPDX document against the packages themselves: sums, files, what programs show of other projects' code, libraries they load."""
    found = sorted(folder.glob("*.spdx.json"))
    if len(found) != 1:
        wrong(f"sbom: {len(found)} SPDX documents")
        return
    d = json.loads(found[0].read_text(encoding="utf-8"))
    for key, value in (("spdxVersion", "SPDX-2.3"), ("dataLicense", "CC0-1.0"), ("SPDXID", "SPDXRef-DOCUMENT")):
        if d.get(key) != value:
            wrong(f"sbom: {key} is {d.get(key)}")
    if not re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", d["creationInfo"]["created"]) or not re.match(r"\w+:", d["documentNamespace"]):
        wrong("sbom: no time or namespace as SPDX wants them")
    ids = [e["SPDXID"] for e in d["packages"] + d["files"]]
    if len(ids) != len(set(ids)) or not all(re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", i) for i in ids):
        wrong("sbom: identifiers come twice or aren't SPDX's")
    known = {*ids, "SPDXRef-DOCUMENT"}
    related = {}
    for r in d["relationships"]:
        if r["spdxElementId"] not in known or r["relatedSpdxElement"] not in known:
            wrong(f"sbom: a relationship of what isn't there: {r}")
        related.setdefault((r["spdxElementId"], r["relationshipType"]), []).append(r["relatedSpdxElement"])
    by_id = {e["SPDXID"]: e for e in d["packages"] + d["files"]}
    described = {by_id[i]["name"]: by_id[i] for i in related.get(("SPDXRef-DOCUMENT", "DESCRIBES"), [])}
    if set(described) != set(packages):
        wrong(f"sbom: describes {sorted(described)}, here are {sorted(packages)}")
        return
    for p in packages.values():
        e = described[p.name]
        sums = {c["algorithm"]: c["checksumValue"] for c in e["checksums"]}
        if e["versionInfo"] != p.version or sums.get("SHA256") != hashlib.sha256(p.file.read_bytes()).hexdigest():
            wrong(f"sbom: {p.name} is of another version or sum")
        of_file = {by_id[i]["fileName"]: by_id[i] for i in related.get((e["SPDXID"], "CONTAINS"), []) if "fileName" in by_id[i]}
        real = {"./" + f for f in p.files() if not (p.tree / f).is_symlink()}
        for f in sorted(real ^ set(of_file)):
            wrong(f"sbom: {p.name}: {f} is {'missing' if f in real else 'not in the package'}")
        sha1 = []
        for f in sorted(real & set(of_file)):
            data = (p.tree / f).read_bytes()
            sha1.append(hashlib.sha1(data).hexdigest())
            if {c["algorithm"]: c["checksumValue"] for c in of_file[f]["checksums"]} != {
                    "SHA1": sha1[-1], "SHA256": hashlib.sha256(data).hexdigest()}:
                wrong(f"sbom: {p.name}: another sum of {f}")
        if e["packageVerificationCode"]["packageVerificationCodeValue"] != hashlib.sha1("".join(sorted(sha1)).encode()).hexdigest():
            wrong(f"sbom: {p.name}: its verification code isn't that of its files")
        inside = {by_id[i]["name"] for i in related.get((e["SPDXID"], "STATIC_LINK"), [])}
        contents = ((p.tree / f).read_bytes() for f in p.files() if not (p.tree / f).is_symlink())
        programs = b"".join(c for c in contents if c[:4] == b"\x7fELF")
        for name, mark in MARKS.items():
            if re.search(mark, programs) and not any(re.fullmatch(name, i) for i in inside):
                wrong(f"sbom: {p.name} holds code of {name}, which isn't told")
        needed = {by_id[i]["name"] for i in related.get((e["SPDXID"], "DEPENDS_ON"), [])}
        if needed != {dependency.split()[0] for dependency in p.depends}:
            wrong(f"sbom: {p.name} depends on others than its control file says: {sorted(needed)}")
    pages = packages["vsasim-data"].tree / "usr/share/vsa/web"
    bundled = {(x["name"], x["versionInfo"]) for i in related.get((described["vsasim-data"]["SPDXID"], "CONTAINS"), [])
               for x in [by_id[i]] if "versionInfo" in x}
    lock = json.loads((ROOT / "web/package-lock.json").read_text(encoding="utf-8"))["packages"]
    shipped = {(n, lock["node_modules/" + n]["version"]) for n in lock[""]["dependencies"]}
    if bundled != shipped:
        wrong(f"sbom: pages hold {sorted(shipped)} by the lock file, the document says {sorted(bundled)}")
    for p in d["packages"]:
        if p["SPDXID"].startswith(("SPDXRef-Debian-", "SPDXRef-npm-")) and p["licenseDeclared"] in ("", "NOASSERTION"):
            wrong(f"sbom: no licence of {p['name']}")
    if "Permission is hereby granted" not in (pages / "replay.html").read_text(encoding="utf-8"):
        wrong("sbom: the replay page has no licence text")
    sums = dict(reversed(line.split("  ", 1)) for line in (folder / "SHA256SUMS").read_text(encoding="utf-8").splitlines())
    for f in [*files, found[0]]:
        if sums.get(f.name) != hashlib.sha256(f.read_bytes()).hexdigest():
            wrong(f"SHA256SUMS: nothing or another sum of {f.name}")


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
    run("cmake", "-S", ROOT / "tests/packages/shared", "-B", work / "shared", "-DCMAKE_BUILD_TYPE=Release",
        f"-DCMAKE_PREFIX_PATH={everything}/usr", "-Wno-dev")
    run("cmake", "--build", work / "shared")
    if (work / "shared/move_a_joint").exists():
        if not re.search(r"^shaft (0\.9|1\.0)", run(work / "shared/move_a_joint"), re.M):
            wrong("use: a program with the shared library doesn't move its joint")
        if f"libvsasim.so.{ABI}]" not in output("readelf", "-d", work / "shared/move_a_joint"):
            wrong("use: a program that links vsa::shared doesn't load it")
    library = next(everything.glob(f"usr/lib/**/libvsasim.so.{ABI}"))
    shown = output("nm", "-D", "--defined-only", "--format=posix", library).split("\n")
    strange = [s for s in shown if s and not re.match(r"_Z(T[ISVT]|GV|Thn\d+_)?N[KRO]*3vsa|VSASIM_", s)]
    if strange or len(shown) < 1000:
        wrong(f"use: of {len(shown)} symbols that the shared library shows {len(strange)} aren't of namespace vsa: {strange[:3]}")
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
        if "vsasim-doc" in packages:
            check_links(packages["vsasim-doc"], packages)
        owner = {}
        secret = [str(p.resolve()).encode() for p in [ROOT, *given.built_in]]
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
        check_sbom(packages, given.packages, files)
        check_lintian(files)
        files_of_all = sum(len(p.files()) for p in packages.values())
    print(f"packages: {len(files)} with {files_of_all} files: {len(problems)} problem{'s' * (len(problems) != 1)}")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
