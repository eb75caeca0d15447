//! The linear elastic law: one point, blocks, strain increments, initial axes.

use core::mem::MaybeUninit;
use core::ptr::{null, null_mut};

use libc::size_t;

use super::arguments::{
    Layout, check_density, check_points, criterion, leading_dimension, level, measure_of, rotation,
};
use super::entry_points::of_points;
use super::structures::{read, structures};
use crate::law::block::{Points, Precision, Strides, at_fault, components, components_mut, distances};
use crate::law::error::{Error, Value};
use crate::law::interface::Law;
use crate::law::linear_elastic::LinearElastic;
use crate::law::number::real::Scalar;
use crate::law::state::LINEAR_ELASTIC_STATE;
use crate::law::status;

/// A point of the linear elastic law. Set `size`, and what is wanted; the rest is 0: an array that is null is left out,
/// and an output that is left out is not computed. The arrays of the old and the new state may be the same.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct LinearPoint<T> {
    /// The size of this structure.
    pub size: size_t,
    /// In: the frame that turns with the material, one of `TORON_ROTATION_...` (0, the fibre's, is right for a yarn),
    /// and the stress that is compared with the strength, one of `TORON_CRITERION_...`.
    pub rotation: i32,
    pub criterion: i32,
    /// In: which tangent, one of `TORON_TANGENT_...`; read if `tangent` is not null.
    pub measure: i32,
    /// In: the instruction set to use, one of `TORON_LEVEL_...`, as in `toron_block_f64`.
    pub level: i32,
    /// In: reference density; read if `wave_speed` is not null.
    pub density: f64,
    /// In, 9 each: F by columns at both ends of the step. Must not be null.
    pub f_old: *const T,
    pub f_new: *const T,
    /// In, 3 each, of any length: the fibre direction and the second material axis in the reference placement; if null,
    /// those of the properties. The second axis may be 0 if any will do. Not read for `TORON_ROTATION_SPIN`.
    pub fibre: *const T,
    pub second_axis: *const T,
    /// In and out, 9: the current material axes in global coordinates, one after the other. Must not be null for
    /// `TORON_ROTATION_SPIN`, and start with those of `toron_linear_elastic_axes_f64`; not used for the other frames.
    /// They are checked: with Q the matrix of the axes, `TORON_MATERIAL_AXES` is returned and nothing changed where the
    /// norm of QᵀQ − 1 exceeds 0.01; a smaller deviation is corrected.
    pub axes: *mut T,
    /// In, 10: the old state; if null, all 0.
    pub state_old: *const T,
    /// Out, 10: the new state. If null, the point does not fail, but stays failed if its old state has the flag set.
    pub state_new: *mut T,
    /// Out, 6: Cauchy stress in global axes, 11 22 33 12 23 31.
    pub stress: *mut T,
    /// Out, 1: an upper bound of the wave speed at the end of the step, to be used with current element lengths.
    pub wave_speed: *mut T,
    /// Out, 36 (81 for `TORON_TANGENT_NOMINAL`): the tangent consistent with the step, as in `toron_point_f64`, but not
    /// symmetric. `TORON_TANGENT_JAUMANN` gives the entries of Abaqus's DDSDDE, but in the order 11 22 33 12 23 31. It
    /// is computed in double precision, and so are then all other results.
    pub tangent: *mut T,
    /// In, 1: the strength, in place of that of the properties; if null or 0, that of the properties. Read if
    /// `state_new` is not null.
    pub limit: *const T,
}

