"""Which parameters, initial values and inputs make a run best? Exact gradients, SciPy's searches."""
