//! The laws against exact arithmetic, derivatives, invariances and each other, as Rust calls them.

mod block;
mod frictional;
mod layouts;
mod limits;
mod linear_block;
mod linear_elastic;
mod parameters;
mod properties;
mod tangent;
mod tensor;
mod user;
mod wave_speed;
