//! What a point may have of its own, in place of what the properties say, and what becomes of the law there: at a point
//! alone and in the lanes of a register.

use super::block::Points;
use super::failure::Failure;
use super::kinematics::Strain;
use super::number::real::{Lanes, Real, Single};
use super::response::Request;
use super::state::part::FAILURE;

/// What a point has of its own, where a host keeps it.
#[derive(Clone, Copy)]
pub(crate) struct Own<'a, T> {
    /// A fibre direction of any length.
    pub fibre: Option<[T; 3]>,
    /// ln(1 + ε_lim), or 0 for that of the properties. Read if failure is requested.
    pub limit: Option<&'a T>,
}

impl<T> Own<'_, T> {
    pub const NONE: Self = Own { fibre: None, limit: None };

    /// A fibre direction, or that of the properties, and nothing else.
    #[inline(always)]
    pub const fn along(fibre: Option<[T; 3]>) -> Self
    where
        T: Copy,
    {
        Own { fibre, limit: None }
    }

    /// The numbers, as far as what is requested depends on them.
    #[inline(always)]
    pub fn numbers<R: Single<T>>(&self, request: Request) -> OwnNumbers<R>
    where
        T: Real,
    {
        OwnNumbers { limit: if request.failure { self.limit.map(|&limit| R::of(limit)) } else { None } }
    }
}

/// The numbers that points have of their own, one for each lane.
#[derive(Clone, Copy)]
pub(crate) struct OwnNumbers<R> {
    /// ln(1 + ε_lim), or 0 for that of the properties.
    limit: Option<R>,
}

impl<R: Real> OwnNumbers<R> {
    pub const NONE: Self = OwnNumbers { limit: None };

    /// Those of the lanes from point i on.
    ///
    /// # Safety
    /// The points are valid, see [`Points`], with i + COUNT ≤ n.
    #[inline(always)]
    pub unsafe fn of_lanes<T>(points: &Points<T>, i: usize) -> Self
    where
        R: Lanes<T>,
    {
        let limited = !points.limits(FAILURE).is_null();
        // SAFETY: `limit` is not null; it has n ≥ i + COUNT values.
        OwnNumbers { limit: if limited { Some(unsafe { R::load(points.limit.add(i)) }) } else { None } }
    }

    /// Where all of them are allowed; `None` if there are none.
    #[inline(always)]
    pub fn are_allowed(&self) -> Option<R::Mask> {
        self.limit.map(Failure::is_limit)
    }

    /// Where `valid` holds and all of them are allowed.
    #[inline(always)]
    pub fn allowed(&self, valid: R::Mask) -> R::Mask {
        match self.are_allowed() {
            Some(allowed) => valid & allowed,
            None => valid,
        }
    }

    /// The failure index, given the law's criterion.
    #[inline(always)]
    pub fn failure_index(&self, failure: Failure<R>, strain: &Strain<R>) -> R {
        match self.limit {
            Some(limit) => failure.at(limit).index(strain),
            None => failure.index(strain),
        }
    }
}
