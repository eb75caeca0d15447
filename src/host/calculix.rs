//! CalculiX: external behaviours through the native interface, `*MATERIAL, NAME=@TORON_HYPERELASTIC` and
//! `NAME=@TORON_LINEARELASTIC`, or `@LIBRARY_LAW` for any other law of a library.
//!
//! | | hyperelastic law | linear elastic law | any law |
//! |---|---|---|---|
//! | found as | `HYPERELASTIC` | `LINEARELASTIC`, both in `libTORON.so`, a link to `libtoron_calculix.so` | its name |
//! | properties, elconloc | 11, or 12 | 10, or 11 | those of its table |
//! | state, nstate_ ≥ | 11 | 19: 10 state variables, then F of the last increment, by columns | its table, and F where it reads that |
//! | stiff | dS/dE | its symmetric part | its symmetric part |
//!
//! | | |
//! |---|---|
//! | kode | −100 minus the number of constants |
//! | deformation | xkl(3,3), F by columns, global |
//! | state | xstateini, xstate: (nstate_, mi(1), elements) |
//! | stress | stre(6): second Piola–Kirchhoff 11 22 33 **12 13 23** |
//! | tangent | stiff(21): dS/dE, tensor components, the upper triangle of that order by columns; on every call |
//! | limit | the constant behind the properties is the number of the state variable, behind those above, that holds the point's own; or 0 |
//! | failure | stress 0; stiff is 1e-6 of the bulk modulus on its diagonal, since nodes between failed elements would have no stiffness |
//! | F inverted or not finite | state kept, pnewdt ≤ ¼ |
//!
//! The directions of a law, the fibre and others, are given in the axes of `*ORIENTATION`, if there are any, else in
//! global ones; everything else is global. NLGEOM, and no initial stress. The header does not declare the entries:
//! CalculiX alone calls them.

use core::cell::Cell;
use core::ffi::c_char;

use crate::law::block::{Circumstances, components, components_mut};
use crate::law::derivative::SixBySix;
use crate::law::description::Direction;
use crate::law::error::{Error, Value};
use crate::law::hyperelastic::Hyperelastic;
use crate::law::interface::{Law, Points};
use crate::law::linear_elastic::LinearElastic;
use crate::law::number::level::Level;
use crate::law::point::{Call, Sink, evaluate_call};
use crate::law::response::Point;
use crate::law::response::{Request, nan_unless_finite};
use crate::law::state::HYPERELASTIC_STATE;
use crate::law::status;
use crate::law::stress::second_piola_kirchhoff;
use crate::law::tangent::Measure;
use nalgebra::{Matrix3, Vector3};

use super::ByStep;
use super::card_variables::{CardNumbers, CardVariables, properties_of};
use super::entry_points::{properties, start_at_rest};
use super::environment::in_default_environment;

/// The value that pnewdt is lowered to if a point cannot be evaluated. CalculiX passes −1 for no limit.
const CUTBACK: f64 = 0.25;

/// The exit code of CalculiX after an error in a material.
const EXIT_CODE: i32 = 201;

/// The diagonal of stiff at a point without stiffness, relative to the bulk modulus. With 0 CalculiX's equation solver
/// ends the job as soon as all elements of a node have failed. The stress stays 0, so that this costs no accuracy.
const RESIDUAL_STIFFNESS: f64 = 1e-6;

/// The most properties of a law whose directions are turned.
const MOST_PROPERTIES: usize = 128;

