// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "datasheet/datasheet.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "datasheet/gallery.hpp"
#include "datasheet/page.hpp"
#include "terminal/console.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/follow.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/numbers.hpp"
#include "terminal/output_files.hpp"
#include "terminal/step.hpp"
#include "terminal/table.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"

namespace vsa::app {
namespace {

constexpr const char* kDatasheetNotes =
    R"(One page: torque, speed, stiffness and energy from the law and the drive's parameters; how fast a step and a
change of stiffness are, from the benches as vsa characterize runs them. Each number says which.

Examples:
  vsa datasheet qbmove_maker_pro
  vsa datasheet qbmove_maker_pro --set drive.supply_V=24 --out at_24V.html
  vsa datasheet --all --out sheets                   # index.html: the gallery; comparison.html)";

/// Known before a minute's work, not after.
void check_writable(const std::filesystem::path& file) {
  const std::filesystem::path directory = file.has_parent_path() ? file.parent_path() : ".";
  if (!std::filesystem::is_directory(directory)) {
    throw InputError({"", "--out", file.string(), "its directory doesn't exist", "a file in a directory that exists"});
  }
  if (std::filesystem::is_directory(file)) throw InputError({"", "--out", file.string(), "is a directory", "a file"});
}

std::string command_of(const DatasheetOptions& o) {
  std::string out = "vsa datasheet " + shell_word(o.type);
  if (o.step_s) out += fmt::format(" --step-s {}", *o.step_s);
  for (const auto& s : o.set) out += " --set " + shell_word(s);
  return out;
}

template <class Results>
void tell_notices(const Results& results, Console& console) {
  for (const auto& r : results) {
    for (const std::string& notice : r.run.notices) console.line("warning: " + notice);
  }
}

}  // namespace

namespace {

int run_gallery(const DatasheetOptions& options) {
  const std::filesystem::path folder = options.out.empty() ? "datasheets" : options.out;
  (void)report::page_template();
  std::vector<study::DataSheet> plans;
  Problems problems;
  for (const std::string& name : config::TypeLibrary().names()) {
    try {
      experiment::Specimen specimen;
      specimen.type = name;
      specimen.step_s = options.step_s;
      plans.push_back(study::plan_data_sheet(specimen));
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  }
  problems.throw_if_any();
  if (plans.empty()) throw InputError({"", "--all", "", "no actuator types found", "set VSA_ACTUATOR_PATH or VSA_DATA_DIR"});
  make_directory(folder, "--out");
  catch_interrupts();
  Console console;
  const std::string step = options.step_s ? fmt::format(" --step-s {}", *options.step_s) : "";
  std::vector<study::DataSheet> sheets;
  for (study::DataSheet& plan : plans) {
    const std::string name = plan.computed.type.name;
    console.line(fmt::format("{} of {}: {}", sheets.size() + 1, plans.size(), name));
    auto done = study::run(std::move(plan), follow(console));
    console.wipe();
    if (!done) return kSignalled + interrupted();
    report::Report sheet = data_sheet_report(*done, "vsa datasheet " + name + step);
    sheet.links = {{"Gallery", kGalleryFile}, {"Comparison", kComparisonFile}};
    report::write_report(sheet, folder / sheet_file(*done));
    sheets.push_back(std::move(*done));
  }
  report::write_report(gallery_page(sheets, "vsa datasheet --all" + step), folder / kGalleryFile);
  sheets = comparable(std::move(sheets));
  report::write_report(comparison_page(sheets, "vsa datasheet --all" + step), folder / kComparisonFile);
  for (const report::Table& table : {strength_table(sheets), stiffness_range_table(sheets), holding_table(sheets)}) {
    std::vector<std::vector<std::string>> rows{table.head};
    rows.insert(rows.end(), table.rows.begin(), table.rows.end());
    std::cout << table.title << '\n' << table_text(rows, terminal_width()) << '\n';
  }
  std::cout << "written: " << (folder / kGalleryFile).string() << ", " << kComparisonFile << " and a sheet of each\n";
  return kDone;
}

}  // namespace

int run_datasheet(const DatasheetOptions& options) {
  check_step(options.step_s);
  if (options.all) return run_gallery(options);
  Console console;
  const std::filesystem::path file = options.out.empty() ? "datasheet_" + options.type + ".html" : options.out;
  experiment::Specimen specimen;
  specimen.type = options.type;
  specimen.overrides = config::parse_overrides(options.set, "--set");
  specimen.step_s = options.step_s;
  study::DataSheet plan = study::plan_data_sheet(specimen);
  check_writable(file);
  (void)report::page_template();
  catch_interrupts();
  const auto done = study::run(std::move(plan), follow(console));
  console.wipe();
  if (!done) return kSignalled + interrupted();
  const study::DataSheet& data = *done;
  tell_notices(data.simulated.speed, console);
  tell_notices(data.simulated.preset_step, console);
  report::write_report(data_sheet_report(data, command_of(options)), file);
  std::cout << data_sheet_text(data) << "written: " << file.string() << '\n';
  return kDone;
}

void setup_datasheet(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<DatasheetOptions>();
  CLI::App* sub = app.add_subcommand("datasheet", "Write a one-page data sheet of an actuator type");
  CLI::Option* type = sub->add_option("TYPE", options->type, "Actuator type, see vsa actuators");
  CLI::Option* all = sub->add_flag("--all", options->all, "Of every type, with a gallery and a page that compares them");
  sub->add_option("--step-s", options->step_s, "Simulated seconds per step; default 0.001, the benches' own")
      ->check(number_given());
  CLI::Option* set = sub->add_option("--set", options->set, "Override a parameter: key=value")->allow_extra_args(false);
  sub->add_option("--out", options->out, "File to write, with --all a directory; default: datasheet_TYPE.html, datasheets");
  all->excludes(type)->excludes(set);
  sub->footer(kDatasheetNotes);
  sub->callback([options, &exit_code] {
    if (options->type.empty() && !options->all)
      throw InputError({"", "TYPE", "", "is missing", "an actuator type, see vsa actuators; or --all"});
    exit_code = run_datasheet(*options);
  });
}

}  // namespace vsa::app
