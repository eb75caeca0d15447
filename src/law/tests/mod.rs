//! Unit tests of what the laws are built from; the laws themselves are tested in `tests/law`.

mod elementary;
mod failure;
