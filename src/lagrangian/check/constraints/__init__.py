"""Systems with constraints: answers with multipliers of any sign, without multipliers, and with a constraint put in."""
