# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""What scripts/soak.py makes of an hour, by made-up ones in which all else is in order."""
import contextlib
import io
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import soak  # noqa: E402

BEGIN, HOUR = 1000.0, 3600.0
NAMES = ("emulate", "run", "batch")


class MadeUp:
    """A program that lived and used as much all the time."""

    def __init__(self, name):
        self.name, self.samples, self.code = name, [(at, 50.0, 10, 4) for at in range(100)], None

    def ended(self):
        return self.code

    def said(self):
        return "a" * 64 if self.name == "batch" else ""


def verdicts(exchanges):
    """Of an hour with these (seconds since its begin, µs or None): those that are broken."""
    hour = soak.Soak(pathlib.Path("build"), pathlib.Path("out"), 1, BEGIN + HOUR)
    hour.begin, hour.digests = BEGIN, {"equal"}
    hour.trips = [(BEGIN + at, trip) for at, trip in exchanges]
    idle = {name: (50.0, 10, 4) for name in NAMES}
    found = soak.verdicts(hour, [MadeUp(name) for name in NAMES], [idle, idle], dict.fromkeys(NAMES, 0), BEGIN + HOUR)
    return {what: figure for what, held, figure in found if not held}


def seconds(start=0, end=3600):
    return range(start, end)


class Answers(unittest.TestCase):
    def assert_silence_is_noticed(self, exchanges, figure):
        broken = verdicts(exchanges)
        self.assertEqual(list(broken.values()), [figure])
        self.assertIn("units answer", *broken)

    def test_an_hour_in_which_all_is_answered_holds(self):
        self.assertEqual(verdicts((at, 300.0) for at in seconds()), {})

    def test_answers_that_lost_bytes_took_are_none_to_miss(self):
        self.assertEqual(verdicts((at, None if at % 20 == 0 else 300.0) for at in seconds()), {})

    def test_units_that_never_answer_are_noticed(self):
        self.assert_silence_is_noticed(((at, None) for at in seconds()), ", ".join(["0.0 % of 900"] * 4))

    def test_units_that_fall_silent_after_half_of_the_time_are_noticed(self):
        # An exchange without an answer takes longer, so there are fewer: a quarter is one of the time.
        exchanges = [(at, 300.0) for at in seconds(0, 1800)] + [(at, None) for at in seconds(1800) if at % 10 == 0]
        self.assert_silence_is_noticed(exchanges, "100.0 % of 900, 100.0 % of 900, 0.0 % of 90, 0.0 % of 90")

    def test_a_port_that_nobody_asks_any_more_is_noticed(self):
        self.assert_silence_is_noticed(((at, 300.0) for at in seconds(0, 2700)), "100.0 % of 900, 100.0 % of 900, 100.0 % of 900, no exchange")

    def test_an_hour_without_visits_is_noticed(self):
        self.assert_silence_is_noticed([], ", ".join(["no exchange"] * 4))

    def test_clients_that_are_through_after_the_end_are_of_the_last_quarter(self):
        self.assertEqual(verdicts((at, 300.0) for at in seconds(0, 3660)), {})

    def test_answers_that_take_longer_are_still_noticed(self):
        broken = verdicts((at, 300.0 if at < 1800 else 900.0) for at in seconds())
        self.assertEqual(list(broken.values()), ["300 → 900 µs"])


class Gazebo(unittest.TestCase):
    """Its server keeps a socket of each client that published, and nothing else of them."""

    def broken(self, descriptors, threads):
        hour = soak.Soak(pathlib.Path("build"), pathlib.Path("out"), 1, BEGIN + HOUR)
        hour.begin, hour.digests, hour.trips = BEGIN, {"equal"}, [(BEGIN + at, 300.0) for at in seconds()]
        hour.counts[soak.OF_GAZEBO], hour.counts[soak.MODULES] = 100, 30
        names = (*NAMES, "gazebo")
        before, after = ({name: (50.0, 10, 4) for name in names} for _ in range(2))
        after["gazebo"] = (50.0, descriptors, threads)
        found = soak.verdicts(hour, [MadeUp(name) for name in names], [before, after], dict.fromkeys(names, 0), BEGIN + HOUR)
        return [figure for _, held, figure in found if not held]

    def test_a_socket_a_client_and_one_a_module_are_allowed_for(self):
        self.assertEqual(self.broken(140, 4), [])

    def test_more_of_them_and_threads_of_modules_that_have_gone_are_noticed(self):
        self.assertEqual(self.broken(146, 6), ["10 → 146", "4 → 6"])


