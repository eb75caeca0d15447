//! `toron fit`: the parameters of the hyperelastic law, and of Weibull's, from measured data, and how sure they are.

pub mod blow;
pub mod checks;
pub mod command;
pub mod data;
pub mod data_sheet;
pub mod equivalence;
pub mod file;
pub mod fit;
pub mod least_squares;
pub mod notes;
pub mod output;
pub mod parameter;
pub mod path_file;
pub mod path_response;
pub mod plot;
pub mod quantities;
pub mod ranges;
pub mod reader;
pub mod region;
pub mod report;
pub mod response;
pub mod sensitivity;
pub mod strength;
pub mod toe;
pub mod uncertainty;
pub mod written;
