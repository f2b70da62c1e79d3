"""The names of all methods of integration, which the help of the command lists without importing the methods."""

MACHINE = ("rk4", "tsit5", "dop853", "gauss4", "taylor")
"""The methods that are printed as machine code, in the order of `lagrangian.integrate.METHODS`."""

SCIPY = ("RK45", "RK23", "DOP853", "Radau", "BDF", "LSODA")
"""SciPy's methods by their names in `scipy.integrate.solve_ivp`."""

MULTISTEP = ("BDF", "LSODA")
"""Those with a history: they go on from many steps, and noise in the accelerations is in all of it."""