class SoFar(unittest.TestCase):
    """What is left every few minutes, while the visitors are there."""

    def left(self, programs):
        hour = soak.Soak(pathlib.Path("build"), pathlib.Path("out"), 1, BEGIN + HOUR)
        hour.begin, hour.digests, hour.trips = BEGIN, {"equal"}, [(BEGIN + at, 300.0) for at in seconds(0, 1200)]
        hour.gazebo.missing = None
        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch("time.monotonic", lambda: BEGIN + 1200):
            with unittest.mock.patch("soak.soak_page.chart", lambda *_: ""):
                soak.leave_so_far(hour, programs, [{p.name: (50.0, 10, 4) for p in programs}], BEGIN, pathlib.Path(folder))
            page = (pathlib.Path(folder) / "soak.html").read_text(encoding="utf-8")
            numbers = json.loads((pathlib.Path(folder) / "soak.json").read_text(encoding="utf-8"))
        self.assertIn("0.33 hours", page)
        self.assertEqual(page.count("<tr"), len(numbers["verdicts"]))
        return numbers

    def test_a_third_of_an_hour_in_which_all_is_well_holds(self):
        numbers = self.left([MadeUp(name) for name in NAMES])
        self.assertEqual([figure for _, held, figure in numbers["verdicts"] if not held], [])
        self.assertIn("100.0 % of 300, 100.0 % of 300, 100.0 % of 300, 100.0 % of 300", [figure for *_, figure in numbers["verdicts"]])
        self.assertEqual(len(numbers["samples"]["run"]), 100)

    def test_a_program_that_has_ended_is_noticed(self):
        programs = [MadeUp(name) for name in NAMES]
        programs[1].code = -6
        self.assertEqual([figure for _, held, figure in self.left(programs)["verdicts"] if not held], ["exit code -6"])


class Writing(unittest.TestCase):
    def test_verdicts_are_told_where_nothing_can_be_written(self):
        hour = soak.Soak(pathlib.Path("build"), pathlib.Path("out"), 1, BEGIN + HOUR)
        hour.gazebo.missing = "not here"
        said = io.StringIO()
        with tempfile.NamedTemporaryFile() as no_folder, contextlib.redirect_stdout(said), self.assertRaises(OSError):
            soak.told(hour, [], [["all is well", True, "1"], ["nothing is", False, "2"]], 1.0, pathlib.Path(no_folder.name))
        self.assertEqual(said.getvalue(), "holds   all is well: 1\nBROKEN  nothing is: 2\nleft out: Gazebo Classic: not here\n")

    def test_a_file_in_the_place_of_the_folder_is_refused_at_once(self):
        with tempfile.TemporaryDirectory() as folder:
            tree, out = pathlib.Path(folder), pathlib.Path(folder) / "out"
            (tree / "bin").mkdir()
            (tree / "bin/vsa").touch()
            (tree / "matplotlib.py").touch()  # asked for first
            out.touch()
            done = subprocess.run([sys.executable, soak.__file__, folder, "1", str(out)], capture_output=True, text=True, check=False,
                                  env={"PYTHONPATH": folder, "PYTHONDONTWRITEBYTECODE": "1"})
            self.assertEqual((done.returncode, done.stderr), (2, f"soak.py: OUT = {out}: is a file (allowed: a folder, or a name for one)\n"))
            done = subprocess.run([sys.executable, soak.__file__, folder, "1", str(out / "below")], capture_output=True, text=True, check=False,
                                  env={"PYTHONPATH": folder, "PYTHONDONTWRITEBYTECODE": "1"})
            self.assertEqual((done.returncode, done.stderr), (2, f"soak.py: {out / 'below'}: Not a directory\n"))


if __name__ == "__main__":
    unittest.main()
