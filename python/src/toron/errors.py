"""Exceptions. Their text is the library's: it names the argument, its value and what is allowed."""

from operator import index as integer
from typing import Any

import numpy as np
from numpy.typing import NDArray

from toron._library import CAPACITY, buffers, lib, text

#: Codes from here on say that points could not be evaluated, while the call as such was right.
_OF_POINTS = -300
_OF_PROPERTIES = -200
#: Characters of a value in a message.
_LONGEST = 60


class Error(Exception):
    """What all exceptions of this package are. `code` is the status code of the library, `TORON_...` in toron.h."""

    def __init__(self, message: str, code: int) -> None:
        # A name with half a character, of which Python makes texts, could not be printed.
        super().__init__(message.encode(errors="backslashreplace").decode())
        self.code = code

    def __reduce__(self) -> Any:
        return type(self), (str(self), self.code)


class ArgumentError(Error, ValueError):
    """An argument of a call is wrong: a name, an option, the shape of an array. Nothing has been written."""


class AssignmentError(ArgumentError, AttributeError):
    """An attribute of what does not change has been set."""


class PropertyError(Error, ValueError):
    """A property of a law is missing or outside its bounds."""


class PointError(Error, ArithmeticError):
    """Points could not be evaluated: an inverted element, NaN, a deformation too large for the number format.

    Such points carry no stress and keep their state; all others have been evaluated and written as usual. `code` is the worst
    code, `status` the codes of all points (int32, in the shape of the points).
    """

    def __init__(self, message: str, code: int, status: NDArray[np.int32]) -> None:
        super().__init__(message, code)
        self.status = status

    def __reduce__(self) -> Any:
        return type(self), (str(self), self.code, self.status)


def shown(value: Any) -> str:
    """A value in a message, cut where it is long."""
    try:
        text = repr(value)
    except Exception:  # That of a foreign object, or of an integer with more digits than Python prints.
        text = f"a {type(value).__name__}"
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}…"


def is_of_points(code: int) -> bool:
    """Whether a status code says that points could not be evaluated, while the call as such was right."""
    return code <= _OF_POINTS


def raise_for(code: int) -> int:
    """Returns the status or count of a call, unless it is an error of the call, whose text the buffer of this thread holds."""
    if code >= 0:
        return code
    kind = PropertyError if code <= _OF_PROPERTIES else ArgumentError
    raise kind(text(buffers.message), code)


def raise_for_point(code: int) -> None:
    """Raises for the status of a function that evaluates one point, whose text the buffer of this thread holds."""
    if is_of_points(code):
        raise PointError(text(buffers.message), code, np.array(code, np.int32))
    raise_for(code)


def status_message(code: int) -> str:
    """The meaning of a status code as a sentence, for example of an entry of a status array.

    Raises `ArgumentError` if there is no such code.
    """
    try:
        known = lib.toron_status_message(integer(code), buffers.message, CAPACITY)
    except (OverflowError, TypeError):
        raise ArgumentError(f"status code {shown(code)} is unknown; allowed: codes of toron.h", lib.TORON_UNKNOWN_NAME) from None
    raise_for(known)
    return text(buffers.message)


