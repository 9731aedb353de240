# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""vsasim.mujoco: what it finds and writes; and, where the build has the plug-in, MuJoCo's C library by ctypes."""
import ctypes
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from unittest import mock

import numpy as np
import vsasim
import vsasim.mujoco as vm

ARM = """<mujoco model="arm"><compiler angle="radian"/><option timestep="0.001" gravity="0 0 0"/><worldbody><body>
<joint name="elbow" axis="0 1 0"/><inertial pos="0 0 0" mass="0.2" diaginertia="0.002 0.002 0.002"/></body></worldbody></mujoco>"""
MUJOCO = os.environ.get("VSA_MUJOCO3_LIBRARY", "")  # MuJoCo's C library that the plug-in was built for
VERSION = os.environ.get("VSA_MUJOCO3_VERSION", "")


class Finding(unittest.TestCase):
    def test_without_mujoco_it_says_so(self):
        with mock.patch.dict(sys.modules, {"mujoco": None}), self.assertRaisesRegex(ImportError, "no MuJoCo for this Python"):
            vm.library()

    def test_without_one_for_this_version_it_says_which_there_are(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.dict(os.environ, {"VSA_MUJOCO_PATH": folder}):
            pathlib.Path(folder, "libvsa-mujoco-3.2.9.so").touch()
            with self.assertRaisesRegex(ImportError, r"no plug-in for MuJoCo 3\.77\.0 here.*3\.2\.9.*VSA_MUJOCO3"):
                vm.library("3.77.0")
            self.assertEqual(vm.library("3.2.9"), str(pathlib.Path(folder, "libvsa-mujoco-3.2.9.so")))
            with self.assertRaisesRegex(ImportError, "libvsa-mujoco-3.2.9.so"):  # an empty file is no library
                vm.load("3.2.9")

    def test_it_looks_above_the_package_where_parents_take_no_slice(self):
        parents = type(pathlib.Path("/a/b").parents)
        one = parents.__getitem__

        def of_python_3_9(self, at):
            if isinstance(at, slice):
                raise TypeError("slice")
            return one(self, at)

        with mock.patch.object(parents, "__getitem__", of_python_3_9), mock.patch.dict(os.environ, {"VSA_MUJOCO_PATH": "/x"}):
            folders = vm._folders()
        self.assertEqual(folders[0], pathlib.Path("/x"))
        self.assertIn(pathlib.Path(vm.__file__).resolve().parents[1] / "lib" / "vsasim", folders)


class Adding(unittest.TestCase):
    def test_a_unit_has_an_instance_two_actuators_and_a_sensor(self):
        text = vm.add(ARM, "elbow", "qbmove_maker_pro_6_1", override={"drive.friction_Nm": 0.7}, preset=0.2, bus="arm", id=3)
        root = ElementTree.fromstring(text)
        instance = root.find("extension/plugin[@plugin='vsasim.unit']/instance[@name='elbow']")
        config = {c.get("key"): c.get("value") for c in instance}
        self.assertEqual(
            config, {"type": "qbmove_maker_pro_6_1", "override": "drive.friction_Nm=0.7", "preset": "0.2", "bus": "arm", "id": "3"}
        )
        self.assertEqual([a.get("name") for a in root.findall("actuator/plugin")], ["elbow", "elbow_preset"])
        self.assertTrue(all(a.get("joint") == "elbow" and a.get("instance") == "elbow" for a in root.findall("actuator/plugin")))
        self.assertEqual(len(root.findall("sensor/plugin")), 1)

    def test_a_type_without_preset_has_one_actuator(self):
        kind = next(t for t in vsasim.ActuatorType.list() if self.controls(t) == 1)
        self.assertEqual(len(ElementTree.fromstring(vm.add(ARM, "elbow", kind, sensor=False)).findall("actuator/plugin")), 1)

    @staticmethod
    def controls(name):
        made = vsasim.ActuatorType.load(name)
        return 1 if not made.preset_unit and made.controller in ("qbmove", "position_servo") else 2

    def test_values_are_written_as_the_plugin_reads_them(self):
        class Two(float):
            def __repr__(self):
                return f"np.float64({float(self)!r})"  # as NumPy 2's numbers

        given = {"firmware.limits_on": False, "firmware.supply_limit": np.bool_(True), "drive.friction_Nm": Two(0.7)}
        given.update({"firmware.resolution": np.int64(1), "drive.off_mode": "coast", "shaft.friction_Nm": np.float32(0.5)})
        unit = vm.Unit("elbow", "qbmove_maker_pro_6_1", override=given, preset=Two(0.2), id=np.uint8(3), equilibrium=1)
        config = unit.config()
        self.assertEqual(
            config["override"],
            "firmware.limits_on=false firmware.supply_limit=true drive.friction_Nm=0.7 firmware.resolution=1 drive.off_mode=coast "
            "shaft.friction_Nm=0.5",
        )
        self.assertEqual([config[key] for key in ("preset", "id", "equilibrium")], ["0.2", "3", "1"])
        self.assertEqual(unit.actuators(), ["elbow", "elbow_preset"])
        with self.assertRaisesRegex(TypeError, "None is neither a number"):
            vm.Unit("elbow", "qbmove_maker_pro", override={"drive.friction_Nm": None}).config()

    def test_voltages_take_an_actuator_a_motor(self):
        for base, names in (("hebi_x8_9", ["elbow_motor_1"]), ("maccepa_edinburgh", ["elbow_motor_1", "elbow_motor_2"])):
            with tempfile.TemporaryDirectory() as folder, mock.patch.dict(os.environ, {"VSA_ACTUATOR_PATH": folder}):
                pathlib.Path(folder, "volts.toml").write_text(
                    f'[type]\nname = "volts"\ntitle = "by voltages"\nbase = "{base}"\n[control]\nkind = "motor_voltages"\n',
                    encoding="utf-8",
                )
                self.assertEqual(vm.Unit("elbow", "volts").actuators(), names)

    def test_a_second_unit_goes_beside_the_first(self):
        arm = ARM.replace("</body>", '<body><joint name="wrist"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body></body>')
        root = ElementTree.fromstring(vm.add(vm.add(arm, "elbow", "qbmove_maker_pro"), "wrist", "qbmove_maker_pro"))
        self.assertEqual(len(root.findall("extension/plugin/instance")), 2)
        self.assertEqual(len(root.findall("actuator")), 1)
        self.assertEqual(len(root.findall("actuator/plugin")), 4)

    def test_bad_input_is_named(self):
        with self.assertRaisesRegex(ValueError, "no joint 'knee'.*elbow"):
            vm.add(ARM, "knee", "qbmove_maker_pro")
        with self.assertRaisesRegex(vsasim.InputError, "did you mean"):
            vm.add(ARM, "elbow", "qbmove_maker_por")
        with self.assertRaisesRegex(ValueError, "controls=2"):
            vm.add(ARM, "elbow", "mine/elbow.toml")
        for controls in (0, 3, "2"):
            with self.assertRaisesRegex(ValueError, "controls = .*1 or 2"):
                vm.add(ARM, "elbow", "mine/elbow.toml", controls=controls)
        self.assertIn("elbow_preset", vm.add(ARM, "elbow", "mine/elbow.toml", controls=2))
        with self.assertRaisesRegex(ValueError, "already"):
            vm.add(vm.add(ARM, "elbow", "qbmove_maker_pro"), "elbow", "qbmove_maker_pro")


class Attaching(unittest.TestCase):
    """The calls that attach() makes, to a stand-in; InMujocosPackage has its own MjSpec."""

    def test_it_makes_the_same_elements(self):
        made = []

        class Element:
            def __init__(self, what, **given):
                self.what, self.given, self.plugin, self.config = what, given, mock.Mock(), None
                made.append(self)

        spec = mock.Mock(spec=["activate_plugin", "add_plugin", "add_actuator", "add_sensor", "plugins"], plugins=[])
        spec.add_plugin = lambda **given: Element("instance", **given)
        spec.add_actuator = lambda **given: Element("actuator", **given)
        spec.add_sensor = lambda **given: Element("sensor", **given)
        with mock.patch.dict(sys.modules, {"mujoco": mock.Mock()}), mock.patch.object(vm, "load"):
            instance = vm.attach(spec, "elbow", "qbmove_maker_pro", preset=0.3)
        spec.activate_plugin.assert_called_once_with("vsasim.unit")
        self.assertEqual([e.what for e in made], ["instance", "actuator", "actuator", "sensor"])
        self.assertEqual(instance.config, {"type": "qbmove_maker_pro", "preset": "0.3"})
        for element in made[1:]:
            self.assertEqual((element.plugin.name, element.plugin.plugin_name, element.plugin.active), ("elbow", "vsasim.unit", True))

    def test_a_spec_that_cannot_is_told_of_add(self):
        with self.assertRaisesRegex(RuntimeError, r"add\(\)"):
            vm.attach(mock.Mock(spec=["add_actuator"]), "elbow", "qbmove_maker_pro")

    def test_what_is_no_spec_is_told_so(self):
        with self.assertRaisesRegex(TypeError, "no mujoco.MjSpec, but of the type NoneType"):
            vm.attach(None, "elbow", "qbmove_maker_pro")


IN_C = """
import ctypes, sys
import vsasim.mujoco as vm
c = ctypes.CDLL(sys.argv[1])
print(vm.load(sys.argv[2]))
assert vm.load(sys.argv[2])                     # once more does no harm
P, D = ctypes.c_void_p, ctypes.c_double
c.mj_loadXML.restype = c.mj_makeData.restype = P
error = ctypes.create_string_buffer(1000)
m = c.mj_loadXML(sys.argv[3].encode(), None, error, 1000)
assert m, error.value
m = P(m)
d = P(c.mj_makeData(m))
POSITIONS, CONTROLS, PLUGIN = 1 << 1, CTRL, 1 << PLUG
assert c.mj_stateSize(m, PLUGIN) > 1000
controls = (D * 2)(0.5, 0.3)
assert c.mj_stateSize(m, CONTROLS) == 2
c.mj_setState(m, d, controls, CONTROLS)
for _ in range(2000):
    c.mj_step(m, d)
q = (D * 1)()
c.mj_getState(m, d, q, POSITIONS)
print("angle", q[0])
"""


@unittest.skipUnless(MUJOCO, "this build has no MuJoCo from 3.2 on (VSA_MUJOCO3)")
class InMujocosLibrary(unittest.TestCase):
    """In programs of their own: a plug-in can't be unloaded."""

    def run_program(self, program, *arguments):
        return subprocess.run([sys.executable, "-c", program, MUJOCO, VERSION, *arguments], capture_output=True, text=True)

    def state_bits(self):
        """mjSTATE_CTRL and mjSTATE_PLUGIN: where the versions have them."""
        later = tuple(int(n) for n in VERSION.split(".")) >= (3, 5, 0)  # mjSTATE_HISTORY came in between
        return ("1 << 6", "13") if later else ("1 << 5", "12")

    def test_an_added_unit_goes_where_its_controls_say(self):
        control, plugin = self.state_bits()
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "arm.xml")
            file.write_text(vm.add(ARM, "elbow", "qbmove_maker_pro_6_1"), encoding="utf-8")
            done = self.run_program(IN_C.replace("CTRL,", control + ",").replace("<< PLUG", "<< " + plugin), str(file))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(float(done.stdout.split()[-1]), 0.5, delta=0.05)

    def test_before_mujoco_is_loaded_it_says_so(self):
        done = self.run_program("import sys, vsasim.mujoco as vm; vm.load(sys.argv[2])")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("load MuJoCo first", done.stderr)


