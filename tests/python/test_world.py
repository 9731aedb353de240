# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
import gc
import pathlib
import tempfile
import threading
import time
import unittest

import numpy as np
import vsasim
from support import Interrupting, columns, finite, readings, resident_bytes, vsa


def loaded(name="bench_load", **options):
    return vsasim.World.load(name, **options)


def being_stepped(world):
    try:
        world.read()
    except RuntimeError:
        return True
    return False


class SameBits(unittest.TestCase):
    def test_a_run_gives_the_files_of_the_command_byte_for_byte(self):
        with tempfile.TemporaryDirectory() as folder:
            scenario = pathlib.Path(folder, "scenario.toml")
            scenario.write_text(
                '[scenario]\nworld = "bench_load"\nduration_s = 0.6\n'
                '[[command]]\ntime_s = 0.0\nactuator = "shaft"\nequilibrium_rad = 0.9\npreset_rad = 0.3\n'
                '[[command]]\ntime_s = 0.3\nactuator = "shaft"\npreset_rad = 0.1\n'
            )
            told = vsa("run", scenario, "--no-topics", "--record", folder + "/command")
            self.assertEqual(told.returncode, 0, told.stderr)
            world = loaded()
            with world.record(folder + "/python"):
                world.command("shaft", 0.9, 0.3)
                world.run(0.3)
                world.command(0, preset=0.1)
                world.step(300)
            files = sorted(p.name for p in pathlib.Path(folder, "command").glob("*.csv"))
            self.assertEqual(len(files), 3)
            for name in files:
                theirs = pathlib.Path(folder, "command", name).read_bytes()
                self.assertEqual(theirs, pathlib.Path(folder, "python", name).read_bytes(), name)
            last = columns(pathlib.Path(folder, "command", "qbmove_bench_load_actuators.csv"))
            self.assertEqual(float(last["shaft_rad"][-1]), world.read("shaft")["shaft_rad"])
            self.assertEqual(float(last["current_2_A"][-1]), world.read("shaft")["current_A"][1])

    def test_steps_and_a_run_of_as_much_time_are_the_same(self):
        one, other = loaded(), loaded()
        for world in (one, other):
            world.command_all(0.5, 0.2)
        one.step(250)
        other.run(0.2)
        other.run(0.0496)  # a part of a step counts as one
        self.assertEqual(one.time_ns, 250_000_000)
        self.assertEqual(one.time_ns, other.time_ns)
        self.assertEqual(one.read().tobytes(), other.read().tobytes())

    def test_a_snapshot_restored_goes_on_bit_by_bit(self):
        world = loaded("manipulator_3r")
        world.command_all([0.4, -0.3, 0.2], 0.3)
        world.run(0.1)
        then = world.snapshot()
        first = readings(world, 50)
        world.command_all(-1.0, 0.0)
        world.run(0.2)
        world.restore(then)
        self.assertEqual(world.time_s, then.time_s)
        self.assertEqual(readings(world, 50), first)

    def test_a_clone_goes_on_as_its_original_would_and_leaves_it_alone(self):
        world = loaded("manipulator_3r")
        world.command_all(0.4, 0.3)
        world.run(0.1)
        twin = world.clone()
        theirs = readings(twin, 30)
        self.assertEqual(world.time_ns, 100_000_000)
        self.assertEqual(readings(world, 30), theirs)

    def test_reset_returns_to_the_first_sample(self):
        world = loaded()
        first = world.read().tobytes(), world.poses().tobytes()
        world.command("shaft", 0.7, 0.5)
        world.run(0.3)
        self.assertNotEqual(world.read().tobytes(), first[0])
        world.reset()
        self.assertEqual((world.time_ns, world.read().tobytes(), world.poses().tobytes()), (0, *first))

    def test_two_worlds_in_two_threads_give_the_bits_of_one(self):
        alone = loaded("manipulator_3r")
        alone.command_all(0.5, 0.3)
        alone.run(0.3)
        worlds = [loaded("manipulator_3r") for _ in range(2)]

        def work(world):
            world.command_all(0.5, 0.3)
            for _ in range(30):
                world.run(0.01)

        threads = [threading.Thread(target=work, args=(w,)) for w in worlds]
        for t in threads:
            t.start()
        for t in threads:
            t.join()
        for world in worlds:
            self.assertEqual(world.read().tobytes(), alone.read().tobytes())


