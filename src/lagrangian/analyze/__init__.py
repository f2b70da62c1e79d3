"""Is it right, and what does it do? Verification, dimensions, rests, linearization, what is conserved."""

from typing import TYPE_CHECKING

from lagrangian.analyze.verify.equations import verify
from lagrangian.lazily import lazily

if TYPE_CHECKING:
    from lagrangian.analyze.dimensions import check_dimensions
    from lagrangian.analyze.kept.canonical_forms import Hamiltonian, Routhian
    from lagrangian.analyze.kept.conserved import conserved
    from lagrangian.analyze.kept.conserved_quantities import Conserved, ConservedQuantities
    from lagrangian.analyze.kept.hamiltonian import hamiltonian
    from lagrangian.analyze.kept.routhian import routhian
    from lagrangian.analyze.linear.along import LinearizationAlong, linearize_along
    from lagrangian.analyze.linear.linearization import Linearization
    from lagrangian.analyze.linear.linearize import linearize
    from lagrangian.analyze.linear.regulate import lqr, to_control
    from lagrangian.analyze.linear.regulator import Regulator
    from lagrangian.analyze.linear.symbolic import SymbolicLinearization, symbolic
    from lagrangian.analyze.rests.equilibria import equilibria
    from lagrangian.analyze.rests.found import Equilibria, Equilibrium
    from lagrangian.analyze.verify.motion import verify_motion
    from lagrangian.analyze.verify.products import verify_products
    from lagrangian.analyze.verify.report import verification_report
else:
    __getattr__ = lazily(
        __name__,
        {
            "dimensions": "check_dimensions",
            "kept.canonical_forms": "Hamiltonian Routhian",
            "kept.conserved": "conserved",
            "kept.conserved_quantities": "Conserved ConservedQuantities",
            "kept.hamiltonian": "hamiltonian",
            "kept.routhian": "routhian",
            "linear.along": "LinearizationAlong linearize_along",
            "linear.linearization": "Linearization",
            "linear.linearize": "linearize",
            "linear.regulate": "lqr to_control",
            "linear.regulator": "Regulator",
            "linear.symbolic": "SymbolicLinearization symbolic",
            "rests.equilibria": "equilibria",
            "rests.found": "Equilibria Equilibrium",
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
