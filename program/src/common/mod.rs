//! What the program's rooms share: units and their expressions, tables of measured data, cases over their scene, numbers of
//! chance, roots, the level of intervals, files for ParaView, and which build of the program this is.

pub mod build;
pub mod chance;
pub mod confidence;
pub mod data_table;
pub mod layers;
pub mod root;
pub mod unit_expression;
pub mod units;
pub mod vtk;
