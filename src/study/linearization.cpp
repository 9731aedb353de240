// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/study/linearization.hpp"

#include "vsa/page/json.hpp"
#include "vsa/page/sliding_keys.hpp"

namespace vsa::study {
namespace {

using page::Json;
using page::real;

constexpr double kSlowest_Hz = 0.01, kFastest_Hz = 1000;
constexpr int kPerDecade = 50, kPerDecadeOfWorld = 10;  // a world's are matrices

Json matrix(const Eigen::MatrixXd& m) {
  Json out = Json::array();
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    Json& row = out.emplace_back(Json::array());
    for (Eigen::Index j = 0; j < m.cols(); ++j) row.push_back(real(m(i, j) + 0.0));  // no −0
  }
  return out;
}

Json signals(const std::vector<linear::Signal>& all) {
  Json out = Json::array();
  for (const linear::Signal& s : all) out.push_back({{"name", s.name}, {"unit", s.unit}});
  return out;
}

Json point_json(const Linearization& l) {
  const linear::Model& m = l.model;
  const elastic::Transmission& law = *l.actuator.unit.actuator.transmission;
  const elastic::EquilibriumPreset attained = law.attained(m.rest.at.x);
  Json out{{"shaft_rad", real(m.rest.at.q)}, {"equilibrium_rad", real(attained.equilibrium)}};
  if (!law.preset_unit().empty()) out["preset_" + std::string(law.preset_unit())] = real(attained.preset);
  out["load_torque_Nm"] = real(m.rest.load_Nm);
  out["inertia_kgm2"] = real(m.inertia_kgm2);
  out["damping_Nms_per_rad"] = real(m.damping_Nms_per_rad);
  for (const auto& [key, values] :
       {std::pair{"pulley_rad", m.rest.at.x}, {"motor_V", m.rest.motor_V}, {"motor_A", m.rest.motor_A}}) {
    Json& each = out[key] = Json::array();
    for (int i = 0; i < law.motor_count(); ++i) each.push_back(real(values[i]));
  }
  return out;
}

Json responses_json(const std::vector<linear::Response>& all) {
  Json out;
  for (const char* key : {"frequency_Hz", "impedance_re_Nms_per_rad", "impedance_im_Nms_per_rad", "compliance_re_rad_per_Nm",
                          "compliance_im_rad_per_Nm", "actuator_stiffness_Nm_per_rad", "actuator_damping_Nms_per_rad"}) {
    out[key] = Json::array();
  }
  for (const linear::Response& r : all) {
    out["frequency_Hz"].push_back(real(r.frequency_Hz));
    out["impedance_re_Nms_per_rad"].push_back(real(r.impedance.real()));
    out["impedance_im_Nms_per_rad"].push_back(real(r.impedance.imag()));
    out["compliance_re_rad_per_Nm"].push_back(real(r.compliance.real()));
    out["compliance_im_rad_per_Nm"].push_back(real(r.compliance.imag()));
    out["actuator_stiffness_Nm_per_rad"].push_back(real(r.stiffness_Nm_per_rad));
    out["actuator_damping_Nms_per_rad"].push_back(real(r.damping_Nms_per_rad));
  }
  return out;
}

std::vector<double> frequencies(const linear::System& m, int per_decade) {
  std::vector<double> out = linear::logarithmic(kSlowest_Hz, kFastest_Hz, per_decade);
  while (m.period_s > 0 && !out.empty() && out.back() >= 0.5 / m.period_s) out.pop_back();
  return out;
}

Json head(const linear::System& m, const std::string& command, const char* kind, const std::string& name, std::string_view firmware,
          std::string_view friction) {
  Json out = page::results_head(command);
  out[kind] = name;
  out["firmware"] = std::string(firmware);
  out["friction"] = std::string(friction);
  if (m.period_s > 0) out["period_s"] = m.period_s;
  return out;
}

void put_system(Json& out, const linear::System& m) {
  out["states"] = signals(m.states);
  out["inputs"] = signals(m.inputs);
  out["outputs"] = signals(m.outputs);
  out["A"] = matrix(m.a);
  out["B"] = matrix(m.b);
  out["C"] = matrix(m.c);
  out["D"] = matrix(m.d);
}

Json pole_json(const linear::Pole& p) {
  return {{"re_per_s", real(p.s.real())},
          {"im_per_s", real(p.s.imag())},
          {"frequency_Hz", real(p.frequency_Hz)},
          {"damping_ratio", real(p.damping_ratio)}};
}

Json joints_json(const linear_world::WorldModel& w) {
  Json out = Json::array();
  for (std::size_t j = 0; j < w.model.bodies.joints.size(); ++j) {
    const linear::BodyJoint& joint = w.model.bodies.joints[j];
    const char* unit = joint.prismatic ? "_N" : "_Nm";
    out.push_back({{"name", joint.name},
                   {joint.prismatic ? "position_m" : "angle_rad", real(joint.angle)},
                   {std::string("gravity_torque") + unit, real(w.gravity_torque[j])},
                   {std::string("outside_torque") + unit, real(w.outside_torque[j])}});
  }
  return out;
}

Json units_json(const linear::RobotModel& m) {
  Json out = Json::array();
  for (const linear::RobotModel::UnitRest& u : m.units) {
    const Json stiffness{{"held_stiffness_Nm_per_rad", real(u.held_stiffness_Nm_per_rad)},
                         {"static_stiffness_Nm_per_rad", real(u.static_stiffness_Nm_per_rad)}};
    out.push_back({{"name", u.name}});
    out.back().update(m.bodies.joints[u.joint].prismatic ? page::sliding_keys(stiffness) : stiffness);
    for (const auto& [key, values] :
         {std::pair{"pulley_rad", u.rest.at.x}, {"motor_V", u.rest.motor_V}, {"motor_A", u.rest.motor_A}})
      for (int i = 0; i < u.motors; ++i) out.back()[key].push_back(real(values[i]));
  }
  return out;
}

Json responses_json(const std::vector<linear::RobotResponse>& all) {
  Json out;
  for (const char* key : {"frequency_Hz", "compliance_re_rad_per_Nm", "compliance_im_rad_per_Nm", "driving_point_re_Nms_per_rad",
                          "driving_point_im_Nms_per_rad"})
    out[key] = Json::array();
  for (const linear::RobotResponse& r : all) {
    out["frequency_Hz"].push_back(real(r.frequency_Hz));
    out["compliance_re_rad_per_Nm"].push_back(matrix(r.compliance.real()));
    out["compliance_im_rad_per_Nm"].push_back(matrix(r.compliance.imag()));
    Json &re = out["driving_point_re_Nms_per_rad"].emplace_back(Json::array()),
         &im = out["driving_point_im_Nms_per_rad"].emplace_back(Json::array());
    for (const std::complex<double> z : r.driving_point) {
      re.push_back(real(z.real()));
      im.push_back(real(z.imag()));
    }
  }
  return out;
}

/// Of each pole: the angle (of a joint or a motor) with the largest share.
std::vector<std::string> moves(const linear::System& m) {
  const Eigen::MatrixXcd shapes = linear::shapes(m);
  std::vector<std::string> out;
  for (Eigen::Index p = 0; p < shapes.cols(); ++p) {
    std::size_t best = 0;
    for (std::size_t i = 0; i < m.states.size(); ++i) {
      const bool angle = m.states[i].unit == "rad" || m.states[i].unit == "m";
      if (angle && std::abs(shapes(static_cast<Eigen::Index>(i), p)) > std::abs(shapes(static_cast<Eigen::Index>(best), p)))
        best = i;
    }
    out.push_back(m.states[best].name);
  }
  return out;
}

}  // namespace

