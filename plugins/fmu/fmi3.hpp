// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The C interface of FMI 3.0, all that a library has to export: names, types and numbers are the standard's (fmi-standard.org,
// version 3.0.2), the text is ours.
#pragma once

#include <cstddef>
#include <cstdint>

#define VSA_FMI_EXPORT __attribute__((visibility("default")))

// NOLINTBEGIN(modernize-use-using,readability-identifier-naming): C's and the standard's
extern "C" {

typedef void* fmi3Instance;
typedef void* fmi3InstanceEnvironment;  // the importer's, handed back to its callbacks
typedef void* fmi3FMUState;
typedef std::uint32_t fmi3ValueReference;
typedef float fmi3Float32;
typedef double fmi3Float64;
typedef std::int8_t fmi3Int8;
typedef std::uint8_t fmi3UInt8;
typedef std::int16_t fmi3Int16;
typedef std::uint16_t fmi3UInt16;
typedef std::int32_t fmi3Int32;
typedef std::uint32_t fmi3UInt32;
typedef std::int64_t fmi3Int64;
typedef std::uint64_t fmi3UInt64;
typedef bool fmi3Boolean;
typedef char fmi3Char;
typedef const fmi3Char* fmi3String;
typedef std::uint8_t fmi3Byte;
typedef const fmi3Byte* fmi3Binary;
typedef bool fmi3Clock;

typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef enum { fmi3Independent, fmi3Constant, fmi3Fixed, fmi3Tunable, fmi3Discrete, fmi3Dependent } fmi3DependencyKind;
typedef enum { fmi3IntervalNotYetKnown, fmi3IntervalUnchanged, fmi3IntervalChanged } fmi3IntervalQualifier;

typedef void (*fmi3LogMessageCallback)(fmi3InstanceEnvironment, fmi3Status, fmi3String category, fmi3String message);
typedef void (*fmi3ClockUpdateCallback)(fmi3InstanceEnvironment);
typedef void (*fmi3IntermediateUpdateCallback)(fmi3InstanceEnvironment, fmi3Float64 time, fmi3Boolean set_requested,
                                               fmi3Boolean get_allowed, fmi3Boolean step_finished, fmi3Boolean can_return_early,
                                               fmi3Boolean* early_return_requested, fmi3Float64* early_return_time);
typedef void (*fmi3LockPreemptionCallback)();
typedef void (*fmi3UnlockPreemptionCallback)();

// The instance's life.
VSA_FMI_EXPORT const char* fmi3GetVersion();
VSA_FMI_EXPORT fmi3Status fmi3SetDebugLogging(fmi3Instance, fmi3Boolean on, std::size_t count, const fmi3String categories[]);
VSA_FMI_EXPORT fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources,
                                                         fmi3Boolean visible, fmi3Boolean logging, fmi3InstanceEnvironment,
                                                         fmi3LogMessageCallback);
VSA_FMI_EXPORT fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
                                                        fmi3Boolean visible, fmi3Boolean logging, fmi3Boolean event_mode,
                                                        fmi3Boolean early_return, const fmi3ValueReference intermediate[],
                                                        std::size_t, fmi3InstanceEnvironment, fmi3LogMessageCallback,
                                                        fmi3IntermediateUpdateCallback);
VSA_FMI_EXPORT fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resources,
                                                              fmi3Boolean visible, fmi3Boolean logging, fmi3InstanceEnvironment,
                                                              fmi3LogMessageCallback, fmi3ClockUpdateCallback,
                                                              fmi3LockPreemptionCallback, fmi3UnlockPreemptionCallback);
VSA_FMI_EXPORT void fmi3FreeInstance(fmi3Instance);
VSA_FMI_EXPORT fmi3Status fmi3EnterInitializationMode(fmi3Instance, fmi3Boolean has_tolerance, fmi3Float64 tolerance,
                                                      fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop);
VSA_FMI_EXPORT fmi3Status fmi3ExitInitializationMode(fmi3Instance);
VSA_FMI_EXPORT fmi3Status fmi3EnterEventMode(fmi3Instance);
VSA_FMI_EXPORT fmi3Status fmi3Terminate(fmi3Instance);
VSA_FMI_EXPORT fmi3Status fmi3Reset(fmi3Instance);

