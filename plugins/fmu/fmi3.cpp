// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// FMI 3.0, the functions of a co-simulation: each forwards to the instance (vsa/fmu/instance.hpp), which knows what is allowed.
#include "fmi3.hpp"

#include <algorithm>

#include "fmi3_shared.hpp"

using vsa::fmu::Component3;
using vsa::fmu::Instance;
using vsa::fmu::Kind;
using vsa::fmu::Status;
using vsa::fmu::with3;

extern "C" {

const char* fmi3GetVersion() { return "3.0"; }

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean, fmi3Boolean logging,
                                         fmi3Boolean event_mode, fmi3Boolean, const fmi3ValueReference[], std::size_t intermediate,
                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                         fmi3IntermediateUpdateCallback) {
  constexpr const char* kCall = "fmi3InstantiateCoSimulation";
  try {
    const Instance::Logger logger = [log, environment](Status status, const char* category, const std::string& text) {
      if (log != nullptr) log(environment, vsa::fmu::word3(status), category, text.c_str());
    };
    const char* wrong = name == nullptr || *name == '\0' ? "an instance needs a name"
                        : event_mode                     ? "this FMU has no event mode"
                        : intermediate > 0               ? "this FMU has no intermediate values"
                                                         : nullptr;
    if (wrong != nullptr) {
      logger(Status::error, vsa::fmu::kLogError, std::string(kCall) + ": " + wrong);
      return nullptr;
    }
    auto instance = vsa::fmu::open_instance(kCall, token, resources, logger);
    if (!instance) return nullptr;
    instance->set_logging(logging);
    return std::make_unique<Component3>(Component3{std::move(instance)}).release();
  } catch (...) {
    return nullptr;
  }
}

void fmi3FreeInstance(fmi3Instance c) { delete static_cast<Component3*>(c); }

fmi3Status fmi3SetDebugLogging(fmi3Instance c, fmi3Boolean on, std::size_t count, const fmi3String categories[]) {
  return with3(c, [&](Instance& i) { return vsa::fmu::set_logging(i, "fmi3SetDebugLogging", on, {categories, count}); });
}
fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean, fmi3Float64, fmi3Float64 start, fmi3Boolean has_stop,
                                       fmi3Float64 stop) {
  return with3(c, [&](Instance& i) {
    constexpr const char* kCall = "fmi3EnterInitializationMode";
    const Status status = i.set_up(kCall, start, has_stop, stop);
    return status == Status::ok ? i.enter_initialization(kCall) : status;
  });
}
fmi3Status fmi3ExitInitializationMode(fmi3Instance c) {
  return with3(c, [](Instance& i) { return i.exit_initialization("fmi3ExitInitializationMode"); });
}
fmi3Status fmi3Terminate(fmi3Instance c) {
  return with3(c, [](Instance& i) { return i.terminate("fmi3Terminate"); });
}
fmi3Status fmi3Reset(fmi3Instance c) {
  return with3(c, [](Instance& i) { return i.reset("fmi3Reset"); });
}

