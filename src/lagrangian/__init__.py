"""Equations of motion by the Lagrangian approach: every step shown, every result checked."""

from lagrangian.lazily import closed as _closed
from lagrangian.lazily import lazily as _lazily

TYPE_CHECKING = False  # for type checkers alone; the module that has it takes 10 ms, in which Ctrl-C shows a traceback
if TYPE_CHECKING:
    from lagrangian.check.classes import CheckedClass, ClassCount, ClassRow
    from lagrangian.check.verb import CheckedAnswer
    from lagrangian.compare import Comparison, PicturePair, compare
    from lagrangian.compiled import Compiled
    from lagrangian.derivation import Derivation
    from lagrangian.derivatives.results import Derivatives, HessianProduct, InverseDerivatives, Pullback
    from lagrangian.derive import LedgerRow, Origin, Step, Why
    from lagrangian.derive.constraints.page import Constraints
    from lagrangian.equilibria.points import Equilibria, Equilibrium
    from lagrangian.errors import Error, MissingExtra, ModelError, Notice, ParseError, Place, RunError
    from lagrangian.fit.base_parameters import BaseParameters
    from lagrangian.fit.result import Fit
    from lagrangian.fit.uncertainty import Undetermined
    from lagrangian.integrate.estimate import NotStarted as NotStarted
    from lagrangian.integrate.estimate import SweepEstimate as SweepEstimate
    from lagrangian.invariants.canonical_forms import Hamiltonian, Routhian
    from lagrangian.invariants.conserved_quantities import Conserved, ConservedQuantities
    from lagrangian.linear.along import MotionLinearization
    from lagrangian.linear.linearization import Linearization
    from lagrangian.linear.modes import Mode
    from lagrangian.linear.regulator import Regulator
    from lagrangian.linear.stability import Stability
    from lagrangian.linear.symbolic import SymbolicLinearization
    from lagrangian.optimize.result import Optimum
    from lagrangian.page.formula import Check, EquationTerm
    from lagrangian.page.report import Report
    from lagrangian.picture import Picture
    from lagrangian.simulate.animation import Animation
    from lagrangian.simulate.ensemble import Ensemble
    from lagrangian.simulate.events import Event, event
    from lagrangian.simulate.reaction import Reaction
    from lagrangian.simulate.recorded import Audit
    from lagrangian.simulate.sensitivities import Sensitivities
    from lagrangian.simulate.settings import Execution, RunSettings
    from lagrangian.simulate.trajectory import Trajectory
    from lagrangian.system import System, example, load, loads
    from lagrangian.worksheet import Worksheet
else:
    __getattr__ = _lazily(
        __name__,
        {
            "check.classes": "CheckedClass ClassCount ClassRow",
            "check.verb": "CheckedAnswer",
            "compare": "Comparison PicturePair compare",
            "compiled": "Compiled",
            "derivation": "Derivation",
            "derivatives.results": "Derivatives HessianProduct InverseDerivatives Pullback",
            "derive": "LedgerRow Origin Step Why",
            "derive.constraints.page": "Constraints",
            "equilibria.points": "Equilibria Equilibrium",
            "errors": "Error MissingExtra ModelError Notice ParseError Place RunError",
            "fit.base_parameters": "BaseParameters",
            "fit.result": "Fit",
            "fit.uncertainty": "Undetermined",
            "invariants.canonical_forms": "Hamiltonian Routhian",
            "integrate.estimate": "NotStarted SweepEstimate",
            "invariants.conserved_quantities": "Conserved ConservedQuantities",
            "linear.along": "MotionLinearization",
            "linear.linearization": "Linearization",
            "linear.modes": "Mode",
            "linear.regulator": "Regulator",
            "linear.stability": "Stability",
            "linear.symbolic": "SymbolicLinearization",
            "optimize.result": "Optimum",
            "page.formula": "Check EquationTerm",
            "page.report": "Report",
            "picture": "Picture",
            "simulate.animation": "Animation",
            "simulate.ensemble": "Ensemble",
            "simulate.events": "Event event",
            "simulate.reaction": "Reaction",
            "simulate.recorded": "Audit",
            "simulate.sensitivities": "Sensitivities",
            "simulate.settings": "Execution RunSettings",
            "simulate.trajectory": "Trajectory",
            "system": "System example load loads",
            "worksheet": "Worksheet",
        },
    )

__all__ = [
    "Animation",
    "Audit",
    "BaseParameters",
    "Check",
    "CheckedAnswer",
    "CheckedClass",
    "ClassCount",
    "ClassRow",
    "Comparison",
    "Compiled",
    "Conserved",
    "ConservedQuantities",
    "Constraints",
    "Derivation",
    "Derivatives",
    "Ensemble",
    "EquationTerm",
    "Equilibria",
    "Equilibrium",
    "Error",
    "Event",
    "Execution",
    "Fit",
    "Hamiltonian",
    "HessianProduct",
    "InverseDerivatives",
    "LedgerRow",
    "Linearization",
    "MissingExtra",
    "Mode",
    "ModelError",
    "MotionLinearization",
    "NotStarted",
    "Notice",
    "Optimum",
    "Origin",
    "ParseError",
    "Picture",
    "PicturePair",
    "Place",
    "Pullback",
    "Reaction",
    "Regulator",
    "Report",
    "Routhian",
    "RunError",
    "RunSettings",
    "Sensitivities",
    "Stability",
    "Step",
    "SweepEstimate",
    "SymbolicLinearization",
    "System",
    "Trajectory",
    "Undetermined",
    "Why",
    "Worksheet",
    "compare",
    "event",
    "example",
    "load",
    "loads",
]
__version__ = "0.1.0"


def __dir__() -> list[str]:
    return sorted([*__all__, *(name for name in globals() if name.startswith("__"))])


_closed(__name__)
del TYPE_CHECKING
