// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A client's side of the conversation: one request, one answer, on any Channel. Works against the simulated unit and real hardware.
//
// Before a request pending input is thrown away, as the public client libraries do. An answer counts if it is a right frame from the
// unit asked and can be this command's; everything else on the line is passed over until the time-out.
#pragma once

#include <cassert>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "vsa/bus/channel.hpp"
#include "vsa/bus/codec.hpp"
#include "vsa/bus/messages.hpp"
#include "vsa/bus/parameters.hpp"

namespace vsa::bus {

/// How a client speaks, and how long it waits.
struct ClientOptions {
  Wire wire{};                                                  ///< as the units speak
  Channel::Time reply_timeout = std::chrono::milliseconds(20);  ///< of a whole answer
  /// Until the first byte of the info text or parameter list, and of an answer that waits for the unit's memory to be written.
  Channel::Time slow_timeout = std::chrono::seconds(2);
  /// Dialect six's info text has no end but silence.
  Channel::Time silence = std::chrono::milliseconds(50);
  int attempts = 1;  ///< a request that got no answer is sent again until this many were sent; at least 1
};

/// Why there is no answer.
enum class ClientError : std::uint8_t {
  timeout,    ///< no answer, or none that could be read
  closed,     ///< the channel is gone
  refused,    ///< the unit answered "not done"
  malformed,  ///< an answer came, but not as this dialect has it
  bad_value,  ///< not of the parameter's type, or the dialect has no such parameter; nothing was sent
};
[[nodiscard]] const char* describe(ClientError error) noexcept;  ///< in words, for a user

/// A value, or why there is none.
template <class T>
class Result {
 public:
  /// Holds a value.
  Result(T value) noexcept : content_(std::move(value)) {}  // NOLINT: implicit on purpose, `return value;`
  /// Holds none.
  Result(ClientError error) noexcept : content_(error) {}  // NOLINT: likewise
  /// Whether there is a value.
  [[nodiscard]] explicit operator bool() const noexcept { return std::holds_alternative<T>(content_); }
  /// Only if there is a value.
  [[nodiscard]] const T& operator*() const noexcept {
    assert(*this);
    return *std::get_if<T>(&content_);
  }
  [[nodiscard]] const T* operator->() const noexcept { return &**this; }  ///< only if there is a value
  /// Only if there is no value.
  [[nodiscard]] ClientError error() const noexcept { return *std::get_if<ClientError>(&content_); }

 private:
  std::variant<T, ClientError> content_;
};

/// Instead of a value where a request has none to give.
struct Done {
  bool operator==(const Done&) const = default;
};

/// A client's side of the conversation: one request, one answer, on any Channel. Every call blocks until the answer or its
/// time-out; one thread.
class Client {
 public:
  Client(Channel& channel, ClientOptions options) : channel_(channel), options_(options) {}  ///< the channel must outlive it

  [[nodiscard]] Result<PingReply> ping(std::uint8_t id);  ///< in dialect six its serial number is 0
  /// Which dialect the unit speaks, by the length of its ping: firmware 7.0, which sends no serial number, looks like six.
  [[nodiscard]] Result<Dialect> dialect(std::uint8_t id);
  /// The ids of `first` … `last` that answer a ping. `each` is the time for one id.
  [[nodiscard]] Result<std::vector<std::uint8_t>> scan(std::uint8_t first, std::uint8_t last, Channel::Time each);

  /// Not answered by the unit: Done means sent.
  [[nodiscard]] Result<Done> activate(std::uint8_t id, bool on);
  [[nodiscard]] Result<bool> active(std::uint8_t id);                                   ///< whether the motors are on
  [[nodiscard]] Result<Done> set_inputs(std::uint8_t id, std::array<Ticks, 2> inputs);  ///< not answered: Done means sent
  /// Not answered: Done means sent.
  [[nodiscard]] Result<Done> set_position_stiffness(std::uint8_t id, Ticks position, std::int16_t stiffness);
  [[nodiscard]] Result<InputsReply> inputs(std::uint8_t id);              ///< the references that the unit has
  [[nodiscard]] Result<MeasurementsReply> measurements(std::uint8_t id);  ///< as the unit itself reads them
  [[nodiscard]] Result<CurrentsReply> currents(std::uint8_t id);          ///< filtered by the program
  [[nodiscard]] Result<CurrentsAndMeasurementsReply> currents_and_measurements(std::uint8_t id);  ///< both in one answer

  [[nodiscard]] Result<std::string> info(std::uint8_t id);  ///< the unit's text about itself
  /// The list as sent, header included; see decode_parameter_list and read_slot.
  [[nodiscard]] Result<std::vector<std::uint8_t>> parameter_list(std::uint8_t id);
  /// The list, decoded; malformed: one that decode_parameter_list() refuses.
  [[nodiscard]] Result<ParameterValues> parameters(std::uint8_t id);
  /// Dialect six doesn't answer: Done means sent. It acts after `store`.
  [[nodiscard]] Result<Done> set_parameter(std::uint8_t id, ParameterId parameter, const ParameterValue& value);
  [[nodiscard]] Result<Done> store(std::uint8_t id);  ///< what set_parameter() changed into the unit's EEPROM

  /// Any other request that is answered by an acknowledgement: StoreDefaults, RestoreDefaults, InitMemory, Calibrate, SetZeros…
  [[nodiscard]] Result<Done> acknowledge(std::uint8_t id, const Request& request);
  /// Any request that isn't answered.
  [[nodiscard]] Result<Done> send(std::uint8_t id, const Request& request);

 private:
  [[nodiscard]] Result<Frame> exchange(std::uint8_t id, const Request& request, Channel::Time timeout);
  [[nodiscard]] Result<Frame> await_frame(std::uint8_t id, Command command, Channel::Time timeout);
  [[nodiscard]] Result<Done> read_some(std::vector<std::uint8_t>& into, Channel::Time timeout);
  [[nodiscard]] Result<std::vector<std::uint8_t>> long_packet(std::uint8_t id, const Request& request);
  [[nodiscard]] bool drain();
  template <class R>
  [[nodiscard]] Result<typename R::Reply> ask(std::uint8_t id, const R& request);

  Channel& channel_;
  ClientOptions options_;
};

}  // namespace vsa::bus
