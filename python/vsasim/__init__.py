# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""vsasim: robots built of variable stiffness actuators, from Python.

    import vsasim
    world = vsasim.World.load("bench_load")
    world.command("shaft", 1.0, 0.3)      # equilibrium and stiffness preset, rad
    world.run(2.0)
    print(world.read("shaft")["shaft_rad"])

SI units, which are at the end of names. The classes are those of the C++ library; docs/howto/python.md tells more.
"""
from . import _vsasim
from ._vsasim import (
    ActuatorType,
    Batch,
    Distribution,
    InputError,
    Linearization,
    OutputError,
    Pull,
    Recorder,
    SimulationError,
    Snapshot,
    Unit,
    UnitBatch,
    UnitSnapshot,
    World,
    WorldLinearization,
    __version__,
    log_uniform,
    normal,
    uniform,
)

for _class in (
    ActuatorType,
    Batch,
    Distribution,
    Linearization,
    Pull,
    Recorder,
    Snapshot,
    Unit,
    UnitBatch,
    UnitSnapshot,
    World,
    WorldLinearization,
):
    _class.__module__ = "vsasim"
del _class

from . import identify, study  # noqa: E402  (their functions come from the compiled part)

__all__ = [
    "ActuatorType",
    "Batch",
    "Distribution",
    "InputError",
    "Linearization",
    "OutputError",
    "Pull",
    "Recorder",
    "SimulationError",
    "Snapshot",
    "Unit",
    "UnitBatch",
    "UnitSnapshot",
    "World",
    "WorldLinearization",
    "identify",
    "log_uniform",
    "normal",
    "study",
    "uniform",
]
