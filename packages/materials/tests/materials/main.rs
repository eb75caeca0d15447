//! Load paths, single points through every entry, and what a bench does beside its clock.

mod answers;
mod frictional;
mod load_paths;
mod newton;
mod parallel;
