# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Balance of a pole on a soft joint.

World: bench_pole. A module with an upright axis swings a lever of 0.2 m, and on the lever's end stands a pole of 0.6 m that
nothing holds (a hinge along the lever, without friction). Between motors and lever are the springs, which this task keeps soft.

Observation: pole_rad (0: upright, positive: it leans the way the lever's end goes when the shaft turns back), its speed
pole_speed_rad_per_s, shaft_rad and shaft_speed_rad_per_s, and the pulleys: motor_mean_rad, motor_half_difference_rad.
Action, 100 times a second: equilibrium_rad, −1.5 … 1.5 rad; preset_rad, 0 … 0.35 rad (0.5 … 1.5 N·m/rad at rest).
Reward of a step: 0.01 s·(1 − (pole / 0.5 rad)²). Termination: the pole beyond 0.5 rad, or the lever beyond 1.5 rad.
Horizon: 5 s. Score: the sum of rewards, s: how long it stood, less for leaning; 5 at most.
Start: pole ±0.25 rad at ±0.5 rad/s, shaft ±0.3 rad, preset 0.05 … 0.3 rad, at rest with its motors.
Baseline: a linear feedback of the four angles and speeds at a constant preset; gains and preset by grid search.
Source: the rotary inverted pendulum of control laboratories (Furuta 1992), with our bench's lever and springs.
"""
from __future__ import annotations

from typing import Any, Dict, Tuple

import numpy as np

from .. import Batch
from .task import Quantity, Task, column

__all__ = ["Pole"]

FALLEN_RAD, BEYOND_RAD = 0.5, 1.5


class Pole(Task):
    """See the module's text."""

    name = "pole"
    world_name = "bench_pole"
    observation = (
        Quantity("pole_rad", "rad", -0.5, 0.5),
        Quantity("pole_speed_rad_per_s", "rad/s", -2.0, 2.0),
        Quantity("shaft_rad", "rad", -1.5, 1.5),
        Quantity("shaft_speed_rad_per_s", "rad/s", -6.0, 6.0),
        Quantity("motor_mean_rad", "rad", -1.5, 1.5),
        Quantity("motor_half_difference_rad", "rad", 0.0, 0.35),
    )
    action = (Quantity("equilibrium_rad", "rad", -1.5, 1.5), Quantity("preset_rad", "rad", 0.0, 0.35))
    score_unit = "s"
    horizon = 500
    baseline_parameters = {"pole": 4.0, "pole_speed": 0.75, "shaft": 1.0, "shaft_speed": 0.3, "preset_rad": 0.35}
    baseline_grid = {
        "pole": [3.0, 4.0, 6.0],
        "pole_speed": [0.5, 0.75, 1.0],
        "shaft": [0.75, 1.0, 1.25],
        "shaft_speed": [0.2, 0.3, 0.4],
        "preset_rad": [0.05, 0.15, 0.25, 0.35],
    }

    def __init__(self, copies: int) -> None:
        super().__init__(copies)
        self.hinge = [j.rsplit("::")[-1] for j in self.world.joints].index("hinge")
        self.hinge_name = self.world.joints[self.hinge]
        self.initial = self.world.state()

    def start(self, copy: int, random: np.random.Generator) -> np.ndarray:
        pole, pole_speed = random.uniform(-0.25, 0.25), random.uniform(-0.5, 0.5)
        shaft, preset = random.uniform(-0.3, 0.3), random.uniform(0.05, 0.3)
        self.world.restore_state(self.initial)
        self.world.place(0, shaft, preset)
        self.world.set_joint(self.hinge_name, pole, pole_speed)
        return self.world.state()

    def command(self, batch: Batch, which: np.ndarray, action: np.ndarray) -> None:
        batch.equilibrium[which, 0] = action[:, 0]
        batch.preset[which, 0] = action[:, 1]

    def observe(self, batch: Batch, which: np.ndarray) -> np.ndarray:
        motors = batch.motor_rad[which, 0]
        return np.column_stack(
            [
                batch.joint_position[which, self.hinge],
                batch.joint_speed[which, self.hinge],
                batch.shaft_rad[which, 0],
                batch.shaft_speed_rad_per_s[which, 0],
                (motors[:, 0] + motors[:, 1]) / 2,
                (motors[:, 0] - motors[:, 1]) / 2,
            ]
        )

    def outcome(self, batch: Batch, which: np.ndarray) -> Tuple[np.ndarray, np.ndarray, Dict[str, np.ndarray]]:
        pole, shaft = batch.joint_position[which, self.hinge], batch.shaft_rad[which, 0]
        fallen = (np.abs(pole) > FALLEN_RAD) | (np.abs(shaft) > BEYOND_RAD)
        return np.where(fallen, 0.0, self.step_s * (1 - (pole / FALLEN_RAD) ** 2)), fallen, {}

    def baseline(self, observation: np.ndarray, **parameters: Any) -> np.ndarray:
        gains = (
            ("pole", "pole_rad"),
            ("pole_speed", "pole_speed_rad_per_s"),
            ("shaft", "shaft_rad"),
            ("shaft_speed", "shaft_speed_rad_per_s"),
        )
        equilibrium = np.zeros(len(observation))
        for gain, of in gains:
            sign = 1.0 if of.startswith("shaft") else -1.0
            equilibrium = equilibrium + sign * parameters[gain] * column(observation, self.observation, of)
        return np.column_stack([equilibrium, np.broadcast_to(parameters["preset_rad"], equilibrium.shape)])
