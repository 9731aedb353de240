# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Tasks as vector environments: Gymnasium's shape, seeds, what is refused, ends of episodes, the tasks themselves."""
import inspect
import math
import pathlib
import tempfile
import unittest

import numpy as np
import vsasim
import vsasim.envs
from support import Interrupting
from vsasim.envs import HAVE_GYMNASIUM, TASKS, AutoresetMode, Box, make
from vsasim.envs.pole import Pole
from vsasim.envs.snake import Snake
from vsasim.envs.throw import Throw


class Short(Throw):
    """A throw of three steps."""

    horizon = 3


def held(env, action):
    return np.tile(np.asarray(action, np.float32), (env.num_envs, 1))


def bits(env, actions, seed):
    """Everything that an environment gives along those actions, as bytes."""
    observations, _ = env.reset(seed=seed)
    out = [observations.tobytes()]
    for action in actions:
        *arrays, infos = env.step(action)
        out += [a.tobytes() for a in arrays]
        out += [infos[k].tobytes() for k in sorted(infos) if infos[k].dtype != object]
    return out


class Shape(unittest.TestCase):
    def test_every_task_speaks_as_its_spaces_say(self):
        for name in TASKS:
            with self.subTest(name):
                env = make(name, 2, threads=1)
                one, many = env.single_observation_space, env.observation_space
                self.assertEqual((many.shape, env.action_space.shape), ((2, *one.shape), (2, *env.single_action_space.shape)))
                self.assertEqual((one.dtype, env.single_action_space.dtype), (np.float64, np.float32))
                self.assertEqual(env.metadata["autoreset_mode"], AutoresetMode.NEXT_STEP)
                observations, infos = env.reset(seed=3)
                self.assertTrue(many.contains(observations))
                self.assertEqual(infos, {})
                env.action_space.seed(1)
                action = env.action_space.sample()
                self.assertTrue(env.action_space.contains(action))
                observations, rewards, terminations, truncations, infos = env.step(action)
                self.assertTrue(many.contains(observations))
                self.assertTrue(np.all(np.isfinite(observations)))
                for array, kind in ((rewards, np.float64), (terminations, np.bool_), (truncations, np.bool_)):
                    self.assertEqual((array.shape, array.dtype), ((2,), kind))
                self.assertIsNone(env.render())
                env.close()
                env.close()
                with self.assertRaisesRegex(RuntimeError, "closed"):
                    env.step(action)

    def test_what_it_gives_is_the_callers_own(self):
        env = make("throw", 2)
        first, _ = env.reset(seed=1)
        kept = first.copy()
        second, *flags, _ = env.step(held(env, [1, 0.2, -1]))
        np.testing.assert_array_equal(first, kept)
        kept, flags[1][:] = second.copy(), True
        third, *_ = env.step(held(env, [1, 0.2, -1]))
        self.assertTrue(np.all(third[:, 4] > 0.015))
        np.testing.assert_array_equal(second, kept)

    def test_every_public_thing_has_a_docstring_and_every_argument_a_type(self):
        for module in (vsasim.envs, __import__("vsasim.learn", fromlist=["learn"])):
            for name in module.__all__:
                thing = getattr(module, name)
                inside = vars(thing).items() if inspect.isclass(thing) else ()
                methods = [m for n, m in inside if inspect.isfunction(m) and not n.startswith("_")]
                for function in [m for m in [thing, *methods] if inspect.isfunction(m) and m.__module__.startswith("vsasim")]:
                    arguments = list(inspect.signature(function).parameters.values())
                    untyped = [a.name for a in arguments if a.annotation is a.empty and a.name != "self"]
                    self.assertEqual(untyped, [], function)
                if inspect.isclass(thing) or inspect.isfunction(thing):
                    self.assertTrue((thing.__doc__ or "").strip(), name)

    @unittest.skipUnless(HAVE_GYMNASIUM, "Gymnasium isn't there")
    def test_gymnasium_takes_it_for_its_own(self):
        import gymnasium
        from gymnasium.wrappers.vector import RecordEpisodeStatistics

        env = make(Short, 2)
        self.assertIsInstance(env, gymnasium.vector.VectorEnv)
        self.assertIsInstance(env.single_action_space, gymnasium.spaces.Box)
        wrapped = RecordEpisodeStatistics(env)
        wrapped.reset(seed=1)
        for _ in range(3):
            *_, infos = wrapped.step(held(env, [1, 0.2, -1]))
        self.assertEqual(infos["episode"]["l"].tolist(), [3, 3])
        made = gymnasium.make_vec("vsasim/throw-v0", num_envs=3)
        self.assertEqual(made.reset(seed=1)[0].tobytes(), make("throw", 3).reset(seed=1)[0].tobytes())


