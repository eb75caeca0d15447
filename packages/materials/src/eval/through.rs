//! A step through the C entry that `eval` is asked for, as its host would call it.

use nalgebra::Matrix3;

use super::command::Entry;
use super::lines::order;
use super::polar::polar_decomposition;
use super::push_forward::{cauchy_of_second, truesdell_of_material};
use crate::entries::step::{Answer, Step, Stepped, jaumann};
use toron::law::{status, stress};

/// The answer of an entry in the library's order; in single precision all that it gets is rounded.
pub fn through<L: Stepped<STATE>, const STATE: usize>(
    entry: Entry,
    step: &Step<'_, L, STATE>,
    f: &Matrix3<f64>,
) -> Answer<STATE> {
    match entry {
        Entry::Law => step.point::<f64>(false),
        Entry::LawF32 => step.point::<f32>(false),
        Entry::LawWithProperties => step.point::<f64>(true),
        Entry::LawWithPropertiesF32 => step.point::<f32>(true),
        Entry::Block => step.block::<f64>(),
        Entry::BlockF32 => step.block::<f32>(),
        Entry::Umat => step.umat(),
        Entry::Vumat => via_vumat(f, |stretch| step.vumat::<f64>(stretch)),
        Entry::VumatSp => via_vumat(f, |stretch| step.vumat::<f32>(stretch)),
        Entry::LsDyna => step.lsdyna(),
        Entry::LsDynaVector => step.lsdyna_vector(),
        Entry::Mgis => {
            let (answer, material) = step.mgis();
            Answer { ddsdde: material.map(|material| jaumann_of_material(&material, f, &answer.stress)), ..answer }
        }
        Entry::CalculiX => {
            let (answer, material) = step.calculix();
            // Where there is no stress, CalculiX gets a stiffness that is none of the law's.
            let intact = answer.status == status::OK;
            let stress = if intact { order(cauchy_of_second(&answer.stress, f)) } else { [0.0; 6] };
            let ddsdde = || if intact { jaumann_of_material(&material, f, &stress) } else { [[0.0; 6]; 6] };
            Answer { stress, ddsdde: step.tangent.then(ddsdde), ..answer }
        }
        Entry::OpenRadioss => step.openradioss(),
    }
}

/// DDSDDE, in the library's order, of dS/dE, 11 22 33 12 13 23, and the Cauchy stress.
fn jaumann_of_material(material: &[[f64; 6]; 6], f: &Matrix3<f64>, stress: &[f64; 6]) -> [[f64; 6]; 6] {
    jaumann(&order(truesdell_of_material(material, f).map(order)), stress)
}

/// Calls a VUMAT as Abaqus/Explicit does: with U; its corotational stress is rotated by R.
fn via_vumat<const STATE: usize>(f: &Matrix3<f64>, entry: impl FnOnce(&[f64; 6]) -> Answer<STATE>) -> Answer<STATE> {
    let (r, u) = polar_decomposition(f);
    let answer = entry(&stress::components(&u));
    let rotated = r * (stress::matrix(&answer.stress) * r.transpose());
    // R of an F that is not finite may not be either.
    let stress = if answer.status == status::OK { stress::components(&rotated) } else { [0.0; 6] };
    Answer { stress, ..answer }
}
