# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Hit and settle: an arm gives way to a blow, and comes to rest.

World: frank_ball. A ball of 1 kg on a cord of 0.6 m falls against Frank's hanging right hand; shoulder and elbow are ours.

Observation: shoulder_rad, elbow_rad (0: hanging), their speeds …_speed_rad_per_s, their torques …_torque_Nm (a unit's springs,
by its encoders), ball_rad (the cord, 0: where it is held; it hangs at 0.419 rad), ball_speed_rad_per_s.
Action, 100 times a second: shoulder_equilibrium_rad, elbow_equilibrium_rad, −0.4 … 0.4 rad; shoulder_preset_rad,
elbow_preset_rad, 0.05 … 0.78 rad.
Reward of a step: −0.01 s·min(1, (shoulder² + elbow²)/(0.4 rad)² + (torques²)/(0.7 N·m)²): both how far the arm is from
where it hung and how hard it pushes back. Termination: none. Horizon: 3 s, the blow comes after about 0.35 s.
Score: the sum of rewards, s: seconds of full cost, 0 at best.
Start: both presets 0.05 … 0.7 rad and at rest, the ball ±0.12 rad from where it is held and at ±0.3 rad/s.
Baseline: equilibria 0, one constant preset each, by grid search.
Source: docs/explanation/what-stiffness-is-good-for.md, experiment 1.
"""
from __future__ import annotations

from typing import Any, Dict, Tuple

import numpy as np

from .. import Batch
from .task import Quantity, Task

__all__ = ["Hit"]

AWAY_RAD, HARD_NM = 0.4, 0.7


class Hit(Task):
    """See the module's text."""

    name = "hit"
    world_name = "frank_ball"
    observation = (
        Quantity("shoulder_rad", "rad", -0.4, 0.4),
        Quantity("elbow_rad", "rad", -0.4, 0.4),
        Quantity("shoulder_speed_rad_per_s", "rad/s", -3.0, 3.0),
        Quantity("elbow_speed_rad_per_s", "rad/s", -3.0, 3.0),
        Quantity("shoulder_torque_Nm", "N·m", -1.5, 1.5),
        Quantity("elbow_torque_Nm", "N·m", -1.5, 1.5),
        Quantity("ball_rad", "rad", -0.2, 1.0),
        Quantity("ball_speed_rad_per_s", "rad/s", -2.0, 2.0),
    )
    action = (
        Quantity("shoulder_equilibrium_rad", "rad", -0.4, 0.4),
        Quantity("elbow_equilibrium_rad", "rad", -0.4, 0.4),
        Quantity("shoulder_preset_rad", "rad", 0.05, 0.78),
        Quantity("elbow_preset_rad", "rad", 0.05, 0.78),
    )
    score_unit = "s"
    horizon = 300
    worst_reward = -0.01
    baseline_parameters = {"shoulder_preset_rad": 0.25, "elbow_preset_rad": 0.35}
    baseline_grid = {
        "shoulder_preset_rad": [0.05, 0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.78],
        "elbow_preset_rad": [0.05, 0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.78],
    }

    def __init__(self, copies: int) -> None:
        super().__init__(copies)
        self.arm = [self.world.actuators.index(name) for name in ("right_shoulder", "right_elbow")]
        self.cord = self.world.joints.index("pendulum::cord")
        for _ in range(10):  # the rest of the body sinks into place with the ball held
            self.world.set_joint("pendulum::cord", 0.0)
            self.world.run(0.05)
        self.initial = self.world.state()

    def start(self, copy: int, random: np.random.Generator) -> np.ndarray:
        presets, ball, speed = random.uniform(0.05, 0.7, 2), random.uniform(-0.12, 0.12), random.uniform(-0.3, 0.3)
        self.world.restore_state(self.initial)
        for actuator, preset in zip(self.arm, presets):
            self.world.place(actuator, 0.0, preset)
        self.world.set_joint("pendulum::cord", ball, speed)
        return self.world.state()

    def command(self, batch: Batch, which: np.ndarray, action: np.ndarray) -> None:
        for i, actuator in enumerate(self.arm):
            batch.equilibrium[which, actuator] = action[:, i]
            batch.preset[which, actuator] = action[:, 2 + i]

    def observe(self, batch: Batch, which: np.ndarray) -> np.ndarray:
        rows = which[:, np.newaxis]
        return np.column_stack(
            [
                batch.shaft_rad[rows, self.arm],
                batch.shaft_speed_rad_per_s[rows, self.arm],
                batch.torque_Nm[rows, self.arm],
                batch.joint_position[which, self.cord],
                batch.joint_speed[which, self.cord],
            ]
        )

    def outcome(self, batch: Batch, which: np.ndarray) -> Tuple[np.ndarray, np.ndarray, Dict[str, np.ndarray]]:
        angles, torques = batch.shaft_rad[which][:, self.arm], batch.torque_Nm[which][:, self.arm]
        away = angles[:, 0] ** 2 + angles[:, 1] ** 2
        hard = torques[:, 0] ** 2 + torques[:, 1] ** 2
        cost = np.minimum(1.0, away / AWAY_RAD**2 + hard / HARD_NM**2)
        return -self.step_s * cost, np.zeros(len(which), bool), {}

    def baseline(self, observation: np.ndarray, **parameters: Any) -> np.ndarray:
        still = np.zeros(len(observation))
        presets = [np.broadcast_to(parameters[p], still.shape) for p in ("shoulder_preset_rad", "elbow_preset_rad")]
        return np.column_stack([still, still, *presets])
