//! Files that are made from the sources and committed. A test holds each against what is made today; `cargo xtask
//! update KIND` runs the tests of a kind with `TORON_UPDATE=KIND`, and they write theirs anew.

/// Whether files of this kind are to be written anew.
pub fn is_asked(kind: &str) -> bool {
    std::env::var_os("TORON_UPDATE").is_some_and(|asked| asked == kind)
}
