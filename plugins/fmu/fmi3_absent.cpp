// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// FMI 3.0, the functions that a library has to export for what this FMU hasn't got: values of other types, clocks, events,
// configuration, model exchange. With nothing to get or set the functions of values are content.
#include "fmi3_shared.hpp"

using vsa::fmu::absent3;
using vsa::fmu::Instance;
using vsa::fmu::Status;
using vsa::fmu::with3;

namespace {

fmi3Status no_values(fmi3Instance c, const char* call, std::size_t count) noexcept {
  return with3(c, [&](Instance& i) {
    return count == 0 ? Status::ok
                      : i.refuse(call, "this FMU has no such variables: Float64, Int32, Boolean and enumerations only");
  });
}

constexpr const char* kNoClocks = "this FMU has no clocks";
constexpr const char* kNoEvents = "this FMU has no event mode";
constexpr const char* kNoConfiguration = "this FMU has no structural parameters";
constexpr const char* kNoExchange = "this FMU is for co-simulation only";

}  // namespace

extern "C" {

#define VSA_FMI3_NO_VALUES(Type)                                                                                         \
  fmi3Status fmi3Get##Type(fmi3Instance c, const fmi3ValueReference[], std::size_t n, fmi3##Type[], std::size_t) {       \
    return no_values(c, "fmi3Get" #Type, n);                                                                             \
  }                                                                                                                      \
  fmi3Status fmi3Set##Type(fmi3Instance c, const fmi3ValueReference[], std::size_t n, const fmi3##Type[], std::size_t) { \
    return no_values(c, "fmi3Set" #Type, n);                                                                             \
  }
VSA_FMI3_NO_VALUES(Float32)
VSA_FMI3_NO_VALUES(Int8)
VSA_FMI3_NO_VALUES(UInt8)
VSA_FMI3_NO_VALUES(Int16)
VSA_FMI3_NO_VALUES(UInt16)
VSA_FMI3_NO_VALUES(UInt32)
VSA_FMI3_NO_VALUES(UInt64)
VSA_FMI3_NO_VALUES(String)
#undef VSA_FMI3_NO_VALUES

fmi3Status fmi3GetBinary(fmi3Instance c, const fmi3ValueReference[], std::size_t n, std::size_t[], fmi3Binary[], std::size_t) {
  return no_values(c, "fmi3GetBinary", n);
}
fmi3Status fmi3SetBinary(fmi3Instance c, const fmi3ValueReference[], std::size_t n, const std::size_t[], const fmi3Binary[],
                         std::size_t) {
  return no_values(c, "fmi3SetBinary", n);
}
fmi3Status fmi3GetClock(fmi3Instance c, const fmi3ValueReference[], std::size_t n, fmi3Clock[]) {
  return no_values(c, "fmi3GetClock", n);
}
fmi3Status fmi3SetClock(fmi3Instance c, const fmi3ValueReference[], std::size_t n, const fmi3Clock[]) {
  return no_values(c, "fmi3SetClock", n);
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                          fmi3InstanceEnvironment environment, fmi3LogMessageCallback log) {
  if (log != nullptr) log(environment, fmi3Error, vsa::fmu::kLogError, "fmi3InstantiateModelExchange: co-simulation only");
  return nullptr;
}
fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                               fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                               fmi3ClockUpdateCallback, fmi3LockPreemptionCallback, fmi3UnlockPreemptionCallback) {
  if (log != nullptr) log(environment, fmi3Error, vsa::fmu::kLogError, "fmi3InstantiateScheduledExecution: co-simulation only");
  return nullptr;
}

fmi3Status fmi3EnterEventMode(fmi3Instance c) { return absent3(c, "fmi3EnterEventMode", kNoEvents); }
fmi3Status fmi3EnterStepMode(fmi3Instance c) { return absent3(c, "fmi3EnterStepMode", kNoEvents); }
fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance c) { return absent3(c, "fmi3EvaluateDiscreteStates", kNoEvents); }
fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*,
                                    fmi3Float64*) {
  return absent3(c, "fmi3UpdateDiscreteStates", kNoEvents);
}
fmi3Status fmi3EnterConfigurationMode(fmi3Instance c) { return absent3(c, "fmi3EnterConfigurationMode", kNoConfiguration); }
fmi3Status fmi3ExitConfigurationMode(fmi3Instance c) { return absent3(c, "fmi3ExitConfigurationMode", kNoConfiguration); }

