// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The entries of the energy record, written once for energy.csv and the page.
#pragma once

#include <array>
#include <limits>
#include <string_view>

#include "vsa/record/run_data.hpp"

namespace vsa::record {

struct EnergyColumn {
  std::string_view name;  // without the unit, J
  double (*value)(const Sample&);
};

/// NaN where the simulator doesn't tell it: an empty cell.
inline double body(const Sample& sample, double scene::Energy::*entry) {
  return sample.bodies ? (*sample.bodies).*entry : std::numeric_limits<double>::quiet_NaN();
}

// "motor_kinetic" is the ledger's own kinetic energy (motors); "kinetic" is that of the bodies; "springs" are the description's own, of joints.
inline constexpr std::array<EnergyColumn, 24> kEnergyColumns{{
    {"supply", [](const Sample& s) { return s.ledger.supply; }},
    {"copper", [](const Sample& s) { return s.ledger.copper; }},
    {"bridge", [](const Sample& s) { return s.ledger.bridge; }},
    {"conversion", [](const Sample& s) { return s.ledger.conversion; }},
    {"viscous", [](const Sample& s) { return s.ledger.viscous; }},
    {"motor_friction", [](const Sample& s) { return s.ledger.motor_friction; }},
    {"shaft_friction", [](const Sample& s) { return s.ledger.shaft_friction; }},
    {"tendon_friction", [](const Sample& s) { return s.ledger.tendon_friction; }},
    {"delivered", [](const Sample& s) { return s.ledger.delivered; }},
    {"pending", [](const Sample& s) { return s.ledger.pending; }},
    {"integrator", [](const Sample& s) { return s.ledger.integrator; }},
    {"coupling", [](const Sample& s) { return s.ledger.coupling; }},
    {"motor_kinetic", [](const Sample& s) { return s.ledger.kinetic; }},
    {"magnetic", [](const Sample& s) { return s.ledger.magnetic; }},
    {"elastic", [](const Sample& s) { return s.ledger.elastic; }},
    {"bristle", [](const Sample& s) { return s.ledger.bristle; }},
    {"shaft_bristle", [](const Sample& s) { return s.ledger.shaft_bristle; }},
    {"tendon_bristle", [](const Sample& s) { return s.ledger.tendon_bristle; }},
    {"stored_at_start", [](const Sample& s) { return s.ledger.stored_at_start; }},
    {"supply_moved", [](const Sample& s) { return s.ledger.supply_moved; }},
    {"delivered_moved", [](const Sample& s) { return s.ledger.delivered_moved; }},
    {"kinetic", [](const Sample& s) { return body(s, &scene::Energy::kinetic); }},
    {"gravitational", [](const Sample& s) { return body(s, &scene::Energy::gravitational); }},
    {"springs", [](const Sample& s) { return body(s, &scene::Energy::springs); }},
}};

}  // namespace vsa::record
