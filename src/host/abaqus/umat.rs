//! The UMAT of Abaqus/Standard: of any law, and that of the hyperelastic law by its kernels of one point.

use core::cell::Cell;
use core::ptr::null;
use core::slice;

use libc::{c_char, size_t};

use super::{UMAT_COUNTS, check_counts, property_count};
use crate::host::ByStep;
use crate::host::card_variables::{CardNumbers, CardVariables, properties_of};
use crate::host::entry_points::{Message, check_plane, check_pointers, entry, properties};
use crate::host::environment::in_default_environment;
use crate::law::block::{Circumstances, components, components_mut};
use crate::law::derivative::{Derivative, JaumannModulus, Stress};
use crate::law::error::Error;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::interface::{Law, Points};
use crate::law::linear_elastic::LinearElastic;
use crate::law::number::level::Level;
use crate::law::number::vector::{cross, dot};
use crate::law::own::Own;
use crate::law::parameters::HYPERELASTIC_PROPERTIES as PROPERTIES;
use crate::law::point::{Call, Sink, evaluate_call};
use crate::law::response::Point;
use crate::law::state::HYPERELASTIC_STATE;
use crate::law::status;
use crate::law::tangent::Measure;
use crate::law::voigt::Moduli;

/// The value that PNEWDT is lowered to if a point cannot be evaluated.
const CUTBACK: f64 = 0.25;

/// The arguments of a UMAT that the laws use, with Abaqus's names. Who makes one promises that every array that is not
/// null has as many values as its field says, valid for what it is used for.
#[derive(Clone, Copy, Debug)]
pub struct Umat {
    /// Out, `ntens` = `ndi` + `nshr`: Cauchy stress.
    pub stress: *mut f64,
    /// In and out, `nstatv`: the law's state variables, or more.
    pub statev: *mut f64,
    /// Out, `ntens` × `ntens`: the modulus of the Jaumann rate of the Kirchhoff stress, over J. Null: not computed.
    pub ddsdde: *mut f64,
    /// Out, 1: energy per current volume.
    pub sse: *mut f64,
    /// In and out, 1.
    pub pnewdt: *mut f64,
    /// In, 9: F by columns at the start of the increment, for a law that reads it, and at its end.
    pub dfgrd0: *const f64,
    pub dfgrd1: *const f64,
    /// In, `nprops`: the law's properties, and behind them the number of the state variable with the point's failure
    /// limit, if there is one.
    pub props: *const f64,
    pub nprops: i32,
    pub nstatv: i32,
    /// Numbers of direct components, 3, and of shear components, 3, or 1 for plane strain and axisymmetric solids.
    pub ndi: i32,
    pub nshr: i32,
    /// JSTEP(3), which is not 0 with NLGEOM=YES.
    pub nlgeom: i32,
    /// When the increment is, and how warm at its end, for a law that reads it; see [`circumstances`].
    pub circumstances: Circumstances<f64>,
}

/// When an increment is, from Abaqus's TIME, at its start, and DTIME, and how warm at its end, from TEMP and DTEMP, in
/// `temperature`; what is null is not known.
///
/// # Safety
/// TIME is null or has 2 values, the others 1.
pub unsafe fn circumstances(
    time: *const f64,
    dtime: *const f64,
    temp: *const f64,
    dtemp: *const f64,
    temperature: &mut f64,
) -> Circumstances<f64> {
    // SAFETY: null, or as many values as just said.
    let known = |array: *const f64, place: usize| if array.is_null() { f64::NAN } else { unsafe { *array.add(place) } };
    let (time_increment, start, warm, warmer) = (known(dtime, 0), known(time, 1), known(temp, 0), known(dtemp, 0));
    // A sum sets flags, which are the caller's.
    let (end, sum) = in_default_environment(|| (start + time_increment, warm + warmer));
    *temperature = sum;
    let temperature = if temp.is_null() || dtemp.is_null() { null() } else { core::ptr::from_ref(temperature) };
    Circumstances { time_increment, time: end, temperature }
}

