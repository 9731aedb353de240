# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Actuator types, units alone, studies and identification."""
import collections
import gc
import math
import pathlib
import tempfile
import types
import unittest

import numpy as np
import vsasim
from support import SOURCE, Interrupting, vsa

RECORDINGS = SOURCE / "data" / "qbmove_maker_pro"


class Types(unittest.TestCase):
    def test_the_types_are_those_that_the_command_lists(self):
        listed = vsa("actuators").stdout
        self.assertGreater(len(vsasim.ActuatorType.list()), 3)
        for name in vsasim.ActuatorType.list():
            self.assertIn(name, listed)

    def test_a_parameter_is_read_with_unit_bounds_and_source(self):
        kind = vsasim.ActuatorType.load("qbmove_maker_pro")
        entry = kind.entry("drive.friction_Nm")
        self.assertEqual(entry["value"], kind["drive.friction_Nm"])
        self.assertEqual(entry["unit"], "N·m")
        self.assertLess(entry["min"], entry["value"])
        self.assertLess(entry["value"], entry["max"])
        self.assertTrue(entry["source"])
        self.assertEqual(len(kind.keys()), len(set(kind.keys())))

    def test_words_switches_and_numbers_have_their_own_types(self):
        kind = vsasim.ActuatorType.load("qbmove_maker_pro_6_1")
        types = {type(kind[key]) for key in kind.keys()}
        self.assertEqual(types, {float, int, bool, str})

    def test_what_is_set_reads_back_and_reaches_a_world(self):
        kind = vsasim.ActuatorType.load("qbmove_maker_pro")
        kind.set("drive.friction_Nm", 0.31)
        kind["shaft.friction_Nm"] = 0.02
        self.assertEqual((kind["drive.friction_Nm"], kind["shaft.friction_Nm"]), (0.31, 0.02))
        self.assertEqual(kind.overrides, {"drive.friction_Nm": "0.31", "shaft.friction_Nm": "0.02"})
        worlds = [vsasim.World.load("bench_free", type="qbmove_maker_pro", set=s) for s in (None, kind.overrides)]
        for world in worlds:
            world.command_all(1.0, 0.2)
            world.run(0.2)
        self.assertNotEqual(*(w.joint_angles()[0] for w in worlds))

    def test_a_wrong_value_has_the_commands_words_and_changes_nothing(self):
        kind = vsasim.ActuatorType.load("qbmove_maker_pro")
        before = kind["drive.friction_Nm"]
        with self.assertRaises(vsasim.InputError) as caught:
            kind.update({"shaft.friction_Nm": 0.02, "drive.friction_Nm": -1})
        told = vsa("characterize", "qbmove_maker_pro", "--set", "shaft.friction_Nm=0.02", "--set", "drive.friction_Nm=-1")
        self.assertEqual(told.returncode, 2)
        self.assertIn(str(caught.exception).splitlines()[0].strip(), told.stderr)
        self.assertEqual((kind["drive.friction_Nm"], kind.overrides), (before, {}))
        with self.assertRaisesRegex(TypeError, "drive.friction_Nm"):
            kind["drive.friction_Nm"] = [1]
        with self.assertRaisesRegex(vsasim.InputError, "no such parameter"):
            kind.get("drive.nothing")
        with self.assertRaisesRegex(vsasim.InputError, "qbmove_maker_pro"):
            vsasim.ActuatorType.load("nothing")

    def test_any_mapping_of_parameters_will_do(self):
        given = types.MappingProxyType({"drive.friction_Nm": 0.31})
        told = {"drive.friction_Nm": "0.31"}
        self.assertEqual(vsasim.ActuatorType.load("qbmove_maker_pro", given).overrides, told)
        kind = vsasim.ActuatorType.load("qbmove_maker_pro")
        kind.update(collections.ChainMap(given))
        self.assertEqual(kind.overrides, told)
        vsasim.World.load("bench_free", set=given)
        with self.assertRaisesRegex(vsasim.InputError, "drive.friction_Nm = .-1"):
            vsasim.study.characterize("qbmove_maker_pro", set=types.MappingProxyType({"drive.friction_Nm": -1}))
        for wrong in ([("drive.friction_Nm", 0.31)], "drive.friction_Nm=0.31", None):
            with self.assertRaisesRegex(TypeError, r"values: .*\(allowed: a dict\)"):
                kind.update(wrong)

    def test_the_law_takes_real_numbers_only(self):
        kind = vsasim.ActuatorType.load("qbmove_maker_pro_paper")
        for law in (kind.torque_Nm, kind.stiffness_Nm_per_rad, kind.energy_J):
            for wrong in (None, "0.3", True, [None], 1j, [[0.1], [0.1, 0.2]]):
                with self.subTest(law=law, wrong=wrong), self.assertRaisesRegex(TypeError, "shaft_rad: .*real numbers"):
                    law(wrong)
            with self.assertRaisesRegex(TypeError, "equilibrium_rad"):
                law(0.1, None)
            with self.assertRaisesRegex(TypeError, "preset"):
                law(0.1, 0.0, "0.3")
            self.assertEqual(law(np.int8(0)), law(0.0))

    def test_the_laws_torque_and_stiffness_are_the_energys_derivatives(self):
        kind = vsasim.ActuatorType.load("qbmove_maker_pro_paper")
        q, h = np.linspace(-0.4, 0.4, 9), 1e-5
        for preset in (0.0, 0.3):
            slope = (kind.energy_J(q + h, 0.1, preset) - kind.energy_J(q - h, 0.1, preset)) / (2 * h)
            np.testing.assert_allclose(kind.torque_Nm(q, 0.1, preset), -slope, rtol=1e-6, atol=1e-8)
            bend = (kind.torque_Nm(q + h, 0.1, preset) - kind.torque_Nm(q - h, 0.1, preset)) / (2 * h)
            np.testing.assert_allclose(kind.stiffness_Nm_per_rad(q, 0.1, preset), -bend, rtol=1e-6)
        self.assertEqual(kind.torque_Nm(q[:, None], 0.0, [0.1, 0.2]).shape, (9, 2))
        self.assertIsInstance(kind.torque_Nm(0.1), float)

    def test_a_command_is_found_for_torque_and_stiffness_and_back(self):
        kind = vsasim.ActuatorType.load("qbmove_maker_pro_paper")
        equilibrium, preset = kind.command_for(0.2, -0.3, 5.0)
        self.assertAlmostEqual(kind.torque_Nm(0.2, equilibrium, preset), -0.3, places=7)
        self.assertAlmostEqual(kind.stiffness_Nm_per_rad(0.2, equilibrium, preset), 5.0, places=6)
        self.assertAlmostEqual(kind.equilibrium_for(0.2, -0.3, preset), equilibrium, places=7)
        np.testing.assert_allclose(kind.attained(kind.references(0.4, 0.2)), (0.4, 0.2), atol=1e-12)
        with self.assertRaisesRegex(vsasim.InputError, "stiffer than the actuator can be"):
            kind.command_for(0.0, 0.0, 1e4)
        self.assertIsNone(kind.equilibrium_for(0.0, 1e30))


