// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "terminal/completion.hpp"

#include <algorithm>
#include <sstream>

#include "vsa/config/actuator_type.hpp"
#include "vsa/config/find_file.hpp"

namespace vsa::app {
namespace {

using Words = std::vector<std::string>;

bool is_option(const std::string& word) { return word.size() > 1 && word[0] == '-' && (word[1] < '0' || word[1] > '9'); }

/// A shell may split "--gait=sidewind" at the sign, or not; here it is two words.
Words without_equals(const Words& given) {
  Words out;
  for (const std::string& word : given) {
    const std::size_t equals = word.find('=');
    if (word == "=" && !out.empty() && is_option(out.back())) {
      if (&word == &given.back()) out.emplace_back();
    } else if (is_option(word) && equals != std::string::npos) {
      out.push_back(word.substr(0, equals));
      out.push_back(word.substr(equals + 1));
    } else {
      out.push_back(word);
    }
  }
  return out;
}

/// Values of CLI::IsMember stand in the type's name: "TEXT:{scatter,equal}".
Words listed(const std::string& type) {
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return {};
  Words out;
  std::istringstream list(type.substr(open + 1, close - open - 1));
  for (std::string value; std::getline(list, value, ',');) out.push_back(value);
  return out;
}

Words values(const CLI::Option& option) {
  const std::string name = option.get_name();
  if (name == "TYPE" || name == "--type") return config::TypeLibrary().names();
  if (name == "WORLD") return config::built_in_files("models/worlds", ".sdf");
  if (name == "--fmu") {
    Words out = config::TypeLibrary().names();
    const Words worlds = config::built_in_files("models/worlds", ".sdf");
    out.insert(out.end(), worlds.begin(), worlds.end());
    return out;
  }
  if (name == "--gait") return config::built_in_files("models/gaits", ".toml");
  if (name == "--speed") return {"max"};
  return listed(option.get_type_name());
}

Words option_names(const CLI::App& app) {
  Words out;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) out.push_back("--" + name);
  }
  return out;
}

Words subcommand_names(const CLI::App& app) {
  Words out;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) out.push_back(sub->get_name());
  return out;
}

/// The option whose value comes next after these words, or the positional; null: none.
const CLI::Option* expected(const CLI::App& sub, const Words& before) {
  const CLI::Option* open = nullptr;
  int values_left = 0;
  std::size_t positionals = 0;
  for (const std::string& word : before) {
    if (is_option(word)) {
      const auto of_name = sub.get_options([&](const CLI::Option* o) { return o->check_name(word); });
      open = of_name.empty() ? nullptr : of_name.front();
      values_left = open == nullptr ? 0 : open->get_items_expected_max();
    } else if (values_left > 0) {
      --values_left;
    } else {
      ++positionals;
    }
  }
  if (values_left > 0) return open;
  const auto all = sub.get_options([](const CLI::Option* o) { return o->get_positional(); });
  if (all.empty()) return nullptr;
  if (positionals < all.size()) return all[positionals];
  return all.back()->get_items_expected_max() > 1 ? all.back() : nullptr;
}

Words candidates(const CLI::App& app, const Words& before, const std::string& last) {
  const auto name = std::find_if_not(before.begin(), before.end(), is_option);
  if (name == before.end()) return is_option(last) || last == "-" ? option_names(app) : subcommand_names(app);
  const auto named = app.get_subcommands([&](const CLI::App* any) { return any->check_name(*name); });
  if (named.empty()) return {};
  const CLI::App* sub = named.front();
  if (!last.empty() && last[0] == '-') return option_names(*sub);
  const CLI::Option* option = expected(*sub, {name + 1, before.end()});
  return option == nullptr ? Words{} : values(*option);
}

}  // namespace

Words complete(const CLI::App& app, Words words) {
  if (words.empty()) words.emplace_back();
  words = without_equals(words);
  const std::string last = words.back();
  words.pop_back();
  Words out;
  for (const std::string& candidate : candidates(app, words, last)) {
    if (candidate.compare(0, last.size(), last) == 0) out.push_back(candidate);
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace vsa::app
