//! toron: the transversely isotropic hyperelastic law of a yarn, for dry fabrics under ballistic impact (P. del Sorbo,
//! ENSAM, 2019), the linear elastic law that it is compared with, and a yarn law whose fibres rub on each other.
//!
//! [`law`] is the laws themselves: from a deformation gradient to a stress; [`law::thesis`] states the yarn's in a
//! page. [`host`] is what solvers call: the C interface, Abaqus, LS-DYNA, CalculiX, OpenRadioss, MGIS. Neither needs a
//! standard library, allocates or panics. What is made of them are packages of their own: `toron-c-functions` is the C
//! interface, which `toron-c` exports as libtoron; `toron-solvers` makes the libraries that Abaqus, CalculiX, MGIS and
//! OpenRadioss load; `toron-program` is the program `toron`. `docs/architecture.md` has the picture of all of them.
//!
//! One point of a Kevlar KM2 yarn, in N, mm and MPa, pulled by 2 % and pressed to 80 % across:
//!
//! ```
//! use toron::{Hyperelastic, Properties, Request, state};
//!
//! let law = Hyperelastic::with(Properties {
//!     k_el: 82341.0,
//!     k_tc: 1055.0,
//!     p: 2.2,
//!     k_td: 649.74,
//!     k_ld: 0.0,
//!     eps_lim: 0.0458,
//!     alpha: 1.8,
//!     beta: 0.0,
//!     fibre: [1.0, 0.0, 0.0],
//! })?;
//!
//! // The deformation gradient by columns, and the state of a point that nothing has happened to.
//! let f = [[1.02, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.8]];
//! let fresh = [0.0; state::HYPERELASTIC_STATE];
//! let point = law.point_along(&f, None, &fresh, Request::ALL);
//!
//! assert_eq!(point.status, 0);
//! // Along the fibre: k_el ln λ/J.
//! assert!((point.stress[0] - 82341.0 * 1.02_f64.ln() / (1.02 * 0.8)).abs() < 1e-9);
//! assert!(point.state[state::FAILURE_INDEX] < 1.0);
//! # Ok::<(), toron::Error>(())
//! ```
//!
//! A crate that depends on this one does not take over its profile: without optimisation and with debug information the
//! kernels take several gigabytes to compile. In your workspace's `Cargo.toml`:
//!
//! ```toml
//! [profile.dev.package.toron]
//! opt-level = 1
//! debug = false
//! ```
//!
//! The laws take deformation gradients as columns, `[[T; 3]; 3]`, or as `nalgebra::Matrix3`, where a matrix says by its
//! type which index is the row; nalgebra is used for nothing else in the hot paths.
//!
//! The documents beside the README say the rest: `docs/reference/theory.md` the law as it is computed,
//! `docs/guides/hosts.md` how it goes into a solver, `docs/results/validation.md` how the numbers are checked,
//! `docs/guides/load-paths.md` what the program reads.

#![cfg_attr(not(test), no_std)]

pub mod host;
pub mod law;

pub use law::block::{Arrays, Block};
pub use law::error::{Error, Value};
pub use law::frictional::Frictional;
pub use law::hyperelastic::{Hyperelastic, Properties};
pub use law::linear_elastic::{Criterion, LinearElastic, LinearPoint, Rotation};
pub use law::linear_tangent::LinearTangent;
pub use law::number::level::Level;
pub use law::number::real::Real;
pub use law::parameters::{self, preset};
pub use law::response::{Point, Request};
pub use law::state;
pub use law::status;
pub use law::tangent::Measure;
pub use law::user;
pub use law::voigt::Moduli;