class Alone(unittest.TestCase):
    KIND = vsasim.ActuatorType.load("qbmove_maker_pro_paper")

    def test_a_unit_on_an_inertia_follows_its_command(self):
        unit, q, v, inertia, dt = vsasim.Unit(self.KIND, preset=0.3), 0.0, 0.0, 1e-3, 1e-3
        unit.command(0.8, 0.3)
        for _ in range(1500):
            v += dt * unit.step(dt, q, v, 1 / inertia) / inertia
            q += dt * v
        self.assertAlmostEqual(q, 0.8, delta=0.1)
        now = unit.readings()
        self.assertAlmostEqual(now["preset"], 0.3, delta=0.05)
        self.assertAlmostEqual(now["measured_ticks"][2] * 2 * math.pi / 32768, q, delta=5e-3)
        self.assertEqual(round(unit.time_s, 9), 1.5)
        self.assertGreater(unit.ledger()["supply_J"], 0)

    def test_following_a_motion_is_the_same_as_its_steps(self):
        one, other = vsasim.Unit(self.KIND), vsasim.Unit(self.KIND)
        shaft = 0.2 * np.sin(np.arange(200) * 0.02)
        together = one.follow(1e-3, shaft, 0.0)
        np.testing.assert_array_equal(together, [other.step(1e-3, q) for q in shaft])
        self.assertGreater(np.abs(together).max(), 0.05)

    def test_a_units_snapshot_goes_on_bit_by_bit_and_anothers_is_refused(self):
        unit = vsasim.Unit(self.KIND)
        unit.command(0.5, 0.2)
        unit.follow(1e-3, np.zeros(100))
        then = unit.snapshot()
        first = unit.follow(1e-3, np.full(50, 0.1))
        unit.restore(then)
        self.assertEqual(round(unit.time_s, 9), 0.1)
        np.testing.assert_array_equal(unit.follow(1e-3, np.full(50, 0.1)), first)
        with self.assertRaisesRegex(vsasim.InputError, "other parameters"):
            vsasim.Unit(vsasim.ActuatorType.load("qbmove_maker_pro")).restore(then)

    def test_a_units_state_as_numbers_goes_on_bit_by_bit_in_another(self):
        unit, other = vsasim.Unit(self.KIND), vsasim.Unit(self.KIND, 0.3)
        unit.command(0.5, 0.2)
        unit.follow(1e-3, np.zeros(100))
        then = unit.state()
        first = unit.follow(1e-3, np.full(50, 0.1))
        other.restore_state(then)
        self.assertEqual(round(other.time_s, 9), 0.1)
        np.testing.assert_array_equal(other.follow(1e-3, np.full(50, 0.1)), first)
        given = np.empty_like(then)
        self.assertIs(other.state(out=given), given)
        self.assertEqual(given.tobytes(), unit.state().tobytes())

    def test_a_units_layout_names_every_number(self):
        at, unit = 0, vsasim.Unit(self.KIND)
        for entry in unit.state_layout:
            self.assertEqual(set(entry), {"name", "unit", "kind", "offset", "count"})
            self.assertEqual(entry["offset"], at)
            at += entry["count"]
        self.assertEqual(unit.state().shape, (at,))
        self.assertEqual(vsasim.Unit.state_layout, unit.state_layout)
        names = {e["name"]: e for e in unit.state_layout}
        self.assertEqual((names["time"]["unit"], names["time"]["offset"]), ("ns", 0))
        unit.step(1e-3, 0.0)
        np.testing.assert_array_equal(unit.state()[:2], [0, 1_000_000])
        self.assertTrue(any(name.startswith("unit.") for name in names))

    def test_numbers_that_are_no_state_of_a_unit_change_nothing(self):
        unit = vsasim.Unit(self.KIND)
        unit.follow(1e-3, np.zeros(10))
        then = unit.state()
        early, infinite = then.copy(), then.copy()
        early[0], infinite[2:] = -1, np.inf
        for wrong, error, text in (
            (then[:-1], vsasim.InputError, "shape"),
            (then.astype(np.float32), TypeError, "float32"),
            (early, vsasim.InputError, "time"),
            (infinite, vsasim.InputError, "inf"),
        ):
            with self.assertRaisesRegex(error, text):
                unit.restore_state(wrong)
            self.assertEqual(unit.state().tobytes(), then.tobytes())

    def test_a_unit_that_is_just_switched_on_gives_no_current(self):
        unit = vsasim.Unit(self.KIND, 0.5, powered=False)
        unit.follow(1e-3, np.zeros(50))
        np.testing.assert_array_equal(unit.readings()["current_A"], [0, 0])

    def test_numbers_out_of_range_are_refused_by_name(self):
        unit = vsasim.Unit(self.KIND)
        for wrong, name in (
            (lambda: unit.step(0.1, 0.0), "dt_s"),
            (lambda: unit.step(0.0, 0.0), "dt_s"),
            (lambda: unit.step(1e-3, math.nan), "shaft_rad"),
            (lambda: unit.step(1e-3, 0.0, math.inf), "shaft_speed_rad_per_s"),
            (lambda: unit.step(1e-3, 0.0, 0.0, -1.0), "inverse_inertia"),
            (lambda: unit.command(math.nan), "equilibrium_rad"),
            (lambda: unit.set_inputs((40000, 0)), "ticks"),
            (lambda: unit.follow(1e-3, [0.0, math.nan]), r"shaft_rad\[1\]"),
            (lambda: unit.follow(1e-3, [0.0, 1e9]), "shaft_rad"),
            (lambda: unit.follow(1e-3, [0.0, 0.0], 1e300), "shaft_speed_rad_per_s"),
            (lambda: unit.follow(1e-3, [0.0, 0.1], [0.0]), "shaft_speed_rad_per_s"),
            (lambda: vsasim.Unit(self.KIND, math.nan), "equilibrium_rad"),
        ):
            with self.assertRaisesRegex(vsasim.InputError, name):
                wrong()
        self.assertEqual(unit.time_s, 0)


