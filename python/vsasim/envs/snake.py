# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""A snake over rubble: how far, by the wave's amplitudes, its phase and the stiffness.

World: snake_rubble. Twelve modules; the wave of the paper's eq. (10), with n/5 half waves along the body and ω = 4.71 rad/s,

    y_n(t) = A r(t) sin(ω t + n π/5 + δ),   r(t) = min(1, t/2 s),   δ on even n (horizontal axes) only

The action says where its numbers go; A changes by at most 0.2 rad/s and δ by 0.5 rad/s, so that the body never jumps.

Observation: heading_rad (direction of travel of the centre over the last gait period against −y, positive: to the left; the last
one where it travelled less than 0.03 m), travel_m (in that period), across_m (x of the centre), lift_m (highest less lowest link),
effort_Nm (mean of the units' torques, without sign), attained_preset_rad (mean), and where the wave is: amplitude_upright_rad,
amplitude_horizontal_rad, delta_rad.
Action, twice a second: amplitude_upright_rad, 0.6 … 1.4 rad (axes upright); amplitude_horizontal_rad, 0.15 … 0.75 rad;
delta_rad, −0.1 … 1.6 rad; preset_rad, 0.17 … 0.78 rad, of all units.
Reward of a step: metres of the centre along −y. Termination: none. Horizon: 20 s. Score: metres along −y. The rubble begins
0.6 m from the start and is 2.4 m wide.
Start: as the world's, turned by ±0.1 rad and moved by up to 0.1 m each way, lying straight at preset 0.61 rad.
Baseline: the hand-made gait `steered` (Table II's amplitudes, δ = 45° less what its heading asks) at a constant preset; lift,
preset and the gain of steering by grid search.
Source: docs/explanation/snake.md.
"""
from __future__ import annotations

from typing import Any, Dict, Tuple

import numpy as np

from .. import Batch
from .task import Quantity, Task, column

__all__ = ["Snake"]

OMEGA_RAD_PER_S, LAMBDA, RAMP_S = 4.71, 5, 2.0
PERIOD = round(2 * np.pi / OMEGA_RAD_PER_S / 0.01)  # in slices
AMPLITUDE_RAD_PER_S, DELTA_RAD_PER_S, LEAST_TRAVEL_M = 0.2, 0.5, 0.03
UPRIGHT, HORIZONTAL, DELTA = range(3)


class Snake(Task):
    """See the module's text."""

    name = "snake"
    world_name = "snake_rubble"
    observation = (
        Quantity("heading_rad", "rad", -1.6, 1.6),
        Quantity("travel_m", "m", 0.0, 0.25),
        Quantity("across_m", "m", -1.0, 1.0),
        Quantity("lift_m", "m", 0.0, 0.1),
        Quantity("effort_Nm", "N·m", 0.0, 1.0),
        Quantity("attained_preset_rad", "rad", 0.17, 0.78),
        Quantity("amplitude_upright_rad", "rad", 0.6, 1.4),
        Quantity("amplitude_horizontal_rad", "rad", 0.15, 0.75),
        Quantity("delta_rad", "rad", -0.1, 1.6),
    )
    action = (
        Quantity("amplitude_upright_rad", "rad", 0.6, 1.4),
        Quantity("amplitude_horizontal_rad", "rad", 0.15, 0.75),
        Quantity("delta_rad", "rad", -0.1, 1.6),
        Quantity("preset_rad", "rad", 0.17, 0.78),
    )
    score_unit = "m"
    slices = 50
    horizon = 40
    baseline_parameters = {"amplitude_horizontal_rad": 0.349, "gain": 1.0, "preset_rad": 0.48}
    baseline_grid = {
        "amplitude_horizontal_rad": [0.349, 0.524],
        "gain": [1.0],
        "preset_rad": [0.175, 0.35, 0.48, 0.611, 0.7, 0.78],
    }

    def __init__(self, copies: int) -> None:
        super().__init__(copies)
        self.n = np.arange(len(self.world.actuators))
        self.bodies = [i for i, link in enumerate(self.world.links) if link.startswith("qbmove_snake::")]
        self.world.run(0.5)  # it drops half a millimetre
        self.initial = self.world.state()
        self.began_s = np.zeros(copies)
        self.wave = np.zeros((copies, 3))
        self.trail = np.zeros((copies, PERIOD, 2))  # the centre after each slice, in a ring
        self.passed = np.zeros(copies, np.int64)
        self.heading = np.zeros(copies)
        self.travel = np.zeros(copies)
        self.before = np.zeros(copies)

    def start(self, copy: int, random: np.random.Generator) -> np.ndarray:
        yaw, x, y = random.uniform(-0.1, 0.1), *random.uniform(-0.1, 0.1, 2)
        self.world.restore_state(self.initial)
        self.world.displace_model("qbmove_snake", yaw, [x, y, 0.0])
        at = self.world.poses()[self.bodies, :2].mean(axis=0)
        self.began_s[copy] = self.world.time_s
        self.wave[copy] = 1.047, 0.349, 0.785  # Table II, with the steered gait's δ
        self.trail[copy] = at
        self.passed[copy] = 0
        self.heading[copy] = self.travel[copy] = 0.0
        self.before[copy] = at[1]
        return self.world.state()

    def command(self, batch: Batch, which: np.ndarray, action: np.ndarray) -> None:
        reach = self.slice_s * np.array([AMPLITUDE_RAD_PER_S, AMPLITUDE_RAD_PER_S, DELTA_RAD_PER_S])
        self.wave[which] += np.clip(action[:, :3] - self.wave[which], -reach, reach)
        t_s = (batch.time_s[which] - self.began_s[which])[:, np.newaxis]
        upright = self.n % 2 == 1
        amplitude = np.where(upright, self.wave[which, UPRIGHT, np.newaxis], self.wave[which, HORIZONTAL, np.newaxis])
        delta = np.where(upright, 0.0, self.wave[which, DELTA, np.newaxis])
        ramp = np.minimum(1.0, t_s / RAMP_S)
        batch.equilibrium[which] = amplitude * ramp * np.sin(OMEGA_RAD_PER_S * t_s + self.n * np.pi / LAMBDA + delta)
        batch.preset[which] = action[:, 3:4]
        self.trail[which, self.passed[which] % PERIOD] = self.centers(batch, which)
        self.passed[which] += 1

    def centers(self, batch: Batch, which: np.ndarray) -> np.ndarray:
        """The bodies' centre, whose masses are equal: (k, 2), m."""
        return batch.poses[which][:, self.bodies, :2].mean(axis=1)

    def observe(self, batch: Batch, which: np.ndarray) -> np.ndarray:
        now = self.centers(batch, which)
        way = now - self.trail[which, self.passed[which] % PERIOD]  # the oldest: a period ago, or the start
        self.travel[which] = np.hypot(way[:, 0], way[:, 1])
        goes = self.travel[which] >= LEAST_TRAVEL_M
        self.heading[which] = np.where(goes, np.arctan2(way[:, 0], -way[:, 1]), self.heading[which])
        heights = batch.poses[which][:, self.bodies, 2]
        motors = batch.motor_rad[which]
        return np.column_stack(
            [
                self.heading[which],
                self.travel[which],
                now[:, 0],
                heights.max(axis=1) - heights.min(axis=1),
                np.abs(batch.torque_Nm[which]).mean(axis=1),
                (motors[:, :, 0] - motors[:, :, 1]).mean(axis=1) / 2,
                self.wave[which],
            ]
        )

    def outcome(self, batch: Batch, which: np.ndarray) -> Tuple[np.ndarray, np.ndarray, Dict[str, np.ndarray]]:
        now = self.centers(batch, which)[:, 1]
        progress = self.before[which] - now
        self.before[which] = now
        return progress, np.zeros(len(which), bool), {}

    def baseline(self, observation: np.ndarray, **parameters: Any) -> np.ndarray:
        heading = column(observation, self.observation, "heading_rad")
        delta = 0.785 + np.clip(parameters["gain"] * heading, -0.8, 0.8)
        amplitude = np.full(len(heading), 1.047)
        lift, preset = (np.broadcast_to(parameters[p], heading.shape) for p in ("amplitude_horizontal_rad", "preset_rad"))
        return np.column_stack([amplitude, lift, delta, preset])
