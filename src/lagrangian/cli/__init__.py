"""The entry point of the command: data on standard output, messages on standard error, exit code 0, 1 or 2.

It imports nothing slow, so that Ctrl-C works from the start.
"""

from __future__ import annotations

import sys
from typing import NoReturn

from lagrangian.interrupts import CODE, interrupts

CLOSED_PIPE = 141
"""The exit code if the reader of the output closes it, as in ``lagrangian … | head``: 128 plus the number of
SIGPIPE."""


def run() -> NoReturn:
    """Run the command and exit with its exit code: the entry point of the installed command."""
    try:
        interrupts.listen()
        code = main()
    except BaseException:
        if not interrupts.came:
            raise
        code = CODE
    if interrupts.came:  # whatever exception a library made of it
        code = interrupts.say()
    interrupts.finish()
    sys.exit(code)


def main(arguments: list[str] | None = None) -> int:
    """Run the command; return 0 for success, 1 if a check failed, 2 for a mistake in the arguments or the model."""
    from lagrangian.cli import door
    from lagrangian.cli.app import invoked
    from lagrangian.cli.progress import status
    from lagrangian.cli.wording import in_options
    from lagrangian.errors import Error

    if sys.stdout is None:  # the shell closed it, as in `lagrangian … >&-`
        door.fail("[E801] standard output is closed")
        return 2
    door.prepare()
    try:
        with status.showing("starting"):
            code = invoked(sys.argv[1:] if arguments is None else arguments)
        sys.stdout.flush()  # a full disk may become apparent only here
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