class Studies(unittest.TestCase):
    OPTIONS = {"experiments": ["speed"], "presets": [0.3], "threads": 1}

    def test_a_characterization_has_the_measures_and_samples_that_outlive_it(self):
        told = []
        done = vsasim.study.characterize("qbmove_maker_pro", progress=lambda *p: told.append(p), **self.OPTIONS)
        speed = done["speed"][0]
        self.assertEqual(speed["preset_rad"], 0.3)
        self.assertGreater(speed["mean"]["shaft"]["mean_speed_rad_per_s"], 1.0)
        samples = speed["samples"]
        shaft, time = samples["shaft_rad"], samples["time_s"]
        self.assertGreater(len(shaft), 1000)
        self.assertFalse(samples.flags.writeable)
        self.assertFalse(shaft.flags.owndata)
        kept = shaft.copy()
        del done, speed, samples
        gc.collect()
        np.testing.assert_array_equal(shaft, kept)
        self.assertTrue(np.all(np.diff(time) > 0))
        self.assertTrue(told and told[0][1] > 0)

    def test_progress_that_says_no_ends_it(self):
        self.assertIsNone(vsasim.study.characterize("qbmove_maker_pro", progress=lambda *_: False, **self.OPTIONS))

    def test_what_progress_raises_comes_out(self):
        def broken(*_):
            raise LookupError("mine")

        with self.assertRaisesRegex(LookupError, "mine"):
            vsasim.study.characterize("qbmove_maker_pro", progress=broken, **self.OPTIONS)

    def test_ctrl_c_ends_a_study(self):
        with self.assertRaises(KeyboardInterrupt):
            with Interrupting(lambda: True):
                vsasim.study.characterize("qbmove_maker_pro", experiments=["stiffness"], cycles=1000, threads=1)

    def test_wrong_options_are_told_at_once(self):
        with self.assertRaises(vsasim.InputError) as caught:
            vsasim.study.characterize("qbmove_maker_pro", experiments=["stiffness"], presets=[9.0], period_s=-1.0)
        self.assertGreaterEqual(len(caught.exception.problems), 2)
        with self.assertRaisesRegex(vsasim.InputError, "preset-step"):
            vsasim.study.characterize("qbmove_maker_pro", experiments=["strength"])
        for wrong, text in (
            ({"cycles": 0}, "^cycles = 0: "),
            ({"presets": [9.0]}, "^presets = 9: "),
            ({"experiments": ["speed"], "period_s": 20.0}, "^period_s: .*allowed: experiments stiffness"),
        ):
            with self.assertRaisesRegex(vsasim.InputError, text):
                vsasim.study.characterize("qbmove_maker_pro", **wrong)
        for threads, error in ((-1, vsasim.InputError), (2**70, vsasim.InputError), (0.5, TypeError)):
            with self.assertRaisesRegex(error, "threads"):
                vsasim.study.characterize("qbmove_maker_pro", threads=threads)


