//! MGIS, MTest and whatever else loads the libraries that MFront generates: behaviours of the generic interface.
//!
//! | | |
//! |---|---|
//! | library | `libtoron_mgis.so` with the behaviours `ToronHyperelastic`, `ToronLinearElastic` and `ToronFrictional`; any other law has its own name |
//! | hypotheses | `Tridimensional`; `PlaneStrain` and `Axisymmetrical`, whose fibre lies in the plane or normal to it |
//! | gradients | F at both ends of the step: 11 22 33 12 21 13 31 23 32; in the plane 11 22 33 12 21 |
//! | stress | K\[1\]: 0 Cauchy σ, 1 second Piola–Kirchhoff S: 11 22 33 √2·12 √2·13 √2·23; 2 first Piola–Kirchhoff P, ordered as F |
//! | tangent | K\[2\]: 0 dσ/dF 6×9, 1 dS/dE 6×6, 2 dP/dF 9×9, 3 dτ/dΔF 6×9 with F1 = ΔF F0; by rows, in these orders, √2 on both sides |
//! | request | K\[0\]: 0 none, 1 to 4 the consistent tangent, −1 to −3 that at the start of the step alone; 100 more: the speed of sound |
//! | properties | all of the law's table, by name; those of the end of the step |
//! | internal state variables | all of the law's table, scalars |
//! | stored energy | per reference volume, the sum of the law's energies; for the linear elastic law the work; dissipated energy: what a law has lost |
//! | failure | stress and tangent 0, `failed` 1, `alive` 0, the energies kept |
//! | F inverted, not finite, … | −1 and a message, nothing written, rdt ≤ ¼ |
//!
//! Everything is global: the behaviours are isotropic to MGIS, and the fibre direction is one of their properties. The
//! elastic, the secant and the tangent operator are the same: the derivative of the stress that is returned.
//! Temperature and time step are not read. The linear elastic law has axes that follow the fibre, and fails by its
//! largest principal stress.

mod hyperelastic;
mod operator;
mod results;
mod step;
pub mod symbols;
mod view;

pub use hyperelastic::{hyperelastic, hyperelastic_in_plane};
pub use step::{MgisLaw, linear_elastic, linear_elastic_in_plane};
pub use view::{BehaviourDataView, StateView};

/// What an entry returns: the point is integrated, or it is not and there is a message.
pub const INTEGRATED: i32 = 1;
pub const NOT_INTEGRATED: i32 = -1;

/// The size of the buffer that MGIS and MTest give for a message, with the terminating null.
pub const MESSAGE_CAPACITY: usize = 512;
