# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Arrays with a mask are refused by name: the numbers under the mask would be taken for given ones."""
import unittest

import numpy as np
import vsasim
import vsasim.envs


def masked(numbers, mask=None):
    return np.ma.array(numbers, mask=False if mask is None else mask)


class Masked(unittest.TestCase):
    def refused(self, name, call):
        with self.assertRaisesRegex(TypeError, f"^{name}: is masked.*allowed"):
            call()

    def test_where_a_world_takes_numbers(self):
        world = vsasim.World.load("manipulator_3r")
        three = masked([0.1, 0.2, 0.3], [False, True, False])
        self.refused("equilibrium_rad", lambda: world.command_all(three))
        self.refused("preset", lambda: world.command_all(None, three))
        self.refused("equilibrium_rad", lambda: world.command_all([masked(0.1), 0.2, 0.3]))
        self.refused("force_N", lambda: world.apply_wrench(world.links[-1], force_N=three))
        self.refused("state", lambda: world.restore_state(masked(world.state())))
        self.refused("out", lambda: world.state(out=masked(world.state())))

    def test_where_copies_take_them(self):
        batch = vsasim.Batch(vsasim.World.load("manipulator_3r"), 2)
        before = batch.preset.tobytes()
        with self.subTest("commands"):
            self.refused("equilibrium", lambda: setattr(batch, "equilibrium", masked(np.zeros((2, 3)))))
            self.refused("preset", lambda: setattr(batch, "preset", masked(0.3)))
            self.assertEqual(batch.preset.tobytes(), before)
        self.refused("which", lambda: batch.step(1, masked([0, 1], [True, False])))
        self.refused("which", lambda: batch.reset(masked([True, False])))
        self.refused("value", lambda: batch.set(None, "joint_1", "drive.friction_Nm", masked([0.7, 0.8])))
        np.testing.assert_array_equal(batch.time_s, [0, 0])

    def test_where_units_laws_and_tasks_take_them(self):
        kind = vsasim.ActuatorType.load("qbmove_maker_pro_6_1")
        two = masked([0.1, 0.2])
        self.refused("shaft_rad", lambda: kind.torque_Nm(two))
        self.refused("shaft_rad", lambda: vsasim.Unit(kind).follow(1e-3, two))
        self.refused("inertia_kgm2", lambda: vsasim.UnitBatch(kind, 2, two))
        env = vsasim.envs.make("throw", 2)
        env.reset(seed=1)
        self.refused("actions", lambda: env.step(masked(np.zeros((2, 3)))))

    def test_other_kinds_of_arrays_are_taken_as_ever(self):
        world = vsasim.World.load("manipulator_3r")
        recorded = np.zeros(3).view(np.recarray)
        world.command_all(recorded, [0.1, 0.2, 0.3])


if __name__ == "__main__":
    unittest.main()
