// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What both versions of the interface make of an instance. Each library (an actuator's, a world's) defines open_model().
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "vsa/errors.hpp"
#include "vsa/fmu/instance.hpp"
#include "vsa/fmu/resources.hpp"
#include "vsa/hash.hpp"

namespace vsa::fmu {

/// The model that a folder of resources describes. Throws InputError.
[[nodiscard]] std::unique_ptr<Model> open_model(const std::filesystem::path& resources);

/// Null where the token isn't the folder's, or the model can't be made; the logger is told why.
[[nodiscard]] inline std::unique_ptr<Instance> open_instance(const char* call, const char* token, const char* resources,
                                                             const Instance::Logger& logger) noexcept {
  const auto refuse = [&](const std::string& text) {
    try {
      if (logger) logger(Status::error, kLogError, std::string(call) + ": " + text);
    } catch (...) {  // the importer's own
    }
  };
  try {
    if (resources == nullptr || token == nullptr) {
      refuse("no token or no folder of resources given");
      return nullptr;
    }
    const std::filesystem::path folder = path_of_uri(resources);
    const std::string expected = token_of(read_resources(folder));
    if (expected != token) {
      refuse("the token " + std::string(token) + " isn't that of " + folder.string() + ", " + expected +
             ": modelDescription.xml and resources are of different exports");
      return nullptr;
    }
    return std::make_unique<Instance>(open_model(folder), fnv1a(expected), logger);
  } catch (const InputError& error) {
    for (const Problem& p : error.problems()) refuse(p.text());
  } catch (const std::exception& error) {
    refuse(error.what());
  } catch (...) {
    refuse("failed");
  }
  return nullptr;
}

/// Values of one of C's types, as the instance has them.
template <class T>
Status get_values(Instance& instance, const char* call, Kind kind, const Reference* references, std::size_t count,
                  T* values) noexcept {
  if (count == 0) return Status::ok;
  if (references == nullptr || values == nullptr) return instance.refuse(call, "no room for values, or no value references");
  try {
    std::vector<double> numbers(count);
    const Status status = instance.get(call, kind, {references, count}, numbers);
    if (status != Status::ok) return status;
    for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<T>(numbers[i]);
    return status;
  } catch (...) {
    return instance.refuse(call, "out of memory");
  }
}

template <class T>
Status set_values(Instance& instance, const char* call, Kind kind, const Reference* references, std::size_t count,
                  const T* values) noexcept {
  if (count == 0) return Status::ok;
  if (references == nullptr || values == nullptr) return instance.refuse(call, "no values, or no value references");
  try {
    return instance.set(call, kind, {references, count}, std::vector<double>(values, values + count));
  } catch (...) {
    return instance.refuse(call, "out of memory");
  }
}

/// Any number but 0 is on.
template <class T>
Status set_switches(Instance& instance, const char* call, const Reference* references, std::size_t count,
                    const T* values) noexcept {
  if (count == 0) return Status::ok;
  if (references == nullptr || values == nullptr) return instance.refuse(call, "no values, or no value references");
  try {
    std::vector<double> numbers(count);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = values[i] ? 1 : 0;
    return instance.set(call, Kind::boolean, {references, count}, numbers);
  } catch (...) {
    return instance.refuse(call, "out of memory");
  }
}

template <class T>
Status get_switches(Instance& instance, const char* call, const Reference* references, std::size_t count, T* values) noexcept {
  if (count == 0) return Status::ok;
  if (references == nullptr || values == nullptr) return instance.refuse(call, "no room for values, or no value references");
  try {
    std::vector<double> numbers(count);
    const Status status = instance.get(call, Kind::boolean, {references, count}, numbers);
    for (std::size_t i = 0; i < count && status == Status::ok; ++i) values[i] = static_cast<T>(numbers[i] != 0);
    return status;
  } catch (...) {
    return instance.refuse(call, "out of memory");
  }
}

/// Those of FMI 3.0, which tells how many values there are: all variables are scalars.
inline constexpr const char* kOneEach = "all variables are scalars: as many values as value references, please";
template <class T>
Status get_all(Instance& instance, const char* call, Kind kind, const Reference* references, std::size_t count, T* values,
               std::size_t room) noexcept {
  return count == room ? get_values(instance, call, kind, references, count, values) : instance.refuse(call, kOneEach);
}
template <class T>
Status set_all(Instance& instance, const char* call, Kind kind, const Reference* references, std::size_t count, const T* values,
               std::size_t given) noexcept {
  return count == given ? set_values(instance, call, kind, references, count, values) : instance.refuse(call, kOneEach);
}

/// `categories`: none means all. Warnings and errors always come; this switches the rest.
inline Status set_logging(Instance& instance, const char* call, bool on, std::span<const char* const> categories) noexcept {
  bool rest = categories.empty();
  for (const char* given : categories) {
    const std::string_view category = given == nullptr ? "" : given;
    if (category != kLogInfo && category != kLogWarning && category != kLogError)
      return instance.refuse(call, "there is no such category of the log; there are logAll, logStatusWarning, logStatusError");
    rest = rest || category == kLogInfo;
  }
  if (rest) instance.set_logging(on);
  return Status::ok;
}

}  // namespace vsa::fmu
