"""The methods that describe circuits: coils, capacitors, resistors, sources, and windings that move something."""

from __future__ import annotations

from lagrangian.calls import Guided, worded
from lagrangian.model import (
    Builder,
    Capacitor,
    Frame,
    Inductor,
    MutualInductance,
    Resistor,
    Transducer,
    VoltageSource,
)
from lagrangian.model.decimals import describes


@worded
@describes
class Circuits(Guided):
    """The methods that add circuit elements, each with the ``charge`` [C] that flows through it.

    Charges are generalized coordinates, one for each loop; a branch that two loops share has ``q1 - q2``.
    """

    _builder: Builder

    def inductor(
        self, L: object = None, charge: object = None, *, law: object = None, coenergy: object = None, name: str = ""
    ) -> Inductor:
        """Add a coil: T* = ½ L i². A ``law`` is its flux linkage [Wb]: ``lambda i: L0*i0*sympy.tanh(i/i0)``.

        L [H] and the law may depend on positions; instead of both, give T* [J] as ``coenergy``.
        """
        return self._builder.add(Inductor(charge=charge, L=L, law=law, coenergy=coenergy, name=name))

    def mutual_inductance(
        self, M: object, charge: object = None, other_charge: object = None, *, name: str = ""
    ) -> MutualInductance:
        """Add the flux that two coils share: T* = M i₁ i₂ with the mutual inductance M [H]."""
        return self._builder.add(MutualInductance(M=M, charge=charge, other_charge=other_charge, name=name))

    def capacitor(
        self, C: object = None, charge: object = None, *, law: object = None, energy: object = None, name: str = ""
    ) -> Capacitor:
        """Add a capacitor: V = q²/(2 C). A ``law`` is its voltage [V]: ``lambda q: q/C + a*q**3``.

        C [F] and the law may depend on positions; instead of both, give V [J] as ``energy``.
        """
        return self._builder.add(Capacitor(charge=charge, C=C, law=law, energy=energy, name=name))

    def resistor(self, R: object = None, charge: object = None, *, law: object = None, name: str = "") -> Resistor:
        """Add a resistor: D = ½ R i². A ``law`` is its voltage [V] as a function of its current."""
        return self._builder.add(Resistor(charge=charge, R=R, law=law, name=name))

    def voltage_source(self, value: object, charge: object = None, *, name: str = "") -> VoltageSource:
        """Add a source of voltage [V], an input or an expression; a positive one drives the charge forward."""
        return self._builder.add(VoltageSource(charge=charge, value=value, name=name))

    def transducer(self, k: object, charge: object = None, on: Frame | object = None, *, name: str = "") -> Transducer:
        """Add a winding in the field of a magnet: the effort k i ``on`` an angle or displacement, the back-emf k ẋ."""
        return self._builder.add(Transducer(charge=charge, k=k, on=on, name=name))
