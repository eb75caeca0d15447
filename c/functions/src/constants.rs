//! The constants of the library as a whole: its interface's version, its laws and the sizes of their tables. Those
//! that a structure holds are in `toron::host::constants`.

use toron::law::{parameters, state};

/// Version of the binary interface. A program built against it runs with every later library of the same number.
pub const TORON_ABI_VERSION: i32 = 2;

/// Selects the hyperelastic yarn law in the functions for tables.
pub const TORON_HYPERELASTIC: i32 = 0;
/// Selects the linear elastic orthotropic law in these functions.
pub const TORON_LINEAR_ELASTIC: i32 = 1;
/// Selects the yarn law with friction in these functions.
pub const TORON_FRICTIONAL: i32 = 2;

/// Number of properties and of state variables of the hyperelastic law.
pub const TORON_HYPERELASTIC_PROPERTIES: usize = 11;
pub const TORON_HYPERELASTIC_STATE: usize = 11;
/// Number of properties and of state variables of the linear elastic law.
pub const TORON_LINEAR_ELASTIC_PROPERTIES: usize = 10;
pub const TORON_LINEAR_ELASTIC_STATE: usize = 10;
/// Number of properties and of state variables of the law with friction.
pub const TORON_FRICTIONAL_PROPERTIES: usize = 13;
pub const TORON_FRICTIONAL_STATE: usize = 15;

const _: () = {
    assert!(TORON_HYPERELASTIC_PROPERTIES == parameters::HYPERELASTIC_PROPERTIES);
    assert!(TORON_HYPERELASTIC_STATE == state::HYPERELASTIC_STATE);
    assert!(TORON_LINEAR_ELASTIC_PROPERTIES == parameters::LINEAR_ELASTIC_PROPERTIES);
    assert!(TORON_LINEAR_ELASTIC_STATE == state::LINEAR_ELASTIC_STATE);
    assert!(TORON_FRICTIONAL_PROPERTIES == parameters::FRICTIONAL_PROPERTIES);
    assert!(TORON_FRICTIONAL_STATE == state::FRICTIONAL_STATE);
};
