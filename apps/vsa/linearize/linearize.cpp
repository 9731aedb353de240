// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "linearize/linearize.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>
#include <utility>

#include "linearize/page.hpp"
#include "terminal/console.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/numbers.hpp"
#include "terminal/output_files.hpp"
#include "vsa/config/find_file.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/output_file.hpp"

namespace vsa::app {
namespace {

constexpr const char* kLinearizeNotes =
    R"(Actuators at rest, and what small motions about that see: A, B, C, D, poles, impedance. Of a TYPE one unit on an inertia; of a
WORLD all joints that move with its actuators, as heavy as they are there, gravity included. Each joint stands where the world
begins or --at says, with the equilibrium that carries its weight or --equilibrium-of says.
  --firmware  frozen: the motors' voltages are inputs; averaged: the position loop in continuous time, its references are
              inputs; sampled: the same loop as it runs, every 1 or 2 ms
  --friction  sliding: dry friction left out; stuck: its presliding as springs, for motions that are smaller

Writes report.html with Bode plots and results.json with the matrices.

Examples:
  vsa linearize qbmove_maker_pro_6_1 --preset-rad 0.3 --inertia-kgm2 0.01
  vsa linearize qbmove_maker_pro_6_1 --at-rad 0.2 --preset-rad 0.3 --firmware frozen
  vsa linearize sea_example --load-Nm 0.5 --set drive.dead_band=0
  vsa linearize manipulator_3r --at joint_1=0.6 --at joint_2=0.4 --preset-rad 0.3)";

/// The library's words for what a flag gave.
constexpr std::array<std::pair<const char*, const char*>, 9> kFlags{{{"angle_rad", "--at-rad"},
                                                                     {"angles", "--at"},
                                                                     {"presets", "--preset-of"},
                                                                     {"equilibria_rad", "--equilibrium-of"},
                                                                     {"equilibrium_rad", "--equilibrium-rad"},
                                                                     {"preset", "--preset-rad"},
                                                                     {"load_Nm", "--load-Nm"},
                                                                     {"inertia_kgm2", "--inertia-kgm2"},
                                                                     {"damping_Nms_per_rad", "--damping-Nms-per-rad"}}};

linear::Firmware firmware_of(const LinearizeOptions& o) {
  for (const auto f : {linear::Firmware::frozen, linear::Firmware::averaged}) {
    if (o.firmware == study::word(f)) return f;
  }
  return linear::Firmware::sampled;
}

linear::DryFriction friction_of(const LinearizeOptions& o) {
  return o.friction == study::word(linear::DryFriction::stuck) ? linear::DryFriction::stuck : linear::DryFriction::sliding;
}

study::LinearizationOptions study_of(const LinearizeOptions& o) {
  study::LinearizationOptions out;
  out.specimen.type = o.target;
  out.specimen.overrides = config::parse_overrides(o.set, "--set");
  out.point = {o.equilibrium_rad.value_or(0), o.preset_rad.value_or(0), o.at_rad,
               o.load_Nm.value_or(0),         o.inertia_kgm2,           o.damping_Nms_per_rad.value_or(0)};
  out.firmware = firmware_of(o);
  out.friction = friction_of(o);
  return out;
}

/// The problems with the flags' names for the library's keys, alone or behind an actuator's.
[[noreturn]] void rethrow_with_flags(const InputError& error) {
  std::vector<Problem> problems = error.problems();
  for (Problem& p : problems) {
    for (const auto& [key, flag] : kFlags) {
      const std::string_view word = key;
      if (p.key == word) p.key = flag;
      if (p.key.size() > word.size() + 2 && p.key.ends_with(": " + std::string(word)))
        p.key.replace(p.key.size() - word.size(), word.size(), flag);
    }
  }
  throw InputError(std::move(problems));
}

linear_world::Named named(const std::vector<std::string>& texts, const char* flag, Problems& problems) {
  linear_world::Named out;
  for (const std::string& text : texts) {
    const std::size_t at = text.rfind('=');
    const auto value = at == std::string::npos ? std::nullopt : config::parse_number(text.substr(at + 1));
    const auto same = [&](const auto& before) { return before.first == text.substr(0, at); };
    if (value && at > 0 && std::any_of(out.begin(), out.end(), same)) {
      problems.add({"", flag, '"' + text + '"', text.substr(0, at) + " is named twice", "each name once"});
    } else if (value && at > 0) {
      out.emplace_back(text.substr(0, at), *value);
    } else {
      problems.add({"", flag, '"' + text + '"', "isn't a name and its number", "NAME=NUMBER, as elbow=0.3"});
    }
  }
  return out;
}

/// A flag that is for the other kind of target is an error, not left out.
void check_flags(const LinearizeOptions& o, bool world) {
  Problems problems;
  const auto refuse = [&](const char* flag, bool given) {
    if (given)
      problems.add({"", flag, "",
                    world ? "is for an actuator type, and " + o.target + " is a world"
                          : "is for a world, and " + o.target + " is an actuator type",
                    world ? "--at, --preset-of, --equilibrium-of" : "--at-rad, --preset-rad, --equilibrium-rad"});
  };
  if (world) {
    refuse("--at-rad", o.at_rad.has_value());
    refuse("--load-Nm", o.load_Nm.has_value());
    refuse("--equilibrium-rad", o.equilibrium_rad.has_value());
    refuse("--inertia-kgm2", o.inertia_kgm2.has_value());
    refuse("--damping-Nms-per-rad", o.damping_Nms_per_rad.has_value());
  } else {
    refuse("--at", !o.at.empty());
    refuse("--preset-of", !o.presets.empty());
    refuse("--equilibrium-of", !o.equilibria.empty());
    refuse("--type", !o.type.empty());
  }
  problems.throw_if_any();
}

bool is_type(const std::string& name) {
  const std::vector<std::string> types = config::TypeLibrary().names();
  return std::find(types.begin(), types.end(), name) != types.end();
}

/// Neither a type nor a world: both lists of what there is.
void check_target(const std::string& name) {
  try {
    (void)config::find_file(name, "world", "models/worlds", ".sdf");
  } catch (const InputError& no_world) {
    Problems problems;
    try {
      (void)config::TypeLibrary().load(name);
    } catch (const InputError& no_type) {
      for (const Problem& p : no_type.problems()) problems.add(p);
    }
    for (const Problem& p : no_world.problems()) problems.add(p);
    problems.throw_if_any();
  }
}

study::WorldLinearization world_of(const LinearizeOptions& o) {
  Problems problems;
  linear_world::WorldPoint point{named(o.at, "--at", problems), o.preset_rad, named(o.presets, "--preset-of", problems),
                                 named(o.equilibria, "--equilibrium-of", problems)};
  problems.throw_if_any();
  engine::WorldOptions with;
  if (!o.type.empty()) with.actuator.type = o.type;
  with.actuator.flag = "--set";
  with.actuator.overrides = config::parse_overrides(o.set, "--set");
  return study::linearize(engine::World::load(o.target, std::move(with)), point, firmware_of(o), friction_of(o));
}

/// The command again, with what was given.
std::string command_of(const LinearizeOptions& o) {
  std::string out = "vsa linearize " + shell_word(o.target);
  const auto put = [&out](const char* flag, const std::optional<double>& value) {
    if (value) out += fmt::format(" {} {}", flag, *value);
  };
  const auto put_all = [&out](const char* flag, const std::vector<std::string>& all) {
    for (const std::string& s : all) out += fmt::format(" {} {}", flag, shell_word(s));
  };
  put("--at-rad", o.at_rad);
  put("--load-Nm", o.load_Nm);
  put_all("--at", o.at);
  put("--preset-rad", o.preset_rad);
  put_all("--preset-of", o.presets);
  put("--equilibrium-rad", o.equilibrium_rad);
  put_all("--equilibrium-of", o.equilibria);
  put("--inertia-kgm2", o.inertia_kgm2);
  put("--damping-Nms-per-rad", o.damping_Nms_per_rad);
  out += " --firmware " + o.firmware + " --friction " + o.friction;
  if (!o.type.empty()) out += " --type " + shell_word(o.type);
  put_all("--set", o.set);
  return out;
}

template <class Linearization>
int write(const Linearization& l, const std::vector<std::string>& notices, const LinearizeOptions& options) {
  Console console;
  (void)report::page_template();
  for (const std::string& notice : notices) console.line("warning: " + notice);
  const std::filesystem::path out =
      options.out.empty() ? "linearize_" + std::filesystem::path(options.target).stem().string() : options.out;
  make_directory(out, "--out");
  const std::string command = command_of(options);
  write_whole(out / "results.json", study::to_json(l, command));
  report::write_report(linearization_report(l, command), out / "report.html");
  std::cout << linearization_text(l) << "written: " << (out / "report.html").string() << " and results.json\n";
  return kDone;
}

}  // namespace

