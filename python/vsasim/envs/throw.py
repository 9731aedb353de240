# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""A throw: how far.

World: bench_throw. A module with an upright axis swings a ball of 0.2 kg on a lever of 0.2 m. The hand that lets go isn't
simulated: at the release the ball's flight is computed from where and how fast it is, 0.438 m above the ground,

    t = √(2h/g),   distance = r·sin q + r·q̇·cos q·t      along −x from the axis, which is where a forward swing throws

Observation: shaft_rad and shaft_speed_rad_per_s, the pulleys' motor_mean_rad and motor_half_difference_rad, time_s.
Action, 100 times a second: equilibrium_rad, −1 … 1 rad; preset_rad, 0.05 … 0.78 rad; release, −1 … 1: above 0 it lets go.
Reward: the distance, m, at the release, else 0. Termination: the release. Horizon: 2 s (never let go: 0 m).
Score: the distance, m.
Start: shaft ±0.5 rad at ±2 rad/s, motors there, preset 0.1 … 0.6 rad.
Baseline: the experiment's throw. Equilibrium back to −1 rad for a while, then forward to +1 rad, let go a while later, at a
constant preset; both times and the preset by grid search.
Source: docs/explanation/what-stiffness-is-good-for.md, experiment 3.
"""
from __future__ import annotations

from typing import Any, Dict, Tuple

import numpy as np

from .. import Batch
from .task import Quantity, Task, column

__all__ = ["Throw"]

LEVER_M, HEIGHT_M, GRAVITY_M_PER_S2 = 0.20, 0.438, 9.81  # models/robots.toml; height of the ball's centre
FLIGHT_S = float(np.sqrt(2 * HEIGHT_M / GRAVITY_M_PER_S2))


class Throw(Task):
    """See the module's text."""

    name = "throw"
    world_name = "bench_throw"
    observation = (
        Quantity("shaft_rad", "rad", -2.0, 2.0),
        Quantity("shaft_speed_rad_per_s", "rad/s", -10.0, 10.0),
        Quantity("motor_mean_rad", "rad", -1.0, 1.0),
        Quantity("motor_half_difference_rad", "rad", 0.0, 0.78),
        Quantity("time_s", "s", 0.0, 1.0),
    )
    action = (
        Quantity("equilibrium_rad", "rad", -1.0, 1.0),
        Quantity("preset_rad", "rad", 0.05, 0.78),
        Quantity("release", "", -1.0, 1.0),
    )
    score_unit = "m"
    horizon = 200
    baseline_parameters = {"back_s": 0.25, "release_s": 0.26, "preset_rad": 0.05}
    baseline_grid = {
        "back_s": [round(0.05 * i, 2) for i in range(13)],
        "release_s": [round(0.1 + 0.04 * i, 2) for i in range(13)],
        "preset_rad": [0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.78],
    }

    def __init__(self, copies: int) -> None:
        super().__init__(copies)
        self.initial = self.world.state()
        self.began_s = np.zeros(copies)
        self.released = np.zeros(copies, bool)

    def start(self, copy: int, random: np.random.Generator) -> np.ndarray:
        shaft, speed, preset = random.uniform(-0.5, 0.5), random.uniform(-2.0, 2.0), random.uniform(0.1, 0.6)
        self.world.restore_state(self.initial)
        self.world.place(0, shaft, preset, speed)
        self.began_s[copy] = self.world.time_s
        self.released[copy] = False
        return self.world.state()

    def command(self, batch: Batch, which: np.ndarray, action: np.ndarray) -> None:
        batch.equilibrium[which, 0] = action[:, 0]
        batch.preset[which, 0] = action[:, 1]
        self.released[which] = action[:, 2] > 0

    def observe(self, batch: Batch, which: np.ndarray) -> np.ndarray:
        motors = batch.motor_rad[which, 0]
        return np.column_stack(
            [
                batch.shaft_rad[which, 0],
                batch.shaft_speed_rad_per_s[which, 0],
                (motors[:, 0] + motors[:, 1]) / 2,
                (motors[:, 0] - motors[:, 1]) / 2,
                batch.time_s[which] - self.began_s[which],
            ]
        )

    def outcome(self, batch: Batch, which: np.ndarray) -> Tuple[np.ndarray, np.ndarray, Dict[str, np.ndarray]]:
        shaft, speed = batch.shaft_rad[which, 0], batch.shaft_speed_rad_per_s[which, 0]
        distance = LEVER_M * (np.sin(shaft) + speed * np.cos(shaft) * FLIGHT_S)
        let_go = self.released[which].copy()
        return np.where(let_go, distance, 0.0), let_go, {}

    def baseline(self, observation: np.ndarray, **parameters: Any) -> np.ndarray:
        time_s = column(observation, self.observation, "time_s") + self.step_s / 2  # between two steps: no tie by rounding
        forward = time_s > parameters["back_s"]
        release = time_s > parameters["back_s"] + parameters["release_s"]
        preset = np.broadcast_to(parameters["preset_rad"], time_s.shape)
        return np.column_stack([np.where(forward, 1.0, -1.0), preset, np.where(release, 1.0, -1.0)])
