// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/config/faults_text.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "vsa/config/text.hpp"

namespace vsa::config {
namespace {

constexpr std::array<std::string_view, 3> kEncoders{"motor_1", "motor_2", "shaft"};

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : text) {
    if (std::isspace(static_cast<unsigned char>(c)) == 0) {
      word += c;
    } else if (!word.empty()) {
      words.push_back(std::move(word));
      word.clear();
    }
  }
  if (!word.empty()) words.push_back(std::move(word));
  return words;
}

/// Reads one word after the other into a Faults.
class FaultsReader {
 public:
  explicit FaultsReader(std::string_view source) : source_(source) {}

  void read(const std::string& word) {
    if (word == "none" || word == "off") {
      faults_.powered = faults_.powered && word != "off";
      return;
    }
    const std::size_t equals = word.find('=');
    const std::string key = word.substr(0, equals);
    const std::vector<std::string> keys{"none",  "off",       "lost_byte", "flipped_byte", "late_s",
                                        "stuck", "noise_rad", "supply_V",  "unplugged",    "seed"};
    if (std::find(keys.begin() + 2, keys.end(), key) == keys.end()) return add(word, "unknown fault", join(keys));
    if (equals == std::string::npos) return add(word, "has no value", key + "=…");
    const bool may_repeat = key == "stuck" || key == "unplugged";  // each time another one
    if (!may_repeat && std::find(seen_.begin(), seen_.end(), key) != seen_.end()) return add(word, "is given twice", "once");
    seen_.push_back(key);
    value(key, word, word.substr(equals + 1));
  }

  device::Faults finish() {
    device::validate(faults_, std::string(source_) + ": ", problems_);
    problems_.throw_if_any();
    return faults_;
  }

 private:
  void add(const std::string& word, const char* what, const std::string& allowed) {
    problems_.add({"", std::string(source_), word, what, allowed});
  }

  void value(const std::string& key, const std::string& word, const std::string& text) {
    if (key == "stuck") {
      const auto which = std::find(kEncoders.begin(), kEncoders.end(), text);
      if (which == kEncoders.end()) return add(word, "no such encoder", "motor_1, motor_2, shaft");
      faults_.encoder[static_cast<std::size_t>(which - kEncoders.begin())].stuck = true;
    } else if (key == "unplugged") {
      if (text != "1" && text != "2") return add(word, "no such motor", "1, 2");
      faults_.motor_unplugged[text == "1" ? 0 : 1] = true;
    } else if (key == "seed") {
      const auto seed = parse_integer(text);
      if (!seed || *seed < 0) return add(word, "isn't a whole number", "0 or more");
      faults_.seed = static_cast<std::uint64_t>(*seed);
    } else {
      const auto number = parse_number(text);
      if (!number) return add(word, "isn't a number", key + "=NUMBER");
      set(key, *number);
    }
  }

  void set(const std::string& key, double number) {
    if (key == "lost_byte") faults_.lost_byte = number;
    if (key == "flipped_byte") faults_.flipped_byte = number;
    if (key == "late_s") faults_.late_s = number;
    if (key == "supply_V") faults_.supply_V = number;
    for (device::EncoderFault& e : faults_.encoder)
      if (key == "noise_rad") e.noise_rad = number;
  }

  std::string_view source_;
  device::Faults faults_;
  std::vector<std::string> seen_;
  Problems problems_;
};

}  // namespace

device::Faults read_faults(std::string_view text, std::string_view source) {
  const std::vector<std::string> words = words_of(text);
  if (words.empty()) throw InputError({"", std::string(source), "", "names no fault", "none, off, lost_byte=…, …"});
  FaultsReader reader(source);
  for (const std::string& word : words) reader.read(word);
  return reader.finish();
}

std::string faults_text(const device::Faults& f) {
  if (f == device::Faults{}) return "none";
  std::vector<std::string> words;
  const auto number = [&words](const char* key, double v) {
    if (v != 0) words.push_back(key + number_text(v));
  };
  if (!f.powered) words.emplace_back("off");
  number("lost_byte=", f.lost_byte);
  number("flipped_byte=", f.flipped_byte);
  number("late_s=", f.late_s);
  for (std::size_t i = 0; i < kEncoders.size(); ++i)
    if (f.encoder[i].stuck) words.push_back("stuck=" + std::string(kEncoders[i]));
  number("noise_rad=", f.encoder[0].noise_rad);
  if (f.supply_V) words.push_back("supply_V=" + number_text(*f.supply_V));
  for (std::size_t i = 0; i < f.motor_unplugged.size(); ++i)
    if (f.motor_unplugged[i]) words.push_back("unplugged=" + std::to_string(i + 1));
  if (f.seed != device::Faults{}.seed) words.push_back("seed=" + std::to_string(f.seed));
  return join(words, " ");
}

}  // namespace vsa::config
