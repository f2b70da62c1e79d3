"""A pole on a cart: values with units, a frame, friction, and where a term of the equations came from."""

import lagrangian as lg

system = lg.System("pole on a cart")
x = system.coordinate("x", "cart, along the track")
theta = system.coordinate("theta", "pole, from upright, positive where it leans forward")
M, m, l, J, b = system.parameters("M m l J b", M="1 kg", m="0.2 kg", l="0.3 m", J="0.006 kg*m^2", b="0.1 N*s/m")
F = system.input("F", "pushes the cart forward", unit="N")

cart = system.origin + (x, 0)
rod = system.frame(-theta, origin=cart)  # frames count counter-clockwise, leaning forward is clockwise
system.particle(M, at=cart, name="cart")
system.rigid_body(m, J, at=rod.point(0, l), frame=rod, name="pole")
system.gravity()
system.damper(b, deflection=x)
system.force((F, 0), at=cart)

d = system.derive()

if __name__ == "__main__":
    print(d.to_text(brief=True))
    for term in d.terms[1]:
        print(f"{term.expr}: {term.kind}, from {', '.join(term.elements)}")