class Boxes(unittest.TestCase):
    def test_a_box_draws_what_it_contains_and_the_same_for_the_same_seed(self):
        box = Box(np.array([-1.0, 0.0, -np.inf, -np.inf]), np.array([1.0, np.inf, 2.0, np.inf]), dtype=np.float64)
        box.seed(5)
        first = [box.sample() for _ in range(50)]
        self.assertTrue(all(box.contains(x) for x in first))
        box.seed(5)
        self.assertEqual(first[7].tobytes(), [box.sample() for _ in range(8)][7].tobytes())
        self.assertGreater(np.ptp([x[0] for x in first]), 1.0)
        self.assertLess(min(x[2] for x in first), 1.0)

    def test_a_box_tells_what_is_not_in_it(self):
        box = Box(-1.0, 1.0, (2,), np.float32)
        of = lambda *numbers: np.array(numbers, np.float32)  # noqa: E731
        for wrong in (["a", "b"], of(0, 0, 0), of(0, 1.5), of(0, np.nan), np.zeros(2, complex)):
            self.assertFalse(box.contains(wrong), wrong)
        self.assertTrue(box.contains(np.zeros(2, np.float32)))
        self.assertTrue(box.contains([0.0, 1.0]))
        self.assertEqual(box, Box(-1.0, 1.0, (2,), np.float32))
        self.assertNotEqual(box, Box(-1.0, 2.0, (2,), np.float32))
        with self.assertRaises(ValueError):
            Box(np.array([1.0]), np.array([0.0]))


class Seeds(unittest.TestCase):
    def test_the_same_seed_gives_the_same_bits_for_any_number_of_threads_and_neighbours(self):
        for name, steps in (("throw", 30), ("pole", 30), ("hit", 4), ("snake", 1)):
            with self.subTest(name):
                space = make(name, 1).single_action_space
                space.seed(2)
                actions = [np.stack([space.sample() for _ in range(3)]) for _ in range(steps)]
                all_runs = [bits(make(name, 3, threads=threads), actions, 11) for threads in (1, 2, 3)]
                self.assertEqual(all_runs[0], all_runs[1])
                self.assertEqual(all_runs[0], all_runs[2])
                alone = make(name, 1, threads=1)
                together = make(name, 3, threads=2)
                seen, _ = together.reset(seed=11)
                mine, _ = alone.reset(seed=13)
                np.testing.assert_array_equal(seen[2:], mine)
                for action in actions[:10]:
                    seen, reward, *_ = together.step(action)
                    mine, mine_reward, *_ = alone.step(action[2:])
                    self.assertEqual(seen[2].tobytes(), mine[0].tobytes())
                    self.assertEqual(reward[2], mine_reward[0])

    def test_other_seeds_and_later_episodes_begin_elsewhere(self):
        env = make("pole", 2)
        first, _ = env.reset(seed=[4, 4])
        np.testing.assert_array_equal(first[0], first[1])
        later, _ = env.reset()
        self.assertTrue(np.all(later[:, 0] != first[:, 0]))
        np.testing.assert_array_equal(later[0], later[1])
        mixed, _ = env.reset(seed=[4, None])
        np.testing.assert_array_equal(mixed[0], first[0])
        self.assertEqual(env.np_random_seed, (4, 4))
        self.assertNotEqual(mixed[1, 0], later[1, 0])

    def test_seeds_that_are_none_are_told_and_nothing_changes(self):
        env = make("throw", 2)
        before, _ = env.reset(seed=1)
        for wrong, error in (
            (-1, ValueError),
            (1.5, TypeError),
            (True, TypeError),
            ("a", TypeError),
            ([1], ValueError),
            ([1, 2.5], TypeError),
            ([1, -2], ValueError),
        ):
            with self.subTest(seed=wrong), self.assertRaisesRegex(error, "seed"):
                env.reset(seed=wrong)
        for wrong, error in (
            ({"x": 1}, ValueError),
            ({"reset_mask": [True, False]}, TypeError),
            ({"reset_mask": np.ones(3, bool)}, ValueError),
            ({"reset_mask": np.zeros(2, bool)}, ValueError),
        ):
            with self.subTest(options=wrong), self.assertRaisesRegex(error, "options"):
                env.reset(options=wrong)
        self.assertEqual(env.np_random_seed, (1, 2))
        np.testing.assert_array_equal(env.task.observe(env.batch, np.arange(2)), before)


