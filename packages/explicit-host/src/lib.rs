//! A small explicit host: bodies of hexahedra of one point, central differences, contact of the bodies with one another
//! and with what strikes them.
//!
//! It calls the laws as a solver does, through their C entries: blocks of component-major arrays, history in place,
//! deletion by the latch. The energies of its balance are those that the laws report, so that the balance tells whether
//! stress and energy belong together and whether the step is short enough. [`struck`] runs a scene on it, from the
//! first step to the last.

pub mod archive;
pub mod block;
pub mod body;
pub mod contact;
pub mod control_keys;
pub mod element;
pub mod energies;
pub mod friction;
pub mod global_estimate;
pub mod hexahedron;
pub mod instructions;
pub mod judgement;
pub mod kernels;
pub mod lanes;
pub mod medium;
pub mod mesh;
pub mod mutual_contact;
pub mod own;
pub mod rows;
pub mod shreds;
pub mod sliding;
pub mod snapshot;
pub mod solid;
pub mod solver;
pub mod step_limit;
pub mod stress;
pub mod striker;
pub mod struck;
pub mod tie;
pub mod vector;
pub mod viscosity;
pub mod vtk;
pub mod vtu;
pub mod wave_bounds;
