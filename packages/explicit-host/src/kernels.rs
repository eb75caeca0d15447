//! What takes the time of a run, with an impl for each number and not a generic one: the loops over elements are
//! compiled in this package, and not again in each package that runs a solver.

use super::body::Body;
use super::medium::Medium;
use super::solver::Solver;
use toron_shared::error::Error;

/// The functions of solvers and bodies of one number.
pub trait Kernels: Sized {
    /// [`Solver::accelerate`].
    ///
    /// # Errors
    /// As there.
    fn accelerate(solver: &mut Solver<Self>, measured: bool, left: f64) -> Result<(), Error>;

    /// [`Solver::displace`].
    fn displace(solver: &mut Solver<Self>);

    /// [`Body::stress`].
    ///
    /// # Errors
    /// As there.
    fn stress(body: &Body<Self>, media: &[Medium<Self>]) -> Result<Vec<[f64; 6]>, i32>;
}

impl Kernels for f64 {
    fn accelerate(solver: &mut Solver<f64>, measured: bool, left: f64) -> Result<(), Error> {
        solver.compute_accelerations(measured, left)
    }

    fn displace(solver: &mut Solver<f64>) {
        solver.update_displacements();
    }

    fn stress(body: &Body<f64>, media: &[Medium<f64>]) -> Result<Vec<[f64; 6]>, i32> {
        body.evaluate_stress(media)
    }
}

impl Kernels for f32 {
    fn accelerate(solver: &mut Solver<f32>, measured: bool, left: f64) -> Result<(), Error> {
        solver.compute_accelerations(measured, left)
    }

    fn displace(solver: &mut Solver<f32>) {
        solver.update_displacements();
    }

    fn stress(body: &Body<f32>, media: &[Medium<f32>]) -> Result<Vec<[f64; 6]>, i32> {
        body.evaluate_stress(media)
    }
}