class WrongUse(unittest.TestCase):
    def test_a_world_that_is_not_there_is_told_with_what_is_wrong(self):
        with self.assertRaises(vsasim.InputError) as caught:
            loaded("no_such_world.sdf")
        self.assertIsInstance(caught.exception, ValueError)
        self.assertIn("no_such_world.sdf", str(caught.exception))
        self.assertEqual(set(caught.exception.problems[0]), {"file", "key", "value", "why", "allowed"})

    def test_every_wrong_parameter_is_told_at_once_in_the_commands_words(self):
        wrong = {"drive.friction_Nm": -1, "drive.nothing": 2.0}
        with self.assertRaises(vsasim.InputError) as caught:
            loaded(type="qbmove_maker_pro", set=wrong)
        self.assertEqual(len(caught.exception.problems), 2)
        told = vsa("run", "bench_load", "--no-topics", "--duration-s", "0.01", "--type", "qbmove_maker_pro",
                   "--set", "drive.friction_Nm=-1", "--set", "drive.nothing=2")  # fmt: skip
        self.assertEqual(told.returncode, 2)
        for line in str(caught.exception).splitlines():
            self.assertIn(line.strip(), told.stderr)

    def test_a_text_that_is_no_world_is_refused(self):
        with self.assertRaises(vsasim.InputError):
            vsasim.World.load_string("<sdf version='1.7'><world name='w'><model/></world></sdf>")

    def test_an_unknown_actuator_is_told_with_those_there_are(self):
        world = loaded()
        with self.assertRaisesRegex(vsasim.InputError, "shaft"):
            world.command("elbow", 0.1)
        with self.assertRaisesRegex(IndexError, "there are 1"):
            world.read(2**70)
        with self.assertRaisesRegex(IndexError, "there are 1"):
            world.read(1)
        with self.assertRaises(IndexError):
            world.read(-1)
        with self.assertRaisesRegex(TypeError, "neither a name nor an index"):
            world.read(0.5)

    def test_commands_of_another_shape_or_type_or_not_finite_change_nothing(self):
        world, untouched = loaded("manipulator_3r"), loaded("manipulator_3r")
        for wrong, error, text in (
            ([0.1, 0.2], vsasim.InputError, r"equilibrium_rad.*shape \(2,\).*\(3,\)"),
            ([[0.1, 0.2, 0.3]], vsasim.InputError, r"shape \(1, 3\)"),
            ([0.1, float("nan"), 0.3], vsasim.InputError, r"equilibrium_rad\[1\].*finite"),
            ([0.1, 0.2, float("inf")], vsasim.InputError, r"equilibrium_rad\[2\]"),
            (float("nan"), vsasim.InputError, "equilibrium_rad.*finite"),
            (np.array([1, 2, 3], dtype=complex), TypeError, "complex128"),
            (np.array([True, False, True]), TypeError, "bool"),
            (["a", "b", "c"], TypeError, "equilibrium_rad"),
            ([[1], [2, 3]], TypeError, "equilibrium_rad"),
        ):
            with self.subTest(wrong=wrong), self.assertRaisesRegex(error, text):
                world.command_all(wrong, 0.2)
        with self.assertRaisesRegex(vsasim.InputError, "joint_2.*preset"):
            world.command(1, 0.3, float("nan"))
        with self.assertRaisesRegex(vsasim.InputError, r"preset\[0\]"):
            world.command_all([0.5, 0.5, 0.5], [float("nan"), 0, 0])  # the first is fine, and isn't commanded
        self.assertEqual(readings(world, 20), readings(untouched, 20))

    def test_commands_of_other_number_types_are_taken(self):
        one, other = loaded("manipulator_3r"), loaded("manipulator_3r")
        one.command_all(np.array([1, 0, -1]), np.float32(0.25))
        other.command_all([1.0, 0.0, -1.0], (0.25, 0.25, 0.25))
        self.assertEqual(readings(one, 20), readings(other, 20))

    def test_an_array_to_fill_must_fit(self):
        world = loaded("manipulator_3r")
        n = len(world.links)
        with self.assertRaisesRegex(TypeError, "float32"):
            world.poses(out=np.empty((n, 7), np.float32))
        with self.assertRaisesRegex(vsasim.InputError, "out.*shape"):
            world.poses(out=np.empty((n + 1, 7)))
        with self.assertRaisesRegex(vsasim.InputError, "contiguous"):
            world.poses(out=np.empty((n, 14))[:, ::2])
        read_only = np.empty((n, 7))
        read_only.flags.writeable = False
        with self.assertRaisesRegex(vsasim.InputError, "writeable"):
            world.poses(out=read_only)
        with self.assertRaisesRegex(TypeError, "ndarray"):
            world.poses(out=[0.0])

    def test_times_and_counts_out_of_range_are_refused(self):
        world = loaded()
        for wrong in (-1.0, float("nan"), 1e10):
            with self.assertRaisesRegex(vsasim.InputError, "duration_s"):
                world.run(wrong)
        with self.assertRaisesRegex(vsasim.InputError, "0 or more"):
            world.step(-1)
        with self.assertRaisesRegex(vsasim.InputError, "step_s"):
            loaded(step_s=1.0)
        self.assertEqual(world.time_ns, 0)

    def test_a_snapshot_of_another_world_is_refused_and_changes_nothing(self):
        world = loaded()
        world.run(0.05)
        before = world.read().tobytes()
        with self.assertRaisesRegex(vsasim.InputError, "another world"):
            world.restore(loaded("manipulator_3r").snapshot())
        self.assertEqual(world.read().tobytes(), before)

    def test_a_blow_up_is_told_and_leaves_the_world_between_two_steps(self):
        world = loaded()
        world.apply_torque(world.joints[0], 1e9)
        with self.assertRaisesRegex(vsasim.SimulationError, "blew up") as caught:
            world.run(5.0)
        self.assertIsInstance(caught.exception, RuntimeError)
        self.assertTrue(finite(world.poses()))
        world.reset()
        world.run(0.01)
        self.assertEqual(world.time_ns, 10_000_000)


