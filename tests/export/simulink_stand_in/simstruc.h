/* A stand-in of Simulink's header for tests: the macros that our S-functions use, over one plain structure, and checks
   that they are called as Simulink asks. It is no part of Simulink, and says nothing about its solvers. */
#ifndef SIMSTRUC_STAND_IN
#define SIMSTRUC_STAND_IN

#include <stddef.h>

typedef double real_T;
typedef int int_T;
typedef const real_T *const *InputRealPtrsType;
typedef struct { double *values; int count; } mxArray;
typedef struct {
  const mxArray *given[2];
  int wanted, states, inputs, input_width, feedthrough, outputs, output_width[2], samples, work;
  double t, *x, *dx, *output[2], *rwork;
  const double **input;
  const char *error;
} SimStruct;

#define CONTINUOUS_SAMPLE_TIME 0.0
#define mxGetNumberOfElements(a) ((size_t)(a)->count)
#define mxGetPr(a) ((a)->values)
#define ssSetNumSFcnParams(S, n) ((S)->wanted = (n))
#define ssGetNumSFcnParams(S) ((S)->wanted)
#define ssGetSFcnParamsCount(S) 2
#define ssGetSFcnParam(S, i) ((S)->given[i])
#define ssSetErrorStatus(S, text) ((S)->error = (text))
#define ssGetErrorStatus(S) ((S)->error)
#define ssSetNumContStates(S, n) ((S)->states = (n))
#define ssSetNumDiscStates(S, n) ((void)(S), (void)(n))
#define ssSetNumInputPorts(S, n) ((S)->inputs = (n), 1)
#define ssSetInputPortWidth(S, i, n) ((S)->input_width = (n))
#define ssSetInputPortDirectFeedThrough(S, i, n) ((S)->feedthrough = (n))
#define ssSetNumOutputPorts(S, n) ((S)->outputs = (n), 1)
#define ssSetOutputPortWidth(S, i, n) ((S)->output_width[i] = (n))
#define ssSetNumSampleTimes(S, n) ((S)->samples = (n))
#define ssSetNumRWork(S, n) ((S)->work = (n))
#define ssSetSampleTime(S, i, t) ((void)(S), (void)(t))
#define ssSetOffsetTime(S, i, t) ((void)(S), (void)(t))
#define ssGetT(S) ((S)->t)
#define ssGetContStates(S) ((S)->x)
#define ssGetdX(S) ((S)->dx)
#define ssGetRWork(S) ((S)->rwork)
#define ssGetInputPortRealSignalPtrs(S, i) ((InputRealPtrsType)(S)->input)
#define ssGetOutputPortRealSignal(S, i) ((S)->output[i])

#endif