// Values: references, their number, values, their number.
#define VSA_FMI3_VALUES(Type)                                                                                                \
  VSA_FMI_EXPORT fmi3Status fmi3Get##Type(fmi3Instance, const fmi3ValueReference[], std::size_t, fmi3##Type[], std::size_t); \
  VSA_FMI_EXPORT fmi3Status fmi3Set##Type(fmi3Instance, const fmi3ValueReference[], std::size_t, const fmi3##Type[], std::size_t);
VSA_FMI3_VALUES(Float32)
VSA_FMI3_VALUES(Float64)
VSA_FMI3_VALUES(Int8)
VSA_FMI3_VALUES(UInt8)
VSA_FMI3_VALUES(Int16)
VSA_FMI3_VALUES(UInt16)
VSA_FMI3_VALUES(Int32)
VSA_FMI3_VALUES(UInt32)
VSA_FMI3_VALUES(Int64)
VSA_FMI3_VALUES(UInt64)
VSA_FMI3_VALUES(Boolean)
VSA_FMI3_VALUES(String)
#undef VSA_FMI3_VALUES
VSA_FMI_EXPORT fmi3Status fmi3GetBinary(fmi3Instance, const fmi3ValueReference[], std::size_t, std::size_t sizes[], fmi3Binary[],
                                        std::size_t);
VSA_FMI_EXPORT fmi3Status fmi3SetBinary(fmi3Instance, const fmi3ValueReference[], std::size_t, const std::size_t sizes[],
                                        const fmi3Binary[], std::size_t);
VSA_FMI_EXPORT fmi3Status fmi3GetClock(fmi3Instance, const fmi3ValueReference[], std::size_t, fmi3Clock[]);
VSA_FMI_EXPORT fmi3Status fmi3SetClock(fmi3Instance, const fmi3ValueReference[], std::size_t, const fmi3Clock[]);
VSA_FMI_EXPORT fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance, fmi3ValueReference, std::size_t* count);
VSA_FMI_EXPORT fmi3Status fmi3GetVariableDependencies(fmi3Instance, fmi3ValueReference dependent,
                                                      std::size_t element_of_dependent[], fmi3ValueReference independents[],
                                                      std::size_t element_of_independent[], fmi3DependencyKind kinds[],
                                                      std::size_t count);

// States and derivatives.
VSA_FMI_EXPORT fmi3Status fmi3GetFMUState(fmi3Instance, fmi3FMUState*);
VSA_FMI_EXPORT fmi3Status fmi3SetFMUState(fmi3Instance, fmi3FMUState);
VSA_FMI_EXPORT fmi3Status fmi3FreeFMUState(fmi3Instance, fmi3FMUState*);
VSA_FMI_EXPORT fmi3Status fmi3SerializedFMUStateSize(fmi3Instance, fmi3FMUState, std::size_t*);
VSA_FMI_EXPORT fmi3Status fmi3SerializeFMUState(fmi3Instance, fmi3FMUState, fmi3Byte[], std::size_t);
VSA_FMI_EXPORT fmi3Status fmi3DeserializeFMUState(fmi3Instance, const fmi3Byte[], std::size_t, fmi3FMUState*);
VSA_FMI_EXPORT fmi3Status fmi3GetDirectionalDerivative(fmi3Instance, const fmi3ValueReference unknowns[], std::size_t,
                                                       const fmi3ValueReference knowns[], std::size_t, const fmi3Float64 seed[],
                                                       std::size_t, fmi3Float64 sensitivity[], std::size_t);
VSA_FMI_EXPORT fmi3Status fmi3GetAdjointDerivative(fmi3Instance, const fmi3ValueReference unknowns[], std::size_t,
                                                   const fmi3ValueReference knowns[], std::size_t, const fmi3Float64 seed[],
                                                   std::size_t, fmi3Float64 sensitivity[], std::size_t);

