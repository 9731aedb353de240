# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""The small learner: strategy, policy, and what the command says."""
import contextlib
import errno
import io
import os
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np
import vsasim
from vsasim.envs import TASKS, make
from vsasim.learn import Evolution, Policy, commands, play, train
from vsasim.learn.__main__ import main


class Strategy(unittest.TestCase):
    def test_it_climbs_a_crooked_hill_of_rosenbrock(self):
        evolution = Evolution(np.zeros(4), 0.5, 12, seed=1)
        for _ in range(250):
            x = evolution.ask()
            evolution.tell(-(100 * (x[:, 1:] - x[:, :-1] ** 2) ** 2 + (1 - x[:, :-1]) ** 2).sum(axis=1))
        np.testing.assert_allclose(evolution.mean, np.ones(4), atol=1e-4)

    def test_the_same_seed_goes_the_same_way_and_order_alone_counts(self):
        means = []
        for seed, shown in ((1, lambda s: s), (1, lambda s: np.exp(s / 10)), (2, lambda s: s)):
            evolution = Evolution(np.ones(3), 0.3, 8, seed)
            for _ in range(5):
                evolution.tell(shown(-(evolution.ask() ** 2).sum(axis=1)))
            means.append(evolution.mean.tobytes())
        self.assertEqual(means[0], means[1])
        self.assertNotEqual(means[0], means[2])


class Policies(unittest.TestCase):
    def test_zeros_are_the_middle_and_no_numbers_leave_the_bounds(self):
        task = TASKS["throw"]
        policy = Policy(task)
        self.assertEqual(policy.size, 3 * 6)
        seen = np.random.default_rng(1).normal(size=(5, 5))
        np.testing.assert_allclose(policy.act(np.zeros(policy.size), seen), np.tile([0.0, 0.415, 0.0], (5, 1)))
        wild = policy.act(np.full(policy.size, 1e6), seen)
        self.assertTrue(np.all(wild >= [-1, 0.05, -1]) and np.all(wild <= [1, 0.78, 1]))

    def test_a_row_has_the_same_bits_among_many_and_alone(self):
        policy, random = Policy(TASKS["hit"]), np.random.default_rng(2)
        parameters, seen = random.normal(size=(37, policy.size)), random.normal(size=(37, 8))
        together = policy.act(parameters, seen)
        for row in (0, 17, 36):
            self.assertEqual(policy.act(parameters[row : row + 1], seen[row : row + 1]).tobytes(), together[row].tobytes())

    def test_what_is_held_stays_and_takes_no_numbers(self):
        policy = Policy(TASKS["throw"], {"preset_rad": 0.3})
        self.assertEqual(policy.size, 2 * 6)
        acts = policy.act(np.ones(policy.size), np.ones((2, 5)))
        np.testing.assert_array_equal(acts[:, 1], [0.3, 0.3])
        with self.assertRaisesRegex(KeyError, "presett"):
            Policy(TASKS["throw"], {"presett": 0.3})


class Learning(unittest.TestCase):
    def test_a_throw_gets_longer(self):
        task = TASKS["throw"]
        env = make("throw", 24, autoreset_mode="Disabled")
        policy = Policy(task)
        evolution = Evolution(np.zeros(policy.size), 0.5, 8, seed=1)
        means = [mean for _, mean, _ in train(env, policy, evolution, 12, first_seed=100)]
        self.assertGreater(np.mean(means[-3:]), np.mean(means[:3]) + 0.1)
        scores = play(env, lambda seen: policy.act(evolution.mean, seen), range(24))
        self.assertGreater(scores.mean(), 0.1)


class Refusals(unittest.TestCase):
    def test_an_environment_that_resets_itself_or_does_not_divide_is_told(self):
        with self.assertRaisesRegex(vsasim.InputError, "env.*DISABLED"):
            play(make("throw", 2), lambda seen: np.zeros((2, 1)), [1, 2])
        policy = Policy(TASKS["throw"])
        with self.assertRaisesRegex(vsasim.InputError, "4 copies.*multiples of 3"):
            next(train(make("throw", 4, autoreset_mode="Disabled"), policy, Evolution(np.zeros(policy.size), 0.5, 3, 1), 1, 0))
        with self.assertRaisesRegex(vsasim.InputError, "population"):
            Evolution(np.zeros(policy.size), 0.5, 1, seed=1)


class Command(unittest.TestCase):
    def test_what_it_does_not_know_is_told(self):
        for arguments, text in (
            (["table", "jump"], "jump"),
            (["grid", "jump"], "jump"),
            (["--threads", "-1", "grid", "throw"], "threads"),
            (["table", "--tests", "0"], "1 or more"),
            (["table", "--seed", "-1"], "-1: 0 or more"),
            (["table", "throw", "--out", "/dev/null/here"], "out = /dev/null/here: Not a directory"),
            (["demo", "--out", "/proc/nothing/here"], "out = /proc/nothing/here"),
            (["table", "--preset-rad", "0.1"], "--constant"),
            (["table", "throw", "--constant", "--preset-rad", "0.9"], "throw: preset_rad = 0.9: out of range (allowed: 0.05 … 0.78"),
        ):
            with self.subTest(arguments=arguments):
                done = self.command(*arguments, timeout=20)  # before minutes of training
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(text, done.stderr.splitlines()[-1])
                self.assertNotIn("Traceback", done.stderr)

    @staticmethod
    def command(*arguments, **options):
        return subprocess.run([sys.executable, "-m", "vsasim.learn", *arguments], capture_output=True, text=True, **options)

    def test_an_encoding_without_its_letters_is_no_reason_to_end(self):
        done = self.command("--help", env={**os.environ, "PYTHONIOENCODING": "latin-1"}, encoding="latin-1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("seeds 1 ? 8", " ".join(done.stdout.split()))

    def test_a_disk_that_is_full_afterwards_is_one_line(self):
        said = io.StringIO()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
            full = OSError(errno.ENOSPC, "No space left on device")
            with mock.patch.object(sys, "argv", ["learn", "demo", "--out", folder]):
                with mock.patch.object(commands, "demo", side_effect=full):
                    self.assertEqual(main(), 1)
        self.assertEqual(said.getvalue(), "[Errno 28] No space left on device\n")


if __name__ == "__main__":
    unittest.main()