class Refused(unittest.TestCase):
    def test_actions_that_fit_nowhere_are_told_and_nothing_is_stepped(self):
        env = make("throw", 2)
        env.reset(seed=1)
        before = env.batch.state(1)
        nan = held(env, [0, 0.2, 0])
        nan[1, 1] = np.nan
        for wrong, error, text in (
            (nan, vsasim.InputError, r"actions\[1, 1\] \(preset_rad\) = nan"),
            (np.full((2, 3), np.inf), vsasim.InputError, "isn't finite"),
            (np.zeros(3), vsasim.InputError, r"shape \(3,\).*\(2, 3\)"),
            (np.zeros((3, 2)), vsasim.InputError, "shape"),
            (np.zeros((2, 3), complex), TypeError, "complex"),
            (np.zeros((2, 3), bool), TypeError, "bool"),
            ([["a"] * 3] * 2, TypeError, "actions"),
            ([[1, 2, 3], [1]], TypeError, "actions"),
            (None, TypeError, "actions"),
        ):
            with self.subTest(text=text), self.assertRaisesRegex(error, text):
                env.step(wrong)
        self.assertEqual(env.batch.state(1).tobytes(), before.tobytes())
        with self.assertRaises(vsasim.InputError) as caught:
            env.step(nan)
        self.assertEqual(caught.exception.problems[0]["why"], "isn't finite")

    def test_what_cannot_be_made_is_told(self):
        for arguments, error, text in (
            (("jump",), vsasim.InputError, "task = jump.*snake, throw, hit, pole"),
            ((int,), TypeError, "Task"),
            (("throw", 0), vsasim.InputError, "num_envs = 0"),
            (("throw", True), vsasim.InputError, "num_envs"),
            (("throw", 2.0), vsasim.InputError, "num_envs"),
        ):
            with self.subTest(arguments=arguments), self.assertRaisesRegex(error, text):
                make(*arguments)
        for options, text in (
            ({"autoreset_mode": "SameStep"}, "isn't offered"),
            ({"autoreset_mode": "x"}, "autoreset_mode"),
            ({"render_mode": "human"}, "render_mode"),
            ({"threads": -1}, "threads"),
        ):
            with self.subTest(options=options), self.assertRaisesRegex(vsasim.InputError, text):
                make("throw", 1, **options)

    def test_a_step_before_a_reset_is_told(self):
        env = make("throw", 2)
        with self.assertRaisesRegex(RuntimeError, "reset"):
            env.step(np.zeros((2, 3)))
        with self.assertRaisesRegex(RuntimeError, "reset"):
            env.reset(options={"reset_mask": np.array([True, False])})

    def test_an_action_beyond_its_bounds_is_clipped(self):
        near, far = make("pole", 1), make("pole", 1)
        near.reset(seed=2)
        far.reset(seed=2)
        one = near.step(np.array([[1.5, 0.0]]))[0]
        other = far.step(np.array([[7, -3]]))[0]
        self.assertEqual(one.tobytes(), other.tobytes())
        self.assertEqual((far.batch.equilibrium[0, 0], far.batch.preset[0, 0]), (1.5, 0.0))

    def test_after_ctrl_c_in_a_step_a_reset_is_due(self):
        class Long(Throw):
            slices = 2_000_000

        env = make(Long, 2, threads=1)
        env.reset(seed=1)
        start = env.batch.time_s[0]
        with self.assertRaises(KeyboardInterrupt), Interrupting(lambda: env.task.released[0]):
            env.step(held(env, [1, 0.2, 1]))
        Long.slices = 1
        with self.assertRaisesRegex(RuntimeError, "interrupted"):
            env.step(held(env, [1, 0.2, 1]))
        env.reset(seed=1)
        self.assertEqual(env.batch.time_s[0], start)


