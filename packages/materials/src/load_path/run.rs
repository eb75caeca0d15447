//! Runs a load path: its points, step by step and increment by increment.

use nalgebra::{Matrix3, Rotation3, SMatrix};
use rayon::prelude::*;

use super::element::Hexahedron;
use super::newton::{self, COMPONENTS, Prescribed};
use super::path::{LoadPath, Point, Step, Target};
use crate::material::model::{Answer, Material};
use toron::Request;
use toron::law::status;
use toron::law::stress::first_piola_kirchhoff;

/// How often an increment may be halved where it cannot be solved in one go.
const HALVINGS: usize = 8;
/// A failed point carries no stress above this fraction of the stiffness.
const CARRIED: f64 = 1e-9;

/// The results at the end of an increment.
#[derive(Clone, Debug, PartialEq)]
pub struct Increment {
    /// Index of the step among [`LoadPath::steps`]; the increment within it, from 1 (0: the start of the path).
    pub step: usize,
    pub number: usize,
    pub time: f64,
    /// Deformation gradient and first Piola–Kirchhoff stress, before the rotation on top.
    pub f: Matrix3<f64>,
    pub p: Matrix3<f64>,
    /// The rotation on top.
    pub q: Matrix3<f64>,
    /// Cauchy stress along the current fibre.
    pub fibre_stress: f64,
    pub answer: Answer,
    /// Work done on the element since the start.
    pub work: f64,
    /// Newton iterations that it took.
    pub iterations: usize,
}

impl Increment {
    /// The deformation gradient with the rotation: what the law was given.
    pub fn rotated_gradient(&self) -> Matrix3<f64> {
        self.q * self.f
    }

    /// The first Piola–Kirchhoff stress with the rotation.
    pub fn rotated_stress(&self) -> Matrix3<f64> {
        self.q * self.p
    }
}

/// How a point's path ended.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    Completed,
    /// The point has failed and a stress is prescribed that nothing can carry any more; where it stopped.
    Stopped(String),
    /// The evaluation failed; where and why.
    Failed(String),
}

/// A point's history along the path.
#[derive(Clone, Debug)]
pub struct History<'a> {
    pub point: &'a Point,
    /// The first one is the start, at rest.
    pub increments: Vec<Increment>,
    /// Index of the first increment with the point failed.
    pub failure: Option<usize>,
    pub end: End,
}

/// Runs all points, in parallel; `progress` is called after every increment. The answer does not depend on the number
/// of threads.
pub fn run<'a>(path: &'a LoadPath, progress: &(dyn Fn() + Sync)) -> Vec<History<'a>> {
    path.points.par_iter().map(|point| run_point(path, point, progress)).collect()
}

/// Runs one point.
pub fn run_point<'a>(path: &'a LoadPath, point: &'a Point, progress: &dyn Fn()) -> History<'a> {
    let mut history = History { point, increments: Vec::new(), failure: None, end: End::Completed };
    let said = |failure: newton::Failure| failure.message(point.material.law.name());
    let mut state = match PointState::at_rest(&point.material, path.element) {
        Ok(state) => state,
        Err(failure) => {
            history.end = End::Failed(format!("at the start: {}", said(failure)));
            return history;
        }
    };
    history.increments.push(state.increment(0, 0, 0.0));
    let mut control = [Control::Gradient; 9];
    let mut start_of_step = 0.0;
    for (index, step) in path.steps.iter().enumerate() {
        let ramp = Ramp::new(step, start_of_step, &state, &mut control);
        let mut from = 0.0;
        for (number, &to) in (1..).zip(&step.fractions) {
            let place = || format!("{step}, increment {number}");
            if state.cannot_carry(&ramp, to) {
                history.end = End::Stopped(place());
                return history;
            }
            if let Err(failure) = state.advance(&ramp, from, to, HALVINGS) {
                history.end = End::Failed(format!("{}: {}", place(), said(failure)));
                return history;
            }
            if history.failure.is_none() && state.failed() {
                history.failure = Some(history.increments.len());
            }
            history.increments.push(state.increment(index, number, ramp.time(to)));
            state.iterations = 0;
            from = to;
            progress();
        }
        start_of_step += step.duration;
    }
    history
}

