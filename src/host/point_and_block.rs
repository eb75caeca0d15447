//! A point of the yarn laws and a block of points, as C passes them: each array stands in both structures, beside what a
//! call asks for with it and where its results go.

use core::ptr::{null, null_mut};

use libc::size_t;

use super::arguments::{Layout, check_density, check_points, leading_dimension, level, measure, measure_of};
use super::constants::{
    TORON_LEVEL_AVX2, TORON_LEVEL_AVX512, TORON_LEVEL_BASELINE, TORON_LEVEL_BEST, TORON_TANGENT_NOMINAL,
};
use super::entry_points::store;
use super::structures::structures;
use crate::law::block::{MOST, Points, Strides, components, components_mut, distances};
use crate::law::error::Error;
use crate::law::number::level::has_fma;
use crate::law::number::real::{Real, Scalar};
use crate::law::own::Own;
use crate::law::point::Sink;
use crate::law::response::{self, Request};
use crate::law::tangent::Measure;
use crate::law::voigt::Moduli;
use crate::law::wave_speed;

/// A point of the hyperelastic law or of the law with friction. Set `size`, and what is wanted; the rest is 0: an array
/// that is null is left out, and an output that is left out is not computed. The arrays of the old and the new state
/// may be the same.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Point<T> {
    /// The size of this structure.
    pub size: size_t,
    /// In: which tangent, one of `TORON_TANGENT_...`; read if `tangent` is not null.
    pub measure: i32,
    /// In: the instruction set to use, one of `TORON_LEVEL_...`; if the processor lacks it, the best one below it.
    pub level: i32,
    /// In: reference density; read if `wave_speed` is not null.
    pub density: f64,
    /// In, 9: F by columns. Must not be null.
    pub deformation_gradient: *const T,
    /// In, 3: the fibre direction, of any length; if null, that of the properties.
    pub fibre: *const T,
    /// In, 11 (15 of the law with friction): the old state; if null, all 0.
    pub state_old: *const T,
    /// Out, as many: the new state. If null, the point does not fail, but stays failed if its old state has the flag
    /// set.
    pub state_new: *mut T,
    /// Out, 6: Cauchy stress 11 22 33 12 23 31.
    pub stress: *mut T,
    /// Out, 24: S_el, S_tc, S_td, S_ld, second Piola-Kirchhoff, each 11 22 33 12 23 31.
    pub modes: *mut T,
    /// Out, 1: an upper bound of the wave speed, to be used with current element lengths; never below the speed along a
    /// fibre at rest. It is meant for the stable time step; a bulk viscosity computed with it damps more than with the
    /// exact speed.
    pub wave_speed: *mut T,
    /// Out, 36 (81 for `TORON_TANGENT_NOMINAL`): the tangent, entry (row, column), counted from 0, at 6 row + column (9
    /// row + column); a symmetric matrix, but where the fibres of the law with friction slide. Rows and columns are in
    /// the order 11 22 33 12 23 31, with derivatives with respect to engineering shears; for `TORON_TANGENT_NOMINAL` 11
    /// 21 31 12 22 32 13 23 33.
    ///
    /// The call that detects failure returns that of the intact material, later calls return zeros. At a kink (I_el = 0
    /// or I_tc = 0) it is that of loading.
    pub tangent: *mut T,
    /// In, 1: the true fibre strain at failure, ln(1 + eps_lim), in place of that of the properties; if null or 0, that
    /// of the properties. Read if `state_new` is not null.
    pub limit: *const T,
}

structures! { Point, "toron_point_f64", "toron_point_f32", "point"; }

#[cfg(target_pointer_width = "64")]
const _: () = assert!(size_of::<Point<f64>>() == 3 * 8 + 9 * 8 && size_of::<Point<f32>>() == size_of::<Point<f64>>());