impl Umat {
    /// The properties, and the law that is prepared from them.
    ///
    /// # Errors
    /// The first argument that is wrong.
    fn law<L: Law<f64>>(&self) -> Result<L, Error> {
        // A law that does not read DFGRD0 need not be given one.
        let dfgrd0 = if L::DESCRIPTION.reads.old_gradient { self.dfgrd0 } else { self.dfgrd1 };
        check_pointers(&[
            (self.stress.cast_const(), "stress"),
            (self.statev, "statev"),
            (self.sse, "sse"),
            (self.pnewdt, "pnewdt"),
            (dfgrd0, if L::DESCRIPTION.reads.old_gradient { "dfgrd0" } else { "dfgrd1" }),
            (self.dfgrd1, "dfgrd1"),
            (self.props, "props"),
        ])?;
        if self.nlgeom == 0 {
            let text = "there is no deformation gradient: the step is geometrically linear, give *STEP, NLGEOM=YES";
            return Err(Error::Setting { code: status::NO_DEFORMATION_GRADIENT, text });
        }
        check_counts(self.ndi, self.nshr, UMAT_COUNTS, self.nstatv, L::DESCRIPTION.state.len())?;
        let table = L::DESCRIPTION.properties;
        let count = properties_of::<f64, L>(property_count(self.nprops, table)?);
        // SAFETY: `props` is not null, as just checked, and has `nprops` values.
        let values = unsafe { properties(self.props, count, table) }?;
        let law = L::new(values)?;
        if self.nshr == 1 {
            check_plane(&law, values)?;
        }
        Ok(law)
    }

    /// What the point has of its own.
    ///
    /// # Errors
    /// The card names no variable that may hold it, or it means nothing.
    fn own<L: Law<f64>>(&self) -> Result<CardNumbers<f64>, Error> {
        let (count, kept) = (property_count(self.nprops, L::DESCRIPTION.properties)?, L::DESCRIPTION.state.len());
        // SAFETY: `law` has found that neither array is null and that the counts are not negative: `nprops` and
        // `nstatv` values.
        unsafe {
            CardVariables::from_card::<f64, L>(self.props, count, kept, self.nstatv as usize)?
                .numbers::<f64, L>(self.statev)
        }
    }
}

/// A law as a UMAT of Abaqus/Standard.
pub trait StandardLaw: Law<f64> {
    /// The UMAT. Returns the status code, with a message of at most `capacity` bytes unless `message` is null.
    ///
    /// # Safety
    /// The arrays are those that [`Umat`] promises, and `message` is null or has `capacity` bytes.
    #[inline(never)]
    unsafe fn umat(call: &Umat, message: *mut c_char, capacity: size_t) -> i32 {
        // SAFETY: the arrays are those that `Umat` promises, and the message is the caller's.
        unsafe { entry(Message { text: message, capacity }, || step::<Self>(call)) }
    }

    /// The UMAT, and SPD: of a law that loses energy, what it has lost per current volume. Another law leaves SPD as it
    /// is.
    ///
    /// # Safety
    /// As for [`umat`](Self::umat); `spd` is null or can be written.
    #[inline(always)]
    unsafe fn umat_with_losses(call: &Umat, spd: *mut f64, message: *mut c_char, capacity: size_t) -> i32 {
        // SAFETY: as for `umat`.
        unsafe {
            match Self::DESCRIPTION.lost {
                None => Self::umat(call, message, capacity),
                Some(lost) => entry(Message { text: message, capacity }, || step_with_losses::<Self>(call, lost, spd)),
            }
        }
    }
}

impl<L: ByStep + Law<f64>> StandardLaw for L {}

impl StandardLaw for LinearElastic<f64> {
    #[inline(never)]
    unsafe fn umat(call: &Umat, message: *mut c_char, capacity: size_t) -> i32 {
        // SAFETY: as in the trait.
        unsafe { entry(Message { text: message, capacity }, || step::<Self>(call)) }
    }
}

