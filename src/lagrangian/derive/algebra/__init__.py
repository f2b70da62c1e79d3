"""The algebra under readable equations: an exact normal form, and from it what a textbook prints.

`algebra` is the ring of one system and `form` the trigonometric normal form in it; `reading` takes expressions into it,
`generators` and `monomials` are what it is made of; `readable` writes it out, with `group`, `factor`, `trig` and `sums`
to choose the shape.
"""

from lagrangian.derive.algebra.algebra import Algebra, equations
from lagrangian.derive.algebra.form import Form, OutOfReach, Term

__all__ = ["Algebra", "Form", "OutOfReach", "Term", "equations"]
