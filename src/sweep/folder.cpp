// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sweep/folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>

#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"

namespace vsa::sweep {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIdentity = "sweep.id";
constexpr const char* kLogs = "log";

std::string head(const Series& series) { return fmt::format("vsasim sweep 1 {:016x}\n", series.fingerprint); }

std::uint32_t checksum(std::string_view text) {
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return crc.checksum();
}

/// Tabs and line ends are the log's own.
std::string in_a_field(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\n' || c == '\t' || c == '\\') {
      out += '\\';
      out += c == '\n' ? 'n' : c == '\t' ? 't' : '\\';
    } else {
      out += c;
    }
  }
  return out;
}
std::string out_of_field(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      out += text[i];
      continue;
    }
    const char c = text[++i];
    out += c == 'n' ? '\n' : c == 't' ? '\t' : c;
  }
  return out;
}

/// Digits that read back the same double; NaN and infinities too.
std::string number_of(double value) { return std::isfinite(value) ? config::number_text(value) : fmt::format("{}", value); }

std::string line_of(const Outcome& o) {
  std::string values;
  for (const double v : o.values) values += (values.empty() ? "" : ",") + number_of(v);
  const std::string text =
      fmt::format("{}\t{:.6f}\t{:.6f}\t{}\t{}\t{}", o.run, o.wall_s, o.cpu_s, values, in_a_field(o.notice), in_a_field(o.error));
  return fmt::format("{:08x}\t{}\n", checksum(text), text);
}

/// What number_of() wrote; none: damaged.
std::optional<double> number_in(const std::string& text) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (text == "nan" || text == "-nan") return std::numeric_limits<double>::quiet_NaN();
  if (text == "inf" || text == "-inf") return text == "inf" ? kInfinity : -kInfinity;
  return config::parse_number(text);
}

/// None: damaged.
std::optional<Outcome> outcome_of(std::string_view line, const Series& series) {
  constexpr std::size_t kSum = 8;
  if (line.size() <= kSum + 1 || line[kSum] != '\t') return std::nullopt;
  const std::string_view text = line.substr(kSum + 1);
  if (fmt::format("{:08x}", checksum(text)) != line.substr(0, kSum)) return std::nullopt;
  const std::vector<std::string> fields = config::split(text, '\t');
  if (fields.size() != 6) return std::nullopt;
  Outcome o;
  const auto run = config::parse_integer(fields[0]);
  if (!run || *run < 0 || static_cast<std::size_t>(*run) >= series.most_runs) return std::nullopt;
  o.run = static_cast<std::size_t>(*run);
  o.wall_s = config::parse_number(fields[1]).value_or(0);
  o.cpu_s = config::parse_number(fields[2]).value_or(0);
  if (!fields[3].empty()) {
    for (const std::string& v : config::split(fields[3], ',')) {
      const std::optional<double> value = number_in(v);
      if (!value) return std::nullopt;
      o.values.push_back(*value);
    }
  }
  o.notice = out_of_field(fields[4]);
  o.error = out_of_field(fields[5]);
  if (o.values.size() != (o.error.empty() ? series.columns : 0)) return std::nullopt;
  return o;
}

bool same(const Outcome& a, const Outcome& b) {
  return a.error == b.error && a.notice == b.notice && a.values.size() == b.values.size() &&
         std::equal(a.values.begin(), a.values.end(), b.values.begin(),
                    [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

std::string host_name() {
  char name[256] = {};
  if (gethostname(name, sizeof name - 1) != 0 || name[0] == '\0') return "host";
  std::string out = name;
  std::replace_if(
      out.begin(), out.end(), [](char c) { return c == '/' || c == '\0'; }, '_');
  return out;
}

/// A file that nobody else has, not even a process of the same number on a machine of the same name.
fs::path fresh_log(const fs::path& folder) {
  for (int n = 1;; ++n) {
    const fs::path path = folder / kLogs / fmt::format("{}-{}-{}", host_name(), getpid(), n);
    const int fd = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd >= 0) return close(fd), path;
    if (errno != EEXIST) throw InputError({"", "--out", path.string(), std::strerror(errno), "a folder that can be written to"});
  }
}

/// Whole or not at all; false: it is there already.
bool create_whole(const fs::path& file, std::string_view text) {
  const fs::path beside = file.string() + fmt::format(".{}-{}", host_name(), getpid());
  {
    OutputFile out(beside);
    out.append(text);
    out.close();
  }
  const int linked = link(beside.c_str(), file.c_str());
  const int error = errno;
  unlink(beside.c_str());
  if (linked != 0 && error != EEXIST)
    throw InputError({"", "--out", file.string(), std::strerror(error), "a folder that can be written to"});
  return linked == 0;
}

}  // namespace

void claim(const fs::path& folder, const Series& series) {
  std::error_code error;
  fs::create_directories(folder / kLogs, error);
  if (!fs::is_directory(folder / kLogs))
    throw InputError({"", "--out", folder.string(), error ? error.message() : "isn't a folder", "a folder that can be written to"});
  const auto other = [&] {
    throw InputError({"", "--out", folder.string(), "holds the results of another plan, or of this one as it was",
                      "another folder; " + (folder / "plan.toml").string() + " is the plan that it holds"});
  };
  if (const auto identity = read_file(folder / kIdentity)) {
    if (*identity != head(series)) other();
    return;
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (name == kLogs || name.rfind(kIdentity, 0) == 0 || name.rfind("plan.toml", 0) == 0) continue;
    throw InputError({"", "--out", folder.string(), "holds something else: " + name, "a new or empty folder"});
  }
  create_whole(folder / "plan.toml", series.text);
  create_whole(folder / kIdentity, head(series));
  if (read_file(folder / kIdentity).value_or("") != head(series)) other();
}

Log::Log(const fs::path& folder, const Series& series) : file_(fresh_log(folder)) { file_.append(head(series)); }

void Log::add(const Outcome& outcome) {
  const std::string line = line_of(outcome);
  const std::scoped_lock lock(mutex_);
  file_.append(line);
}

Results read_logs(const fs::path& folder, const Series& series) {
  Results out;
  std::map<std::size_t, Outcome> known;
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / kLogs, none)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    const std::string text = read_file(file).value_or("");
    const std::string first = head(series);
    if (text.size() < first.size() && first.compare(0, text.size(), text) == 0) continue;  // its writer has just begun, or died so
    if (text.compare(0, first.size(), first) != 0)
      throw InputError({file.string(), "", "", "isn't a log of this plan, or of it as it is now", "logs of one plan"});
    for (std::size_t at = first.size(); at < text.size();) {
      const std::size_t end = text.find('\n', at);
      const auto outcome = outcome_of(std::string_view(text).substr(at, end - at), series);
      at = end == std::string::npos ? text.size() : end + 1;
      if (!outcome || end == std::string::npos) {
        ++out.damaged;
        continue;
      }
      const auto [known_at, fresh] = known.try_emplace(outcome->run, *outcome);
      if (fresh || same(known_at->second, *outcome)) continue;
      // What once failed, at a limit or for want of memory, may do so only there.
      if (!known_at->second.error.empty() || !outcome->error.empty()) {
        if (!known_at->second.error.empty()) known_at->second = *outcome;
        continue;
      }
      throw InputError({file.string(), "run", std::to_string(outcome->run), "differs from what another log says",
                        "machines and builds that give the same bits"});
    }
  }
  out.outcomes.reserve(known.size());
  for (auto& [run, outcome] : known) out.outcomes.push_back(std::move(outcome));
  return out;
}

}  // namespace vsa::sweep
