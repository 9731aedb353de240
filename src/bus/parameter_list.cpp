// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The list packet of command 12.
#include <algorithm>

#include "bus/parameter_bytes.hpp"
#include "vsa/bus/bytes.hpp"
#include "vsa/bus/parameters.hpp"

namespace vsa::bus {
namespace {

constexpr std::size_t kFirstSlot = 2;  ///< offsets count from CMD
constexpr std::size_t kValuesInSlot = 2;

// As the unit sends them, line ends included.
constexpr std::array<std::string_view, kMaxMenus> kMenus{
    "0 -> Usb\n1 -> Shaft's position controls the motors\n",
    "0 -> Position\n1 -> PWM\n2 -> Current\n3 -> Position-Current\n4 -> Deflection\n5 -> Deflection-Current\n",
    "0 -> Deactivate [NO]\n1 -> Activate [YES]\n",
};
constexpr std::array<std::string_view, 2> kInputModes{" Usb", " Encoder 3"};
constexpr std::array<std::string_view, 6> kControlModes{
    " Position", " PWM", " Current", " Position and current", " Deflection", " Deflection and current"};

std::size_t slots(Dialect dialect) noexcept { return parameter_table(dialect).size(); }
std::size_t slot_at(std::size_t index) noexcept { return kFirstSlot + (index - 1) * kSlotBytes; }
std::size_t menu_at(Dialect dialect, std::size_t menu) noexcept { return slot_at(slots(dialect) + 1) + (menu - 1) * kMenuBytes; }
std::size_t list_bytes(Dialect dialect) noexcept { return dialect == Dialect::six ? kListBytesSix : kListBytesSeven; }

/// How many bytes CHK covers: firmware 6.1 hands the number over in 8 bits.
std::size_t checked_bytes(Wire wire, std::size_t bytes) noexcept {
  return wire.dialect == Dialect::six && !wire.repair_list_checksum ? bytes % 256 : bytes;
}

/// Either sum is accepted of a unit of dialect six.
bool checksum_ok(Wire wire, std::span<const std::uint8_t> body) noexcept {
  const auto content = body.first(body.size() - 1);
  return checksum(content) == body.back() || checksum(content.first(checked_bytes(wire, content.size()))) == body.back();
}

void put_text(std::span<std::uint8_t> body, std::size_t at, std::string_view text) noexcept {
  for (std::size_t i = 0; i < text.size() && at + i < body.size(); ++i) body[at + i] = static_cast<std::uint8_t>(text[i]);
}

/// The word for a flag's value; empty for a value that the unit has no word for.
std::string_view flag_word(ParameterId id, std::uint8_t value) noexcept {
  switch (id) {
    case ParameterId::input_mode:
      return value < kInputModes.size() ? kInputModes[value] : std::string_view{};
    case ParameterId::control_mode:
      return value < kControlModes.size() ? kControlModes[value] : std::string_view{};
    default:
      return value != 0 ? " YES" : " NO";
  }
}

/// Text, word, zero, menu number. With no word for the value the unit uses the length left over from the flag before, which is what
/// `length` carries from call to call.
void put_flag(std::span<std::uint8_t> body, std::size_t at, const ParameterInfo& info, std::uint8_t value,
              std::size_t& length) noexcept {
  const std::string_view word = flag_word(info.id, value);
  if (!word.empty()) length = info.text.size() + word.size() + 1;
  put_text(body, at, info.text);
  put_text(body, at + info.text.size(), word);
  body[at + length] = info.menu;
}

}  // namespace

std::size_t encode_parameter_list(Wire wire, std::uint8_t id, const ParameterValues& values, std::span<std::uint8_t> out) noexcept {
  const std::size_t total = list_bytes(wire.dialect);
  if (out.size() < total) return 0;
  out = out.first(total);
  std::fill(out.begin(), out.end(), std::uint8_t{0});
  const std::size_t body_bytes = total - kHeaderBytes;
  ByteWriter header{out};
  for (const std::uint8_t byte : {kStartByte, kStartByte, id}) header.u8(byte);
  header.u8(static_cast<std::uint8_t>(wire.dialect == Dialect::six ? body_bytes : body_bytes / 32));

  const auto body = out.subspan(kHeaderBytes);
  body[0] = static_cast<std::uint8_t>(Command::parameters);
  body[1] = static_cast<std::uint8_t>(slots(wire.dialect));
  std::size_t flag_length = 0;
  for (const ParameterInfo& info : parameter_table(wire.dialect)) {
    const std::size_t at = slot_at(static_cast<std::size_t>(info.id));
    ByteWriter slot{body.subspan(at, kSlotBytes)};
    slot.u8(static_cast<std::uint8_t>(info.type));
    slot.u8(info.count);
    write_value(slot, values, info.id);
    if (info.type == ParameterType::flag)
      put_flag(body, at + slot.size(), info, body[at + kValuesInSlot], flag_length);
    else
      put_text(body, at + slot.size(), info.text);
  }
  // The unit copies the third menu with the first one's length: nine bytes from behind the text's zero, unknown ones. Zeros here.
  for (std::size_t menu = 1; menu <= kMaxMenus; ++menu) put_text(body, menu_at(wire.dialect, menu), kMenus[menu - 1]);
  body[body_bytes - 1] = checksum(body.first(checked_bytes(wire, body_bytes - 1)));
  return total;
}

std::optional<ParameterSlot> read_slot(std::span<const std::uint8_t> list, std::uint16_t index) noexcept {
  if (list.size() < kHeaderBytes + kFirstSlot) return std::nullopt;
  const auto body = list.subspan(kHeaderBytes);
  const std::size_t at = slot_at(index);
  if (index < 1 || index > body[1] || at + kSlotBytes > body.size()) return std::nullopt;
  const auto bytes = body.subspan(at, kSlotBytes);
  ParameterSlot slot;
  slot.type = static_cast<ParameterType>(bytes[0]);
  slot.count = bytes[1];
  const std::size_t value_size = slot.count * value_bytes(slot.type);
  if (kValuesInSlot + value_size >= kSlotBytes) return std::nullopt;
  slot.values = bytes.subspan(kValuesInSlot, value_size);
  const auto text = bytes.subspan(kValuesInSlot + value_size);
  const auto end = std::find(text.begin(), text.end(), std::uint8_t{0});
  slot.text = {reinterpret_cast<const char*>(text.data()), static_cast<std::size_t>(end - text.begin())};
  const auto menu = std::find_if(end, text.end(), [](std::uint8_t b) { return b != 0; });
  if (slot.type == ParameterType::flag && menu != text.end()) slot.menu = *menu;
  return slot;
}

std::optional<ParameterValues> decode_parameter_list(Wire wire, std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() != list_bytes(wire.dialect) || bytes[0] != kStartByte || bytes[1] != kStartByte) return std::nullopt;
  const auto body = bytes.subspan(kHeaderBytes);
  const bool advanced = wire.dialect == Dialect::six && body[1] == kSlotsOfAdvanced;
  if (body[0] != static_cast<std::uint8_t>(Command::parameters) || (body[1] != slots(wire.dialect) && !advanced) ||
      !checksum_ok(wire, body))
    return std::nullopt;
  ParameterValues values;
  values.advanced = advanced;
  if (const auto rate = advanced ? read_slot(bytes, kSlotsOfAdvanced) : std::nullopt; rate && !rate->values.empty())
    values.rate_limiter = rate->values.front();
  for (const ParameterInfo& info : parameter_table(wire.dialect)) {
    const auto slot = read_slot(bytes, static_cast<std::uint16_t>(info.id));
    if (!slot || slot->type != info.type || slot->count != info.count) return std::nullopt;
    ByteReader in{slot->values};
    read_value(in, values, info.id);
  }
  return values;
}

}  // namespace vsa::bus
