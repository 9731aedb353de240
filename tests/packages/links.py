# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Links of the package vsasim-doc that lead nowhere: links.py, of what packaging/manual.py makes now; check.py asks of packages.

Exit code 1, and a line each, where there is any.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests/scripts"))
import manual  # noqa: E402

PAGES = pathlib.Path("usr/share/doc/vsasim-doc")


def dead_links(pages, is_there):
    """(number of links, a line for each that leads nowhere); `is_there`: whether a package has this path, seen from the system's root."""
    count, dead = 0, []
    for page in sorted(pages.rglob("*.md")):
        name = page.relative_to(pages)
        for number, target in manual.Page(page).links():
            if "://" in target or target.startswith(("#", "mailto:")):
                continue
            count += 1
            path = os.path.normpath(PAGES / name.parent / urllib.parse.unquote(target.partition("#")[0]))
            if not is_there(pathlib.Path(path)):
                dead.append(f"{name}:{number}: {target} leads to {path}, which no package has")
    return count, dead


def main():
    with tempfile.TemporaryDirectory() as folder:
        pages = pathlib.Path(folder) / "pages"
        subprocess.run([sys.executable, ROOT / "packaging/manual.py", "--out", pages], check=True)

        def is_there(path):
            """As cmake/install.cmake and cmake/packages.cmake install it."""
            for place, source in {PAGES / "examples": ROOT / "examples", PAGES: pages, pathlib.Path("usr/include"): ROOT / "include",
                                  pathlib.Path("usr/share/vsa"): ROOT}.items():
                if path.is_relative_to(place):
                    return (source / path.relative_to(place)).exists()
            return False

        count, dead = dead_links(pages, is_there)
    for line in dead:
        print(line)
    print(f"links: {count}, {len(dead)} of them dead")
    return 1 if dead or count < 300 else 0


if __name__ == "__main__":
    sys.exit(main())
