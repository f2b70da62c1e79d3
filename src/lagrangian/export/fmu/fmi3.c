/* -- FMI 3.0 ----------------------------------------------------------------------------------------------------- */

#ifdef FMI_HEADERS   /* with the headers of the standard a compiler holds these declarations against it */
#include "fmi3Functions.h"
#else
#include <stdbool.h>
#include <stdint.h>
typedef void *fmi3Instance, *fmi3InstanceEnvironment, *fmi3FMUState;
typedef uint32_t fmi3ValueReference;
typedef float fmi3Float32;
typedef double fmi3Float64;
typedef int8_t fmi3Int8;
typedef uint8_t fmi3UInt8, fmi3Byte;
typedef int16_t fmi3Int16;
typedef uint16_t fmi3UInt16;
typedef int32_t fmi3Int32;
typedef uint32_t fmi3UInt32;
typedef int64_t fmi3Int64;
typedef uint64_t fmi3UInt64;
typedef bool fmi3Boolean, fmi3Clock;
typedef const char *fmi3String;
typedef const fmi3Byte *fmi3Binary;
typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef enum { fmi3Independent, fmi3Constant, fmi3Fixed, fmi3Tunable, fmi3Discrete, fmi3Dependent } fmi3DependencyKind;
typedef enum { fmi3IntervalNotYetKnown, fmi3IntervalUnchanged, fmi3IntervalChanged } fmi3IntervalQualifier;
typedef void (*fmi3LogMessageCallback)(fmi3InstanceEnvironment, fmi3Status, fmi3String, fmi3String);
typedef void (*fmi3ClockUpdateCallback)(fmi3InstanceEnvironment);
typedef void (*fmi3IntermediateUpdateCallback)(fmi3InstanceEnvironment, fmi3Float64, fmi3Boolean, fmi3Boolean,
                                               fmi3Boolean, fmi3Boolean, fmi3Boolean *, fmi3Float64 *);
typedef void (*fmi3LockPreemptionCallback)(void);
typedef void (*fmi3UnlockPreemptionCallback)(void);
#endif

#define ME(c) ((Instance *)(c))
#define REFERENCES const fmi3ValueReference vr[], size_t nvr

static void say3(void *instance, const char *message) {
  fmi3LogMessageCallback logger;
  memcpy(&logger, &ME(instance)->logger, sizeof logger);
  if (logger) logger(ME(instance)->environment, fmi3Error, "logStatusError", message);
}

static fmi3Instance instantiated(fmi3String name, fmi3String token, fmi3InstanceEnvironment environment,
                                 fmi3LogMessageCallback log) {
  Instance *m;
  if (!token || strcmp(token, TOKEN)) return NULL;
  m = made(name);
  if (!m) return NULL;
  m->say = say3;
  m->environment = environment;
  memcpy(&m->logger, &log, sizeof log);
  return m;
}

EXPORTED const char *fmi3GetVersion(void) { return "3.0"; }

EXPORTED fmi3Status fmi3SetDebugLogging(fmi3Instance c, fmi3Boolean on, size_t n, const fmi3String categories[]) {
  (void)c; (void)on; (void)n; (void)categories;
  return fmi3OK;
}

EXPORTED fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources,
                                                   fmi3Boolean visible, fmi3Boolean on,
                                                   fmi3InstanceEnvironment environment, fmi3LogMessageCallback log) {
  (void)resources; (void)visible; (void)on;
  return instantiated(name, token, environment, log);
}

EXPORTED fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
                                                  fmi3Boolean visible, fmi3Boolean on, fmi3Boolean eventModeUsed,
                                                  fmi3Boolean earlyReturnAllowed, REFERENCES,
                                                  fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                                  fmi3IntermediateUpdateCallback update) {
  (void)resources; (void)visible; (void)on; (void)eventModeUsed; (void)earlyReturnAllowed; (void)vr; (void)nvr;
  (void)update;
  return instantiated(name, token, environment, log);
}

EXPORTED fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resources,
                                                        fmi3Boolean visible, fmi3Boolean on,
                                                        fmi3InstanceEnvironment environment,
                                                        fmi3LogMessageCallback log, fmi3ClockUpdateCallback clock,
                                                        fmi3LockPreemptionCallback lock,
                                                        fmi3UnlockPreemptionCallback unlock) {
  (void)name; (void)token; (void)resources; (void)visible; (void)on; (void)environment; (void)log; (void)clock;
  (void)lock; (void)unlock;
  return NULL;   /* there is nothing to schedule */
}

