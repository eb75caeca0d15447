//! What the number of this build is made of, for programs of laws of one's own.

use toron_build_number::{OF_MATERIALS, OF_STRIKES, set_sources};

fn main() {
    set_sources("../..", &[&OF_MATERIALS[..], &OF_STRIKES].concat());
}
