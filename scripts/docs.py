#!/usr/bin/env python3
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Builds the manual as a site that needs no network: python3 scripts/docs.py BUILD
`docs.py names` only asks Doxygen whether each public C++ name has a docstring: seconds, and no build; code 77 without Doxygen.

BUILD is a build tree with `vsa` and the Python module. Into BUILD/docs/site go docs/ by Sphinx, with search; the C++ names by
Doxygen, the Python names by autodoc; a replay page, made anew; sources and folders that pages link to. A page of the repository
outside docs/ is there as repository/NAME.

Ends with code 1, and a line each, where Sphinx or Doxygen has a complaint (a public C++ name without a docstring is one), a link or
picture of a page leads nowhere, or a file can't be written.
"""
import html.parser
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parent.parent
FENCE = re.compile(r"^(?:```|~~~).*?^(?:```|~~~)\s*$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\[\]]*\])*)\]\(([^)\s]+)\)")
PAGE_DIRECTORIES = {".git", "build", "out", "node_modules"}


def write_file(path, text):
    """As Path.write_text, and what goes wrong names the file: a full disk's error of Python's doesn't."""
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from error


def copy_file(source, path):
    """As shutil.copyfile, and what goes wrong names the file that couldn't be written."""
    try:
        shutil.copyfile(source, path)
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from error


def run(*command, **options):
    """The command's output; ends the program where it fails."""
    done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(str(c) for c in command)}: exit code {done.returncode}\n{done.stdout}")
    return done.stdout


class Doxygen:
    """The C++ pages: where each header's is, and what Doxygen complains about."""

    COMPLAINT = re.compile(r"(?:^|: )(?:warning|error): ")
    # What says nothing beyond its signature: operators, what is moved, copied or defaulted, and the walk over a state's fields
    # (vsa/state_walk.hpp), whose contract stands at state::Sink.
    SILENT = re.compile(r"Member (operator\W|~|(fields|impossible|decode_reply< .* >)\(|.*(&&|=default).*\(function\))"
                        r"|Member .* of class vsa::state::(Namer|Sizer|Reader|Writer)\b")

    def __init__(self, into, version):
        into.mkdir(parents=True)
        self.log, self.tags = into.parent.parent / "doxygen.txt", into.parent.parent / "tags.xml"
        settings = (ROOT / "scripts/site/Doxyfile").read_text(encoding="utf-8")
        # In quotes: a path may have blanks.
        settings += (f'INPUT = "{ROOT}/include/vsa" "{ROOT}/scripts/site/namespaces.dox"\nSTRIP_FROM_PATH = "{ROOT}/include"\n'
                     f'OUTPUT_DIRECTORY = "{into}"\nPROJECT_NUMBER = {version}\nWARN_LOGFILE = "{self.log}"\nGENERATE_TAGFILE = "{self.tags}"\n')
        run("doxygen", "-", input=settings)
        self.pages = {}
        compounds = list(self.read_tags().iter("compound")) if self.tags.is_file() else []
        # Who looked at no header has no complaint either; namespaces it has from namespaces.dox.
        if all(c.get("kind") == "namespace" for c in compounds):
            said = self.log.read_text(encoding="utf-8") if self.log.is_file() else ""
            sys.exit(f"docs.py: Doxygen found no class in {ROOT}/include/vsa\n{said}")
        for compound in compounds:
            if compound.get("kind") == "file":
                path = compound.findtext("path", "") + compound.findtext("name", "")
                page = compound.findtext("filename", "")
                self.pages["include/" + path] = page if page.endswith(".html") else page + ".html"

    def read_tags(self):
        """Doxygen ends with code 0 on a full disk, too, and leaves half a file."""
        try:
            return xml.etree.ElementTree.parse(self.tags).getroot()
        except xml.etree.ElementTree.ParseError as error:
            free_MB = shutil.disk_usage(self.tags).free >> 20
            sys.exit(f"docs.py: {self.tags}: Doxygen didn't write all of it ({error}); {free_MB} MB are free on that disk")

    def warnings(self):
        """What it warns of, and its errors: those of programs that it calls among them."""
        return [line for line in self.log.read_text(encoding="utf-8").splitlines() if self.COMPLAINT.search(line)]

    def complaints(self):
        """A public name without a docstring, and whatever else Doxygen finds wrong."""
        return [line for line in self.warnings() if not self.SILENT.match(self.COMPLAINT.split(line, 1)[-1])]