/// The arguments of CalculiX that the laws use, with the names of its `umat_user.f`. Who makes one promises that every
/// pointer points to as many values as its field says, valid for what they are used for.
#[derive(Clone, Copy, Debug)]
pub struct Behaviour {
    /// In, 80 characters: the material's name.
    pub amat: *const c_char,
    /// In, 1 each: element and integration point, from 1; −100 minus the number of constants, and the constants.
    pub iel: *const i32,
    pub iint: *const i32,
    pub kode: *const i32,
    pub elconloc: *const f64,
    /// In, 6 each: strain and initial stress; 9: F by columns.
    pub emec: *const f64,
    pub beta: *const f64,
    pub xkl: *const f64,
    /// In: the integration points of an element, mi(1), and the state variables of a point, 1; then the old and, out,
    /// the new state variables of all points.
    pub mi: *const i32,
    pub nstate_: *const i32,
    pub xstateini: *const f64,
    pub xstate: *mut f64,
    /// Out, 6 and 21: stress and tangent.
    pub stre: *mut f64,
    pub stiff: *mut f64,
    /// In: the orientation, from 1, or 0, 1; coordinates of the point, 3; 7 for each orientation.
    pub iorien: *const i32,
    pub pgauss: *const f64,
    pub orab: *const f64,
    /// In and out, 1.
    pub pnewdt: *mut f64,
    /// dtime, the time at the end of the increment, ttime + time, and t1l, for a law that reads them.
    pub circumstances: Circumstances<f64>,
}

/// The sum of two times; it leaves no flags behind.
pub fn sum([start, since]: [f64; 2]) -> f64 {
    in_default_environment(|| start + since)
}

/// The arguments of a call, at its point.
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
    circumstances: Circumstances<f64>,
}

/// The results that are returned to CalculiX.
struct Answer<S> {
    stress: [f64; 6],
    stiffness: [f64; 21],
    state: S,
    /// F by columns, kept behind the state for the next increment by a law that reads it.
    kept: Option<[f64; 9]>,
    pnewdt: f64,
    status: i32,
    /// Why the law has refused the point, if it has a reason of its own.
    refusal: Option<&'static str>,
}

impl<S> Answer<S> {
    /// A state, and nothing else yet.
    #[inline(always)]
    const fn new(state: S) -> Self {
        Answer {
            stress: [0.0; 6],
            stiffness: [0.0; 21],
            state,
            kept: None,
            pnewdt: 0.0,
            status: status::OK,
            refusal: None,
        }
    }
}

