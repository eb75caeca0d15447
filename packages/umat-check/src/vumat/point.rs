//! Material points that are driven as Abaqus/Explicit drives them: everything on the axes that turn with R of F = R U.

use std::io;

use nalgebra::Matrix3;

use super::super::kinematics::{Increment, rotation_of, rotation_vector};
use super::super::material::Material;
use super::call::{Components, PointInput, PointOutput, Session, Time};

/// Row and column of each component: 11 22 33 12 23 31.
const PLACES: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)];
/// Those of F: 11 22 33 12 23 31 21 32 13.
const OF_GRADIENT: [(usize, usize); 9] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0), (1, 0), (2, 1), (0, 2)];

pub fn tensor(values: &Components) -> Matrix3<f64> {
    let mut tensor = Matrix3::zeros();
    for (&value, (i, j)) in values.iter().zip(PLACES) {
        tensor[(i, j)] = value;
        tensor[(j, i)] = value;
    }
    tensor
}

pub fn components(tensor: &Matrix3<f64>) -> Components {
    PLACES.map(|(i, j)| 0.5 * (tensor[(i, j)] + tensor[(j, i)]))
}

/// A point's state after its last increment.
#[derive(Clone, Debug)]
pub struct Point {
    /// Without superposed rotations.
    pub f: Matrix3<f64>,
    /// A superposed rotation, which defgradOld and defgradNew alone see.
    turn: Matrix3<f64>,
    pub stress: Components,
    pub state: Vec<f64>,
    pub energies: [f64; 2],
}

impl Point {
    /// A point that has not been deformed, with the state that a data check without strain leaves.
    ///
    /// # Errors
    /// The system has no memory.
    pub fn undeformed(session: &mut Session) -> io::Result<Point> {
        let nothing = Point {
            f: Matrix3::identity(),
            turn: Matrix3::identity(),
            stress: [0.0; 6],
            state: session.material.initial.clone(),
            energies: [0.0; 2],
        };
        if session.undeformed.is_none() {
            let given = nothing.given(&nothing.f, &nothing.turn, session.material);
            let found = session.call_law(Time::data_check(session.material), &[given])?;
            session.undeformed = found.into_iter().next().map(|found| found.state);
        }
        let state = session.undeformed.clone().unwrap_or_default();
        Ok(Point { state, ..nothing })
    }

    /// What a call gets for the increment to this deformation, which a rotation may be superposed on.
    pub fn given(&self, f1: &Matrix3<f64>, turn: &Matrix3<f64>, material: &Material) -> PointInput {
        let stretch = |f: &Matrix3<f64>| {
            let u = rotation_of(f).transpose() * f;
            (u + u.transpose()) * 0.5
        };
        let [u0, u1] = [&self.f, f1].map(stretch);
        // On the turning axes the increment of F is U1 / U0; that of R is not seen.
        let increment = Increment::between(&u0, &u1);
        let gradient = |f: &Matrix3<f64>, u: &Matrix3<f64>, turn: &Matrix3<f64>| {
            let gradient = if material.explicit.stretch_alone { *u } else { turn * f };
            OF_GRADIENT.map(|place| gradient[place])
        };
        PointInput {
            density: material.explicit.density / ((u0 + u1) * 0.5).determinant(),
            strain_increment: components(&increment.strain),
            spin: rotation_vector(&increment.rotation).into(),
            stretch: [components(&u0), components(&u1)],
            gradient: [gradient(&self.f, &u0, &self.turn), gradient(f1, &u1, turn)],
            stress: self.stress,
            state: self.state.clone(),
            energies: self.energies,
            temperature: material.temperature,
        }
    }

    /// The point after an increment.
    pub fn after(&self, f1: &Matrix3<f64>, turn: &Matrix3<f64>, found: &PointOutput) -> Point {
        Point { f: *f1, turn: *turn, stress: found.stress, state: found.state.clone(), energies: found.energies }
    }
}

/// Time at the end of an increment, counted from 0.
pub fn time(increment: usize, material: &Material) -> Time {
    Time { end: (increment + 1) as f64 * material.time_step, step: material.time_step }
}

/// One point's history, up to where it is not finite.
///
/// # Errors
/// The system has no memory.
pub fn history(session: &mut Session, path: &[Matrix3<f64>]) -> io::Result<Vec<PointOutput>> {
    let mut histories = block(session, &[path.to_vec()])?;
    let mut found = histories.pop().unwrap_or_default();
    let finite = found.iter().take_while(|found| found.finite()).count();
    found.truncate(finite);
    Ok(found)
}

/// Histories side by side, as one block, of the length of the shortest.
///
/// # Errors
/// The system has no memory.
pub fn block(session: &mut Session, paths: &[Vec<Matrix3<f64>>]) -> io::Result<Vec<Vec<PointOutput>>> {
    block_at(session, paths, &vec![session.material.temperature; paths.len()])
}

/// The same, each at a temperature of its own.
///
/// # Errors
/// The system has no memory.
pub fn block_at(
    session: &mut Session,
    paths: &[Vec<Matrix3<f64>>],
    temperatures: &[f64],
) -> io::Result<Vec<Vec<PointOutput>>> {
    let undeformed = Point::undeformed(session)?;
    let mut points = vec![undeformed; paths.len()];
    let mut answers = vec![Vec::new(); paths.len()];
    let unturned = Matrix3::<f64>::identity();
    let material = session.material;
    for k in 0..paths.iter().map(Vec::len).min().unwrap_or(0) {
        let all = points.iter().zip(paths).zip(temperatures);
        let given = all.map(|((point, path), &temperature)| {
            let given = point.given(&path[k], &unturned, material);
            PointInput { temperature, ..given }
        });
        let given: Vec<PointInput> = given.collect();
        for (i, found) in session.call_law(time(k, material), &given)?.into_iter().enumerate() {
            points[i] = points[i].after(&paths[i][k], &unturned, &found);
            answers[i].push(found);
        }
    }
    Ok(answers)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_come_back() {
        let values = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        assert_eq!(components(&tensor(&values)), values);
        let f = Matrix3::new(11.0, 12.0, 13.0, 21.0, 22.0, 23.0, 31.0, 32.0, 33.0);
        assert_eq!(OF_GRADIENT.map(|place| f[place]), [11.0, 22.0, 33.0, 12.0, 23.0, 31.0, 21.0, 32.0, 13.0]);
    }
}
