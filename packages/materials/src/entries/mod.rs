//! The C entries as their hosts call them, behind safe functions. The program's unsafe code is here.

pub mod aligned;
pub mod blocks;
pub mod hosts;
pub mod own_block;
pub mod precision;
pub mod step;