impl Sink<f64, 21> for &mut Answer<[f64; HYPERELASTIC_STATE]> {
    #[inline(always)]
    fn take(self, point: Point<f64>, _: Option<f64>, moduli: [f64; 21]) {
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
    /// The constants of the material, if there are as many as the law has properties.
    ///
    /// # Errors
    /// The errors of a deck that the arguments show.
    fn properties<L: Law<f64>>(&self) -> Result<&[f64], Error> {
        let law = &L::DESCRIPTION;
        let count = properties_of::<f64, L>(self.count());
        // SAFETY: as many constants as kode says: see `Behaviour`.
        let properties = unsafe { properties(self.constants, count, law.properties) }?;
        let state = law.history();
        if self.state_count < state as i32 {
            let (found, wanted) = (i64::from(self.state_count), state as i64);
            let what = "number of state variables (*DEPVAR)";
            return Err(Error::Count { code: status::STATE_COUNT, what, found, wanted });
        }
        if let Some(&value) = self.initial_stress.iter().find(|&&x| x != 0.0) {
            return Err(Error::Argument {
                name: "initial stress",
                value: Value::of(value),
                wanted: "0: F = 1 is free of stress",
            });
        }
        if self.is_linear() {
            let text = "there is no deformation gradient: the step is geometrically linear, give *STEP, NLGEOM";
            return Err(Error::Setting { code: status::NO_DEFORMATION_GRADIENT, text });
        }
        Ok(properties)
    }

    /// The number of constants.
    fn count(&self) -> usize {
        usize::try_from(-100 - i64::from(self.kode)).unwrap_or(0)
    }

    /// What the point has of its own.
    ///
    /// # Errors
    /// The card names no variable that may hold it, or it means nothing.
    fn own<L: Law<f64>>(&self) -> Result<CardNumbers<f64>, Error> {
        let (kept, variables) = (L::DESCRIPTION.history(), usize::try_from(self.state_count).unwrap_or(0));
        // SAFETY: as many constants as kode says, and as many variables: see `Behaviour`.
        unsafe {
            CardVariables::from_card::<f64, L>(self.constants, self.count(), kept, variables)?
                .numbers::<f64, L>(self.old_state)
        }
    }

    /// Completes the answer: pnewdt, and a stiffness where there is none, relative to the bulk modulus.
    ///
    /// # Errors
    /// A status that no smaller increment helps.
    fn finish<S>(&self, mut answer: Answer<S>, bulk: impl FnOnce() -> f64) -> Result<Answer<S>, Error> {
        if [status::FIBRE_DIRECTION, status::STATE_NOT_FINITE].contains(&answer.status) {
            return Err(Error::Plain(answer.status));
        }
        answer.pnewdt = match (answer.status, self.pnewdt > 0.0) {
            (status::OK, _) => self.pnewdt,
            (_, true) => self.pnewdt.min(CUTBACK),
            (_, false) => CUTBACK,
        };
        if answer.stiffness.iter().all(|&c| c == 0.0) {
            let residual = RESIDUAL_STIFFNESS * bulk();
            answer.stiffness = DIAGONAL.map(|diagonal| residual * diagonal);
        }
        Ok(answer)
    }

    /// Evaluates the hyperelastic law, by its kernel of one point.
    ///
    /// # Errors
    /// The errors of a deck that the arguments show.
    fn hyperelastic(&self) -> Result<Answer<[f64; HYPERELASTIC_STATE]>, Error> {
        let properties = self.properties::<Hyperelastic>()?;
        let fibre = match (self.orientation, properties) {
            (Some((axes, place)), &[.., m_1, m_2, m_3]) => Some(turned([m_1, m_2, m_3], axes, place)),
            _ => None,
        };
        let numbers = self.own::<Hyperelastic>()?;
        let mut answer = Answer::new([0.0; HYPERELASTIC_STATE]);
        let request = Request { stress: false, wave_modulus: false, ..Request::ALL };
        let tangent = SixBySix(request, Measure::Material);
        let own = numbers.own(fibre);
        // SAFETY: `properties` has refused a state_count below the law's number of variables, and there are as many.
        let state = unsafe { &*self.old_state.cast::<[Cell<f64>; HYPERELASTIC_STATE]>() };
        evaluate_call(Call { source: properties, f: self.f, own, state, tangent, sink: &mut answer }, Level::Avx512)?;
        self.finish(answer, || 0.5 * properties.first().copied().unwrap_or_default())
    }

    /// Evaluates any law by its step.
    ///
    /// # Errors
    /// The errors of a deck that the arguments show.
    fn step<L: CalculixLaw>(&self) -> Result<Answer<L::State>, Error> {
        let values = self.properties::<L>()?;
        let law = self.oriented::<L>(values)?;
        // SAFETY: `properties` has refused a state_count below the law's number of variables, and there are as many.
        let old = unsafe { *self.old_state.cast::<L::State>() };
        let f_new: &[f64; 9] = self.f.as_flattened().first_chunk().unwrap_or(&[0.0; 9]); // there are nine
        let mut f_old = *f_new;
        if L::DESCRIPTION.reads.old_gradient {
            // SAFETY: as above: state_count includes the nine values of F, of a law that reads them.
            unsafe {
                f_old = *self.old_state.add(L::DESCRIPTION.state.len()).cast();
                start_at_rest(components_mut(f_old.as_mut_ptr(), 1), 1);
            }
        }
        let own = self.own::<L>()?;
        let mut answer = Answer::new(old);
        let (mut cauchy, mut entries) = ([0.0; 6], [[0.0; 6]; 6]);
        let nowhere = [f64::NAN; 9];
        // The state must not advance where the second Piola-Kirchhoff stress alone overflows: the law then leaves it as
        // at any point without an F.
        let mut overflows = false;
        for f_new in [f_new, &nowhere] {
            let point = Points {
                f_old: components(f_old.as_ptr(), 1),
                f_new: components(f_new.as_ptr(), 1),
                circumstances: self.circumstances,
                state_old: L::parts(old.as_ref().as_ptr(), 1),
                state_new: L::parts_mut(answer.state.as_mut().as_mut_ptr(), 1),
                stress: components_mut(cauchy.as_mut_ptr(), 1),
                tangent: entries.as_mut_ptr().cast(),
                measure: Measure::Material,
                ..own.point::<L>()
            };
            // SAFETY: the arrays have the sizes of one point, and outputs overlap nothing.
            answer.status = unsafe { law.step(&point) }?;
            let [s11, s22, s33, s12, s23, s31] = second_piola_kirchhoff(&cauchy, self.f);
            answer.stress = [s11, s22, s33, s12, s31, s23];
            if nan_unless_finite(&answer.stress) == 0.0 {
                break;
            }
            overflows = true;
        }
        if overflows {
            (answer.status, answer.stress) = (status::OVERFLOW, [0.0; 6]);
        }
        // The symmetric part, its upper triangle by rows. Halves first: a sum might overflow.
        let columns: [[f64; 6]; 6] =
            core::array::from_fn(|c| entries.map(|row| row.get(c).copied().unwrap_or_default()));
        let mut upper = [0.0; 21];
        let pairs = entries.iter().zip(&columns).enumerate();
        let pairs = pairs.flat_map(|(r, (row, column))| row.iter().zip(column).skip(r));
        upper.iter_mut().zip(pairs).for_each(|(entry, (x, y))| *entry = 0.5 * x + 0.5 * y);
        answer.stiffness = by_columns(upper);
        if L::DESCRIPTION.reads.old_gradient {
            answer.kept = Some(if answer.status == status::OK { *f_new } else { f_old });
        }
        if answer.status == status::OVERFLOW {
            law.told(status::OVERFLOW)?;
        }
        answer.refusal = L::DESCRIPTION.refusal.filter(|_| answer.status == status::LAW);
        self.finish(answer, || law.bulk_modulus(values))
    }

    /// The law, its directions turned where the element has an orientation.
    ///
    /// # Errors
    /// The first property that is wrong.
    fn oriented<L: Law<f64>>(&self, values: &[f64]) -> Result<L, Error> {
        const { assert!(L::DESCRIPTION.properties.len() <= MOST_PROPERTIES, "CalculiX: too many properties") };
        // As they are given, so that a message names what stands in the deck.
        let law = L::new(values)?;
        let Some((axes, place)) = self.orientation else { return Ok(law) };
        let mut turned_values = [0.0; MOST_PROPERTIES];
        turned_values.iter_mut().zip(values).for_each(|(to, &from)| *to = from);
        for &Direction { first, .. } in L::DESCRIPTION.directions {
            // One that may be 0 stays so.
            if let Some(direction) = turned_values.get_mut(first..).and_then(<[f64]>::first_chunk_mut)
                && *direction != [0.0; 3]
            {
                *direction = turned(*direction, axes, place);
            }
        }
        L::new(turned_values.get(..values.len()).unwrap_or_default()).map_err(|_| Error::Plain(status::FIBRE_DIRECTION))
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

/// The vector whose components in the axes of `*ORIENTATION` are `m`: rectangular axes by two vectors, or cylindrical
/// ones about the line through two points, as CalculiX's `transformatrix.f` reads them.
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

/// The text of an error. It is written in the default floating-point environment, since formatting numbers is
/// arithmetic.
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

/// Prints a line as CalculiX prints its own errors and warnings.
fn print_line(kind: &[u8], material: &[u8; 80], message: &[u8]) {
    for text in [kind, b": toron, material ", material.trim_ascii_end(), b": ", message, b"\n"] {
        // SAFETY: the format takes a length and as many bytes.
        unsafe { libc::printf(c"%.*s".as_ptr(), text.len() as libc::c_int, text.as_ptr()) };
    }
}

/// Prints what is wrong as CalculiX prints its own errors, and ends the job as it does.
fn refuse(material: &[u8; 80], message: &Message) -> ! {
    print_line(b" *ERROR", material, message.text.get(..message.length).unwrap_or_default());
    // SAFETY: CalculiX itself ends in this way; open files are flushed.
    unsafe { libc::exit(EXIT_CODE) }
}

/// A law as an external behaviour of CalculiX.
pub trait CalculixLaw: Law<f64> {
    /// The bulk modulus to which the stiffness of a failed point is relative.
    fn bulk_modulus(&self, _properties: &[f64]) -> f64 {
        let [bulk, _] = self.bulk_and_shear();
        bulk
    }

    /// The function that CalculiX calls.
    ///
    /// # Safety
    /// The arguments are those that [`Behaviour`] promises.
    #[inline(never)]
    unsafe fn behaviour(call: &Behaviour) {
        // SAFETY: the arguments are those that `Behaviour` promises.
        unsafe { answer(call, |arguments| arguments.step::<Self>()) }
    }
}

impl<L: ByStep + Law<f64>> CalculixLaw for L {}

impl CalculixLaw for Hyperelastic<f64> {
    #[inline(always)]
    unsafe fn behaviour(call: &Behaviour) {
        // SAFETY: the arguments are those that `Behaviour` promises.
        unsafe { hyperelastic(call) }
    }
}

impl CalculixLaw for LinearElastic<f64> {
    /// ½ E1, also where that is not the largest modulus.
    fn bulk_modulus(&self, properties: &[f64]) -> f64 {
        0.5 * properties.first().copied().unwrap_or_default()
    }

    #[inline(always)]
    unsafe fn behaviour(call: &Behaviour) {
        // SAFETY: the arguments are those that `Behaviour` promises.
        unsafe { linear_elastic(call) }
    }
}

/// The hyperelastic law as an external behaviour of CalculiX.
///
/// # Safety
/// As for [`CalculixLaw::behaviour`].
#[inline(never)]
pub unsafe fn hyperelastic(call: &Behaviour) {
    // SAFETY: the arguments are those that `Behaviour` promises.
    unsafe { answer(call, |arguments| arguments.hyperelastic()) }
}

/// The linear elastic law as an external behaviour of CalculiX.
///
/// # Safety
/// As for [`CalculixLaw::behaviour`].
#[inline(never)]
pub unsafe fn linear_elastic(call: &Behaviour) {
    // SAFETY: the arguments are those that `Behaviour` promises.
    unsafe { answer(call, |arguments| arguments.step::<LinearElastic>()) }
}

/// Evaluates a law and stores its results, or ends the job.
///
/// # Safety
/// As for [`CalculixLaw::behaviour`].
#[inline(always)]
unsafe fn answer<S>(call: &Behaviour, law: impl FnOnce(&Arguments<'_>) -> Result<Answer<S>, Error>) {
    // SAFETY: no pointer is null, and each has the values that `Behaviour` says. Integration points, elements and
    // orientations count from 1.
    let (arguments, new) = unsafe {
        let point = (*call.iel as usize - 1) * *call.mi as usize + (*call.iint as usize - 1);
        let place = point * *call.nstate_ as usize;
        let axes = usize::try_from(*call.iorien - 1).ok();
        let arguments = Arguments {
            kode: *call.kode,
            constants: call.elconloc,
            strain: &*call.emec.cast(),
            initial_stress: &*call.beta.cast(),
            f: &*call.xkl.cast(),
            orientation: axes.map(|i| (&*call.orab.cast::<[f64; 7]>().add(i), &*call.pgauss.cast())),
            state_count: *call.nstate_,
            old_state: call.xstateini.wrapping_add(place),
            pnewdt: *call.pnewdt,
            circumstances: call.circumstances,
        };
        (arguments, call.xstate.wrapping_add(place))
    };
    let mut message = Message::EMPTY;
    match in_default_environment(|| law(&arguments).map_err(|error| message.write(error))) {
        // SAFETY: the results have the sizes that `Behaviour` says; the state has as many values as the law's and F,
        // which `Arguments::properties` has checked before there is an answer.
        Ok(answer) => unsafe {
            *call.stre.cast() = answer.stress;
            *call.stiff.cast() = answer.stiffness;
            *new.cast() = answer.state;
            let mut written = size_of::<S>() / size_of::<f64>();
            if let Some(f) = answer.kept {
                *new.add(written).cast() = f;
                written += f.len();
            }
            // CalculiX does not keep what is not written: a limit, or a variable of somebody else's.
            for place in written..arguments.state_count as usize {
                *new.add(place) = *arguments.old_state.add(place);
            }
            *call.pnewdt = answer.pnewdt;
            if let Some(text) = answer.refusal {
                // CalculiX itself says only that a smaller increment is tried.
                print_line(b" *WARNING", &*call.amat.cast(), text.as_bytes());
            }
        },
        // SAFETY: a material's name has 80 characters.
        Err(()) => refuse(unsafe { &*call.amat.cast() }, &message),
    }
}
