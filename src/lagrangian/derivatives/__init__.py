"""How do the accelerations change? Derivatives of the dynamics, and of single steps, as numbers."""