class Stage:
    """A copy of the pages for Sphinx, with links that lead to where things are on the site."""

    def __init__(self, into, headers):
        self.into, self.extra, self.headers = into, into.parent / "extra", headers
        self.extra.mkdir(parents=True, exist_ok=True)
        self.wanted = []  # pages outside docs/ that a page links to
        self.done, self.wrong = set(), []

    def place(self, path):
        """Where a page of the repository is in the copy."""
        if path == ROOT / "docs/README.md":
            return self.into / "index.md"
        inside = path.is_relative_to(ROOT / "docs")
        return self.into / (path.relative_to(ROOT / "docs") if inside else pathlib.Path("repository") / path.relative_to(ROOT))

    def source(self, path):
        """A file or folder as something that a browser shows; its place below the site's root."""
        name = path.relative_to(ROOT)
        if path.is_dir():
            place = pathlib.Path("source") / name / "index.html"
            if place not in self.done:
                self.done.add(place)
                rows = [f'<li><a href="{self.up(place, self.source(p))}">{p.name}{"/" if p.is_dir() else ""}</a></li>'
                        for p in sorted(path.iterdir()) if p.name[0] != "." and p.name not in PAGE_DIRECTORIES | {"__pycache__"}]
                self.write(place, f'<!DOCTYPE html><meta charset="utf-8"><title>{name}</title><h1>{name}</h1><ul>{"".join(rows)}</ul>')
            return place
        if str(name) in self.headers:
            return pathlib.Path("cpp") / self.headers[str(name)]
        shown = name.suffix in {".png", ".svg", ".html", ".txt", ".json", ".csv"}
        place = pathlib.Path("source") / (name if shown else name.with_name(name.name + ".txt"))
        if place not in self.done:
            self.done.add(place)
            target = self.extra / place
            target.parent.mkdir(parents=True, exist_ok=True)
            copy_file(path, target)
        return place

    def write(self, place, text):
        target = self.extra / place
        target.parent.mkdir(parents=True, exist_ok=True)
        write_file(target, text)

    @staticmethod
    def up(page, place):
        return urllib.parse.quote(os.path.relpath(place, page.parent))

    def link(self, page, match):
        picture, text, target = match.groups()
        if re.match(r"[a-z]+:|#", target):
            return match.group(0)
        target, _, anchor = target.partition("#")
        path = (page.parent / urllib.parse.unquote(target)).resolve()
        here = self.place(page)
        if not path.exists():
            self.wrong.append(f"{page.relative_to(ROOT)}: {match.group(3)} leads nowhere")
            return text
        if path.is_dir() and (path / "README.md").is_file():
            path = path / "README.md"
        if path.suffix == ".md":
            self.wanted.append(path)
            to = os.path.relpath(self.place(path), here.parent)
            return f"{picture}[{text}]({to}{'#' + anchor if anchor else ''})"
        if picture:
            return f"![{text}]({os.path.relpath(self.picture(path), here.parent)})"
        return f'<a href="{self.up(here.relative_to(self.into), self.source(path))}">{text}</a>'

    def picture(self, path):
        place = self.place(path)
        place.parent.mkdir(parents=True, exist_ok=True)
        copy_file(path, place)
        return place

    def add(self, page):
        """The page and those outside docs/ that it leads to."""
        place = self.place(page)
        if place in self.done:
            return
        self.done.add(place)
        text, out, at = page.read_text(encoding="utf-8"), "", 0
        for fence in [*FENCE.finditer(text), None]:
            prose = text[at:fence.start() if fence else len(text)]
            out += LINK.sub(lambda m: self.link(page, m), prose) + (fence.group(0) if fence else "")
            at = fence.end() if fence else 0
        if page == ROOT / "docs/README.md":
            out += contents(text)
        elif not page.is_relative_to(ROOT / "docs"):
            out = "---\norphan: true\n---\n\n" + out
        place.parent.mkdir(parents=True, exist_ok=True)
        write_file(place, out)
        while self.wanted:
            self.add(self.wanted.pop())


def contents(index):
    """What the side bar has: the pages of docs/README.md under its headings, and the names of the libraries."""
    chapters, caption = {}, "Begin"
    for line in index.splitlines():
        if line.startswith("## "):
            caption = line[3:]
        for target in re.findall(r"\]\(([^)#]+\.md)\)", line):
            if not target.startswith(".."):
                chapters.setdefault(caption, []).append(target[:-3])
    chapters["Names"] = ["cpp", "python", "replay"]
    out = ""
    for caption, pages in chapters.items():
        out += f"\n```{{toctree}}\n:hidden:\n:caption: {caption}\n\n" + "\n".join(dict.fromkeys(pages)) + "\n```\n"
    return out