int run_linearize(const LinearizeOptions& options) {
  const bool type = is_type(options.target);
  if (!type) check_target(options.target);
  check_flags(options, !type);
  try {
    if (type) {
      const study::Linearization l = study::linearize(study_of(options));
      return write(l, l.model.notices, options);
    }
    const study::WorldLinearization l = world_of(options);
    return write(l, l.world.model.notices, options);
  } catch (const InputError& error) {
    rethrow_with_flags(error);
  }
}

void setup_linearize(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<LinearizeOptions>();
  CLI::App* sub = app.add_subcommand("linearize", "Linearise an actuator type, or a world of them, about a point of rest");
  sub->add_option("TARGET", options->target,
                  "Actuator type (see vsa actuators), SDF, URDF or MJCF file, or a built-in world's name")
      ->required();
  auto* at =
      sub->add_option("--at-rad", options->at_rad, "The shaft's angle; default: where the load puts it")->check(number_given());
  sub->add_option("--load-Nm", options->load_Nm, "External torque on the shaft, about +q; default 0")
      ->check(number_given())
      ->excludes(at);
  sub->add_option("--at", options->at, "A world's joint or actuator and where it stands: JOINT=RAD; default: where it begins")
      ->allow_extra_args(false);
  sub->add_option("--preset-rad", options->preset_rad, "Stiffness preset, attained; default 0, a world's: as it begins")
      ->check(number_given());
  sub->add_option("--preset-of", options->presets, "That of a world's single actuator: ACTUATOR=PRESET")->allow_extra_args(false);
  sub->add_option("--equilibrium-of", options->equilibria,
                  "A world's actuator and its equilibrium: ACTUATOR=RAD; default: that which carries the weight")
      ->allow_extra_args(false);
  sub->add_option("--equilibrium-rad", options->equilibrium_rad, "Equilibrium, attained; default 0")->check(number_given());
  sub->add_option("--inertia-kgm2", options->inertia_kgm2, "Of all that the shaft turns; default: the type's flange")
      ->check(number_given());
  sub->add_option("--damping-Nms-per-rad", options->damping_Nms_per_rad, "Viscous friction of the load; default 0")
      ->check(number_given());
  sub->add_option("--firmware", options->firmware, "What the position loop does: frozen, averaged or sampled; default averaged")
      ->check(CLI::IsMember({"frozen", "averaged", "sampled"}));
  sub->add_option("--friction", options->friction, "Dry friction: sliding (left out) or stuck (its presliding); default sliding")
      ->check(CLI::IsMember({"sliding", "stuck"}));
  sub->add_option("--type", options->type, "Put this actuator type on every actuator of the world");
  sub->add_option("--set", options->set, "Override a parameter: key=value")->allow_extra_args(false);
  sub->add_option("--out", options->out, "Directory for the files; default: linearize_TARGET");
  sub->footer(kLinearizeNotes);
  sub->callback([options, &exit_code] { exit_code = run_linearize(*options); });
}

}  // namespace vsa::app
