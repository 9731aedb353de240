# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Tasks for learning, many copies at once, in the shape of Gymnasium's vector environments.

    import vsasim.envs
    env = vsasim.envs.make("throw", 64)
    observations, infos = env.reset(seed=1)
    observations, rewards, terminations, truncations, infos = env.step(env.action_space.sample())

Derives from gymnasium.vector.VectorEnv where that can be imported, and then gymnasium.make_vec("vsasim/throw-v0", 64) makes one,
too; Gymnasium isn't needed. docs/howto/learn.md tells more.
"""
from __future__ import annotations

import contextlib
import functools
import os
import pathlib
from typing import Any, Callable, Dict, Optional, Type, Union

import numpy as np

from .hit import Hit
from .pole import Pole
from .snake import Snake
from .spaces import HAVE_GYMNASIUM, AutoresetMode, Box
from .task import Quantity, Task
from .throw import Throw
from .vector_env import VectorEnv, refused

__all__ = ["AutoresetMode", "Box", "HAVE_GYMNASIUM", "Quantity", "TASKS", "Task", "VectorEnv", "make", "record"]

TASKS: Dict[str, Type[Task]] = {t.name: t for t in (Snake, Throw, Hit, Pole)}
"""The shipped tasks by name; each module's text tells observation, action, reward, score and source."""


def make(task: Union[str, Type[Task]], num_envs: int = 1, **options: Any) -> VectorEnv:
    """That many copies of a task: its name, one of TASKS, or a class of yours that derives from Task.

    options: those of VectorEnv, threads (0: as many as the machine has) and autoreset_mode. InputError: no such task.
    """
    if isinstance(task, str):
        if task not in TASKS:
            raise refused("task", task, "isn't known", ", ".join(TASKS))
        task = TASKS[task]
    elif not (isinstance(task, type) and issubclass(task, Task)):
        raise TypeError(f"task: {task!r} is neither a name nor a class that derives from vsasim.envs.Task")
    return VectorEnv(task, num_envs, **options)


def record(
    task: Union[str, Type[Task]],
    policy: Callable[[np.ndarray], np.ndarray],
    directory: Union[str, "os.PathLike[str]"],
    *,
    seed: int = 0,
    title: str = "",
) -> Dict[str, Any]:
    """Plays one episode and records it as `vsa run --record` does: CSV files, MCAP and a replay page in `directory`.

    policy: observations (1, n) to actions (1, m). Returns a dict of score, steps and page (pathlib.Path, or None without a page,
    and then without_page says why). A copy of the task's world, with the parameters of the environment's copy, gets the same
    commands, and goes the same way bit for bit. What the policy raises ends the recording whole, with a note on its page.
    InputError, OutputError: what can't be written. RuntimeError: it went another way, as where a task sets parameters of the
    environment's Batch in an episode.
    """
    env = make(task, 1, threads=1, autoreset_mode=AutoresetMode.DISABLED)
    observations, _ = env.reset(seed=seed)
    world = env.task.world.clone()  # not the file's: a task may have changed it, and what its links weigh is no part of a state
    env.batch.give_parameters(0, world)
    world.restore_state(env.batch.state(0))
    env.follower = world
    with contextlib.closing(env), world.record(pathlib.Path(directory), title=title or env.task.name) as recorder:
        return _played(env, observations, policy, recorder, seed)


def _played(env: VectorEnv, observations: np.ndarray, policy: Any, recorder: Any, seed: int) -> Dict[str, Any]:
    """To the end of the episode. What the policy raises ends the recording, with a note on its page."""
    world = env.follower
    while True:
        observations, _, terminations, truncations, infos = env.step(policy(observations))
        if terminations[0] or truncations[0]:
            break
    if world.state().tobytes() != env.batch.state(0).tobytes():
        raise RuntimeError(
            f"the recorded world didn't go the environment's way: does the task {env.task.name} change parameters in an episode?"
        )
    score, steps = float(infos["score"][0]), int(infos["steps"][0])
    summary = {"task": env.task.name, "score": f"{score:.3f} {env.task.score_unit}", "seed": seed}
    page: Optional[pathlib.Path] = recorder.finish(summary)
    return {"score": score, "steps": steps, "page": page, "without_page": recorder.without_page}


if HAVE_GYMNASIUM:
    from gymnasium import register as _register

    for _name in TASKS:
        _register(f"vsasim/{_name}-v0", vector_entry_point=functools.partial(make, _name))
