// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "identify/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <thread>
#include <utility>

#include "identify/signal_watch.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/output_files.hpp"
#include "terminal/table.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/hash.hpp"
#include "vsa/output_file.hpp"
#include "vsa/sweep/fits.hpp"
#include "vsa/sweep/pool.hpp"

namespace vsa::app {
namespace {

namespace fs = std::filesystem;

/// How many fits at once, and on how many threads each.
struct Share {
  unsigned fits, threads;
};
Share share(int wanted, std::size_t fits) {
  const unsigned machine = std::max(1U, std::thread::hardware_concurrency());
  const auto most = static_cast<unsigned>(std::max<std::size_t>(1, fits));
  const unsigned at_once = std::min(wanted > 0 ? static_cast<unsigned>(wanted) : machine, most);
  return {at_once, std::max(1U, machine / at_once)};
}

fs::path file_of(const Comparing& what, std::size_t fit) { return what.out() / "fits" / (what.name(fit) + ".json"); }

fs::path failure_of(const Comparing& what, std::size_t fit) { return what.out() / "fits" / (what.name(fit) + ".failed"); }

/// None: no failure is noted.
std::optional<fs::file_time_type> failed_at(const Comparing& what, std::size_t fit) {
  std::error_code none;
  const fs::file_time_type at = fs::last_write_time(failure_of(what, fit), none);
  return none ? std::nullopt : std::optional(at);
}

void write_judgement(const Comparing& what, std::vector<identify::FitRecord> records) {
  Compared c;
  c.comparison = what.comparison();
  c.command = what.command();
  c.records = std::move(records);
  c.rows = identify::judge(c.comparison, c.records);
  const fs::path out = what.out();
  const report::Table table = comparison_table(c);
  write_whole(out / "comparison.json", comparison_json(c));
  write_whole(out / "comparison.md", comparison_markdown(c));
  std::vector<std::vector<std::string>> rows{table.head};
  rows.insert(rows.end(), table.rows.begin(), table.rows.end());
  std::cout << table.title << '\n' << table_text(rows, terminal_width()) << '\n';
  std::cout << "written: " << (out / "comparison.md").string() << ", comparison.json\n";
  if (!std::cout.flush()) throw std::runtime_error("can't write the table to standard output");
}

}  // namespace

Comparing::Comparing(const CompareOptions& options) : options_(options) {
  (void)part_of(options.part);
  check_wait(options.wait_s);
  comparison_ = identify::read_comparison(options.file);
  requests_ = identify::requests(comparison_);
  make_directory(out(), "--out");
  make_directory(out() / "fits", "--out");
  for (std::size_t fit = 0; fit < fits(); ++fit) failed_before_.push_back(failed_at(*this, fit));
  experiment::Watch watch;
  const SignalWatch signals(watch);
  hashes_ = identify::request_hashes(comparison_, requests_, share(options_.threads.value_or(0), fits()).fits, &watch);
}

fs::path Comparing::out() const {
  return options_.out.empty() ? fs::path("compare_" + fs::path(options_.file).stem().string()) : fs::path(options_.out);
}

std::optional<identify::FitRecord> Comparing::stored(std::size_t fit) const {
  return stored_fit(file_of(*this, fit), hashes_[fit]);
}

std::optional<Comparing::Failure> Comparing::failure(std::size_t fit) const {
  const bool is_news = failed_at(*this, fit) != failed_before_[fit];  // by one clock, the folder's
  const std::string text = read_file(failure_of(*this, fit)).value_or("");
  const std::string& asked = hashes_[fit];
  if (text.compare(0, asked.size(), asked) != 0) return std::nullopt;
  return Failure{std::string(config::trim(std::string_view(text).substr(asked.size()))), is_news};
}

void Comparing::note_failure(std::size_t fit, const std::string& why) const {
  write_whole(failure_of(*this, fit), hashes_[fit] + '\n' + why + '\n');
}

void Comparing::forget_failure(std::size_t fit) const {
  std::error_code ignored;
  fs::remove(failure_of(*this, fit), ignored);
}

sweep::Series Comparing::series(unsigned threads, Console& console) const {
  return sweep::series_of(comparison_, threads, [this, &console](std::size_t fit, identify::FitRecord record) {
    record.asked = hashes_[fit];
    write_whole(file_of(*this, fit), fit_json(record));
    console.line(fmt::format("fit {} of {}: {} in {:.0f} s", fit + 1, fits(), name(fit), record.seconds));
  });
}

std::uint64_t Comparing::fingerprint() const { return fnv1a(config::join(hashes_)); }

std::string Comparing::command() const {
  std::string out = "vsa identify --compare " + options_.file;
  if (!options_.out.empty()) out += " --out " + options_.out;
  return out;
}

int compare_with(const Comparing& what, Console& console, const MakeFits& make) {
  const Part part = part_of(what.options().part);
  Todo todo;
  for (std::size_t fit = 0; fit < what.fits(); ++fit) {
    if (!part.has(fit)) continue;
    if (what.stored(fit)) {
      console.line("kept: " + what.name(fit));
    } else {
      what.forget_failure(fit);
      todo.add(fit);
    }
  }
  const auto stopped = [&] {
    console.line("stopped: the same command goes on from the fits in " + (what.out() / "fits").string());
    return kSignalled + std::max(1, interrupted());
  };
  if (todo.count > 0 && !make(todo)) return stopped();
  if (part.number != 1) return kDone;
  OthersRuns others(part, what.options().wait_s, console);
  for (bool first = true;; first = false) {
    std::vector<identify::FitRecord> records;
    std::vector<std::size_t> missing;
    bool failed = false;
    for (std::size_t fit = 0; fit < what.fits(); ++fit) {
      if (auto record = what.stored(fit)) {
        records.push_back(std::move(*record));
        continue;
      }
      missing.push_back(fit);
      const auto why = part.has(fit) ? std::nullopt : what.failure(fit);
      const bool is_news = why && why->is_news;
      if (is_news) console.line(fmt::format("{} failed in another part: {}", what.name(fit), why->why));
      if (why && !is_news && first)
        console.line(fmt::format("{} failed in another part before this one began, which waits for another try: {}", what.name(fit),
                                 why->why));
      failed = failed || part.has(fit) || is_news;
    }
    if (failed) return kFailed;
    if (records.size() == what.fits()) {
      write_judgement(what, std::move(records));
      return kDone;
    }
    if (interrupted() != 0) return stopped();
    others.wait_for(missing, "fits");
  }
}

int run_compare(const CompareOptions& o) {
  catch_interrupts();
  Console console;
  try {
    const Comparing what(o);
    return compare_with(what, console, [&](const Todo& fits) {
      const Share work = share(o.threads.value_or(what.comparison().jobs), fits.count);
      Dealer dealer(fits);
      const sweep::Work each{[&] { return dealer.next(); },
                             [&](const sweep::Outcome& outcome) { tell_failed(what, outcome, console); },
                             [] { return interrupted() == 0; }};
      static_cast<void>(sweep::run_pool(what.series(work.threads, console), work.fits, each));
      return interrupted() == 0;
    });
  } catch (const experiment::Stopped&) {
    console.line("stopped: nothing was fitted");
    return kSignalled + std::max(1, interrupted());
  }
}

void tell_failed(const Comparing& what, const sweep::Outcome& outcome, Console& console) {
  if (outcome.error.empty()) return;
  console.line(fmt::format("{} failed: {}", what.name(outcome.run), outcome.error));
  what.note_failure(outcome.run, outcome.error);
}

}  // namespace vsa::app
