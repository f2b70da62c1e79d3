"""The linear system near a point: A, B, C, D, poles, modes, stability, control."""