class Interrupts(unittest.TestCase):
    def test_ctrl_c_ends_a_long_run_between_two_steps(self):
        world, again = loaded(), loaded()
        world.command("shaft", 0.8, 0.2)
        again.command("shaft", 0.8, 0.2)
        with self.assertRaises(KeyboardInterrupt):
            with Interrupting(lambda: being_stepped(world)):
                world.run(1e6)
        self.assertGreater(world.time_ns, 0)
        self.assertEqual(world.time_ns % 1_000_000, 0)
        again.step(world.time_ns // 1_000_000)
        self.assertEqual(readings(world, 10), readings(again, 10))

    def test_while_one_thread_steps_another_may_command_but_not_read(self):
        world = loaded()
        seen = []
        begun = threading.Event()

        def run():
            begun.set()
            try:
                world.run(1e6)
            except vsasim.SimulationError as error:
                seen.append(error)

        # The main thread runs, so that the signal ends it; the other looks in.
        def look():
            begun.wait()
            end = time.monotonic() + Interrupting.MOST_S / 2
            while not seen:
                if time.monotonic() > end:
                    seen.append("nothing was refused")
                try:
                    world.read()
                except RuntimeError as error:
                    seen.append(str(error))
            for reading in (lambda: world.dof_count, lambda: world.free_dof(world.links[0])):
                try:
                    reading()
                    seen.append("wasn't refused")
                except RuntimeError as error:
                    seen.append(str(error))
            world.command("shaft", 0.5)

        other = threading.Thread(target=look)
        other.start()
        with self.assertRaises(KeyboardInterrupt):
            with Interrupting(lambda: len(seen) > 2):
                run()
        other.join()
        self.assertEqual(["stepped in another thread" in text for text in seen], [True] * 3)
        world.run(0.2)
        self.assertEqual(world.read("shaft")["equilibrium_command_rad"], 0.5)


class Memory(unittest.TestCase):
    def test_a_thousand_worlds_made_and_dropped_leave_nothing(self):
        def some(count):
            for _ in range(count):
                world = loaded("bench_free").clone()
                world.step()
                world.read(), world.poses(), world.snapshot()
            gc.collect()
            return resident_bytes()

        warm = some(200)
        self.assertLess(some(1000) - warm, 20e6)  # 20 kB each would be a leak of any of its parts

    def test_arrays_outlive_the_world_that_gave_them(self):
        world = loaded()
        world.run(0.1)
        poses, now = world.poses(), world.read("shaft")
        kept = poses.copy(), now["shaft_rad"]
        del world
        gc.collect()
        np.testing.assert_array_equal(poses, kept[0])
        self.assertEqual(now["shaft_rad"], kept[1])


class Bodies(unittest.TestCase):
    def test_readings_come_as_one_record_an_actuator_by_name_or_index(self):
        world = loaded("manipulator_3r")
        world.command_all([0.3, 0.2, 0.1], 0.4)
        world.run(0.5)
        every = world.read()
        self.assertEqual(every.shape, (3,))
        self.assertEqual(every.dtype, vsasim.World.reading_dtype)
        for i, name in enumerate(world.actuators):
            self.assertEqual(world.read(name), every[i])
            self.assertEqual(world.read(i), every[i])
        np.testing.assert_allclose(every["deflection_rad"], every["shaft_rad"] - every["equilibrium_rad"], atol=1e-15)
        out = np.empty(3, vsasim.World.reading_dtype)
        self.assertIs(world.read(out=out), out)
        self.assertEqual(out.tobytes(), every.tobytes())

    def test_joint_angles_are_the_shafts(self):
        world = loaded("manipulator_3r")
        world.command_all([0.3, 0.2, 0.1], 0.4)
        world.run(0.5)
        joints = [info["joint"] for info in world.actuator_info()]
        index = [world.joints.index(name) for name in joints]
        np.testing.assert_array_equal(world.joint_angles()[index], world.read()["shaft_rad"])
        np.testing.assert_array_equal(world.joint_speeds()[index], world.read()["shaft_speed_rad_per_s"])

    def test_the_kinetic_energy_is_that_of_the_mass_matrix(self):
        world = loaded("manipulator_3r")
        speeds = np.array([0.5, -1.0, 2.0])
        for joint, speed in zip(world.joints, speeds):
            world.set_joint(joint, 0.2, speed)
        mass = world.mass_matrix()
        self.assertEqual(mass.shape, (world.dof_count, world.dof_count))
        np.testing.assert_allclose(mass, mass.T, rtol=1e-12)
        v = np.zeros(world.dof_count)
        for info in world.joint_info():
            if info["name"] in world.joints:
                v[info["dof"]] = world.joint_speeds()[world.joints.index(info["name"])]
        kinetic = world.energy()["kinetic_J"]  # with the positions half a step before
        self.assertAlmostEqual(0.5 * v @ mass @ v, kinetic, delta=2e-4 * kinetic)

    def test_a_jacobian_times_the_speeds_is_the_links_velocity(self):
        world = loaded("manipulator_3r")
        for joint in world.joints:
            world.set_joint(joint, 0.3, 1.0)
        link = max(world.links, key=lambda name: np.linalg.norm(world.velocity(name)))
        v = np.zeros(world.dof_count)
        for info in world.joint_info():
            if info["dof"] is not None:
                v[info["dof"]] = 1.0
        jacobian = world.jacobian(link)
        self.assertEqual(jacobian.shape, (6, world.dof_count))
        np.testing.assert_allclose(jacobian @ v, world.velocity(link), atol=1e-9)
        self.assertGreater(np.linalg.norm(world.velocity(link)), 0.1)

    def test_poses_are_unit_quaternions_and_rows_are_links(self):
        world = loaded("manipulator_3r")
        poses = world.poses()
        self.assertEqual(poses.shape, (len(world.links), 7))
        np.testing.assert_allclose(np.linalg.norm(poses[:, 3:], axis=1), 1.0, atol=1e-12)
        for i, link in enumerate(world.links):
            np.testing.assert_array_equal(world.pose(link), poses[i])

    def test_contacts_carry_the_snakes_weight(self):
        world = loaded("snake_flat")
        self.assertEqual(world.contacts().shape, (0,))
        world.run(1.0)
        up = 0.0
        for _ in range(200):
            world.step()
            up += world.contacts()["force_N"][:, 2].sum() / 200
        mass = sum(i["mass_kg"] for i in world.link_info() if not i["is_static"])
        self.assertAlmostEqual(up / (9.81 * mass), 1.0, delta=0.05)

    def test_a_wrench_a_torque_and_a_hand_move_the_shaft_and_let_go(self):
        link = "qbmove_bench_load::flange"
        reach = loaded().pose(link)[:3] + [0.3, 0.3, 0.3]
        for act in (
            lambda w: w.apply_torque(w.joints[0], 0.5),
            lambda w: w.apply_wrench(link, torque_Nm=(0.0, 0.5, 0.0)),
            lambda w: w.pull(vsasim.Pull(link, reach, point_m=(0.05, 0.05, 0.0), force_max_N=50.0)),
        ):
            world, alone = loaded(), loaded()
            act(world)
            world.run(0.3)
            alone.run(0.3)
            self.assertGreater(abs(world.joint_angles()[0] - alone.joint_angles()[0]), 1e-3)
            world.reset()
            world.run(0.3)
            self.assertEqual(world.read().tobytes(), alone.read().tobytes())

    def test_place_puts_an_actuator_without_a_kick(self):
        world = loaded("bench_free")
        world.place("shaft", 0.5, 0.3)
        self.assertEqual(world.joint_angles()[0], 0.5)
        world.run(0.5)
        self.assertAlmostEqual(world.joint_angles()[0], 0.5, delta=2e-3)
        with self.assertRaises(vsasim.InputError):
            world.place("shaft", 1e6, 0.3)

    def test_a_torque_past_the_law_moves_a_torque_servo_and_no_qbmove(self):
        world = loaded("bench_free", type="anydrive_ad119e20")
        world.command_direct("shaft", 1.0)
        world.run(2.0)
        self.assertAlmostEqual(world.joint_angles()[0], 1.0 / 20.0, delta=2e-3)  # its stiffness is 20 N·m/rad
        with self.assertRaises(vsasim.InputError):
            loaded().command_direct("shaft", 1.0)

    def test_the_ledger_balances_and_notices_tell_what_was_clamped(self):
        world = loaded()
        world.command("shaft", 0.5, 5.0)
        world.run(1.0)
        ledger = world.ledger()
        self.assertEqual(ledger, world.ledger("shaft"))
        self.assertGreater(ledger["supply_J"], 0.1)
        self.assertLess(abs(ledger["imbalance_J"]), 1e-9 * ledger["moved_J"] + 1e-12)
        self.assertRegex("; ".join(world.take_notices()), r"^shaft: preset 5 rad is beyond ±[0-9.]+ rad: clamped")
        self.assertEqual(world.take_notices(), [])

    def test_other_parameters_change_the_motion(self):
        soft, stiff = loaded("bench_free"), loaded("bench_free")
        kind = vsasim.ActuatorType.load(stiff.actuator_info()[0]["type"])
        kind["drive.friction_Nm"] = 0.1
        stiff.set_parameters("shaft", kind)
        for world in (soft, stiff):
            world.command("shaft", 1.0, 0.2)
            world.run(0.3)
        self.assertNotEqual(soft.joint_angles()[0], stiff.joint_angles()[0])
        with self.assertRaises(vsasim.InputError):
            stiff.set_parameters("shaft", vsasim.ActuatorType.load("sea_example"))


class Recording(unittest.TestCase):
    def test_a_record_begins_where_the_world_was_put_and_its_folder_is_free_afterwards(self):
        world = vsasim.World.load("bench_free")
        world.step(5)
        back = {
            "restore": (world.snapshot(), world.restore),
            "restore_state": (world.state(), world.restore_state),
        }
        with tempfile.TemporaryDirectory() as folder:
            for name, (state, restore) in back.items():
                with world.record(folder, rate_Hz=1000):
                    world.step(20)
                    restore(state)
                    world.step(2)
                lines = pathlib.Path(folder, "energy.csv").read_text().splitlines()
                self.assertEqual([line.split(",")[0] for line in lines[1:]], ["0.005", "0.006", "0.007"], name)
                restore(state)

    def test_a_block_that_fails_leaves_a_finished_record(self):
        with tempfile.TemporaryDirectory() as folder:
            world = loaded()
            with self.assertRaises(ZeroDivisionError):
                with world.record(folder, rate_Hz=1000) as recorder:
                    world.step(5)
                    raise ZeroDivisionError("half-way")
            world.step(5)
            times = columns(pathlib.Path(folder, "qbmove_bench_load_actuators.csv"))["time_s"]
            self.assertEqual(len(times), 6)
            self.assertIn(pathlib.Path(folder, "links.csv"), recorder.files)

    def test_a_reset_starts_the_record_over(self):
        with tempfile.TemporaryDirectory() as folder:
            world = loaded()
            with world.record(folder, rate_Hz=1000):
                world.step(8)
                world.reset()
                world.step(3)
            times = columns(pathlib.Path(folder, "qbmove_bench_load_actuators.csv"))["time_s"]
            self.assertEqual([float(t) for t in times], [0.0, 0.001, 0.002, 0.003])

    def test_a_directory_that_cannot_be_made_is_told(self):
        with self.assertRaisesRegex(vsasim.InputError, "/proc/nothing"):
            loaded().record("/proc/nothing/here")


if __name__ == "__main__":
    unittest.main()
