"""How the terms of a sum, as they were written, differ from the right ones, and in which scale."""
