# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Linearisation: the command's numbers bit by bit, shapes, what follows from them, errors."""
import json
import pathlib
import tempfile
import unittest
from types import MappingProxyType

import numpy as np
import vsasim
from support import vsa

TYPE = "qbmove_maker_pro_6_1"


def by_command(*arguments):
    """The command's results.json."""
    with tempfile.TemporaryDirectory() as folder:
        done = vsa("linearize", *arguments, "--out", folder)
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        return json.loads((pathlib.Path(folder) / "results.json").read_text(encoding="utf-8"))


class Same(unittest.TestCase):
    def expect_same(self, found, told):
        for key in "ABCD":
            self.assertEqual(getattr(found, key).tolist(), told[key], key)
        for key in ("states", "inputs", "outputs"):
            self.assertEqual([{"name": n, "unit": u} for n, u in getattr(found, key)], told[key])
        self.assertEqual(found.notices, told["notices"])
        self.assertEqual(found.poles["s"].real.tolist(), [p["re_per_s"] for p in told["poles"]])
        self.assertEqual(found.poles["s"].imag.tolist(), [p["im_per_s"] for p in told["poles"]])
        self.assertEqual(found.poles["frequency_Hz"].tolist(), [p["frequency_Hz"] for p in told["poles"]])
        self.assertEqual(found.poles["damping_ratio"].tolist(), [p["damping_ratio"] for p in told["poles"]])
        self.assertEqual(found.period_s, told.get("period_s", 0.0))
        mine = found.results()
        self.assertEqual({k: v for k, v in mine.items() if k != "command"}, {k: v for k, v in told.items() if k != "command"})

    def test_a_type_gives_the_commands_bits(self):
        for firmware, friction in (("frozen", "sliding"), ("averaged", "stuck"), ("sampled", "sliding")):
            found = vsasim.ActuatorType.load(TYPE, {"drive.friction_Nm": 0.7}).linearize(
                shaft_rad=0.05, preset=0.3, inertia_kgm2=0.002, damping_Nms_per_rad=0.01, firmware=firmware, friction=friction
            )
            told = by_command(
                TYPE, "--at-rad", 0.05, "--preset-rad", 0.3, "--inertia-kgm2", 0.002, "--damping-Nms-per-rad", 0.01,
                "--firmware", firmware, "--friction", friction, "--set", "drive.friction_Nm=0.7",
            )  # fmt: skip
            self.expect_same(found, told)
            self.assertEqual(found.rest, told["point"])
            self.assertEqual(found.held_stiffness_Nm_per_rad, told["held_stiffness_Nm_per_rad"])
            self.assertEqual(found.static_stiffness_Nm_per_rad, told["static_stiffness_Nm_per_rad"])
            answer = found.response(told["response"]["frequency_Hz"])
            self.assertEqual(answer["impedance"].real.tolist(), told["response"]["impedance_re_Nms_per_rad"])
            self.assertEqual(answer["compliance"].imag.tolist(), told["response"]["compliance_im_rad_per_Nm"])
            self.assertEqual(answer["stiffness_Nm_per_rad"].tolist(), told["response"]["actuator_stiffness_Nm_per_rad"])
            self.assertEqual(answer["damping_Nms_per_rad"].tolist(), told["response"]["actuator_damping_Nms_per_rad"])

    def test_a_world_gives_the_commands_bits(self):
        world = vsasim.World.load("manipulator_3r", set={"drive.friction_Nm": 0.7})
        first, second = world.actuators[:2]
        for firmware in ("frozen", "sampled"):
            found = world.linearize(angles={first: 0.3, second: -0.2}, preset=0.3, equilibrium_rad={first: 0.35}, firmware=firmware)
            told = by_command(
                "manipulator_3r", "--at", f"{first}=0.3", "--at", f"{second}=-0.2", "--preset-rad", 0.3, "--equilibrium-of",
                f"{first}=0.35", "--firmware", firmware, "--set", "drive.friction_Nm=0.7",
            )  # fmt: skip
            self.expect_same(found, told)
            for mine, key in ((found.mass, "mass_matrix"), (found.gravity_stiffness, "gravity_stiffness")):
                self.assertEqual(mine.tolist(), told[key])
            self.assertEqual([j["name"] for j in found.joints], [j["name"] for j in told["joints"]])
            self.assertEqual(
                [j["outside_torque_Nm"] for j in found.joints], [j["outside_torque_Nm"] for j in told["joints"]]
            )
            answer = found.response(told["response"]["frequency_Hz"])
            self.assertEqual(answer["compliance"].real.tolist(), told["response"]["compliance_re_rad_per_Nm"])
            self.assertEqual(answer["driving_point"].imag.tolist(), told["response"]["driving_point_im_Nms_per_rad"])