impl StandardLaw for Hyperelastic<f64> {
    /// Inlined, so that what is usual is seen in registers; the kernels are called.
    #[inline(always)]
    unsafe fn umat(call: &Umat, message: *mut c_char, capacity: size_t) -> i32 {
        let message = Message { text: message, capacity };
        // SAFETY: as above.
        unsafe {
            let mut own = None;
            if !call.is_usual(PROPERTIES) {
                let code = check(call, &mut own, message);
                if code != status::OK {
                    return code;
                }
            }
            if call.ddsdde.is_null() {
                without_tangent(call, own.as_ref(), message)
            } else {
                with_tangent(call, own.as_ref(), message)
            }
        }
    }
}

impl Umat {
    /// Whether nothing is missing or wrong in a call for a point in three dimensions with the hyperelastic law and a
    /// card of so many `constants`: every argument is looked at only if something is, or if the element is
    /// two-dimensional.
    #[inline(always)]
    fn is_usual(&self, constants: usize) -> bool {
        let usual = (self.ndi ^ 3) | (self.nshr ^ 3) | (self.nprops ^ constants as i32) == 0;
        let usual = usual && self.nstatv >= HYPERELASTIC_STATE as i32 && self.nlgeom != 0;
        let missing = self.stress.is_null() || self.statev.is_null() || self.sse.is_null() || self.pnewdt.is_null();
        usual && !(missing || self.dfgrd1.is_null() || self.props.is_null())
    }
}

/// # Safety
/// As for [`StandardLaw::umat`].
#[cold]
#[inline(never)]
unsafe fn check(call: &Umat, own: &mut Option<CardNumbers<f64>>, message: Message) -> i32 {
    let body = || {
        // The kernel checks the properties too.
        if !call.is_usual(PROPERTIES + 1) {
            call.law::<Hyperelastic>()?;
        }
        *own = Some(call.own::<Hyperelastic>()?);
        Ok(status::OK)
    };
    // SAFETY: the message is the caller's.
    unsafe { entry(message, body) }
}

/// # Safety
/// As for [`StandardLaw::umat`]; the arguments have been checked.
#[inline(never)]
unsafe fn without_tangent(call: &Umat, own: Option<&CardNumbers<f64>>, message: Message) -> i32 {
    // SAFETY: the caller's arrays and message.
    unsafe { hyperelastic(call, own, message, Stress::<true>) }
}

/// # Safety
/// As for [`StandardLaw::umat`]; the arguments have been checked, and DDSDDE is not null.
#[inline(never)]
unsafe fn with_tangent(call: &Umat, own: Option<&CardNumbers<f64>>, message: Message) -> i32 {
    // SAFETY: as above.
    unsafe { hyperelastic(call, own, message, JaumannModulus) }
}

/// The UMAT of the hyperelastic law, by its kernel of one point.
///
/// # Safety
/// As for [`StandardLaw::umat`]; the arguments have been checked, and DDSDDE is there if `tangent` is that.
#[inline(always)]
unsafe fn hyperelastic<D: Derivative<N>, const N: usize>(
    call: &Umat,
    own: Option<&CardNumbers<f64>>,
    message: Message,
    tangent: D,
) -> i32
where
    for<'a> &'a Results<'a>: Sink<f64, N>,
{
    let status = Cell::new(status::OK);
    let results = Results { call, status: &status };
    let sink = &results;
    let body = move || {
        // SAFETY: not null, and of the sizes that `Umat` promises.
        let (source, f, state) = unsafe {
            (
                slice::from_raw_parts(sink.call.props, PROPERTIES),
                &*sink.call.dfgrd1.cast::<[[f64; 3]; 3]>(),
                &*sink.call.statev.cast::<[Cell<f64>; HYPERELASTIC_STATE]>(),
            )
        };
        let own = match own {
            Some(numbers) => numbers.own(None),
            None => Own::NONE,
        };
        evaluate_call(Call { source, f, own, state, tangent, sink }, Level::Avx512)?;
        Ok(sink.status.get())
    };
    // SAFETY: the message is the caller's; what `body` reads and writes is not null.
    unsafe { entry(message, body) }
}

