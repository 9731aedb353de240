// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// libsdformat 12 returns some errors and prints others; of a number that is none it returns "Error reading element <mass>" with its
// place and prints why; the errors of included files are only printed, and the settings it reads those with are global. All is
// joined here. What it can't read as SDF it tries as URDF and then as something older: what those attempts print says nothing of an
// SDF file.
#include "sdf/parse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <sdf/Console.hh>
#include <sdf/Error.hh>
#include <sdf/ParserConfig.hh>
#include <sstream>

#include "sdf/includes.hpp"

namespace vsa::reader {
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

/// The settings that libsdformat reads included files with.
class GlobalConfig {
 public:
  explicit GlobalConfig(const sdf::ParserConfig& config) : before_(sdf::ParserConfig::GlobalConfig()) {
    sdf::ParserConfig::GlobalConfig() = config;
  }
  ~GlobalConfig() { sdf::ParserConfig::GlobalConfig() = before_; }
  GlobalConfig(const GlobalConfig&) = delete;
  GlobalConfig& operator=(const GlobalConfig&) = delete;

 private:
  sdf::ParserConfig before_;
};

struct Message {
  std::string file, key, text;
  bool error = true;
};

std::string without_copying(std::string text) {
  if (const std::size_t more = text.find(". Copying["); more != std::string::npos) text.resize(more);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

/// "Error Code 9: [/sdf/model:FILE:L3]: Msg: text", of an included file.
std::optional<Message> from_included(const std::string& line, const ReadContext& c) {
  const std::size_t open = line.find('['), text = line.find("]: Msg: ");
  if (!starts(line, "Error Code ") || open == std::string::npos || text == std::string::npos) return std::nullopt;
  const std::string place = line.substr(open + 1, text - open - 1);
  const std::size_t number = place.rfind(":L"), colon = number == std::string::npos ? number : place.rfind(':', number - 1);
  Message out{c.file, place, without_copying(line.substr(text + 8)), true};
  if (number == std::string::npos || colon == std::string::npos) return out;
  const std::string file = place.substr(colon + 1, number - colon - 1), original = c.files.original(file);
  out.file = c.files.is_urdf(original) ? original : fmt::format("{}:{}", original, place.substr(number + 2));
  out.key = place.substr(0, colon);
  return out;
}

/// What was printed of the files: "\033[1;31mError [Param.cc:771]\033[0m message" by libsdformat, "Error:   message" by urdfdom.
std::vector<Message> messages(const std::string& printed, const ReadContext& c) {
  const bool urdf = c.files.top_is_urdf || !c.files.urdfs.empty();
  std::vector<Message> out;
  std::istringstream lines(printed);
  for (std::string line; std::getline(lines, line);) {
    if (std::optional<Message> message = from_included(line, c)) {
      out.push_back(std::move(*message));
      continue;
    }
    const std::size_t at = line.find("]\033[0m ");
    const bool noise = holds(line, "parser_urdf.cc") && (!urdf || holds(line, "Unable to call parseURDF"));
    if (at != std::string::npos && !noise && !holds(line, "old deprecated model")) {
      out.push_back({c.file, "", c.files.with_originals(line.substr(at + 6)), holds(line.substr(0, at), "Error")});
    } else if (at == std::string::npos && urdf && (starts(line, "Error:") || starts(line, "Warning:"))) {
      out.push_back({c.file, "", line.substr(line.find_first_not_of(' ', line.find(':') + 1)), starts(line, "Error:")});
    }
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

/// What all that speaks of a model's parts comes to where an <include> brought none.
bool follows_lost_include(const sdf::Error& error) {
  using enum sdf::ErrorCode;
  constexpr std::array kFollows{MODEL_WITHOUT_LINK,        MODEL_CANONICAL_LINK_INVALID, JOINT_CHILD_LINK_INVALID,
                                JOINT_PARENT_LINK_INVALID, FRAME_ATTACHED_TO_INVALID,    FRAME_ATTACHED_TO_GRAPH_ERROR,
                                POSE_RELATIVE_TO_INVALID,  POSE_RELATIVE_TO_GRAPH_ERROR, MODEL_PLACEMENT_FRAME_INVALID};
  return std::find(kFollows.begin(), kFollows.end(), error.Code()) != kFollows.end();
}

/// "Unable to find uri[model://x]" → model://x
std::string uri_in(const std::string& message) {
  const std::size_t open = message.find("uri["), close = message.find(']', open);
  return open == std::string::npos || close == std::string::npos ? "model://" : message.substr(open + 4, close - open - 4);
}

Problem to_problem(const sdf::Error& error, const ReadContext& c) {
  Problem p;
  p.file = c.files.original(error.FilePath().value_or(c.file));
  if (p.file.empty() || p.file.front() == '<' || p.file == "data-string" || p.file == "urdf file") p.file = c.file;
  if (error.LineNumber() && !c.files.is_urdf(p.file)) p.file += fmt::format(":{}", *error.LineNumber());
  p.key = error.XmlPath().value_or("");
  p.message = without_copying(c.files.with_originals(error.Message()));
  if (c.files.newer && holds(p.message, "not defined in SDF")) p.allowed = "elements of SDF 1.9, as which newer files are read";
  if (error.Code() == sdf::ErrorCode::URI_LOOKUP) p.allowed = c.finder.searched(uri_in(p.message), c.base);
  return p;
}

void report(const sdf::Errors& errors, std::vector<Message> printed, ReadContext& c) {
  const std::size_t before = c.problems.list().size();
  bool reading = false;  // within a chain from the innermost element outwards
  bool left_to_readers = false;
  const bool lost =
      std::any_of(errors.begin(), errors.end(), [](const sdf::Error& e) { return e.Code() == sdf::ErrorCode::URI_LOOKUP; });
  for (const sdf::Error& error : errors) {
    left_to_readers = left_to_readers || reported_by_readers(error);
    if (reported_by_readers(error) || only_follows(error) || (lost && follows_lost_include(error))) continue;
    Problem p = to_problem(error, c);
    const bool outer = starts(p.message, "Error reading element");
    if (outer && (reading || (printed.empty() && c.problems.list().size() > before))) continue;
    reading = outer;
    if (outer && !printed.empty()) {
      p.message = printed.front().text;
      printed.erase(printed.begin());
    }
    c.problems.add(std::move(p));
  }
  const bool unexplained = c.problems.list().size() == before && !left_to_readers;
  for (Message& m : printed) c.problems.add({std::move(m.file), std::move(m.key), "", std::move(m.text), ""});
  if (unexplained && printed.empty())
    c.problems.add(
        {c.file, "", "", "isn't readable as SDF or URDF", "an SDF 1.6 … 1.12 or URDF file, or MJCF named .xml or .mjcf"});
}

sdf::ParserConfig parser_config(const ReadContext& c) {
  sdf::ParserConfig config;
  config.SetWarningsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetFindCallback([&c](const std::string& uri) {
    const std::filesystem::path found = c.finder.find(uri, c.base);
    return found.empty() ? std::string() : c.files.stand_in(model_file(found, c.seen)).string();
  });
  return config;
}

/// What libsdformat says of the source; an exception of its own (a number that is none, in a URDF) as an error.
sdf::Errors load(const SdfSource& source, const ReadContext& c, sdf::Root& root) {
  const sdf::ParserConfig config = parser_config(c);
  const GlobalConfig global(config);
  try {
    if (c.files.top) return root.LoadSdfString(*c.files.top, config);
    if (source.path.empty()) return root.LoadSdfString(std::string(source.text), config);
    // It takes "model.sdf" or "actor.sdf" for a file of its own.
    return root.Load(std::filesystem::absolute(source.path).string(), config);
  } catch (const std::exception& error) {
    return {{sdf::ErrorCode::FILE_READ, std::string("can't be read: ") + error.what()}};
  }
}

}  // namespace

void parse_sdf(const SdfSource& source, ReadContext& c, sdf::Root& root) {
  sdf::Errors errors;
  std::string printed;
  {
    const CerrCapture capture;
    sdf::Console::Instance()->SetQuiet(false);
    errors = load(source, c, root);
    sdf::Console::Instance()->SetQuiet(true);
    printed = capture.text();
  }
  for (const sdf::Error& error : errors) {
    c.parsed_clean = c.parsed_clean && error.Code() == sdf::ErrorCode::LINK_INERTIA_INVALID;
  }
  std::vector<Message> said = messages(printed, c);
  // Of an SDF without either the reader says what it lacks.
  if (!errors.empty() || (!c.files.top_is_sdf && root.WorldCount() == 0 && root.Model() == nullptr)) {
    report(errors, std::move(said), c);
    return;
  }
  for (const Message& m : said) {
    if (m.error) {
      c.problems.add({m.file, m.key, "", m.text, ""});
    } else {
      c.notes.add(m.text, m.file);
    }
  }
}

}  // namespace vsa::reader
