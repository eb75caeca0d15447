//! What is wrong with a UMAT, one's own or anybody's: the program `umat-check`, and `toron check`.
//!
//! The file becomes a library ([`compile`]) that a child process loads and calls as Abaqus/Standard does ([`child`],
//! [`call`], [`point`]). `answer_question` in [`child`] lists which module answers which question, such as [`tangent`]
//! (with [`differences`], [`judgement`], [`hypotheses`], [`mistakes`]), [`objectivity`], [`energy`] and [`process`].
//! Answers are lines ([`finding`]) of a [`report`]. [`vumat`] has what differs in Abaqus/Explicit.

#![cfg(target_os = "linux")]

pub mod again;
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
pub mod expect_keys;
pub mod finding;
pub mod guarded;
pub mod histories;
pub mod hypotheses;
pub mod inp;
pub mod input;
pub mod job;
pub mod judgement;
pub mod jumps;
pub mod kept_properties;
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
pub mod report;
pub mod rest;
pub mod shared_memory;
pub mod sources;
pub mod steps;
pub mod stress;
pub mod tangent;
pub mod thermal;
pub mod unset;
pub mod vumat;
pub mod work_dir;
pub mod wrapper;
