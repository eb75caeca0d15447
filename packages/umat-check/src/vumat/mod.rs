//! The same questions to a VUMAT, called as Abaqus/Explicit calls it: blocks of points, stress on corotational axes, no
//! tangent.
//!
//! [`call`] is the subroutine, [`point`] the material points that are driven. The questions: [`frame`] (objectivity,
//! isotropy, steps), [`blocks`] (sizes, order, repetition, threads), [`energy`], [`single`], [`deletion`], [`process`];
//! [`child`] asks them.

pub mod blocks;
pub mod call;
pub mod child;
pub mod deletion;
pub mod energy;
pub mod frame;
pub mod point;
pub mod process;
pub mod single;
