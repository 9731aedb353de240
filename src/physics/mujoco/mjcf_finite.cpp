// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// MuJoCo takes "nan" and "inf" for numbers. Its own lists of a model's numbers (mjxmacro.h) are gone through here, so that none is
// missed, but for what is
//   nobody's      users' data
//   worked out    of the others: what ends in 0 at qpos0, masses of subtrees, bounds
//   open          one side of a range may be inf
//   another's     the time step is judged where it is taken
#include <fmt/format.h>
#include <mujoco/mjxmacro.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "physics/mujoco/mjcf_file.hpp"

namespace vsa::physics {
namespace {

/// Whose numbers an array's are, by how its name begins.
struct Owner {
  std::string_view begins, element;
  int type;
};
constexpr std::array<Owner, 15> kOwners{{{"body_", "body", mjOBJ_BODY},
                                         {"jnt_", "joint", mjOBJ_JOINT},
                                         {"dof_", "joint", mjOBJ_JOINT},
                                         {"qpos", "joint", mjOBJ_JOINT},
                                         {"geom_", "geom", mjOBJ_GEOM},
                                         {"site_", "site", mjOBJ_SITE},
                                         {"cam_", "camera", mjOBJ_CAMERA},
                                         {"light_", "light", mjOBJ_LIGHT},
                                         {"mat_", "material", mjOBJ_MATERIAL},
                                         {"pair_", "pair", mjOBJ_PAIR},
                                         {"eq_", "equality", mjOBJ_EQUALITY},
                                         {"tendon_", "tendon", mjOBJ_TENDON},
                                         {"actuator_", "actuator", mjOBJ_ACTUATOR},
                                         {"sensor_", "sensor", mjOBJ_SENSOR},
                                         {"key_", "key", mjOBJ_KEY}}};

bool is_passed_over(std::string_view name) {
  constexpr std::array<std::string_view, 7> kParts{"user", "numeric_", "tuple_", "subtreemass", "lengthrange", "bound", "aabb"};
  const auto holds = [&](std::string_view part) { return name.find(part) != std::string_view::npos; };
  return (name.ends_with('0') && name != "qpos0") || name == "timestep" || std::any_of(kParts.begin(), kParts.end(), holds);
}

class Check {
 public:
  Check(const mjModel& m, const std::string& file, Problems& problems) : m_(m), file_(file), problems_(problems) {}

  void all() {
    // A field of mjOption is a number or an array of them.
#define X(type, name, ...) option(#name, m_.opt.name);
#define XVEC X
#ifdef MJOPTION_FIELDS
    MJOPTION_FIELDS
#else
    MJOPTION_FLOATS
    MJOPTION_INTS
#undef X
#define X(name, size) option(#name, m_.opt.name);
    MJOPTION_VECTORS
#endif
#undef X
#undef XVEC
#undef MJ_M
#define MJ_M(size) m_.size
#define X(type, name, rows, columns) array(#name, m_.name, static_cast<std::size_t>(m_.rows), static_cast<std::size_t>(columns));
    MJMODEL_POINTERS
#undef X
    // Of mjStatistic the solver takes that alone.
    if (const double mean = m_.stat.meaninertia; !std::isfinite(mean)) problem("statistic@meaninertia", mean);
  }

 private:
  /// The first number that is none.
  template <class Number>
  [[nodiscard]] static std::size_t first_wrong(std::string_view name, const Number* numbers, std::size_t count) {
    if constexpr (std::is_floating_point_v<Number>) {
      const bool open = name.ends_with("range");
      const auto wrong = [&](Number x) { return !std::isfinite(x) && !(open && std::isinf(x)); };
      if (!is_passed_over(name)) return static_cast<std::size_t>(std::find_if(numbers, numbers + count, wrong) - numbers);
    }
    return count;
  }

  void problem(std::string key, double value) {
    problems_.add({file_, std::move(key), std::isnan(value) ? "nan" : fmt::format("{}", value), "isn't finite", "finite numbers"});
  }

  template <class Number>
  void option(const char* name, const Number& value) {
    if (first_wrong(name, &value, 1) == 0) problem(std::string("option@") + name, static_cast<double>(value));
  }
  template <class Number, std::size_t N>
  void option(const char* name, const Number (&values)[N]) {
    if (const std::size_t at = first_wrong(name, values, N); at < N)
      problem(std::string("option@") + name, static_cast<double>(values[at]));
  }

  template <class Number>
  void array(std::string_view name, const Number* numbers, std::size_t rows, std::size_t columns) {
    const std::size_t at = first_wrong(name, numbers, rows * columns);
    if (at < rows * columns) problem(key_of(name, static_cast<int>(at / columns)), static_cast<double>(numbers[at]));
  }

  /// "body[upper]/pos" of a row of body_pos.
  [[nodiscard]] std::string key_of(std::string_view name, int row) const {
    const auto* const owner =
        std::find_if(kOwners.begin(), kOwners.end(), [&](const Owner& o) { return name.starts_with(o.begins); });
    if (owner == kOwners.end()) return fmt::format("{}[{}]", name, row);
    int id = owner->begins == "dof_" ? m_.dof_jntid[row] : row;
    if (owner->begins == "qpos")
      id = static_cast<int>(std::upper_bound(m_.jnt_qposadr, m_.jnt_qposadr + m_.njnt, row) - m_.jnt_qposadr) - 1;
    const char* own = mj_id2name(&m_, owner->type, id);
    const std::string called = own == nullptr ? fmt::format("number {}", id) : own;
    return fmt::format("{}[{}]/{}", owner->element, called,
                       name == "qpos0"         ? "ref"
                       : name == "qpos_spring" ? "springref"
                                               : name.substr(owner->begins.size()));
  }

  const mjModel& m_;
  const std::string& file_;
  Problems& problems_;
};

}  // namespace

void check_finite(const mjModel& model, const std::string& file, Problems& problems) { Check(model, file, problems).all(); }

}  // namespace vsa::physics