/// Where the results of a point go: by reference, so that only its address is passed down.
struct Results<'a> {
    call: &'a Umat,
    status: &'a Cell<i32>,
}

impl Results<'_> {
    /// Stores all results except DDSDDE.
    #[inline(always)]
    fn put(&self, point: &Point<f64>, inverse_jacobian: Option<f64>) {
        let [s11, s22, s33, s12, s23, s31] = point.stress;
        // SAFETY: `Umat` promises ntens entries, 6 or 4, and as many state variables as the law has.
        unsafe {
            *self.call.stress.cast() = [s11, s22, s33, s12];
            if self.call.nshr == 3 {
                *self.call.stress.add(4).cast() = [s31, s23];
            }
            let Some(inverse_jacobian) = inverse_jacobian else { return self.keep(point) };
            // The sum of the energies of a point that can be evaluated fits the number format; a check here took 6 % of
            // the call.
            let energy = sum_of_energies(point);
            let current = energy * inverse_jacobian;
            *self.call.statev.cast() = point.state;
            *self.call.sse = if current < f64::INFINITY { current } else { energy };
        }
    }

    /// Stores the state and the energy of a point that may have failed before, with an F and old energies that mean
    /// nothing, and the status of one that cannot be evaluated.
    #[cold]
    #[inline(never)]
    fn keep(&self, point: &Point<f64>) {
        let energy = sum_of_energies(point);
        let fits = point.status != status::OK || energy.is_finite();
        self.status.set(if fits { point.status } else { status::OVERFLOW });
        // SAFETY: as many state variables as the law has; nine entries of F.
        unsafe {
            if self.status.get() == status::OK {
                *self.call.statev.cast() = point.state;
                *self.call.sse = current_density(energy, determinant(&*self.call.dfgrd1.cast()));
            } else {
                *self.call.pnewdt = (*self.call.pnewdt).min(CUTBACK);
            }
        }
    }
}

/// The energy per reference volume.
#[inline(always)]
fn sum_of_energies(point: &Point<f64>) -> f64 {
    let [w_el, w_tc, w_td, w_ld, ..] = point.state;
    ((w_el + w_tc) + w_td) + w_ld
}

impl Sink<f64, 0> for &Results<'_> {
    #[inline(always)]
    fn take(self, point: Point<f64>, inverse_jacobian: Option<f64>, _: [f64; 0]) {
        self.put(&point, inverse_jacobian);
    }
}

impl Sink<f64, 21> for &Results<'_> {
    #[inline(always)]
    fn take(self, point: Point<f64>, inverse_jacobian: Option<f64>, moduli: [f64; 21]) {
        let [r1, r2, r3, r4, r5, r6] = Moduli(moduli).matrix();
        let [r1, r2, r3, r4] = [abaqus_order(r1), abaqus_order(r2), abaqus_order(r3), abaqus_order(r4)];
        let [r5, r6] = [abaqus_order(r5), abaqus_order(r6)];
        // SAFETY: ntens² entries, for ntens = 6 or 4.
        unsafe {
            if self.call.nshr == 3 {
                *self.call.ddsdde.cast() = [r1, r2, r3, r4, r6, r5];
            } else {
                for (k, [c1, c2, c3, c4, ..]) in [r1, r2, r3, r4].into_iter().enumerate() {
                    *self.call.ddsdde.cast::<[f64; 4]>().add(k) = [c1, c2, c3, c4];
                }
            }
        }
        self.put(&point, inverse_jacobian);
    }
}

