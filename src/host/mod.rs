//! The world's conventions meet the law here: one file a host, each opening with its order of arguments and components.

pub mod abaqus;
mod border;
pub mod c;
pub mod calculix;
pub mod environment;
pub mod lsdyna;
pub mod units;
