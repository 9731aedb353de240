# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""A policy of few numbers: a = middle + half·tanh(W x + b), x the observations scaled to about −1 … 1."""
from __future__ import annotations

from typing import Mapping, Optional, Sequence

import numpy as np

from ..envs import Quantity, Task

__all__ = ["Policy"]


def _scales(quantities: Sequence[Quantity]) -> tuple[np.ndarray, np.ndarray]:
    low, high = np.array([q.low for q in quantities]), np.array([q.high for q in quantities])
    return (low + high) / 2, (high - low) / 2


class Policy:
    """Linear in a task's observations, bounded as its actions are. `size` numbers; zeros: the middle of every action.

    held: actions that it doesn't choose, by name, and their values.
    """

    def __init__(self, task: type[Task], held: Optional[Mapping[str, float]] = None) -> None:
        held = held or {}
        unknown = set(held) - {q.name for q in task.action}
        if unknown:
            raise KeyError(f"held: {', '.join(sorted(unknown))}: {task.name} has no such action")
        self.middle_in, self.half_in = _scales(task.observation)
        self.middle_out, self.half_out = _scales(task.action)
        self.values = np.array([held.get(q.name, np.nan) for q in task.action])
        self.chosen = np.isnan(self.values)
        self.shape = (int(self.chosen.sum()), len(task.observation) + 1)
        self.size = self.shape[0] * self.shape[1]

    def act(self, parameters: np.ndarray, observations: np.ndarray) -> np.ndarray:
        """Actions (n, m) for observations (n, k) with parameters (n, size), a row each, or (size,) for all.

        Sums go row by row, so that a row's bits don't depend on how many there are.
        """
        n = len(observations)
        weights = np.broadcast_to(parameters, (n, self.size)).reshape(n, *self.shape)
        x = np.column_stack([(observations - self.middle_in) / self.half_in, np.ones(n)])
        out = np.tile(self.values, (n, 1))
        bent = np.tanh((weights * x[:, np.newaxis, :]).sum(axis=2))
        out[:, self.chosen] = self.middle_out[self.chosen] + self.half_out[self.chosen] * bent
        return out
