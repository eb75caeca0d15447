//! libtoron.so and libtoron.a: the functions of package `toron-c-functions`, with the standard library's panic handler.
//!
//! A package of its own: a library of Rust beside these two would take the file name of the crate `toron`'s, and
//! whatever is built on the functions would link the two as well.

extern crate toron_c;
