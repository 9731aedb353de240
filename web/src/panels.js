// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Which curves there are. A line: [name, channel, dash]; `scale` takes the recorded unit to the shown one.

import { series } from './palette.js';

const kDegree = 180 / Math.PI;

export function actuatorPanels(actuators) {
  const units = [...new Set(actuators.map((a) => a.preset_unit))];
  const angle = units.length === 1 && units[0] === 'rad';
  const hasPreset = units.some((u) => u !== '');
  const twoMotors = actuators.some((a) => a.motors > 1);
  const panels = [
    {
      title: 'Shaft angle',
      unit: '°',
      scale: kDegree,
      digits: 1,
      lines: [
        ['shaft', 'shaft_rad', 'solid'],
        ['equilibrium', 'equilibrium_rad', 'dash'],
        ['commanded', 'equilibrium_command_rad', 'dot'],
      ],
    },
    {
      title: 'Stiffness preset',
      unit: angle ? '°' : units.join(', '),
      scale: angle ? kDegree : 1,
      digits: angle ? 1 : 3,
      lines: [
        ['attained', 'preset', 'solid'],
        ['commanded', 'preset_command', 'dot'],
      ],
    },
    { title: 'Stiffness', unit: 'N·m/rad', scale: 1, digits: 2, lines: [['stiffness', 'stiffness_Nm_per_rad', 'solid']] },
    { title: 'Torque on the shaft', unit: 'N·m', scale: 1, digits: 3, lines: [['torque', 'torque_Nm', 'solid']] },
    {
      title: twoMotors ? 'Motor currents' : 'Motor current',
      unit: 'A',
      scale: 1,
      digits: 3,
      lines: [['motor 1', 'current_1_A', 'solid'], ...(twoMotors ? [['motor 2', 'current_2_A', 'dash']] : [])],
    },
    { title: 'Shaft speed', unit: 'rad/s', scale: 1, digits: 2, lines: [['speed', 'shaft_speed_rad_per_s', 'solid']] },
  ];
  return hasPreset ? panels : panels.filter((p) => p.title !== 'Stiffness preset');
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

/** What a panel draws of these sources: [{label, color, dash, channel}]. */
export function linesOf(panel, sources) {
  const colors = series();
  return sources.flatMap((source) =>
    panel.lines.map(([label, channel, dash], i) => ({
      label: sources.length > 1 ? (panel.lines.length > 1 ? `${source.name} ${label}` : source.name) : label,
      // One source: a colour a line. Several: a colour a source, as on its chip.
      color: sources.length > 1 ? source.color : colors[i],
      dash,
      channel: source.data[channel],
    })),
  );
}