fmi3Status fmi3GetIntervalDecimal(fmi3Instance c, const fmi3ValueReference[], std::size_t, fmi3Float64[], fmi3IntervalQualifier[]) {
  return absent3(c, "fmi3GetIntervalDecimal", kNoClocks);
}
fmi3Status fmi3GetIntervalFraction(fmi3Instance c, const fmi3ValueReference[], std::size_t, fmi3UInt64[], fmi3UInt64[],
                                   fmi3IntervalQualifier[]) {
  return absent3(c, "fmi3GetIntervalFraction", kNoClocks);
}
fmi3Status fmi3GetShiftDecimal(fmi3Instance c, const fmi3ValueReference[], std::size_t, fmi3Float64[]) {
  return absent3(c, "fmi3GetShiftDecimal", kNoClocks);
}
fmi3Status fmi3GetShiftFraction(fmi3Instance c, const fmi3ValueReference[], std::size_t, fmi3UInt64[], fmi3UInt64[]) {
  return absent3(c, "fmi3GetShiftFraction", kNoClocks);
}
fmi3Status fmi3SetIntervalDecimal(fmi3Instance c, const fmi3ValueReference[], std::size_t, const fmi3Float64[]) {
  return absent3(c, "fmi3SetIntervalDecimal", kNoClocks);
}
fmi3Status fmi3SetIntervalFraction(fmi3Instance c, const fmi3ValueReference[], std::size_t, const fmi3UInt64[],
                                   const fmi3UInt64[]) {
  return absent3(c, "fmi3SetIntervalFraction", kNoClocks);
}
fmi3Status fmi3SetShiftDecimal(fmi3Instance c, const fmi3ValueReference[], std::size_t, const fmi3Float64[]) {
  return absent3(c, "fmi3SetShiftDecimal", kNoClocks);
}
fmi3Status fmi3SetShiftFraction(fmi3Instance c, const fmi3ValueReference[], std::size_t, const fmi3UInt64[], const fmi3UInt64[]) {
  return absent3(c, "fmi3SetShiftFraction", kNoClocks);
}
fmi3Status fmi3ActivateModelPartition(fmi3Instance c, fmi3ValueReference, fmi3Float64) {
  return absent3(c, "fmi3ActivateModelPartition", kNoClocks);
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance c) { return absent3(c, "fmi3EnterContinuousTimeMode", kNoExchange); }
fmi3Status fmi3CompletedIntegratorStep(fmi3Instance c, fmi3Boolean, fmi3Boolean*, fmi3Boolean*) {
  return absent3(c, "fmi3CompletedIntegratorStep", kNoExchange);
}
fmi3Status fmi3SetTime(fmi3Instance c, fmi3Float64) { return absent3(c, "fmi3SetTime", kNoExchange); }
fmi3Status fmi3SetContinuousStates(fmi3Instance c, const fmi3Float64[], std::size_t) {
  return absent3(c, "fmi3SetContinuousStates", kNoExchange);
}
fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance c, fmi3Float64[], std::size_t) {
  return absent3(c, "fmi3GetContinuousStateDerivatives", kNoExchange);
}
fmi3Status fmi3GetEventIndicators(fmi3Instance c, fmi3Float64[], std::size_t) {
  return absent3(c, "fmi3GetEventIndicators", kNoExchange);
}
fmi3Status fmi3GetContinuousStates(fmi3Instance c, fmi3Float64[], std::size_t) {
  return absent3(c, "fmi3GetContinuousStates", kNoExchange);
}
fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance c, fmi3Float64[], std::size_t) {
  return absent3(c, "fmi3GetNominalsOfContinuousStates", kNoExchange);
}
fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance c, std::size_t*) {
  return absent3(c, "fmi3GetNumberOfEventIndicators", kNoExchange);
}
fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance c, std::size_t*) {
  return absent3(c, "fmi3GetNumberOfContinuousStates", kNoExchange);
}
fmi3Status fmi3GetOutputDerivatives(fmi3Instance c, const fmi3ValueReference[], std::size_t n, const fmi3Int32[], fmi3Float64[],
                                    std::size_t) {
  return with3(c, [&](Instance& i) {
    return n == 0 ? Status::ok : i.refuse("fmi3GetOutputDerivatives", "this FMU has no derivatives of its outputs by time");
  });
}
}
