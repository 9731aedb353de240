// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// vsa/elastic/two_sinh.hpp has the equations; these are its two sets of parameters.
#include "vsa/elastic/two_sinh.hpp"

#include "vsa/elastic/law.hpp"

namespace vsa::elastic {
namespace {

constexpr LawParameter kOwn[] = {
    {"k1_Nm", "N·m", 1e-9, 1e3, "torque scale of the spring to motor 1"},
    {"a1_per_rad", "1/rad", 1e-3, 100, "hardening rate of the spring to motor 1"},
    {"k2_Nm", "N·m", 1e-9, 1e3, "torque scale of the spring to motor 2"},
    {"a2_per_rad", "1/rad", 1e-3, 100, "hardening rate of the spring to motor 2"},
};
constexpr LawParameter kWithLinear[] = {
    {"k1_Nm", "N·m", 1e-9, 1e3, "torque scale of the spring to motor 1"},
    {"a1_per_rad", "1/rad", 1e-3, 100, "hardening rate of the spring to motor 1"},
    {"c1_Nm_per_rad", "N·m/rad", 0, 1e4, "linear part of the spring to motor 1"},
    {"k2_Nm", "N·m", 1e-9, 1e3, "torque scale of the spring to motor 2"},
    {"a2_per_rad", "1/rad", 1e-3, 100, "hardening rate of the spring to motor 2"},
    {"c2_Nm_per_rad", "N·m/rad", 0, 1e4, "linear part of the spring to motor 2"},
    {"linear_beyond_rad", "rad", 1e-3, 100, "deflection of a spring beyond which its torque follows its tangent"},
};

}  // namespace

extern const Law kTwoSinh{
    .name = "two_sinh",
    .title = "two hardening springs against each other",
    .equation = "H = Σ k/a (cosh(a δ) − 1),  δ = q − x",
    .source = "the qbmove's makers; the paper's eq. (1)",
    .parameters = kOwn,
    .make = [](std::span<const double> v) -> std::shared_ptr<const Transmission> {
      return std::make_shared<TwoSinh>(TwoSinhParams{.k_Nm = {v[0], v[2]}, .a_per_rad = {v[1], v[3]}});
    },
};

extern const Law kTwoSinhLinear{
    .name = "two_sinh_linear",
    .title = "the same with linear parts, straight beyond an edge",
    .equation = "H = Σ k/a (cosh(a δ) − 1) + c δ²/2,  along the tangent beyond δ = ±d",
    .source = "this project: what the recordings ask for (docs/validation.md)",
    .parameters = kWithLinear,
    .make = [](std::span<const double> v) -> std::shared_ptr<const Transmission> {
      return std::make_shared<TwoSinh>(
          TwoSinhParams{.k_Nm = {v[0], v[3]}, .a_per_rad = {v[1], v[4]}, .c_Nm_per_rad = {v[2], v[5]}, .linear_beyond_rad = v[6]});
    },
};

}  // namespace vsa::elastic