// Configuration, clocks and events, of which this FMU has none.
VSA_FMI_EXPORT fmi3Status fmi3EnterConfigurationMode(fmi3Instance);
VSA_FMI_EXPORT fmi3Status fmi3ExitConfigurationMode(fmi3Instance);
VSA_FMI_EXPORT fmi3Status fmi3GetIntervalDecimal(fmi3Instance, const fmi3ValueReference[], std::size_t, fmi3Float64[],
                                                 fmi3IntervalQualifier[]);
VSA_FMI_EXPORT fmi3Status fmi3GetIntervalFraction(fmi3Instance, const fmi3ValueReference[], std::size_t, fmi3UInt64 counters[],
                                                  fmi3UInt64 resolutions[], fmi3IntervalQualifier[]);
VSA_FMI_EXPORT fmi3Status fmi3GetShiftDecimal(fmi3Instance, const fmi3ValueReference[], std::size_t, fmi3Float64[]);
VSA_FMI_EXPORT fmi3Status fmi3GetShiftFraction(fmi3Instance, const fmi3ValueReference[], std::size_t, fmi3UInt64 counters[],
                                               fmi3UInt64 resolutions[]);
VSA_FMI_EXPORT fmi3Status fmi3SetIntervalDecimal(fmi3Instance, const fmi3ValueReference[], std::size_t, const fmi3Float64[]);
VSA_FMI_EXPORT fmi3Status fmi3SetIntervalFraction(fmi3Instance, const fmi3ValueReference[], std::size_t,
                                                  const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]);
VSA_FMI_EXPORT fmi3Status fmi3SetShiftDecimal(fmi3Instance, const fmi3ValueReference[], std::size_t, const fmi3Float64[]);
VSA_FMI_EXPORT fmi3Status fmi3SetShiftFraction(fmi3Instance, const fmi3ValueReference[], std::size_t, const fmi3UInt64 counters[],
                                               const fmi3UInt64 resolutions[]);
VSA_FMI_EXPORT fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance);
VSA_FMI_EXPORT fmi3Status fmi3UpdateDiscreteStates(fmi3Instance, fmi3Boolean* again, fmi3Boolean* terminate, fmi3Boolean* nominals,
                                                   fmi3Boolean* values, fmi3Boolean* has_next_event, fmi3Float64* next_event);
VSA_FMI_EXPORT fmi3Status fmi3ActivateModelPartition(fmi3Instance, fmi3ValueReference clock, fmi3Float64 time);

// Model exchange, which this FMU isn't for.
VSA_FMI_EXPORT fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance);
VSA_FMI_EXPORT fmi3Status fmi3CompletedIntegratorStep(fmi3Instance, fmi3Boolean, fmi3Boolean* event_mode, fmi3Boolean* terminate);
VSA_FMI_EXPORT fmi3Status fmi3SetTime(fmi3Instance, fmi3Float64);
VSA_FMI_EXPORT fmi3Status fmi3SetContinuousStates(fmi3Instance, const fmi3Float64[], std::size_t);
VSA_FMI_EXPORT fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance, fmi3Float64[], std::size_t);
VSA_FMI_EXPORT fmi3Status fmi3GetEventIndicators(fmi3Instance, fmi3Float64[], std::size_t);
VSA_FMI_EXPORT fmi3Status fmi3GetContinuousStates(fmi3Instance, fmi3Float64[], std::size_t);
VSA_FMI_EXPORT fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance, fmi3Float64[], std::size_t);
VSA_FMI_EXPORT fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance, std::size_t*);
VSA_FMI_EXPORT fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance, std::size_t*);

// Steps.
VSA_FMI_EXPORT fmi3Status fmi3EnterStepMode(fmi3Instance);
VSA_FMI_EXPORT fmi3Status fmi3GetOutputDerivatives(fmi3Instance, const fmi3ValueReference[], std::size_t, const fmi3Int32 orders[],
                                                   fmi3Float64[], std::size_t);
VSA_FMI_EXPORT fmi3Status fmi3DoStep(fmi3Instance, fmi3Float64 point, fmi3Float64 step, fmi3Boolean no_set_state_before,
                                     fmi3Boolean* event, fmi3Boolean* terminate, fmi3Boolean* early_return,
                                     fmi3Float64* last_successful);
}
// NOLINTEND(modernize-use-using,readability-identifier-naming)
