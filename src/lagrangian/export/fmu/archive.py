"""The archive of an FMU: description, source, and a binary for this machine where a C compiler is found."""

from __future__ import annotations

import io
import logging
import platform
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

from lagrangian.export.fmu.description import build_description, description2, description3
from lagrangian.export.fmu.source import Standard, source, token_of
from lagrangian.export.fmu.variables import variables_of
from lagrangian.export.start import start_of
from lagrangian.model import Model

_log = logging.getLogger(__name__)

COMPILERS = ("cc", "gcc", "clang")
"""C compilers that accept these options, in the order in which they are tried."""

OPTIONS = ("-std=c99", "-O2", "-ffp-contract=off", "-shared", "-fPIC")

PATIENCE = 600
"""The time [s] after which a compiler is stopped."""

EPOCH = (1980, 1, 1, 0, 0, 0)
"""The date of all files in the archive, so that equal FMUs have equal bytes."""


def archive(model: Model, stem: str, standard: Standard) -> bytes:
    """The bytes of ``stem.fmu``.

    Raises `ModelError` for a parameter without a value, and `RunError` if the constraints cannot be satisfied.
    """
    variables, duration = variables_of(model), start_of(model).duration
    token = token_of(model, variables, standard)
    code = source(model, standard, token)
    describe = description2 if standard == 2 else description3
    files: dict[str, bytes] = {
        "modelDescription.xml": describe(model, variables, stem, token, duration).encode("utf-8"),
        f"sources/{stem}.c": code.encode("utf-8"),
    }
    if standard == 3:
        files["sources/buildDescription.xml"] = build_description(stem).encode("utf-8")
    binary = compiled(code, stem)
    if binary is not None:
        files[f"binaries/{binary_folder(standard)}/{stem}{suffix()}"] = binary
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as target:
        for name, content in files.items():
            info = zipfile.ZipInfo(name, EPOCH)
            info.compress_type, info.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
            target.writestr(info, content)
    return packed.getvalue()


def compiled(code: str, stem: str) -> bytes | None:
    """The source as a shared library for this machine; None without a compiler, or if it fails."""
    compiler = next((path for name in COMPILERS if (path := shutil.which(name))), None)
    if compiler is None:
        _log.info("no C compiler was found: the FMU contains its source alone")
        return None
    with tempfile.TemporaryDirectory(prefix="lagrangian-", ignore_cleanup_errors=True) as folder:
        file, library = Path(folder) / f"{stem}.c", Path(folder) / f"{stem}{suffix()}"
        file.write_text(code, encoding="utf-8")
        command = [compiler, *OPTIONS, "-o", str(library), str(file), "-lm"]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=False)
        except (OSError, subprocess.TimeoutExpired) as error:
            _log.warning("the C compiler could not be run: the FMU contains its source alone (%s)", error)
            return None
        if done.returncode:
            _log.warning("the C compiler failed: the FMU contains its source alone (%s)", done.stderr.strip()[:200])
            return None
        return library.read_bytes()


def suffix() -> str:
    """The ending of shared libraries on this machine."""
    return {"win32": ".dll", "darwin": ".dylib"}.get(sys.platform, ".so")


def binary_folder(standard: Standard) -> str:
    """The name of this machine in the standard."""
    arm = platform.machine().lower() in ("arm64", "aarch64")
    system = {"win32": "windows", "darwin": "darwin"}.get(sys.platform, "linux")
    if standard == 2 and not arm:
        return {"windows": "win64"}.get(system, f"{system}64")
    return f"{'aarch64' if arm else 'x86_64'}-{system}"
