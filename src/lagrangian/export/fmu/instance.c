/* -- the instance ------------------------------------------------------------------------------------------------

   Everything that changes is in Values, which is plain data: states of an FMU are copies of it. Values are referred to
   in this order: time, the states x = [q; v], their derivatives, inputs, parameters, T, V, multipliers. */

#define FIRST_X 1
#define FIRST_DER (FIRST_X + NX)
#define FIRST_U (FIRST_DER + NX)
#define FIRST_P (FIRST_U + NU)
#define FIRST_E (FIRST_P + NP)
#define FIRST_L (FIRST_E + 2)
#define COUNT (FIRST_L + NL)

#define CLOSED 1e-12   /* a gap of the constraints, over its scale, that needs no further correction */
#define DRIFTED 1e-9   /* one after which an integrator outside is asked for an event, in which it is closed */
#define OPEN 1e-6      /* one that is an error */
#define MOST_STEPS 1000000

typedef struct {
  double t, x[NX + 1], u[NU + 1], p[NP + 1], h, tolerance;
} Values;

typedef struct {
  double der[NX + 1], energy[2], lam[NL + 1];
  int known;
} Results;

typedef struct {
  Values now;
  Results results;
  void (*say)(void *instance, const char *message);
  void *environment, *logger;
  char name[128];
} Instance;

static void reset(Instance *m) {
  memset(&m->now, 0, sizeof m->now);
  memcpy(m->now.x, start_x, sizeof start_x);
  memcpy(m->now.u, start_u, sizeof start_u);
  memcpy(m->now.p, start_p, sizeof start_p);
  m->now.t = START_TIME;
  m->now.tolerance = TOLERANCE;
  m->results.known = 0;
}

static Instance *made(const char *name) {
  Instance *m = (Instance *)calloc(1, sizeof(Instance));
  if (m) {
    strncpy(m->name, name ? name : "", sizeof m->name - 1);
    reset(m);
  }
  return m;
}

/* Whether all of n numbers are finite. */
static int finite_all(const double *x, size_t n) {
  size_t i;
  for (i = 0; i < n; i++)
    if (!(fabs(x[i]) <= 1.7976931348623157e308)) return 0;
  return 1;
}

/* What follows from the values now; 0, and a message, if something is not finite. */
static int computed(Instance *m) {
  Values *n = &m->now;
  Results *r = &m->results;
  if (r->known) return 1;
  eq_rhs(n->x, n->u, n->p, &n->t, r->der);
  eq_energy(n->x, n->x + NQ, n->u, n->p, &n->t, &r->energy[0], &r->energy[1]);
#if NL > 0
  eq_multipliers(n->x, n->x + NQ, n->u, n->p, &n->t, r->lam);
#endif
  if (!finite_all(r->der, NX) || !finite_all(r->energy, 2) || !finite_all(r->lam, NL)) {
    m->say(m, "accelerations, energies or multipliers are not finite in this state");
    return 0;
  }
  return r->known = 1;
}

/* The value behind a reference; 0 if there is none, or if it is not finite. */
static int get(Instance *m, unsigned int vr, double *value) {
  if (vr >= COUNT) {
    m->say(m, "there is no variable with this value reference");
    return 0;
  }
  if (vr < FIRST_X) *value = m->now.t;
  else if (vr < FIRST_DER) *value = m->now.x[vr - FIRST_X];
  else if (vr >= FIRST_U && vr < FIRST_P) *value = m->now.u[vr - FIRST_U];
  else if (vr >= FIRST_P && vr < FIRST_E) *value = m->now.p[vr - FIRST_P];
  else {
    if (!computed(m)) return 0;
    if (vr < FIRST_U) *value = m->results.der[vr - FIRST_DER];
    else if (vr < FIRST_L) *value = m->results.energy[vr - FIRST_E];
    else *value = m->results.lam[vr - FIRST_L];
  }
  return 1;
}

/* Set a state, an input or a parameter; 0 for anything else, and for what is not finite. */
static int set(Instance *m, unsigned int vr, double value) {
  if (!finite_all(&value, 1)) {
    m->say(m, "a value that is not finite cannot be set");
    return 0;
  }
  if (vr >= FIRST_X && vr < FIRST_DER) m->now.x[vr - FIRST_X] = value;
  else if (vr >= FIRST_U && vr < FIRST_P) m->now.u[vr - FIRST_U] = value;
  else if (vr >= FIRST_P && vr < FIRST_E) m->now.p[vr - FIRST_P] = value;
  else {
    m->say(m, "only states, inputs and parameters can be set");
    return 0;
  }
  m->results.known = 0;
  return 1;
}

/* -- constraints -------------------------------------------------------------------------------------------------- */

