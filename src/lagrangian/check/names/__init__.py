"""What the names of an answer mean that the system does not have."""
