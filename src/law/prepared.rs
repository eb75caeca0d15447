//! Prepared laws as plain numbers: a host may store them, copy them and send them to other processes, and a law comes
//! back from them without a check and without arithmetic.

use super::axes::FibreFrame;
use super::error::Error;
use super::failure::Failure;
use super::frictional::{Friction, Frictional};
use super::hyperelastic::Hyperelastic;
use super::kinematics::Strain;
use super::linear_elastic::LinearElastic;
use super::number::elementary::Exponent;
use super::number::real::{Real, Single};
use super::point::Source;
use super::preparation::PropertyFrame;

/// A prepared hyperelastic law: k_el, k_tc, p, k_td, k_ld, the numbers of the exponent, of W″ near zero compaction and
/// of the failure criterion, the axes m, t1 and t2, and 1 where the fibre lies along the first coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct PreparedHyperelastic<T>(pub [T; PreparedHyperelastic::<f64>::COUNT]);

/// A prepared linear elastic law: the six stiffnesses, the stress at failure, the three axes, and the second axis of
/// the properties as a unit vector, or 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct PreparedLinearElastic<T>(pub [T; PreparedLinearElastic::<f64>::COUNT]);

/// A prepared law with friction: the hyperelastic one, µ, c and 2/k_td.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct PreparedFrictional<T> {
    elastic: PreparedHyperelastic<T>,
    friction: [T; 3],
}

impl PreparedHyperelastic<f64> {
    pub(crate) const COUNT: usize = 26;
}

impl PreparedLinearElastic<f64> {
    pub(crate) const COUNT: usize = 19;
}

impl<T: Real + Into<f64>> From<&Hyperelastic<T>> for PreparedHyperelastic<T> {
    fn from(law: &Hyperelastic<T>) -> Self {
        let [q_1, q_2, q_3, q_4] = law.exponent.numbers();
        let [f_1, f_2, f_3, f_4, f_5] = law.failure.numbers();
        let FibreFrame { m: [m_1, m_2, m_3], t1: [s_1, s_2, s_3], t2: [t_1, t_2, t_3] } = law.frame;
        let aligned = T::splat(if law.aligned { 1.0 } else { 0.0 });
        PreparedHyperelastic([
            law.k_el,
            law.k_tc,
            law.p,
            law.k_td,
            law.k_ld,
            q_1,
            q_2,
            q_3,
            q_4,
            law.limited_below,
            law.limited_curvature,
            f_1,
            f_2,
            f_3,
            f_4,
            f_5,
            m_1,
            m_2,
            m_3,
            s_1,
            s_2,
            s_3,
            t_1,
            t_2,
            t_3,
            aligned,
        ])
    }
}

impl<T: Real + Into<f64>> PreparedHyperelastic<T> {
    /// The law that these numbers came from.
    #[inline(always)]
    pub(crate) fn law(&self) -> Hyperelastic<T> {
        let &PreparedHyperelastic(
            [
                k_el,
                k_tc,
                p,
                k_td,
                k_ld,
                q_1,
                q_2,
                q_3,
                q_4,
                limited_below,
                limited_curvature,
                f_1,
                f_2,
                f_3,
                f_4,
                f_5,
                ..,
            ],
        ) = self;
        let PropertyFrame { frame, aligned, .. } = self.frame();
        Hyperelastic {
            k_el,
            k_tc,
            p,
            k_td,
            k_ld,
            exponent: Exponent::from_numbers([q_1, q_2, q_3, q_4]),
            limited_below,
            limited_curvature,
            failure: Failure::from_numbers([f_1, f_2, f_3, f_4, f_5]),
            frame,
            aligned,
            shears: k_ld.into() > 0.0,
        }
    }
}

