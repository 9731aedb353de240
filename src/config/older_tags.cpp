// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "config/older_tags.hpp"

#include <algorithm>
#include <iterator>

namespace vsa::config {
namespace {

constexpr std::string_view kViscous = "drive.viscous_Nms_per_rad, friction alone";
constexpr std::string_view kViscousWhy =
    "the toolbox's damping stands for friction and back-EMF together; here the motor's own back-EMF damps it by K_tau K_b / R";
constexpr std::string_view kTorqueKeys = "drive.supply_V, drive.resistance_Ohm and drive.torque_constant_Nm_per_A";
constexpr std::string_view kTorqueWhy = "the motor's torque is limited by its voltage here, not by a number";
constexpr std::string_view kSpeedKeys = "drive.back_emf_Vs_per_rad and drive.supply_V";
constexpr std::string_view kSpeedWhy = "the toolbox reads it and never uses it; here the no-load speed follows from the back-EMF";
constexpr std::string_view kLow = "leave it out for no stop; firmware.limit_low_raw limits the reference";
constexpr std::string_view kHigh = "leave it out for no stop; firmware.limit_high_raw limits the reference";
constexpr std::string_view kLimitWhy = "was a stop of the motor's angle; the unit has a limit of its reference, of both motors";
constexpr std::string_view kGainP = "firmware.kp_pct_per_tick, see docs/howto/migration.md for the arithmetic";
constexpr std::string_view kGainI = "firmware.ki_pct_per_tick, see docs/howto/migration.md for the arithmetic";
constexpr std::string_view kGainD = "firmware.kd_pct_per_tick, see docs/howto/migration.md for the arithmetic";
constexpr std::string_view kGainWhy = "was a torque in N·m a rad; the unit's firmware gives a voltage, in % PWM a tick";
constexpr std::string_view kLever = "the type awas_2_example and its elastic.… (law lever_pivot), see docs/reference/config.md";
constexpr std::string_view kLeverWhy = "the AwAS-II's lever is a law with its own names and a start of its own here";
constexpr std::string_view kExponential = "the type bavs_example and its elastic.… (law two_exp), see docs/reference/config.md";
constexpr std::string_view kExponentialWhy = "the BAVS's springs are a law here, with the products of the toolbox's numbers";
constexpr std::string_view kPublishWhy = "nothing is switched on for a topic here: a state is published while somebody listens";
constexpr std::string_view kModeWhy =
    "the unit takes equilibrium and preset here, the toolbox's mode 6, and moves its motors to them";
constexpr std::string_view kMode =
    "6, or leave it out; for mode 5 publish equilibrium = (ref_1 + ref_2)/2 and preset = (ref_1 - ref_2)/2";

constexpr OlderTag kTags[] = {
    {"spring_k1", Meaning::same, "elastic.k1_Nm", "", ""},
    {"spring_a1", Meaning::same, "elastic.a1_per_rad", "", ""},
    {"spring_k2", Meaning::same, "elastic.k2_Nm", "", ""},
    {"spring_a2", Meaning::same, "elastic.a2_per_rad", "", ""},
    {"spring_k", Meaning::same, "elastic.stiffness_Nm_per_rad", "", ""},
    {"stiffness", Meaning::same, "elastic.stiffness_Nm_per_rad", "", ""},
    {"max_def", Meaning::another, "", "the springs' torque doesn't saturate here; it goes on growing",
     "leave it out, or the law two_sinh_linear with elastic.linear_beyond_rad"},
    {"mot_J", Meaning::of_both_motors, "drive.inertia_kgm2", "", ""},
    {"mot_1_J", Meaning::of_both_motors, "drive.inertia_kgm2", "", ""},
    {"mot_2_J", Meaning::of_both_motors, "drive.inertia_kgm2", "", ""},
    {"mot_tauFric", Meaning::friction_of_both_motors, "drive.friction_Nm", "", ""},
    {"mot_1_tauFric", Meaning::friction_of_both_motors, "drive.friction_Nm", "", ""},
    {"mot_2_tauFric", Meaning::friction_of_both_motors, "drive.friction_Nm", "", ""},
    {"mot_D", Meaning::another, "", kViscousWhy, kViscous},
    {"mot_1_D", Meaning::another, "", kViscousWhy, kViscous},
    {"mot_2_D", Meaning::another, "", kViscousWhy, kViscous},
    {"mot_tauMax", Meaning::another, "", kTorqueWhy, kTorqueKeys},
    {"mot_1_tauMax", Meaning::another, "", kTorqueWhy, kTorqueKeys},
    {"mot_2_tauMax", Meaning::another, "", kTorqueWhy, kTorqueKeys},
    {"mot_maxVel", Meaning::another, "", kSpeedWhy, kSpeedKeys},
    {"mot_1_maxVel", Meaning::another, "", kSpeedWhy, kSpeedKeys},
    {"mot_2_maxVel", Meaning::another, "", kSpeedWhy, kSpeedKeys},
    {"mot_minPos", Meaning::angle_limit, "firmware.limit_low_raw", kLimitWhy, kLow},
    {"mot_1_minPos", Meaning::angle_limit, "firmware.limit_low_raw", kLimitWhy, kLow},
    {"mot_2_minPos", Meaning::angle_limit, "firmware.limit_low_raw", kLimitWhy, kLow},
    {"mot_maxPos", Meaning::angle_limit, "firmware.limit_high_raw", kLimitWhy, kHigh},
    {"mot_1_maxPos", Meaning::angle_limit, "firmware.limit_high_raw", kLimitWhy, kHigh},
    {"mot_2_maxPos", Meaning::angle_limit, "firmware.limit_high_raw", kLimitWhy, kHigh},
    {"ctrl_P", Meaning::another, "", kGainWhy, kGainP},
    {"ctrl_1_P", Meaning::another, "", kGainWhy, kGainP},
    {"ctrl_2_P", Meaning::another, "", kGainWhy, kGainP},
    {"ctrl_I", Meaning::another, "", kGainWhy, kGainI},
    {"ctrl_1_I", Meaning::another, "", kGainWhy, kGainI},
    {"ctrl_2_I", Meaning::another, "", kGainWhy, kGainI},
    {"ctrl_D", Meaning::another, "", kGainWhy, kGainD},
    {"ctrl_1_D", Meaning::another, "", kGainWhy, kGainD},
    {"ctrl_2_D", Meaning::another, "", kGainWhy, kGainD},
    {"spring_Ks", Meaning::another, "", kLeverWhy, kLever},
    {"spring_l_0", Meaning::another, "", kLeverWhy, kLever},
    {"spring_L", Meaning::another, "", kLeverWhy, kLever},
    {"spring_r_t", Meaning::another, "", kLeverWhy, kLever},
    {"spring_a", Meaning::another, "", kExponentialWhy, kExponential},
    {"spring_b", Meaning::another, "", kExponentialWhy, kExponential},
    {"spring_k_e", Meaning::another, "", kExponentialWhy, kExponential},
    {"operation_mode", Meaning::mode, "", kModeWhy, kMode},
    {"control_type", Meaning::another, "", kModeWhy,
     "leave it out; for type 0 publish equilibrium = (ref_1 + ref_2)/2 and preset = (ref_1 - ref_2)/2"},
    {"pub_eltau", Meaning::another, "", kPublishWhy,
     "leave it out; /model/M/vsa/joint_state has the springs' torque on motors and shaft"},
    {"pub_state", Meaning::another, "", kPublishWhy, "leave it out; /model/M/vsa/joint_state"},
    {"sub_ext_tau", Meaning::another, "", "an external torque isn't a command to an actuator here",
     "leave it out; apply it to the link, as the simulator offers it"},
    {"namespace", Meaning::another, "", "topics are named after the model here", "leave it out; /model/M/…"},
};

}  // namespace

const OlderTag* find_older_tag(std::string_view name) noexcept {
  const auto* at = std::find_if(std::begin(kTags), std::end(kTags), [name](const OlderTag& t) { return t.name == name; });
  return at == std::end(kTags) ? nullptr : at;
}

}  // namespace vsa::config