EXPORTED void fmi3FreeInstance(fmi3Instance c) { free(c); }

EXPORTED fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean defined, fmi3Float64 tolerance,
                                                fmi3Float64 start, fmi3Boolean ends, fmi3Float64 end) {
  (void)ends; (void)end;
  ME(c)->now.t = start;
  if (defined && tolerance > 0.0) ME(c)->now.tolerance = tolerance;
  ME(c)->results.known = 0;
  return fmi3OK;
}

EXPORTED fmi3Status fmi3ExitInitializationMode(fmi3Instance c) { return settled(ME(c), 50) ? fmi3OK : fmi3Error; }
EXPORTED fmi3Status fmi3EnterEventMode(fmi3Instance c) { (void)c; return fmi3OK; }
EXPORTED fmi3Status fmi3Terminate(fmi3Instance c) { (void)c; return fmi3OK; }
EXPORTED fmi3Status fmi3Reset(fmi3Instance c) { reset(ME(c)); return fmi3OK; }
EXPORTED fmi3Status fmi3EnterConfigurationMode(fmi3Instance c) { (void)c; return fmi3OK; }
EXPORTED fmi3Status fmi3ExitConfigurationMode(fmi3Instance c) { (void)c; return fmi3OK; }

EXPORTED fmi3Status fmi3GetFloat64(fmi3Instance c, REFERENCES, fmi3Float64 values[], size_t n) {
  size_t i;
  if (n != nvr) return fmi3Error;
  for (i = 0; i < nvr; i++)
    if (!get(ME(c), vr[i], &values[i])) return vr[i] < COUNT ? fmi3Discard : fmi3Error;
  return fmi3OK;
}

EXPORTED fmi3Status fmi3SetFloat64(fmi3Instance c, REFERENCES, const fmi3Float64 values[], size_t n) {
  size_t i;
  if (n != nvr) return fmi3Error;
  for (i = 0; i < nvr; i++)
    if (!set(ME(c), vr[i], values[i])) return fmi3Error;
  return fmi3OK;
}

static fmi3Status other_type(fmi3Instance c, size_t n) {
  if (n) ME(c)->say(c, "all variables of this FMU are Float64");
  return n ? fmi3Error : fmi3OK;
}

#define OTHER(type) \
  EXPORTED fmi3Status fmi3Get##type(fmi3Instance c, REFERENCES, fmi3##type values[], size_t n) { \
    (void)vr; (void)values; (void)n; \
    return other_type(c, nvr); \
  } \
  EXPORTED fmi3Status fmi3Set##type(fmi3Instance c, REFERENCES, const fmi3##type values[], size_t n) { \
    (void)vr; (void)values; (void)n; \
    return other_type(c, nvr); \
  }
OTHER(Float32)
OTHER(Int8)
OTHER(UInt8)
OTHER(Int16)
OTHER(UInt16)
OTHER(Int32)
OTHER(UInt32)
OTHER(Int64)
OTHER(UInt64)
OTHER(Boolean)
OTHER(String)

EXPORTED fmi3Status fmi3GetBinary(fmi3Instance c, REFERENCES, size_t sizes[], fmi3Binary values[], size_t n) {
  (void)vr; (void)sizes; (void)values; (void)n;
  return other_type(c, nvr);
}
EXPORTED fmi3Status fmi3SetBinary(fmi3Instance c, REFERENCES, const size_t sizes[], const fmi3Binary values[],
                                  size_t n) {
  (void)vr; (void)sizes; (void)values; (void)n;
  return other_type(c, nvr);
}
EXPORTED fmi3Status fmi3GetClock(fmi3Instance c, REFERENCES, fmi3Clock values[]) {
  (void)vr; (void)values;
  return other_type(c, nvr);
}
EXPORTED fmi3Status fmi3SetClock(fmi3Instance c, REFERENCES, const fmi3Clock values[]) {
  (void)vr; (void)values;
  return other_type(c, nvr);
}

