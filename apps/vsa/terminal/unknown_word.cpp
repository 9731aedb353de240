// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "terminal/unknown_word.hpp"

#include <algorithm>

#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"

namespace vsa::app {
namespace {

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

}  // namespace

void refuse_unknown_command(const CLI::App& app, const std::vector<std::string>& arguments,
                            const std::vector<std::string>& left_out) {
  if (arguments.empty() || arguments.front().empty() || arguments.front().front() == '-') return;
  const std::vector<std::string> known = commands_of(app);
  if (std::find(known.begin(), known.end(), arguments.front()) != known.end()) return;
  const std::string& word = arguments.front();
  if (std::find(left_out.begin(), left_out.end(), word) != left_out.end()) {
    throw InputError(
        {"", word, "", "not in this build, which was made for a first run; `make` builds every command", config::join(known)});
  }
  throw InputError({"", word, "", "no such command" + config::did_you_mean(word, known), config::join(known)});
}

void refuse_unexpected(const CLI::App& app) {
  for (const CLI::App* command : app.get_subcommands()) {
    const std::vector<std::string> words = command->remaining(true);
    if (words.empty()) continue;
    const auto is_option = [](const std::string& word) { return word.size() > 1 && word.front() == '-'; };
    const auto option = std::find_if(words.begin(), words.end(), is_option);
    const std::string help = "what vsa " + command->get_name() + " --help lists";
    if (option == words.end()) throw InputError({command->get_name(), words.front(), "", "one word too many", help});
    const std::string name = option->substr(0, option->find('='));
    throw InputError({command->get_name(), name, "", "no such option" + config::did_you_mean(name, options_of(*command)), help});
  }
}

void refuse_unreadable(const CLI::App& app, const CLI::ConversionError& error) {
  const std::string what = error.what();
  for (const CLI::App* command : app.get_subcommands()) {
    for (const CLI::Option* option : command->get_options()) {
      const std::string begin = "Could not convert: " + option->get_name() + " = ";
      if (what.compare(0, begin.size(), begin) != 0) continue;
      const bool whole = option->get_type_name().compare(0, 5, "FLOAT") != 0;
      const std::string kind = whole ? "a whole number" : "a number";
      throw InputError({"", option->get_name(), what.substr(begin.size()), "isn't " + kind, kind});
    }
  }
}

}  // namespace vsa::app