/// A block of points of the hyperelastic law or of the law with friction. Set `size`, `n`, and what is wanted; the rest
/// is 0: an array that is null is left out, and an output that is left out is not computed.
///
/// Component c of point i is at `c * leading_dimension + i`, unless the layout of the array says otherwise. F, fibre
/// and stress have a pointer for each component, so that they may be in separate arrays; if only the first is set, the
/// others follow it by the layout. The arrays of the old and the new state may be the same; otherwise arrays must not
/// overlap. Energies, invariants and failure may be parts of one array of 11 components (15 of the law with friction),
/// starting at components 0, 4 and 8.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Block<T> {
    /// The size of this structure.
    pub size: size_t,
    /// The number of points.
    pub n: size_t,
    /// In numbers, from one component to the next; 0: n.
    pub leading_dimension: size_t,
    /// In: which tangent, one of `TORON_TANGENT_...`; read if `tangent` is not null.
    pub measure: i32,
    /// In: the instruction set to use, one of `TORON_LEVEL_...`; if the processor lacks it, the best one below it. AVX2
    /// and AVX-512 give identical bits; the baseline differs in the last digits.
    pub level: i32,
    /// In: reference density; read if `wave_speed` is not null.
    pub density: f64,
    /// In, 9 components: F by columns. The first must not be null.
    pub deformation_gradient: [*const T; 9],
    /// In, 3 components: the fibre direction of each point, of any length; if null, that of the properties.
    pub fibre: [*const T; 3],
    /// In, 4, 4 and 3 components: the old state; if null, all 0. The failure has 7 of the law with friction.
    pub energies_old: *const T,
    pub invariants_old: *const T,
    pub failure_old: *const T,
    /// Out, 6 components: Cauchy stress 11 22 33 12 23 31.
    pub stress: [*mut T; 6],
    /// Out, 4: W_el W_tc W_td W_ld.
    pub energies: *mut T,
    /// Out, 4: I_el I_tc I_td I_ld.
    pub invariants: *mut T,
    /// Out, 3: failure index, failed, alive; of the law with friction 7, before these the energy lost, I_te and the two
    /// components of the slip. If null, no point fails, but a point whose old failure flag is set stays failed.
    pub failure: *mut T,
    /// Out, 24: S_el, S_tc, S_td, S_ld, second Piola-Kirchhoff, each 11 22 33 12 23 31.
    pub modes: *mut T,
    /// Out, 36 components (81 for `TORON_TANGENT_NOMINAL`): entry (row, column), counted from 0, is component 6 row +
    /// column (9 row + column); else as in `toron_point_f64`.
    pub tangent: *mut T,
    /// Out, a number for each point: an upper bound of the wave speed, as in `toron_point_f64`.
    pub wave_speed: *mut T,
    /// Out, a number for each point: 1, or 0 if it has failed or cannot be evaluated: what a solver deletes elements
    /// by.
    pub active: *mut T,
    /// Out, a number for each point: its status code.
    pub status: *mut i32,
    /// Where the entries of these arrays are. That of the state holds for energies, invariants and failure, old and
    /// new.
    pub deformation_gradient_layout: Layout,
    pub fibre_layout: Layout,
    pub state_layout: Layout,
    pub stress_layout: Layout,
    pub modes_layout: Layout,
    pub tangent_layout: Layout,
    /// In, a number for each point: the true fibre strain at failure, ln(1 + eps_lim), in place of that of the
    /// properties; 0: that of the properties. If null, that of the properties. Read if `failure` is not null.
    pub limit: *const T,
    pub limit_layout: Layout,
}

structures! { Block, "toron_block_f64", "toron_block_f32", "block"; }

#[cfg(target_pointer_width = "64")]
const _: () =
    assert!(size_of::<Block<f64>>() == 5 * 8 + 30 * 8 + 14 * 8 && size_of::<Block<f32>>() == size_of::<Block<f64>>());

/// The columns of F, and the fibre direction or `None` for that of the properties.
type Motion<'a, T> = (&'a [[T; 3]; 3], Option<[T; 3]>);

impl<T> Point<T> {
    /// The results that have an array.
    #[inline(always)]
    pub(super) fn request(&self) -> Request {
        let kept = !self.state_new.is_null();
        Request {
            stress: !self.stress.is_null(),
            energies: kept,
            invariants: kept,
            failure: kept,
            modes: !self.modes.is_null(),
            wave_modulus: !self.wave_speed.is_null(),
        }
    }

