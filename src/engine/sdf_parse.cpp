// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// libsdformat 12 returns some errors and prints others; of a number that is none it returns "Error reading element <mass>" with its
// place and prints why. Both are joined here. What it can't read as SDF it tries as URDF and then as something older: what those
// attempts print says nothing of an SDF file.
#include "sdf_parse.hpp"

#include <fmt/format.h>

#include <iostream>
#include <sdf/Console.hh>
#include <sdf/Error.hh>
#include <sdf/ParserConfig.hh>
#include <sstream>

namespace vsa::engine {
namespace {

/// Takes what is written to std::cerr.
class CerrCapture {
 public:
  CerrCapture() : before_(std::cerr.rdbuf(taken_.rdbuf())) {}
  ~CerrCapture() { std::cerr.rdbuf(before_); }
  CerrCapture(const CerrCapture&) = delete;
  CerrCapture& operator=(const CerrCapture&) = delete;
  [[nodiscard]] std::string text() const { return taken_.str(); }

 private:
  std::ostringstream taken_;
  std::streambuf* before_;
};

bool starts(const std::string& text, const char* with) { return text.rfind(with, 0) == 0; }
bool holds(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

/// "\033[1;31mError [Param.cc:771]\033[0m message" → message, of the lines that speak of the SDF.
std::vector<std::string> messages(const std::string& printed) {
  std::vector<std::string> out;
  std::istringstream lines(printed);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find("]\033[0m ");
    if (at == std::string::npos || holds(line, "parser_urdf.cc") || holds(line, "old deprecated model")) continue;
    out.push_back(line.substr(at + 6));
  }
  return out;
}

/// Errors that the readers of links and joints report themselves, with name and value.
bool reported_by_readers(const sdf::Error& error) {
  return error.Code() == sdf::ErrorCode::LINK_INERTIA_INVALID || starts(error.Message(), "Joint type of");
}

/// Errors that only say that there was another.
bool only_follows(const sdf::Error& error) {
  return starts(error.Message(), "Failed to load a") || starts(error.Message(), "Unable to read");
}

Problem to_problem(const sdf::Error& error, const ReadContext& c) {
  Problem p;
  p.file = error.FilePath().value_or(c.file);
  if (p.file.empty() || p.file.front() == '<' || p.file == "data-string") p.file = c.file;
  if (error.LineNumber()) p.file += fmt::format(":{}", *error.LineNumber());
  p.key = error.XmlPath().value_or("");
  p.message = error.Message();
  while (!p.message.empty() && p.message.back() == '\n') p.message.pop_back();
  if (error.Code() == sdf::ErrorCode::URI_LOOKUP) p.allowed = "a model in: " + c.finder.searched();
  return p;
}

void report(const sdf::Errors& errors, std::vector<std::string> printed, ReadContext& c) {
  const std::size_t before = c.problems.list().size();
  bool reading = false;  // within a chain from the innermost element outwards
  bool left_to_readers = false;
  for (const sdf::Error& error : errors) {
    left_to_readers = left_to_readers || reported_by_readers(error);
    if (reported_by_readers(error) || only_follows(error)) continue;
    Problem p = to_problem(error, c);
    const bool outer = starts(p.message, "Error reading element");
    if (outer && (reading || (printed.empty() && c.problems.list().size() > before))) continue;
    reading = outer;
    if (outer && !printed.empty()) {
      p.message = printed.front();
      printed.erase(printed.begin());
    }
    c.problems.add(std::move(p));
  }
  const bool unexplained = c.problems.list().size() == before && !left_to_readers;
  for (std::string& text : printed) c.problems.add({c.file, "", "", std::move(text), ""});
  if (unexplained && printed.empty())
    c.problems.add({c.file, "", "", "isn't readable as SDF or URDF", "an SDF 1.6 … 1.9 or URDF file"});
}

sdf::ParserConfig parser_config(const ReadContext& c) {
  sdf::ParserConfig config;
  config.SetWarningsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetFindCallback([&finder = c.finder, base = c.base](const std::string& uri) { return finder.find(uri, base).string(); });
  return config;
}

}  // namespace

void parse_sdf(const SdfSource& source, ReadContext& c, sdf::Root& root) {
  const sdf::ParserConfig config = parser_config(c);
  sdf::Errors errors;
  std::string printed;
  {
    const CerrCapture capture;
    sdf::Console::Instance()->SetQuiet(false);
    errors = source.path.empty() ? root.LoadSdfString(std::string(source.text), config) : root.Load(source.path.string(), config);
    sdf::Console::Instance()->SetQuiet(true);
    printed = capture.text();
  }
  for (const sdf::Error& error : errors) {
    c.parsed_clean = c.parsed_clean && error.Code() == sdf::ErrorCode::LINK_INERTIA_INVALID;
  }
  if (!errors.empty() || (root.WorldCount() == 0 && root.Model() == nullptr)) {
    report(errors, messages(printed), c);
  } else {
    for (const std::string& text : messages(printed)) c.notes.add(text, c.file);
  }
}

}  // namespace vsa::engine
