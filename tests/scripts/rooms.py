# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Checks that arrows between rooms point only downward: python3 rooms.py ROOT LINKS

The list of rooms is that of docs/explanation/rooms.md, the first code block below its heading "Rooms": a line "  ROOM  ← ROOM ROOM"
each, under lines that don't begin with a blank; where such a line begins with "core", its rooms know nothing but the standard library and rooms.
LINKS is what CMake wrote at configure time (cmake/rooms.cmake): a line "ROOM: TARGET TARGET" each.

rooms     every folder of src and include/vsa is in the list, and every room of the list is there
arrows    an #include of include, src, apps and plugins, and a link, leads to the room itself or one below it, by the list; what a
          room includes it also links; what the list says is below a room, it links
private   "ROOM/x.hpp" of src is included by that room alone
cycles    neither the list nor files have any
core      no header but the standard library's and rooms'
tests     a source of tests/ROOM with tests in it is called NAME_test.cpp, and no other is

Prints FILE:LINE: what is wrong; exit code 1 where anything is.
"""
import pathlib
import re
import sys

LIST = "docs/explanation/rooms.md"
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')
ROOM = re.compile(r"^\s+([a-z_]+)(?:\s+←((?:\s+[a-z_]+)+))?\s*$")
STANDARD = set(
    "algorithm any array atomic barrier bit bitset cassert cctype cerrno cfenv cfloat charconv chrono cinttypes climits clocale cmath"
    " compare complex concepts condition_variable coroutine csetjmp csignal cstdarg cstddef cstdint cstdio cstdlib cstring ctime cuchar"
    " cwchar cwctype deque exception execution filesystem format forward_list fstream functional future initializer_list iomanip ios"
    " iosfwd iostream istream iterator latch limits list locale map memory memory_resource mutex new numbers numeric optional ostream"
    " queue random ranges ratio regex scoped_allocator semaphore set shared_mutex source_location span sstream stack stdexcept"
    " stop_token streambuf string string_view strstream syncstream system_error thread tuple type_traits typeindex typeinfo"
    " unordered_map unordered_set utility valarray variant vector version".split()
)


class House:
    """The list of rooms: what stands on what, and which are core."""

    def __init__(self, readme, complain):
        self.below, self.core = {}, set()
        lines = readme.read_text(encoding="utf-8").splitlines()
        heading = next((i for i, line in enumerate(lines) if re.fullmatch(r"#+ Rooms", line)), None)
        if heading is None:
            complain(readme, 1, 'has no heading "Rooms"')
            return
        fences = [i for i in range(heading, len(lines)) if lines[i].startswith("```")][:2]
        if len(fences) < 2:
            complain(readme, heading + 1, "no list of rooms in a code block below it")
            return
        core = False
        for number in range(fences[0] + 1, fences[1]):
            line = lines[number]
            match = ROOM.match(line)
            if match:
                self.below[match[1]] = (match[2] or "").split()
                if core:
                    self.core.add(match[1])
            elif line.startswith(" "):
                complain(readme, number + 1, f'isn\'t "ROOM  ← ROOM ROOM": {line.strip()}')
            elif line:
                core = line.startswith("core")
        for room, others in self.below.items():
            for other in others:
                if other not in self.below:
                    complain(readme, heading + 1, f"{room} stands on {other}, which isn't in the list")
        for cycle in cycles(self.below):
            complain(readme, heading + 1, "rooms in a circle: " + " → ".join(cycle))


def cycles(arrows):
    """One for each group of nodes that lead back to themselves: [a, b, a]."""
    state, found = {}, []

    def walk(start):
        path, stack = [start], [iter(arrows.get(start, ()))]
        state[start] = "open"
        while stack:
            for node in stack[-1]:
                if node not in state:
                    state[node] = "open"
                    path.append(node)
                    stack.append(iter(arrows.get(node, ())))
                    break
                if state[node] == "open":
                    found.append(path[path.index(node) :] + [node])
            else:
                state[path.pop()] = "done"
                stack.pop()

    for node in list(arrows):
        if node not in state:
            walk(node)
    return found


def reach(arrows, start):
    """All that `start` leads to, and itself."""
    seen, open_ = {start}, [start]
    while open_:
        for node in arrows.get(open_.pop(), ()):
            if node not in seen:
                seen.add(node)
                open_.append(node)
    return seen


class Tree:
    """The sources and what they include."""

    def __init__(self, root):
        self.root = root
        files = (p for top in ("include", "src", "apps", "plugins") for p in sorted((root / top).rglob("*")))
        self.files = [p for p in files if p.suffix in (".hpp", ".cpp", ".hh", ".h") and p.is_file()]

    def room_of(self, path):
        """None for apps and plugins, which know every room."""
        parts = path.relative_to(self.root).parts
        inner = parts[1:] if parts[0] == "src" else parts[2:] if parts[:2] == ("include", "vsa") else None
        return None if inner is None else inner[0] if len(inner) > 1 else "base"

    def includes(self, path):
        """(line number, text, file or None where it isn't of this tree, whether in quotes)"""
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            if match:
                yield number, match[1] or match[2], self._find(path, match[1] or match[2]), match[1] is not None

    def _find(self, path, name):
        top = path.relative_to(self.root).parts[0]
        folders = [path.parent, self.root / "include", self.root / "src"]
        folders += [self.root / "apps" / "vsa", self.root / "apps"] if top == "apps" else []
        folders += [self.root / "plugins"] if top == "plugins" else []
        for folder in folders:
            file = pathlib.Path(folder / name)
            if file.is_file():
                return file.resolve()
        return None


def links_of(path):
    """From what CMake wrote: room → rooms."""
    links = {}
    for line in path.read_text(encoding="utf-8").splitlines():
        room, targets = line.split(":", 1)
        links[room] = [t.split("::")[1] for t in targets.split() if t.startswith("vsa::")]
    return links


def check_folders(root, house, complain):
    folders = {p.name for top in (root / "src", root / "include" / "vsa") for p in top.iterdir() if p.is_dir()} | {"base"}
    for room in sorted(folders - set(house.below)):
        complain(root / LIST, 1, f"room {room} isn't in the list")
    for room in sorted(set(house.below) - folders):
        complain(root / LIST, 1, f"no such room: {room}")


def check_includes(tree, house, links, complain):
    arrows = {}
    for path in tree.files:
        room = tree.room_of(path)
        arrows[path.resolve()] = []
        for number, name, found, quoted in tree.includes(path):
            if found is None:
                if quoted:
                    complain(path, number, f'"{name}" is no header of this tree')
                elif room in house.core and name not in STANDARD:
                    complain(path, number, f"<{name}> in the core, which knows the standard library only")
                continue
            arrows[path.resolve()].append(found)
            other = tree.room_of(found)
            if other == room:
                continue
            if other is None:
                complain(path, number, f'"{name}": a room knows neither apps nor plugins')
            elif found.is_relative_to(tree.root / "src"):
                complain(path, number, f'"{name}" is a private header of {other}')
            elif room is not None and other not in reach(house.below, room):
                complain(path, number, f"{room} doesn't stand on {other}")
            elif room is not None and other not in reach(links, room):
                complain(path, number, f"{room} doesn't link {other}")
    for cycle in cycles(arrows):
        complain(cycle[0], 1, "files in a circle: " + " → ".join(str(p.relative_to(tree.root)) for p in cycle))


def check_links(root, house, links, complain):
    readme = root / LIST
    for room, others in links.items():
        for other in others:
            if other not in reach(house.below, room):
                complain(readme, 1, f"{room} links {other}, on which it doesn't stand")
    for room, others in house.below.items():
        for other in others:
            if other not in reach(links, room):
                complain(readme, 1, f"{room} is said to stand on {other}, but doesn't link it")
    for cycle in cycles(links):
        complain(readme, 1, "links in a circle: " + " → ".join(cycle))


def check_tests(root, complain):
    for path in sorted((root / "tests").glob("*/*.cpp")):
        tests = re.search(r"^(TYPED_)?TEST(_F|_P)?\(", path.read_text(encoding="utf-8"), re.MULTILINE) is not None
        if tests != path.name.endswith("_test.cpp"):
            complain(path, 1, "has tests and isn't called NAME_test.cpp" if tests else "is called a test and has none")


def check(root, links_file):
    """All that is wrong, a line each."""
    root = root.resolve()
    problems = []

    def complain(path, number, what):
        problems.append(f"{path.relative_to(root)}:{number}: {what}")

    house = House(root / LIST, complain)
    if not house.below:
        return problems
    links = links_of(links_file)
    check_folders(root, house, complain)
    check_links(root, house, links, complain)
    check_includes(Tree(root), house, links, complain)
    check_tests(root, complain)
    return problems


if __name__ == "__main__":
    arguments = [pathlib.Path(a) for a in sys.argv[1:]]
    if len(arguments) != 2 or not (arguments[0] / LIST).is_file() or not arguments[1].is_file():
        print(f"rooms.py: {' '.join(sys.argv[1:]) or 'nothing'}: not a checkout with docs/explanation/rooms.md and CMake's list of links; usage: "
              "rooms.py ROOT LINKS", file=sys.stderr)
        sys.exit(2)
    found = check(*arguments)
    print("\n".join(found) if found else "Arrows point only downward; tests have their names.")
    sys.exit(1 if found else 0)
