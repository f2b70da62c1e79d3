"""What went wrong: the mistakes that explain an answer, in the order in which they are likely, and their words."""
