# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""A rollout: 64 states of a knee, each with a preset of its own, go on together on all processors.

The whole state of the units is in mjData.plugin_state, so mujoco.rollout takes it with positions and speeds. Run: python3 rollout.py.
Needs MuJoCo's Python package and vsasim's plug-in for it (docs/howto/mujoco.md).
"""
import os
import pathlib

import mujoco
import numpy as np
import vsasim.mujoco
from mujoco import rollout

STATES, STEPS = 64, 500

vsasim.mujoco.load()
model = mujoco.MjModel.from_xml_path(str(pathlib.Path(__file__).with_name("knee.xml")))
kind = mujoco.mjtState.mjSTATE_FULLPHYSICS
data = mujoco.MjData(model)
states = np.empty((STATES, mujoco.mj_stateSize(model, kind)))
presets = np.linspace(0, 0.6, STATES)
for state, preset in zip(states, presets):
    mujoco.mj_resetData(model, data)
    data.ctrl[:] = 0.4, preset
    mujoco.mj_step(model, data, 1000)
    mujoco.mj_getState(model, data, state, kind)

control = np.repeat(np.stack([np.full(STATES, 0.0), presets], axis=1)[:, None, :], STEPS, axis=1)  # back to 0
threads = [mujoco.MjData(model) for _ in range(os.cpu_count() or 1)]
_, sensors = rollout.rollout(model, threads, states, control)
deflection = np.abs(sensors[:, :, vsasim.mujoco.READINGS.index("deflection")]).max(axis=1)
for i in range(0, STATES, 21):
    print(f"preset {presets[i]:.2f} rad: up to {deflection[i]:.3f} rad off its equilibrium on the way back")
