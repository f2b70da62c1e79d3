/* -- FMI 2.0 ----------------------------------------------------------------------------------------------------- */

#ifdef FMI_HEADERS   /* with the headers of the standard a compiler holds these declarations against it */
#include "fmi2Functions.h"
#else
typedef void *fmi2Component, *fmi2ComponentEnvironment, *fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer, fmi2Boolean;
typedef char fmi2Byte;
typedef const char *fmi2String;
typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated } fmi2StatusKind;
typedef void (*fmi2CallbackLogger)(fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String, fmi2String, ...);
typedef struct {
  fmi2CallbackLogger logger;
  void *(*allocateMemory)(size_t, size_t);
  void (*freeMemory)(void *);
  void (*stepFinished)(fmi2ComponentEnvironment, fmi2Status);
  fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;
typedef struct {
  fmi2Boolean newDiscreteStatesNeeded, terminateSimulation, nominalsOfContinuousStatesChanged;
  fmi2Boolean valuesOfContinuousStatesChanged, nextEventTimeDefined;
  fmi2Real nextEventTime;
} fmi2EventInfo;
#endif

#define ME(c) ((Instance *)(c))
#define NOTHING_ELSE(name, type) \
  EXPORTED fmi2Status name(fmi2Component c, const fmi2ValueReference vr[], size_t n, type value[]) { \
    (void)vr; (void)value; \
    if (n) ME(c)->say(c, "all variables of this FMU are Real"); \
    return n ? fmi2Error : fmi2OK; \
  }

/* A logger of FMI 2 takes the text of a format; ours contain no sign of one. */
static void say2(void *instance, const char *message) {
  fmi2CallbackLogger logger = ((const fmi2CallbackFunctions *)ME(instance)->logger)->logger;
  if (logger) logger(ME(instance)->environment, ME(instance)->name, fmi2Error, "logStatusError", message);
}

EXPORTED const char *fmi2GetTypesPlatform(void) { return "default"; }
EXPORTED const char *fmi2GetVersion(void) { return "2.0"; }

EXPORTED fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[]) {
  (void)c; (void)on; (void)n; (void)categories;
  return fmi2OK;
}

EXPORTED fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                                       const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean on) {
  Instance *m;
  (void)type; (void)resources; (void)visible; (void)on;
  if (!functions || !guid || strcmp(guid, TOKEN)) return NULL;
  m = made(name);
  if (!m) return NULL;
  m->say = say2;
  m->logger = (void *)functions;
  m->environment = functions->componentEnvironment;
  return m;
}

EXPORTED void fmi2FreeInstance(fmi2Component c) { free(c); }

EXPORTED fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean defined, fmi2Real tolerance, fmi2Real start,
                                        fmi2Boolean ends, fmi2Real end) {
  (void)ends; (void)end;
  ME(c)->now.t = start;
  if (defined && tolerance > 0.0) ME(c)->now.tolerance = tolerance;
  ME(c)->results.known = 0;
  return fmi2OK;
}

EXPORTED fmi2Status fmi2EnterInitializationMode(fmi2Component c) { (void)c; return fmi2OK; }
EXPORTED fmi2Status fmi2ExitInitializationMode(fmi2Component c) { return settled(ME(c), 50) ? fmi2OK : fmi2Error; }
EXPORTED fmi2Status fmi2Terminate(fmi2Component c) { (void)c; return fmi2OK; }
EXPORTED fmi2Status fmi2Reset(fmi2Component c) { reset(ME(c)); return fmi2OK; }

EXPORTED fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[]) {
  size_t i;
  for (i = 0; i < n; i++)
    if (!get(ME(c), vr[i], &value[i])) return vr[i] < COUNT ? fmi2Discard : fmi2Error;
  return fmi2OK;
}

EXPORTED fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Real value[]) {
  size_t i;
  for (i = 0; i < n; i++)
    if (!set(ME(c), vr[i], value[i])) return fmi2Error;
  return fmi2OK;
}

NOTHING_ELSE(fmi2GetInteger, fmi2Integer)
NOTHING_ELSE(fmi2GetBoolean, fmi2Boolean)
NOTHING_ELSE(fmi2GetString, fmi2String)
NOTHING_ELSE(fmi2SetInteger, const fmi2Integer)
NOTHING_ELSE(fmi2SetBoolean, const fmi2Boolean)
NOTHING_ELSE(fmi2SetString, const fmi2String)

EXPORTED fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) {
  if (!*state) *state = malloc(sizeof(Values));
  if (!*state) return fmi2Error;
  memcpy(*state, &ME(c)->now, sizeof(Values));
  return fmi2OK;
}

