// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What can be set of the copies of a world: who has which keys, what each is at first, and how a copy's parameters are made of it.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "vsa/batch/spread.hpp"
#include "vsa/engine/world.hpp"

namespace vsa::batch {

/// The parameters of one copy. Several copies share one World::Parameters as long as they are alike.
struct CopyParameters {
  std::shared_ptr<const engine::World::Parameters> of;
  std::vector<double> inertia_factor;  ///< by link; empty: all 1
};

/// One value of one actuator or link.
struct Change {
  std::size_t owner = 0;  ///< into World::actuators(), or World::links() where the key is a link's
  const std::string* key = nullptr;
  std::variant<double, std::string> value;
};

class ParameterBook {
 public:
  explicit ParameterBook(const engine::World& world);

  [[nodiscard]] const CopyParameters& first() const noexcept { return first_; }
  [[nodiscard]] static bool is_of_links(std::string_view key) noexcept { return key.rfind("link.", 0) == 0; }
  /// Those that `who` names and that have the key; InputError: nobody.
  [[nodiscard]] std::vector<std::size_t> owners(const engine::World& world, const std::string& who, const std::string& key);
  [[nodiscard]] std::string owner_name(const engine::World& world, std::string_view key, std::size_t owner) const;

  /// NaN: an optional one that isn't given. A word: its place among the words.
  [[nodiscard]] double number(const engine::World& world, const CopyParameters& copy, std::size_t owner, const std::string& key);
  [[nodiscard]] std::string text(const engine::World& world, const CopyParameters& copy, std::size_t owner, const std::string& key);
  /// What a draw multiplies: of a second motor that is as the first, that one's. InputError: there is none.
  [[nodiscard]] double nominal(const engine::World& world, std::size_t owner, const std::string& key);
  /// What a draw for it is set as; InputError for a word or a switch.
  [[nodiscard]] double rounded(const engine::World& world, std::size_t owner, const std::string& key, double value);

  /// `copy` with changes to owners that owners() gave. Throws InputError, whose keys begin with "NAME: ". Several threads may, each with
  /// a World of its own.
  [[nodiscard]] CopyParameters with(const engine::World& world, const CopyParameters& copy,
                                    const std::vector<Change>& changes) const;

 private:
  /// Of an actuator, made once for all with the same type and the same values put into it.
  struct Kind {
    config::TypeFile file;
    std::vector<config::Entry> entries;
    std::string refusal;  ///< why nothing can be set; empty: it can
  };
  const Kind& kind(const engine::World& world, std::size_t actuator);
  [[nodiscard]] const config::Entry* entry(const engine::World& world, std::size_t actuator, const std::string& key);
  [[nodiscard]] bool has(const engine::World& world, std::size_t owner, const std::string& key);
  [[noreturn]] void refuse_unknown(const engine::World& world, std::size_t actuator, const std::string& key, const std::string& of);
  using Law = std::shared_ptr<const elastic::Transmission>;
  [[nodiscard]] static std::vector<config::Override> values_with(const host::ActuatorConfig& now, const Kind& kind,
                                                                 const std::vector<const Change*>& changes);
  [[nodiscard]] static host::ActuatorConfig remade(host::ActuatorConfig now, const Kind& kind,
                                                   const std::vector<config::Override>& values, const Law& at_first);
  void change_actuators(const engine::World& world, const CopyParameters& copy, const std::vector<Change>& changes,
                        engine::ParameterChanges& out, Problems& problems) const;
  void change_links(const engine::World& world, const std::vector<Change>& changes, CopyParameters& copy,
                    engine::ParameterChanges& out, Problems& problems) const;

  CopyParameters first_;
  std::map<std::string, std::shared_ptr<const Kind>> known_;  ///< by type and values
  std::vector<std::shared_ptr<const Kind>> kinds_;            ///< of an actuator; null: nobody asked yet
  std::vector<engine::LinkHandle> links_;
};

}  // namespace vsa::batch
