/* Runs a system that the Python package `lagrangian` compiled, in a browser, a worker or Node. No dependency.

   lagrangianSolver.makeSolver(code, layout, functions)  integrates in WebAssembly; code: bytes or WebAssembly.Module
   lagrangianSolver.makeFallback(functions, layout)      the same in JavaScript, with Runge-Kutta steps of order 4
   lagrangianSolver.load(code, layout, functions)        a promise of the first, or of the second where WebAssembly is
                                                         forbidden; solver.kind is "wasm" or "javascript"

   solver.solve({state, params, inputs, t0, t1, samples | every | times, rtol, atol, step, maxSteps, maxStep, maxEvents,
                 seconds})
      -> {status, message, t, states, supplied, final, reached, events, steps, rejected, evaluations}
   solver.start({state, params, inputs, t, ...})      begins a run that is shown while it is computed
   solver.advance(dt) -> {status, message, t, state, supplied, events, steps}
   solver.change({state, params, inputs})             between two calls of advance
   solver.many({states, params, inputs, t0, t1, ...}) many runs, one row of states each (only in WebAssembly)
      -> {status, final, reached, supplied, events, steps, rejected, evaluations}, and with samples or times also states

   States, parameters and inputs are arrays in the order of the layout, or objects by name; what is left out keeps the
   value of the layout (start, change: the value it has). SI units. supplied: the energy that inputs, dampers and
   prescribed motions have supplied since the start of the call; layout.supply says whether they can. status: 0 the end
   was reached, 1 a terminal event, negative: the run failed, and message says why. */