    /// Whether it asks for what most callers do: the stress with or without the state, and nothing else.
    #[inline(always)]
    pub(super) fn is_usual(&self) -> bool {
        let nothing_else = self.modes.is_null() && self.wave_speed.is_null() && self.tangent.is_null();
        nothing_else && !self.stress.is_null()
    }

    /// Whether it asks for what solvers do in every step: stress and a new state from an old one, without a limit of
    /// its own, at a level whose lanes compute as a point on its own does.
    #[inline(always)]
    pub(super) fn is_usual_step(&self) -> bool {
        self.is_usual()
            && !(self.state_old.is_null() | self.state_new.is_null())
            && self.limit.is_null()
            && matches!(self.level, TORON_LEVEL_BEST | TORON_LEVEL_AVX2 | TORON_LEVEL_AVX512)
            && has_fma()
    }
}

impl<T: Real> Point<T> {
    /// F and the fibre direction.
    ///
    /// # Errors
    /// F is null.
    ///
    /// # Safety
    /// What [a caller promises](super#what-a-caller-promises).
    #[inline(always)]
    pub(super) unsafe fn motion(&self) -> Result<Motion<'_, T>, Error> {
        // SAFETY: F is null or nine values, and so is the fibre with three.
        unsafe {
            let f = self.deformation_gradient.cast::<[[T; 3]; 3]>().as_ref();
            let fibre = if self.fibre.is_null() { None } else { Some(*self.fibre.cast::<[T; 3]>()) };
            Ok((f.ok_or(Error::Null { name: "deformation_gradient" })?, fibre))
        }
    }

    /// What the point has of its own: its fibre direction, and a limit beside a new state, where it is read. It is
    /// looked up where it is passed on: read with the other arrays, it would cost all calls a register.
    ///
    /// # Safety
    /// What [a caller promises](super#what-a-caller-promises).
    #[inline(always)]
    pub(super) unsafe fn own(&self, fibre: Option<[T; 3]>) -> Own<'_, T> {
        // SAFETY: null or one number, if there is a new state.
        Own { fibre, limit: if self.state_new.is_null() { None } else { unsafe { self.limit.as_ref() } } }
    }

    /// The sink for its results.
    #[inline(always)]
    pub(super) fn answer<'a>(&self, status: &'a mut i32) -> PointAnswer<'a, T> {
        let Point { state_new: state, stress, modes, wave_speed, tangent, .. } = *self;
        PointAnswer { stress, state, modes, density: T::splat(self.density), wave_speed, tangent, status }
    }
}

impl<T: Scalar> Point<T> {
    /// Calls `evaluate` with the point as a block of one, without its state: a structure of 500 bytes, which is not
    /// returned, since the processor would wait for each copy of it.
    ///
    /// # Errors
    /// An argument is wrong, or what `evaluate` finds.
    #[inline(always)]
    pub(super) fn as_points(&self, evaluate: impl FnOnce(Points<T>) -> Result<i32, Error>) -> Result<i32, Error> {
        let level = level(self.level)?;
        check_density::<T>(self.density, !self.wave_speed.is_null())?;
        let measure = measure_of(self.tangent, self.measure)?;
        evaluate(Points {
            f_new: components(self.deformation_gradient, 1),
            fibre: components(self.fibre, 1),
            limit: self.limit,
            density: T::splat(self.density),
            stress: components_mut(self.stress, 1),
            modes: self.modes,
            wave_speed: self.wave_speed,
            tangent: self.tangent,
            measure,
            level,
            ..Points::without_arrays(1, 1)
        })
    }
}

/// The sink for one point: the caller's arrays, those for a tangent included. What is null is not stored, except that
/// `tangent` must not be null if there is a tangent. Who makes one promises that the others have the values of one
/// point: 6, 11, 4 × 6, 1, and those of the tangent's measure, 36 or 81.
pub(in crate::host) struct PointAnswer<'a, T> {
    pub stress: *mut T,
    pub state: *mut T,
    pub modes: *mut T,
    pub density: T,
    pub wave_speed: *mut T,
    pub tangent: *mut T,
    pub status: &'a mut i32,
}

