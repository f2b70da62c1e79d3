"""One file a verb of the command; `terminal` is what they share."""