/// Which of the two conjugates is prescribed.
#[derive(Clone, Copy, Debug)]
enum Control {
    Gradient,
    Stress,
}

/// The prescribed values of a step, at its start and its end.
struct Ramp<'a> {
    step: &'a Step,
    start_time: f64,
    start: [Prescribed; 9],
    end: [Prescribed; 9],
    rotation: Matrix3<f64>,
}

impl<'a> Ramp<'a> {
    /// The ramp from the current state; what the step does not name is held, in the conjugate that `control` names.
    fn new(step: &'a Step, start_time: f64, state: &PointState, control: &mut [Control; 9]) -> Self {
        let mut start = [Prescribed::Gradient(0.0); 9];
        let mut end = start;
        for (k, &component) in COMPONENTS.iter().enumerate() {
            let (f, p) = (state.f[component], state.held[k]);
            let (from, to) = match step.targets[k] {
                Some(Target::Gradient(value)) => (Prescribed::Gradient(f), Prescribed::Gradient(value)),
                Some(Target::Stress(value)) => (Prescribed::Stress(state.p[component]), Prescribed::Stress(value)),
                Some(Target::Hold) => (Prescribed::Gradient(f), Prescribed::Gradient(f)),
                None => match control[k] {
                    Control::Gradient => (Prescribed::Gradient(f), Prescribed::Gradient(f)),
                    Control::Stress => (Prescribed::Stress(p), Prescribed::Stress(p)),
                },
            };
            control[k] = match to {
                Prescribed::Gradient(_) => Control::Gradient,
                Prescribed::Stress(_) => Control::Stress,
            };
            (start[k], end[k]) = (from, to);
        }
        Ramp { step, start_time, start, end, rotation: state.q }
    }

    /// The time at the fraction `s` of the step.
    fn time(&self, s: f64) -> f64 {
        self.start_time + s * self.step.duration
    }

    /// What is prescribed at the fraction `s` of the step, and the rotation on top; exact at the end of the step.
    fn at(&self, s: f64) -> ([Prescribed; 9], Matrix3<f64>) {
        let between = |from: f64, to: f64| if s == 1.0 { to } else { from + s * (to - from) };
        let prescribed = std::array::from_fn(|k| match (self.start[k], self.end[k]) {
            (Prescribed::Stress(from), Prescribed::Stress(to)) => Prescribed::Stress(between(from, to)),
            (Prescribed::Gradient(from), Prescribed::Gradient(to)) => Prescribed::Gradient(between(from, to)),
            (_, to) => to, // not reached: both ends prescribe the same conjugate
        });
        let rotation = match &self.step.rotation {
            Some((axis, angle)) => Rotation3::from_axis_angle(axis, s * angle).into_inner() * self.rotation,
            None => self.rotation,
        };
        (prescribed, rotation)
    }
}

/// The current state of a point on its path.
struct PointState<'a> {
    material: &'a Material,
    element: Hexahedron,
    scale: f64,
    answer: Answer,
    f: Matrix3<f64>,
    p: Matrix3<f64>,
    q: Matrix3<f64>,
    /// The prescribed stresses, which the stress itself meets within the tolerance of Newton's method only.
    held: [f64; 9],
    work: f64,
    /// Newton iterations since the last increment.
    iterations: usize,
}

impl<'a> PointState<'a> {
    fn at_rest(material: &'a Material, element: Hexahedron) -> Result<Self, newton::Failure> {
        let f = Matrix3::identity();
        let answer = material.evaluate(&f, 0.0, &material.at_rest(), Request::ALL).map_err(newton::Failure::Law)?;
        let p = first_piola_kirchhoff(&answer.cauchy, &f);
        let scale = material.stress_scale();
        Ok(PointState { material, element, scale, answer, f, p, q: f, held: [0.0; 9], work: 0.0, iterations: 0 })
    }