impl<'a, T: Real> PointAnswer<'a, T> {
    /// The status alone.
    #[inline(always)]
    pub fn nothing(status: &'a mut i32) -> Self {
        PointAnswer {
            stress: null_mut(),
            state: null_mut(),
            modes: null_mut(),
            density: T::splat(1.0),
            wave_speed: null_mut(),
            tangent: null_mut(),
            status,
        }
    }

    #[inline(always)]
    fn put(self, point: &response::Point<T>) {
        *self.status = point.status;
        // SAFETY: each array is null or has as many values as `PointAnswer` says.
        unsafe {
            store(&point.state, self.state);
            store(&point.stress, self.stress);
            if !self.modes.is_null() {
                *self.modes.cast() = point.modes;
            }
            if !self.wave_speed.is_null() {
                *self.wave_speed = wave_speed::wave_speed(point.wave_modulus, self.density);
            }
        }
    }
}

impl<T: Real> Sink<T, 0> for PointAnswer<'_, T> {
    #[inline(always)]
    fn take(self, point: response::Point<T>, _: Option<T>, _: [T; 0]) {
        self.put(&point);
    }
}

impl<T: Real> Sink<T, 21> for PointAnswer<'_, T> {
    #[inline(always)]
    fn take(self, point: response::Point<T>, _: Option<T>, moduli: [T; 21]) {
        // SAFETY: 36 values, which `PointAnswer` promises for this tangent.
        unsafe { *self.tangent.cast() = Moduli(moduli).matrix() };
        self.put(&point);
    }
}

impl<T: Real> Sink<T, 81> for PointAnswer<'_, T> {
    #[inline(always)]
    fn take(self, point: response::Point<T>, _: Option<T>, nominal: [T; 81]) {
        // SAFETY: 81 values, which `PointAnswer` promises for this tangent.
        unsafe { *self.tangent.cast() = nominal };
        self.put(&point);
    }
}

impl<T: Scalar> Block<T> {
    /// The layouts of all arrays.
    #[inline(always)]
    fn layouts(&self) -> [&Layout; 7] {
        [
            &self.deformation_gradient_layout,
            &self.fibre_layout,
            &self.state_layout,
            &self.stress_layout,
            &self.modes_layout,
            &self.tangent_layout,
            &self.limit_layout,
        ]
    }

    /// Whether all arrays are placed in the usual way: one pointer each, and one leading dimension for all. Most blocks
    /// are, and most calls have so few points that to look at every layout would take time.
    #[inline(always)]
    pub(super) fn is_plain(&self) -> bool {
        let (mut others, mut c) = (0, 0);
        let layouts = self.layouts();
        while c < layouts.len() {
            others |= layouts[c].leading_dimension | layouts[c].stride;
            c += 1;
        }
        others |= behind_first(&self.deformation_gradient) | behind_first(&self.fibre);
        let [_, s1, s2, s3, s4, s5] = self.stress;
        others |= s1.addr() | s2.addr() | s3.addr() | s4.addr() | s5.addr();
        others == 0 && self.leading_dimension <= MOST && self.n <= leading_dimension(self.leading_dimension, self.n)
    }

    /// Whether it is a single point, and requests what most callers do, the stress with or without the state, the wave
    /// speed and a tangent of 6×6, at a level whose lanes compute as a point on its own does.
    #[inline(always)]
    pub(super) fn is_usual_point(&self) -> bool {
        let no_state = self.energies.addr() | self.invariants.addr() | self.failure.addr() == 0;
        let state = !(self.energies.is_null() | self.invariants.is_null() | self.failure.is_null());
        let stress_alone = no_state & (self.failure_old.addr() | self.active.addr() | self.wave_speed.addr() == 0);
        let nominal = !self.tangent.is_null() && self.measure == TORON_TANGENT_NOMINAL;
        self.n == 1
            && !(self.deformation_gradient[0].is_null() | self.stress[0].is_null())
            && self.modes.is_null()
            && !nominal
            && state | stress_alone
            && self.level != TORON_LEVEL_BASELINE
            && has_fma()
    }

