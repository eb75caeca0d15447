#[cfg(feature = "driver")]
pub mod driver;
pub mod host;
pub mod law;
