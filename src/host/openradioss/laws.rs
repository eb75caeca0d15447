//! The laws that a library has, and what starter and engine call for each.

use crate::host::ByStep;
use crate::host::entry_points::stiffness_at_rest;
use crate::law::block::Precision;
use crate::law::error::Error;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::interface::Law;
use crate::law::linear_elastic::LinearElastic;
use crate::law::parameters::HYPERELASTIC_PROPERTIES;
use crate::law::response::Request;
use crate::law::state::HYPERELASTIC_STATE;

use super::card::{Card, Layout, OPTIONS};
use super::engine::Group;

/// A law as a material of solids.
pub trait SolidLaw<T: Precision>: Law<T> {
    /// How many of [`OPTIONS`] its card has: the first one is for a law with a fibre, the others for the linear elastic
    /// law.
    const OPTIONS: usize;

    /// Whether its card has [`OWN_OPTION`](super::card::OWN_OPTION) behind them.
    const HAS_OWN_OPTION: bool = false;

    /// ρ0 c² of the fastest wave in the unstressed material.
    ///
    /// # Errors
    /// A wrong property.
    fn modulus_at_rest(properties: &[T]) -> Result<T, Error>;

    /// Evaluates the law at a group that has been checked.
    ///
    /// # Errors
    /// A property that is wrong, a fibre direction that has no length.
    ///
    /// # Safety
    /// As for [`evaluate_material`](super::engine::evaluate_material).
    unsafe fn evaluate_group(group: &Group<T>, card: &Card<'_, T>) -> Result<(), Error>;
}

impl<L: ByStep + Law<T>, T: Precision> SolidLaw<T> for L {
    const OPTIONS: usize = if L::DESCRIPTION.has_fibre() { 1 } else { 0 };

    const HAS_OWN_OPTION: bool = L::HAS.limit;

    fn modulus_at_rest(properties: &[T]) -> Result<T, Error> {
        let [bulk, shear] = stiffness_at_rest(&L::new(properties)?)?.map(Into::into);
        Ok(T::splat(bulk + 4.0 * shear / 3.0))
    }

    unsafe fn evaluate_group(group: &Group<T>, card: &Card<'_, T>) -> Result<(), Error> {
        // SAFETY: the group is the caller's, and has been checked.
        unsafe { group.step::<Self>(card) }
    }
}

/// A law of a list.
#[derive(Clone, Copy, Debug)]
pub struct Material<T: Precision> {
    pub layout: Layout,
    pub(super) modulus_at_rest: fn(&[T]) -> Result<T, Error>,
    pub(super) evaluate_group: unsafe fn(&Group<T>, &Card<'_, T>) -> Result<(), Error>,
}

impl<T: Precision> Material<T> {
    /// The law as `/MAT/USERnn`.
    pub const fn of<L: SolidLaw<T>>(number: i32) -> Self {
        Material {
            layout: Layout::of::<T, L>(number),
            modulus_at_rest: L::modulus_at_rest,
            evaluate_group: L::evaluate_group,
        }
    }
}

/// The laws of a library.
#[derive(Clone, Copy, Debug)]
pub struct Laws<T: Precision> {
    pub materials: &'static [Material<T>],
    /// Their numbers in words, for the message where there is none of a number.
    pub allowed: &'static str,
    /// The greatest NUPARAM.
    pub most_parameters: usize,
}

impl<T: Precision> Laws<T> {
    /// A list of laws; `allowed` says in messages which numbers they have.
    pub const fn new(materials: &'static [Material<T>], allowed: &'static str) -> Self {
        let (mut most_parameters, mut i) = (0, 0);
        while i < materials.len() {
            let parameters = materials[i].layout.parameters();
            most_parameters = if parameters > most_parameters { parameters } else { most_parameters };
            i += 1;
        }
        Laws { materials, allowed, most_parameters }
    }

    /// The law of `/MAT/USERnn`.
    ///
    /// # Errors
    /// There is none of this number.
    pub fn material(&self, number: i32) -> Result<&'static Material<T>, Error> {
        let found = self.materials.iter().find(|material| material.layout.number == number);
        found.ok_or(Error::Choice { name: "nn of /MAT/USERnn", value: i64::from(number), wanted: self.allowed })
    }
}

/// The solver's real numbers, `my_real`, with the list of toron's own laws.
pub trait MyReal: Precision {
    /// The laws of the library in this precision.
    const TORON: Laws<Self>;
}

// An impl for each type and not a generic one, so that the groups are compiled in this crate and not in the crates that
// use it.
macro_rules! toron_laws {
    ($($t:ty)*) => {$(
        impl SolidLaw<$t> for Hyperelastic<$t> {
            const OPTIONS: usize = 1;

            const HAS_OWN_OPTION: bool = true;

            fn modulus_at_rest(properties: &[$t]) -> Result<$t, Error> {
                hyperelastic_modulus(properties)
            }

            unsafe fn evaluate_group(group: &Group<$t>, card: &Card<'_, $t>) -> Result<(), Error> {
                // SAFETY: the group is the caller's, and has been checked.
                unsafe { group.step::<Self>(card) }
            }
        }

        impl SolidLaw<$t> for LinearElastic<$t> {
            const OPTIONS: usize = OPTIONS.len();

            const HAS_OWN_OPTION: bool = true;

            fn modulus_at_rest(properties: &[$t]) -> Result<$t, Error> {
                Ok(LinearElastic::new(properties)?.lanes::<f64>().wave_modulus() as $t)
            }

            unsafe fn evaluate_group(group: &Group<$t>, card: &Card<'_, $t>) -> Result<(), Error> {
                // SAFETY: the group is the caller's, and has been checked.
                unsafe { group.step::<Self>(card) }
            }
        }

        crate::library_laws! { listed { $t; } }
    )*};
}

macro_rules! listed {
    ($t:ty;
        $first:ident {
            $first_name:literal, $first_title:literal, $first_symbol:literal, $first_behaviour:literal,
            user $first_user:literal, umat $first_umat:literal
        }
        $($law:ident {
            $name:literal, $title:literal, $symbol:literal, $behaviour:literal, user $user:literal, umat $umat:literal
        })*
    ) => {
        impl MyReal for $t {
            const TORON: Laws<$t> = Laws::new(
                &[Material::of::<crate::$first<$t>>($first_user), $(Material::of::<crate::$law<$t>>($user)),*],
                concat!(
                    $first_user, " (USER0", $first_user, ", ", $first_title, ")",
                    $(", ", $user, " (USER0", $user, ", ", $title, ")"),*
                ),
            );
        }
    };
}

toron_laws! { f64 f32 }

/// The modulus of the hyperelastic law at rest.
fn hyperelastic_modulus<T: Precision>(properties: &[T]) -> Result<T, Error> {
    Hyperelastic::new(properties)?; // an error names the value of the card, not its copy in double precision
    let values: [f64; HYPERELASTIC_PROPERTIES] = in_double_precision(properties);
    let rest = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let wanted = Request { wave_modulus: true, ..Request::default() };
    let point = Hyperelastic::new(&values)?.point_along(&rest, None, &[0.0; HYPERELASTIC_STATE], wanted);
    Ok(T::splat(point.wave_modulus))
}

fn in_double_precision<T: Precision, const N: usize>(properties: &[T]) -> [f64; N] {
    let mut values = [0.0; N];
    values.iter_mut().zip(properties).for_each(|(to, &from)| *to = from.into());
    values
}
