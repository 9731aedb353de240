# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""manual.py finds what it is for, each in a small manual that is otherwise whole."""
import pathlib
import stat
import tempfile
import unittest

import manual

VSA = r"""#!/bin/sh
case $1 in
  run) printf 'Run a world\n\nOptions:\n  -h,--help  Help\n  --gait TEXT  Play\n' ;;
  *) printf 'vsa\n\nOptions:\n  -h,--help  Help\n  --version  V\n\nSubcommands:\n  run   Run a world\n\nExamples:\n' ;;
esac
"""
REFERENCE = "# Commands\n\n## `vsa run`\n\n| `--gait FILE` | play |\n"


class Manual(unittest.TestCase):
    def problems(self, **pages):
        """Of a manual with these pages below docs/ (`__` for `/`), beside an index that leads to all but `orphan`."""
        with tempfile.TemporaryDirectory() as directory:
            root = pathlib.Path(directory)
            texts = {"reference/command-line.md": REFERENCE}
            texts.update({name.replace("__", "/") + ".md": text for name, text in pages.items()})
            index = "".join(f"- [page]({name})\n" for name in texts if name != "orphan.md")
            for name, text in {**texts, "README.md": "# Manual\n\n" + index}.items():
                path = root / "docs" / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            vsa = root / "vsa"
            vsa.write_text(VSA)
            vsa.chmod(vsa.stat().st_mode | stat.S_IXUSR)
            return manual.check(root, str(vsa))

    def finds(self, what, **pages):
        found = self.problems(**pages)
        self.assertEqual(len(found), 1, found)
        self.assertIn(what, found[0])

    def test_a_whole_manual_has_no_problems(self):
        text = "# A page\n\n[here](#a-page), [there](other.md#two--words), [web](https://example.org/x)\n\n```sh\nvsa run w --gait g\n```\n"
        self.assertEqual(self.problems(page=text, other="# Two – `words`\n"), [])

    def test_a_link_to_a_file_that_isnt_there(self):
        self.finds("docs/page.md:3: no such file: gone.md", page="# A\n\n[b](gone.md)\n")

    def test_an_anchor_that_no_heading_has(self):
        self.finds("no such heading: #b", page="# A\n\n[b](#b)\n")

    def test_a_page_that_nothing_leads_to(self):
        self.finds("docs/orphan.md:1: can't be reached", orphan="# A\n")

    def test_a_long_line_but_not_a_long_row_address_or_code(self):
        long = "word " * 30
        self.finds("page.md:3: 149 columns", page=f"# A\n\n{long.strip()}\n")
        self.assertEqual(self.problems(page=f"# A\n\n| {long} |\n\n    {long}\n\n<https://e.org/{'x' * 130}>\n"), [])

    def test_a_subcommand_and_a_flag_that_the_program_lacks(self):
        self.finds("vsa walk: no such subcommand", page="# A\n\n`vsa walk`\n")
        self.finds("vsa run has no --gate", page="# A\n\n```sh\nbuild/bin/vsa run w \\\n  --gate g | tee --append f\n```\n")
        self.finds("no vsa command has --gate", page="# A\n\nuse `--gate g`\n")

    def test_a_flag_and_a_subcommand_that_the_reference_lacks(self):
        found = self.problems(**{"reference__command-line": "# Commands\n\n## `vsa run`\n"})
        self.assertEqual(len(found), 1, found)
        self.assertIn("vsa run --gait isn't in its section", found[0])
        found = self.problems(**{"reference__command-line": "# Commands\n"})
        self.assertIn("vsa run has no section", found[0])


if __name__ == "__main__":
    unittest.main()
