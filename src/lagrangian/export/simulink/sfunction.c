/* -- the S-function ---------------------------------------------------------------------------------------------- */

#define PARAMETERS 0   /* of the dialog: p, or [] for the declared values */
#define START 1        /* x at the start, or [] for that of the model file */
#define COUNT(S, i) ((int)mxGetNumberOfElements(ssGetSFcnParam(S, i)))
#define WORKING 0      /* the parameters as doubles, in a work vector */

static double time_of(SimStruct *S) { return (double)ssGetT(S); }

static void inputs_of(SimStruct *S, double *u) {
  int i;
  for (i = 0; i <= NU; i++) u[i] = start_u[i];
#if NU > 0
  {
    InputRealPtrsType port = ssGetInputPortRealSignalPtrs(S, 0);
    for (i = 0; i < NU; i++) u[i] = *port[i];
  }
#else
  (void)S;
#endif
}

#define MDL_CHECK_PARAMETERS
static void mdlCheckParameters(SimStruct *S) {
  if (COUNT(S, PARAMETERS) != 0 && COUNT(S, PARAMETERS) != NP)
    ssSetErrorStatus(S, "the first parameter must be [] or hold every parameter of the system, in declared order");
  else if (COUNT(S, START) != 0 && COUNT(S, START) != NX)
    ssSetErrorStatus(S, "the second parameter must be [] or the state [q; v] at the start");
}

static void mdlInitializeSizes(SimStruct *S) {
  ssSetNumSFcnParams(S, 2);
  if (ssGetNumSFcnParams(S) != ssGetSFcnParamsCount(S)) return;   /* Simulink says so */
  mdlCheckParameters(S);
  if (ssGetErrorStatus(S) != NULL) return;
  ssSetNumContStates(S, NX);
  ssSetNumDiscStates(S, 0);
  if (!ssSetNumInputPorts(S, NU > 0 ? 1 : 0)) return;
#if NU > 0
  ssSetInputPortWidth(S, 0, NU);
  ssSetInputPortDirectFeedThrough(S, 0, ENERGY_READS_INPUTS);
#endif
  if (!ssSetNumOutputPorts(S, 2)) return;
  ssSetOutputPortWidth(S, 0, NX);   /* x = [q; v] */
  ssSetOutputPortWidth(S, 1, 2);    /* T and V */
  ssSetNumSampleTimes(S, 1);
  ssSetNumRWork(S, NP + 1);
}

static void mdlInitializeSampleTimes(SimStruct *S) {
  ssSetSampleTime(S, 0, CONTINUOUS_SAMPLE_TIME);
  ssSetOffsetTime(S, 0, 0.0);
}

#define MDL_PROCESS_PARAMETERS
static void mdlProcessParameters(SimStruct *S) {
  const double *given = COUNT(S, PARAMETERS) ? mxGetPr(ssGetSFcnParam(S, PARAMETERS)) : start_p;
  real_T *p = ssGetRWork(S);
  int i;
  for (i = 0; i < NP; i++) p[i] = given[i];
}

#define MDL_INITIALIZE_CONDITIONS
static void mdlInitializeConditions(SimStruct *S) {
  const double *given = COUNT(S, START) ? mxGetPr(ssGetSFcnParam(S, START)) : start_x;
  real_T *x = ssGetContStates(S);
  int i;
  mdlProcessParameters(S);
  for (i = 0; i < NX; i++) x[i] = given[i];
}

static void mdlOutputs(SimStruct *S, int_T tid) {
  const double *x = ssGetContStates(S);
  real_T *states = ssGetOutputPortRealSignal(S, 0), *energy = ssGetOutputPortRealSignal(S, 1);
  double u[NU + 1], t = time_of(S);
  int i;
  (void)tid;
#if ENERGY_READS_INPUTS
  inputs_of(S, u);
#else
  for (i = 0; i <= NU; i++) u[i] = 0.0;
#endif
  for (i = 0; i < NX; i++) states[i] = x[i];
  eq_energy(x, x + NQ, u, ssGetRWork(S), &t, &energy[0], &energy[1]);
}

#define MDL_DERIVATIVES
static void mdlDerivatives(SimStruct *S) {
  double u[NU + 1], t = time_of(S);
  real_T *dx = ssGetdX(S);
  int i;
  inputs_of(S, u);
  eq_rhs(ssGetContStates(S), u, ssGetRWork(S), &t, dx);
  for (i = 0; i < NX; i++)
    if (!(fabs(dx[i]) <= 1.7976931348623157e308)) {
      ssSetErrorStatus(S, "the accelerations are not finite in this state");
      return;
    }
}

#if HAS_POSITION || HAS_VELOCITY
/* After every step of a solver with variable steps: the least motion onto the constraints. */
#define MDL_PROJECTION
static void mdlProjection(SimStruct *S) {
  double u[NU + 1], dx[NX], gap = 0.0, margin, t = time_of(S);
  real_T *x = ssGetContStates(S);
  int i;
#if HAS_POSITION
  int k;
#endif
  inputs_of(S, u);
#if HAS_POSITION
  for (k = 0; k < 8; k++) {
    eq_position(x, u, ssGetRWork(S), &t, dx, &gap, &margin);
    for (i = 0; i < NX; i++) x[i] += dx[i];
    if (gap <= 1e-12) break;
  }
  if (!(gap <= 1e-6)) {
    ssSetErrorStatus(S, "the state has left its constraints: choose a smaller tolerance, or another start");
    return;
  }
#endif
#if HAS_VELOCITY
  eq_velocity(x, u, ssGetRWork(S), &t, dx, &gap, &margin);
  for (i = 0; i < NX; i++) x[i] += dx[i];
#endif
}
#endif

static void mdlTerminate(SimStruct *S) { (void)S; }

#ifdef MATLAB_MEX_FILE
#include "simulink.c"
#else
#include "cg_sfun.h"
#endif
