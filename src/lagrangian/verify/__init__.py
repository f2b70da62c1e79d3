"""Routes held against each other: the derived equations, what is compiled, exported and linearized from them."""