def package():
    """MuJoCo's Python package, where there is one with a plug-in for it."""
    try:
        import mujoco

        vm.library()
        return mujoco
    except ImportError:
        return None


@unittest.skipUnless(package(), "this Python has no MuJoCo with a plug-in for it (VSA_MUJOCO3)")
class InMujocosPackage(unittest.TestCase):
    def test_an_attached_unit_moves_as_an_added_one(self):
        import mujoco

        spec = mujoco.MjSpec.from_string(ARM)
        vm.attach(spec, "elbow", "qbmove_maker_pro_6_1", preset=0.2, override={"drive.friction_Nm": 0.7})
        text = vm.add(ARM, "elbow", "qbmove_maker_pro_6_1", preset=0.2, override={"drive.friction_Nm": 0.7})
        angles = []
        for model in (spec.compile(), mujoco.MjModel.from_xml_string(text)):
            data = mujoco.MjData(model)
            data.ctrl[:] = 0.5, 0.3
            mujoco.mj_step(model, data, 1500)
            angles.append(data.qpos[0])
        self.assertAlmostEqual(angles[0], 0.5, delta=0.05)
        self.assertEqual(*angles)

    def test_bad_input_is_named_and_the_host_goes_on(self):
        import mujoco

        spec = mujoco.MjSpec.from_string(ARM)
        vm.attach(spec, "elbow", "qbmove_maker_pro")
        with self.assertRaisesRegex(ValueError, "elbow.* already"):
            vm.attach(spec, "elbow", "qbmove_maker_pro")
        vm.attach(spec, "elbow", "qbmove_maker_pro", name="other")
        with self.assertRaisesRegex(ValueError, "elbow drives this joint already"):
            mujoco.MjData(spec.compile())
        with self.assertRaisesRegex(vsasim.InputError, "did you mean qbmove_advanced"):
            vm.attach(mujoco.MjSpec.from_string(ARM), "elbow", "qbmove")
        spec = mujoco.MjSpec.from_string(ARM)
        vm.attach(spec, "elbow", "qbmove_maker_pro").config = {"type": "qbmove_maker_pro", "presets": "0.3"}
        with self.assertRaisesRegex(ValueError, "presets"):
            spec.compile()
        spec = mujoco.MjSpec.from_string(ARM)
        vm.attach(spec, "knee", "qbmove_maker_pro")
        with self.assertRaisesRegex(ValueError, "knee"):
            spec.compile()

    def test_what_a_model_may_not_have_is_told_while_data_of_its_like_live(self):
        import mujoco

        vm.load()
        text = vm.add(ARM, "elbow", "qbmove_maker_pro")
        living = mujoco.MjData(mujoco.MjModel.from_xml_string(text))
        for wrong, told in (('gear="2"', "gear"), ('forcerange="-1 1"', "forcerange")):
            changed = text.replace('name="elbow" joint=', f'name="elbow" {wrong} joint=')
            with self.subTest(wrong=wrong), self.assertRaisesRegex(ValueError, told):
                mujoco.MjData(mujoco.MjModel.from_xml_string(changed))
        self.assertEqual(living.qpos[0], 0)

    def test_an_edited_type_is_of_effect_in_the_next_model_while_data_of_the_one_before_live(self):
        import mujoco

        vm.load()
        text = vm.add(ARM, "elbow", "edited", controls=2)
        living, angles = [], []
        with tempfile.TemporaryDirectory() as folder, mock.patch.dict(os.environ, {"VSA_ACTUATOR_PATH": folder}):
            for friction in (0.1, 2.0):
                pathlib.Path(folder, "edited.toml").write_text(
                    '[type]\nname = "edited"\ntitle = "one that changes"\nbase = "qbmove_maker_pro_6_1"\n[drive]\n'
                    f'friction_Nm = {{ value = {friction}, unit = "N·m", bounds = [0.0, 10.0], source = "this test" }}\n',
                    encoding="utf-8",
                )
                model = mujoco.MjModel.from_xml_string(text)
                living.append(mujoco.MjData(model))
                living[-1].ctrl[:] = 0.5, 0.3
                mujoco.mj_step(model, living[-1], 200)
                angles.append(living[-1].qpos[0])
        self.assertNotEqual(*angles)

    def run_example(self, name):
        file = pathlib.Path(__file__).parents[2] / "examples" / "mujoco" / name
        done = subprocess.run([sys.executable, str(file)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.splitlines()

    def test_the_joint_gives_way_less_where_it_is_stiff(self):
        soft, stiff = (float(line.split(",")[2]) for line in self.run_example("one_joint.py")[1:])
        self.assertGreater(soft, 2 * stiff)
        self.assertGreater(stiff, 0)

    def test_the_snake_moves(self):
        line = self.run_example("snake.py")[-1].split()
        self.assertGreater(float(line[3]), 0.02)
        self.assertGreater(float(line[6]), 1)

    def test_the_rollout_tells_of_soft_and_stiff(self):
        lines = self.run_example("rollout.py")
        deflection = [float(line.split()[5]) for line in lines]
        self.assertEqual(len(lines), 4)
        self.assertGreater(deflection[0], deflection[-1])

    def test_the_sweep_has_a_row_a_case(self):
        rows = [line.split(",") for line in self.run_example("sweep.py")[1:]]
        self.assertEqual(len(rows), 6)
        for soft, stiff in ((0, 2), (3, 5)):
            self.assertGreater(float(rows[soft][2]), float(rows[stiff][2]))


if __name__ == "__main__":
    unittest.main()
