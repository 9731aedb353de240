#!/usr/bin/env python3
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Whether the tests notice: makes the one-line changes of scripts/mutants.toml, one at a time, and runs the tests that should fail.

Works in a copy of the tracked files under build/mutants, built there as the preset `release`, each source by itself; the checkout
isn't touched. Each entry of the list is a table [[mutant]] with
    name        what is wrong with the program then
    file        which is changed
    old, new    this text, which must be there exactly once, becomes that one
    tests       targets to build and run, the likeliest first: "test_bus", or "test_chain:SerialChain.*" with a GoogleTest filter;
                the first that fails ends the search
    equivalent  why no test can notice, for a change that makes no difference
Prints one line a mutant as it goes:
    caught      with the test that failed, or how the program ended
    SURVIVED    no test failed and the list doesn't say why
    equivalent  no test failed, as the list says
    WRONG       caught, although the list calls it equivalent
    STALE       the text isn't there exactly once: the list is to be brought up to date
    BROKEN      the changed program doesn't compile
A test that fails without any change is left out, and named.

With the argument `check` it only looks whether the list is up to date, and ends with 1 if not: no copy, no tests.

MUTANTS_FILTER  a regular expression: only mutants whose name or file it matches
MUTANTS_JOBS    processes that build (1)
Ends with 0 if all were caught or equivalent, with 1 if not, with 2 if nothing could be tried, with 77 where Python is too old.
"""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

try:
    import tomllib
except ImportError:
    print("mutants.py: needs Python 3.11 or newer, for tomllib", file=sys.stderr)
    sys.exit(77)  # a test that is left out

ROOT = pathlib.Path(__file__).resolve().parent.parent
TREE = ROOT / "build" / "mutants" / "tree"
BUILD = TREE / "build" / "release"
LEAST_LIMIT_S = 120  # what a test may take at least; else ten times what it takes unchanged
KEYS = {"name", "file", "old", "new", "tests", "equivalent"}


def stop(message):
    print(f"mutants.py: {message}", file=sys.stderr)
    sys.exit(2)


def read_list(path, choose):
    with open(path, "rb") as file:
        mutants = tomllib.load(file).get("mutant", [])
    for m in mutants:
        if not KEYS - {"equivalent"} <= m.keys() <= KEYS or not m["tests"]:
            stop(f"{path.name}: {m.get('name', m)}: needs {', '.join(sorted(KEYS - {'equivalent'}))}; may have equivalent")
    chosen = [m for m in mutants if choose.search(m["name"]) or choose.search(m["file"])]
    if not chosen:
        stop(f"no mutant matches MUTANTS_FILTER = {choose.pattern}")
    return chosen


def copy_tree():
    """Tracked files, and only those that differ: what was built before stays."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True).stdout.decode()
    names = {name for name in listed.split("\0") if name and (ROOT / name).is_file()}
    for name in names:
        source, target = ROOT / name, TREE / name
        if target.is_file() and target.read_bytes() == source.read_bytes():
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, target)
    for folder in (f for f in TREE.iterdir() if f.is_dir() and f.name != "build"):
        for path in folder.rglob("*"):
            if path.is_file() and str(path.relative_to(TREE)) not in names and "node_modules" not in path.parts:
                path.unlink()


def configure():
    run = subprocess.run(["cmake", "--preset", "release", "-DVSA_UNITY=OFF"], cwd=TREE, capture_output=True, text=True)
    if run.returncode != 0:
        stop("cmake --preset release:\n" + run.stderr)


def build(target):
    """None, or what the compiler said."""
    jobs = os.environ.get("MUTANTS_JOBS", "1")
    command = ["cmake", "--build", str(BUILD), "-j", jobs, "--target", target]
    run = subprocess.run(command, cwd=TREE, capture_output=True, text=True)
    if run.returncode == 0:
        return None
    text = run.stdout + run.stderr
    return next((line for line in text.splitlines() if "error:" in line), text[-300:]).strip()


