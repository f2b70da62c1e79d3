"""From a description to runs: one, an ensemble, a sweep. Wires mechanics to integrators and names what comes out."""