/// A block of points of the linear elastic law. Set `size`, `n`, and what is wanted; the rest is 0: an array that is
/// null is left out, and an output that is left out is not computed.
///
/// Entries are placed as in `toron_block_f64`; the arrays hold what they hold in `toron_linear_point_f64`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct LinearBlock<T> {
    /// The size of this structure.
    pub size: size_t,
    /// The number of points.
    pub n: size_t,
    /// In numbers, from one component to the next; 0: n.
    pub leading_dimension: size_t,
    /// In: one of `TORON_ROTATION_...`, `TORON_CRITERION_...`, `TORON_TANGENT_...` and `TORON_LEVEL_...`.
    pub rotation: i32,
    pub criterion: i32,
    pub measure: i32,
    pub level: i32,
    /// In: reference density; read if `wave_speed` is not null.
    pub density: f64,
    /// In, 9 components each: F by columns at both ends of the step. The first must not be null.
    pub f_old: [*const T; 9],
    pub f_new: [*const T; 9],
    /// In, 3 components each: fibre direction and second axis of each point.
    pub fibre: [*const T; 3],
    pub second_axis: [*const T; 3],
    /// In and out, 9 components: the current material axes, for `TORON_ROTATION_SPIN`, which are checked as
    /// those of `toron_linear_point_f64`: the code of a point whose axes are not orthonormal is `TORON_MATERIAL_AXES`.
    pub axes: *mut T,
    /// In, 10 components: the old state; if null, all 0.
    pub state_old: *const T,
    /// Out, 10 components: the new state.
    pub state_new: *mut T,
    /// Out, 6 components: Cauchy stress in global axes, 11 22 33 12 23 31.
    pub stress: [*mut T; 6],
    /// Out, 36 components (81 for `TORON_TANGENT_NOMINAL`): the tangent.
    pub tangent: *mut T,
    /// Out, a number for each point: an upper bound of the wave speed.
    pub wave_speed: *mut T,
    /// Out, a number for each point: 1, or 0 if it has failed or cannot be evaluated.
    pub active: *mut T,
    /// Out, a number for each point: its status code.
    pub status: *mut i32,
    /// Where the entries of these arrays are. That of F holds for both ends, that of the fibre for the second axis too,
    /// that of the state for the old and the new one.
    pub deformation_gradient_layout: Layout,
    pub fibre_layout: Layout,
    pub axes_layout: Layout,
    pub state_layout: Layout,
    pub stress_layout: Layout,
    pub tangent_layout: Layout,
    /// In, a number for each point: the strength in place of that of the properties; if null or 0, that of the
    /// properties. Read if `state_new` is not null.
    pub limit: *const T,
    pub limit_layout: Layout,
}

/// A strain increment of the linear elastic law, in material axes that the caller updates. Set `size`, and what is
/// wanted; the rest is 0.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct LinearIncrement<T> {
    /// The size of this structure.
    pub size: size_t,
    /// In: one of `TORON_CRITERION_...`.
    pub criterion: i32,
    /// 0.
    pub reserved: i32,
    /// In: the volume ratio J, a factor of the work per reference volume; 0: 1, not known.
    pub jacobian: f64,
    /// In, 6: tensor components 11 22 33 12 23 31 (half the engineering shears) in the material axes. Must not be null.
    pub strain: *const T,
    /// In, 10: the old state; if null, all 0.
    pub state_old: *const T,
    /// Out, 10: the new state; null: it is not returned.
    pub state_new: *mut T,
    /// Out, 6: Cauchy stress in the material axes.
    pub stress: *mut T,
}

structures! {
    LinearPoint, "toron_linear_point_f64", "toron_linear_point_f32", "point";
    LinearBlock, "toron_linear_block_f64", "toron_linear_block_f32", "block";
    LinearIncrement, "toron_linear_increment_f64", "toron_linear_increment_f32", "increment";
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<LinearPoint<f64>>() == 4 * 8 + 11 * 8 && size_of::<LinearPoint<f32>>() == 4 * 8 + 11 * 8);
    assert!(size_of::<LinearBlock<f64>>() == 6 * 8 + 38 * 8 + 14 * 8);
    assert!(size_of::<LinearBlock<f32>>() == size_of::<LinearBlock<f64>>());
    assert!(size_of::<LinearIncrement<f64>>() == 7 * 8 && size_of::<LinearIncrement<f32>>() == 7 * 8);
};

