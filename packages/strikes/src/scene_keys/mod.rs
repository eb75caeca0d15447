//! The keys that struck scenes have in common. [`impact`](crate::impact) strikes a yarn, [`fabric`](crate::fabric) a
//! panel.

pub mod keys;
pub mod shots;
pub mod zones;
