//! CalculiX: an external behaviour through the native interface, `*MATERIAL, NAME=@TORON_HYPERELASTIC`.
//!
//! | | |
//! |---|---|
//! | found as | `HYPERELASTIC` in `libTORON.so`, a link to `libtoron_calculix.so` |
//! | properties | elconloc(1) … elconloc(11), kode = −100 − 11 |
//! | deformation | xkl(3,3), F by columns, global |
//! | state | xstateini, xstate: (nstate_, mi(1), elements), nstate_ ≥ 11 |
//! | stress | stre(6): second Piola–Kirchhoff 11 22 33 **12 13 23** |
//! | tangent | stiff(21): dS/dE, tensor components, the upper triangle of that order by columns; on every call |
//! | failure | stress 0; stiff is 1e-6 of the bulk modulus on its diagonal, since nodes between failed elements would have no stiffness |
//! | F inverted or not finite | state kept, pnewdt ≤ ¼ |
//!
//! The fibre is given in the axes of `*ORIENTATION`, if there are any, else in global ones; everything else is global. NLGEOM,
//! and no initial stress. The header does not declare the entry: CalculiX alone calls it.

use core::cell::Cell;
use core::ffi::c_char;

use crate::law::derivative::SixBySix;
use crate::law::error::Error;
use crate::law::number::level::Level;
use crate::law::parameters;
use crate::law::point::{Call, Point, Sink, evaluate_call};
use crate::law::response::Request;
use crate::law::state::HYPERELASTIC_STATE;
use crate::law::status;
use crate::law::tangent::Measure;
use nalgebra::{Matrix3, Vector3};

use super::border::properties;
use super::environment::in_default_environment;

/// The value that pnewdt is lowered to if a point cannot be evaluated. CalculiX passes −1 for no limit.
const CUTBACK: f64 = 0.25;

/// The exit code of CalculiX after an error in a material.
const EXIT_CODE: i32 = 201;

/// The diagonal of stiff at a point without stiffness, relative to the bulk modulus ½ k_el. With 0 CalculiX's equation solver
/// ends the job as soon as all elements of a node have failed. The stress stays 0, so that this costs no accuracy.
const RESIDUAL_STIFFNESS: f64 = 1e-6;

/// The arguments of CalculiX that the law uses.
struct Arguments<'a> {
    /// −100 minus the number of constants.
    kode: i32,
    constants: *const f64,
    /// Lagrange strain 11 22 33 12 13 23, without its quadratic part where the analysis is linear.
    strain: &'a [f64; 6],
    initial_stress: &'a [f64; 6],
    f: &'a [[f64; 3]; 3],
    /// The axes of `*ORIENTATION` and the coordinates of the point, if the element has an orientation.
    orientation: Option<(&'a [f64; 7], &'a [f64; 3])>,
    state_count: i32,
    old_state: *const f64,
    pnewdt: f64,
}

/// The results that are returned to CalculiX.
#[derive(Default)]
struct Answer {
    stress: [f64; 6],
    stiffness: [f64; 21],
    state: [f64; HYPERELASTIC_STATE],
    pnewdt: f64,
    status: i32,
}

impl Sink<f64, 21> for &mut Answer {
    #[inline(always)]
    fn take(self, point: Point<f64>, moduli: [f64; 21]) {
        let [el, tc, td, ld] = point.modes;
        let [s11, s22, s33, s12, s23, s31] = core::array::from_fn(|c| el[c] + tc[c] + td[c] + ld[c]);
        self.stress = [s11, s22, s33, s12, s31, s23];
        self.stiffness = by_columns(moduli);
        self.state = point.state;
        self.status = point.status;
    }
}

/// stiff: the upper triangle by columns, 11 22 33 12 13 23, of the law's by rows, 11 22 33 12 23 31.
const fn by_columns([a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u]: [f64; 21]) -> [f64; 21] {
    [a, b, g, c, h, l, d, i, m, p, f, k, o, r, u, e, j, n, q, t, s]
}

