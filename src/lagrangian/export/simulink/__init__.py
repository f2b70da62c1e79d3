"""Writes a system as a C S-function of Simulink."""