class Identification(unittest.TestCase):
    FILES = [str(RECORDINGS / "stiffness_preset_0.0000rad_branches.csv"), str(RECORDINGS / "stiffness_preset_0.6903rad_branches.csv")]
    QUICK = {"model": "quasi-static", "starts": 1, "global_search": False, "iterations": 5, "threads": 1}

    def test_a_recording_is_read_with_its_preset_and_branches(self):
        read = vsasim.identify.read_recording(self.FILES[1], "qbmove_maker_pro")
        self.assertEqual(read["preset"], 0.6903)
        self.assertEqual(read["branches"]["torque_Nm"].shape, read["branches"]["falling_rad"].shape)

    def test_samples_are_read_on_the_grid_of_the_load_that_they_were_taken_with(self):
        time = np.arange(0, 76.0, 0.02)
        torque = 50 * np.sin(2 * np.pi * time / 38)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "stiffness_preset_0.3000rad_samples.csv"
            rows = "".join(f"{t},{x},{x / 100}\n" for t, x in zip(time, torque))
            file.write_text("time_s,load_torque_Nm,deflection_rad\n" + rows, encoding="utf-8")
            read = vsasim.identify.read_recording(str(file), "qbmove_maker_pro", load_kg=36.0)
            self.assertGreater(np.nanmax(read["branches"]["torque_Nm"]), 40)
            for load_kg, text in ((1.0, "load_torque_Nm"), (0.0, "load_kg"), (math.nan, "load_kg")):
                with self.assertRaisesRegex(vsasim.InputError, text):
                    vsasim.identify.read_recording(str(file), "qbmove_maker_pro", load_kg=load_kg)

    def test_a_fit_is_nearer_to_the_recordings_than_its_start(self):
        parameters = "elastic.k1_Nm=elastic.k2_Nm,shaft.friction_Nm"
        done = vsasim.identify.fit(self.FILES[1:], "qbmove_maker_pro_paper", parameters, **self.QUICK)
        self.assertEqual(list(done["parameters"]), parameters.split(","))
        before, after = done["misfits_before"], done["misfits"]
        self.assertEqual([m["preset"] for m in before], [0.6903])
        self.assertLess(after[0]["rms_rad"], 0.9 * before[0]["rms_rad"])
        self.assertAlmostEqual(after[0]["rms_rad"], np.sqrt(np.mean(done["residuals_rad"] ** 2)), places=9)
        for p in done["parameters"].values():
            self.assertTrue(p["min"] <= p["value"] <= p["max"])
        self.assertEqual(done["correlation"].shape, (2, 2))
        kind = vsasim.ActuatorType.load("qbmove_maker_pro_paper", done["set"])
        self.assertEqual(kind["elastic.k1_Nm"], kind["elastic.k2_Nm"])

    def test_the_law_takes_finite_numbers_that_broadcast(self):
        kind = vsasim.ActuatorType.load("qbmove_maker_pro")
        for call, text in (
            (lambda: kind.torque_Nm([1, 2], [1, 2, 3]), "don't broadcast"),
            (lambda: kind.stiffness_Nm_per_rad(math.inf), "shaft_rad"),
            (lambda: kind.energy_J([0.1, math.nan]), "shaft_rad"),
            (lambda: kind.references(math.nan, 0), "equilibrium_rad"),
            (lambda: kind.equilibrium_for(0, math.nan), "torque_Nm"),
        ):
            with self.assertRaisesRegex(vsasim.InputError, text):
                call()
        self.assertEqual(kind.torque_Nm([[0.1], [0.2]], [0.0, 0.1, 0.2]).shape, (2, 3))

    def test_wrong_parameters_files_and_words_are_refused(self):
        for change, text in (
            ({"parameters": "elastic.nothing"}, "^parameters: elastic.nothing"),
            ({"recordings": []}, "recordings"),
            ({"recordings": ["/nowhere/preset_0.1rad.csv"]}, "/nowhere"),
            ({"model": "guess"}, "model.*bench"),
            ({"weights": "none"}, "weights"),
            ({"amplitude_rad": math.nan}, "amplitude_rad"),
            ({"amplitude_rad": -1.0, "model": "quasi-static"}, "amplitude_rad"),
            ({"amplitude_rad": 1e9, "model": "quasi-static"}, "amplitude_rad"),
            ({"seed": -1}, "seed = -1"),
            ({"seed": 2**32}, "seed"),
            ({"threads": -1}, "threads = -1"),
        ):
            arguments = {"recordings": self.FILES, "type": "qbmove_maker_pro_paper", "parameters": "shaft.friction_Nm"}
            with self.assertRaisesRegex(vsasim.InputError, text):
                vsasim.identify.fit(**{**arguments, **self.QUICK, **change})

    def test_ctrl_c_ends_a_fit(self):
        with self.assertRaises(KeyboardInterrupt):
            with Interrupting(lambda: True):
                vsasim.identify.fit(self.FILES, "qbmove_maker_pro_paper", "shaft.friction_Nm,drive.friction_Nm")


if __name__ == "__main__":
    unittest.main()
