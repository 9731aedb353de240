// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// FMI 2.0: each function forwards to the instance (vsa/fmu/instance.hpp), which knows what is allowed.
#include "fmi2.hpp"

#include "component.hpp"

using vsa::fmu::Instance;
using vsa::fmu::Kind;
using vsa::fmu::Mode;
using vsa::fmu::Status;

namespace {

struct Component {
  std::string name;
  std::unique_ptr<Instance> instance;
};

Instance* instance_of(fmi2Component c) { return c == nullptr ? nullptr : static_cast<Component*>(c)->instance.get(); }
fmi2Status word(Status status) { return static_cast<fmi2Status>(static_cast<int>(status)); }

/// Runs `work` on the instance; without one there is nobody to tell.
template <class Work>
fmi2Status with(fmi2Component c, const Work& work) noexcept {
  Instance* instance = instance_of(c);
  return instance == nullptr ? fmi2Error : word(work(*instance));
}

/// The text stands in the place of the format: importers that take no further arguments show it as it is.
Instance::Logger logger_of(const fmi2CallbackFunctions& f, const std::string& name) {
  return [log = f.logger, env = f.componentEnvironment, name](Status status, const char* category, const std::string& text) {
    if (log == nullptr) return;
    std::string format;
    for (const char c : text) format += c == '%' ? std::string("%%") : std::string(1, c);
    log(env, name.c_str(), word(status), category, format.c_str());
  };
}

}  // namespace

extern "C" {

const char* fmi2GetTypesPlatform() { return "default"; }
const char* fmi2GetVersion() { return "2.0"; }

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions* functions, fmi2Boolean, fmi2Boolean logging) {
  constexpr const char* kCall = "fmi2Instantiate";
  if (functions == nullptr) return nullptr;
  try {
    const Instance::Logger logger = logger_of(*functions, name == nullptr ? "" : name);
    const char* wrong = name == nullptr || *name == '\0' ? "an instance needs a name"
                        : type != fmi2CoSimulation       ? "this FMU is for co-simulation only"
                                                         : nullptr;
    if (wrong != nullptr) {
      logger(Status::error, vsa::fmu::kLogError, std::string(kCall) + ": " + wrong);
      return nullptr;
    }
    auto instance = vsa::fmu::open_instance(kCall, guid, resources, logger);
    if (!instance) return nullptr;
    instance->set_logging(logging != 0);
    return std::make_unique<Component>(Component{name, std::move(instance)}).release();
  } catch (...) {
    return nullptr;
  }
}