/// Evaluates the law at a point, as a block of one. Returns its status.
///
/// # Errors
/// An argument is wrong, and nothing is written.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
pub unsafe fn point<T: Precision>(law: &LinearElastic<T>, point: *const LinearPoint<T>) -> Result<i32, Error> {
    let mut buffer = MaybeUninit::uninit();
    // SAFETY: `read` refuses null, and `step` an F that is; how long the arrays of the one point are the C caller
    // promises.
    unsafe {
        let point = read(point, &mut buffer)?;
        check_density::<T>(point.density, !point.wave_speed.is_null())?;
        law.step(&Points {
            f_old: components(point.f_old, 1),
            f_new: components(point.f_new, 1),
            fibre: components(point.fibre, 1),
            second_axis: components(point.second_axis, 1),
            limit: point.limit,
            axes: point.axes,
            state_old: LinearElastic::parts(point.state_old, 1),
            state_new: LinearElastic::parts_mut(point.state_new, 1),
            density: T::splat(point.density),
            stress: components_mut(point.stress, 1),
            wave_speed: point.wave_speed,
            tangent: point.tangent,
            measure: measure_of(point.tangent, point.measure)?,
            rotation: rotation(point.rotation)?,
            criterion: criterion(point.criterion)?,
            level: level(point.level)?,
            ..Points::without_arrays(1, 1)
        })
    }
}

impl<T: Precision> LinearBlock<T> {
    fn points(&self) -> Result<Points<T>, Error> {
        let leading_dimension = leading_dimension(self.leading_dimension, self.n);
        let (f, fibre) =
            (self.deformation_gradient_layout.or(leading_dimension), self.fibre_layout.or(leading_dimension));
        let (axes, state) = (self.axes_layout.or(leading_dimension), self.state_layout.or(leading_dimension));
        let (stress, tangent) = (self.stress_layout.or(leading_dimension), self.tangent_layout.or(leading_dimension));
        let n = self.n;
        check_points(n)?;
        check_density::<T>(self.density, !self.wave_speed.is_null() && n > 0)?;
        f.check(&self.f_old, null(), n, "f_old, one of its components,", distances!("f_old"))?;
        f.check(&self.f_new, null(), n, "f_new, one of its components,", distances!("f_new"))?;
        fibre.check(&self.fibre, null(), n, "fibre, one of its components,", distances!("fibre"))?;
        let component = "second_axis, one of its components,";
        fibre.check(&self.second_axis, null(), n, component, distances!("second_axis"))?;
        stress.check(&self.stress, null_mut(), n, "stress, one of its components,", distances!("stress"))?;
        Ok(Points {
            leading_dimension: state.leading_dimension,
            axes_leading_dimension: axes.leading_dimension,
            tangent_leading_dimension: tangent.leading_dimension,
            strides: Strides {
                deformation_gradient: f.stride,
                fibre: fibre.stride,
                limit: self.limit_layout.stride.max(1),
                axes: axes.stride,
                state: state.stride,
                stress: stress.stride,
                tangent: tangent.stride,
                ..Strides::UNIT
            },
            f_old: f.components(&self.f_old),
            f_new: f.components(&self.f_new),
            fibre: fibre.components(&self.fibre),
            second_axis: fibre.components(&self.second_axis),
            limit: self.limit,
            axes: self.axes,
            state_old: LinearElastic::parts(self.state_old, state.leading_dimension),
            state_new: LinearElastic::parts_mut(self.state_new, state.leading_dimension),
            density: T::splat(self.density),
            stress: stress.components_mut(&self.stress),
            wave_speed: self.wave_speed,
            tangent: self.tangent,
            measure: measure_of(self.tangent, self.measure)?,
            status: self.status,
            active: self.active,
            rotation: rotation(self.rotation)?,
            criterion: criterion(self.criterion)?,
            level: level(self.level)?,
            ..Points::without_arrays(n, leading_dimension)
        })
    }
}

/// Evaluates the law at the points of a block. Returns 0.
///
/// # Errors
/// An argument is wrong, and nothing is written; or the worst code of the points, with the first that has it.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
pub unsafe fn block<T: Precision>(law: &LinearElastic<T>, block: *const LinearBlock<T>) -> Result<i32, Error> {
    let mut buffer = MaybeUninit::uninit();
    // SAFETY: `read` refuses null, and `points` and `step` check the layouts; how long the arrays are the C caller
    // promises.
    unsafe {
        let block = read(block, &mut buffer)?;
        let points = block.points()?;
        let worst = law.step(&points)?;
        if worst == status::OK || !block.status.is_null() {
            return of_points(worst, block.status, block.n);
        }
        Err(at_fault(law, &points, worst).map_or(Error::Plain(worst), |index| Error::Point { code: worst, index }))
    }
}

