"""The command, ``lagrangian`` or ``python -m lagrangian``.

Until it can answer Ctrl-C in its own words, the signal ends it at once: Python would print a traceback of its imports.
"""

import signal

if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)

from lagrangian.cli import run

if __name__ == "__main__":
    run()
