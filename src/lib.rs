//! toron: the transversely isotropic hyperelastic law of a yarn, for dry fabrics under ballistic impact (P. del Sorbo,
//! ENSAM, 2019), and the linear elastic law that it is compared with.
//!
//! [`law`] is the laws themselves: from a deformation gradient to a stress, without a standard library, an allocation or a
//! panic. [`host`] is how solvers call them: the C ABI, Abaqus, LS-DYNA. `driver` (feature `driver`, on by default) is what
//! the program `toron` does: load paths on one element, tables, plots and decks.
//!
//! One point of a Kevlar KM2 yarn, in N, mm and MPa, pulled by 2 % and pressed to 80 % across:
//!
//! ```
//! use nalgebra::Matrix3;
//! use toron::host::units::UnitSystem;
//! use toron::law::hyperelastic::{Hyperelastic, Request};
//! use toron::law::parameters;
//! use toron::law::state::{FAILURE_INDEX, HYPERELASTIC_STATE};
//!
//! let units = UnitSystem::parse("mm-tonne-s").expect("three known units");
//! let km2 = parameters::preset("kevlar-km2-600").expect("a known yarn");
//! let pairs = km2.table.iter().zip(km2.values);
//! let properties: Vec<f64> = pairs.map(|(property, &si)| units.from_si(si, property.dimension)).collect();
//! let law = Hyperelastic::<f64>::new(&properties)?;
//!
//! let f = Matrix3::from_diagonal(&[1.02, 1.0, 0.8].into());
//! let point = law.point(&f, &[0.0; HYPERELASTIC_STATE], Request::ALL);
//! assert_eq!(point.status, 0);
//! // Along the fibre: k_el ln λ/J.
//! assert!((point.stress[0] - 82341.0 * 1.02f64.ln() / (1.02 * 0.8)).abs() < 1e-9);
//! assert!(point.state[FAILURE_INDEX] < 1.0);
//! # Ok::<(), toron::law::status::Error>(())
//! ```
//!
//! The documents beside the README say the rest: `docs/theory.md` the law as it is computed, `docs/hosts.md` how it goes
//! into a solver, `docs/validation.md` how the numbers are checked, `docs/load-paths.md` what the program reads.

#![cfg_attr(not(test), no_std)]

pub mod host;
pub mod law;
