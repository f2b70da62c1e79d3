"""Random circuits that move something, described twice: by elements to the package, by T*, V, D and Ξ to the oracle.

Coils and capacitors depend on where a cart and a rotor are; mutual inductances, resistors of shared branches, sources
that depend on time, and transducers, whose two actions, k i on what moves and −k ẋ on the charge, are written out.
"""

from __future__ import annotations

import random

import sympy as sp
from differences import Mechanism
from random_systems import Case, chosen, of

import lagrangian as lg


def circuits(seed: int) -> Case:
    """A cart and a rotor, and one to three loops of which each has a coil."""
    source = random.Random(seed)
    s = lg.System(f"circuit {seed}")
    x, phi = s.coordinate("x"), s.coordinate("phi")
    charges = [s.coordinate(f"q{k}") for k in range(source.randint(1, 3))]
    q, u, t = [x, phi, *charges], {}, s.t
    m, J, k, b = (chosen(source) for _ in range(4))
    rotor = s.frame(phi, name="rotor")
    s.particle(m, at=s.origin + (x, 0))
    s.rigid_body(m, J, at=s.origin, frame=rotor)
    s.spring(k, deflection=x)
    s.damper(b, deflection=phi)
    T, V, D = m * x.diff() ** 2 / 2 + J * phi.diff() ** 2 / 2, k * x**2 / 2, b * phi.diff() ** 2 / 2
    Xi: dict[int, sp.Expr] = dict.fromkeys(range(len(q)), sp.S.Zero)
    for i, charge in enumerate(charges, 2):
        L = 2 + chosen(source) / (1 + x**2) + sp.cos(phi) ** 2 / 5
        s.inductor(L, charge)
        T += L * charge.diff() ** 2 / 2
        if source.random() < 0.6:
            C = chosen(source) / (1 + chosen(source) * x**2)
            s.capacitor(C, charge)
            V += charge**2 / (2 * C)
        if source.random() < 0.7:
            driven = s.input(f"u{i}")
            u[driven] = float(chosen(source))
            s.voltage_source(driven + sp.sin(t), charge)
            Xi[i] += driven + sp.sin(t)
    for i in range(2, len(q)):
        one, other = q[i], q[source.randrange(2, len(q))]
        branch = one if one == other else one - other
        R = chosen(source) * (1 + x**2)
        s.resistor(R, branch)
        D += R * branch.diff() ** 2 / 2
        if one != other:
            M = sp.cos(phi) / 3
            s.mutual_inductance(M, one, other)
            T += M * one.diff() * other.diff()
        constant, (at, place) = chosen(source), source.choice([(0, x), (1, rotor)])
        s.transducer(constant, one, on=place)
        Xi[at] += constant * one.diff()
        Xi[i] -= constant * q[at].diff()
    oracle = Mechanism(len(q), kinetics=[of(T, q, q, t, {})], losses=[of(D, q, q, t, {})])
    stored = of(V, q, q, t, {})
    oracle.potentials.append(lambda at, time: stored(at, at, time))
    oracle.direct += [(i, of(force, q, q, t, u)) for i, force in Xi.items()]
    return Case(s, oracle, list(u.values()))
