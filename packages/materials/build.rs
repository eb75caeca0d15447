//! What the number of this build is made of, for programs of laws of one's own.

fn main() {
    toron_build_number::set_sources("../..", &toron_build_number::OF_MATERIALS);
}
