//! The numbers that a caller passes by name.

use crate::law::{parameters, state};

/// Number of the interface. It changes when a caller compiled against an older header could no longer run.
pub const TORON_ABI_VERSION: i32 = 1;

/// The hyperelastic yarn law, where a table or a preset is asked for.
pub const TORON_HYPERELASTIC: i32 = 0;
/// The linear elastic orthotropic law.
pub const TORON_LINEAR_ELASTIC: i32 = 1;

/// Number of properties and of state variables of the hyperelastic law.
pub const TORON_HYPERELASTIC_PROPERTIES: usize = 11;
pub const TORON_HYPERELASTIC_STATE: usize = 11;
/// Number of properties and of state variables of the linear elastic law.
pub const TORON_LINEAR_ELASTIC_PROPERTIES: usize = 10;
pub const TORON_LINEAR_ELASTIC_STATE: usize = 10;

/// The frame of the linear elastic law follows the fibre.
pub const TORON_ROTATION_FIBRE: i32 = 0;
/// It follows the polar rotation of F.
pub const TORON_ROTATION_POLAR: i32 = 1;
/// It follows the spin.
pub const TORON_ROTATION_SPIN: i32 = 2;

/// The linear elastic law fails by its largest principal stress.
pub const TORON_CRITERION_PRINCIPAL: i32 = 0;
/// It fails by the stress along the fibre.
pub const TORON_CRITERION_FIBRE: i32 = 1;

/// Tangent: dS/dE, second Piola-Kirchhoff stress by Green-Lagrange strain, reference axes; 6 x 6.
pub const TORON_TANGENT_MATERIAL: i32 = 0;
/// The Truesdell modulus of the Cauchy stress: dS/dE pushed forward, over J; 6 x 6.
pub const TORON_TANGENT_TRUESDELL: i32 = 1;
/// The modulus of the Jaumann rate of the Kirchhoff stress, over J; 6 x 6.
pub const TORON_TANGENT_JAUMANN: i32 = 2;
/// dP/dF, first Piola-Kirchhoff stress by deformation gradient, both 11 21 31 12 22 32 13 23 33; 9 x 9.
pub const TORON_TANGENT_NOMINAL: i32 = 3;

/// Instructions of a block: the best that the processor has.
pub const TORON_LEVEL_BEST: i32 = 0;
/// None that only some processors of the architecture have.
pub const TORON_LEVEL_BASELINE: i32 = 1;
/// At most AVX2 with fused multiply-add.
pub const TORON_LEVEL_AVX2: i32 = 2;
/// At most AVX-512.
pub const TORON_LEVEL_AVX512: i32 = 3;

const _: () = {
    assert!(TORON_HYPERELASTIC_PROPERTIES == parameters::HYPERELASTIC_PROPERTIES);
    assert!(TORON_HYPERELASTIC_STATE == state::HYPERELASTIC_STATE);
    assert!(TORON_LINEAR_ELASTIC_PROPERTIES == parameters::LINEAR_ELASTIC_PROPERTIES);
    assert!(TORON_LINEAR_ELASTIC_STATE == state::LINEAR_ELASTIC_STATE);
};
