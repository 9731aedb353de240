#!/usr/bin/env python3
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""The table of docs/explanation/what-stiffness-is-good-for.md, section 4: by gait, ground and preset the way's median with its interval,
the energy a metre, and from how many of the starts each preset goes farther than each other one.

usage: python3 bench/measurements/snake_terrain.py RESULTS.csv      of vsa sweep examples/sweep/snake_terrain.toml
"""

import collections
import csv
import pathlib
import random
import statistics
import sys

DRAWS = 2000


def interval(values: list[float], seed: int) -> tuple[float, float]:
    """95 % of the median, by the bootstrap."""
    chance = random.Random(seed)
    medians = sorted(statistics.median(chance.choices(values, k=len(values))) for _ in range(DRAWS))
    return medians[round(0.025 * DRAWS)], medians[round(0.975 * DRAWS)]


def main() -> int:
    if len(sys.argv) != 2:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    try:
        rows = list(csv.DictReader(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8").splitlines()))
        missing = {"gait", "ground", "preset_deg", "repetition", "net_m", "supply_J", "error"} - set(rows[0] if rows else ())
    except (OSError, UnicodeDecodeError) as error:
        print(f"snake_terrain.py: {sys.argv[1]}: {error}", file=sys.stderr)
        return 2
    if missing:
        print(f"snake_terrain.py: {sys.argv[1]}: no column {', '.join(sorted(missing))}: not that plan's table", file=sys.stderr)
        return 2
    way = collections.defaultdict(dict)  # (gait, ground) → (preset) → repetition → m
    cost = collections.defaultdict(list)
    for row in rows:
        if row["error"] or not row["net_m"]:
            continue
        place, preset = (row["gait"], row["ground"].removeprefix("snake_")), float(row["preset_deg"])
        way[place].setdefault(preset, {})[int(row["repetition"])] = float(row["net_m"])
        cost[(*place, preset)].append(float(row["supply_J"]) / float(row["net_m"]))
    for (gait, ground), presets in way.items():
        print(f"{gait}, {ground}")
        for preset, by_start in presets.items():
            values = list(by_start.values())
            low, high = interval(values, 1)
            others = []
            for other, theirs in presets.items():
                both = [s for s in by_start if s in theirs]
                if other != preset:
                    others.append(f"{other:g}°: {sum(by_start[s] > theirs[s] for s in both)}/{len(both)}")
            joules = statistics.median(cost[(gait, ground, preset)])
            print(f"  {preset:4g}° {len(values):3d} starts  {statistics.median(values):5.2f} [{low:.2f} … {high:.2f}] m "
                  f"{joules:6.0f} J/m   farther than {', '.join(others)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