EXPORTED fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance c, fmi3ValueReference vr, size_t *n) {
  (void)vr; (void)n;
  ME(c)->say(c, "dependencies are not provided");
  return fmi3Error;
}
EXPORTED fmi3Status fmi3GetVariableDependencies(fmi3Instance c, fmi3ValueReference vr, size_t elements[],
                                                fmi3ValueReference independents[], size_t others[],
                                                fmi3DependencyKind kinds[], size_t n) {
  (void)vr; (void)elements; (void)independents; (void)others; (void)kinds; (void)n;
  ME(c)->say(c, "dependencies are not provided");
  return fmi3Error;
}

EXPORTED fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState *state) {
  if (!*state) *state = malloc(sizeof(Values));
  if (!*state) return fmi3Error;
  memcpy(*state, &ME(c)->now, sizeof(Values));
  return fmi3OK;
}
EXPORTED fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state) {
  memcpy(&ME(c)->now, state, sizeof(Values));
  ME(c)->results.known = 0;
  return fmi3OK;
}
EXPORTED fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState *state) {
  (void)c;
  free(*state);
  *state = NULL;
  return fmi3OK;
}
EXPORTED fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t *size) {
  (void)c; (void)state;
  *size = sizeof(Values);
  return fmi3OK;
}
EXPORTED fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size) {
  (void)c;
  if (size < sizeof(Values)) return fmi3Error;
  memcpy(bytes, state, sizeof(Values));
  return fmi3OK;
}
EXPORTED fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState *state) {
  (void)c;
  if (size != sizeof(Values)) return fmi3Error;
  if (!*state) *state = malloc(sizeof(Values));
  if (!*state) return fmi3Error;
  memcpy(*state, bytes, sizeof(Values));
  return fmi3OK;
}

#define DERIVATIVE(name) \
  EXPORTED fmi3Status name(fmi3Instance c, const fmi3ValueReference unknowns[], size_t nUnknowns, \
                           const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[], \
                           size_t nSeed, fmi3Float64 sensitivity[], size_t nSensitivity) { \
    (void)unknowns; (void)nUnknowns; (void)knowns; (void)nKnowns; (void)seed; (void)nSeed; (void)sensitivity; \
    (void)nSensitivity; \
    ME(c)->say(c, "directional and adjoint derivatives are not provided"); \
    return fmi3Error; \
  }
DERIVATIVE(fmi3GetDirectionalDerivative)
DERIVATIVE(fmi3GetAdjointDerivative)

/* clocks: there are none */

EXPORTED fmi3Status fmi3GetIntervalDecimal(fmi3Instance c, REFERENCES, fmi3Float64 intervals[],
                                           fmi3IntervalQualifier qualifiers[]) {
  (void)vr; (void)intervals; (void)qualifiers;
  return other_type(c, nvr);
}
EXPORTED fmi3Status fmi3GetIntervalFraction(fmi3Instance c, REFERENCES, fmi3UInt64 counters[],
                                            fmi3UInt64 resolutions[], fmi3IntervalQualifier qualifiers[]) {
  (void)vr; (void)counters; (void)resolutions; (void)qualifiers;
  return other_type(c, nvr);
}
EXPORTED fmi3Status fmi3GetShiftDecimal(fmi3Instance c, REFERENCES, fmi3Float64 shifts[]) {
  (void)vr; (void)shifts;
  return other_type(c, nvr);
}
EXPORTED fmi3Status fmi3GetShiftFraction(fmi3Instance c, REFERENCES, fmi3UInt64 counters[], fmi3UInt64 resolutions[]) {
  (void)vr; (void)counters; (void)resolutions;
  return other_type(c, nvr);
}
EXPORTED fmi3Status fmi3SetIntervalDecimal(fmi3Instance c, REFERENCES, const fmi3Float64 intervals[]) {
  (void)vr; (void)intervals;
  return other_type(c, nvr);
}
EXPORTED fmi3Status fmi3SetIntervalFraction(fmi3Instance c, REFERENCES, const fmi3UInt64 counters[],
                                            const fmi3UInt64 resolutions[]) {
  (void)vr; (void)counters; (void)resolutions;
  return other_type(c, nvr);
}
EXPORTED fmi3Status fmi3SetShiftDecimal(fmi3Instance c, REFERENCES, const fmi3Float64 shifts[]) {
  (void)vr; (void)shifts;
  return other_type(c, nvr);
}
EXPORTED fmi3Status fmi3SetShiftFraction(fmi3Instance c, REFERENCES, const fmi3UInt64 counters[],
                                         const fmi3UInt64 resolutions[]) {
  (void)vr; (void)counters; (void)resolutions;
  return other_type(c, nvr);
}
EXPORTED fmi3Status fmi3ActivateModelPartition(fmi3Instance c, fmi3ValueReference clock, fmi3Float64 time) {
  (void)clock; (void)time;
  return other_type(c, 1);
}