class Meaning(unittest.TestCase):
    def test_a_response_is_that_of_the_matrices(self):
        found = vsasim.ActuatorType.load(TYPE).linearize(preset=0.3, inertia_kgm2=0.01)
        f = np.array([0.5, 3.0, 40.0])
        answer = found.response(f)
        for i, s in enumerate(2j * np.pi * f):
            x = np.linalg.solve(s * np.eye(len(found.A)) - found.A, found.B[:, 0])
            np.testing.assert_allclose(answer["compliance"][i], x[0], rtol=1e-9)
            np.testing.assert_allclose(answer["impedance"][i], 1 / x[1], rtol=1e-9)
        self.assertEqual(found.response(3.0)["impedance"].shape, (1,))
        self.assertEqual(found.response(3.0)["impedance"][0], answer["impedance"][1])

    def test_poles_and_shapes_are_those_of_A(self):
        world = vsasim.World.load("manipulator_3r")
        found = world.linearize(preset={a: 0.3 for a in world.actuators})
        poles = found.poles
        self.assertEqual(poles["shape"].shape, (len(found.A), len(poles["s"])))
        for s, shape in zip(poles["s"], poles["shape"].T):
            self.assertLess(np.linalg.norm(found.A @ shape - s * shape), 1e-9 * np.linalg.norm(found.A))
        z = found.response([2.0])
        np.testing.assert_allclose(z["impedance"][0] @ (z["compliance"][0] * 4j * np.pi), np.eye(len(found.joints)), atol=1e-9)

    def test_a_world_of_one_joint_is_its_type(self):
        world = vsasim.World.load("bench_free")
        found = world.linearize(preset=0.3, firmware="frozen")
        name = world.actuator_info()[0]["type"]
        alone = vsasim.ActuatorType.load(name).linearize(
            equilibrium_rad=found.results()["joints"][0]["angle_rad"], preset=0.3, inertia_kgm2=found.mass[0, 0], firmware="frozen"
        )
        if found.mass.shape == (1, 1) and found.gravity_stiffness[0, 0] == 0:
            np.testing.assert_allclose(found.A, alone.A, rtol=1e-9, atol=1e-9)
        else:
            self.fail("the bench has one joint without gravity")

    def test_arrays_are_read_only_and_outlive_it(self):
        a = vsasim.ActuatorType.load(TYPE).linearize().A
        with self.assertRaises(ValueError):
            a[0, 0] = 1
        self.assertEqual(a[0, 1], 1)

    def test_the_world_stays_as_it_is(self):
        world = vsasim.World.load("manipulator_3r")
        world.command_all(0.3, 0.2)
        world.run(0.2)
        before = world.state_hash()
        world.linearize(angles={world.actuators[0]: 0.7})
        self.assertEqual(world.state_hash(), before)

    def test_any_mapping_of_angles_and_presets_will_do(self):
        world = vsasim.World.load("manipulator_3r")
        angles, presets = {world.actuators[0]: 0.7}, {world.actuators[1]: 0.3}
        as_dict = world.linearize(angles=angles, preset=presets)
        other = world.linearize(angles=MappingProxyType(angles), preset=MappingProxyType(presets))
        np.testing.assert_array_equal(other.A, as_dict.A)
        for name, wrong in (("angles", [0.7]), ("angles", {1: 0.7}), ("equilibrium_rad", {"joint_1": "a"}), ("preset", {"joint_1": None})):
            with self.subTest(name=name, wrong=wrong), self.assertRaisesRegex(TypeError, name):
                world.linearize(**{name: wrong})


class Errors(unittest.TestCase):
    def test_bad_input_has_the_librarys_texts(self):
        type = vsasim.ActuatorType.load(TYPE)
        for arguments, parts in (
            ({"preset": 0.9}, ("preset = 0.9", "0.785")),
            ({"inertia_kgm2": 0}, ("inertia_kgm2", "above 0")),
            ({"firmware": "asleep"}, ("firmware = asleep", "frozen", "sampled")),
            ({"friction": "none"}, ("friction = none", "stuck")),
            ({"shaft_rad": 1.5}, ("motor 1 voltage",)),
            ({"shaft_rad": 0.1, "load_Nm": 0.2}, ("load_Nm = 0.2", "shaft_rad")),
            ({"shaft_rad": 0.1, "load_Nm": float("nan")}, ("load_Nm = nan",)),
        ):
            with self.assertRaises(vsasim.InputError) as raised:
                type.linearize(**arguments)
            for part in parts:
                self.assertIn(part, str(raised.exception))
        with self.assertRaises(TypeError):
            type.linearize(preset="much")
        found = type.linearize()
        for wrong in (0.0, -1.0, float("nan"), [1.0, float("inf")]):
            with self.assertRaises(vsasim.InputError):
                found.response(wrong)
        with self.assertRaises(TypeError):
            found.response("slow")

    def test_a_world_refuses_what_it_cant_be(self):
        world = vsasim.World.load("manipulator_3r")
        with self.assertRaises(vsasim.InputError) as raised:
            world.linearize(angles={"wrist": 0.1})
        self.assertIn("no such joint", str(raised.exception))
        with self.assertRaises(vsasim.InputError) as raised:
            vsasim.World.load("snake_flat").linearize()
        self.assertIn("flies free", str(raised.exception))
        for preset in (float("nan"), {"joint_2": float("inf")}):
            with self.assertRaisesRegex(vsasim.InputError, "joint_2: preset = (nan|inf): is out of range"):
                world.linearize(preset=preset)
        with self.assertRaises(TypeError):
            world.linearize(preset="soft")


if __name__ == "__main__":
    unittest.main()