/// 11 22 33 12 13 23 of 11 22 33 12 23 31.
#[inline(always)]
fn abaqus_order([c11, c22, c33, c12, c23, c31]: [f64; 6]) -> [f64; 6] {
    [c11, c22, c33, c12, c31, c23]
}

/// The determinant of F, given by columns.
#[inline(always)]
fn determinant(f: &[[f64; 3]; 3]) -> f64 {
    dot(f[0], cross(f[1], f[2]))
}

/// An energy per reference volume as one per current volume, W/J. A point that has failed before may have any F.
#[inline(always)]
fn current_density(energy: f64, jacobian: f64) -> f64 {
    let current = energy / jacobian;
    if jacobian > 0.0 && current.is_finite() { current } else { energy }
}

/// The UMAT of a law by its step at one point.
///
/// # Errors
/// The first argument that is wrong.
///
/// # Safety
/// As for [`StandardLaw::umat`].
unsafe fn step<L: Law<f64>>(call: &Umat) -> Result<i32, Error> {
    let law: L = call.law()?;
    let own = call.own::<L>()?;
    let (mut sigma, mut state, mut tangent) = ([0.0; 6], L::fresh(), [[0.0; 6]; 6]);
    let wanted = !call.ddsdde.is_null();
    let point = Points {
        f_old: components(if L::DESCRIPTION.reads.old_gradient { call.dfgrd0 } else { call.dfgrd1 }, 1),
        f_new: components(call.dfgrd1, 1),
        circumstances: call.circumstances,
        state_old: L::parts(call.statev, 1),
        state_new: L::parts_mut(state.as_mut().as_mut_ptr(), 1),
        stress: components_mut(sigma.as_mut_ptr(), 1),
        tangent: if wanted { tangent.as_mut_ptr().cast() } else { core::ptr::null_mut() },
        measure: Measure::Jaumann,
        ..own.point::<L>()
    };
    // SAFETY: the arrays are not null and those that `Umat` promises, or of one point here.
    let code = unsafe { law.step(&point) }?;
    let components = if call.nshr == 3 { 6 } else { 4 };
    // SAFETY: ntens components, and as many state variables as the law has.
    unsafe {
        for (to, from) in (0..components).zip(IN_ABAQUS) {
            *call.stress.add(to) = component(&sigma, from);
        }
        if wanted {
            for (column, from) in (0..components).zip(IN_ABAQUS) {
                for (row, entries) in (0..components).zip(IN_ABAQUS.map(|row| tangent.get(row))) {
                    *call.ddsdde.add(components * column + row) = entries.map_or(0.0, |row| component(row, from));
                }
            }
        }
        if code == status::OK {
            *call.statev.cast() = state;
            *call.sse = current_density(L::DESCRIPTION.energy(state.as_ref()), determinant(&*call.dfgrd1.cast()));
        } else {
            *call.pnewdt = (*call.pnewdt).min(CUTBACK);
        }
    }
    law.told(code)
}

/// The UMAT of a law by its step, and the energy lost per current volume, variable `lost` of its state, to `spd`.
///
/// # Errors
/// The first argument that is wrong.
///
/// # Safety
/// As for [`StandardLaw::umat_with_losses`].
unsafe fn step_with_losses<L: Law<f64>>(call: &Umat, lost: usize, spd: *mut f64) -> Result<i32, Error> {
    // SAFETY: the arrays are those that `Umat` promises; `step` has refused those that are null and counts that are too
    // small.
    unsafe {
        let code = step::<L>(call)?;
        if code == status::OK && !spd.is_null() {
            *spd = current_density(*call.statev.add(lost), determinant(&*call.dfgrd1.cast()));
        }
        Ok(code)
    }
}

/// The law's components 11 22 33 12 23 31 in Abaqus's order.
const IN_ABAQUS: [usize; 6] = [0, 1, 2, 3, 5, 4];

fn component(values: &[f64; 6], place: usize) -> f64 {
    values.get(place).copied().unwrap_or_default()
}
