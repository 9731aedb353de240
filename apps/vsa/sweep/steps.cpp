// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sweep/steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>

#include "terminal/exit_codes.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/sweep/summary.hpp"

namespace vsa::app {
namespace {

namespace fs = std::filesystem;

std::string duration_text(double s) {
  if (!(s < 1e9)) return "a long time";
  if (s < 100) return fmt::format("{:.0f} s", s);
  return s < 6000 ? fmt::format("{:.0f} min", s / 60) : fmt::format("{:.1f} h", s / 3600);
}

}  // namespace

Part part_of(const std::string& text) {
  if (text.empty()) return {};
  const std::size_t slash = text.find('/');
  const auto number = config::parse_integer(text.substr(0, slash));
  const auto of = slash == std::string::npos ? std::nullopt : config::parse_integer(text.substr(slash + 1));
  if (!number || !of || *number < 1 || *of < *number || *of > 1'000'000)
    throw InputError({"", "--part", text, "isn't a part of a whole", "I/N, 1 ≤ I ≤ N ≤ 1000000"});
  return {static_cast<std::size_t>(*number), static_cast<std::size_t>(*of)};
}

void check_wait(double wait_s) {
  constexpr double kMost_s = 1e8;
  if (!(wait_s >= 0 && wait_s <= kMost_s))
    throw InputError({"", "--wait-s", fmt::format("{}", wait_s), "out of range", "0 … 1e8 s"});
}

void OthersRuns::wait_for(const std::vector<std::size_t>& missing, const char* runs) {
  constexpr std::chrono::seconds kSoon{5};
  const auto now = std::chrono::steady_clock::now();
  if (missing.size() != missing_) {
    if (missing_ == 0) begin_ = now;
    news_ = now;
    missing_ = missing.size();
  }
  std::set<std::size_t> owing;
  for (const std::size_t run : missing) owing.insert(run % part_.of + 1);
  constexpr std::size_t kNamed = 8;
  std::string parts;
  for (const std::size_t part : owing) {
    parts += fmt::format("{}{}/{}", parts.empty() ? "" : ", ", part, part_.of);
    if (std::count(parts.begin(), parts.end(), '/') == kNamed && owing.size() > kNamed) {
      parts += fmt::format(" and {} more", owing.size() - kNamed);
      break;
    }
  }
  if (std::chrono::duration<double>(now - news_).count() >= wait_s_)
    throw std::runtime_error(
        fmt::format("no {} of the parts {} for {} s, which owe {}: start them, and then this one again "
                    "(--wait-s waits longer)",
                    runs, parts, wait_s_, missing.size()));
  if (!told_ && part_.of > 1 && now - begin_ > kSoon) {
    console_.line(fmt::format("waiting for {} {} of the parts {}, for up to {} s without news (--wait-s): are they at work?",
                              missing.size(), runs, parts, wait_s_));
    told_ = true;
  }
  console_.status(fmt::format("waiting for {} {} of other parts", missing.size(), runs));
  constexpr std::chrono::milliseconds kLook{200};
  std::this_thread::sleep_for(kLook);
}

fs::path folder_of(const SweepOptions& options) {
  return options.out.empty() ? fs::path(options.command + "_" + fs::path(options.plan).stem().string()) : fs::path(options.out);
}

void Todo::add(std::size_t run) {
  if (!ranges.empty() && ranges.back().second == run) {
    ++ranges.back().second;
  } else {
    ranges.emplace_back(run, run + 1);
  }
  ++count;
}

Todo what_is_left(const sweep::Plan& plan, const SweepOptions& options) {
  const Part part = part_of(options.part);
  const fs::path folder = folder_of(options);
  const sweep::Results there = sweep::read_logs(folder, plan);
  std::vector<bool> done(plan.runs(), false);
  std::size_t known = 0;
  for (const sweep::Outcome& o : there.outcomes) {
    if (!part.has(o.run)) continue;
    ++known;
    done[o.run] = o.error.empty() || !options.retry_failed;
  }
  if (known > 0 && !options.resume)
    throw InputError({"", "--out", folder.string(), fmt::format("has the results of {} runs already", known),
                      "--resume, which goes on; --merge, which makes the tables; or another folder"});
  Todo out;
  for (std::size_t run = part.number - 1; run < plan.runs(); run += part.of)
    if (!done[run]) out.add(run);
  return out;
}

DirectoryLock claim_folder(const fs::path& folder, const sweep::Series& series, const Part& part) {
  sweep::claim(folder, series);
  return {folder, "another one is at work there", part.of > 1 ? DirectoryLock::Use::shared : DirectoryLock::Use::alone};
}

std::optional<std::size_t> Dealer::next() {
  const auto one = deal(1);
  return one.empty() ? std::nullopt : std::optional(one.front());
}

std::vector<std::size_t> Dealer::deal(std::size_t count) {
  const std::scoped_lock lock(mutex_);
  std::vector<std::size_t> out;
  for (; out.size() < count && left_ > 0; --left_) {
    const auto& [begin, end] = todo_.ranges[range_];
    out.push_back(begin + at_);
    if (begin + ++at_ == end) ++range_, at_ = 0;
  }
  return out;
}

void refuse_search(const sweep::Plan& plan, const SweepOptions& options) {
  if (plan.search()) throw InputError({options.plan, "vary.search", "", "is to be searched, not swept", "vsa optimize"});
}

void tell_plan(const sweep::Plan& plan, Console& console) {
  std::string axes;
  for (const sweep::Axis& a : plan.axes()) {
    const std::string many = a.kind == sweep::Axis::Kind::listed     ? std::to_string(a.values.size())
                             : a.kind == sweep::Axis::Kind::random   ? "random"
                             : a.kind == sweep::Axis::Kind::searched ? "searched"
                                                                     : "Sobol'";
    axes += (axes.empty() ? "" : ", ") + a.name + " (" + many + ")";
  }
  console.line(fmt::format("{}{} runs: {} points × {} repetitions{}", plan.title().empty() ? "" : plan.title() + ": ", plan.runs(),
                           plan.points(), plan.repetitions(), axes.empty() ? "" : "; " + axes));
}

std::string RunProgress::text(std::size_t done, std::size_t failed) const {
  const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  const double rate = static_cast<double>(done) / std::max(s, 1e-9);
  const double left_s = static_cast<double>(total_ - std::min(done, total_)) / std::max(rate, 1e-9);
  return fmt::format("{} of {} runs, {:.3g} a second, {} left{}", done, total_, rate, done == 0 ? "?" : duration_text(left_s),
                     failed > 0 ? fmt::format(", {} failed", failed) : "");
}

std::string account_text(const sweep::Account& a, std::size_t processes) {
  const double part = 100 * a.run_cpu_s / std::max(a.all_cpu_s, 1e-9);
  return fmt::format("{} runs in {:.3g} s on {} thread{} of {} process{}: {}a thread waited {:.1f} % of the time{}", a.runs,
                     a.span_s, a.threads, a.threads == 1 ? "" : "s", processes, processes == 1 ? "" : "es",
                     std::isfinite(part) ? fmt::format("{:.1f} % of their CPU time was the runs'; ", part) : "", 100 * a.waited(),
                     processes == 1 ? "" : fmt::format(", in the process that waited most {:.1f} %", 100 * a.most_waited));
}

bool write_page(const report::Report& page, const fs::path& file, Console& console) {
  try {
    report::write_report(page, file);
    return true;
  } catch (const InputError& error) {
    console.line("page left out: " + error.problems().front().text());
    return false;
  }
}

int merge(const sweep::Plan& plan, const SweepOptions& options, Console& console) {
  constexpr std::size_t kShown = 10;
  const fs::path folder = folder_of(options);
  const sweep::Results results = sweep::read_logs(folder, plan);
  auto files = sweep::write_tables(folder, plan, results);
  const fs::path page = folder / "page.html";
  if (write_page(sweep::summary(plan, results, "vsa sweep " + shell_word(options.plan)), page, console)) files.push_back(page);
  console.wipe();
  if (results.damaged > 0)
    console.line(
        fmt::format("warning: {} lines of the logs are damaged or cut short; their runs count as not run", results.damaged));
  if (!sweep::has_hdf5()) console.line("results.h5 left out: this build has no HDF5 (libhdf5-dev)");
  std::size_t failed = 0, told = 0;
  for (const sweep::Outcome& o : results.outcomes) {
    if (!o.notice.empty() && told++ < 3) console.line(fmt::format("warning: run {}: {}", o.run, o.notice));
    if (o.error.empty()) continue;
    if (failed++ < kShown)
      console.line(
          fmt::format("run {} failed: {}\n  again: vsa sweep {} --run {}", o.run, o.error, shell_word(options.plan), o.run));
  }
  if (told > 3) console.line(fmt::format("warning: {} more runs have notices; column notice", told - 3));
  if (failed > kShown) console.line(fmt::format("… and {} more; column error", failed - kShown));
  const std::size_t missing = plan.runs() - results.outcomes.size();
  std::cout << fmt::format("runs                {} of {}{}{}\n", results.outcomes.size() - failed, plan.runs(),
                           failed > 0 ? fmt::format(", {} failed", failed) : "",
                           missing > 0 ? fmt::format(", {} not run (--resume)", missing) : "");
  for (const fs::path& file : files)
    std::cout << fmt::format("{:<20}{}\n",
                             file.extension() == ".html" ? "page"
                             : file == files.front()     ? "tables"
                                                         : "",
                             file.string());
  std::cout.flush();
  if (!std::cout) throw std::runtime_error("can't write the summary to standard output");
  return failed > 0 || missing > 0 ? kFailed : kDone;
}

}  // namespace vsa::app
