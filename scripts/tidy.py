#!/usr/bin/env python3
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""tidy.py BUILD: clang-tidy (.clang-tidy) over the C++ sources that BUILD compiles, each by itself (VSA_UNITY=OFF).

Sources of a folder that are compiled alike are looked at together, eight in one translation unit: most of the time goes into
headers. Where they don't go together (two helpers of a name, say), each half is tried by itself. Groups with what was changed last
come first.

Sources that were clean and are what they were, with all of the project that they include, aren't looked at again; BUILD/tidy.json
says which.

TIDY_S: seconds after which no further group is begun (0: all are checked). TIDY_JOBS: groups side by side (all processors).
Ends with 1 if any source isn't clean, with 2 for wrong use.
"""
import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
TOGETHER = 8
SELF = os.path.basename(sys.argv[0])  # or alone.py, which asks the same of its users


def setting(name, default):
    text = os.environ.get(name, "") or str(default)
    if not text.isdigit():
        print(f"{SELF}: {name} = '{text}': a whole number", file=sys.stderr)
        sys.exit(2)
    return int(text)


def git(*arguments):
    return subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=False).stdout.split("\n")


def age():
    """How long ago each file was changed, as a rank: what isn't committed comes first."""
    rank = {}
    for name in git("diff", "--name-only", "HEAD") + git("log", "--name-only", "--format=") + git("ls-files"):
        rank.setdefault(name, len(rank))
    return rank


@functools.lru_cache(maxsize=None)
def digest(file):
    return hashlib.sha256(pathlib.Path(file).read_bytes()).hexdigest()


@functools.lru_cache(maxsize=None)
def included(file, folders):
    """Files of the project that `file` names, where the compiler finds them."""
    names = re.findall(r'^\s*#\s*include\s+["<]([^">]+)[">]', pathlib.Path(file).read_text(encoding="utf-8"), re.MULTILINE)
    found = []
    for name in names:
        places = (os.path.normpath(os.path.join(folder, name)) for folder in (os.path.dirname(file), *folders))
        found += [p for p in places if os.path.isfile(p)][:1]
    return found


def reached(file, folders):
    """`file` and all of the project that it includes, also by way of others, whether or not a condition leaves it out."""
    seen, due = set(), [file]
    while due:
        f = due.pop()
        if f not in seen:
            seen.add(f)
            due += included(f, folders)
    return sorted(seen)


def include_folders(command):
    """Of a command as a shell takes it: -IFOLDER and -I FOLDER, in quotes where a name has blanks."""
    words = shlex.split(command)
    return [word[2:] or after for word, after in zip(words, [*words[1:], ""]) if word.startswith("-I")]


def states(commands, script):
    """Of each source: a sum of all that decides what is said of it by `script`, or by clang-tidy."""
    tool = "" if script != __file__ else subprocess.run(["clang-tidy", "--version"], capture_output=True, text=True, check=False).stdout
    out = {}
    for file, command in commands.items():
        folders = tuple(f for f in include_folders(command["command"]) if pathlib.Path(f).is_relative_to(ROOT))
        parts = [tool, command["command"], digest(script), digest(ROOT / ".clang-tidy"), *(f + digest(f) for f in reached(file, folders))]
        out[file] = hashlib.sha256("\n".join(parts).encode()).hexdigest()
    return out


class Clean:
    """Which sources were clean as they are: kept in a file."""

    def __init__(self, file, now):
        self.file, self.now = file, now
        try:
            then = json.loads(file.read_text(encoding="utf-8"))
        except (OSError, ValueError):  # none yet, or nothing that this wrote: all is looked at
            then = {}
        self.then = then if isinstance(then, dict) else {}

    def has(self, source):
        return source in self.now and self.then.get(source) == self.now[source]

    def add(self, sources):
        self.then.update({s: self.now[s] for s in sources if s in self.now})
        part = self.file.with_suffix(".part")
        part.write_text(json.dumps(self.then), encoding="utf-8")
        part.replace(self.file)


