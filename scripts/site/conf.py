# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Sphinx's settings; scripts/docs.py runs it over a copy of the pages (make docs)."""
import os
import re

import vsasim

project = "vsasim"
project_copyright = "the vsasim authors, Apache-2.0"
release = os.environ["VSA_VERSION"]
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx_rtd_theme"]
root_doc = "index"
myst_heading_anchors = 4
suppress_warnings = ["myst.header"]  # a page may begin its sections where it likes
html_theme = "sphinx_rtd_theme"
html_title = f"vsasim {release}"
html_extra_path = [os.environ["VSA_SITE_EXTRA"]]  # what isn't a page of this manual: C++ pages, sources, the replay
html_static_path = ["site.css"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_search_summary = False  # it fetches pages, which a browser refuses from the disk
html_show_sphinx = False
autodoc_default_options = {"members": True, "undoc-members": False, "member-order": "bysource"}
autodoc_typehints = "signature"


def plain(app, what, name, obj, options, lines):
    """Docstrings are plain text: what reStructuredText would read in it is escaped, what is set in from the margin stays as it is."""
    paragraphs = "\n".join(lines).split("\n\n")
    lines[:] = []
    for paragraph in paragraphs:
        rows = paragraph.splitlines()
        if any(row.startswith((" ", "- ")) for row in rows):
            lines += ["::", "", *("   " + row for row in rows), ""]
        else:
            lines += [re.sub(r"`([^`]+)`", r"``\1``", re.sub(r"([*|_\\])", r"\\\1", row)) for row in rows] + [""]


def public(app, what, name, obj, options, signature, returned):
    """Where users find a class, which isn't where it is compiled."""
    return tuple(text and text.replace("vsasim._vsasim.", "vsasim.") for text in (signature, returned))


def setup(app):
    for value in vars(vsasim).values():
        if getattr(value, "__module__", "") == "vsasim._vsasim":
            value.__module__ = "vsasim"
    app.connect("autodoc-process-signature", public)
    app.connect("autodoc-process-docstring", plain)
