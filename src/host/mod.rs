//! The interfaces to host programs, one file for each; it begins with the host's order of arguments and components.

pub mod abaqus;
mod border;
pub mod c;
pub mod calculix;
pub mod environment;
pub mod lsdyna;
pub mod mgis;
pub mod openradioss;
mod structures;
pub mod units;
