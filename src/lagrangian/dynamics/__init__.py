"""Model → Program: inverse and forward dynamics, mass matrix, energies, by virtual work through the graph."""
