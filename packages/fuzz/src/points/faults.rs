//! Sixteen faults that a numerical library might have, planted in the answers that the fuzzer sees: a test asserts that it
//! finds them. Nothing of the library is changed.

use super::case::{Case, Host, Law, group, with};
use super::entries::{Entry, Outcome};
use super::functions::Functions;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// A shear stress of the wrong sign, in every entry of the hyperelastic law.
    WrongSign,
    /// A refused point of the friction's point entry counts as evaluated.
    StatusDropped,
    /// The energy lost falls by a hundredth, in every entry of the law with friction.
    LossesFall,
    /// A lane of a block has the state of its neighbour.
    NeighboursState,
    /// A block writes behind the stresses of the last point.
    PaddingWritten,
    /// Each point of a block has the limit of the next one.
    LimitOffByOne,
    /// The VUMAT in double precision computes its stress in single.
    SinglePrecision,
    /// The tangent of the law with friction is transposed, in every entry.
    TransposedTangent,
    /// Fibres slide, but the slip stays, in every entry of the law with friction.
    SlipStays,
    /// A point that has failed before keeps its stress, in blocks of the linear elastic law.
    FailedCarries,
    /// A UMAT says of a point that it can evaluate that numbers overflow.
    UmatOverflows,
    /// MGIS refuses a point that it can evaluate.
    MgisRefuses,
    /// LS-DYNA leaves out the last element of a block.
    LastElementLeftOut,
    /// The tangent of LS-DYNA is not divided by J.
    TangentOfKirchhoff,
    /// OpenRadioss gets half the wave speed.
    HalfWaveSpeed,
    /// CalculiX gets the shear stresses 13 and 23 in the order of the law.
    ShearsSwapped,
}

pub const FAULTS: [Fault; 16] = [
    Fault::WrongSign,
    Fault::StatusDropped,
    Fault::LossesFall,
    Fault::NeighboursState,
    Fault::PaddingWritten,
    Fault::LimitOffByOne,
    Fault::SinglePrecision,
    Fault::TransposedTangent,
    Fault::SlipStays,
    Fault::FailedCarries,
    Fault::UmatOverflows,
    Fault::MgisRefuses,
    Fault::LastElementLeftOut,
    Fault::TangentOfKirchhoff,
    Fault::HalfWaveSpeed,
    Fault::ShearsSwapped,
];

impl Fault {
    /// The case that is called in place of this one, for a fault that mistakes its inputs.
    pub fn of_inputs(self, entry: Entry, case: &Case) -> Option<Case> {
        if self != Fault::LimitOffByOne || !matches!(entry, Entry::Block | Entry::BlockWithProperties) {
            return None;
        }
        let mut called = case.clone();
        let n = case.points.len();
        for (i, point) in called.points.iter_mut().enumerate() {
            point.limit = case.points[(i + 1) % n].limit;
        }
        Some(called)
    }

