//! Which build of a program this is: runs of another one may have other bits, and files that this one cannot read.

use std::any::TypeId;
use std::sync::OnceLock;

static NUMBER: OnceLock<u32> = OnceLock::new();

/// Says which build this is, at the beginning of a program; the first one counts. `P` is a type of the program's
/// package: Cargo and the compiler make its number of the package, the versions and features of all packages that it is
/// built on, profile, target and compiler, and of no folder. `sources` is the checksum of what it is made of.
pub fn declare<P: 'static>(sources: &str) {
    let package = TypeId::of::<P>();
    NUMBER.get_or_init(|| crc32fast::hash(format!("{package:?} {sources}").as_bytes()));
}

/// Tells builds of other sources, packages, compilers, profiles, targets or options apart. Two builds of the same have
/// the same, wherever they were made and however they were installed. It is 0 where no program has begun, as in tests
/// of a library.
pub fn number() -> u32 {
    NUMBER.get().copied().unwrap_or_default()
}
