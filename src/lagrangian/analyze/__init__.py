"""Is it right, and what does it do? Verification, dimensions, rests, linearization, what is conserved."""

from typing import TYPE_CHECKING

from lagrangian.analyze.verify.equations import verify
from lagrangian.lazily import lazily

if TYPE_CHECKING:
    from lagrangian.analyze.dimensions import check_dimensions
    from lagrangian.analyze.kept.conserved import Conserved, ConservedQuantities, conserved
    from lagrangian.analyze.kept.hamiltonian import Hamiltonian, hamiltonian
    from lagrangian.analyze.kept.routhian import Routhian, routhian
    from lagrangian.analyze.linear.along import LinearizationAlong, linearize_along
    from lagrangian.analyze.linear.linearize import Linearization, linearize
    from lagrangian.analyze.linear.regulate import Regulator, lqr, to_control
    from lagrangian.analyze.linear.symbolic import SymbolicLinearization, symbolic
    from lagrangian.analyze.rests.equilibria import Equilibria, Equilibrium, equilibria
    from lagrangian.analyze.verify.motion import verify_motion
    from lagrangian.analyze.verify.products import verify_products
    from lagrangian.analyze.verify.report import verification_report
else:
    __getattr__ = lazily(
        __name__,
        {
            "dimensions": "check_dimensions",
            "kept.conserved": "Conserved ConservedQuantities conserved",
            "kept.hamiltonian": "Hamiltonian hamiltonian",
            "kept.routhian": "Routhian routhian",
            "linear.along": "LinearizationAlong linearize_along",
            "linear.linearize": "Linearization linearize",
            "linear.regulate": "Regulator lqr to_control",
            "linear.symbolic": "SymbolicLinearization symbolic",
            "rests.equilibria": "Equilibria Equilibrium equilibria",
            "verify.motion": "verify_motion",
            "verify.products": "verify_products",
            "verify.report": "verification_report",
        },
    )

__all__ = [
    "Conserved",
    "ConservedQuantities",
    "Equilibria",
    "Equilibrium",
    "Hamiltonian",
    "Linearization",
    "LinearizationAlong",
    "Regulator",
    "Routhian",
    "SymbolicLinearization",
    "check_dimensions",
    "conserved",
    "equilibria",
    "hamiltonian",
    "linearize",
    "linearize_along",
    "lqr",
    "routhian",
    "symbolic",
    "to_control",
    "verification_report",
    "verify",
    "verify_motion",
    "verify_products",
]
