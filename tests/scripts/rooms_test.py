# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""rooms.py finds what it is for, each in a small house that is otherwise in order."""
import pathlib
import tempfile
import unittest

import rooms

HOUSE = """# House

## Rooms

```text
core: the standard library only
  base
  bus      ← base
above it
  engine   ← bus
```
"""
LINKS = "bus: vsa::base\nengine: vsa::bus fmt::fmt\n"
FILES = {
    "include/vsa/errors.hpp": "#include <string>\n",
    "include/vsa/bus/frame.hpp": '#include <vector>\n#include "vsa/errors.hpp"\n',
    "src/bus/frame.cpp": '#include "vsa/bus/frame.hpp"\n\n#include "bus/bytes.hpp"\n',
    "src/bus/bytes.hpp": "#include <cstdint>\n",
    "include/vsa/engine/world.hpp": '#include "vsa/errors.hpp"\n',
    "src/engine/world.cpp": '#include <fmt/format.h>\n#include "vsa/bus/frame.hpp"\n#include "vsa/engine/world.hpp"\n',
    "apps/vsa/main.cpp": '#include "run/run.hpp"\n#include "vsa/engine/world.hpp"\n',
    "apps/vsa/run/run.hpp": "",
    "plugins/p/plugin.cpp": '#include "compat.hpp"\n#include "vsa/bus/frame.hpp"\n',
    "plugins/p/compat.hpp": "#include <gz/sim.hh>\n",
}


class Rooms(unittest.TestCase):
    def problems(self, files=None, readme=HOUSE, links=LINKS):
        with tempfile.TemporaryDirectory() as directory:
            root = pathlib.Path(directory)
            (root / rooms.LIST).parent.mkdir(parents=True)
            (root / rooms.LIST).write_text(readme, encoding="utf-8")
            (root / "links.txt").write_text(links)
            for name, text in {**FILES, **(files or {})}.items():
                path = root / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return rooms.check(root, root / "links.txt")

    def finds(self, what, *more, **tree):
        found = self.problems(**tree)
        self.assertEqual(len(found), 1 + len(more), found)
        for text in (what, *more):
            self.assertTrue(any(text in problem for problem in found), found)

    def test_a_house_in_order_has_no_problems(self):
        self.assertEqual(self.problems(), [])

    def test_a_source_of_tests_with_another_name(self):
        self.finds("tests/bus/frame.cpp:1: has tests", "tests/bus/help_test.cpp:1: is called a test",
                   files={"tests/bus/frame.cpp": "TEST_F(A, B) {}\n", "tests/bus/help_test.cpp": "", "tests/bus/help.cpp": ""})

    def test_a_room_that_the_list_hasnt(self):
        self.finds("room attic isn't in the list", files={"src/attic/a.cpp": ""})

    def test_a_room_that_isnt_there(self):
        self.finds("no such room: cellar", readme=HOUSE.replace("above it", "  cellar\nabove it"))

    def test_a_line_of_the_list_that_cant_be_read(self):
        found = self.problems(readme=HOUSE.replace("bus      ← base", "bus -> base"))
        self.assertIn(f"{rooms.LIST}:8: isn't \"ROOM  ← ROOM ROOM\": bus -> base", found)

    def test_an_include_that_points_up(self):
        self.finds("src/bus/frame.cpp:2: bus doesn't stand on engine",
                   files={"src/bus/frame.cpp": '#include "vsa/bus/frame.hpp"\n#include "vsa/engine/world.hpp"\n'})

    def test_an_include_of_what_isnt_linked(self):
        self.finds("bus doesn't link base", "bus is said to stand on base", "engine doesn't link base", links="engine: vsa::bus\n")

    def test_a_link_that_points_up(self):
        self.finds("bus links engine, on which it doesn't stand", "links in a circle: bus → engine → bus",
                   links="bus: vsa::base vsa::engine\nengine: vsa::bus\n")

    def test_a_room_that_is_said_to_stand_on_what_it_doesnt_link(self):
        self.finds("sensor is said to stand on bus", files={"src/sensor/a.cpp": ""},
                   readme=HOUSE.replace("above it", "above it\n  sensor  ← bus"))

    def test_rooms_in_a_circle(self):
        self.finds(f"{rooms.LIST}:3: rooms in a circle: bus → engine → bus", "bus is said to stand on engine",
                   readme=HOUSE.replace("bus      ← base", "bus      ← base engine"))

    def test_files_in_a_circle(self):
        self.finds("files in a circle: src/bus/bytes.hpp → src/bus/words.hpp → src/bus/bytes.hpp",
                   files={"src/bus/bytes.hpp": '#include "bus/words.hpp"\n', "src/bus/words.hpp": '#include "bytes.hpp"\n'})

    def test_a_private_header_of_another_room(self):
        self.finds('"bus/bytes.hpp" is a private header of bus', files={"src/engine/a.cpp": '#include "bus/bytes.hpp"\n'})
        self.finds('"bus/bytes.hpp" is a private header of bus', files={"apps/vsa/run/run.hpp": '#include "bus/bytes.hpp"\n'})

    def test_a_library_in_the_core(self):
        self.finds("src/bus/bytes.hpp:1: <fmt/format.h> in the core", files={"src/bus/bytes.hpp": "#include <fmt/format.h>\n"})

    def test_a_room_that_includes_an_app(self):
        self.finds("a room knows neither apps nor plugins",
                   files={"src/engine/a.cpp": '#include "../../apps/vsa/run/run.hpp"\n'})

    def test_a_header_that_isnt_there(self):
        self.finds('"bus/gone.hpp" is no header of this tree', files={"src/bus/bytes.hpp": '#include "bus/gone.hpp"\n'})

    def test_a_readme_without_a_list(self):
        self.finds('has no heading "Rooms"', readme="# House\n")


if __name__ == "__main__":
    unittest.main()
