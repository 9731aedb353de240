// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Which curves there are. A line: [name, channel, dash]; `scale` takes the recorded unit to the shown one.

import { series } from './palette.js';
import { presetUnit, shaftUnits } from './units.js';

/** Actuators by what `key` tells of them: [[key, actuators], …]. */
function groups(actuators, key) {
  const out = new Map();
  for (const a of actuators) out.set(key(a), [...(out.get(key(a)) ?? []), a]);
  return [...out];
}

/** What has different units has panels of its own, which say in `of` whose curves they draw. */
export function actuatorPanels(actuators) {
  if (!actuators.length) return [];
  const shafts = groups(actuators, shaftUnits);
  const presets = groups(actuators.filter((a) => a.preset_unit !== ''), (a) => a.preset_unit);
  const twoMotors = actuators.some((a) => a.motors > 1);
  return [
    ...shafts.map(([{ place }, of]) => ({
      ...place,
      title: `Shaft ${place.title.toLowerCase()}`,
      of,
      lines: [
        ['shaft', 'shaft_rad', 'solid'],
        ['equilibrium', 'equilibrium_rad', 'dash'],
        ['commanded', 'equilibrium_command_rad', 'dot'],
      ],
    })),
    ...presets.map(([, of]) => ({
      ...presetUnit(of[0]),
      title: 'Stiffness preset',
      of,
      lines: [
        ['attained', 'preset', 'solid'],
        ['commanded', 'preset_command', 'dot'],
      ],
    })),
    ...shafts.map(([{ stiffness }, of]) => ({
      ...stiffness,
      title: 'Stiffness',
      of,
      lines: [['stiffness', 'stiffness_Nm_per_rad', 'solid']],
    })),
    ...shafts.map(([{ load }, of]) => ({
      ...load,
      title: `${load.title} on the shaft`,
      of,
      lines: [[load.title.toLowerCase(), 'torque_Nm', 'solid']],
    })),
    {
      title: twoMotors ? 'Motor currents' : 'Motor current',
      unit: 'A',
      scale: 1,
      digits: 3,
      lines: [['motor 1', 'current_1_A', 'solid'], ...(twoMotors ? [['motor 2', 'current_2_A', 'dash']] : [])],
    },
    ...shafts.map(([{ speed }, of]) => ({
      ...speed,
      title: 'Shaft speed',
      of,
      lines: [['speed', 'shaft_speed_rad_per_s', 'solid']],
    })),
  ];
}

/** Of the channels of a run's energies; those that its simulator doesn't tell are no numbers. */
export function energyPanels(energy) {
  const panels = [
    {
      title: 'From the supply',
      unit: 'J',
      scale: 1,
      digits: 1,
      lines: [
        ['supply', 'supply', 'solid'],
        ['given to the robot', 'delivered', 'dash'],
        ['motor constants', 'conversion', 'dot'], // (K_b − K_τ)∫Iω dt: see actuator/ledger.hpp
      ],
    },
    {
      title: 'Turned to heat',
      unit: 'J',
      scale: 1,
      digits: 1,
      lines: [
        ['copper', 'copper', 'solid'],
        ['bridge', 'bridge', 'longdashdot'],
        ['gear friction', 'motor_friction', 'dash'],
        ['viscous', 'viscous', 'dot'],
        ['shaft friction', 'shaft_friction', 'dashdot'],
        ['tendon friction', 'tendon_friction', 'longdash'],
      ],
    },
    { title: 'Stored in the springs', unit: 'J', scale: 1, digits: 3, lines: [['elastic', 'elastic', 'solid']] },
    { title: 'Motion of the bodies', unit: 'J', scale: 1, digits: 3, lines: [['kinetic', 'kinetic', 'solid']] },
    { title: 'Height of the bodies', unit: 'J', scale: 1, digits: 3, lines: [['gravitational', 'gravitational', 'solid']] },
  ];
  return panels.filter((p) => p.lines.every(([, channel]) => !Number.isNaN(energy[channel][0])));
}

/** What a panel draws of these sources, which are all that is chosen: [{label, color, dash, channel}]. */
export function linesOf(panel, sources) {
  const colors = series();
  const drawn = panel.of ? sources.filter((source) => panel.of.includes(source.actuator)) : sources;
  return drawn.flatMap((source) =>
    panel.lines.map(([label, channel, dash], i) => ({
      label: sources.length > 1 ? (panel.lines.length > 1 ? `${source.name} ${label}` : source.name) : label,
      // One source: a colour a line. Several: a colour a source, as on its chip.
      color: sources.length > 1 ? source.color : colors[i],
      dash,
      channel: source.data[channel],
    })),
  );
}
