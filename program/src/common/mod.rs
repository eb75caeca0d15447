//! What all commands share: errors and their exit codes, the console, progress bars, units, short numbers, names of
//! files, files in TOML, keyword files of solvers, tables of measured data, numbers of chance, roots, the level of
//! intervals.

pub mod bound_child;
pub mod build;
pub mod chance;
pub mod confidence;
pub mod console;
pub mod data_table;
pub mod error;
pub mod file_names;
pub mod folder;
pub mod interrupt;
pub mod kept_file;
pub mod keyword_file;
pub mod nearest;
pub mod progress;
pub mod root;
pub mod run_directory;
pub mod shell;
pub mod short_number;
pub mod text_table;
pub mod toml_error;
pub mod toml_file;
pub mod unit_expression;
pub mod units;
pub mod vtk;
