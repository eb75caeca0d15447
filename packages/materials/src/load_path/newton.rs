//! Mixed control: the free components of F from the prescribed components of its conjugate, by Newton's method.

use nalgebra::{DMatrix, DVector, Matrix3};

use crate::material::laws::LawName;
use crate::material::model::NominalTangent;
use toron::law::status;

/// The prescribed value of a component: of the deformation gradient, or of the first Piola–Kirchhoff stress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Prescribed {
    Gradient(f64),
    Stress(f64),
}

/// The nine components in the order 11 12 13 21 22 23 31 32 33.
pub const COMPONENTS: [(usize, usize); 9] = [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (2, 0), (2, 1), (2, 2)];

/// The names of the components, in the same order.
pub const COMPONENT_NAMES: [&str; 9] = ["11", "12", "13", "21", "22", "23", "31", "32", "33"];

/// Stress below this fraction of the scale counts as none.
const TOLERANCE: f64 = 1e-11;
/// A direction of stiffness below this fraction of the scale has none: two orders above what rounding leaves of it.
const NO_STIFFNESS: f64 = 1e-9;
/// Largest change of a component in one iteration.
const LARGEST_STEP: f64 = 0.1;
/// How far a component without stiffness is moved to find some, at first and at most: a slack yarn is drawn taut, a
/// loose one compacted.
const LEAST_SLACK: f64 = 1e-6;
const LARGEST_SLACK: f64 = 0.5;
const ITERATIONS: usize = 60;
const HALVINGS: usize = 30;

// Sized at run time: with static sizes the compiler unrolls the singular value decomposition, and spends half a minute
// on it.
type Vector = DVector<f64>;
type Jacobian = DMatrix<f64>;

/// The first Piola–Kirchhoff stress P of a deformation gradient and dP/dF, both by columns; or the law's status code.
pub type Stress<'a> = dyn Fn(&Matrix3<f64>) -> Result<(Matrix3<f64>, NominalTangent), i32> + 'a;

/// The solution, and the residuals on the way to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    pub f: Matrix3<f64>,
    /// The largest deviation from a prescribed stress before each iteration, and at the end.
    pub residuals: Vec<f64>,
}

/// Why there is no solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Failure {
    /// The law refuses this deformation gradient, with its status code.
    Law(i32),
    /// The stress of this component is off by this much, and no free component changes it.
    NoStiffness { component: usize, residual: f64 },
    /// Iterations or step halvings did not bring this component nearer than this.
    NotConverged { component: usize, residual: f64 },
}

impl Failure {
    /// In words, with what is known of directions without stiffness in the library's laws.
    pub fn message(&self, law: LawName) -> String {
        let hint = if let LawName::Own(_) = law { String::new() } else { format!(" ({HINT})") };
        match *self {
            Failure::Law(code) => status::meaning(code).unwrap_or("the law refuses this deformation").to_string(),
            Failure::NoStiffness { component, residual } => format!(
                "P{name} is off its prescribed value by {residual:.6e} and F{name} has no stiffness here{hint}: \
                 prescribe F{name} instead",
                name = COMPONENT_NAMES[component]
            ),
            Failure::NotConverged { component, residual } => format!(
                "Newton's method does not converge: P{} is off its prescribed value by {residual:.6e}{hint}",
                COMPONENT_NAMES[component]
            ),
        }
    }
}

const HINT: &str = "the yarn law carries no transverse expansion, no compression along the fibre, and no longitudinal \
                    shear without k_ld";

