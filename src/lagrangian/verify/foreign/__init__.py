"""Runs exports in the programs that they were written for, each in a file of its own."""
