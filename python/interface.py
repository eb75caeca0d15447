"""Makes the module `_interface` from the C header: the structures, functions and constants as cffi reads them."""

import re
from pathlib import Path

import cffi


def declarations(header: str) -> str:
    """The header without what only a C compiler needs: guards, includes and the `extern "C"` of C++."""
    header = re.sub(r"#ifdef __cplusplus\n.*?\n#endif[^\n]*\n", "", header, flags=re.DOTALL)
    return re.sub(r"^#(include .*|ifndef .*|endif.*|define \w+)$", "", header, flags=re.MULTILINE)


def write(header: Path, module: Path) -> None:
    """Writes the Python source of the module."""
    ffi = cffi.FFI()
    ffi.cdef(declarations(header.read_text(encoding="utf-8")))
    ffi.set_source("toron._interface", None)
    ffi.emit_python_code(str(module))