    fn failed(&self) -> bool {
        self.material.failed(&self.answer.memory)
    }

    /// Whether the point has failed and the ramp asks for a stress at `s`.
    fn cannot_carry(&self, ramp: &Ramp, s: f64) -> bool {
        let asks = |known: &Prescribed| matches!(known, Prescribed::Stress(p) if p.abs() > CARRIED * self.scale);
        self.failed() && ramp.at(s).0.iter().any(asks)
    }

    /// Advances along the ramp, in halves where the whole cannot be solved.
    fn advance(&mut self, ramp: &Ramp, from: f64, to: f64, halvings: usize) -> Result<(), newton::Failure> {
        let (prescribed, q) = ramp.at(to);
        let failure = match self.solve(&prescribed, &q, ramp.time(to)) {
            Ok(solution) => {
                self.iterations += solution.residuals.len() - 1;
                return self.accept(&solution.f, &q, ramp.time(to), &prescribed);
            }
            Err(failure) => failure,
        };
        let halving_is_useless =
            matches!(failure, newton::Failure::NoStiffness { .. } | newton::Failure::Law(status::NOT_FINITE));
        if halvings == 0 || halving_is_useless {
            return Err(failure);
        }
        let middle = 0.5 * (from + to);
        self.advance(ramp, from, middle, halvings - 1)
            .and_then(|()| self.advance(ramp, middle, to, halvings - 1))
            .map_err(|_| failure)
    }

    /// The deformation gradient, before the rotation, that meets what is prescribed.
    fn solve(
        &self,
        prescribed: &[Prescribed; 9],
        q: &Matrix3<f64>,
        time: f64,
    ) -> Result<newton::Solution, newton::Failure> {
        // The rotation acts on the first index of P and F.
        let rotation = SMatrix::<f64, 3, 3>::identity().kronecker(q);
        let stress = |f: &Matrix3<f64>| {
            let rotated = q * f;
            let (cauchy, tangent) = self.material.tangent(&rotated, time, &self.answer.memory)?;
            let p = q.transpose() * first_piola_kirchhoff(&cauchy, &rotated);
            Ok((p, rotation.transpose() * tangent * rotation))
        };
        newton::solve(&stress, &self.f, prescribed, self.scale)
    }

    /// Makes the deformation gradient the current state.
    fn accept(
        &mut self,
        f: &Matrix3<f64>,
        q: &Matrix3<f64>,
        time: f64,
        prescribed: &[Prescribed; 9],
    ) -> Result<(), newton::Failure> {
        let rotated = q * f;
        let answer =
            self.material.evaluate(&rotated, time, &self.answer.memory, Request::ALL).map_err(newton::Failure::Law)?;
        let p = q.transpose() * first_piola_kirchhoff(&answer.cauchy, &rotated);
        // A point that has failed before takes no work; the rotation never does.
        if !self.failed() {
            self.work += self.element.work(&self.f, &self.p, f, &p);
        }
        for (held, known) in self.held.iter_mut().zip(prescribed) {
            if let Prescribed::Stress(value) = known {
                *held = *value;
            }
        }
        (self.f, self.p, self.q, self.answer) = (*f, p, *q, answer);
        Ok(())
    }

    fn increment(&self, step: usize, number: usize, time: f64) -> Increment {
        let e = (self.q * self.f * self.material.fibre()).normalize();
        let fibre_stress = e.dot(&(toron::law::stress::matrix(&self.answer.cauchy) * e));
        let PointState { f, p, q, work, iterations, .. } = *self;
        let answer = self.answer.clone();
        Increment { step, number, time, f, p, q, fibre_stress, answer, work, iterations }
    }
}
