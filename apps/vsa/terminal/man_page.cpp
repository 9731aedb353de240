// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "terminal/man_page.hpp"

#include <fmt/format.h>

#include <set>
#include <sstream>

namespace vsa::app {
namespace {

/// The code point at `at`, which moves behind it. The texts are our own, in UTF-8.
unsigned code_point(const std::string& text, std::size_t& at) {
  const auto lead = static_cast<unsigned char>(text[at++]);
  if (lead < 0x80) return lead;
  unsigned code = lead & (lead < 0xE0 ? 0x1FU : lead < 0xF0 ? 0x0FU : 0x07U);
  for (; at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U; ++at) {
    code = code << 6U | (static_cast<unsigned char>(text[at]) & 0x3FU);
  }
  return code;
}

/// One line of text as roff shows it literally.
std::string roff(const std::string& text) {
  std::string out;
  if (!text.empty() && (text[0] == '.' || text[0] == '\'')) out = "\\&";
  for (std::size_t at = 0; at < text.size();) {
    const unsigned code = code_point(text, at);
    switch (code) {
      case '\\':
        out += "\\e";
        break;
      case '-':
        out += "\\-";
        break;
      case '\'':
        out += "\\(aq";
        break;
      case '`':
        out += "\\(ga";
        break;
      case '^':
        out += "\\(ha";
        break;
      case '~':
        out += "\\(ti";
        break;
      default:
        out += code < 0x80 ? std::string(1, static_cast<char>(code)) : fmt::format("\\[u{:04X}]", code);
    }
  }
  return out;
}

/// Lines as they are, tables and examples included.
std::string verbatim(const std::string& text) {
  std::istringstream lines(text);
  std::string out = ".PP\n.nf\n";
  for (std::string line; std::getline(lines, line);) out += line.empty() ? "\n" : roff(line) + '\n';
  return out + ".fi\n";
}

/// "-h, --help", or a positional's name.
std::string names(const CLI::Option& option) {
  if (option.get_positional()) return "\\fI" + roff(option.get_name()) + "\\fR";
  std::string out;
  const auto add = [&out](const std::string& name) { out += (out.empty() ? "" : ", ") + ("\\fB" + roff(name) + "\\fR"); };
  for (const std::string& name : option.get_snames()) add("-" + name);
  for (const std::string& name : option.get_lnames()) add("--" + name);
  return out;
}

std::string others(const std::string& what, const std::set<CLI::Option*>& options) {
  std::set<std::string> sorted;  // not by address
  for (const CLI::Option* o : options) sorted.insert(o->get_name());
  std::string out;
  for (const std::string& name : sorted) out += (out.empty() ? what : ", ") + name;
  return out.empty() ? "" : out + ".";
}

std::string option_text(const CLI::Option& option) {
  std::string head = names(option);
  const bool takes_value = option.get_items_expected_max() > 0;
  if (takes_value && !option.get_positional()) head += " " + roff(option.get_type_name());
  if (option.get_items_expected_max() > 1) head += " " + roff("…");
  std::string text = option.get_description();
  for (const std::string& more : {others(" Needs ", option.get_needs()), others(" Excludes ", option.get_excludes())}) {
    if (!more.empty()) text += (text.empty() || text.back() == '.' ? "" : ".") + more;
  }
  if (takes_value && !option.get_default_str().empty()) text += "; default: " + option.get_default_str();
  return ".TP\n" + head + '\n' + roff(text) + '\n';
}

std::string synopsis(const CLI::App& sub) {
  std::string out = ".PP\n\\fBvsa " + roff(sub.get_name()) + "\\fR [\\fIOPTION\\fR]...";
  for (const CLI::Option* o : sub.get_options([](const CLI::Option* any) { return any->get_positional(); })) {
    const bool needed = o->get_required();
    out +=
        std::string(" ") + (needed ? "" : "[") + names(*o) + (needed ? "" : "]") + (o->get_items_expected_max() > 1 ? "..." : "");
  }
  return out + '\n';
}

std::string subcommand(const CLI::App& sub) {
  std::string out = ".SS " + roff(sub.get_name()) + '\n' + roff(sub.get_description()) + ".\n" + synopsis(sub);
  for (const CLI::Option* option : sub.get_options()) out += option_text(*option);
  return sub.get_footer().empty() ? out : out + verbatim(sub.get_footer());
}

}  // namespace

std::string man_page(const CLI::App& app, const std::string& version) {
  std::string out = fmt::format(".TH VSA 1 \"\" \"vsasim {}\" \"User Commands\"\n", roff(version));
  out += ".SH NAME\nvsa \\- simulate robots built of variable stiffness actuators\n.SH SYNOPSIS\n";
  out += ".B vsa\n\\fISUBCOMMAND\\fR [\\fIOPTION\\fR]... [\\fIARGUMENT\\fR]...\n.SH OPTIONS\n";
  for (const CLI::Option* option : app.get_options()) out += option_text(*option);
  out += ".SH SUBCOMMANDS\n";
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) out += subcommand(*sub);
  return out + ".SH EXAMPLES AND EXIT STATUS\n" + verbatim(app.get_footer());
}

}  // namespace vsa::app
