//! The constants of the C interface by which a caller chooses something in a structure.

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
