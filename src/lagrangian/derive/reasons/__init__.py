"""Why are these the equations of motion? The lecture's equations (1) to (12), carried out on one system.

`motion` has momenta and wiggles, `loads` the forces on bodies, `held` what holds each of them, `laws` both sides of
every equation in normal form, `at_a_state` the same in numbers by another route. `forces_page`, `constraint_page` and
`energy_page` are the parts of the page.
"""

from lagrangian.derive.reasons.page import Why, why

__all__ = ["Why", "why"]
