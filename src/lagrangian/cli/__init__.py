"""Where the installed command begins: data on standard output, talk on standard error, exit 0, 1 or 2.

It imports nothing heavy, so that an interrupt is heard from the start.
"""

from __future__ import annotations

import sys
from typing import NoReturn

from lagrangian.interrupts import CODE, interrupts

CLOSED_PIPE = 141
"""The exit code where the reader has seen enough, as in ``lagrangian … | head``: 128 and the number of SIGPIPE."""


def run() -> NoReturn:
    """Run the command and leave with its exit code: the entry point of the installed command."""
    interrupts.listen()
    try:
        code = main()
    except BaseException:
        if not interrupts.came:
            raise
        code = CODE
    if interrupts.came:  # whatever a library made of it
        code = interrupts.say()
    interrupts.finish()
    sys.exit(code)


def main(arguments: list[str] | None = None) -> int:
    """Run the command; return 0 when all is well, 1 when a check failed, 2 for a mistake in what was given."""
    from lagrangian.cli import door
    from lagrangian.cli.app import invoked
    from lagrangian.cli.progress import status
    from lagrangian.cli.wording import in_options
    from lagrangian.errors import Error

    if sys.stdout is None:  # closed by the shell, as in `lagrangian … >&-`
        door.fail("[E801] standard output is closed")
        return 2
    door.prepare()
    try:
        with status.showing("starting"):
            code = invoked(sys.argv[1:] if arguments is None else arguments)
        sys.stdout.flush()  # a full disk shows itself only here
    except BrokenPipeError:
        door.drop()
        return CLOSED_PIPE
    except OSError as trouble:
        door.drop()
        where = "write to standard output" if trouble.filename is None else f"use '{trouble.filename}'"
        door.fail(f"[E801] cannot {where}: {(trouble.strerror or str(trouble)).lower()}")
        return 2
    except Error as error:
        error.fix = error.fix and in_options(error.fix)
        door.fail(str(error))
        return 2
    return code
