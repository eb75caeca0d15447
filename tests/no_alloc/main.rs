//! Nothing that a solver calls allocates: a binary of its own, since it counts in the allocator.

mod entries;
mod law;