def run_test(test, without, limit_s, more=()):
    """Failed tests by name, or how else it ended; empty if all passed."""
    target, _, wanted = test.partition(":")
    chosen = wanted or "*"
    if without:
        chosen += (":" if "-" in chosen else "-") + ":".join(without)
    with open(TREE.parent / "output.txt", "w+b") as output:
        command = [str(BUILD / "bin" / target), "--gtest_filter=" + chosen, "--gtest_color=no", *more]
        process = subprocess.Popen(command, cwd=TREE, stdout=output, stderr=subprocess.STDOUT, start_new_session=True)
        try:
            code = process.wait(limit_s)
        except subprocess.TimeoutExpired:
            return [f"not done after {limit_s:.0f} s"]
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
        output.seek(0)
        text = output.read().decode(errors="replace")
    if code == 0:
        return [] if re.search(r"^\[  PASSED  \] [1-9]", text, re.M) else ["no test ran"]
    failed = dict.fromkeys(re.findall(r"^\[  FAILED  \] (\w+[.\/][^\s,]+)", text, re.M))
    if failed:
        return list(failed)
    running = re.findall(r"^\[ RUN      \] (\S+)", text, re.M)
    return [f"{running[-1] if running else target} (ended with {code})"]


class Unchanged:
    """The tests as they are: which fail anyway and how long they take; each is tried once, when it is first needed."""

    def __init__(self):
        self.known = {}

    def ask(self, test):
        if test not in self.known:
            error = build(test.partition(":")[0])
            if error:
                stop(f"{test} doesn't build without a change: {error}")
            begin = time.monotonic()
            failing = run_test(test, [], 3600)
            self.known[test] = (failing, max(LEAST_LIMIT_S, 10 * (time.monotonic() - begin)))
            if failing and (" " in failing[0] or run_test(test, failing, 3600)):
                stop(f"{test} fails without a change: {failing[0]}")
            for name in failing:
                print(f"  (left out, it fails without a change: {name})", flush=True)
        return self.known[test]


def stale(mutant, tree):
    """Why it can't be made in this tree, or nothing."""
    path = tree / mutant["file"]
    if not path.is_file():
        return "there is no such file"
    count = path.read_text(encoding="utf-8").count(mutant["old"])
    return f"its text is there {count} times" if count != 1 else "it changes nothing" if mutant["old"] == mutant["new"] else ""


def check(mutants):
    found = [(m, why) for m in mutants if (why := stale(m, ROOT))]
    for mutant, why in found:
        print(f"mutants.toml: {mutant['name']}: {mutant['file']}: {why}", file=sys.stderr)
    return 1 if found else 0


def judge(mutant, unchanged):
    """(verdict, remark)"""
    if why := stale(mutant, TREE):
        return "STALE", why
    path = TREE / mutant["file"]
    text = path.read_text(encoding="utf-8")
    for test in mutant["tests"]:
        unchanged.ask(test)
    path.write_text(text.replace(mutant["old"], mutant["new"]), encoding="utf-8")
    try:
        for test in mutant["tests"]:
            error = build(test.partition(":")[0])
            if error:
                return "BROKEN", error
            without, limit_s = unchanged.ask(test)
            failed = run_test(test, without, limit_s, ["--gtest_fail_fast"])
            if failed:
                return "WRONG" if "equivalent" in mutant else "caught", f"{test.partition(':')[0]}: {failed[0]}"
        return ("equivalent", mutant["equivalent"]) if "equivalent" in mutant else ("SURVIVED", ", ".join(mutant["tests"]))
    finally:
        path.write_text(text, encoding="utf-8")


def main():
    only_check = sys.argv[1:] == ["check"]
    if len(sys.argv) > 1 and not only_check:
        print(__doc__.strip())
        sys.exit(0 if sys.argv[1] in ("-h", "--help") else 2)
    try:
        choose = re.compile(os.environ.get("MUTANTS_FILTER") or ".")
    except re.error as error:
        stop(f"MUTANTS_FILTER: {error}")
    mutants = read_list(ROOT / "scripts" / "mutants.toml", choose)
    if only_check:
        return check(mutants)
    copy_tree()
    configure()
    unchanged, counts = Unchanged(), {}
    widths = [max(len(m[key]) for m in mutants) for key in ("name", "file")]
    for mutant in mutants:
        verdict, remark = judge(mutant, unchanged)
        counts[verdict] = counts.get(verdict, 0) + 1
        print(f"{mutant['name']:{widths[0]}}  {mutant['file']:{widths[1]}}  {verdict:10}  {remark}", flush=True)
    print(f"{len(mutants)} mutants: " + ", ".join(f"{n} {verdict}" for verdict, n in counts.items()))
    return 0 if set(counts) <= {"caught", "equivalent"} else 1


if __name__ == "__main__":
    sys.exit(main())
