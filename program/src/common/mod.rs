//! What the program's rooms share: numbers of chance, roots, the level of intervals, files for ParaView.

pub mod chance;
pub mod confidence;
pub mod root;
pub mod vtk;
