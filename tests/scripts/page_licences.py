# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""page_licences.py FOLDER: each page in it holds the licence text of every package that is bundled in it, and bundled.json names these.

What is bundled is told by the packages' own marks in the code, not by who bundled it.
"""
import json
import pathlib
import re
import sys

MARKS = {  # in the minified code, outside of the licence block
    "three": r'__THREE__|Three\.js Authors',
    "plotly.js-basic-dist-min": r"plotly_relayouting",
    "uplot": r"\bu-hz\b",
}
TEXTS = {
    "three": "three.js authors",
    "plotly.js-basic-dist-min": "Plotly, Inc",
    "uplot": "Leon Sorokin",
}
BLOCK = re.compile(r'<script type="text/plain" id="licences">\n(.*?)</script>', re.S)

folder = pathlib.Path(sys.argv[1])
told = json.loads((folder / "bundled.json").read_text(encoding="utf-8"))
failed = False


def wrong(what):
    global failed
    failed = True
    print(what)


pages = sorted(p.name for p in folder.glob("*.html"))
if pages != sorted(told) or len(pages) != 3:
    wrong(f"bundled.json tells of {sorted(told)}, the folder has {pages}")
for page in pages:
    text = (folder / page).read_text(encoding="utf-8")
    blocks = BLOCK.findall(text)
    if len(blocks) != 1:
        wrong(f"{page}: {len(blocks)} blocks of licences")
        continue
    code = BLOCK.sub("", text)
    inside = {name for name, mark in MARKS.items() if re.search(mark, code)}
    if inside != {p["name"] for p in told.get(page, [])}:
        wrong(f"{page}: holds {sorted(inside)}, bundled.json says {told.get(page)}")
    for p in told.get(page, []):
        if f"{p['name']} {p['version']} ({p['license']})" not in blocks[0] or TEXTS.get(p["name"], "\0") not in blocks[0]:
            wrong(f"{page}: no licence of {p['name']} {p['version']}")
    if blocks[0].count("Permission is hereby granted") != len(told.get(page, [])):
        wrong(f"{page}: not a licence text per package")
print(f"{len(pages)} pages, {sum(len(v) for v in told.values())} bundles: {'wrong' if failed else 'all with their licences'}")
sys.exit(failed)
