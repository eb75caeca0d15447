pub mod eval;
pub mod polar;
