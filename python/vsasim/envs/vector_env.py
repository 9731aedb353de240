# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Many copies of a task in the shape of gymnasium.vector.VectorEnv, on vsasim.Batch."""
from __future__ import annotations

from typing import Any, Dict, List, Optional, Tuple

import numpy as np

from .. import Batch, InputError, SimulationError, World
from .spaces import AutoresetMode, Box, Seed, VectorEnvBase, batched
from .task import Task

__all__ = ["VectorEnv"]


def refused(key: str, value: str, why: str, allowed: str) -> InputError:
    error = InputError(f"{key} = {value}: {why} (allowed: {allowed})")
    error.problems = [{"file": "", "key": key, "value": value, "why": why, "allowed": allowed}]
    return error


class VectorEnv(VectorEnvBase):
    """num_envs copies of a task, stepped by several threads; vsasim.envs.make() makes one.

    Spaces: single_observation_space and single_action_space are boxes of the task's quantities, observation_space and
    action_space n of them. Observations are float64, actions float32 (any real dtype is taken); an action beyond its bounds is
    clipped. The same seeds give the same bits, whatever the number of threads and of neighbours.

    metadata["autoreset_mode"] is one of Gymnasium's, whose names and meaning these are:
    - NEXT_STEP: an episode that has ended begins anew in the next step, which ignores that copy's action and gives its first
      observation, reward 0 and no end.
    - DISABLED: it rests, with its last observation, reward 0 and the flags of its end, until
      reset(options={"reset_mask": mask}) or reset().
    An episode is drawn from its copy's own generator, which reset(seed=…) sets.

    infos, each an array (n,) with a mask of the same name behind an underscore that says where it counts: "score" and "steps" of
    an episode that has ended in this step (the sum of its rewards, and their number), "failure" of a copy that blew up: it is
    terminated, with the task's worst reward for the steps left, and the others go on. And what the task tells.
    """

    def __init__(
        self,
        task: type[Task],
        num_envs: int = 1,
        *,
        threads: int = 0,
        autoreset_mode: Any = AutoresetMode.NEXT_STEP,
        render_mode: Optional[str] = None,
    ) -> None:
        if render_mode is not None:
            allowed = "None; vsasim.envs.record() makes a replay page"
            raise refused("render_mode", str(render_mode), "there are no frames", allowed)
        try:
            mode = AutoresetMode(autoreset_mode)
        except ValueError:
            mode = AutoresetMode.SAME_STEP
        if mode is AutoresetMode.SAME_STEP:
            raise refused("autoreset_mode", str(autoreset_mode), "isn't offered", "NextStep, Disabled")
        self.metadata = {"render_modes": [], "render_fps": round(1 / (task.slices * task.slice_s)), "autoreset_mode": mode}
        self.render_mode = None
        self.spec = None
        self.closed = False
        self._rests = mode is AutoresetMode.DISABLED
        if isinstance(num_envs, bool) or not isinstance(num_envs, (int, np.integer)) or num_envs < 1:
            raise refused("num_envs", str(num_envs), "isn't a number of copies", "1 or more")
        self.num_envs = int(num_envs)
        self.task = task(self.num_envs)
        self.batch = Batch(self.task.world, self.num_envs, threads)
        unbounded = np.full(len(task.observation), np.inf)
        self.single_observation_space = Box(-unbounded, unbounded, dtype=np.float64)
        self.single_action_space = Box(
            np.array([q.low for q in task.action], np.float32), np.array([q.high for q in task.action], np.float32), dtype=np.float32
        )
        self.observation_space = batched(self.single_observation_space, self.num_envs)
        self.action_space = batched(self.single_action_space, self.num_envs)
        self._low = self.single_action_space.low.astype(float)
        self._high = self.single_action_space.high.astype(float)
        self._randoms: List[Optional[np.random.Generator]] = [None] * self.num_envs
        self._seeds: List[int] = [-1] * self.num_envs
        self._observations = np.zeros((self.num_envs, len(task.observation)))
        self._terminated = np.zeros(self.num_envs, bool)
        self._truncated = np.zeros(self.num_envs, bool)
        self._steps = np.zeros(self.num_envs, np.int64)
        self._scores = np.zeros(self.num_envs)
        self._why_not = "reset() comes first"
        self.follower: Optional[World] = None
        """A world that gets the first copy's commands and steps with it: record() sets it."""

    def reset(self, *, seed: Seed = None, options: Optional[Dict[str, Any]] = None) -> Tuple[np.ndarray, Dict[str, Any]]:
        """Begins new episodes. Returns observations (n, observations) and infos.

        seed: a whole number s (copy i gets s + i), one for each copy, or None: each goes on drawing where it was.
        options: {"reset_mask": bool (n,)}: only those, as in Gymnasium. InputError, TypeError: nothing has changed.
        """
        seeds = self._checked_seeds(seed)
        which = self._masked(options)
        self._ready(self._why_not if len(which) < self.num_envs else "")
        self._why_not = "an earlier reset() was interrupted: reset() again"
        for copy in which:
            self._begin(int(copy), seeds[copy])
        self._observations[which] = self.task.observe(self.batch, which)
        self._why_not = ""
        return self._observations.copy(), {}

    def step(self, actions: Any) -> Tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, Dict[str, Any]]:
        """One step of each copy, actions (n, actions): observations, rewards, terminations, truncations, infos.

        InputError: another shape, NaN or infinity. TypeError: no real numbers. RuntimeError: closed, or not reset. Nothing is
        stepped then. Ctrl-C ends it between two steps of the worlds, after which a reset() is due.
        """
        self._ready(self._why_not)
        wanted = np.clip(self._checked(actions), self._low, self._high)
        ended = self._terminated | self._truncated
        rewards = np.zeros(self.num_envs)
        infos: Dict[str, Any] = {}
        which = np.flatnonzero(~ended)
        self._why_not = "an earlier step() was interrupted: reset() again"
        if not self._rests:
            again = np.flatnonzero(ended)
            for copy in again:
                self._begin(int(copy), None)
            if len(again):
                self._observations[again] = self.task.observe(self.batch, again)
        if len(which):
            for _ in range(self.task.slices):
                self.task.command(self.batch, which, wanted[which])
                self._go(which)
            self._take(which, rewards, infos)
        self._why_not = ""
        return self._observations.copy(), rewards, self._terminated.copy(), self._truncated.copy(), infos

    def render(self) -> Optional[Tuple[Any, ...]]:
        """None: there are no frames. vsasim.envs.record() makes a replay page."""
        return None

    def close_extras(self, **kwargs: Any) -> None:
        """Gives the worlds back."""
        del self.batch

    @property
    def np_random(self) -> Tuple[np.random.Generator, ...]:
        """Each copy's generator."""
        return tuple(self._random(c) for c in range(self.num_envs))

    @property
    def np_random_seed(self) -> Tuple[int, ...]:
        """Each copy's last seed; drawn, where none was given."""
        for c in range(self.num_envs):
            self._random(c)
        return tuple(self._seeds)

    def __repr__(self) -> str:
        return f"VectorEnv({self.task.name}, num_envs={self.num_envs})"

    def _ready(self, why_not: str) -> None:
        if self.closed:
            raise RuntimeError("the environment is closed")
        if why_not:
            raise RuntimeError(why_not)

    def _random(self, copy: int) -> np.random.Generator:
        random = self._randoms[copy]
        if random is None:
            self._seeds[copy] = int(np.random.SeedSequence().generate_state(1)[0])
            random = self._randoms[copy] = np.random.default_rng(self._seeds[copy])
        return random

    def _begin(self, copy: int, seed: Optional[int]) -> None:
        if seed is not None:
            self._seeds[copy], self._randoms[copy] = seed, np.random.default_rng(seed)
        self.batch.restore(copy, self.task.start(copy, self._random(copy)))
        self.batch.equilibrium[copy] = np.nan
        self.batch.preset[copy] = np.nan
        self._terminated[copy] = self._truncated[copy] = False
        self._steps[copy] = 0
        self._scores[copy] = 0.0

    def _go(self, which: np.ndarray) -> None:
        if self.follower is not None:
            told = [[None if np.isnan(v) else float(v) for v in of[0]] for of in (self.batch.equilibrium, self.batch.preset)]
            for actuator, (equilibrium, preset) in enumerate(zip(*told)):
                if equilibrium is not None or preset is not None:
                    self.follower.command(actuator, equilibrium, preset)
        self.batch.step(self.task.steps, which)
        if self.follower is not None:
            try:
                self.follower.step(self.task.steps)
            except SimulationError:
                if not self.batch.status[0]:
                    raise

    def _take(self, which: np.ndarray, rewards: np.ndarray, infos: Dict[str, Any]) -> None:
        """What came of a step that those copies made."""
        self._steps[which] += 1
        reward, terminated, told = self.task.outcome(self.batch, which)
        failed = self.batch.status[which]
        reward = np.where(failed, self.task.worst_reward * (self.task.horizon - self._steps[which] + 1), reward)
        rewards[which] = reward
        self._scores[which] += reward
        self._terminated[which] = terminated | failed
        self._truncated[which] = (self._steps[which] >= self.task.horizon) & ~self._terminated[which]
        self._observations[which] = self.task.observe(self.batch, which)
        for key, value in told.items():
            self._tell(infos, key, which, value)
        if failed.any():
            self._tell(infos, "failure", which[failed], np.array([self.batch.failure(int(c)) for c in which[failed]], object))
        done = which[self._terminated[which] | self._truncated[which]]
        if len(done):
            self._tell(infos, "score", done, self._scores[done])
            self._tell(infos, "steps", done, self._steps[done])

    def _tell(self, infos: Dict[str, Any], key: str, which: np.ndarray, value: np.ndarray) -> None:
        infos[key] = np.full(self.num_envs, None, object) if value.dtype == object else np.zeros(self.num_envs, value.dtype)
        infos[key][which] = value
        infos["_" + key] = np.zeros(self.num_envs, bool)
        infos["_" + key][which] = True

    def _checked(self, actions: Any) -> np.ndarray:
        allowed = f"{self.action_space.shape}"
        if isinstance(actions, np.ma.MaskedArray):
            raise TypeError("actions: is masked, and the mask would be lost (allowed: an array without a mask)")
        try:
            given = np.asarray(actions)
        except ValueError:
            raise TypeError("actions: isn't an array of real numbers") from None
        if given.dtype.kind not in "fiu":
            raise TypeError(f"actions: dtype {given.dtype} isn't real numbers")
        if given.shape != self.action_space.shape:
            raise refused("actions", f"shape {given.shape}", "has another shape", allowed)
        wrong = np.argwhere(~np.isfinite(given))
        if len(wrong):
            copy, k = wrong[0]
            where = f"actions[{copy}, {k}] ({self.task.action[k].name})"
            raise refused(where, str(given[copy, k]), "isn't finite", "finite numbers")
        return given.astype(float)

    def _checked_seeds(self, seed: Seed) -> List[Optional[int]]:
        if seed is None or isinstance(seed, (int, np.integer)) and not isinstance(seed, bool):
            given: List[Optional[int]] = [None if seed is None else int(seed) + i for i in range(self.num_envs)]
        elif isinstance(seed, (list, tuple, np.ndarray)):
            given = [None if s is None else s for s in seed]
        else:
            raise TypeError(f"seed: {type(seed).__name__} is neither a whole number nor a list of them")
        if len(given) != self.num_envs:
            raise refused("seed", f"a list of {len(given)}", "has another length", f"one for each copy: {self.num_envs}")
        for s in given:
            if s is not None and (isinstance(s, bool) or not isinstance(s, (int, np.integer))):
                raise TypeError(f"seed: {s!r} isn't a whole number")
            if s is not None and s < 0:
                raise refused("seed", str(s), "out of range", "0 or more")
        return [None if s is None else int(s) for s in given]

    def _masked(self, options: Optional[Dict[str, Any]]) -> np.ndarray:
        everything = np.arange(self.num_envs)
        if not options:
            return everything
        for key in options:
            if key != "reset_mask":
                raise refused(f"options[{key!r}]", str(options[key]), "isn't known", "reset_mask")
        mask = options["reset_mask"]
        if not isinstance(mask, np.ndarray) or mask.dtype != np.bool_:
            raise TypeError("options['reset_mask']: isn't an array of bool")
        if mask.shape != (self.num_envs,):
            raise refused("options['reset_mask']", f"shape {mask.shape}", "has another shape", f"({self.num_envs},)")
        if not mask.any():
            raise refused("options['reset_mask']", "all False", "chooses no copy", "one True or more")
        return everything[mask]