class Ends(unittest.TestCase):
    def test_next_step_begins_anew_and_ignores_that_copys_action(self):
        env, other = make("throw", 2), make("throw", 2)
        for e in (env, other):
            e.reset(seed=5)
        swing = held(env, [1, 0.2, -1])
        go = swing.copy()
        go[0, 2] = 1.0
        last, rewards, terminations, truncations, infos = env.step(go)
        self.assertEqual((terminations.tolist(), truncations.tolist()), ([True, False], [False, False]))
        self.assertEqual((infos["score"][0], infos["_score"].tolist()), (rewards[0], [True, False]))
        self.assertEqual(infos["steps"][0], 1)
        first, rewards, terminations, truncations, infos = env.step(go)
        self.assertEqual((rewards[0], terminations[0], truncations[0]), (0.0, False, False))
        self.assertNotIn("score", infos)
        self.assertLess(first[0, 4], 1e-9)  # its time
        self.assertNotEqual(first[0, 0], last[0, 0])
        for _ in range(2):
            alone, *_ = other.step(swing)
        np.testing.assert_array_equal(first[1], alone[1])
        again, *_ = env.step(swing)
        self.assertAlmostEqual(again[0, 4], 0.01, delta=1e-9)
        _, rewards, *_, infos = env.step(go)
        self.assertEqual((infos["score"][0], infos["steps"][0]), (rewards[0], 2))

    def test_a_horizon_truncates(self):
        env = make(Short, 2)
        env.reset(seed=1)
        for k in range(3):
            _, _, terminations, truncations, infos = env.step(held(env, [1, 0.2, -1]))
            self.assertEqual(truncations.tolist(), [k == 2] * 2)
        self.assertFalse(terminations.any())
        self.assertEqual(infos["steps"].tolist(), [3, 3])
        *_, truncations, _ = env.step(held(env, [1, 0.2, -1]))
        self.assertFalse(truncations.any())

    def test_disabled_rests_until_it_is_reset(self):
        env = make("throw", 2, autoreset_mode="Disabled")
        env.reset(seed=5)
        go = held(env, [1, 0.2, -1])
        go[0, 2] = 1.0
        last, *_ = env.step(go)
        seen, rewards, terminations, _, infos = env.step(go)
        np.testing.assert_array_equal(seen[0], last[0])
        self.assertEqual((rewards[0], terminations.tolist(), infos), (0.0, [True, False], {}))
        moved = seen[1].copy()
        seen, _ = env.reset(options={"reset_mask": np.array([True, False])})
        np.testing.assert_array_equal(seen[1], moved)
        self.assertLess(seen[0, 4], 1e-9)
        _, _, terminations, *_ = env.step(held(env, [1, 0.2, -1]))
        self.assertFalse(terminations.any())

    def test_a_copy_that_blows_up_ends_and_the_others_go_on(self):
        env, good = make("hit", 3, threads=1), make("hit", 3, threads=1)
        for e in (env, good):
            e.reset(seed=5)
        world = env.task.world
        bad = env.batch.state(1)
        entry = next(e for e in world.state_layout if "physics/joint" in e["name"] and ".speed" in e["name"])
        bad[entry["offset"]] = 1e11
        env.batch.restore(1, bad)
        action = held(env, [0, 0, 0.3, 0.3])
        seen, rewards, terminations, truncations, infos = env.step(action)
        expected, *_ = good.step(action)
        self.assertEqual((terminations.tolist(), truncations.tolist()), ([False, True, False], [False] * 3))
        self.assertEqual(infos["_failure"].tolist(), [False, True, False])
        self.assertIn("blew up", infos["failure"][1])
        self.assertAlmostEqual(rewards[1], -0.01 * 300)
        self.assertTrue(np.all(np.isfinite(seen)))
        for c in (0, 2):
            self.assertEqual(seen[c].tobytes(), expected[c].tobytes())
        seen, rewards, terminations, *_ = env.step(action)
        self.assertFalse(terminations.any())
        self.assertEqual(rewards[1], 0.0)
        self.assertFalse(env.batch.status.any())


