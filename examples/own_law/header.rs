//! The build script of the libraries: the header of the law in C.

fn main() -> std::io::Result<()> {
    println!("cargo::rerun-if-changed=../header.rs");
    toron_solvers::write_header::<reinforced_solid::ReinforcedSolid>("REINFORCED", "../reinforced.h")
}
