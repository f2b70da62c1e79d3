"""The command, ``lagrangian`` or ``python -m lagrangian``.

Until it can answer Ctrl-C in its own words, the signal ends it at once: Python would print a traceback of its imports.
"""

import os
import signal

if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)

os.environ.setdefault("SYMPY_CACHE_SIZE", "20000")  # the results of each function that SymPy keeps: read at its import

from lagrangian.cli import run

if __name__ == "__main__":
    run()