impl<T: Real> PreparedHyperelastic<T> {
    /// The same law, not known to have its fibre along the first axis: evaluated in the axes of any fibre, whose
    /// results differ from those of the first axis in the last digits.
    #[inline(always)]
    pub(crate) fn with_axes_of_any_fibre(self) -> Self {
        let PreparedHyperelastic(mut numbers) = self;
        numbers[PreparedHyperelastic::COUNT - 1] = T::splat(0.0);
        PreparedHyperelastic(numbers)
    }
}

impl<T: Real + Into<f64>> Source<T> for &PreparedHyperelastic<T> {
    #[inline(always)]
    fn frame(&self) -> PropertyFrame<T> {
        let &&PreparedHyperelastic([.., m_1, m_2, m_3, s_1, s_2, s_3, t_1, t_2, t_3, aligned]) = self;
        let frame = FibreFrame { m: [m_1, m_2, m_3], t1: [s_1, s_2, s_3], t2: [t_1, t_2, t_3] };
        PropertyFrame { frame, aligned: aligned.into() != 0.0, usable: true }
    }

    #[inline(always)]
    fn law(&self, _: &PropertyFrame<T>) -> Result<Hyperelastic<T>, Error> {
        Ok(PreparedHyperelastic::law(self))
    }

    fn whole(&self) -> Result<Hyperelastic<T>, Error> {
        Ok(PreparedHyperelastic::law(self))
    }

    #[inline(always)]
    fn power_and_failure<R: Single<T>>(&self, law: &Hyperelastic<R>, strain: &Strain<R>) -> (R, Failure<R>) {
        (law.compaction(strain).reduce(&law.exponent).finish(), law.failure)
    }
}

impl<T: Real + Into<f64>> From<&Frictional<T>> for PreparedFrictional<T> {
    fn from(law: &Frictional<T>) -> Self {
        PreparedFrictional { elastic: (&law.elastic).into(), friction: law.friction.numbers() }
    }
}

impl<T: Real + Into<f64>> PreparedFrictional<T> {
    /// The law that these numbers came from.
    #[inline(always)]
    pub(crate) fn law(&self) -> Frictional<T> {
        Frictional { elastic: self.elastic.law(), friction: Friction::from_numbers(self.friction) }
    }

    /// Whether the fibre lies along the first axis.
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    pub(crate) fn is_aligned(&self) -> bool {
        (&self.elastic).frame().aligned
    }

    /// Whether there is a longitudinal-shear stiffness.
    #[inline(always)]
    pub(crate) fn shears(&self) -> bool {
        let PreparedHyperelastic([_, _, _, _, k_ld, ..]) = self.elastic;
        k_ld.into() > 0.0
    }
}

impl<T: Real<Mask = bool> + Into<f64>> From<&LinearElastic<T>> for PreparedLinearElastic<T> {
    fn from(law: &LinearElastic<T>) -> Self {
        let [e_1, e_2, e_3, g_12, g_23, g_31] = law.stiffness;
        let [[m_1, m_2, m_3], [s_1, s_2, s_3], [t_1, t_2, t_3]] = law.axes;
        let [n_1, n_2, n_3] = law.second_axis;
        PreparedLinearElastic([
            e_1, e_2, e_3, g_12, g_23, g_31, law.limit, m_1, m_2, m_3, s_1, s_2, s_3, t_1, t_2, t_3, n_1, n_2, n_3,
        ])
    }
}

impl<T: Real<Mask = bool> + Into<f64>> PreparedLinearElastic<T> {
    /// The law that these numbers came from.
    pub(crate) fn law(&self) -> LinearElastic<T> {
        let &PreparedLinearElastic(
            [e_1, e_2, e_3, g_12, g_23, g_31, limit, m_1, m_2, m_3, s_1, s_2, s_3, t_1, t_2, t_3, n_1, n_2, n_3],
        ) = self;
        LinearElastic {
            stiffness: [e_1, e_2, e_3, g_12, g_23, g_31],
            limit,
            axes: [[m_1, m_2, m_3], [s_1, s_2, s_3], [t_1, t_2, t_3]],
            second_axis: [n_1, n_2, n_3],
        }
    }
}
