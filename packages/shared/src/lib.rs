//! What all programs share; no law, no host and no unit is known here.
//!
//! - what a user is told: [`error`] with its exit codes, [`console`], [`progress`], [`text_table`], [`numbers`],
//!   [`short_number`], [`nearest`] names;
//! - arguments and the end of a program: [`command_line`];
//! - files in TOML, with the places of what stands in them: [`toml_file`], [`toml_error`], tables over others in
//!   [`layers`], a struct's [`field_names`], [`checked`] values, [`spanned`] ones, their `schema`; keyword files of
//!   solvers: [`keyword_file`];
//! - where a program writes: [`run_directory`], [`kept_file`], [`file_names`], [`folder`];
//! - which program it is: the [`mod@build`]; how long it has computed: [`processor_time`]; what runs beside it:
//!   [`interrupt`], [`bound_child`], the [`shell`]'s words.

pub mod bound_child;
pub mod build;
pub mod checked;
pub mod command_line;
pub mod console;
pub mod error;
pub mod field_names;
pub mod file_names;
pub mod folder;
pub mod interrupt;
pub mod kept_file;
pub mod keyword_file;
pub mod layers;
pub mod nearest;
pub mod numbers;
pub mod processor_time;
pub mod progress;
pub mod run_directory;
#[cfg(feature = "schema")]
pub mod schema;
pub mod shell;
pub mod short_number;
pub mod spanned;
pub mod text_table;
pub mod toml_error;
pub mod toml_file;
mod toml_value;
