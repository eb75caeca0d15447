//! The constants of the C interface that a caller passes by name.

use crate::law::{parameters, state};

/// Version of the binary interface. A program built against it runs with every later library of the same number.
pub const TORON_ABI_VERSION: i32 = 2;

/// Selects the hyperelastic yarn law in the functions for tables.
pub const TORON_HYPERELASTIC: i32 = 0;
/// Selects the linear elastic orthotropic law in these functions.
pub const TORON_LINEAR_ELASTIC: i32 = 1;

/// Number of properties and of state variables of the hyperelastic law.
pub const TORON_HYPERELASTIC_PROPERTIES: usize = 11;
pub const TORON_HYPERELASTIC_STATE: usize = 11;
/// Number of properties and of state variables of the linear elastic law.
pub const TORON_LINEAR_ELASTIC_PROPERTIES: usize = 10;
pub const TORON_LINEAR_ELASTIC_STATE: usize = 10;

/// Linear elastic law: the material frame follows the fibre.
pub const TORON_ROTATION_FIBRE: i32 = 0;
/// Linear elastic law: the material frame follows the rotation R of F = R U.
pub const TORON_ROTATION_POLAR: i32 = 1;
/// Linear elastic law: the material frame follows the spin (Jaumann rate).
pub const TORON_ROTATION_SPIN: i32 = 2;

/// Linear elastic law: failure by the largest principal stress.
pub const TORON_CRITERION_PRINCIPAL: i32 = 0;
/// Linear elastic law: failure by the stress along the fibre.
pub const TORON_CRITERION_FIBRE: i32 = 1;

/// Tangent dS/dE: derivative of the second Piola-Kirchhoff stress with respect to the Green-Lagrange strain, reference
/// axes; 6 x 6.
pub const TORON_TANGENT_MATERIAL: i32 = 0;
/// Tangent for the Truesdell rate of the Cauchy stress: dS/dE pushed forward and divided by J; 6 x 6.
pub const TORON_TANGENT_TRUESDELL: i32 = 1;
/// Tangent for the Jaumann rate of the Kirchhoff stress, divided by J (Abaqus's DDSDDE); 6 x 6.
pub const TORON_TANGENT_JAUMANN: i32 = 2;
/// Tangent dP/dF: derivative of the first Piola-Kirchhoff stress with respect to the deformation gradient, both in the
/// order 11 21 31 12 22 32 13 23 33; 9 x 9.
pub const TORON_TANGENT_NOMINAL: i32 = 3;

/// Instruction set for a block: the widest that the processor supports.
pub const TORON_LEVEL_BEST: i32 = 0;
/// Only instructions that every processor of the architecture has (SSE2 on x86-64).
pub const TORON_LEVEL_BASELINE: i32 = 1;
/// At most AVX2 with fused multiply-add.
pub const TORON_LEVEL_AVX2: i32 = 2;
/// At most AVX-512.
pub const TORON_LEVEL_AVX512: i32 = 3;

/// Room for any message, its terminating null included.
pub const TORON_MESSAGE_CAPACITY: usize = 512;

const _: () = {
    assert!(TORON_HYPERELASTIC_PROPERTIES == parameters::HYPERELASTIC_PROPERTIES);
    assert!(TORON_HYPERELASTIC_STATE == state::HYPERELASTIC_STATE);
    assert!(TORON_LINEAR_ELASTIC_PROPERTIES == parameters::LINEAR_ELASTIC_PROPERTIES);
    assert!(TORON_LINEAR_ELASTIC_STATE == state::LINEAR_ELASTIC_STATE);
};
