//! What starter and engine agree on: the numbers in UPARAM and the variables in UVAR.

use crate::law::description::{self, Description};
use crate::law::error::Error;
use crate::law::linear_elastic::{Criterion, Rotation};
use crate::law::number::real::Scalar;
use crate::law::parameters;

/// The most numbers that a law has in UPARAM.
pub const MOST_PARAMETERS: usize = 1 + parameters::LINEAR_ELASTIC_PROPERTIES + OPTIONS.len();

/// What the elements of these laws need, for the listing and for the message where F is missing.
pub const NEEDS: &str = "/PROP/TYPE14 (/PROP/SOLID) with Isolid = 1, Ismstr = 10, Iframe = 1";

/// `deleted` of a point that has failed, and of one whose element the solver or another point has taken out. Where a point could
/// not be evaluated, `deleted` is the negative status code.
pub const BY_FAILURE: f64 = 1.0;
pub const BY_SOLVER: f64 = 2.0;

/// An option of the card: its name, the greatest number, and the meaning of 0, 1, ….
pub struct CardOption {
    pub name: &'static str,
    pub greatest: i64,
    pub allowed: &'static str,
}

/// The options behind the properties; the hyperelastic law has the first one.
pub static OPTIONS: [CardOption; 3] = [
    CardOption {
        name: "fibre_from",
        greatest: 2,
        allowed: "0 (the fibre direction of the card), 1 (of each element, from its nodes), 2 (of each element, from its initial user variables)",
    },
    CardOption {
        name: "frame",
        greatest: 1,
        allowed: "0 (the material axes follow the fibre), 1 (they follow the polar rotation)",
    },
    CardOption {
        name: "criterion",
        greatest: 1,
        allowed: "0 (failure by the largest principal stress), 1 (by the stress along the fibre)",
    },
];

/// Where the fibre direction of a point comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FibreFrom {
    /// The properties: one direction for the material.
    Card,
    /// From the centre of nodes 1 to 4 to that of nodes 5 to 8 at time 0: two sections of the yarn.
    Nodes,
    /// UVAR as the model initialises it.
    InitialValues,
}

/// Which law a material has, and where its numbers are.
#[derive(Debug)]
pub struct Layout {
    /// UPARAM(1), and nn of `/MAT/USERnn`.
    pub number: i32,
    pub law: &'static Description,
    /// How many of [`OPTIONS`] it has.
    pub options: usize,
}

pub static HYPERELASTIC: Layout = Layout { number: 1, law: &description::HYPERELASTIC, options: 1 };

pub static LINEAR_ELASTIC: Layout = Layout { number: 2, law: &description::LINEAR_ELASTIC, options: OPTIONS.len() };

impl Layout {
    /// The law of `/MAT/USERnn`.
    ///
    /// # Errors
    /// There is none of this number.
    pub fn of(number: i32) -> Result<&'static Layout, Error> {
        [&HYPERELASTIC, &LINEAR_ELASTIC].into_iter().find(|layout| layout.number == number).ok_or(Error::Choice {
            name: "nn of /MAT/USERnn",
            value: i64::from(number),
            wanted: "1 (USER01, hyperelastic yarn law), 2 (USER02, linear elastic law)",
        })
    }

    /// NUPARAM.
    pub fn parameters(&self) -> usize {
        1 + self.law.properties.len() + self.options
    }

    /// Indices into UVAR, from 0, behind the law's state: the fibre's three components, `deleted`, and the nine of the old F.
    pub fn fibre(&self) -> usize {
        self.law.state.len()
    }

    pub fn deleted(&self) -> usize {
        self.fibre() + 3
    }

    pub fn f_old(&self) -> usize {
        self.deleted() + 1
    }

    /// NUVAR.
    pub fn variables(&self) -> usize {
        self.f_old() + self.law.kept()
    }

    /// The names of the variables behind the state, in order.
    pub fn other_variables(&self) -> &'static [&'static str] {
        const NAMES: [&str; 13] = [
            "fibre_1", "fibre_2", "fibre_3", "deleted", "F11_old", "F21_old", "F31_old", "F12_old", "F22_old",
            "F32_old", "F13_old", "F23_old", "F33_old",
        ];
        NAMES.split_at_checked(self.variables() - self.law.state.len()).map_or(&[], |(names, _)| names)
    }
}

/// The numbers of UPARAM, apart.
#[derive(Clone, Copy, Debug)]
pub struct Card<'a, T> {
    pub layout: &'static Layout,
    pub properties: &'a [T],
    pub fibre_from: FibreFrom,
    pub rotation: Rotation,
    pub criterion: Criterion,
}

impl<'a, T: Scalar> Card<'a, T> {
    /// Reads what [`read`](super::starter::read) has written.
    ///
    /// # Errors
    /// There are other numbers: UPARAM of another library, or of another version.
    pub fn of(uparam: &'a [T]) -> Result<Self, Error> {
        let (number, rest) = uparam.split_first().map_or((0, uparam), |(&number, rest)| (whole(number), rest));
        let layout = Layout::of(i32::try_from(number).unwrap_or(0))?;
        if uparam.len() != layout.parameters() {
            let (found, wanted) = (uparam.len() as i64, layout.parameters() as i64);
            return Err(Error::Count { code: crate::law::status::PROPERTY_COUNT, what: "NUPARAM", found, wanted });
        }
        let (properties, options) = rest.split_at_checked(layout.law.properties.len()).unwrap_or((rest, &[]));
        Self::with_options(layout, properties, options)
    }

    /// # Errors
    /// An option that has no meaning.
    pub fn with_options(layout: &'static Layout, properties: &'a [T], options: &[T]) -> Result<Self, Error> {
        let mut chosen = [0; OPTIONS.len()];
        for ((choice, option), &value) in chosen.iter_mut().zip(&OPTIONS).zip(options) {
            *choice = whole(value);
            if !(0..=option.greatest).contains(choice) {
                return Err(Error::Argument { name: option.name, value: value.into(), wanted: option.allowed });
            }
        }
        let [fibre_from, frame, criterion] = chosen;
        Ok(Card {
            layout,
            properties,
            fibre_from: match fibre_from {
                0 => FibreFrom::Card,
                1 => FibreFrom::Nodes,
                _ => FibreFrom::InitialValues,
            },
            rotation: if frame == 0 { Rotation::Fibre } else { Rotation::Polar },
            criterion: if criterion == 0 { Criterion::LargestPrincipal } else { Criterion::FibreStress },
        })
    }
}

/// The whole number that `value` is, or −1.
fn whole<T: Scalar>(value: T) -> i64 {
    let value: f64 = value.into();
    let integer = value as i64;
    if integer as f64 == value { integer } else { -1 }
}