class Tasks(unittest.TestCase):
    def test_a_thrown_ball_flies_as_far_as_it_falls_for(self):
        env = make("throw", 1)
        env.reset(seed=1)
        for _ in range(40):
            seen, *_ = env.step(np.array([[1.0, 0.3, -1.0]]))
        seen, rewards, *_ = env.step(np.array([[1.0, 0.3, 1.0]]))
        q, speed = seen[0, :2]
        pose = dict(zip(env.batch.links, env.batch.poses[0]))["qbmove_bench_throw::flange"]
        ball = pose[2] + 0.038  # above the flange's origin, as the model has it
        self.assertAlmostEqual(rewards[0], 0.2 * math.sin(q) + 0.2 * speed * math.cos(q) * math.sqrt(2 * ball / 9.81), places=9)

    def test_on_a_stiff_joint_the_pole_falls_as_a_rod_about_its_end(self):
        world = vsasim.World.load("bench_pole")
        world.place(0, 0.0, 0.78)
        hinge = next(j for j in world.joints if j.endswith("hinge"))
        world.set_joint(hinge, 0.01, 0.0)
        world.run(0.4)
        angle = world.joint_angles()[world.joints.index(hinge)]
        self.assertAlmostEqual(angle / (0.01 * math.cosh(math.sqrt(1.5 * 9.81 / 0.6) * 0.4)), 1.0, delta=0.02)
        self.assertGreater(world.joint_angles()[0], 0.0)  # the falling rod pushes its hinge the other way

    def test_a_standing_pole_earns_its_time_and_a_fallen_one_ends(self):
        env = make("pole", 1, autoreset_mode="Disabled")
        seen, _ = env.reset(seed=901)
        total = 0.0
        for _ in range(500):
            seen, rewards, terminations, *_ = env.step(np.array([[0.0, 0.2]]))
            total += rewards[0]
            if terminations[0]:
                break
            self.assertAlmostEqual(rewards[0], 0.01 * (1 - (seen[0, 0] / 0.5) ** 2), places=12)
        self.assertTrue(terminations[0])
        self.assertGreater(max(abs(seen[0, 0]) / 0.5, abs(seen[0, 2]) / 1.5), 1.0)
        self.assertEqual(rewards[0], 0.0)
        self.assertLess(total, 1.5)
        seen, _ = env.reset(seed=901)
        for _ in range(200):
            seen, _, terminations, *_ = env.step(env.task.baseline(seen, **Pole.baseline_parameters))
        self.assertFalse(terminations[0])
        self.assertLess(abs(seen[0, 0]), 0.05)

    def test_a_stiff_arm_gives_way_less_and_pushes_back_harder(self):
        env = make("hit", 2, threads=1)
        seen, _ = env.reset(seed=[7, 7])
        presets = np.array([0.1, 0.78])
        far, hard = np.zeros(2), np.zeros(2)
        for _ in range(70):
            seen, rewards, *_ = env.step(env.task.baseline(seen, shoulder_preset_rad=presets, elbow_preset_rad=presets))
            away, torque = (seen[:, :2] ** 2).sum(axis=1), (seen[:, 4:6] ** 2).sum(axis=1)
            np.testing.assert_allclose(rewards, -0.01 * np.minimum(1, away / 0.16 + torque / 0.49), rtol=1e-12)
            far, hard = np.maximum(far, away), np.maximum(hard, torque)
        env.step(np.tile([0.1, -0.2, 0.3, 0.4], (2, 1)))
        told = {name: (env.batch.equilibrium[0, a], env.batch.preset[0, a]) for a, name in enumerate(env.batch.actuators)}
        np.testing.assert_allclose([told["right_shoulder"], told["right_elbow"]], [(0.1, 0.3), (-0.2, 0.4)])
        self.assertTrue(np.all(np.isnan(told["left_elbow"])))
        self.assertGreater(far[0], 1.5 * far[1])
        self.assertGreater(hard[1], 2 * hard[0])

    def test_the_snakes_wave_is_the_papers_and_steers_the_way_it_says(self):
        env = make("snake", 2, threads=2)
        env.reset(seed=1)
        action = held(env, [1.047, 0.349, 0.785, 0.611])
        total, both = np.zeros(2), np.arange(2)
        began = env.task.centers(env.batch, both)[:, 1]
        for _ in range(10):
            seen, rewards, *_ = env.step(action)
            total += rewards
        np.testing.assert_allclose(total, began - env.task.centers(env.batch, both)[:, 1], atol=1e-12)
        t = 5.0 - 0.01  # when the last command was given
        n = np.arange(12)
        wave = np.where(n % 2 == 1, 1.047, 0.349) * np.sin(4.71 * t + n * np.pi / 5 + np.where(n % 2 == 1, 0, 0.785))
        np.testing.assert_allclose(env.batch.equilibrium[0], wave, atol=1e-6)
        self.assertTrue(np.all(total > 0.2), total)  # along −y
        np.testing.assert_allclose(seen[:, 6:9], action[:, :3], atol=1e-6)
        self.assertTrue(np.all((seen[:, 1] > 0.05) & (seen[:, 1] < 0.4)))
        left = env.task.baseline(np.where(np.arange(9) == 0, 0.3, seen), **Snake.baseline_parameters)
        ahead = env.task.baseline(np.where(np.arange(9) == 0, 0.0, seen), **Snake.baseline_parameters)
        self.assertTrue(np.all(left[:, 2] > ahead[:, 2]))  # a larger δ turns to the right

    def test_the_baselines_are_better_than_standing_still(self):
        for name in ("throw", "hit", "pole"):
            with self.subTest(name):
                scores = {}
                for kind in ("baseline", "still"):
                    env = make(name, 3, autoreset_mode="Disabled")
                    seen, _ = env.reset(seed=1)
                    total, on = np.zeros(3), True
                    still = np.clip(np.zeros(env.action_space.shape), env.action_space.low, env.action_space.high)
                    while on:
                        baseline = env.task.baseline(seen, **env.task.baseline_parameters)
                        seen, rewards, terminations, truncations, _ = env.step(baseline if kind == "baseline" else still)
                        total += rewards
                        on = not np.all(terminations | truncations)
                    scores[kind] = total.mean()
                self.assertGreater(scores["baseline"], scores["still"])

    def test_a_baselines_parameters_are_of_its_grid(self):
        for task in TASKS.values():
            self.assertEqual(set(task.baseline_parameters), set(task.baseline_grid))
            for key, value in task.baseline_parameters.items():
                self.assertIn(value, task.baseline_grid[key], (task.name, key))


