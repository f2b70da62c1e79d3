"""Answers in plain text."""
