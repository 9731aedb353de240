# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""What a task is made of: a world, what is seen and done, how an episode begins, what it is worth."""
from __future__ import annotations

from typing import Any, ClassVar, Dict, List, NamedTuple, Tuple

import numpy as np

from .. import Batch, InputError, World

__all__ = ["Quantity", "Task"]


class Quantity(NamedTuple):
    """One number of an observation or an action. low, high: where an action is clipped; of an observation its usual range, by
    which a learner may scale it and which nothing enforces."""

    name: str
    unit: str
    low: float
    high: float


class Task:
    """Deriving: say the constants, and write start(), command(), observe() and outcome(), each for many copies at once.

    A task keeps what it remembers of each copy in arrays with a row per copy; `copies` says how many. A row depends on nothing in
    other rows, so that a copy goes the same way whatever its neighbours do.
    """

    name: ClassVar[str]
    world_name: ClassVar[str]
    observation: ClassVar[Tuple[Quantity, ...]]
    action: ClassVar[Tuple[Quantity, ...]]
    score_unit: ClassVar[str]
    slice_s: ClassVar[float] = 0.01
    """command() is called each so many seconds."""
    slices: ClassVar[int] = 1
    """So often in a step of the environment."""
    horizon: ClassVar[int]
    """After so many steps of the environment an episode is truncated."""
    worst_reward: ClassVar[float] = 0.0
    """Of a step that a copy doesn't make because it blew up."""
    baseline_parameters: ClassVar[Dict[str, float]]
    """Of baseline(): the best of `baseline_grid`, found by `python3 -m vsasim.learn grid NAME`."""
    baseline_grid: ClassVar[Dict[str, List[float]]]

    def __init__(self, copies: int) -> None:
        self.copies = copies
        self.world = World.load(self.world_name)
        self.steps = round(self.slice_s / self.world.step_s)
        if self.steps < 1 or abs(self.steps * self.world.step_s - self.slice_s) > 1e-9:
            raise InputError(
                f"{type(self).__name__}.slice_s = {self.slice_s}: not a whole number of the world's steps"
                f" (allowed: multiples of {self.world.step_s} s)"
            )

    @property
    def step_s(self) -> float:
        """Simulated time of one step of the environment, s."""
        return self.slices * self.slice_s

    def start(self, copy: int, random: np.random.Generator) -> np.ndarray:
        """Begins an episode of that copy: a world's state as numbers, drawn from `random`."""
        raise NotImplementedError

    def command(self, batch: Batch, which: np.ndarray, action: np.ndarray) -> None:
        """Before each slice: what the copies `which` (k,) are told by their actions (k, actions)."""
        raise NotImplementedError

    def observe(self, batch: Batch, which: np.ndarray) -> np.ndarray:
        """Of those copies: (k, observations)."""
        raise NotImplementedError

    def outcome(self, batch: Batch, which: np.ndarray) -> Tuple[np.ndarray, np.ndarray, Dict[str, np.ndarray]]:
        """After a step: rewards (k,), which of them have ended (k,) and what else there is to tell, arrays (k,)."""
        raise NotImplementedError

    def baseline(self, observation: np.ndarray, **parameters: Any) -> np.ndarray:
        """What a hand-made controller does: actions (k, actions). Each parameter is a number, or one a row: (k,)."""
        raise NotImplementedError


def column(table: np.ndarray, quantities: Tuple[Quantity, ...], name: str) -> np.ndarray:
    """That quantity's column of observations or actions."""
    return table[:, [q.name for q in quantities].index(name)]
