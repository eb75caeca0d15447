//! A material point that is driven as Abaqus drives it: stress and strain turned before the call, state carried from
//! one increment to the next.

use nalgebra::Matrix3;

use super::call::{Answer, Call, Session};
use super::kinematics::{Components, Increment, of_strain, of_stress, rotation_of, strain_tensor, tensor};
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
}

/// Why an increment has no answer.
#[derive(Clone, Debug)]
pub enum Failure {
    /// PNEWDT asks for smaller increments, again and again.
    Refused,
    /// Stress, state or DDSDDE is not finite.
    NotFinite(Box<Call>),
}

/// How often an increment is halved if the law asks for it.
const HALVINGS: u32 = 6;

impl Point {
    /// A point that has not been deformed, of this element and number. The element is 1 everywhere: laws may have
    /// tables by it.
    pub fn virgin(session: &mut Session, place: [i32; 2]) -> Point {
        let state = session.initial_state(place);
        let nothing = [0.0; 6];
        Point {
            f: Matrix3::identity(),
            stress: nothing,
            state,
            energies: [0.0; 3],
            strain: nothing,
            time: 0.0,
            increment: 0,
            place,
        }
    }

    /// The arguments for the increment to this deformation.
    pub fn call(&self, f1: &Matrix3<f64>, material: &Material) -> Call {
        let components = material.components;
        let increment = Increment::between(&self.f, f1);
        let turned = |tensor: Matrix3<f64>| increment.rotation * tensor * increment.rotation.transpose();
        let mut call = Call {
            stress: of_stress(&turned(tensor(&self.stress, components)), components),
            state: self.state.clone(),
            energies: self.energies,
            strain: of_strain(&turned(strain_tensor(&self.strain, components)), components),
            strain_increment: of_strain(&increment.strain, components),
            time: [self.time; 2],
            time_step: material.time_step,
            temperature: material.temperature,
            rotation: increment.rotation,
            f0: self.f,
            f1: *f1,
            place: self.place,
            increment: self.increment + 1,
            unset: 0.0,
        };
        if material.orientation {
            // The axes turn with the material, and everything is written on them.
            let (r0, r1) = (rotation_of(&self.f), rotation_of(f1));
            call.stress = self.stress;
            call.strain = self.strain;
            call.strain_increment = of_strain(&(r1.transpose() * increment.strain * r1), components);
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
        }
    }

    /// Goes on to this deformation, in smaller increments if the law asks for them; the last one's answer.
    ///
    /// # Errors
    /// The law asks for ever smaller increments, or answers what is not finite.
    pub fn advance(&mut self, session: &mut Session, f1: &Matrix3<f64>) -> Result<Answer, Failure> {
        let time_step = session.material.time_step;
        self.advance_within(session, f1, time_step, HALVINGS)
    }

    /// The same within another time.
    ///
    /// # Errors
    /// As [`advance`](Self::advance).
    pub fn advance_in(&mut self, session: &mut Session, f1: &Matrix3<f64>, time_step: f64) -> Result<Answer, Failure> {
        self.advance_within(session, f1, time_step, HALVINGS)
    }

    fn advance_within(
        &mut self,
        session: &mut Session,
        f1: &Matrix3<f64>,
        time_step: f64,
        halvings: u32,
    ) -> Result<Answer, Failure> {
        let mut call = self.call(f1, session.material);
        call.time_step = time_step;
        let answer = session.call_law(&call);
        if answer.refused() {
            let Some(halvings) = halvings.checked_sub(1) else { return Err(Failure::Refused) };
            let middle = Increment::between(&self.f, f1).at(0.5, &self.f);
            self.advance_within(session, &middle, 0.5 * time_step, halvings)?;
            return self.advance_within(session, f1, 0.5 * time_step, halvings);
        }
        if !answer.finite() {
            return Err(Failure::NotFinite(Box::new(call)));
        }
        *self = self.after(f1, &call, &answer);
        Ok(answer)
    }

    /// Cauchy stress on global axes.
    pub fn global_stress(&self, material: &Material) -> Matrix3<f64> {
        global(&self.stress, &self.f, material)
    }
}

/// A stress on the law's axes, on global ones.
pub fn global(stress: &Components, f: &Matrix3<f64>, material: &Material) -> Matrix3<f64> {
    let local = tensor(stress, material.components);
    if material.orientation {
        let r = rotation_of(f);
        return r * local * r.transpose();
    }
    local
}
