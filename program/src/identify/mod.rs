//! `toron fit`: the parameters of the hyperelastic law from measured data, and how sure they are.

pub mod data;
pub mod fit;
pub mod least_squares;
pub mod parameter;
pub mod path_response;
pub mod response;
pub mod uncertainty;
