//! Keyword files of solvers as tokens: keywords with their parameters, lines of data, and the files that they include,
//! each with file and line. Abaqus inputs ([`abaqus`]) and LS-DYNA decks ([`ls_dyna`]). What a keyword means is its
//! reader's business.

pub mod abaqus;
pub mod files;
pub mod line;
pub mod ls_dyna;
#[cfg(test)]
mod tests;
