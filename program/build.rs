//! What the number of this build is made of.

use toron_build_number::{OF_MATERIALS, OF_PROGRAM, set_sources};

fn main() {
    set_sources("..", &[&OF_MATERIALS[..], &OF_PROGRAM].concat());
}
