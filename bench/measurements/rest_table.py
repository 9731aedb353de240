#!/usr/bin/env python3
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""The tables of what is left alone in docs/explanation/7-host.md, from what test_rest_long printed, written between their markers.

usage: build/release/bin/test_rest_long >LOG; python3 bench/measurements/rest_table.py LOG
"""

import dataclasses
import datetime
import pathlib
import re
import sys

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/explanation/7-host.md"
IN_FULL = ("qbmove_maker_pro", "qbmove_maker_pro_6_1", "qbmove_maker_pro_paper", "qbmove_maker_pro_datasheet", "qbmove_advanced",
           "sea_example")
KINDS = (("chains", "at zero"), ("chains", "aside"), ("light", "at zero"), ("light", "aside"))
TITLE = re.compile(r"(\w+), (chains of|three links)")
ROW = re.compile(r"(at zero|aside) +\S+ ms +(\d+) \| +(\d+) +(\S+) +(\S+) % \| +(\d+) +(\S+) +\S+ % +(\S+) +\d+ \| +(\S+)$")


@dataclasses.dataclass
class Sum:
    """Over the steps of one kind of chain: counts, and the largest of the rest."""

    cases: int = 0
    quiet: int = 0
    quiet_rms: float = 0
    scatter: float = 0
    busy_rms: float = 0
    ratio: float = 0
    coupling: float = 0

    def add(self, other: "Sum") -> None:
        self.cases += other.cases
        self.quiet += other.quiet
        for name in ("quiet_rms", "scatter", "busy_rms", "ratio"):
            setattr(self, name, max(getattr(self, name), getattr(other, name)))
        self.coupling = min(self.coupling, other.coupling)

    def worst(self) -> str:
        power = f"{self.coupling:.0e}".replace("e-0", "e-").replace("-", "−")
        return f"{self.busy_rms:.2f} | {self.ratio:.1f} | {power if self.coupling < -1e-9 else '0'}"


def read(log: str) -> dict:
    """By type: its sums by kind."""
    found, now = {}, None
    for line in log.splitlines():
        if title := TITLE.match(line):
            now = found.setdefault(title[1], {}), "chains" if title[2] == "chains of" else "light"
        elif (row := ROW.match(line)) and now:
            v = [float(x) for x in row.groups()[1:]]
            now[0].setdefault((now[1], row[1]), Sum()).add(Sum(int(v[0]), int(v[1]), v[2], v[3], v[5], v[6], v[7]))
    return found


def tables(found: dict) -> dict:
    """By marker: its table's lines."""
    full = ["| type | | cases | quiet | their rms, rad/s | scatter | busy: rms, rad/s | times that of short steps | `coupling` over moved |",
            "|---|---|---|---|---|---|---|---|---|"]
    rest = ["| type | chains, at zero | chains, aside | light, at zero | light, aside | busy: rms, rad/s | times that of short steps | "
            "`coupling` over moved |", "|---|---|---|---|---|---|---|---|"]
    for name in IN_FULL:
        for kind in KINDS:
            s = found[name][kind]
            full.append(f"| `{name}` | {kind[0]}, {kind[1]} | {s.cases} | {s.quiet} | {s.quiet_rms:.3f} | {s.scatter:.2f} % | {s.worst()} |")
    for name in sorted(set(found) - set(IN_FULL)):
        every = Sum()
        for s in found[name].values():
            every.add(s)
        quiet = " | ".join(f"{found[name][kind].quiet} of {found[name][kind].cases}" for kind in KINDS)
        rest.append(f"| `{name}` | {quiet} | {every.worst()} |")
    date = f"`build/release/bin/test_rest_long`, {datetime.date.today()}:"
    return {"qbmoves": [date, "", *full], "others": [date, "", *rest]}


def main() -> int:
    if len(sys.argv) != 2 or not pathlib.Path(sys.argv[1]).is_file():
        print(__doc__.strip(), file=sys.stderr)
        return 2
    found = read(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    missing = [name for name in {*IN_FULL, *found} if set(found.get(name, {})) != set(KINDS)]
    if missing or not set(found) - set(IN_FULL):
        sys.exit(f"rest_table.py: {sys.argv[1]}: a whole run's output has all kinds of chains of every type; not so of: "
                 f"{', '.join(sorted(missing)) or 'types other than the qbmoves'}")
    text = PAGE.read_text(encoding="utf-8")
    for name, lines in tables(found).items():
        first, last = f"<!-- rest_table.py: {name} -->", f"<!-- rest_table.py: end of {name} -->"
        if text.count(first) != 1 or text.count(last) != 1:
            sys.exit(f"rest_table.py: {PAGE.name}: needs each of the markers once: {first}, {last}")
        before, rest = text.split(first)
        text = before + first + "\n\n" + "\n".join(lines) + "\n\n" + last + rest.split(last)[1]
    PAGE.write_text(text, encoding="utf-8")
    print(f"written: docs/explanation/{PAGE.name}, {len(found)} types")
    return 0


if __name__ == "__main__":
    sys.exit(main())
