"""The machine: its capabilities, compiling IR text to object code, and loading object code.

llvmlite contains LLVM; nothing else is needed on the user's machine.
"""

from __future__ import annotations

import ctypes
import os
import threading
from functools import cache

from lagrangian.errors import MissingExtra, RunError

try:
    import llvmlite
    import llvmlite.binding as llvm
except ImportError:
    raise MissingExtra(
        "machine code is made by the package 'llvmlite', which is not installed",
        fix="pip install llvmlite; derivations and exported source code need no machine code",
        code="E801",
    ) from None

from .elementary import LIBM
from .ir import BIND, Target

_lock = threading.RLock()  # LLVM's global state (targets, engines) must be set up by one thread at a time


OLD = tuple(int(part) for part in llvmlite.__version__.split(".")[:2]) < (0, 45)  # LLVM 15


@cache
def _ready() -> None:
    """Initialize LLVM for this machine."""
    if OLD:  # later versions initialize themselves, and raise an error here
        llvm.initialize()
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()


@cache
def host() -> Target:
    """The name of this machine, its features, and its widest vector of doubles."""
    with _lock:
        _ready()
        features = llvm.get_host_cpu_features()
        # Even on Windows, LLVM loads ELF objects into memory.
        triple = llvm.get_process_triple() + ("-elf" if os.name == "nt" else "")
        flags = features.flatten()
    arm = triple.startswith(("aarch64", "arm64"))
    lanes = 8 if features.get("avx512f") and features.get("avx512dq") else 4 if features.get("avx2") else 2
    # The features are those of the host, but the instruction scheduler uses the common model of the generation: in
    # tests, this code was as fast as with the processor's own model, was compiled in a quarter less time, and LLVM
    # knows the common model even if it does not yet know the processor.
    cpu = {8: "x86-64-v4", 4: "x86-64-v3", 2: "x86-64"}[lanes] if triple.startswith("x86_64") else ""
    return Target(triple, cpu, flags, bool(arm or features.get("fma")), lanes, llvm.llvm_version_info[0] >= 19)


def machine(target: Target, level: int) -> llvm.TargetMachine:
    """LLVM's code generator for ``target`` at optimization level 0–3."""
    with _lock:
        _ready()
        if target.imports:
            return _foreign(target, level)
        # Position-independent small code: constants are addressed relative to the instruction pointer. The memory
        # manager requested in `load` keeps all sections of an object within reach.
        return llvm.Target.from_triple(target.triple).create_target_machine(
            cpu=target.cpu, features=target.features, opt=level, reloc="pic", codemodel="small", jit=True
        )


def _foreign(target: Target, level: int) -> llvm.TargetMachine:
    """LLVM's code generator for another machine, whose object code is linked into a file."""
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    try:
        found = llvm.Target.from_triple(target.triple)
    except RuntimeError:
        raise RunError(
            f"this build of llvmlite cannot make code for {target.triple}",
            fix="install llvmlite from PyPI or conda-forge, or export to JavaScript",
            code="E801",
        ) from None
    return found.create_target_machine(
        cpu=target.cpu, features=target.features, opt=level, reloc="static", codemodel="default", jit=False
    )


def _context() -> llvm.ContextRef:
    """A separate context, so that other users of LLVM in this process, and their kind of pointers, do not interfere."""
    if OLD:  # opaque pointers must be requested
        return llvm.context.ContextRef(llvm.ffi.lib.LLVMPY_ContextCreate(True))
    return llvm.create_context()


@cache
def _lasting_context() -> llvm.ContextRef:
    """The context of the empty modules around which engines are built; it must outlive all of them."""
    return _context()


def object_code(text: str, target: Target, level: int) -> bytes:
    """Compile IR text. The text is our own, so LLVM's RuntimeError for invalid text is a bug here and is not caught."""
    with _lock:
        _ready()
        context = _context()
        module = llvm.parse_assembly(text, context)
        try:
            return machine(target, level).emit_object(module)
        finally:
            module.close()  # before its context
            context.close()


class Loaded:
    """Object code in memory, which exists as long as this object."""

    def __init__(self, code: bytes, target: Target) -> None:
        with _lock:
            _ready()
            shell = llvm.parse_assembly(f'target triple = "{target.triple}"', _lasting_context())
            self._engine = llvm.create_mcjit_compiler(shell, machine(target, 1), use_lmm=True)
            self._engine.add_object_file(llvm.ObjectFileRef.from_data(code))
            self._engine.finalize_object()
        bind = ctypes.CFUNCTYPE(None, ctypes.c_void_p)(self.address(BIND))
        bind(libm_table())

    def address(self, name: str) -> int:
        """The address of the function ``name``."""
        with _lock:
            found = self._engine.get_function_address(name)
        if not found:
            raise KeyError(name)
        return found


_tables: list[ctypes.Array[ctypes.c_void_p]] = []  # compiled code refers to it, so it lives as long as the process


@cache
def libm_table() -> int:
    """The address of the table of C functions, in the order of :data:`~lagrangian.codegen.elementary.LIBM`."""
    library = _c_library()
    table = (ctypes.c_void_p * len(LIBM))()
    for k, name in enumerate(LIBM):
        table[k] = ctypes.cast(getattr(library, name), ctypes.c_void_p).value
    _tables.append(table)
    return ctypes.addressof(table)


def _c_library() -> ctypes.CDLL:
    """The mathematical functions of the C library."""
    names = ["ucrtbase", "msvcrt"] if os.name == "nt" else [None, "libm.so.6"]
    for name in names:
        try:
            library = ctypes.CDLL(name)
            library.asinh  # noqa: B018  (asks whether it is there)
        except (OSError, AttributeError):
            continue
        return library
    raise RunError("the C mathematical library was not found", fix="install the system's C library (libm)")
