"""Quantities that are constant along every motion, and the equations of Hamilton and Routh."""
