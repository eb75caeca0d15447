//! What both laws write: the stress in its measure, the tangent of its kind, the energy and the speed of sound.

use crate::law::response::nan_unless_finite;
use crate::law::status;
use crate::law::wave_speed::wave_speed;

use super::operator::{first_piola_kirchhoff, symmetric, unsymmetric};
use super::view::{BehaviourDataView, Options, StressMeasure};

/// The stress in the measure that is requested, before it is written.
#[derive(Clone, Copy)]
pub(super) enum Stress {
    Symmetric([f64; 6]),
    Unsymmetric([f64; 9]),
}

impl Stress {
    /// From the Cauchy stress 11 22 33 12 23 31; `second` gives the second Piola–Kirchhoff stress, in the same order.
    ///
    /// A stress of 0 stays 0 whatever F is: that of a point which has failed before may be any.
    #[inline(always)]
    pub fn new(
        measure: StressMeasure,
        cauchy: &[f64; 6],
        f: &[[f64; 3]; 3],
        second: impl FnOnce() -> [f64; 6],
    ) -> Self {
        match measure {
            StressMeasure::Cauchy => Stress::Symmetric(symmetric(*cauchy)),
            StressMeasure::SecondPiolaKirchhoff => Stress::Symmetric(symmetric(second())),
            StressMeasure::FirstPiolaKirchhoff if cauchy.iter().all(|&x| x == 0.0) => Stress::Unsymmetric([0.0; 9]),
            StressMeasure::FirstPiolaKirchhoff => Stress::Unsymmetric(unsymmetric(first_piola_kirchhoff(cauchy, f))),
        }
    }

    /// Whether all values are finite: those that are converted may overflow.
    #[inline(always)]
    pub fn is_finite(&self) -> bool {
        match self {
            Stress::Symmetric(values) => nan_unless_finite(values) == 0.0,
            Stress::Unsymmetric(values) => nan_unless_finite(values) == 0.0,
        }
    }
}

/// Where the results go.
#[derive(Clone, Copy)]
pub(super) struct Results<'a> {
    pub view: &'a BehaviourDataView,
    pub options: Options,
    /// Whether this is a plane hypothesis: then the first 4 components of a symmetric tensor count, and the first 5 of
    /// another one.
    pub plane: bool,
}

impl Results<'_> {
    /// Writes the new state of a step that is integrated, and its stress; whether its values are finite has been
    /// checked.
    ///
    /// # Safety
    /// The view is what [`BehaviourDataView`] says; arrays that are needed are not null.
    #[inline(always)]
    pub unsafe fn store_step<S: Copy>(&self, stress: &Stress, state: &S, energy: f64) {
        let s1 = &self.view.s1;
        // SAFETY: `integrate` has found these arrays not to be null, and the energy is checked; a stress has 6 or 9
        // values, in the plane 4 or 5, and the state is the law's.
        unsafe {
            match (stress, self.plane) {
                (Stress::Symmetric(values), false) => *s1.thermodynamic_forces.cast() = *values,
                (Stress::Unsymmetric(values), false) => *s1.thermodynamic_forces.cast() = *values,
                (&Stress::Symmetric([a, b, c, d, ..]), true) => *s1.thermodynamic_forces.cast() = [a, b, c, d],
                (&Stress::Unsymmetric([a, b, c, d, e, ..]), true) => *s1.thermodynamic_forces.cast() = [a, b, c, d, e],
            }
            *s1.internal_state_variables.cast() = *state;
            if !s1.stored_energy.is_null() {
                *s1.stored_energy = energy;
            }
        }
    }

    /// Writes a tangent of so many rows and columns in three dimensions, or the part of it that counts in the plane.
    ///
    /// # Safety
    /// As for [`store_step`](Self::store_step).
    #[inline(always)]
    pub unsafe fn store_operator<const COLUMNS: usize, const ROWS: usize>(&self, rows: &[[f64; COLUMNS]; ROWS]) {
        let in_plane = |count: usize| if count == 6 { 4 } else { 5 };
        // SAFETY: K is not null, and has as many values as the operator: ROWS × COLUMNS, or in the plane those of the
        // first 4 or 5.
        unsafe {
            if !self.plane {
                *self.view.k.cast() = *rows;
                return;
            }
            let width = in_plane(COLUMNS);
            for (r, row) in rows.iter().enumerate().take(in_plane(ROWS)) {
                for (c, &entry) in row.iter().enumerate().take(width) {
                    *self.view.k.add(width * r + c) = entry;
                }
            }
        }
    }

    /// Writes the speed of sound, if it is requested.
    ///
    /// # Safety
    /// As for [`store_step`](Self::store_step).
    #[inline(always)]
    pub unsafe fn store_speed(&self, modulus: f64) {
        if let Some(density) = self.options.density {
            // SAFETY: `Options::read` gives a density only where the speed has a place.
            unsafe { *self.view.speed_of_sound = wave_speed(modulus, density) };
        }
    }
}

/// The status of a point, given whether its converted results are finite.
#[inline(always)]
pub(super) fn status_of(code: i32, finite: bool) -> i32 {
    if code == status::OK && !finite { status::OVERFLOW } else { code }
}
