// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "identify/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <iostream>
#include <thread>

#include "identify/compare_output.hpp"
#include "terminal/console.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/output_files.hpp"
#include "terminal/table.hpp"
#include "vsa/errors.hpp"
#include "vsa/experiment/parallel.hpp"

namespace vsa::app {
namespace {

namespace fs = std::filesystem;

std::string command_of(const CompareOptions& o) {
  std::string out = "vsa identify --compare " + o.file;
  if (!o.out.empty()) out += " --out " + o.out;
  return out;
}

/// How many fits at once, and on how many threads each.
struct Share {
  unsigned fits, threads;
};
Share share(int jobs, std::size_t fits) {
  const unsigned machine = std::max(1u, std::thread::hardware_concurrency());
  const auto most = static_cast<unsigned>(std::max<std::size_t>(1, fits));
  const unsigned wanted = std::min(jobs > 0 ? static_cast<unsigned>(jobs) : machine, most);
  return {wanted, std::max(1u, machine / wanted)};
}

/// The fits that aren't in `fits` yet, each written when it is done.
void fit_all(Compared& c, const fs::path& fits, int jobs, Console& console, experiment::Watch& watch) {
  const std::vector<identify::FitRequest> all = identify::requests(c.comparison);
  const std::vector<std::string> hashes = identify::request_hashes(c.comparison, all, share(jobs, all.size()).fits, &watch);
  c.records.resize(all.size());
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string name = identify::request_name(c.comparison, all[i]);
    if (auto kept = stored_fit(fits / (name + ".json"), hashes[i])) {
      c.records[i] = std::move(*kept);
      console.line("kept: " + name);
    } else {
      missing.push_back(i);
    }
  }
  const Share work = share(jobs, missing.size());
  std::atomic<std::size_t> done{all.size() - missing.size()};
  experiment::run_in_parallel(missing.size(), work.fits, [&](std::size_t m) {
    const std::size_t i = missing[m];
    identify::FitRecord record = identify::run_fit(c.comparison, all[i], work.threads, &watch);
    record.asked = hashes[i];
    const std::string name = identify::request_name(c.comparison, all[i]);
    write_whole(fits / (name + ".json"), fit_json(record));
    console.line(fmt::format("{} of {}: {} in {:.0f} s", ++done, all.size(), name, record.seconds));
    c.records[i] = std::move(record);
  });
  c.rows = identify::judge(c.comparison, c.records);
}

}  // namespace

int run_compare(const CompareOptions& o) {
  if (o.jobs && !(*o.jobs >= 0 && *o.jobs <= 1024))
    throw InputError({"", "--jobs", std::to_string(*o.jobs), "out of range", "0 … 1024"});
  Compared c;
  c.comparison = identify::read_comparison(o.file);
  c.command = command_of(o);
  const fs::path out = o.out.empty() ? "compare_" + fs::path(o.file).stem().string() : o.out;
  make_directory(out, "--out");
  make_directory(out / "fits", "--out");
  catch_interrupts();
  Console console;
  experiment::Watch watch;
  auto work = std::async(std::launch::async, [&] { fit_all(c, out / "fits", o.jobs.value_or(c.comparison.jobs), console, watch); });
  while (work.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
    if (interrupted() != 0) watch.stop = true;
  }
  try {
    work.get();
  } catch (const experiment::Stopped&) {
    console.line("stopped: the same command goes on from the fits in " + (out / "fits").string());
    return kSignalled + interrupted();
  }
  const report::Table table = comparison_table(c);
  write_whole(out / "comparison.json", comparison_json(c));
  write_whole(out / "comparison.md", comparison_markdown(c));
  std::vector<std::vector<std::string>> rows{table.head};
  rows.insert(rows.end(), table.rows.begin(), table.rows.end());
  std::cout << table.title << '\n' << table_text(rows, terminal_width()) << '\n';
  std::cout << "written: " << (out / "comparison.md").string() << ", comparison.json\n";
  return std::cout.flush() ? kDone : kFailed;
}

}  // namespace vsa::app
