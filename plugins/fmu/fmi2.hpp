// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The C interface of FMI 2.0 for co-simulation, as far as a library has to export it: names, types and numbers are the standard's
// (fmi-standard.org, version 2.0.4), the text is ours. All that this project's library exports, and what its tests look up.
#pragma once

#include <cstddef>

#define VSA_FMI_EXPORT __attribute__((visibility("default")))

// NOLINTBEGIN(modernize-use-using,readability-identifier-naming): C's and the standard's
extern "C" {

typedef void* fmi2Component;             // an instance
typedef void* fmi2ComponentEnvironment;  // the importer's, handed back to its callbacks
typedef void* fmi2FMUstate;              // a saved state
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer;
typedef int fmi2Boolean;  // 0 or 1
typedef char fmi2Char;
typedef const fmi2Char* fmi2String;
typedef char fmi2Byte;

typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated } fmi2StatusKind;

typedef void (*fmi2CallbackLogger)(fmi2ComponentEnvironment, fmi2String instance, fmi2Status, fmi2String category,
                                   fmi2String format, ...);
typedef void* (*fmi2CallbackAllocateMemory)(std::size_t count, std::size_t size);
typedef void (*fmi2CallbackFreeMemory)(void*);
typedef void (*fmi2StepFinished)(fmi2ComponentEnvironment, fmi2Status);

typedef struct {
  fmi2CallbackLogger logger;
  fmi2CallbackAllocateMemory allocateMemory;
  fmi2CallbackFreeMemory freeMemory;
  fmi2StepFinished stepFinished;
  fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

// The instance's life.
VSA_FMI_EXPORT const char* fmi2GetTypesPlatform();
VSA_FMI_EXPORT const char* fmi2GetVersion();
VSA_FMI_EXPORT fmi2Status fmi2SetDebugLogging(fmi2Component, fmi2Boolean on, std::size_t count, const fmi2String categories[]);
VSA_FMI_EXPORT fmi2Component fmi2Instantiate(fmi2String name, fmi2Type, fmi2String guid, fmi2String resources,
                                             const fmi2CallbackFunctions*, fmi2Boolean visible, fmi2Boolean logging);
VSA_FMI_EXPORT void fmi2FreeInstance(fmi2Component);
VSA_FMI_EXPORT fmi2Status fmi2SetupExperiment(fmi2Component, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                                              fmi2Boolean has_stop, fmi2Real stop);
VSA_FMI_EXPORT fmi2Status fmi2EnterInitializationMode(fmi2Component);
VSA_FMI_EXPORT fmi2Status fmi2ExitInitializationMode(fmi2Component);
VSA_FMI_EXPORT fmi2Status fmi2Terminate(fmi2Component);
VSA_FMI_EXPORT fmi2Status fmi2Reset(fmi2Component);

// Values.
VSA_FMI_EXPORT fmi2Status fmi2GetReal(fmi2Component, const fmi2ValueReference[], std::size_t, fmi2Real[]);
VSA_FMI_EXPORT fmi2Status fmi2GetInteger(fmi2Component, const fmi2ValueReference[], std::size_t, fmi2Integer[]);
VSA_FMI_EXPORT fmi2Status fmi2GetBoolean(fmi2Component, const fmi2ValueReference[], std::size_t, fmi2Boolean[]);
VSA_FMI_EXPORT fmi2Status fmi2GetString(fmi2Component, const fmi2ValueReference[], std::size_t, fmi2String[]);
VSA_FMI_EXPORT fmi2Status fmi2SetReal(fmi2Component, const fmi2ValueReference[], std::size_t, const fmi2Real[]);
VSA_FMI_EXPORT fmi2Status fmi2SetInteger(fmi2Component, const fmi2ValueReference[], std::size_t, const fmi2Integer[]);
VSA_FMI_EXPORT fmi2Status fmi2SetBoolean(fmi2Component, const fmi2ValueReference[], std::size_t, const fmi2Boolean[]);
VSA_FMI_EXPORT fmi2Status fmi2SetString(fmi2Component, const fmi2ValueReference[], std::size_t, const fmi2String[]);

// States and derivatives.
VSA_FMI_EXPORT fmi2Status fmi2GetFMUstate(fmi2Component, fmi2FMUstate*);
VSA_FMI_EXPORT fmi2Status fmi2SetFMUstate(fmi2Component, fmi2FMUstate);
VSA_FMI_EXPORT fmi2Status fmi2FreeFMUstate(fmi2Component, fmi2FMUstate*);
VSA_FMI_EXPORT fmi2Status fmi2SerializedFMUstateSize(fmi2Component, fmi2FMUstate, std::size_t*);
VSA_FMI_EXPORT fmi2Status fmi2SerializeFMUstate(fmi2Component, fmi2FMUstate, fmi2Byte[], std::size_t);
VSA_FMI_EXPORT fmi2Status fmi2DeSerializeFMUstate(fmi2Component, const fmi2Byte[], std::size_t, fmi2FMUstate*);
VSA_FMI_EXPORT fmi2Status fmi2GetDirectionalDerivative(fmi2Component, const fmi2ValueReference unknown[], std::size_t,
                                                       const fmi2ValueReference known[], std::size_t, const fmi2Real seed[],
                                                       fmi2Real sensitivity[]);

// Steps.
VSA_FMI_EXPORT fmi2Status fmi2SetRealInputDerivatives(fmi2Component, const fmi2ValueReference[], std::size_t,
                                                      const fmi2Integer order[], const fmi2Real[]);
VSA_FMI_EXPORT fmi2Status fmi2GetRealOutputDerivatives(fmi2Component, const fmi2ValueReference[], std::size_t,
                                                       const fmi2Integer order[], fmi2Real[]);
VSA_FMI_EXPORT fmi2Status fmi2DoStep(fmi2Component, fmi2Real point, fmi2Real step, fmi2Boolean no_set_state_before);
VSA_FMI_EXPORT fmi2Status fmi2CancelStep(fmi2Component);
VSA_FMI_EXPORT fmi2Status fmi2GetStatus(fmi2Component, fmi2StatusKind, fmi2Status*);
VSA_FMI_EXPORT fmi2Status fmi2GetRealStatus(fmi2Component, fmi2StatusKind, fmi2Real*);
VSA_FMI_EXPORT fmi2Status fmi2GetIntegerStatus(fmi2Component, fmi2StatusKind, fmi2Integer*);
VSA_FMI_EXPORT fmi2Status fmi2GetBooleanStatus(fmi2Component, fmi2StatusKind, fmi2Boolean*);
VSA_FMI_EXPORT fmi2Status fmi2GetStringStatus(fmi2Component, fmi2StatusKind, fmi2String*);
}
// NOLINTEND(modernize-use-using,readability-identifier-naming)