EXPORTED fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  memcpy(&ME(c)->now, state, sizeof(Values));
  ME(c)->results.known = 0;
  return fmi2OK;
}

EXPORTED fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) {
  (void)c;
  free(*state);
  *state = NULL;
  return fmi2OK;
}

EXPORTED fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size) {
  (void)c; (void)state;
  *size = sizeof(Values);
  return fmi2OK;
}

EXPORTED fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
  (void)c;
  if (size < sizeof(Values)) return fmi2Error;
  memcpy(bytes, state, sizeof(Values));
  return fmi2OK;
}

EXPORTED fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state) {
  (void)c;
  if (size != sizeof(Values)) return fmi2Error;
  if (!*state) *state = malloc(sizeof(Values));
  if (!*state) return fmi2Error;
  memcpy(*state, bytes, sizeof(Values));
  return fmi2OK;
}

EXPORTED fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[], size_t nUnknown,
                                                 const fmi2ValueReference known[], size_t nKnown,
                                                 const fmi2Real seed[], fmi2Real sensitivity[]) {
  (void)unknown; (void)nUnknown; (void)known; (void)nKnown; (void)seed; (void)sensitivity;
  ME(c)->say(c, "directional derivatives are not provided");
  return fmi2Error;
}

/* model exchange */

EXPORTED fmi2Status fmi2EnterEventMode(fmi2Component c) { (void)c; return fmi2OK; }

EXPORTED fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info) {
  memset(info, 0, sizeof *info);
  if (gap_now(ME(c)) > DRIFTED) {
    if (!settled(ME(c), 8)) return fmi2Error;
    info->valuesOfContinuousStatesChanged = 1;
  }
  return fmi2OK;
}

EXPORTED fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) { (void)c; return fmi2OK; }

EXPORTED fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean noSet, fmi2Boolean *enterEventMode,
                                                fmi2Boolean *terminate) {
  (void)noSet;
  *enterEventMode = gap_now(ME(c)) > DRIFTED;
  *terminate = 0;
  return fmi2OK;
}

EXPORTED fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time) {
  ME(c)->now.t = time;
  ME(c)->results.known = 0;
  return fmi2OK;
}

EXPORTED fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t n) {
  if (n != NX) return fmi2Error;
  memcpy(ME(c)->now.x, x, NX * sizeof(double));
  ME(c)->results.known = 0;
  return fmi2OK;
}

EXPORTED fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t n) {
  if (n != NX) return fmi2Error;
  if (!computed(ME(c))) return fmi2Discard;
  memcpy(derivatives, ME(c)->results.der, NX * sizeof(double));
  return fmi2OK;
}

EXPORTED fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real indicators[], size_t n) {
  (void)c; (void)indicators;
  return n ? fmi2Error : fmi2OK;
}

EXPORTED fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t n) {
  if (n != NX) return fmi2Error;
  memcpy(x, ME(c)->now.x, NX * sizeof(double));
  return fmi2OK;
}

EXPORTED fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real nominals[], size_t n) {
  size_t i;
  (void)c;
  for (i = 0; i < n; i++) nominals[i] = 1.0;
  return n == NX ? fmi2OK : fmi2Error;
}

/* co-simulation */

EXPORTED fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                                const fmi2Integer order[], const fmi2Real value[]) {
  (void)c; (void)vr; (void)n; (void)order; (void)value;
  return fmi2Error;
}

EXPORTED fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                                 const fmi2Integer order[], fmi2Real value[]) {
  (void)c; (void)vr; (void)n; (void)order; (void)value;
  return fmi2Error;
}

EXPORTED fmi2Status fmi2DoStep(fmi2Component c, fmi2Real now, fmi2Real step, fmi2Boolean noSet) {
  (void)noSet;
  if (step < 0.0) return fmi2Error;
  ME(c)->results.known = 0;
  return advanced(ME(c), now + step) ? fmi2OK : fmi2Discard;
}

EXPORTED fmi2Status fmi2CancelStep(fmi2Component c) { (void)c; return fmi2Error; }

EXPORTED fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value) {
  (void)c; (void)kind; (void)value;
  return fmi2Discard;
}

EXPORTED fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value) {
  if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
  *value = ME(c)->now.t;
  return fmi2OK;
}

EXPORTED fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value) {
  (void)c; (void)kind; (void)value;
  return fmi2Discard;
}

EXPORTED fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value) {
  (void)c;
  if (kind != fmi2Terminated) return fmi2Discard;
  *value = 0;
  return fmi2OK;
}

EXPORTED fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value) {
  (void)c; (void)kind; (void)value;
  return fmi2Discard;
}