class Records(unittest.TestCase):
    def test_a_recorded_episode_is_the_environments(self):
        env = make("throw", 1, autoreset_mode="Disabled")

        def policy(seen):
            return env.task.baseline(seen, **Throw.baseline_parameters)

        seen, _ = env.reset(seed=901)
        total = 0.0
        for _ in range(200):
            seen, rewards, terminations, *_ = env.step(policy(seen))
            total += rewards[0]
        with tempfile.TemporaryDirectory() as folder:
            done = vsasim.envs.record("throw", policy, pathlib.Path(folder) / "out", seed=901)
            files = {f.name for f in (pathlib.Path(folder) / "out").iterdir()}
            self.assertTrue(done["page"] is None or done["page"].stat().st_size > 100_000)
        self.assertEqual(done["score"], total)
        self.assertIn("qbmove_bench_throw_actuators.csv", files)

    def test_what_a_policy_raises_ends_the_recording_whole(self):
        def policy(seen):
            raise ZeroDivisionError("half-way")

        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaises(ZeroDivisionError):
                vsasim.envs.record("throw", policy, folder, seed=1)
            page = pathlib.Path(folder, "replay.html")
            self.assertIn("ZeroDivisionError: half-way", page.read_text())

    def test_a_copy_that_blows_up_is_recorded_up_to_there(self):
        class Wild(Throw):
            """Faster than anything goes."""

            def start(self, copy, random):
                world = self.world.clone()
                world.restore_state(super().start(copy, random))
                world.set_joint(world.joints[0], 0.0, 1e11)
                return world.state()

        env = make(Wild, 1, autoreset_mode="Disabled")
        idle = np.zeros((1, env.single_action_space.shape[0]))
        env.reset(seed=1)
        self.assertIn("failure", env.step(idle)[4])
        with tempfile.TemporaryDirectory() as folder:
            done = vsasim.envs.record(Wild, lambda seen: idle, folder, seed=1)
            self.assertEqual(done["steps"], 1)
            self.assertTrue(done["page"].exists())

    def test_a_slice_is_whole_steps(self):
        class Odd(Throw):
            """Between two steps."""

            slice_s = 0.0154

        with self.assertRaisesRegex(vsasim.InputError, "Odd.slice_s = 0.0154.*multiples of"):
            make(Odd, 1)

    @staticmethod
    def recorded(task):
        with tempfile.TemporaryDirectory() as folder:
            return vsasim.envs.record(task, lambda seen: Pole.baseline(Pole, seen, **Pole.baseline_parameters), folder, seed=3)

    def test_a_task_that_changes_its_world_is_recorded_in_that_world(self):
        link = next(name for name in vsasim.World.load(Pole.world_name).links if name.endswith("pole"))

        class Heavy(Pole):
            """Twice the pole."""

            horizon = 30

            def __init__(self, copies):
                super().__init__(copies)
                self.world.set_link_parameters(link, mass_kg=2 * self.world.link_parameters(link)["mass_kg"])

        env = make(Heavy, 1, autoreset_mode="Disabled")
        seen, _ = env.reset(seed=3)
        total, over = 0.0, False
        while not over:
            seen, rewards, terminations, truncations, _ = env.step(env.task.baseline(seen, **Pole.baseline_parameters))
            total, over = total + rewards[0], terminations[0] or truncations[0]
        self.assertEqual(self.recorded(Heavy)["score"], total)

    def test_a_record_that_goes_another_way_is_told(self):
        class Rusting(Pole):
            """With friction that comes in an episode."""

            horizon = 30

            def outcome(self, batch, which):
                batch.set(None, None, "drive.friction_Nm", 2.0)
                return super().outcome(batch, which)

        with self.assertRaisesRegex(RuntimeError, "pole change parameters in an episode"):
            self.recorded(Rusting)


if __name__ == "__main__":
    unittest.main()
