#!/usr/bin/env python3
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""What of include and src the tests ran: python3 scripts/coverage.py BUILD PERCENT [LABEL]

BUILD is a tree compiled with --coverage whose tests have run; with LABEL only those tests have, and only their rooms count. Prints
lines and part of them by room, and the files that the tests see least of; ends with code 1 where fewer than PERCENT of all lines ran.
Lines are gcov's, by gcovr.
"""
import collections
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
WORST = 10


def lines_by_file(build):
    """FILE: (lines that ran, lines)."""
    out = build / "coverage.json"
    subprocess.run(["gcovr", "--root", ROOT, "--object-directory", build, "--filter", re.escape(f"{ROOT}/src/"), "--filter", re.escape(f"{ROOT}/include/"),
                    "--exclude-directories", ".*CompilerId.*", "--gcov-ignore-parse-errors", "--json", out, build], check=True, stdout=subprocess.DEVNULL)
    found = {}
    for file in json.loads(out.read_text(encoding="utf-8"))["files"]:
        counts = [line["count"] for line in file["lines"] if not line.get("gcovr/noncode")]
        if counts:
            found[file["file"]] = (sum(count > 0 for count in counts), len(counts))
    return found


def room(file):
    parts = pathlib.PurePath(file).parts
    inside = parts[2:] if parts[0] == "include" else parts[1:]
    return inside[0] if len(inside) > 1 else "base"


def rooms_of(build, label):
    """The rooms whose tests have the label."""
    listed = subprocess.run(["ctest", "--test-dir", build, "-L", label, "--show-only=json-v1"], check=True, capture_output=True, text=True)
    return {test["name"] for test in json.loads(listed.stdout)["tests"]}


def main(build, least, label):
    files = lines_by_file(build)
    if not files:
        print(f"coverage.py: {build}: no test has counted lines there: the preset coverage's tree has them once its tests ran", file=sys.stderr)
        return 2
    if label:
        counting = rooms_of(build, label)
        files = {file: lines for file, lines in files.items() if room(file) in counting}
        if not files:
            print(f"coverage.py: label '{label}': no room has tests with it in {build}", file=sys.stderr)
            return 2
    rooms = collections.defaultdict(lambda: [0, 0])
    for file, (ran, of) in files.items():
        rooms[room(file)][0] += ran
        rooms[room(file)][1] += of
    print(f"{'room':16}{'lines':>8}{'ran':>9}")
    for name, (ran, of) in sorted(rooms.items(), key=lambda item: item[1][0] / item[1][1]):
        print(f"{name:16}{of:8}{100 * ran / of:8.1f} %")
    ran, of = (sum(counts[i] for counts in files.values()) for i in (0, 1))
    part = 100 * ran / of if of else 0.0
    print(f"{'all':16}{of:8}{part:8.1f} %\n\nleast of:")
    for file, (ran, of) in sorted(files.items(), key=lambda item: item[1][0] - item[1][1])[:WORST]:
        print(f"  {file}: {of - ran} of {of} lines didn't run")
    if part < least:
        print(f"coverage.py: {part:.1f} % of the lines ran, at least {least:g} % are asked for", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    try:
        tree, percent = pathlib.Path(sys.argv[1]).resolve(strict=True), float(sys.argv[2])
        wanted = sys.argv[3] if len(sys.argv) > 3 else ""
        if not 0 <= percent <= 100:  # not of NaN either, which no part of the lines is below
            raise ValueError(f"PERCENT = {percent:g} (allowed: 0 to 100)")
    except (IndexError, ValueError, OSError) as error:
        print(f"coverage.py: {error}; usage: coverage.py BUILD PERCENT [LABEL]", file=sys.stderr)
        sys.exit(2)
    sys.exit(main(tree, percent, wanted))
