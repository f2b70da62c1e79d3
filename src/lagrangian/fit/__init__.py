"""Which constants fit measured data? Least squares with the sensitivities of runs."""