/// 1 on the diagonal of stiff.
const DIAGONAL: [f64; 21] = by_columns([
    1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0,
]);

impl Arguments<'_> {
    /// Evaluates the law.
    ///
    /// # Errors
    /// The errors of a deck that the arguments show.
    fn evaluate(&self) -> Result<Answer, Error> {
        let count = usize::try_from(-100 - i64::from(self.kode)).unwrap_or(0);
        // SAFETY: CalculiX's promise: as many constants as kode says.
        let properties = unsafe { properties(self.constants, count, &parameters::HYPERELASTIC) }?;
        if self.state_count < HYPERELASTIC_STATE as i32 {
            return Err(Error::Plain(status::STATE_COUNT));
        }
        if let Some(&value) = self.initial_stress.iter().find(|&&x| x != 0.0) {
            return Err(Error::Argument { name: "initial stress", value, wanted: "0: F = 1 is free of stress" });
        }
        if self.is_linear() {
            return Err(Error::Plain(status::NO_DEFORMATION_GRADIENT));
        }
        let fibre = match (self.orientation, properties) {
            (Some((axes, place)), &[.., m_1, m_2, m_3]) => Some(turned([m_1, m_2, m_3], axes, place)),
            _ => None,
        };
        let mut answer = Answer { pnewdt: self.pnewdt, ..Answer::default() };
        let request = Request { stress: false, wave_modulus: false, ..Request::ALL };
        let tangent = SixBySix(request, Measure::Material);
        // SAFETY: CalculiX's promise: there are as many as state_count says.
        let state = unsafe { &*self.old_state.cast::<[Cell<f64>; HYPERELASTIC_STATE]>() };
        evaluate_call(Call { source: properties, f: self.f, fibre, state, tangent, sink: &mut answer }, Level::Avx512)?;
        if [status::FIBRE_DIRECTION, status::STATE_NOT_FINITE].contains(&answer.status) {
            return Err(Error::Plain(answer.status)); // no smaller increment helps
        }
        if answer.status != status::OK {
            answer.pnewdt = if self.pnewdt > 0.0 { self.pnewdt.min(CUTBACK) } else { CUTBACK };
        }
        if let (true, &[k_el, ..]) = (answer.stiffness.iter().all(|&c| c == 0.0), properties) {
            let residual = RESIDUAL_STIFFNESS * 0.5 * k_el;
            answer.stiffness = DIAGONAL.map(|diagonal| residual * diagonal);
        }
        Ok(answer)
    }

    /// Whether NLGEOM is missing: the strain is the linear one of this F, without ½ HᵀH, H = F − 1.
    fn is_linear(&self) -> bool {
        let h = Matrix3::from(*self.f) - Matrix3::identity();
        let six = |s: Matrix3<f64>| [s.m11, s.m22, s.m33, s.m12, s.m13, s.m23];
        let largest = |s: [f64; 6]| s.into_iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let (linear, quadratic) = (six(0.5 * (h + h.transpose())), largest(six(0.5 * h.tr_mul(&h))));
        let mut off = *self.strain;
        off.iter_mut().zip(linear).for_each(|(strain, linear)| *strain -= linear);
        // If F or the strain is not finite, the law reports it.
        quadratic > 1e-9 && quadratic.is_finite() && largest(off) < 1e-3 * quadratic
    }
}

/// The vector whose components in the axes of `*ORIENTATION` are `m`: rectangular axes by two vectors, or cylindrical ones about
/// the line through two points, as CalculiX's `transformatrix.f` reads them.
fn turned(m: [f64; 3], &[a_1, a_2, a_3, b_1, b_2, b_3, system]: &[f64; 7], place: &[f64; 3]) -> [f64; 3] {
    let (a, b) = (Vector3::new(a_1, a_2, a_3), Vector3::new(b_1, b_2, b_3));
    let unit = |v: Vector3<f64>| v / v.norm();
    let across = |v: Vector3<f64>, axis: Vector3<f64>| unit(v - axis * axis.dot(&v));
    let (e1, e2, e3);
    if system > 0.0 {
        e1 = unit(a);
        e2 = across(b, e1);
        e3 = e1.cross(&e2);
    } else {
        e3 = unit(b - a);
        e1 = across(Vector3::from(*place) - a, e3);
        e2 = e3.cross(&e1);
    }
    let [m_1, m_2, m_3] = m;
    (e1 * m_1 + e2 * m_2 + e3 * m_3).into()
}