void fmi2FreeInstance(fmi2Component c) { delete static_cast<Component*>(c); }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, std::size_t count, const fmi2String categories[]) {
  return with(c, [&](Instance& i) { return vsa::fmu::set_logging(i, "fmi2SetDebugLogging", on != 0, {categories, count}); });
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean, fmi2Real, fmi2Real start, fmi2Boolean has_stop, fmi2Real stop) {
  return with(c, [&](Instance& i) { return i.set_up("fmi2SetupExperiment", start, has_stop != 0, stop); });
}
fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  return with(c, [](Instance& i) { return i.enter_initialization("fmi2EnterInitializationMode"); });
}
fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  return with(c, [](Instance& i) { return i.exit_initialization("fmi2ExitInitializationMode"); });
}
fmi2Status fmi2Terminate(fmi2Component c) {
  return with(c, [](Instance& i) { return i.terminate("fmi2Terminate"); });
}
fmi2Status fmi2Reset(fmi2Component c) {
  return with(c, [](Instance& i) { return i.reset("fmi2Reset"); });
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], std::size_t n, fmi2Real v[]) {
  return with(c, [&](Instance& i) { return vsa::fmu::get_values(i, "fmi2GetReal", Kind::real, vr, n, v); });
}
fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], std::size_t n, fmi2Integer v[]) {
  return with(c, [&](Instance& i) { return vsa::fmu::get_values(i, "fmi2GetInteger", Kind::integer, vr, n, v); });
}
fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], std::size_t n, fmi2Boolean v[]) {
  return with(c, [&](Instance& i) { return vsa::fmu::get_switches(i, "fmi2GetBoolean", vr, n, v); });
}
fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference[], std::size_t n, fmi2String[]) {
  return with(c, [&](Instance& i) { return n == 0 ? Status::ok : i.refuse("fmi2GetString", "this FMU has no strings"); });
}
fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], std::size_t n, const fmi2Real v[]) {
  return with(c, [&](Instance& i) { return vsa::fmu::set_values(i, "fmi2SetReal", Kind::real, vr, n, v); });
}
fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], std::size_t n, const fmi2Integer v[]) {
  return with(c, [&](Instance& i) { return vsa::fmu::set_values(i, "fmi2SetInteger", Kind::integer, vr, n, v); });
}
fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], std::size_t n, const fmi2Boolean v[]) {
  return with(c, [&](Instance& i) { return vsa::fmu::set_switches(i, "fmi2SetBoolean", vr, n, v); });
}
fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference[], std::size_t n, const fmi2String[]) {
  return with(c, [&](Instance& i) { return n == 0 ? Status::ok : i.refuse("fmi2SetString", "this FMU has no strings"); });
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* state) {
  return with(c, [&](Instance& i) { return i.save("fmi2GetFMUstate", state); });
}
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  return with(c, [&](Instance& i) { return i.restore("fmi2SetFMUstate", state); });
}
fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate* state) {
  return with(c, [&](Instance& i) { return i.free_state("fmi2FreeFMUstate", state); });
}
fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, std::size_t* size) {
  return with(c, [&](Instance& i) { return i.size_of_state("fmi2SerializedFMUstateSize", state, size); });
}
fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], std::size_t size) {
  return with(c, [&](Instance& i) { return i.serialize("fmi2SerializeFMUstate", state, {bytes, bytes == nullptr ? 0 : size}); });
}
fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], std::size_t size, fmi2FMUstate* state) {
  return with(c, [&](Instance& i) {
    return i.deserialize("fmi2DeSerializeFMUstate", {bytes, bytes == nullptr ? 0 : size}, state);
  });
}
fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[], std::size_t unknowns,
                                        const fmi2ValueReference known[], std::size_t knowns, const fmi2Real seed[],
                                        fmi2Real sensitivity[]) {
  return with(c, [&](Instance& i) {
    return i.derivatives("fmi2GetDirectionalDerivative", {unknown, unknowns}, {known, knowns}, {seed, knowns},
                         {sensitivity, unknowns});
  });
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference[], std::size_t n, const fmi2Integer[],
                                       const fmi2Real[]) {
  return with(c, [&](Instance& i) {
    return n == 0 ? Status::ok : i.refuse("fmi2SetRealInputDerivatives", "this FMU doesn't interpolate its inputs");
  });
}
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference[], std::size_t n, const fmi2Integer[],
                                        fmi2Real[]) {
  return with(c, [&](Instance& i) {
    return n == 0 ? Status::ok : i.refuse("fmi2GetRealOutputDerivatives", "this FMU has no derivatives of its outputs by time");
  });
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real point, fmi2Real step, fmi2Boolean) {
  return with(c, [&](Instance& i) { return i.step("fmi2DoStep", point, step); });
}
fmi2Status fmi2CancelStep(fmi2Component c) {
  return with(c,
              [](Instance& i) { return i.refuse("fmi2CancelStep", "no step is under way: steps end before fmi2DoStep returns"); });
}

fmi2Status fmi2GetStatus(fmi2Component c, fmi2StatusKind, fmi2Status*) {
  return with(c, [](Instance& i) { return i.refuse("fmi2GetStatus", "steps end before fmi2DoStep returns"); });
}
fmi2Status fmi2GetRealStatus(fmi2Component c, fmi2StatusKind kind, fmi2Real* value) {
  return with(c, [&](Instance& i) {
    if (kind != fmi2LastSuccessfulTime || value == nullptr) return i.refuse("fmi2GetRealStatus", "only fmi2LastSuccessfulTime");
    *value = i.time_s();
    return Status::ok;
  });
}
fmi2Status fmi2GetIntegerStatus(fmi2Component c, fmi2StatusKind, fmi2Integer*) {
  return with(c, [](Instance& i) { return i.refuse("fmi2GetIntegerStatus", "there is none"); });
}
fmi2Status fmi2GetBooleanStatus(fmi2Component c, fmi2StatusKind kind, fmi2Boolean* value) {
  return with(c, [&](Instance& i) {
    if (kind != fmi2Terminated || value == nullptr) return i.refuse("fmi2GetBooleanStatus", "only fmi2Terminated");
    *value = i.mode() == Mode::terminated ? 1 : 0;
    return Status::ok;
  });
}
fmi2Status fmi2GetStringStatus(fmi2Component c, fmi2StatusKind, fmi2String*) {
  return with(c, [](Instance& i) { return i.refuse("fmi2GetStringStatus", "there is none"); });
}
}