/* The largest gap of the constraints over its scale, without a change of the state. */
static double gap_now(Instance *m) {
  double gap = 0.0;
#if HAS_POSITION || HAS_VELOCITY
  Values *n = &m->now;
  double dx[NX + 1], margin, one;
#if HAS_POSITION
  eq_position(n->x, n->u, n->p, &n->t, dx, &one, &margin);
  if (!(one <= gap)) gap = one;
#endif
#if HAS_VELOCITY
  eq_velocity(n->x, n->u, n->p, &n->t, dx, &one, &margin);
  if (!(one <= gap)) gap = one;
#endif
#else
  (void)m;
#endif
  return gap;
}

/* Move the state onto its constraints by the least motion; 0, and a message, if they stay open. */
static int settled(Instance *m, int most) {
#if HAS_POSITION || HAS_VELOCITY
  Values *n = &m->now;
  double dx[NX + 1], gap, margin;
  int i;
#if HAS_POSITION
  int k;
  for (k = 0; k < most; k++) {
    eq_position(n->x, n->u, n->p, &n->t, dx, &gap, &margin);
    for (i = 0; i < NX; i++) n->x[i] += dx[i];
    if (gap <= CLOSED) break;
  }
#endif
#if HAS_VELOCITY
  eq_velocity(n->x, n->u, n->p, &n->t, dx, &gap, &margin);
  for (i = 0; i < NX; i++) n->x[i] += dx[i];
#endif
  m->results.known = 0;
  (void)most;
  if (!(gap_now(m) <= OPEN)) {
    m->say(m, "no state near this one satisfies the constraints");
    return 0;
  }
#else
  (void)m;
  (void)most;
#endif
  return 1;
}

/* -- the integrator of a co-simulation: Dormand and Prince's method of order 8, with steps by its error ----------- */

/* One trial step: the new state, and the error over the tolerance (not finite if the state is not). */
static double trial(Instance *m, double h, const double *first, double *y) {
  const Values *n = &m->now;
  double k[RK_STAGES][NX + 1], z[NX + 1], fifth = 0.0, third = 0.0;
  int s, j, i;
  memcpy(k[0], first, sizeof k[0]);
  for (s = 1; s < RK_STAGES; s++) {
    double t = n->t + RK_C[s] * h;
    for (i = 0; i < NX; i++) {
      double sum = 0.0;
      for (j = 0; j < s; j++) sum += RK_A[s][j] * k[j][i];
      z[i] = n->x[i] + h * sum;
    }
    eq_rhs(z, n->u, n->p, &t, k[s]);
  }
  for (i = 0; i < NX; i++) {
    double sum = 0.0, five = 0.0, three = 0.0, scale;
    for (s = 0; s < RK_STAGES; s++) {
      sum += RK_B[s] * k[s][i];
      five += RK_FIFTH[s] * k[s][i];
      three += RK_THIRD[s] * k[s][i];
    }
    y[i] = n->x[i] + h * sum;
    scale = n->tolerance * (0.001 + fmax(fabs(n->x[i]), fabs(y[i])));
    fifth += five / scale * (five / scale);
    third += three / scale * (three / scale);
  }
  if (!finite_all(y, NX)) return INFINITY;
  if (fifth == 0.0) return 0.0;
  return fabs(h) * fifth / sqrt((fifth + 0.01 * third) * NX);
}

/* Integrate up to a time; 0, and a message, if that cannot be done. */
static int advanced(Instance *m, double end) {
  Values *n = &m->now;
  double y[NX + 1];
  long steps;
  if (!(n->h > 0.0)) n->h = 1e-3;
  for (steps = 0; n->t < end; steps++) {
    int last = n->t + 1.001 * n->h >= end;
    double h = last ? end - n->t : n->h, error;
    if (steps == MOST_STEPS) {
      m->say(m, "a communication step takes more than a million steps");
      return 0;
    }
    if (!computed(m)) return 0;
    error = trial(m, h, m->results.der, y);
    if (error <= 1.0) {
      memcpy(n->x, y, NX * sizeof(double));
      n->t = last ? end : n->t + h;
      m->results.known = 0;
      if (!settled(m, 8)) return 0;
      h *= error > 1e-9 ? fmin(6.0, 0.9 * pow(error, -0.125)) : 6.0;
      if (!last || h > n->h) n->h = h;
    } else {
      n->h = h * (error < INFINITY ? fmax(0.2, 0.9 * pow(error, -0.125)) : 0.1);
      if (n->h < 1e-15 * fmax(1.0, fabs(n->t))) {
        m->say(m, "the steps became too small: the motion ends here");
        return 0;
      }
    }
  }
  return 1;
}