/// The deformation gradient whose components, and whose stress's, are as prescribed, sought from `start`.
///
/// `scale` is the stress by which small ones are measured. A free direction without stiffness stays where it is: the
/// step is the shortest that solves the linearised equations. One that lacks stress is moved until the law answers: a
/// slack yarn is drawn taut.
///
/// # Errors
/// See [`Failure`].
pub fn solve(
    stress: &Stress,
    start: &Matrix3<f64>,
    prescribed: &[Prescribed; 9],
    scale: f64,
) -> Result<Solution, Failure> {
    let mut f = *start;
    for (&component, &known) in COMPONENTS.iter().zip(prescribed) {
        if let Prescribed::Gradient(value) = known {
            f[component] = value;
        }
    }
    let residual = |f: &Matrix3<f64>| {
        let (p, tangent) = stress(f).map_err(Failure::Law)?;
        Ok(Residual { deviation: stress_deviation(&p, prescribed), jacobian: jacobian(&tangent, prescribed) })
    };
    let mut current = residual(&f)?;
    let mut residuals = Vec::new();
    for _ in 0..ITERATIONS {
        let Residual { deviation: r, jacobian } = &current;
        residuals.push(r.amax());
        if r.amax() <= TOLERANCE * scale {
            return Ok(Solution { f, residuals });
        }
        let decomposition = jacobian.clone().svd(true, true);
        let step = -decomposition.solve(r, NO_STIFFNESS * scale).expect("both factors were asked for");
        let remaining = r + jacobian * &step;
        let next = if remaining.amax() > 0.5 * r.amax() {
            let component = remaining.iamax();
            let moved = take_up_slack(&residual, &f, r, component, TOLERANCE * scale);
            Some(moved.ok_or(Failure::NoStiffness { component, residual: r[component] })?)
        } else {
            line_search(&residual, &f, r, &step)
        };
        let Some(next) = next else { break };
        (f, current) = next;
    }
    let r = &current.deviation;
    Err(Failure::NotConverged { component: r.iamax(), residual: r[r.iamax()] })
}

/// Deviation of each component from its prescribed stress; 0 where the gradient is prescribed.
fn stress_deviation(p: &Matrix3<f64>, prescribed: &[Prescribed; 9]) -> Vector {
    Vector::from_fn(9, |k, _| match prescribed[k] {
        Prescribed::Gradient(_) => 0.0,
        Prescribed::Stress(value) => p[COMPONENTS[k]] - value,
    })
}

/// Deviation from the prescribed stresses and its derivative, at a deformation gradient.
struct Residual {
    deviation: Vector,
    jacobian: Jacobian,
}

/// ∂P/∂F of the free components; rows and columns of prescribed ones are 0.
fn jacobian(tangent: &NominalTangent, prescribed: &[Prescribed; 9]) -> Jacobian {
    let free = |k: usize| matches!(prescribed[k], Prescribed::Stress(_));
    let by_columns = |k: usize| COMPONENTS[k].0 + 3 * COMPONENTS[k].1;
    Jacobian::from_fn(9, 9, |row, column| {
        if free(row) && free(column) { tangent[(by_columns(row), by_columns(column))] } else { 0.0 }
    })
}

/// The first of ever shorter steps that brings the residual down.
fn line_search(
    residual: &dyn Fn(&Matrix3<f64>) -> Result<Residual, Failure>,
    f: &Matrix3<f64>,
    r: &Vector,
    step: &Vector,
) -> Option<(Matrix3<f64>, Residual)> {
    let mut length = (LARGEST_STEP / step.amax()).min(1.0);
    for _ in 0..HALVINGS {
        let mut trial = *f;
        for (k, &component) in COMPONENTS.iter().enumerate() {
            trial[component] += length * step[k];
        }
        if let Ok(new) = residual(&trial)
            && new.deviation.norm() < r.norm()
        {
            return Some((trial, new));
        }
        length *= 0.5;
    }
    None
}

/// Moves a component without stiffness towards the stress that it lacks, ever farther, until the stress answers.
fn take_up_slack(
    residual: &dyn Fn(&Matrix3<f64>) -> Result<Residual, Failure>,
    f: &Matrix3<f64>,
    r: &Vector,
    component: usize,
    least: f64,
) -> Option<(Matrix3<f64>, Residual)> {
    let towards = -r[component].signum();
    let mut reach = LEAST_SLACK;
    while reach <= LARGEST_SLACK {
        let mut trial = *f;
        trial[COMPONENTS[component]] += towards * reach;
        let new = residual(&trial).ok()?;
        if (new.deviation[component] - r[component]) * towards > least {
            return Some((trial, new));
        }
        reach *= 2.0;
    }
    None
}
