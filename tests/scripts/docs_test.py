# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""What scripts/docs.py looks at, on small sites and logs."""
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import docs  # noqa: E402


class Docs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name).resolve()

    def write(self, name, text):
        (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
        (self.folder / name).write_text(text, encoding="utf-8")

    def doxygen(self, log="", tags="<tagfile/>"):
        """Doxygen's, as if it had run."""
        self.write("doxygen.txt", log)
        self.write("tags.xml", tags)
        out = object.__new__(docs.Doxygen)
        out.log, out.tags = self.folder / "doxygen.txt", self.folder / "tags.xml"
        return out

    def test_doxygens_errors_and_warnings_are_complaints(self):
        lines = ["/a/b.dot:1: error: Problems running dot: exit code=127, command='dot'", "error: Could not open file",
                 "/a/b.hpp:3: warning: Member x of class vsa::Y is not documented."]
        silent = "/a/b.hpp:4: warning: Member operator==(const Y &) const =default of class vsa::Y is not documented."
        self.assertEqual(self.doxygen("\n".join([*lines, silent, "", "said"])).complaints(), lines)

    def test_half_a_file_of_tags_is_told_by_its_name(self):
        with self.assertRaisesRegex(SystemExit, r"docs\.py: .*tags\.xml: Doxygen didn't write all of it .*free"):
            self.doxygen(tags="<tagfile><comp").read_tags()

    def test_links_and_pictures_of_both_kinds_of_pages_are_looked_at(self):
        self.write("index.html", '<a href="cpp/a.html#there">x</a><a href="cpp/a.html#gone">x</a><a href="none.html">x</a><img src="p.png">')
        self.write("p.png", "")
        self.write("cpp/a.html", '<a id="there"></a><img src="graph.png"><a href="#left-out">x</a><a href="../index.html">x</a>'
                                 '<script src="https://example.org/x.js"></script>')
        self.write("replay/snake.html", '<img src="none.png">')
        self.assertEqual(sorted(docs.dead_links(self.folder)),
                         ["cpp/a.html: graph.png leads nowhere", "cpp/a.html: loads https://example.org/x.js",
                          "index.html: cpp/a.html#gone: no such place on that page", "index.html: none.html leads nowhere"])

    def test_an_error_of_writing_names_the_file(self):
        with self.assertRaises(OSError) as caught:
            docs.write_file(self.folder, "a folder")
        self.assertEqual(caught.exception.filename, str(self.folder))


if __name__ == "__main__":
    unittest.main()
