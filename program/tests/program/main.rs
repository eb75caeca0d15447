//! The program, the load paths and the yarn under impact; CalculiX, whose answers are held against load paths.

#[path = "../../../tests/common/mod.rs"]
mod common;
#[path = "../../../tests/common/library.rs"]
mod library;

mod calculix;
mod calculix_decks;
mod command_line;
mod documents;
mod eval;
mod examples;
mod hexahedra;
mod impact;
mod load_paths;
mod newton;
mod parallel;
mod yarn_between_plates;
