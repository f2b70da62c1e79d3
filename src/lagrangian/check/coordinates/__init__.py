"""Answers in other coordinates than the system's."""
