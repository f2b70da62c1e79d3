"""A hatch that a rope to a drum holds: the length of the rope is a function of half the angle."""

from functools import cache

import lagrangian as lg

HATCH = """
name = "hatch on a rope"
[coordinates]
theta = "hatch from the vertical"
[parameters]
m = "20 kg"
a = "1 m"
b = "2 m"
r = "0.1 m"
Jd = "0.5 kg*m^2"
c = "3 N*m*s"
[inputs]
tau = "N*m, on the drum, hauls in"
[define]
NAME = "2*b*sin(pi/4 + theta/2)"
[points]
G = ["a*sin(theta)", "a*cos(theta)"]
[[frame]]
name = "drum"
angle = "NAME/r"
[[particle]]
name = "hatch"
mass = "m"
at = "G"
[[rigid_body]]
name = "drum"
mass = 1
inertia = "Jd"
at = "origin"
frame = "drum"
[[gravity]]
direction = [0, -1]
[[damper]]
name = "hinge"
b = "c"
deflection = "theta"
[[torque]]
name = "winch"
value = "-tau"
on = "NAME/r"
"""


@cache
def hatch(name: str, r: str = "0.1 m") -> lg.Derivation:
    """The hatch, whose rope has a length with this name, and a drum of this radius."""
    return lg.loads(HATCH.replace("NAME", name).replace("0.1 m", r)).derive()
