#!/usr/bin/env python3
# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""The cost tables of the manual, measured and written between their markers: processor time, medians of five, all in one run.

usage: python3 bench/measurements/cost_tables.py BIN      BIN: the build's bin/
"""

import datetime
import json
import pathlib
import subprocess
import sys

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs/explanation"
BENCHES = {"bench_actuator": "pair|actuator_step_1ms$|units_in_lanes|robot_step/1000$", "bench_snake": ".",
           "bench_device": "physics_1ms$|unit_1ms$|emulated_units|encode_and_decode"}


def measure(programs: pathlib.Path) -> dict:
    """By benchmark: its median as Google Benchmark tells it."""
    found = {}
    for name, which in BENCHES.items():
        command = [programs / name, f"--benchmark_filter={which}", "--benchmark_format=json", "--benchmark_repetitions=5",
                   "--benchmark_report_aggregates_only=true", "--benchmark_min_time=0.3"]
        for row in json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["benchmarks"]:
            if row["aggregate_name"] == "median":
                found[row["run_name"]] = row
    return found


def time_text(ns: float) -> str:
    return f"{ns:.3g} ns" if ns < 1000 else f"{ns / 1000:.3g} µs"


def tables(found: dict) -> dict:
    """By page: its table's lines."""
    ns = {name: row["cpu_time"] for name, row in found.items()}
    pair = ns["sinh_cosh_pair"]
    lanes = found["units_in_lanes/64"].get("label", "")

    def real(name: str) -> str:
        return f"{1e6 / ns[name]:.3g} × real time"

    def pairs(name: str, units: int) -> str:
        return f"{ns[name] / units / pair:.3g}"

    head = f"`python3 bench/measurements/cost_tables.py build/release/bin`, {datetime.date.today()}:\n"
    head += f"processor time, medians of 5, lanes by {lanes or 'the base'}."
    beside = [("units_in_lanes_any/64", "64 side by side, the processor's base (2 lanes)", 64),
              ("units_in_lanes_avx2/64", "64 side by side, AVX2 (4 lanes)", 64),
              ("units_in_lanes_avx512/64", "64 side by side, AVX-512 (8 lanes)", 64),
              ("units_in_lanes/4096", "4096 side by side, the widest", 4096)]
    share = ns["actuators_of_the_crawling_snake"] / ns["crawling"]
    return {
        "8-engine.md": [
            head, "", "| steps of 1 ms | time | ratio |", "|---|---|---|",
            f"| a bare `sinh` + `cosh` pair | {time_text(pair)} | 1 |",
            f"| one actuator: two motors, program tick, springs, sensors | {time_text(ns['actuator_step_1ms'])} | "
            f"{pairs('actuator_step_1ms', 1)} pairs |",
            f"| 1,000 actuators on 84 buses, in one thread | {time_text(ns['robot_step/1000'])} | {real('robot_step/1000')} |",
            f"| snake lying still on flat ground | {time_text(ns['still/with_actuators'])} | {real('still/with_actuators')} |",
            f"| the same without actuators | {time_text(ns['still/limp_without'])} | {real('still/limp_without')} |",
            f"| snake crawling | {time_text(ns['crawling'])} | {real('crawling')} |",
            f"| of that its 12 actuators with their bus | {time_text(ns['actuators_of_the_crawling_snake'])} | {share:.0%} |".replace(
                "%", " %"),
        ],
        "6-bus-and-device.md": [
            head, "", "| | |", "|---|---|",
            f"| a millisecond of a unit's physics (`physics_1ms`) | {time_text(ns['physics_1ms'])} |",
            f"| with sensors, program and bridge (`unit_1ms`) | {time_text(ns['unit_1ms'])} |",
            "| with its line, 12 units, each asked and told every 12 ms (`emulated_units/12`, per unit) | "
            f"{time_text(ns['emulated_units/12'] / 12)} |",
            "| 1008 emulated units on 84 lines, each line asked and told once a millisecond | "
            f"{real('emulated_units/1008')} |",
            "| request to bytes to request (`encode_and_decode_a_request`) | "
            f"{found['encode_and_decode_a_request']['bytes_per_second'] / 1e6:.3g} MB/s |",
        ],
        "5-actuator.md": [
            head, "", "| a step of 1 ms | `sinh` + `cosh` pairs per unit |", "|---|---|",
            f"| a unit alone | {pairs('actuator_step_1ms', 1)} |",
            *(f"| {text} | {pairs(name, units)} |" for name, text, units in beside if name in ns),
        ],
    }


def write(page: pathlib.Path, lines: list) -> None:
    first, last = "<!-- cost_tables.py: table -->", "<!-- cost_tables.py: end of table -->"
    text = page.read_text(encoding="utf-8")
    if text.count(first) != 1 or text.count(last) != 1:
        sys.exit(f"cost_tables.py: {page}: needs each of the markers once: {first}, {last}")
    before, rest = text.split(first)
    page.write_text(before + first + "\n\n" + "\n".join(lines) + "\n\n" + last + rest.split(last)[1], encoding="utf-8")


def main() -> int:
    if len(sys.argv) != 2 or not all(pathlib.Path(sys.argv[1], name).exists() for name in BENCHES):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    for page, lines in tables(measure(pathlib.Path(sys.argv[1]))).items():
        write(DOCS / page, lines)
        print(f"written: docs/explanation/{page}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