    /// Falsifies what a call has left behind.
    pub fn of_outcome<T: Functions>(self, case: &Case, outcome: &mut Outcome<T>) {
        let (n, law, failed) = (case.points.len(), case.law, case.law.failed());
        let is_block = matches!(outcome.entry, Entry::Block | Entry::BlockWithProperties | Entry::BlockOfOne);
        let evaluated: Vec<usize> = (0..n).filter(|&i| outcome.status(case, i) == Some(0)).collect();
        let frictional = law == Law::Frictional && case.asks_state();
        let is_of = |host: Host| outcome.entry == Entry::Host && case.host == host;
        let slides = |outcome: &Outcome<T>, i: usize| {
            let before = if outcome.entry == Entry::Host { case.points[i].state[8] } else { lost_before(case, i) };
            frictional && outcome.state.get(8, i).into() > before
        };
        match self {
            Fault::WrongSign if law == Law::Hyperelastic && case.asks(with::STRESS) => {
                for i in evaluated {
                    outcome.stress.set(4, i, T::splat(0.0) - outcome.stress.get(4, i));
                }
            }
            Fault::StatusDropped if law == Law::Frictional && outcome.entry == Entry::Point => {
                (outcome.code, outcome.message) = (outcome.code.max(0), String::new());
            }
            Fault::LossesFall if frictional => {
                for i in evaluated {
                    outcome.state.set(8, i, outcome.state.get(8, i) * T::splat(0.99));
                }
            }
            Fault::NeighboursState if is_block && n > 4 && case.asks_state() && law != Law::Linear => {
                for c in 0..failed {
                    outcome.state.set(c, 3, outcome.state.get(c, 2));
                }
            }
            Fault::PaddingWritten if outcome.entry == Entry::Block && case.placings[group::STRESS].gap > 0 => {
                let at = outcome.stress.padding();
                outcome.stress.values[at] = T::splat(0.0);
            }
            Fault::SinglePrecision if case.host == Host::Vumat && outcome.entry == Entry::Host && !case.single => {
                for i in 0..n {
                    for c in 0..6 {
                        let value: f64 = outcome.stress.get(c, i).into();
                        outcome.stress.set(c, i, T::splat(f64::from(value as f32)));
                    }
                }
            }
            Fault::TransposedTangent if law == Law::Frictional && case.asks(with::TANGENT) => {
                let size = case.tangent_size();
                for i in evaluated {
                    let rows = outcome.tangent.row(i);
                    for c in 0..size * size {
                        outcome.tangent.set(c, i, T::splat(rows[size * (c % size) + c / size]));
                    }
                }
            }
            Fault::SlipStays => {
                for i in evaluated {
                    if slides(outcome, i) {
                        let old = if case.old == super::case::Old::Null { 0.0 } else { 1.0 };
                        outcome.state.set(10, i, T::splat(old * case.points[i].state[10]));
                        outcome.state.set(11, i, T::splat(old * case.points[i].state[11]));
                    }
                }
            }
            Fault::FailedCarries if is_block && law == Law::Linear && case.asks(with::STRESS) && case.asks_state() => {
                for i in evaluated {
                    if outcome.state.get(failed, i).into() == 1.0 {
                        outcome.stress.set(0, i, T::splat(case.points[i].state[0]));
                    }
                }
            }
            Fault::UmatOverflows if is_of(Host::Umat) && outcome.code == 0 => {
                outcome.code = toron::status::OVERFLOW;
            }
            Fault::MgisRefuses if is_of(Host::Mgis) && outcome.code == 0 => {
                outcome.code = -1;
            }
            Fault::LastElementLeftOut if is_of(Host::LsDyna) && n > 1 => {
                for c in 0..6 {
                    outcome.stress.set(c, n - 1, T::splat(0.0));
                }
            }
            Fault::TangentOfKirchhoff if is_of(Host::LsDyna) => {
                let Some((_, tangents)) = &mut outcome.further else { return };
                for (i, point) in case.points.iter().enumerate() {
                    let volume = nalgebra::Matrix3::from_column_slice(&point.f).determinant();
                    for c in 0..36 {
                        tangents.set(c, i, tangents.get(c, i) * T::splat(volume));
                    }
                }
            }
            Fault::HalfWaveSpeed if is_of(Host::OpenRadioss) => {
                for i in evaluated {
                    outcome.wave_speed.set(0, i, outcome.wave_speed.get(0, i) * T::splat(0.5));
                }
            }
            Fault::ShearsSwapped if is_of(Host::CalculiX) => {
                let [s23, s31] = [4, 5].map(|c| outcome.stress.get(c, 0));
                outcome.stress.set(4, 0, s31);
                outcome.stress.set(5, 0, s23);
            }
            _ => (),
        }
    }
}

/// The energy lost before the step.
fn lost_before(case: &Case, point: usize) -> f64 {
    if case.old == super::case::Old::Null { 0.0 } else { case.points[point].state[8] }
}
