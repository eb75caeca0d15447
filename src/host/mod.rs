//! The world's conventions meet the law here: one file a host, each opening with its order of arguments and components.

pub mod abaqus;
pub mod c_api;
pub mod calculix;
#[cfg(feature = "driver")]
pub mod calls;
pub mod environment;
pub mod lsdyna;
pub mod units;