def groups(commands):
    """Lists of files of a folder with one command but for their names."""
    alike = {}
    for file in sorted(commands):
        words = shlex.split(commands[file]["command"])
        command = tuple(word for before, word in zip(["", *words], words) if "-o" not in (before, word) and word != file)
        alike.setdefault((os.path.dirname(file), command), []).append(file)
    return [files[k : k + TOGETHER] for files in alike.values() for k in range(0, len(files), TOGETHER)]


def look(files, commands, folder):
    """What clang-tidy says of these files: (files checked, [(file, text) of those that aren't clean])."""
    place = pathlib.Path(tempfile.mkdtemp(dir=folder))
    source, more = files[0], []
    if len(files) > 1:
        source = str(place / "together.cpp")
        pathlib.Path(source).write_text("".join(f'#include "{file}"\n' for file in files), encoding="utf-8")
        more = ["--checks=-bugprone-suspicious-include", f"--extra-arg=-I{os.path.dirname(files[0])}"]
    first = commands[files[0]]
    entry = {"directory": first["directory"], "command": first["command"].replace(files[0], source), "file": source}
    (place / "compile_commands.json").write_text(json.dumps([entry]), encoding="utf-8")
    # GCC's own options mean nothing to clang, and a mask of several lanes is a truth of one; neither is a fault.
    extra = [f"--extra-arg=-Wno-{w}" for w in ("unknown-warning-option", "ignored-optimization-argument", "bitwise-instead-of-logical")]
    run = subprocess.run(
        ["clang-tidy", "-p", str(place), "--quiet", f"--config-file={ROOT / '.clang-tidy'}", *extra, *more, source],
        capture_output=True, text=True, check=False)
    if run.returncode == 0:
        return len(files), []
    if len(files) > 1:  # which of them, and whether only together
        half = len(files) // 2
        parts = [look(part, commands, folder) for part in (files[:half], files[half:])]
        return sum(n for n, _ in parts), [bad for _, found in parts for bad in found]
    return 1, [(files[0], run.stdout)]


def newest(files, rank):
    return min(rank.get(os.path.relpath(file, ROOT), len(rank)) for file in files)


def listing_of():
    """The list of commands of the one argument; ends the script where that isn't one."""
    if len(sys.argv) != 2:
        print(f"usage: {SELF} BUILD", file=sys.stderr)
        sys.exit(2)
    listing = pathlib.Path(sys.argv[1]) / "compile_commands.json"
    if not listing.exists():
        print(f"{SELF}: {sys.argv[1]}: no compile_commands.json: configure it first", file=sys.stderr)
        sys.exit(2)
    return listing


def sources(listing):
    """The project's own, with their commands."""
    generated = ROOT / "build"
    listed = json.loads(listing.read_text(encoding="utf-8"))
    if any("/Unity/unity_" in c["file"] for c in listed):
        print(f"{SELF}: {listing.parent}: compiles sources together, which hides them: configure it with -DVSA_UNITY=OFF", file=sys.stderr)
        sys.exit(2)
    return {c["file"]: c for c in listed
            if c["file"].endswith(".cpp") and ROOT in pathlib.Path(c["file"]).parents and generated not in pathlib.Path(c["file"]).parents}


def main():
    listing = listing_of()
    seconds, jobs = setting("TIDY_S", 0), setting("TIDY_JOBS", os.cpu_count())
    rank, commands = age(), sources(listing)
    clean = Clean(listing.with_name("tidy.json"), states(commands, __file__))
    known = [file for file in commands if clean.has(file)]
    for file in known:
        del commands[file]
    order = sorted(groups(commands), key=lambda files: newest(files, rank))
    start, checked, unclean = time.monotonic(), 0, []
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(max(1, jobs)) as pool:
        begun = lambda files: look(files, commands, folder) if not seconds or time.monotonic() - start < seconds else (0, [])  # noqa: E731
        for files, (n, found) in zip(order, pool.map(begun, order)):
            checked += n
            unclean += found
            if n == len(files):
                clean.add(set(files) - {file for file, _ in found})
            for _, text in found:
                print(text, end="", flush=True)
    was = f", {len(known)} were clean before" if known else ""
    print(f"clang-tidy: {checked} of {len(commands) + len(known)} sources checked, {len(unclean)} not clean{was}")
    return 1 if unclean else 0


if __name__ == "__main__":
    sys.exit(main())
