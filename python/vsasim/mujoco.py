# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Variable stiffness actuators in MuJoCo from 3.2 on: vsasim's plug-in from Python. docs/howto/mujoco.md tells of it.

    import mujoco
    import vsasim.mujoco

    spec = mujoco.MjSpec.from_file("arm.xml")
    vsasim.mujoco.attach(spec, "elbow", "qbmove_maker_pro_6_1")  # loads the plug-in, or says why there is none
    model = spec.compile()
    data = mujoco.MjData(model)
    data.ctrl[:] = 0.5, 0.3                                     # equilibrium and stiffness preset, rad

add() does the same to the text of an MJCF, and needs no MuJoCo.
"""
import ctypes
import dataclasses
import numbers
import os
import pathlib
import xml.etree.ElementTree as ElementTree
from typing import Any, Dict, List, Mapping, Optional, Union

import numpy as np

from . import ActuatorType

__all__ = ["PLUGIN", "READINGS", "Unit", "add", "attach", "library", "load"]

#: As a model names the plug-in.
PLUGIN = "vsasim.unit"

#: What a unit's sensor tells, in this order. SI units; of a linear actuator m and N instead of rad and N·m.
READINGS = (
    "ticks_1",
    "ticks_2",
    "ticks_shaft",
    "current_1_A",
    "current_2_A",
    "stiffness",
    "preset",
    "equilibrium",
    "deflection",
    "torque",
    "energy_supply_J",
    "energy_delivered_J",
    "energy_stored_J",
    "energy_lost_J",
)

_Number = Union[int, float]
_loaded: Dict[str, Any] = {}


def _folders() -> List[pathlib.Path]:
    """Where a build tree and an installation have libraries for others."""
    package = pathlib.Path(__file__).resolve().parent
    out = [package / "lib"]
    for up in list(package.parents)[:4]:  # a slice of parents itself needs Python 3.10
        out += [up / "lib" / "vsasim", up / "vsasim"]
        out += sorted(up.glob("*-linux-gnu*/vsasim"))
    given = os.environ.get("VSA_MUJOCO_PATH")
    return ([pathlib.Path(p) for p in given.split(os.pathsep) if p] if given else []) + out


def library(version: Optional[str] = None) -> str:
    """The plug-in's library for that version of MuJoCo; None: the one that Python has. $VSA_MUJOCO_PATH names folders that are
    searched first. ImportError: there is none, with the versions there are."""
    version = version or _version_of_python()
    name = f"libvsa-mujoco-{version}.so"
    folders = _folders()
    for folder in folders:
        if (folder / name).is_file():
            return str(folder / name)
    others = sorted({p.name[len("libvsa-mujoco-") : -len(".so")] for f in folders for p in f.glob("libvsa-mujoco-*.so")})
    raise ImportError(
        f"no plug-in for MuJoCo {version} here ({name}): "
        + (f"there is one for {', '.join(others)}: take that MuJoCo, or " if others else "")
        + f"build vsasim with -DVSA_MUJOCO3 (docs/howto/mujoco.md); $VSA_MUJOCO_PATH says where else to look"
    )


def _version_of_python() -> str:
    try:
        import mujoco
    except ImportError as error:
        raise ImportError("there is no MuJoCo for this Python: pip install mujoco, from 3.2 on") from error
    return mujoco.__version__


def load(version: Optional[str] = None) -> str:
    """Loads the plug-in for the MuJoCo that is loaded, so that models may name it; once is enough. Returns its file. `version`: of a
    MuJoCo that the program has loaded otherwise; None: Python's. ImportError: there is none, or it doesn't fit."""
    version = version or _version_of_python()
    if version in _loaded:
        return _loaded[version][0]
    path = library(version)
    try:
        plugin = ctypes.CDLL(path)
    except OSError as error:
        raise ImportError(f"{path}: {error}") from error
    plugin.vsa_mujoco_problem.restype = ctypes.c_char_p
    problem = plugin.vsa_mujoco_problem().decode()
    if problem:
        raise ImportError(problem)
    _loaded[version] = (path, plugin)
    return path


@dataclasses.dataclass
class Unit:
    """A unit as add() and attach() take it, and as the plug-in's `config` has it (docs/howto/mujoco.md)."""

    joint: str  #: it drives
    type: str  #: of actuator: a name, or with `controls` a file
    name: str = ""  #: of its instance, its sensor and its first actuator; the second is `name`_preset. Empty: the joint's
    override: Optional[Mapping[str, Union[bool, _Number, str]]] = None  #: values that replace the type's
    equilibrium: Optional[_Number] = None  #: where it begins
    preset: Optional[_Number] = None  #: with which it begins
    bus: Optional[str] = None  #: the line that it shares with others that name it
    id: Optional[int] = None  #: its id there
    faults: Optional[str] = None  #: "noise_rad=0.001 seed=3"
    controls: Optional[int] = None  #: how many actuators; None: as many as its type takes
    sensor: bool = True  #: it has one

    def __post_init__(self) -> None:
        self.name = self.name or self.joint
        if self.controls not in (None, 1, 2):
            raise ValueError(f"controls = {self.controls!r}: 1 or 2 (an actuator takes no other number)")

    def config(self) -> Dict[str, str]:
        """What its instance of the plug-in says."""
        given = {key: getattr(self, key) for key in ("type", "equilibrium", "preset", "bus", "id", "faults")}
        out = {key: _text(value) for key, value in given.items() if value is not None}
        if self.override:
            out["override"] = " ".join(f"{key}={_text(value)}" for key, value in self.override.items())
        return out

    def actuators(self) -> List[str]:
        """Their names, one a control. InputError: no such type; ValueError: a file, whose controls nobody told."""
        if self.controls is not None:
            endings = ["", "_preset"][: self.controls]
        elif "/" in self.type or self.type.endswith(".toml"):
            raise ValueError(
                f"{self.type!r} is a file: say how many controls it takes (controls=2: equilibrium and preset; 1: equilibrium)"
            )
        else:
            made = ActuatorType.load(self.type, {key: _text(value) for key, value in (self.override or {}).items()})
            if made.controller == "motor_voltages":
                endings = ["_motor_1", "_motor_2"][: len(made.reference_range_rad)]
            else:
                endings = ["", "_preset"] if made.preset_unit or made.controller == "torque_servo" else [""]
        return [f"{self.name}{ending}" for ending in endings]


