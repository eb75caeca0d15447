//! From properties to a law: their check against the tables, and what is derived from them once.

use super::axes::FibreFrame;
use super::bounds::{check, checked, limits};
use super::error::{Error, Value};
use super::failure::Failure;
use super::hyperelastic::{self, Hyperelastic};
use super::linear_elastic::{self, LinearElastic, axes_of};
use super::number::elementary::{Exponent, power};
use super::number::real::Real;
use super::parameters::{
    self, FIBRE, HYPERELASTIC_PROPERTIES, LINEAR_ELASTIC_PROPERTIES, LINEAR_FIBRE, LINEAR_SECOND_AXIS,
};
use super::status;

impl<T> From<hyperelastic::Properties<T>> for [T; HYPERELASTIC_PROPERTIES] {
    fn from(properties: hyperelastic::Properties<T>) -> Self {
        let hyperelastic::Properties { k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, fibre: [m_1, m_2, m_3] } =
            properties;
        [k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, m_1, m_2, m_3]
    }
}

impl<T> From<[T; HYPERELASTIC_PROPERTIES]> for hyperelastic::Properties<T> {
    #[inline(always)]
    fn from([k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, m_1, m_2, m_3]: [T; HYPERELASTIC_PROPERTIES]) -> Self {
        hyperelastic::Properties { k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, fibre: [m_1, m_2, m_3] }
    }
}

impl<T: Real + Into<f64>> Hyperelastic<T> {
    /// Checks the properties and prepares the law.
    ///
    /// # Errors
    /// The first property that is wrong, with its value and what is allowed.
    pub fn with(properties: hyperelastic::Properties<T>) -> Result<Self, Error> {
        Self::new(&<[T; HYPERELASTIC_PROPERTIES]>::from(properties))
    }

    /// Checks the properties, in the order of [`parameters::HYPERELASTIC`], and prepares the law.
    ///
    /// # Errors
    /// The first property that is wrong, with its value and what is allowed.
    #[inline(always)]
    pub fn new(properties: &[T]) -> Result<Self, Error> {
        let mut law = Self::prepare(properties, &PropertyFrame::new(properties))?;
        law.failure = Self::prepare_failure(properties);
        Ok(law)
    }

    /// As [`new`](Self::new), given the frame of the fibre direction, but without failure, which
    /// [`prepare_failure`](Self::prepare_failure) prepares.
    ///
    /// # Errors
    /// The first property that is wrong, those of failure included.
    // A call for one point prepares the law every time. Inlined, each number is used as soon as it has been computed;
    // if the law were copied as a whole, all of them would have to be computed first.
    #[inline(always)]
    pub(super) fn prepare(properties: &[T], frame: &PropertyFrame<T>) -> Result<Self, Error> {
        let table = &parameters::HYPERELASTIC;
        let properties = checked(table, const { &limits(&parameters::HYPERELASTIC) }, properties)?;
        let &[k_el, k_tc, p, k_td, k_ld, _, _, _, m_1, m_2, m_3] = properties;
        if !frame.usable {
            return Err(Error::Direction {
                code: status::PROPERTY_DIRECTION,
                index: FIBRE,
                name: "fibre direction",
                value: [Value::of(m_1), Value::of(m_2), Value::of(m_3)],
                wanted: "any vector but zero",
            });
        }
        let one = T::splat(1.0);
        let exponent = Exponent::new(p - one);
        let [limited_below, limited_curvature] = curvature_limit(k_tc, p, &exponent);
        Ok(Hyperelastic {
            k_el,
            k_tc,
            p,
            k_td,
            k_ld,
            exponent,
            limited_below,
            limited_curvature,
            failure: Failure::none(),
            frame: frame.frame,
            aligned: frame.aligned,
            shears: T::splat(0.0).into() < k_ld.into(),
        })
    }

    /// ε_lim, α and β of properties that have been checked.
    #[inline(always)]
    pub(super) fn failure_properties(properties: &[T]) -> [T; 3] {
        match properties {
            &[_, _, _, _, _, eps_lim, alpha, beta, ..] => [eps_lim, alpha, beta],
            _ => [T::splat(0.0); 3], // not reached: their number has been checked
        }
    }

    /// The failure criterion from properties that have been checked.
    #[inline(always)]
    pub(super) fn prepare_failure(properties: &[T]) -> Failure<T> {
        let [eps_lim, alpha, beta] = Self::failure_properties(properties);
        Failure::new(eps_lim, alpha, beta)
    }
}

impl<R: Real> Hyperelastic<R> {
    /// The same law in another number type: each of its numbers in all lanes of `L`.
    #[inline(always)]
    pub(crate) fn lanes<L: Real>(&self) -> Hyperelastic<L>
    where
        R: Into<f64>,
    {
        let lane = |x: R| L::splat(x.into());
        let vector = |v: [R; 3]| [lane(v[0]), lane(v[1]), lane(v[2])];
        Hyperelastic {
            k_el: lane(self.k_el),
            k_tc: lane(self.k_tc),
            p: lane(self.p),
            k_td: lane(self.k_td),
            k_ld: lane(self.k_ld),
            exponent: self.exponent.map(lane),
            limited_below: lane(self.limited_below),
            limited_curvature: lane(self.limited_curvature),
            failure: self.failure.map(lane),
            frame: FibreFrame { m: vector(self.frame.m), t1: vector(self.frame.t1), t2: vector(self.frame.t2) },
            aligned: self.aligned,
            shears: self.shears,
        }
    }
}

/// The frame of the fibre direction among the properties.
#[derive(Clone, Copy, Debug)]
pub struct PropertyFrame<T> {
    pub frame: FibreFrame<T>,
    /// Whether the fibre lies along the first axis.
    pub aligned: bool,
    /// Whether the direction is finite and not zero.
    pub usable: bool,
}

