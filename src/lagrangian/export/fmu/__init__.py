"""Writes a system as a Functional Mock-up Unit, for model exchange and co-simulation, with sources and a binary."""
