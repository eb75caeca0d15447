"""The shared library that comes with the package, and what the modules here need to call it."""

import threading
from pathlib import Path
from typing import Any

from toron._interface import ffi

PATH = Path(__file__).with_name("libtoron.so")
lib: Any = ffi.dlopen(str(PATH))

CAPACITY: int = lib.TORON_MESSAGE_CAPACITY

if lib.toron_abi_version() != lib.TORON_ABI_VERSION:
    raise ImportError(f"{PATH} has interface {lib.toron_abi_version()}; the package was built for {lib.TORON_ABI_VERSION}")


class _Buffers(threading.local):
    """A buffer for messages in every thread: calls run side by side."""

    def __init__(self) -> None:
        self.message = ffi.new("char[]", CAPACITY)


buffers = _Buffers()


def text(characters: Any) -> str:
    """A null-terminated array of the library as a text."""
    # A message that is cut off may end within a character.
    return ffi.string(characters).decode(errors="replace")


def structure(name: str) -> Any:
    """A structure of this name with its size set and everything else left out."""
    made = ffi.new(f"{name} *")
    made.size = ffi.sizeof(made[0])
    return made


def constants(prefix: str) -> dict[str, int]:
    """The constants of the header that begin with `prefix`, by the rest of their names in small letters."""
    return {name.removeprefix(prefix).lower(): getattr(lib, name) for name in dir(lib) if name.startswith(prefix)}
