/* Runs an S-function by a fixed step of Runge and Kutta, as a test asks: see test_simulink.py. */

#include <string.h>

/* p, x0: parameters of the dialog and their numbers of entries; u: constant inputs; x: the state at the end; energy: T
   and V there. Return the error's text, or NULL. */
const char *run(double *p, int np, double *x0, int nx, const double *u, double step, int steps, int project, double *x,
                double *energy) {
  static double work[NP + 1], dx[NX], k[4][NX], base[NX], out[NX];
  static const double *pointers[NU + 1];
  static const double share[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
  mxArray first, second;
  SimStruct S;
  int n, s, i;
  memset(&S, 0, sizeof S);
  first.values = p;
  first.count = np;
  second.values = x0;
  second.count = nx;
  S.given[0] = &first;
  S.given[1] = &second;
  S.x = x;
  S.dx = dx;
  S.rwork = work;
  S.output[0] = out;
  S.output[1] = energy;
  for (i = 0; i < NU; i++) pointers[i] = &u[i];
  S.input = pointers;
  mdlInitializeSizes(&S);
  if (S.error) return S.error;
  if (S.states != NX || S.input_width != NU || S.output_width[0] != NX || S.output_width[1] != 2 || S.work < NP)
    return "sizes";
  mdlInitializeSampleTimes(&S);
  mdlInitializeConditions(&S);
  for (n = 0; n < steps && !S.error; n++) {
    double t = n * step;
    memcpy(base, x, sizeof base);
    for (s = 0; s < 4; s++) {
      S.t = t + share[s] * step;
      for (i = 0; i < NX; i++) x[i] = base[i] + (s ? step * share[s] * k[s - 1][i] : 0.0);
      mdlDerivatives(&S);
      memcpy(k[s], dx, sizeof dx);
    }
    for (i = 0; i < NX; i++)
      for (x[i] = base[i], s = 0; s < 4; s++) x[i] += step * weight[s] * k[s][i];
    S.t = t + step;
#ifdef MDL_PROJECTION
    if (project) mdlProjection(&S);
#endif
  }
  (void)project;
  mdlOutputs(&S, 0);
  if (memcmp(out, x, sizeof out)) return "the first port is not the state";
  mdlTerminate(&S);
  return S.error;
}
