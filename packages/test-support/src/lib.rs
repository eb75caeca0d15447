//! What tests of several packages share; nothing but tests and benchmarks is built on it.
//!
//! - the library as a user builds it: [`library`], and in [`python`];
//! - committed files that are made: [`update`];
//! - with the feature `law`, for tests of the laws: `exact` numbers, the `truth` and the measure of an answer, random
//!   `deformations`, the `block` kernel with guards around every array.

#[cfg(feature = "law")]
pub mod block;
#[cfg(feature = "law")]
pub mod deformations;
#[cfg(feature = "law")]
pub mod exact;
pub mod library;
pub mod python;
#[cfg(feature = "law")]
pub mod truth;
pub mod update;