std::string_view word(linear::Firmware f) noexcept {
  return f == linear::Firmware::frozen ? "frozen" : f == linear::Firmware::averaged ? "averaged" : "sampled";
}

std::string_view word(linear::DryFriction f) noexcept { return f == linear::DryFriction::sliding ? "sliding" : "stuck"; }

Linearization linearize(const LinearizationOptions& o) {
  Linearization out{o.specimen.library.load(o.specimen.type, o.specimen.overrides), o.firmware, o.friction, {}, {}, {}};
  out.model = linear::linearize(out.actuator.unit, o.point, o.firmware, o.friction);
  out.poles = linear::poles(out.model);
  for (const double f : frequencies(out.model, kPerDecade)) out.responses.push_back(linear::response(out.model, f));
  return out;
}

WorldLinearization linearize(const engine::World& world, const linear_world::WorldPoint& point, linear::Firmware firmware,
                             linear::DryFriction friction) {
  WorldLinearization out{world.name(), firmware, friction, linear_world::linearize(world, point, firmware, friction), {}, {}, {}};
  out.poles = linear::poles(out.world.model);
  out.moves = moves(out.world.model);
  for (const double f : frequencies(out.world.model, kPerDecadeOfWorld))
    out.responses.push_back(linear::response(out.world.model, f));
  return out;
}

std::string to_json(const Linearization& l, const std::string& command) {
  const linear::Model& m = l.model;
  Json out = head(m, command, "type", l.actuator.name, word(l.firmware), word(l.friction));
  const bool slides = l.actuator.unit.actuator.linear();
  const auto told = [slides](const Json& values) { return slides ? page::sliding_keys(values) : values; };
  const auto key = [slides](const char* name) { return slides ? sliding(name) : std::string(name); };
  out["point"] = told(point_json(l));
  out["notices"] = m.notices;
  out[key("held_stiffness_Nm_per_rad")] = real(m.held_stiffness_Nm_per_rad);
  out[key("static_stiffness_Nm_per_rad")] = real(m.static_stiffness_Nm_per_rad);
  put_system(out, m);
  Json& poles = out["poles"] = Json::array();
  for (const linear::Pole& p : l.poles) poles.push_back(pole_json(p));
  out["response"] = told(responses_json(l.responses));
  return page::results_text(out);
}

std::string to_json(const WorldLinearization& l, const std::string& command) {
  const linear::RobotModel& m = l.world.model;
  Json out = head(m, command, "world", l.name, word(l.firmware), word(l.friction));
  out["joints"] = joints_json(l.world);
  out["actuators"] = units_json(m);
  out["notices"] = m.notices;
  out["mass_matrix"] = matrix(m.bodies.mass);
  out["gravity_stiffness"] = matrix(m.bodies.gravity_stiffness);
  out["held_stiffness"] = matrix(m.held_stiffness);
  out["static_stiffness"] = matrix(m.static_stiffness);
  put_system(out, m);
  Json& poles = out["poles"] = Json::array();
  for (std::size_t i = 0; i < l.poles.size(); ++i) {
    poles.push_back(pole_json(l.poles[i]));
    poles.back()["moves"] = l.moves[i];
  }
  // Where joints of both kinds are, a matrix has m and N in the rows and columns of those that slide.
  const auto& joints = m.bodies.joints;
  const bool slide = std::all_of(joints.begin(), joints.end(), [](const linear::BodyJoint& j) { return j.prismatic; });
  out["response"] = slide ? page::sliding_keys(responses_json(l.responses)) : responses_json(l.responses);
  return page::results_text(out);
}

}  // namespace vsa::study