EXPORTED fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance c) { (void)c; return fmi3OK; }

EXPORTED fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, fmi3Boolean *again, fmi3Boolean *terminate,
                                             fmi3Boolean *nominals, fmi3Boolean *values, fmi3Boolean *timed,
                                             fmi3Float64 *next) {
  *again = *terminate = *nominals = *values = *timed = false;
  *next = 0.0;
  if (gap_now(ME(c)) > DRIFTED) {
    if (!settled(ME(c), 8)) return fmi3Error;
    *values = true;
  }
  return fmi3OK;
}

/* model exchange */

EXPORTED fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance c) { (void)c; return fmi3OK; }

EXPORTED fmi3Status fmi3CompletedIntegratorStep(fmi3Instance c, fmi3Boolean noSet, fmi3Boolean *enterEventMode,
                                                fmi3Boolean *terminate) {
  (void)noSet;
  *enterEventMode = gap_now(ME(c)) > DRIFTED;
  *terminate = false;
  return fmi3OK;
}

EXPORTED fmi3Status fmi3SetTime(fmi3Instance c, fmi3Float64 time) {
  ME(c)->now.t = time;
  ME(c)->results.known = 0;
  return fmi3OK;
}

EXPORTED fmi3Status fmi3SetContinuousStates(fmi3Instance c, const fmi3Float64 x[], size_t n) {
  if (n != NX) return fmi3Error;
  memcpy(ME(c)->now.x, x, NX * sizeof(double));
  ME(c)->results.known = 0;
  return fmi3OK;
}

EXPORTED fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance c, fmi3Float64 derivatives[], size_t n) {
  if (n != NX) return fmi3Error;
  if (!computed(ME(c))) return fmi3Discard;
  memcpy(derivatives, ME(c)->results.der, NX * sizeof(double));
  return fmi3OK;
}

EXPORTED fmi3Status fmi3GetEventIndicators(fmi3Instance c, fmi3Float64 indicators[], size_t n) {
  (void)c; (void)indicators;
  return n ? fmi3Error : fmi3OK;
}

EXPORTED fmi3Status fmi3GetContinuousStates(fmi3Instance c, fmi3Float64 x[], size_t n) {
  if (n != NX) return fmi3Error;
  memcpy(x, ME(c)->now.x, NX * sizeof(double));
  return fmi3OK;
}

EXPORTED fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance c, fmi3Float64 nominals[], size_t n) {
  size_t i;
  (void)c;
  for (i = 0; i < n; i++) nominals[i] = 1.0;
  return n == NX ? fmi3OK : fmi3Error;
}

EXPORTED fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance c, size_t *n) { (void)c; *n = 0; return fmi3OK; }
EXPORTED fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance c, size_t *n) { (void)c; *n = NX; return fmi3OK; }

/* co-simulation */

EXPORTED fmi3Status fmi3EnterStepMode(fmi3Instance c) { (void)c; return fmi3OK; }

EXPORTED fmi3Status fmi3GetOutputDerivatives(fmi3Instance c, REFERENCES, const fmi3Int32 orders[],
                                             fmi3Float64 values[], size_t n) {
  (void)c; (void)vr; (void)nvr; (void)orders; (void)values; (void)n;
  return fmi3Error;
}

EXPORTED fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 now, fmi3Float64 step, fmi3Boolean noSet,
                               fmi3Boolean *eventHandlingNeeded, fmi3Boolean *terminate, fmi3Boolean *earlyReturn,
                               fmi3Float64 *lastSuccessfulTime) {
  int done;
  (void)noSet;
  *eventHandlingNeeded = *terminate = *earlyReturn = false;
  ME(c)->results.known = 0;
  done = step >= 0.0 && advanced(ME(c), now + step);
  *lastSuccessfulTime = ME(c)->now.t;
  return done ? fmi3OK : fmi3Error;
}