fmi3Status fmi3GetFloat64(fmi3Instance c, const fmi3ValueReference vr[], std::size_t n, fmi3Float64 v[], std::size_t nv) {
  return with3(c, [&](Instance& i) { return vsa::fmu::get_all(i, "fmi3GetFloat64", Kind::real, vr, n, v, nv); });
}
fmi3Status fmi3SetFloat64(fmi3Instance c, const fmi3ValueReference vr[], std::size_t n, const fmi3Float64 v[], std::size_t nv) {
  return with3(c, [&](Instance& i) { return vsa::fmu::set_all(i, "fmi3SetFloat64", Kind::real, vr, n, v, nv); });
}
fmi3Status fmi3GetInt32(fmi3Instance c, const fmi3ValueReference vr[], std::size_t n, fmi3Int32 v[], std::size_t nv) {
  return with3(c, [&](Instance& i) { return vsa::fmu::get_all(i, "fmi3GetInt32", Kind::integer, vr, n, v, nv); });
}
fmi3Status fmi3SetInt32(fmi3Instance c, const fmi3ValueReference vr[], std::size_t n, const fmi3Int32 v[], std::size_t nv) {
  return with3(c, [&](Instance& i) { return vsa::fmu::set_all(i, "fmi3SetInt32", Kind::integer, vr, n, v, nv); });
}
// Enumerations are 64 bits wide here.
fmi3Status fmi3GetInt64(fmi3Instance c, const fmi3ValueReference vr[], std::size_t n, fmi3Int64 v[], std::size_t nv) {
  return with3(c, [&](Instance& i) { return vsa::fmu::get_all(i, "fmi3GetInt64", Kind::enumeration, vr, n, v, nv); });
}
fmi3Status fmi3SetInt64(fmi3Instance c, const fmi3ValueReference vr[], std::size_t n, const fmi3Int64 v[], std::size_t nv) {
  return with3(c, [&](Instance& i) { return vsa::fmu::set_all(i, "fmi3SetInt64", Kind::enumeration, vr, n, v, nv); });
}
fmi3Status fmi3GetBoolean(fmi3Instance c, const fmi3ValueReference vr[], std::size_t n, fmi3Boolean v[], std::size_t nv) {
  return with3(c, [&](Instance& i) {
    constexpr const char* kCall = "fmi3GetBoolean";
    return n == nv ? vsa::fmu::get_switches(i, kCall, vr, n, v) : i.refuse(kCall, vsa::fmu::kOneEach);
  });
}
fmi3Status fmi3SetBoolean(fmi3Instance c, const fmi3ValueReference vr[], std::size_t n, const fmi3Boolean v[], std::size_t nv) {
  return with3(c, [&](Instance& i) {
    constexpr const char* kCall = "fmi3SetBoolean";
    return n == nv ? vsa::fmu::set_switches(i, kCall, vr, n, v) : i.refuse(kCall, vsa::fmu::kOneEach);
  });
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance c, fmi3ValueReference dependent, std::size_t* count) {
  return with3(c, [&](Instance& i) {
    constexpr const char* kCall = "fmi3GetNumberOfVariableDependencies";
    const auto& all = i.model().variables();
    if (dependent >= all.size() || count == nullptr)
      return i.refuse(kCall, "there is no such variable, or no place for the number");
    *count = all[dependent].depends_on.size();
    return Status::ok;
  });
}
fmi3Status fmi3GetVariableDependencies(fmi3Instance c, fmi3ValueReference dependent, std::size_t of_dependent[],
                                       fmi3ValueReference independents[], std::size_t of_independent[], fmi3DependencyKind kinds[],
                                       std::size_t count) {
  return with3(c, [&](Instance& i) {
    constexpr const char* kCall = "fmi3GetVariableDependencies";
    const auto& all = i.model().variables();
    if (dependent >= all.size()) return i.refuse(kCall, "there is no such variable");
    const auto& on = all[dependent].depends_on;
    if (count != on.size()) return i.refuse(kCall, "it has another number of dependencies");
    for (std::size_t k = 0; k < count; ++k) {
      of_dependent[k] = of_independent[k] = 0;  // of scalars: the whole
      independents[k] = on[k];
      kinds[k] = fmi3Dependent;
    }
    return Status::ok;
  });
}

fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState* state) {
  return with3(c, [&](Instance& i) { return i.save("fmi3GetFMUState", state); });
}
fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state) {
  return with3(c, [&](Instance& i) { return i.restore("fmi3SetFMUState", state); });
}
fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState* state) {
  return with3(c, [&](Instance& i) { return i.free_state("fmi3FreeFMUState", state); });
}
fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, std::size_t* size) {
  return with3(c, [&](Instance& i) { return i.size_of_state("fmi3SerializedFMUStateSize", state, size); });
}
fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], std::size_t size) {
  return with3(c, [&](Instance& i) {
    return i.serialize("fmi3SerializeFMUState", state, {reinterpret_cast<char*>(bytes), bytes == nullptr ? 0 : size});
  });
}
fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte bytes[], std::size_t size, fmi3FMUState* state) {
  return with3(c, [&](Instance& i) {
    return i.deserialize("fmi3DeserializeFMUState", {reinterpret_cast<const char*>(bytes), bytes == nullptr ? 0 : size}, state);
  });
}
fmi3Status fmi3GetDirectionalDerivative(fmi3Instance c, const fmi3ValueReference unknowns[], std::size_t nu,
                                        const fmi3ValueReference knowns[], std::size_t nk, const fmi3Float64 seed[], std::size_t ns,
                                        fmi3Float64 sensitivity[], std::size_t nn) {
  return with3(c, [&](Instance& i) {
    return i.derivatives("fmi3GetDirectionalDerivative", {unknowns, nu}, {knowns, nk}, {seed, ns}, {sensitivity, nn});
  });
}
fmi3Status fmi3GetAdjointDerivative(fmi3Instance c, const fmi3ValueReference unknowns[], std::size_t nu,
                                    const fmi3ValueReference knowns[], std::size_t nk, const fmi3Float64 seed[], std::size_t ns,
                                    fmi3Float64 sensitivity[], std::size_t nn) {
  return with3(c, [&](Instance& i) {
    return i.adjoint("fmi3GetAdjointDerivative", {unknowns, nu}, {knowns, nk}, {seed, ns}, {sensitivity, nn});
  });
}

fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 point, fmi3Float64 step, fmi3Boolean, fmi3Boolean* event, fmi3Boolean* terminate,
                      fmi3Boolean* early_return, fmi3Float64* last_successful) {
  return with3(c, [&](Instance& i) {
    const Status status = i.step("fmi3DoStep", point, step);
    for (fmi3Boolean* flag : {event, terminate, early_return})
      if (flag != nullptr) *flag = false;
    // The communication point reached, as the importer counts; the unit's own time is it in whole nanoseconds.
    if (last_successful != nullptr) *last_successful = status == Status::ok ? point + step : i.time_s();
    return status;
  });
}
}
