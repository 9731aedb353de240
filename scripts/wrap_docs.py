# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Wraps the prose of Markdown files at 120 columns, in place: python3 scripts/wrap_docs.py FILE…

Paragraphs and list items that have a line too long are filled anew, the others stay as they are. Headings, tables, code,
quotes and HTML comments are left alone; `…` is never broken, nor
a number from its %.
"""
import pathlib
import re
import sys
import unicodedata

COLUMNS = 120
ITEM = re.compile(r"^(\s*)([-*]|\d+\.)\s+")
FIXED = re.compile(r"^\s*(\||#|```|>|<!--|!\[)")


def columns(text):
    return sum(0 if unicodedata.combining(c) else 1 for c in text)


def fill(lines):
    """One paragraph or list item, its first line's indent and its others' kept."""
    item = ITEM.match(lines[0])
    first = re.match(r"\s*", lines[0]).group()
    rest = " " * len(item.group()) if item else first
    words = re.findall(r"(?:`[^`]*`|\S|(?<=\d) (?=%))+", " ".join(line.strip() for line in lines))
    for i in range(len(words) - 1, 0, -1):  # no line may begin with what would be a list or a heading there
        if re.fullmatch(r"[-*+#>|]|\d+[.)]", words[i]):
            words[i - 1 : i + 1] = [words[i - 1] + " " + words[i]]
    out, line = [], first
    for word in words:
        if line.strip() and columns(line) + 1 + columns(word) > COLUMNS:
            out.append(line)
            line = rest
        line += ("" if not line.strip() else " ") + word
    return out + [line]


def wrap(text):
    out, block = [], []
    fence = False

    def flush():
        out.extend(fill(block) if any(columns(line) > COLUMNS for line in block) else block)
        block.clear()

    before = ""
    for line in text.splitlines():
        opens = line.lstrip().startswith("```")
        code = not block and line.startswith("    ") and (before == "" or before.startswith("    "))
        if fence or opens or code or not line.strip() or FIXED.match(line):
            flush()
            out.append(line)
            fence ^= opens
        elif ITEM.match(line):
            flush()
            block.append(line)
        else:
            block.append(line)
        before = line
    flush()
    return "\n".join(out) + "\n"


if __name__ == "__main__":
    missing = [name for name in sys.argv[1:] if not pathlib.Path(name).is_file()]
    if missing or len(sys.argv) < 2:
        print(f"wrap_docs.py: {', '.join(missing) or 'FILE'}: no such file; nothing was wrapped", file=sys.stderr)
        sys.exit(2)
    for name in sys.argv[1:]:
        path = pathlib.Path(name)
        path.write_text(wrap(path.read_text(encoding="utf-8")), encoding="utf-8")
