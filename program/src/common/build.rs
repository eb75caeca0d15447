//! Which build of the program this is: runs of another one may have other bits, and files that this one cannot read.

use std::any::TypeId;
use std::sync::LazyLock;

/// A type of this package's: Cargo and the compiler make its number of the package, the versions and features of all
/// packages that it is built on, profile, target and compiler, and of no folder.
struct Package;

static NUMBER: LazyLock<u32> = LazyLock::new(|| {
    let (package, sources) = (TypeId::of::<Package>(), env!("TORON_SOURCES"));
    crc32fast::hash(format!("{package:?} {sources}").as_bytes())
});

/// Tells builds of other sources, packages, compilers, profiles, targets or options apart. Two builds of the same have
/// the same, wherever they were made and however they were installed.
pub fn number() -> u32 {
    *NUMBER
}
