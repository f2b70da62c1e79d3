"""The algebra behind readable equations: an exact normal form, and its conversion to textbook form.

`algebra` is the polynomial ring of one system, and `form` is the trigonometric normal form in it. `reading` converts
expressions to it, using `generators` and `monomials`. `readable` converts it back, and `group`, `factor`, `trig` and
`sums` choose the shape of the result.
"""

from lagrangian.derive.algebra.algebra import Algebra, equations
from lagrangian.derive.algebra.form import Form, OutOfReach, Term

__all__ = ["Algebra", "Form", "OutOfReach", "Term", "equations"]
