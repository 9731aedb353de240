# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Checks the manual: python3 manual.py ROOT [VSA]

links    every link and anchor of README, CONTRIBUTING, data/README, docs/ and ros2/ resolves (those to the web aren't looked at)
pages    every page below docs/ is reached from docs/README.md
lines    no line above 120 columns but in tables, code blocks and where an address makes it long
commands every `vsa` subcommand and flag that a page names is in that command's --help, and the reference of the command line
         names them all (with VSA, the program)

Prints FILE:LINE: what is wrong; exit code 1 where anything is.
"""
import pathlib
import re
import subprocess
import sys
import unicodedata

COLUMNS = 120
# Flags in `…` without their program's name that belong to other programs than vsa.
FOREIGN_FLAGS = {"--ros-args", "--use-angle"}
OLD_FLAGS = {"--preset"}  # understood for one more release
CODE_SPAN = re.compile(r"`((?:[^`\n]|\n(?!\s*\n))+)`")  # `…`, over two lines too
PLACEHOLDER = re.compile(r"[A-Z…<\[(\"'$-]")


class Page:
    """A Markdown file, taken apart: prose lines, code, headings' anchors, links."""

    def __init__(self, path):
        self.path = path
        self.prose, self.code = [], []  # (line number, text)
        self.headings = {}
        fence = False
        before = ""
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if line.lstrip().startswith("```"):
                fence = not fence
            elif fence or (line.startswith("    ") and (before == "" or before.startswith("    "))):
                self.code.append((number, line))
            else:
                self.prose.append((number, line))
                if line.startswith("#"):
                    self._add_heading(line)
            before = line
        self.anchors = set(self.headings)

    def _add_heading(self, line):
        """As GitHub makes them: lower case, punctuation out, blanks to dashes, -1, -2 … for those that come again."""
        text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", line.lstrip("#").strip()).replace("`", "")
        slug = re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")
        count = sum(1 for h in self.headings.values() if h == slug)
        self.headings[slug if count == 0 else f"{slug}-{count}"] = slug

    def links(self):
        """(line number, target), pictures and links over two lines included."""
        text, number_at = self._text()
        without_code = CODE_SPAN.sub(lambda m: re.sub(r"[^\n]", "x", m.group()), text)
        for match in re.finditer(r"\]\(([^)\s]+)\)", without_code):
            yield number_at(match.start()), text[match.start(1) : match.end(1)]

    def _text(self):
        """The prose in one piece, and what tells an index's line number."""
        text = "\n".join(line for _, line in self.prose)
        return text, lambda at: self.prose[text.count("\n", 0, at)][0]

    def commands(self):
        """(line number, text) of all that may hold a command: code lines, with \\ joined, and `…`."""
        held = ""
        for number, line in self.code:
            held += re.sub(r"(^|\s)#.*", "", line)
            if held.endswith("\\"):
                held = held[:-1] + " "
                continue
            yield number, held
            held = ""
        text, number_at = self._text()
        for span in CODE_SPAN.finditer(text):
            yield number_at(span.start()), span.group(1)


def pages_of(root):
    found = [root / name for name in ("README.md", "CONTRIBUTING.md", "data/README.md") if (root / name).is_file()]
    for folder in ("docs", "ros2"):
        found += sorted((root / folder).rglob("*.md"))
    return [Page(path) for path in found]


def check_links(pages, complain):
    """Returns who links to whom."""
    known = {page.path.resolve(): page for page in pages}
    arrows = {}
    for page in pages:
        for number, target in page.links():
            if re.match(r"[a-z]+:", target):
                continue
            name, _, anchor = target.partition("#")
            path = (page.path.parent / name).resolve() if name else page.path.resolve()
            if not path.exists():
                complain(page, number, f"no such file: {target}")
                continue
            arrows.setdefault(page.path.resolve(), set()).add(path)
            if anchor and path in known and anchor not in known[path].anchors:
                complain(page, number, f"no such heading: {target}")
    return arrows


def check_reach(root, pages, arrows, complain):
    index = (root / "docs/README.md").resolve()
    reached, queue = {index}, [index]
    while queue:
        for path in arrows.get(queue.pop(), ()):
            if path not in reached:
                reached.add(path)
                queue.append(path)
    for page in pages:
        if (root / "docs").resolve() in page.path.resolve().parents and page.path.resolve() not in reached:
            complain(page, 1, "can't be reached from docs/README.md")


def check_lines(pages, complain):
    for page in pages:
        for number, line in page.prose:
            shown = re.sub(r"https?://\S+", "", line)
            columns = sum(1 for c in shown if not unicodedata.combining(c))
            if columns > COLUMNS and not line.lstrip().startswith("|"):
                complain(page, number, f"{columns} columns, at most {COLUMNS}")


class Help:
    """What the program says of itself: subcommand → its flags; "" → those of the program."""

    def __init__(self, vsa):
        def ask(*words):
            return subprocess.run([vsa, *words, "--help"], capture_output=True, text=True, check=True).stdout

        top = ask()
        names = re.findall(r"^  ([a-z]+) ", top.split("Subcommands:")[1].split("\n\n")[0], re.MULTILINE)
        self.flags = {"": self._flags(top)}
        self.flags.update({name: self._flags(ask(name)) for name in names})

    @staticmethod
    def _flags(text):
        return set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", text, re.MULTILINE)) | {"--help"}

    def anywhere(self, flag):
        return any(flag in flags for flags in self.flags.values())


def check_command(help_, words, wrong):
    """`words` follow the program's name."""
    command = words[0] if words and not words[0].startswith("-") else ""
    if command and PLACEHOLDER.match(command):
        return
    if command not in help_.flags:
        wrong(f"vsa {command}: no such subcommand")
        return
    for word in words:
        if word in ("|", "&", "&&", ";", "||", ">"):
            break
        flag = re.match(r"\[?(--[A-Za-z][\w-]*)", word)
        if flag and flag.group(1) not in help_.flags[command]:
            wrong(f"vsa {command} has no {flag.group(1)}")


def check_commands(root, pages, help_, complain):
    for page in pages:
        for number, text in page.commands():
            words = text.split()
            starts = [i for i, word in enumerate(words) if re.fullmatch(r"(.*/)?vsa", word.lstrip("("))]
            in_code = any(n == number for n, _ in page.code)
            for start in starts:
                if in_code or start == 0 or "=" in words[start - 1]:
                    check_command(help_, words[start + 1 :], lambda what, n=number: complain(page, n, what))
            flag = re.match(r"(--[A-Za-z][\w-]*)", text)
            if flag and not in_code and flag.group(1) not in FOREIGN_FLAGS | OLD_FLAGS and not help_.anywhere(flag.group(1)):
                complain(page, number, f"no vsa command has {flag.group(1)}")
    reference = root / "docs/reference/command-line.md"
    text = reference.read_text(encoding="utf-8")
    for command, flags in help_.flags.items():
        section = re.search(rf"^## `vsa {command}`$(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
        if command and not section:
            complain(Page(reference), 1, f"vsa {command} has no section")
        elif command:
            for flag in sorted(flags - {"--help"}):
                if not re.search(rf"{flag}(?![\w-])", section.group(1)):
                    complain(Page(reference), 1, f"vsa {command} {flag} isn't in its section")


def check(root, vsa=None):
    """All that is wrong, a line each."""
    problems = []

    def complain(page, number, what):
        problems.append(f"{page.path.relative_to(root)}:{number}: {what}")

    pages = pages_of(root)
    arrows = check_links(pages, complain)
    check_reach(root, pages, arrows, complain)
    check_lines(pages, complain)
    if vsa:
        check_commands(root, pages, Help(vsa), complain)
    return problems


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or not (pathlib.Path(sys.argv[1]) / "docs" / "README.md").is_file():
        print(f"manual.py: ROOT = {' '.join(sys.argv[1:2]) or 'missing'}: a checkout with docs/README.md; usage: manual.py ROOT [VSA]",
              file=sys.stderr)
        sys.exit(2)
    found = check(pathlib.Path(sys.argv[1]), *sys.argv[2:3])
    print("\n".join(found) if found else "The manual is whole.")
    sys.exit(1 if found else 0)