    /// What its only point has of its own.
    ///
    /// # Safety
    /// What [a caller promises](super#what-a-caller-promises), of a block of one point that [is plain](Self::is_plain).
    #[inline(always)]
    pub(super) unsafe fn own(&self) -> Own<'_, T> {
        let (m, next) = (self.fibre[0], leading_dimension(self.leading_dimension, 1));
        // SAFETY: a fibre that is not null is one array of three components; a limit is null, or the number of the only
        // point, if its failure is computed.
        unsafe {
            let fibre = if m.is_null() { None } else { Some([*m, *m.add(next), *m.add(2 * next)]) };
            Own { fibre, limit: if self.failure.is_null() { None } else { self.limit.as_ref() } }
        }
    }

    /// Checks what the law itself does not check, but for the layouts.
    #[inline(always)]
    pub(super) fn check(&self) -> Result<(), Error> {
        check_points(self.n)?;
        check_density::<T>(self.density, !self.wave_speed.is_null() && self.n > 0)?;
        level(self.level)?;
        if !self.tangent.is_null() {
            measure(self.measure)?;
        }
        Ok(())
    }

    /// Checks where the entries of the arrays are that have a pointer for each component; the law checks the others.
    pub(super) fn check_layouts(&self) -> Result<(), Error> {
        let (n, leading_dimension) = (self.n, leading_dimension(self.leading_dimension, self.n));
        let [f, fibre, stress] = [self.deformation_gradient_layout, self.fibre_layout, self.stress_layout];
        f.or(leading_dimension).check(
            &self.deformation_gradient,
            null(),
            n,
            "deformation_gradient, one of its components,",
            distances!("deformation_gradient"),
        )?;
        let component = "fibre, one of its components,";
        fibre.or(leading_dimension).check(&self.fibre, null(), n, component, distances!("fibre"))?;
        let component = "stress, one of its components,";
        stress.or(leading_dimension).check(&self.stress, null_mut(), n, component, distances!("stress"))
    }

    /// The block as the law takes it, if it [is plain](Self::is_plain).
    #[inline(always)]
    pub(super) fn plain_points(&self) -> Points<T> {
        let leading_dimension = leading_dimension(self.leading_dimension, self.n);
        Points {
            f_new: components(self.deformation_gradient[0], leading_dimension),
            fibre: components(self.fibre[0], leading_dimension),
            limit: self.limit,
            state_old: [self.energies_old, self.invariants_old, self.failure_old],
            state_new: [self.energies, self.invariants, self.failure],
            density: T::splat(self.density),
            stress: components_mut(self.stress[0], leading_dimension),
            modes: self.modes,
            wave_speed: self.wave_speed,
            tangent: self.tangent,
            measure: measure(self.measure).unwrap_or(Measure::Jaumann),
            status: self.status,
            active: self.active,
            level: level(self.level).unwrap_or(None),
            ..Points::without_arrays(self.n, leading_dimension)
        }
    }

    /// The block as the law takes it, whose layouts [have been checked](Self::check_layouts).
    pub(super) fn points(&self) -> Points<T> {
        let leading_dimension = leading_dimension(self.leading_dimension, self.n);
        let [f, fibre] = [self.deformation_gradient_layout, self.fibre_layout].map(|x| x.or(leading_dimension));
        let [state, stress] = [self.state_layout, self.stress_layout].map(|x| x.or(leading_dimension));
        let [modes, tangent] = [self.modes_layout, self.tangent_layout].map(|x| x.or(leading_dimension));
        Points {
            leading_dimension: state.leading_dimension,
            modes_leading_dimension: modes.leading_dimension,
            tangent_leading_dimension: tangent.leading_dimension,
            strides: Strides {
                deformation_gradient: f.stride,
                fibre: fibre.stride,
                limit: self.limit_layout.stride.max(1),
                state: state.stride,
                stress: stress.stride,
                modes: modes.stride,
                tangent: tangent.stride,
                ..Strides::UNIT
            },
            f_new: f.components(&self.deformation_gradient),
            fibre: fibre.components(&self.fibre),
            stress: stress.components_mut(&self.stress),
            ..self.plain_points()
        }
    }
}

/// 0 if no pointer behind the first one is set.
#[inline(always)]
fn behind_first<T, const N: usize>(components: &[*const T; N]) -> usize {
    let (mut others, mut c) = (0, 1);
    while c < N {
        others |= components[c].addr();
        c += 1;
    }
    others
}
