// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/elastic/travel.hpp"

#include <utility>

#include "vsa/checks.hpp"

namespace vsa::elastic {

Travel::Travel(std::shared_ptr<const Transmission> law, const Leads& leads) noexcept
    : law_(std::move(law)),
      leads_(leads),
      h_{leads.input[0].value_or(1.0), leads.input[1].value_or(1.0)},
      rho_(leads.shaft.value_or(1.0)) {}

Positions Travel::own(const Positions& at) const noexcept { return {rho_ * at.q, {h_[0] * at.x[0], h_[1] * at.x[1]}}; }

Origin Travel::own(const Origin& at) const noexcept {
  Origin origin = at;
  origin.at = own(at.at);
  return origin;
}

Origin Travel::seen(Origin origin, const Positions& at) const noexcept {
  origin.at = at;
  return origin;
}

std::array<double, 2> Travel::loads(const std::array<double, 2>& own) const noexcept { return {h_[0] * own[0], h_[1] * own[1]}; }

Hessian Travel::curvature(Hessian c) const noexcept {
  c.qq *= rho_ * rho_;
  for (std::size_t i = 0; i < 2; ++i) c.qx[i] *= rho_ * h_[i];
  c.xx[0] *= h_[0] * h_[0];
  c.x0x1 *= h_[0] * h_[1];
  c.xx[1] *= h_[1] * h_[1];
  return c;
}

Response Travel::evaluate(const Positions& at) const noexcept {
  const Response r = law_->evaluate(own(at));
  return {r.energy, rho_ * r.torque, loads(r.load), curvature(r.curvature)};
}

double Travel::energy(const Positions& at) const noexcept { return law_->energy(own(at)); }

SegmentMean Travel::mean_over(const Positions& from, const Positions& to) const noexcept {
  const SegmentMean m = law_->mean_over(own(from), own(to));
  return {rho_ * m.torque, loads(m.load), curvature(m.slope)};
}

Origin Travel::origin(const Positions& at) const noexcept { return seen(law_->origin(own(at)), at); }

Origin Travel::moved(const Origin& from, const Positions& to) const noexcept { return seen(law_->moved(own(from), own(to)), to); }

SegmentMean Travel::mean_from(const Origin& from, const Positions& to, double ahead_rad) const noexcept {
  const SegmentMean m = law_->mean_from(own(from), own(to), rho_ * ahead_rad);
  return {rho_ * m.torque, loads(m.load), curvature(m.slope)};
}

Tangent Travel::tangent_of(const Origin& here) const noexcept {
  const Tangent t = law_->tangent_of(own(here));
  return {rho_ * rho_ * t.stiffness, {rho_ * t.tension[0], rho_ * t.tension[1]}};
}

double Travel::energy_of(const Origin& here) const noexcept { return law_->energy_of(own(here)); }

std::array<double, 2> Travel::signed_energies_of(const Origin& here) const noexcept { return law_->signed_energies_of(own(here)); }

std::array<double, 2> Travel::references(const EquilibriumPreset& command) const noexcept {
  const std::array<double, 2> x = law_->references({rho_ * command.equilibrium, command.preset});
  return {x[0] / h_[0], x[1] / h_[1]};
}

EquilibriumPreset Travel::attained(const std::array<double, 2>& x) const noexcept {
  const EquilibriumPreset own = law_->attained({h_[0] * x[0], h_[1] * x[1]});
  return {own.equilibrium / rho_, own.preset};
}

std::optional<EquilibriumPreset> Travel::command_exactly(double q, double torque, double stiffness) const noexcept {
  auto command = law_->command_exactly(rho_ * q, torque / rho_, stiffness / (rho_ * rho_));
  if (command) command->equilibrium /= rho_;
  return command;
}

int Travel::spring_count() const noexcept {
  const int springs = leads_.shaft ? 0 : law_->spring_count();
  for (int i = 0; i < springs; ++i)
    if (leads_.input[static_cast<std::size_t>(i)]) return 0;
  return springs;
}

std::array<double, 2> Travel::signed_energies(const Positions& at) const noexcept { return law_->signed_energies(own(at)); }

bool Travel::equals(const Transmission& other) const noexcept {
  const auto* same = dynamic_cast<const Travel*>(&other);
  return same != nullptr && same->leads_ == leads_ && law_->equals(*same->law_);
}

std::string_view Travel::input_unit(std::size_t input) const noexcept {
  return leads_.input[input] ? "rad" : law_->input_unit(input);
}

void Travel::validate(std::string_view where, Problems& problems) const {
  law_->validate(where, problems);
  Checks check(where, problems);
  for (std::size_t i = 0; i < 2; ++i) {
    if (!leads_.input[i]) continue;
    const std::string key = "lead_" + std::to_string(i + 1) + "_m_per_rad";
    check.positive(key, *leads_.input[i]);
    if (law_->input_unit(i) != "m")
      check.refuse(key, Checks::text(*leads_.input[i]), "this input of the law is an angle", "no lead");
  }
  if (!leads_.shaft) return;
  check.positive("pinion_m", *leads_.shaft);
  if (law_->shaft_unit() != "m") check.refuse("pinion_m", Checks::text(*leads_.shaft), "the law's shaft turns by itself", "none");
}

namespace {

std::shared_ptr<const Transmission> with(const std::shared_ptr<const Transmission>& law, auto&& change) {
  const auto* travel = dynamic_cast<const Travel*>(law.get());
  Leads leads = travel != nullptr ? travel->leads() : Leads{};
  change(leads);
  return std::make_shared<Travel>(travel != nullptr ? travel->law() : law, leads);
}

}  // namespace

std::string_view own_input_unit(const Transmission& law, std::size_t input) noexcept {
  const auto* travel = dynamic_cast<const Travel*>(&law);
  return (travel != nullptr ? *travel->law() : law).input_unit(input);
}

double shaft_per_pulley(const Transmission& law, std::size_t input) noexcept {
  const auto* travel = dynamic_cast<const Travel*>(&law);
  if (travel == nullptr) return 1.0;
  return travel->leads().input[input].value_or(1.0) / travel->leads().shaft.value_or(1.0);
}

std::shared_ptr<const Transmission> with_lead(const std::shared_ptr<const Transmission>& law, std::size_t input, double lead) {
  return with(law, [&](Leads& leads) { leads.input[input] = lead; });
}

std::shared_ptr<const Transmission> with_pinion(const std::shared_ptr<const Transmission>& law, double radius_m) {
  return with(law, [&](Leads& leads) { leads.shaft = radius_m; });
}

}  // namespace vsa::elastic
