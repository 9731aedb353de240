# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""version.py ROOT VSA: CMakeLists.txt's version is that of the program and of the files that can't take it from there."""
import pathlib
import re
import subprocess
import sys

root, vsa = pathlib.Path(sys.argv[1]), sys.argv[2]
PLACES = {
    "CMakeLists.txt": r"^project\(vsasim VERSION ([\d.]+)",
    "CHANGELOG.md": r"^## \[([\d.]+)\] - \d{4}-\d\d-\d\d$",  # the topmost
    "CITATION.cff": r"^version: ([\d.]+)$",
    "include/vsa/elastic/law_module.hpp": r'^#define VSA_LAW_VERSION "([\d.]+)"$',
    "pyproject.toml": r'^version = "([\d.]+)"$',
    "web/package.json": r'^  "version": "([\d.]+)"',
}
said = {"vsa --version": subprocess.run([vsa, "--version"], capture_output=True, text=True, check=True).stdout.strip().removeprefix("vsa ")}
for name, pattern in PLACES.items():
    match = re.search(pattern, (root / name).read_text(encoding="utf-8"), re.M)
    said[name] = match.group(1) if match else "no version"
wrong = {name: version for name, version in said.items() if version != said["CMakeLists.txt"]}
for name, version in wrong.items():
    print(f"{name}: {version}, CMakeLists.txt says {said['CMakeLists.txt']}")
sys.exit(bool(wrong))