/// `N` numbers in double precision, all 0 if there is no array.
///
/// # Safety
/// `from` is null or points to N values.
unsafe fn load<T: Scalar, const N: usize>(from: *const T) -> [f64; N] {
    let mut values = [0.0; N];
    if !from.is_null() {
        for (i, value) in values.iter_mut().enumerate() {
            // SAFETY: `from` is not null, as just checked, and i < N by the loop.
            *value = unsafe { *from.add(i) }.into();
        }
    }
    values
}

/// Copies numbers in double precision to the caller, unless `to` is null.
///
/// # Safety
/// `to` is null or has space for as many values.
unsafe fn store_rounded<T: Scalar>(values: &[f64], to: *mut T) {
    if !to.is_null() {
        for (i, &value) in values.iter().enumerate() {
            // SAFETY: `to` is not null, as just checked, and i counts the values that it has space for.
            unsafe { *to.add(i) = T::splat(value) };
        }
    }
}

/// The material axes in the undeformed state, along a point's own directions or, where these are null, the properties'.
/// Returns 0.
///
/// # Errors
/// There are no such axes, or nowhere to write them.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
pub unsafe fn axes<T: Scalar>(
    law: &LinearElastic<T>,
    fibre: *const T,
    second_axis: *const T,
    axes: *mut T,
) -> Result<i32, Error> {
    if axes.is_null() {
        return Err(Error::Null { name: "axes" });
    }
    // SAFETY: `axes` has nine values; `load` reads the three of a direction.
    unsafe {
        let mut law = law.lanes::<f64>();
        if !fibre.is_null() || !second_axis.is_null() {
            let own = law.reference_axes();
            let fibre = if fibre.is_null() { own.column(0).into() } else { load(fibre) };
            let second = if second_axis.is_null() { None } else { Some(load(second_axis)) };
            law = law.along(fibre, second)?;
        }
        store_rounded(law.reference_axes().as_slice(), axes);
    }
    Ok(status::OK)
}

/// Evaluates the law for a strain increment. Returns the point's status.
///
/// # Errors
/// An argument is wrong, and nothing is written.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
pub unsafe fn increment<T: Scalar>(law: &LinearElastic<T>, increment: *const LinearIncrement<T>) -> Result<i32, Error> {
    let mut buffer = MaybeUninit::uninit();
    // SAFETY: `read` refuses null, `strain` is checked, and `load` and `store_rounded` pass over null; the arrays are
    // as long as the C caller promises.
    unsafe {
        let increment = read(increment, &mut buffer)?;
        if increment.strain.is_null() {
            return Err(Error::Null { name: "strain" });
        }
        let criterion = criterion(increment.criterion)?;
        if increment.reserved != 0 {
            let (code, value) = (status::UNKNOWN_FIELD, i64::from(increment.reserved));
            return Err(Error::Range { code, name: "reserved", value, least: 0, greatest: 0 });
        }
        let jacobian = if increment.jacobian == 0.0 { 1.0 } else { increment.jacobian };
        if !(jacobian > 0.0 && jacobian.is_finite()) {
            let wanted = "a finite number > 0, or 0 if it is not known";
            return Err(Error::Argument { name: "jacobian", value: Value::of(jacobian), wanted });
        }
        let old: [f64; LINEAR_ELASTIC_STATE] = load(increment.state_old);
        let law = law.lanes::<f64>();
        let mut point = law.increment(&load(increment.strain), jacobian, &old, criterion);
        // Rounded to T, a number that does not fit is not finite.
        let fits = |values: &[f64]| values.iter().all(|&x| T::splat(x).into().is_finite());
        if !(fits(&point.stress) && fits(&point.state)) {
            point = law.kept(&old, status::OVERFLOW);
        }
        store_rounded(&point.state, increment.state_new);
        store_rounded(&point.stress, increment.stress);
        Ok(point.status)
    }
}
