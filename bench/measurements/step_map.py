# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""What a step resolves: the energy that a swing keeps over ten periods, over inertia, stiffness and length of the step.

Simulates one undamped spring between a held pulley and a free inertia, a cell each, with the shaft coupling that every host has
(docs/explanation/7-host.md). Bars: where the springs of shipped types are, from the softest preset to the stiffest, on their bare
flange and as joints of a robot. Needs Debian's python3-matplotlib. Run:

    PYTHONPATH=build/release/python python3 bench/measurements/step_map.py docs/figures/step-map.png
"""
import sys

import matplotlib
import numpy as np
import vsasim

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from matplotlib.colors import LinearSegmentedColormap  # noqa: E402

STEPS_S = (0.25e-3, 1e-3, 4e-3)
INERTIA, STIFFNESS = np.logspace(-5, -1, 33), np.logspace(-0.5, 3.5, 33)
LINES = {
    0.25: ("0.25: all is kept below", "-"),
    1.0: ("1: 4 % is left", "--"),
    2.0: ("2: a torque read at the step's start blows up above", ":"),
}
MARGINS = {"left": 0.06, "right": 0.97, "top": 0.94, "bottom": 0.26, "wspace": 0.06}
# Nothing but a spring: a pulley of 1e5 kg·m² stays where it is.
BARE = {"drive.gear_ratio": 1000, "drive.inertia_kgm2": 0.1, "drive.viscous_Nms_per_rad": 0, "drive.back_emf_Vs_per_rad": 0,
        "drive.friction_Nm": 0, "shaft.friction_Nm": 0, "physics.substep_max_s": 1e-3}  # fmt: skip


def energy_left(type, stiffness, inertia, step_s):
    """Part of the energy after ten periods (of three steps, where they are fewer) of a swing of 0.1 rad, both at q − dt/2·v, where the
    coupling has them."""
    unit = vsasim.Unit(type, powered=False)
    q, v = 0.1, 0.0
    for _ in range(max(3, round(20 * np.pi / np.sqrt(stiffness / inertia) / step_s))):
        v += step_s * unit.step(step_s, q, v, 1 / inertia) / inertia
        q += step_s * v
    return (stiffness * (q - step_s / 2 * v) ** 2 + inertia * v**2) / (stiffness * 0.1**2)


def bars():
    """(name, inertia, softest, stiffest) of springs that ship: on a type's bare flange, and with what a robot's joint has behind it."""

    def springs(name):
        type = vsasim.ActuatorType.load(name)
        return type, type.stiffness_Nm_per_rad(0.0, 0.0, [0.0, type.preset_max])

    for name, label in (("qbmove_maker_pro_6_1", "qbmove, bare flange"), ("qbmove_advanced", "advanced, bare flange")):
        type, ends = springs(name)
        yield label, type["shaft.inertia_kgm2"], *ends
    world = vsasim.World.load("manipulator_3r")
    behind = 1 / np.diag(np.linalg.inv(world.linearize(preset=0.0).mass))
    for info, inertia in zip(world.actuator_info(), behind):
        yield "manipulator, " + info["name"], inertia, *springs(info["type"])[1]


def main(file):
    figure, axes = pyplot.subplots(1, len(STEPS_S), figsize=(12, 5.2), sharey=True, gridspec_kw=MARGINS)
    colors = LinearSegmentedColormap.from_list("kept", ["#7f2704", "#fd8d3c", "#fee6ce", "#f7fbff", "#9ecae1"])
    shown = list(bars())
    for axis, step_s in zip(axes, STEPS_S):
        kept = np.empty((STIFFNESS.size, INERTIA.size))
        for i, stiffness in enumerate(STIFFNESS):
            type = vsasim.ActuatorType.load("sea_example", {**BARE, "elastic.stiffness_Nm_per_rad": float(stiffness)})
            kept[i] = [energy_left(type, stiffness, inertia, step_s) for inertia in INERTIA]
        if kept.max() > 1 + 1e-3:
            sys.exit(f"energy out of nothing: {kept.max()} at {step_s} s")
        picture = axis.pcolormesh(INERTIA, STIFFNESS, kept, cmap=colors, vmin=0, vmax=1, shading="nearest")
        for x, (_, line) in LINES.items():
            axis.plot(INERTIA, INERTIA * (x / step_s) ** 2, "k" + line, linewidth=1)
        for n, (name, inertia, soft, stiff) in enumerate(shown):
            axis.plot([inertia] * 2, [soft, stiff], "-o", color=f"C{n}", linewidth=6 if n == 0 else 2.5, markersize=4)
        axis.set(xscale="log", yscale="log", xlim=INERTIA[[0, -1]], ylim=STIFFNESS[[0, -1]], xticks=[1e-4, 1e-3, 1e-2])
        axis.set_xlabel("inertia behind the joint, kg·m²")
        axis.set_title(f"step {step_s * 1e3:g} ms")
    axes[0].set_ylabel("stiffness, N·m/rad")
    figure.colorbar(picture, ax=axes, label="energy left after ten periods", pad=0.02)
    handles = [pyplot.Line2D([], [], color="k", linestyle=line, label=f"ω·dt = {text}") for text, line in LINES.values()]
    handles += [pyplot.Line2D([], [], color=f"C{n}", marker="o", label=bar[0]) for n, bar in enumerate(shown)]
    figure.legend(handles=handles, loc="lower center", ncols=4, fontsize=8)
    figure.savefig(file, dpi=110)


if __name__ == "__main__":
    main(sys.argv[1])