/// The text of an error. It is written in the default floating-point environment, since formatting numbers is arithmetic.
struct Message {
    text: [u8; 400],
    length: usize,
}

impl Message {
    const EMPTY: Message = Message { text: [0; 400], length: 0 };

    fn write(&mut self, error: Error) {
        error.describe(&mut |piece| {
            for (to, &from) in self.text.iter_mut().skip(self.length).zip(piece.as_bytes()) {
                *to = from;
                self.length += 1;
            }
        });
    }
}

/// Prints what is wrong as CalculiX prints its own errors, and ends the job as it does.
fn refuse(material: &[u8; 80], message: &Message) -> ! {
    let print = |text: &[u8]| {
        // SAFETY: the format takes a length and as many bytes.
        unsafe { libc::printf(c"%.*s".as_ptr(), text.len() as libc::c_int, text.as_ptr()) };
    };
    print(b" *ERROR: toron, material ");
    print(material.trim_ascii_end());
    print(b": ");
    print(message.text.get(..message.length).unwrap_or_default());
    print(b"\n");
    // SAFETY: CalculiX itself ends in this way; open files are flushed.
    unsafe { libc::exit(EXIT_CODE) }
}

/// The hyperelastic law as an external behaviour of CalculiX. Arguments as CalculiX passes them, see its `umat_user.f`.
///
/// # Safety
/// CalculiX's promise: every pointer has as many values as documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn hyperelastic(
    amat: *const c_char,
    iel: *const i32,
    iint: *const i32,
    kode: *const i32,
    elconloc: *const f64,
    emec: *const f64,
    _emec0: *const f64,
    beta: *const f64,
    _xokl: *const f64,
    _voj: *const f64,
    xkl: *const f64,
    _vj: *const f64,
    _ithermal: *const i32,
    _t1l: *const f64,
    _dtime: *const f64,
    _time: *const f64,
    _ttime: *const f64,
    _icmd: *const i32,
    _ielas: *const i32,
    mi: *const i32,
    nstate_: *const i32,
    xstateini: *const f64,
    xstate: *mut f64,
    stre: *mut f64,
    stiff: *mut f64,
    iorien: *const i32,
    pgauss: *const f64,
    orab: *const f64,
    pnewdt: *mut f64,
    _ipkon: *const i32,
    _amat_length: i32,
) {
    // SAFETY: CalculiX's promise; integration points and elements count from 1.
    let (arguments, new) = unsafe {
        let point = (*iel as usize - 1) * *mi as usize + (*iint as usize - 1);
        let place = point * *nstate_ as usize;
        let arguments = Arguments {
            kode: *kode,
            constants: elconloc,
            strain: &*emec.cast(),
            initial_stress: &*beta.cast(),
            f: &*xkl.cast(),
            orientation: usize::try_from(*iorien - 1).ok().map(|i| (&*orab.cast::<[f64; 7]>().add(i), &*pgauss.cast())),
            state_count: *nstate_,
            old_state: xstateini.wrapping_add(place),
            pnewdt: *pnewdt,
        };
        (arguments, xstate.wrapping_add(place))
    };
    let mut message = Message::EMPTY;
    match in_default_environment(|| arguments.evaluate().map_err(|error| message.write(error))) {
        // SAFETY: CalculiX's promise.
        Ok(answer) => unsafe {
            *stre.cast() = answer.stress;
            *stiff.cast() = answer.stiffness;
            *new.cast() = answer.state;
            *pnewdt = answer.pnewdt;
        },
        // SAFETY: a material's name has 80 characters.
        Err(()) => refuse(unsafe { &*amat.cast() }, &message),
    }
}
