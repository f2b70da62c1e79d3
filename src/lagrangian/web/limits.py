"""What a process of the app may take: memory, files, core dumps. The operating system enforces it where it can."""

from __future__ import annotations

import contextlib
import ctypes
import os
import subprocess
import sys
from pathlib import Path

MEMORY = 2**30
"""The memory that a job may take above what its process has at the start, in bytes."""

_DIES_WITH_PARENT = 1
"""``PR_SET_PDEATHSIG`` of Linux."""


def restrict(memory: int = MEMORY) -> None:
    """Restrict this process from now on: no core dumps, no bytes in files, and on Linux so much more address space.

    Other systems do not keep to a limit on the address space: there the parent watches the size of the process.
    """
    if os.name != "posix":
        return
    import resource

    for kind in (resource.RLIMIT_CORE, resource.RLIMIT_FSIZE):
        resource.setrlimit(kind, (0, 0))
    if sys.platform == "linux":
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
        most = pages * resource.getpagesize() + memory
        with contextlib.suppress(ValueError, OSError):  # a smaller limit of the user stays
            resource.setrlimit(resource.RLIMIT_AS, (most, most))


def end_with(parent: int) -> None:
    """Let this process end when its parent does, even if that is killed (Linux; elsewhere its input closes)."""
    if sys.platform == "linux":
        import signal

        with contextlib.suppress(OSError, AttributeError):  # another C library
            ctypes.CDLL(None).prctl(_DIES_WITH_PARENT, signal.SIGKILL, 0, 0, 0)
        if os.getppid() != parent:  # it ended before that was set
            os._exit(1)


def size_of(process: int) -> int | None:
    """Return the memory of a process in bytes, None if it is unknown or the process has ended."""
    if sys.platform == "win32":
        return _size_on_windows(process)
    if sys.platform == "linux":
        try:
            pages = int(Path(f"/proc/{process}/statm").read_text(encoding="ascii").split()[1])
        except (OSError, ValueError, IndexError):
            return None
        return pages * os.sysconf("SC_PAGE_SIZE")
    try:
        said = subprocess.run(
            ["ps", "-o", "rss=", "-p", str(process)], capture_output=True, text=True, check=False, timeout=5
        )
        return int(said.stdout) * 1024
    except (OSError, ValueError, subprocess.SubprocessError):
        return None


def _size_on_windows(process: int) -> int | None:
    """The size that Windows calls the working set, or the committed memory if that is larger."""
    if sys.platform != "win32":
        return None

    class Counters(ctypes.Structure):
        _fields_ = (
            ("size", ctypes.c_uint32),
            ("faults", ctypes.c_uint32),
            *(
                (name, ctypes.c_size_t)
                for name in ("peak", "working", "a", "b", "c", "d", "committed", "peak_committed")
            ),
        )

    kernel = ctypes.WinDLL("kernel32", use_last_error=True)
    kernel.OpenProcess.restype = ctypes.c_void_p
    kernel.K32GetProcessMemoryInfo.argtypes = (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_uint32)
    kernel.CloseHandle.argtypes = (ctypes.c_void_p,)
    handle = kernel.OpenProcess(0x1000, False, process)  # PROCESS_QUERY_LIMITED_INFORMATION
    if not handle:
        return None
    try:
        found = Counters(size=ctypes.sizeof(Counters))
        if not kernel.K32GetProcessMemoryInfo(handle, ctypes.byref(found), found.size):
            return None
        return max(int(found.working), int(found.committed))
    finally:
        kernel.CloseHandle(handle)
