# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""The manual as the package vsasim-doc has it: manual.py --out DIR

DIR, which is made anew, gets docs/, README.md, CONTRIBUTING.md and whatever other pages they link to. A link to headers or data leads
to where the other packages have them, seen from share/doc/vsasim-doc. One to what no package has (sources, tests) becomes its text,
with the path in the sources.
"""
import argparse
import os
import pathlib
import re
import shutil
import sys
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "scripts"))
from docs import FENCE, LINK, copy_file, write_file  # noqa: E402  (what Markdown is here, in one place)

PAGES = "usr/share/doc/vsasim-doc"
# Beside the pages that are linked: what the package has anyway, and where other packages have the rest.
WHOLE = ("docs", "examples")
ELSEWHERE = {"include/vsa": "usr/include/vsa", "actuators": "usr/share/vsa/actuators", "models": "usr/share/vsa/models",
             "data": "usr/share/vsa/data", "LICENSE": "usr/share/vsa/LICENSE"}


class Manual:
    def __init__(self, into):
        self.into = into
        self.pages = {pathlib.Path("README.md"), pathlib.Path("CONTRIBUTING.md")}
        self.pages |= {p.relative_to(ROOT) for p in (ROOT / "docs").rglob("*.md")}
        self.done = set()

    def link(self, page, match):
        picture, text, target = match.groups()
        if re.match(r"[a-z]+:|#", target):
            return match.group(0)
        target, _, anchor = target.partition("#")
        path = pathlib.Path(os.path.normpath(page.parent / urllib.parse.unquote(target)))
        if (ROOT / path / "README.md").is_file() and path.parts[0] not in WHOLE:
            path = path / "README.md"
        if path.suffix == ".md":
            self.pages.add(path)
        place = self.place(path)
        if place is None:
            return text if path.name in text else f"{text} (`{path}`)"
        here = pathlib.Path(PAGES) / page.parent
        return f"{picture}[{text}]({urllib.parse.quote(os.path.relpath(place, here))}{'#' + anchor if anchor else ''})"

    def place(self, path):
        """Where it is on a machine with the packages; None: in no package."""
        if path in self.pages or path.parts[0] in WHOLE:
            return pathlib.Path(PAGES) / path
        for ours, theirs in ELSEWHERE.items():
            if path.is_relative_to(ours):
                return pathlib.Path(theirs) / path.relative_to(ours)
        return None

    def add(self, page):
        text, out, at = (ROOT / page).read_text(encoding="utf-8"), "", 0
        for fence in [*FENCE.finditer(text), None]:
            prose = text[at:fence.start() if fence else len(text)]
            out += LINK.sub(lambda m: self.link(page, m), prose) + (fence.group(0) if fence else "")
            at = fence.end() if fence else 0
        (self.into / page).parent.mkdir(parents=True, exist_ok=True)
        write_file(self.into / page, out)

    def make(self):
        shutil.rmtree(self.into, ignore_errors=True)
        for file in sorted(p.relative_to(ROOT) for p in (ROOT / "docs").rglob("*") if p.is_file() and p.suffix != ".md"):
            (self.into / file).parent.mkdir(parents=True, exist_ok=True)
            copy_file(ROOT / file, self.into / file)
        while self.pages - self.done:
            page = min(self.pages - self.done)
            self.done.add(page)
            self.add(page)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    Manual(parser.parse_args().out).make()


if __name__ == "__main__":
    try:
        main()
    except OSError as error:
        sys.exit(f"manual.py: {error.filename or ROOT}: {error.strerror}")
