// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What an actuator's numbers are shown in: {unit, scale from the recorded number to the shown one, digits}. The channels have the names of
// a turning shaft; a linear actuator's hold m and N.

const kAngle = { unit: '°', scale: 180 / Math.PI, digits: 1 };

const kTurning = {
  place: { title: 'Angle', ...kAngle },
  stiffness: { title: 'Stiffness', unit: 'N·m/rad', scale: 1, digits: 2 },
  load: { title: 'Torque', unit: 'N·m', scale: 1, digits: 3 },
  speed: { unit: 'rad/s', scale: 1, digits: 2 },
};
const kSliding = {
  place: { title: 'Position', unit: 'm', scale: 1, digits: 4 },
  stiffness: { title: 'Stiffness', unit: 'N/m', scale: 1, digits: 2 },
  load: { title: 'Force', unit: 'N', scale: 1, digits: 3 },
  speed: { unit: 'm/s', scale: 1, digits: 4 },
};

export const shaftUnits = (actuator) => (actuator.linear ? kSliding : kTurning);

/** Of the law or the torque servo: pulleys turn also where the shaft slides. No unit: no preset. */
export const presetUnit = ({ preset_unit: unit }) => (unit === 'rad' ? kAngle : { unit, scale: 1, digits: 3 });