class Links(html.parser.HTMLParser):
    """What a page loads and leads to, and the anchors that it has."""

    def __init__(self, page):
        super().__init__()
        self.targets, self.loads, self.anchors = [], [], set()
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for key, value in attributes:
            if key in ("id", "name") and value:
                self.anchors.add(value)
            if value and ((key == "href" and tag == "a") or (key == "src" and tag == "iframe")):
                self.targets.append(value)
            elif value and ((key == "src") or (key == "href" and tag == "link")):
                self.loads.append(value)


def dead_links(site):
    """Of Sphinx's and Doxygen's pages: links and pictures that lead nowhere, and whatever is loaded from the net."""
    files = {str(p) for p in site.rglob("*") if p.is_file()}
    pages = {str(p): Links(p) for p in site.rglob("*.html") if not p.is_relative_to(site / "replay")}
    doxygens = str(site / "cpp") + os.sep  # whose summaries lead to sections that a page may lack
    wrong = []
    for page, links in pages.items():
        name = os.path.relpath(page, site)
        wrong += [f"{name}: loads {url}" for url in links.loads if re.match(r"(https?:)?//", url)]
        for url in links.targets + links.loads:
            if re.match(r"[a-z]+:|//", url):
                continue
            target, _, anchor = url.partition("#")
            # By their names: to ask the disk about each of Doxygen's 65,000 takes long.
            path = os.path.normpath(os.path.join(os.path.dirname(page), urllib.parse.unquote(target.split("?")[0]))) if target else page
            if path not in files:
                wrong.append(f"{name}: {url} leads nowhere")
            elif anchor and not page.startswith(doxygens) and path in pages and urllib.parse.unquote(anchor) not in pages[path].anchors:
                wrong.append(f"{name}: {url}: no such place on that page")
    return wrong


def record_replay(build, stage):
    """The page of a short run; the other files of the recording stay outside."""
    out = stage.into.parent / "recorded"
    run(build / "bin/vsa", "run", "snake_flat", "--gait", "sidewind", "--duration-s", "6", "--record", out, "--no-topics")
    (stage.extra / "replay").mkdir()
    copy_file(out / "replay.html", stage.extra / "replay/snake.html")


def sphinx(build, stage, site, version):
    """Its complaints, a line each."""
    log = stage.into.parent / "sphinx.txt"
    python = build / "python"
    environment = dict(os.environ, VSA_VERSION=version, VSA_SITE_EXTRA=str(stage.extra), PYTHONPATH=str(python), PYTHONDONTWRITEBYTECODE="1")
    run("/usr/bin/python3", "-m", "sphinx", "-q", "-b", "html", "-c", ROOT / "scripts/site", "-w", log, stage.into, site, env=environment)
    return [line.replace(str(stage.into) + "/", "") for line in log.read_text(encoding="utf-8").splitlines() if line]


def main_of_names():
    if shutil.which("doxygen") is None:
        print("left out: Doxygen is not installed")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        wrong = Doxygen(pathlib.Path(folder) / "extra/cpp", "names").complaints()
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


def main(build):
    out = build / "docs"
    site = out / "site"
    shutil.rmtree(out, ignore_errors=True)
    version = run(build / "bin/vsa", "--version").split()[1]
    doxygen = Doxygen(out / "extra/cpp", version)
    wrong = doxygen.complaints()
    stage = Stage(out / "stage", doxygen.pages)
    for page in sorted((ROOT / "docs").rglob("*.md")):
        stage.add(page)
    for page in sorted((ROOT / "scripts/site").glob("*.md")):
        copy_file(page, stage.into / page.name)
    record_replay(build, stage)
    wrong += stage.wrong + sphinx(build, stage, site, version) + dead_links(site)
    for line in wrong:
        print(line, file=sys.stderr)
    print(f"{site}/index.html")
    return 1 if wrong else 0


def program(arguments):
    if arguments == ["names"]:
        return main_of_names()
    if len(arguments) != 1 or not (pathlib.Path(arguments[0]) / "bin/vsa").is_file():
        print(f"docs.py: {' '.join(arguments) or 'nothing'}: not a build tree with bin/vsa; usage: docs.py BUILD | docs.py names", file=sys.stderr)
        return 2
    return main(pathlib.Path(arguments[0]).resolve())


if __name__ == "__main__":
    try:
        sys.exit(program(sys.argv[1:]))
    except OSError as error:
        sys.exit(f"docs.py: {error.filename or ROOT}: {error.strerror}")
