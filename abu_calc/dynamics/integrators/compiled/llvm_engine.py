"""LLVM by llvmlite: from its text to machine code as bytes, from bytes to functions.

llvmlite is what numba stands on, with wheels for Linux, macOS and Windows; it is imported in a tenth of numba's time.
"""

import ctypes
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any

LEVEL = 2
"""Level of optimisation."""


class CompilerError(Exception):
    """There is no compiler here, or it does not do what it should: there are other ways."""


@contextmanager
def guarded(doing: str) -> Iterator[None]:
    """Raise CompilerError for whatever goes wrong in the library."""
    try:
        yield
    except Exception as error:
        reason = (str(error).splitlines() or [""])[0]
        raise CompilerError(f"{doing}: {type(error).__name__}: {reason}") from error


@cache
def _library() -> Any:
    """llvmlite's binding, ready for this machine; it knows the functions of C that the code calls."""
    import llvmlite.binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    library = ctypes.CDLL("ucrtbase" if sys.platform == "win32" else None)
    for name in ("sin", "cos", "pow"):
        llvm.add_symbol(name, ctypes.cast(getattr(library, name), ctypes.c_void_p).value)
    return llvm


@cache
def _features() -> str:
    """Features of this processor."""
    features: str = _library().get_host_cpu_features().flatten()
    return features


def _target() -> Any:
    """Target machine for this computer; each engine takes one of its own."""
    llvm = _library()
    return llvm.Target.from_triple(llvm.get_process_triple()).create_target_machine(
        cpu=llvm.get_host_cpu_name(),
        features=_features(),
        opt=LEVEL,
        reloc="static" if sys.platform == "win32" else "pic",
        codemodel="jitdefault",
    )


@cache
def described() -> str:
    """Description of all that machine code depends on besides its text. Raises CompilerError."""
    with guarded("llvmlite"):
        llvm = _library()
        name = llvm.get_host_cpu_name()
        return f"{llvm.llvm_version_info} {llvm.get_process_triple()} {name} {_features()} {LEVEL}"


def compiled(text: str) -> bytes:
    """Machine code for a module in LLVM's language. Raises CompilerError."""
    with guarded("compiling"):
        llvm, target = _library(), _target()
        module = llvm.parse_assembly(text)
        module.triple, module.data_layout = llvm.get_process_triple(), str(target.target_data)
        module.verify()
        options = llvm.create_pipeline_tuning_options(speed_level=LEVEL)
        options.loop_vectorization = options.loop_unrolling = False
        options.slp_vectorization = True  # of straight-line code; it changes no rounding
        builder = llvm.create_pass_builder(target, options)
        builder.getModulePassManager().run(module, builder)
        code: bytes = target.emit_object(module)
        return code


class LoadedModule:
    """A module in this process, in an engine of its own: two in one got each other's constants."""

    def __init__(self, code: bytes) -> None:
        with guarded("loading compiled code"):
            llvm = _library()
            self._engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), _target())
            self._engine.add_object_file(llvm.ObjectFileRef.from_data(code))
            self._engine.finalize_object()

    def address(self, name: str) -> int:
        """Address of a function. Raises CompilerError."""
        with guarded("loading compiled code"):
            pointer: int = self._engine.get_function_address(name)
        if not pointer:
            raise CompilerError(f"compiled code has no {name}")
        return pointer

    def function(self, name: str, pointers: int) -> Callable[..., int]:
        """One that takes so many arrays, by their places, and gives a whole number."""
        return ctypes.CFUNCTYPE(ctypes.c_int64, *[ctypes.c_void_p] * pointers)(self.address(name))

    def rates(self, name: str, pointers: int) -> Callable[..., None]:
        """One that takes a moment and so many arrays."""
        return ctypes.CFUNCTYPE(None, ctypes.c_double, *[ctypes.c_void_p] * pointers)(self.address(name))
