pub mod host;
pub mod law;