impl<T: Real + Into<f64>> PropertyFrame<T> {
    #[inline(always)]
    pub fn new(properties: &[T]) -> Self {
        let direction = match properties {
            &[.., m_1, m_2, m_3] if properties.len() == HYPERELASTIC_PROPERTIES => [m_1, m_2, m_3],
            _ => [T::splat(0.0); 3], // a wrong number of properties, which `prepare` refuses
        };
        let [m_1, m_2, m_3]: [f64; 3] = [direction[0].into(), direction[1].into(), direction[2].into()];
        if m_2 == 0.0 && m_3 == 0.0 && m_1 >= T::MIN_POSITIVE {
            return PropertyFrame { frame: FibreFrame::first_axis(), aligned: true, usable: true };
        }
        let (frame, usable) = FibreFrame::new(direction);
        let usable = T::select(usable, T::splat(1.0), T::splat(0.0)).into() == 1.0;
        PropertyFrame { frame, aligned: false, usable }
    }
}

/// Below this compaction W″ is limited if p ≤ 2: for p < 2 it is infinite at 0.
const COMPACTION_FLOOR: f64 = 1e-8;

/// The compaction up to which W″ = p(p − 1) k_tc i^(p−2) is replaced by a constant, and that constant. For p > 2 it is
/// 0, and replaces W″ only where i^(p−1) underflows to 0 too, so that no quotient overflows.
#[inline(always)]
fn curvature_limit<T: Real + Into<f64>>(k_tc: T, p: T, exponent: &Exponent<T>) -> [T; 2] {
    if p.into() > 2.0 {
        return [T::splat(T::MIN_POSITIVE * f64::from(1 << 20)), T::splat(0.0)];
    }
    let floor = T::splat(COMPACTION_FLOOR);
    [floor, p * (p - T::splat(1.0)) * k_tc * power(floor, exponent) / floor]
}

impl<T> From<linear_elastic::Properties<T>> for [T; LINEAR_ELASTIC_PROPERTIES] {
    fn from(properties: linear_elastic::Properties<T>) -> Self {
        let linear_elastic::Properties { e_1, e_2, g, sigma_lim, fibre: [m_1, m_2, m_3], second_axis: [n_1, n_2, n_3] } =
            properties;
        [e_1, e_2, g, sigma_lim, m_1, m_2, m_3, n_1, n_2, n_3]
    }
}

impl<T> From<[T; LINEAR_ELASTIC_PROPERTIES]> for linear_elastic::Properties<T> {
    #[inline(always)]
    fn from([e_1, e_2, g, sigma_lim, m_1, m_2, m_3, n_1, n_2, n_3]: [T; LINEAR_ELASTIC_PROPERTIES]) -> Self {
        linear_elastic::Properties { e_1, e_2, g, sigma_lim, fibre: [m_1, m_2, m_3], second_axis: [n_1, n_2, n_3] }
    }
}

impl<T: Real<Mask = bool> + Into<f64>> LinearElastic<T> {
    /// Checks the properties, in the order of [`parameters::LINEAR_ELASTIC`], and prepares the law.
    ///
    /// # Errors
    /// The first property that is wrong, with its value and what is allowed.
    pub fn new(properties: &[T]) -> Result<Self, Error> {
        check(&parameters::LINEAR_ELASTIC, properties)?;
        let Ok(properties) = <&[T; LINEAR_ELASTIC_PROPERTIES]>::try_from(properties) else {
            return Err(Error::Plain(status::PROPERTY_COUNT)); // not reached: the count is checked
        };
        let linear_elastic::Properties { e_1, e_2, g, sigma_lim: limit, fibre, second_axis } = (*properties).into();
        let direction = |index, name, value: [T; 3], wanted| {
            let (code, value) = (status::PROPERTY_DIRECTION, value.map(Value::of));
            Err(Error::Direction { code, index, name, value, wanted })
        };
        let (frame, usable) = FibreFrame::new(fibre);
        if !usable {
            return direction(LINEAR_FIBRE, "fibre direction", fibre, "any vector but zero");
        }
        let (axes, usable) = axes_of(&frame, second_axis);
        if !usable {
            let wanted = "any vector that is not along the fibre, or zero";
            return direction(LINEAR_SECOND_AXIS, "second axis", second_axis, wanted);
        }
        let zero = T::splat(0.0);
        let second_axis = if is_zero(second_axis) { [zero; 3] } else { FibreFrame::new(second_axis).0.m };
        Ok(LinearElastic { stiffness: [e_1, e_2, e_2, g, g, g], limit, axes, second_axis })
    }

    /// The same law in another number type: each of its numbers in all lanes of `L`.
    #[inline(always)]
    pub(crate) fn lanes<L: Real>(&self) -> LinearElastic<L> {
        let lane = |x: T| L::splat(x.into());
        let vector = |v: [T; 3]| [lane(v[0]), lane(v[1]), lane(v[2])];
        let [e_1, e_2, e_3, g_12, g_23, g_31] = self.stiffness;
        LinearElastic {
            stiffness: [lane(e_1), lane(e_2), lane(e_3), lane(g_12), lane(g_23), lane(g_31)],
            limit: lane(self.limit),
            axes: [vector(self.axes[0]), vector(self.axes[1]), vector(self.axes[2])],
            second_axis: vector(self.second_axis),
        }
    }
}

/// Whether all components are 0.
fn is_zero<T: Real + Into<f64>>([x, y, z]: [T; 3]) -> bool {
    [x.into(), y.into(), z.into()] == [0.0; 3]
}
