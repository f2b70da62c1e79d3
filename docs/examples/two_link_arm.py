"""Three masses on a two-link arm, the second angle relative: the lecture's example 2, in Python."""

from sympy import cos, sin

import lagrangian as lg

arm = lg.System("two-link arm")
th1, th2 = arm.coordinates("theta1 theta2")  # SymPy dynamicsymbols: th1.diff() is its rate
La, Lb, Lc, m1, m2, m3 = arm.parameters("L_a L_b L_c m1 m2 m3")
tau = arm.input("tau")

p1 = arm.origin + (La * cos(th1), La * sin(th1))  # points are relative to points
p2 = p1 + (Lb * cos(th1), Lb * sin(th1))
p3 = p2 + (Lc * cos(th1 + th2), Lc * sin(th1 + th2))
arm.particle(m1, at=p1)
arm.particle(m2, at=p2)
arm.particle(m3, at=p3)
arm.gravity(direction=(0, -1))  # parameter g, 9.81 m/s² unless given
arm.torque(tau, on=th1 + th2, reaction=th1)  # acts on link 2, reacts on link 1

d = arm.derive()

if __name__ == "__main__":
    print(d.to_text())
    print("Ξ for theta2 is", d.Xi[th2])
