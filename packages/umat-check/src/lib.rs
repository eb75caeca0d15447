//! What is wrong with a UMAT, one's own or anybody's: the program `umat-check`, and `toron check`.
//!
//! The file becomes a library ([`compile`]) that a child process loads and calls as Abaqus/Standard does ([`child`],
//! [`call`], [`point`]). One question a module: [`tangent`] (with [`differences`], [`judgement`], [`hypotheses`],
//! [`mistakes`]), [`objectivity`], [`steps`], [`energy`], [`rest`], [`process`]. Answers are lines ([`finding`]) of a
//! [`report`]. [`vumat`] has what differs in Abaqus/Explicit.

#![cfg(target_os = "linux")]

pub mod arguments;
pub mod call;
pub mod child;
pub mod ci;
pub mod command;
pub mod compile;
pub mod compiler;
pub mod coverage;
pub mod diagnose;
pub mod differences;
pub mod driver;
pub mod energy;
pub mod expect;
pub mod finding;
pub mod given;
pub mod guarded;
pub mod histories;
pub mod hypotheses;
pub mod inp;
pub mod input;
pub mod job;
pub mod judgement;
pub mod jumps;
pub mod kept;
pub mod kinematics;
pub mod map;
pub mod material;
pub mod mistakes;
pub mod noise;
pub mod objectivity;
pub mod place;
pub mod point;
pub mod process;
pub mod properties;
pub mod relate;
pub mod repeated;
pub mod report;
pub mod rest;
pub mod shared;
pub mod sources;
pub mod steps;
pub mod stress;
pub mod tangent;
pub mod thermal;
pub mod unset;
pub mod vumat;
pub mod work_dir;
pub mod wrapper;
