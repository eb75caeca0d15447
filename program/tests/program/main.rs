//! The program and the yarn under impact; CalculiX and Akantu, whose answers are held against them.

mod akantu;
mod blow;
mod build;
mod calculix;
#[allow(dead_code)] // each test uses its own part
mod calculix_decks;
mod cell;
mod check;
mod command_line;
mod compare;
mod directories;
mod documents;
mod eval;
mod examples;
mod fabric;
mod fabric_files;
mod fibres;
mod fit;
#[allow(dead_code)]
mod hexahedra;
mod impact;
mod interface;
mod licences;
mod long;
mod meshes;
mod one_element;
mod params;
mod scene_decks;
mod shots;
mod sliding;
mod v50;
mod weave;
mod yarn_between_plates;
