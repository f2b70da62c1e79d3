"""Local changes of a derivation: every small mistake that can be made in a system, and its effect in numbers."""
