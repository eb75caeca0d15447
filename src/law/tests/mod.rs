//! Tests of what the laws are made of; the laws themselves are tested from outside.

mod elementary;
mod failure;
