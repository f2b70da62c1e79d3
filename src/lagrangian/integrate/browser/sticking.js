/* Whether a state lies on a surface where a force jumps, and to which the motion leads from both sides (A. F. Filippov,
   Differential Equations with Discontinuous Righthand Sides, 1988, section 4); as in chattering.py of the package. */
function sticks({ sticking }, { surfaces, rhs }, x, p, u, t, reach, step) {
  const n = x.length, known = surfaces(x, p, u, t), here = rhs(x, p, u, t), m = known.length / (n + 2);
  const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);
  const normalOf = (f, k) => f.subarray(m + k * n, m + (k + 1) * n), driftOf = (f, k) => f[m + m * n + k];
  for (let k = 0; k < m; k++) {
    const s = known[k], normal = normalOf(known, k), length = dot(normal, normal), tiny = sticking.aside;
    if (!(length > 0 && length < Infinity)) continue;
    const rounding = normal.reduce((sum, a, i) => sum + Math.abs(a) * (Math.abs(x[i]) + tiny), 0);
    const aside = 2 * Math.abs(s) + tiny * rounding;
    const [a, b] = [1, -1].map((side) => {
      const beside = x.map((value, i) => value + ((side * aside - s) / length) * normal[i]);
      const there = surfaces(beside, p, u, t);
      return -side * (dot(normalOf(there, k), rhs(beside, p, u, t)) + driftOf(there, k));
    });
    const slow = Math.min(a, b), near = aside <= reach * slow || aside <= 2 * step * Math.max(a, b);
    if (slow > 0 && near && Math.abs(dot(normal, here) + driftOf(known, k)) > sticking.rests * slow) return true;
  }
  return false;
}
