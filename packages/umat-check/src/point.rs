//! A material point that is driven as Abaqus drives it: stress and strain turned before the call, state carried from
//! one increment to the next.

use nalgebra::Matrix3;

use super::call::{Answer, Call, Session};
use super::kinematics::{Components, Increment, logarithm, of_strain, of_stress, rotation_of, strain_tensor, tensor};
use super::material::Material;

/// A point's state after its last increment.
#[derive(Clone, Debug)]
pub struct Point {
    /// On global axes, also where the law's are corotational.
    pub f: Matrix3<f64>,
    /// On the law's axes.
    pub stress: Components,
    pub state: Vec<f64>,
    pub energies: [f64; 3],
    strain: Components,
    time: f64,
    increment: i32,
    place: [i32; 2],
    /// KSTEP, and the time at which the step began.
    step: i32,
    begun: f64,
}

/// What begins again with a further step: Abaqus has KSTEP go on, and KINC and TIME(1) begin again.
#[derive(Clone, Copy, Debug)]
pub struct StepStart {
    pub step: bool,
    pub increment: bool,
    /// TIME(1) at the beginning, if it does not go on.
    pub time: Option<f64>,
}

/// Why an increment has no answer.
#[derive(Clone, Debug)]
pub enum Failure {
    /// PNEWDT asks for smaller increments, again and again.
    Refused,
    /// Stress, state or DDSDDE is not finite.
    NotFinite(Box<Call>),
}

/// How often an increment is tried: Abaqus's own default.
const ATTEMPTS: u32 = 5;
/// So many increments one may become; a job would have ended.
const MOST_INCREMENTS: usize = 200;
/// What PNEWDT may leave of an increment, at least.
const SMALLEST_PART: f64 = 0.05;
/// By what Abaqus lets increments grow that converge well.
const GROWTH: f64 = 1.5;

impl Point {
    /// A point that has not been deformed, of this element and number. The element is 1 everywhere: laws may have
    /// tables by it.
    pub fn undeformed(session: &mut Session, place: [i32; 2]) -> Point {
        let (state, stress) = (session.initial_state(place), session.initial_stress(place));
        let nothing = [0.0; 6];
        Point {
            f: Matrix3::identity(),
            stress,
            state,
            energies: [0.0; 3],
            strain: nothing,
            time: 0.0,
            increment: 0,
            place,
            step: 1,
            begun: 0.0,
        }
    }

    /// The arguments for the increment to this deformation.
    pub fn call(&self, f1: &Matrix3<f64>, material: &Material) -> Call {
        let components = material.layout();
        let increment = Increment::between(&self.f, f1);
        let turned = |tensor: Matrix3<f64>| increment.rotation * tensor * increment.rotation.transpose();
        let mut call = Call {
            stress: of_stress(&turned(tensor(&self.stress, components)), components),
            state: self.state.clone(),
            energies: self.energies,
            strain: of_strain(&turned(strain_tensor(&self.strain, components)), components),
            strain_increment: of_strain(&increment.strain, components),
            time: [self.time - self.begun, self.time],
            time_step: material.time_step,
            temperature: material.temperature,
            rotation: increment.rotation,
            f0: self.f,
            f1: *f1,
            place: self.place,
            increment: self.increment + 1,
            unset: 0.0,
            step: self.step,
            temperature_step: 0.0,
        };
        if material.orientation {
            // The axes turn with the material, and everything is written on them.
            let (r0, r1) = (rotation_of(&self.f), rotation_of(f1));
            call.stress = self.stress;
            call.strain = self.strain;
            call.strain_increment = of_strain(&(r1.transpose() * increment.strain * r1), components);
            if material.small_strain {
                // Strains add up, to the logarithm of U.
                let strain = |f: &Matrix3<f64>, r: &Matrix3<f64>| r.transpose() * logarithm(f) * r;
                call.strain_increment = of_strain(&(strain(f1, &r1) - strain(&self.f, &r0)), components);
            }
            call.rotation = Matrix3::identity();
            call.f0 = r0.transpose() * self.f;
            call.f1 = r1.transpose() * f1;
        }
        call
    }

    /// The point after an increment.
    pub fn after(&self, f1: &Matrix3<f64>, call: &Call, answer: &Answer) -> Point {
        let mut strain = call.strain;
        for (total, step) in strain.iter_mut().zip(&call.strain_increment) {
            *total += step;
        }
        Point {
            f: *f1,
            stress: answer.stress,
            state: answer.state.clone(),
            energies: answer.energies,
            strain,
            time: self.time + call.time_step,
            increment: call.increment,
            place: self.place,
            step: self.step,
            begun: self.begun,
        }
    }

    /// Goes on to this deformation, in smaller increments if the law asks for them; the last one's answer.
    ///
    /// # Errors
    /// The law asks for ever smaller increments, or answers what is not finite.
    pub fn advance(&mut self, session: &mut Session, f1: &Matrix3<f64>) -> Result<Answer, Failure> {
        let time_step = session.material.time_step;
        self.advance_in(session, f1, time_step)
    }

    /// The same within another time. PNEWDT is obeyed as Abaqus does: the increment begins again from the old state
    /// with that part of DTIME, so often and no oftener, and later ones may grow again.
    ///
    /// # Errors
    /// As [`advance`](Self::advance).
    pub fn advance_in(&mut self, session: &mut Session, f1: &Matrix3<f64>, time_step: f64) -> Result<Answer, Failure> {
        let start = self.f;
        let whole = Increment::between(&start, f1);
        let (mut done, mut part, mut attempts) = (0.0, 1.0, 1);
        for _ in 0..MOST_INCREMENTS {
            let last = done + part >= 1.0 - 1e-9;
            let f = if last { *f1 } else { whole.at(done + part, &start) };
            let mut call = self.call(&f, session.material);
            call.time_step = time_step * part;
            let answer = session.call_law(&call);
            if answer.refused() {
                if attempts == ATTEMPTS {
                    return Err(Failure::Refused);
                }
                attempts += 1;
                part *= answer.next_step.clamp(SMALLEST_PART, 1.0);
                continue;
            }
            if !answer.finite() {
                return Err(Failure::NotFinite(Box::new(call)));
            }
            *self = self.after(&f, &call, &answer);
            if last {
                return Ok(answer);
            }
            done += part;
            part = (GROWTH * part).min(1.0 - done);
            attempts = 1;
        }
        Err(Failure::Refused)
    }

    /// Increments up to now, those that PNEWDT has divided one by one.
    pub fn increments(&self) -> i32 {
        self.increment
    }

    /// The point at the beginning of a further step.
    pub fn next_step(&self, begun: StepStart) -> Point {
        Point {
            step: self.step + i32::from(begun.step),
            begun: begun.time.map_or(self.begun, |time| self.time - time),
            increment: if begun.increment { 0 } else { self.increment },
            ..self.clone()
        }
    }

    /// Cauchy stress on global axes.
    pub fn global_stress(&self, material: &Material) -> Matrix3<f64> {
        global(&self.stress, &self.f, material)
    }
}

/// A stress on the law's axes, on global ones.
pub fn global(stress: &Components, f: &Matrix3<f64>, material: &Material) -> Matrix3<f64> {
    let local = tensor(stress, material.layout());
    if material.orientation {
        let r = rotation_of(f);
        return r * local * r.transpose();
    }
    local
}