def _text(value: Any) -> str:
    """As the plug-in reads it: NumPy's numbers without NumPy's names, which their repr() has."""
    if isinstance(value, str):
        return value
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    raise TypeError(f"{value!r} is neither a number, a bool nor a text")


def add(mjcf: str, joint: str, type: str, **more: Any) -> str:
    """An MJCF's text with a unit of that actuator type on a joint: an instance of vsasim.unit, its actuators and a sensor. `more`: the
    other members of Unit. ValueError: no such joint, or a unit of this name; InputError: no such type."""
    unit = Unit(joint, type, **more)
    root = ElementTree.fromstring(mjcf)
    if not any(j.get("name") == joint for j in root.iter("joint")):
        names = sorted({j.get("name") for j in root.iter("joint")} - {None})
        raise ValueError(f"no joint {joint!r} in the MJCF (there are {', '.join(names) or 'none with a name'})")
    if any(i.get("name") == unit.name for i in root.iter("instance")):
        raise ValueError(f"the MJCF has an instance {unit.name!r} already")

    def child(of: ElementTree.Element, tag: str, **attributes: str) -> ElementTree.Element:
        for found in of.findall(tag):
            if all(found.get(k) == v for k, v in attributes.items()):
                return found
        return ElementTree.SubElement(of, tag, attributes)

    instance = ElementTree.SubElement(child(child(root, "extension"), "plugin", plugin=PLUGIN), "instance", name=unit.name)
    for key, value in unit.config().items():
        ElementTree.SubElement(instance, "config", key=key, value=value)
    for name in unit.actuators():
        ElementTree.SubElement(child(root, "actuator"), "plugin", name=name, joint=joint, plugin=PLUGIN, instance=unit.name)
    if unit.sensor:
        ElementTree.SubElement(child(root, "sensor"), "plugin", name=unit.name, plugin=PLUGIN, instance=unit.name)
    return ElementTree.tostring(root, encoding="unicode")


def attach(spec: Any, joint: str, type: str, **more: Any) -> Any:
    """As add(), to a mujoco.MjSpec that isn't compiled yet, and load(). Returns the instance, whose `config` may be changed.
    RuntimeError: a MuJoCo whose MjSpec can't activate plug-ins (before 3.3.1): use add() there. ValueError: two units of one name.
    TypeError: no MjSpec."""
    if not hasattr(spec, "add_actuator"):
        raise TypeError(f"spec is no mujoco.MjSpec, but of the type {spec.__class__.__name__}")
    if not hasattr(spec, "activate_plugin"):
        raise RuntimeError("this MuJoCo's MjSpec can't activate plug-ins: vsasim.mujoco.add() works on the MJCF's text")
    import mujoco

    unit = Unit(joint, type, **more)
    names = unit.actuators()
    if any(p.name == unit.name for p in spec.plugins):
        raise ValueError(f"the spec has an instance {unit.name!r} already")
    load()
    spec.activate_plugin(PLUGIN)
    instance = spec.add_plugin(name=unit.name, plugin_name=PLUGIN, active=True)
    instance.config = unit.config()

    def of_instance(element: Any) -> None:
        element.plugin.name = unit.name
        element.plugin.plugin_name = PLUGIN
        element.plugin.active = True

    for name in names:
        of_instance(spec.add_actuator(name=name, trntype=mujoco.mjtTrn.mjTRN_JOINT, target=joint))
    if unit.sensor:
        of_instance(spec.add_sensor(name=unit.name, type=mujoco.mjtSensor.mjSENS_PLUGIN))
    return instance
