#!/usr/bin/env python3
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Whether tests try every public function of vsa::engine and vsa::host with nonsense: python3 doors.py [SOURCES]

Asks Doxygen for the functions and the hostile tests (tests/*/hostile_test.cpp) for their names. Code 1 with a line each that no test
calls; 77 without Doxygen. It sees names, not overloads, and not what a test does with them.
"""
import pathlib
import re
import shutil
import sys
import tempfile
import xml.etree.ElementTree


def functions(tags):
    """(class or namespace, function) of what Doxygen lists, without what a user implements."""
    interfaces = {"vsa::host::Publisher", "vsa::host::TopicTransport", "vsa::host::Simulation"}
    for compound in xml.etree.ElementTree.parse(tags).getroot().iter("compound"):
        name = compound.findtext("name", "")
        if not re.match(r"vsa::(engine|host)(::|$)", name) or compound.get("kind") == "concept" or name in interfaces:
            continue
        for member in compound.iter("member"):
            if member.get("kind") == "function" and member.get("protection", "public") == "public":
                yield name, member.findtext("name", "")


def main(root):
    if shutil.which("doxygen") is None:
        print("left out: Doxygen is not installed")
        return 77
    sys.path.insert(0, str(root / "scripts"))
    import docs  # pylint: disable=import-outside-toplevel

    tests = "".join(path.read_text(encoding="utf-8") for path in sorted((root / "tests").glob("*/hostile_test.cpp")))
    called = set(re.findall(r"[A-Za-z_]\w*", tests))
    with tempfile.TemporaryDirectory() as folder:
        found = sorted(set(functions(docs.Doxygen(pathlib.Path(folder) / "extra/cpp", "doors").tags)))
    skipped = re.compile(r"operator\W|~|fields$|impossible$")  # compared, freed, walked: no argument of theirs can be wrong
    missing = [f"{where}::{name}: no hostile test calls it" for where, name in found if not skipped.match(name) and name not in called]
    for line in missing:
        print(line, file=sys.stderr)
    print(f"{len(found)} public functions of vsa::engine and vsa::host")
    return 1 if missing or len(found) < 100 else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]))
