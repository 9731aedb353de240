# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Units side by side, each beside a Unit alone."""
import gc
import unittest

import numpy as np
import vsasim


def maker_pro():
    return vsasim.ActuatorType.load("qbmove_maker_pro")


def alone(steps, q, p, inertia, damping, gravity, push):
    unit = vsasim.Unit(maker_pro())
    unit.command(q, p)
    angle = speed = 0.0
    for _ in range(steps):
        torque = unit.step(1e-3, angle, speed, 1 / inertia)
        scale = 1e-3 * (1 / inertia)
        pull = gravity * np.sin(angle) if gravity else 0.0
        speed = (speed + scale * (torque - pull + push)) / (1 + scale * damping)
        angle += 1e-3 * speed
    return angle, speed


class UnitBatch(unittest.TestCase):
    def test_each_goes_as_a_unit_alone_on_every_instruction_set(self):
        n = 11
        inertia, damping, gravity = np.geomspace(1e-4, 1e-2, n), np.linspace(0, 0.05, n), np.linspace(-0.2, 0.4, n)
        for instructions in vsasim.UnitBatch.instruction_sets():
            units = vsasim.UnitBatch(maker_pro(), n, inertia, damping, gravity, instructions)
            units.equilibrium = np.linspace(-0.5, 0.5, n)
            units.preset = 0.3
            units.push[4] = 0.2
            units.step(300)
            self.assertAlmostEqual(units.time_s, 0.3)
            for i in (0, 4, n - 1):
                angle, speed = alone(300, units.equilibrium[i], 0.3, inertia[i], damping[i], gravity[i], units.push[i])
                self.assertAlmostEqual(units.shaft_rad[i], angle, 9)
                self.assertAlmostEqual(units.shaft_speed_rad_per_s[i], speed, 7)

    def test_reset_takes_some_back_and_the_others_go_on(self):
        units = vsasim.UnitBatch(maker_pro(), 5)
        units.equilibrium, units.preset = 0.5, 0.2
        units.step(200)
        before = units.shaft_rad.copy()
        units.equilibrium[[1, 3]] = np.nan
        units.reset([1, 3], equilibrium_rad=[0.1, -0.1], preset=0.4)
        np.testing.assert_array_equal(units.shaft_rad, [before[0], 0.1, before[2], -0.1, before[4]])
        units.reset(np.array([True, False, False, False, False]), 0.2)
        self.assertEqual(units.shaft_rad[0], 0.2)
        for nobody in ([], np.zeros(5, bool)):
            units.reset(nobody, 0.7)
        np.testing.assert_array_equal(units.shaft_rad, [0.2, 0.1, before[2], -0.1, before[4]])
        units.step(50)
        self.assertLess(abs(units.shaft_rad[3] + 0.1), 0.01)

    def test_readings_are_those_of_units_that_go_on_from_its_states(self):
        units = vsasim.UnitBatch(maker_pro(), 5)
        units.equilibrium, units.preset = np.linspace(-0.5, 0.5, 5), 0.2
        units.step(37)
        now, given = units.read(), np.zeros(5, vsasim.UnitBatch.reading_dtype)
        self.assertIs(units.read(out=given), given)
        self.assertEqual(now.tobytes(), given.tobytes())
        self.assertEqual(now["current_A"].shape, (5, 2))
        self.assertGreater(np.abs(now["current_A"]).max(), 0.01)
        np.testing.assert_array_equal(now["mean_torque_Nm"], units.torque_Nm)
        self.assertEqual(units.state_layout, vsasim.Unit.state_layout)
        for i in (0, 3, 4):
            unit = vsasim.Unit(maker_pro())
            unit.restore_state(units.state(i))
            self.assertAlmostEqual(unit.time_s, 0.037)
            told = unit.readings()
            self.assertEqual(set(told), set(now.dtype.names))
            for name, value in told.items():
                np.testing.assert_array_equal(now[name][i], value, name)
        with self.assertRaisesRegex(IndexError, "unit 5"):
            units.state(5)

    def test_restored_units_go_on_bit_by_bit_and_their_neighbours_as_they_would(self):
        for instructions in vsasim.UnitBatch.instruction_sets():
            units = vsasim.UnitBatch(maker_pro(), 9, 2e-3, 0.01, 0.4, instructions)
            units.equilibrium, units.preset = np.linspace(-0.5, 0.5, 9), 0.2
            units.push[4] = 0.3
            units.step(150)
            at = [units.state(i) for i in range(9)]
            units.step(80)
            there = [units.state(i)[1:] for i in range(9)]
            for i in (0, 3, 4):
                units.restore(i, at[i])
            self.assertEqual(units.shaft_rad[3], units.read()["shaft_rad"][3])
            self.assertNotEqual(units.shaft_rad[3], there[3][0])
            neighbour = vsasim.UnitBatch(maker_pro(), 9, 2e-3, 0.01, 0.4, instructions)
            for i in range(9):
                neighbour.restore(i, units.state(i))
            neighbour.push[4] = 0.3
            units.step(80)
            neighbour.step(80)
            names = [(e["name"], e["offset"], e["count"]) for e in units.state_layout]
            clocks = {k for n, o, c in names if n in ("time", "unit.program.busy_until", "unit.program.watchdog.next_clock") for k in range(o, o + c)}
            rest = [k for k in range(len(at[0])) if k not in clocks]
            for i in (0, 3, 4):
                np.testing.assert_array_equal(units.state(i)[rest], np.concatenate([[0], there[i]])[rest], f"{instructions} {i}")
            for i in range(9):  # commanded by nobody, they keep what they had
                np.testing.assert_array_equal(neighbour.state(i)[rest], units.state(i)[rest], f"{instructions} {i}")

    def test_a_state_tells_where_the_lever_is(self):
        units = vsasim.UnitBatch(maker_pro(), 2, gravity_Nm=0.4, damping_Nms_per_rad=0.02)
        units.equilibrium = 0.6
        units.step(60)
        np.testing.assert_array_equal(units.read()["shaft_rad"], units.shaft_rad)
        np.testing.assert_array_equal(units.read()["shaft_speed_rad_per_s"], units.shaft_speed_rad_per_s)
        unit = vsasim.Unit(maker_pro())
        unit.restore_state(units.state(1))
        self.assertEqual(unit.readings()["shaft_rad"], units.shaft_rad[1])

    def test_states_that_are_none_are_refused_and_nothing_moves(self):
        units = vsasim.UnitBatch(maker_pro(), 3)
        units.equilibrium = 0.3
        units.step(20)
        at = units.state(1)
        nan, far = at.copy(), at.copy()
        nan[100] = np.nan
        offset = next(e["offset"] for e in units.state_layout if e["name"] == "unit.reached.angle")
        far[offset] = 1e7
        late = at.copy()
        late[next(e["offset"] for e in units.state_layout if e["name"] == "unit.program.busy_until")] = 2.0**31 - 1
        world = np.zeros(len(at) + 7)
        for bad in (at[:-1], np.append(at, 0.0), at.reshape(1, -1), nan, far, late, world, np.full_like(at, np.inf)):
            with self.assertRaises(vsasim.InputError):
                units.restore(1, bad)
        for bad in (at.astype(np.float32), "state", None, list(at) + ["x"]):
            with self.assertRaises(TypeError):
                units.restore(1, bad)
        for nobody in (3, -4):
            with self.assertRaises(IndexError):
                units.restore(nobody, at)
        np.testing.assert_array_equal(units.state(1), at)

    def test_one_command_after_a_restore_leaves_the_other(self):
        units = vsasim.UnitBatch(maker_pro(), 2)
        units.equilibrium, units.preset = 0.2, 0.4
        units.step(500)
        at = units.state(0)
        other = vsasim.UnitBatch(maker_pro(), 2)
        for i in (0, 1):
            other.restore(i, at)
        other.equilibrium = -0.2
        other.preset[1] = 0.4  # 0 keeps it
        other.step(800)
        kept, told = other.read()
        self.assertAlmostEqual(kept["equilibrium_rad"], told["equilibrium_rad"], delta=1e-3)
        self.assertAlmostEqual(kept["preset"], told["preset"], delta=1e-3)
        self.assertGreater(kept["preset"], 0.2)

    def test_views_outlive_the_batch(self):
        units = vsasim.UnitBatch(maker_pro(), 3)
        shaft = units.shaft_rad
        del units
        gc.collect()
        self.assertEqual(shaft.tolist(), [0, 0, 0])
        with self.assertRaises(ValueError):
            shaft[0] = 1

    def test_a_lever_that_would_fly_off_stays_and_the_others_go_on(self):
        units = vsasim.UnitBatch(maker_pro(), 3, inertia_kgm2=[1e-3, 1e-12, 1e-3])
        units.equilibrium = 0.5
        units.push[1] = 1e6
        with self.assertRaisesRegex(vsasim.InputError, r"lever\[1\].*fly off"):
            units.step(5)
        self.assertAlmostEqual(units.time_s, 0.001)
        self.assertTrue(np.isfinite(units.shaft_rad).all() and np.isfinite(units.shaft_speed_rad_per_s).all())
        units.push[:] = 0
        units.set_levers(1e-3)
        units.reset([1])
        units.step(500)
        self.assertTrue((np.abs(units.shaft_rad - 0.5) < 0.1).all())

    def test_what_no_lever_can_have_is_refused(self):
        units = vsasim.UnitBatch(maker_pro(), 2)
        for refused in (
            lambda: vsasim.UnitBatch(maker_pro(), 2, inertia_kgm2=1e-300),
            lambda: units.set_levers(1e-300),
            lambda: units.reset(shaft_rad=1e300),
            lambda: units.reset(equilibrium_rad=1e300),
            lambda: units.reset(shaft_speed_rad_per_s=-1e300),
            lambda: units.reset([1, 1], [0.1, 0.2]),
            lambda: units.reset(shaft_rad=[0.1, 1e7]),
            lambda: units.reset(preset=[0.1, 1e7], shaft_rad=0.2),
        ):
            with self.assertRaises(vsasim.InputError):
                refused()
        self.assertEqual(units.shaft_rad.tolist(), [0, 0])
        units.push[1] = 1e300
        with self.assertRaises(vsasim.InputError):
            units.step()
        self.assertEqual(units.time_s, 0)

    def test_bad_input_is_told_and_nothing_moves(self):
        units = vsasim.UnitBatch(maker_pro(), 3)
        for call in (
            lambda: vsasim.UnitBatch(maker_pro(), 0),
            lambda: vsasim.UnitBatch(maker_pro(), 2, inertia_kgm2=0),
            lambda: vsasim.UnitBatch(maker_pro(), 2, instructions="abacus"),
            lambda: units.step(0),
            lambda: units.step(1, 0.017),
            lambda: units.step(1, float("nan")),
            lambda: units.set_levers([1e-3, -1e-3, 1e-3]),
            lambda: units.set_levers([1e-3, 1e-3]),
            lambda: units.reset(which=[0.5]),
            lambda: units.reset(which=[True, False]),
            lambda: units.reset(equilibrium_rad=[1, 2]),
            lambda: setattr(units, "push", [1, 2]),
        ):
            with self.assertRaises(vsasim.InputError):
                call()
        for dt_s in (1e-10, 0.0, 0.017):
            with self.assertRaisesRegex(vsasim.InputError, f"dt_s = {dt_s}: out of range"):
                units.step(1, dt_s)
        with self.assertRaises(IndexError):
            units.reset([3])
        with self.assertRaisesRegex(IndexError, "unit 9223372036854775813: there are 3"):
            units.reset(np.array([2**63 + 5], np.uint64))
        with self.assertRaises(TypeError):
            units.push = "much"
        for name in ("equilibrium", "preset", "push"):
            getattr(units, name)[1] = np.inf
            with self.assertRaises(vsasim.InputError):
                units.step()
            getattr(units, name)[1] = 0
        self.assertEqual(units.time_s, 0)


if __name__ == "__main__":
    unittest.main()
