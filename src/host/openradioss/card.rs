//! What starter and engine agree on: the numbers in UPARAM and the variables in UVAR.

use crate::law::block::Precision;
use crate::law::description::Description;
use crate::law::error::{Error, Value};
use crate::law::hyperelastic::Hyperelastic;
use crate::law::linear_elastic::{Criterion, LinearElastic, Rotation};
use crate::law::number::real::Scalar;

use super::laws::{Laws, Material, SolidLaw};

/// What the elements of these laws need, for the listing and for the message where F is missing.
pub const NEEDS: &str = "/PROP/TYPE14 (/PROP/SOLID) with Isolid = 1, Ismstr = 10, Iframe = 1";

/// `deleted` of a point that has failed, and of one whose element the solver or another point has taken out. Where a
/// point could not be evaluated, `deleted` is the negative status code.
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

/// The option that is that of toron's own laws, behind the others.
pub static OWN_OPTION: CardOption = CardOption {
    name: "limit_from",
    greatest: 1,
    allowed: "0 (the failure limit of the card), 1 (of each element, from its initial user variable limit, 16 of USER01, 24 of USER02, 20 of USER03; 0 there is that of the card)",
};

/// The names of the variables of an element's diagonal.
const DIAGONAL: [&str; 3] = ["diagonal_1", "diagonal_2", "diagonal_3"];

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
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    /// UPARAM(1), and nn of `/MAT/USERnn`.
    pub number: i32,
    pub law: &'static Description,
    /// How many of [`OPTIONS`] it has.
    pub options: usize,
    /// Whether [`OWN_OPTION`] follows them.
    pub has_own_option: bool,
}

/// The variables of the hyperelastic law, `/MAT/USER01`, and of the linear elastic law, `/MAT/USER02`.
pub static HYPERELASTIC: Layout = Layout::of::<f64, Hyperelastic<f64>>(1);

pub static LINEAR_ELASTIC: Layout = Layout::of::<f64, LinearElastic<f64>>(2);

impl Layout {
    /// The law as `/MAT/USERnn`.
    pub const fn of<T: Precision, L: SolidLaw<T>>(number: i32) -> Self {
        Layout { number, law: const { &L::DESCRIPTION }, options: L::OPTIONS, has_own_option: L::HAS_OWN_OPTION }
    }

    /// NUPARAM.
    pub const fn parameters(&self) -> usize {
        1 + self.law.properties.len() + self.options + self.has_own_option as usize
    }

    /// The options of the card, in their order.
    pub fn options(&self) -> impl Iterator<Item = &'static CardOption> {
        OPTIONS.iter().take(self.options).chain(self.has_own_option.then_some(&OWN_OPTION))
    }

    /// Indices into UVAR, from 0, behind the law's state: the fibre's three components of a law that has a fibre,
    /// `deleted`, and the nine of the old F.
    pub fn fibre(&self) -> usize {
        self.law.state.len()
    }

    /// The place among the user variables of the flag of a deleted element, and of F at the start of the step.
    pub fn deleted(&self) -> usize {
        self.fibre() + self.law.fibre_components().len()
    }

    pub fn f_old(&self) -> usize {
        self.deleted() + 1
    }

    /// Where the limit stands if the card asks for it.
    pub fn limit(&self) -> usize {
        self.f_old() + self.law.kept()
    }

    /// NUVAR without the limit: the element's diagonal comes last.
    pub fn variables(&self) -> usize {
        self.limit() + DIAGONAL.len()
    }

    /// The names of the variables between the state and the limit, in order.
    fn other_variables(&self) -> &'static [&'static str] {
        const NAMES: [&str; 13] = [
            "fibre_1", "fibre_2", "fibre_3", "deleted", "F11_old", "F21_old", "F31_old", "F12_old", "F22_old",
            "F32_old", "F13_old", "F23_old", "F33_old",
        ];
        let first = 3 - self.law.fibre_components().len();
        NAMES.get(first..first + self.limit() - self.law.state.len()).unwrap_or_default()
    }
}

/// The numbers of UPARAM, apart.
#[derive(Clone, Copy, Debug)]
pub struct Card<'a, T: Precision> {
    pub material: &'static Material<T>,
    pub properties: &'a [T],
    pub fibre_from: FibreFrom,
    pub rotation: Rotation,
    pub criterion: Criterion,
    /// Whether each element has a failure limit of its own.
    pub has_limits: bool,
}

impl<'a, T: Precision> Card<'a, T> {
    /// Reads what [`read`](super::starter::read) has written.
    ///
    /// # Errors
    /// There are other numbers: UPARAM of another library, or of another version.
    pub fn of(laws: &Laws<T>, uparam: &'a [T]) -> Result<Self, Error> {
        let (number, rest) = uparam.split_first().map_or((0, uparam), |(&number, rest)| (whole(number), rest));
        let material = laws.material(i32::try_from(number).unwrap_or(0))?;
        let layout = &material.layout;
        // Without the last option, which is 0 then, as callers have it that know of no limits.
        let least = layout.parameters() - usize::from(layout.has_own_option);
        if !(least..=layout.parameters()).contains(&uparam.len()) {
            let (found, wanted) = (uparam.len() as i64, layout.parameters() as i64);
            return Err(Error::Count { code: crate::law::status::PROPERTY_COUNT, what: "NUPARAM", found, wanted });
        }
        let (properties, options) = rest.split_at_checked(layout.law.properties.len()).unwrap_or((rest, &[]));
        Self::with_options(material, properties, options)
    }

    /// Which law it is, and where its numbers are.
    #[inline(always)]
    pub fn layout(&self) -> &'static Layout {
        &self.material.layout
    }

    /// The index into UVAR, from 0, of the element's diagonal as it is undeformed, by which F is checked: the last
    /// three variables.
    pub fn diagonal(&self) -> usize {
        self.layout().limit() + usize::from(self.has_limits)
    }

    /// NUVAR.
    pub fn variables(&self) -> usize {
        self.layout().variables() + usize::from(self.has_limits)
    }

    /// The name of a variable, from 0.
    pub fn variable(&self, place: usize) -> &'static str {
        let layout = self.layout();
        let state = layout.law.state.iter().map(|row| row.name);
        let limit = self.has_limits.then_some("limit");
        let behind = layout.other_variables().iter().copied().chain(limit).chain(DIAGONAL);
        state.chain(behind).nth(place).unwrap_or_default()
    }

    /// # Errors
    /// An option that has no meaning.
    fn with_options(material: &'static Material<T>, properties: &'a [T], options: &[T]) -> Result<Self, Error> {
        let layout = &material.layout;
        for (option, &value) in layout.options().zip(options) {
            if !(0..=option.greatest).contains(&whole(value)) {
                return Err(Error::Argument { name: option.name, value: Value::of(value), wanted: option.allowed });
            }
        }
        let chosen = |i: usize| if i < layout.options { options.get(i).map_or(0, |&value| whole(value)) } else { 0 };
        let own = options.get(layout.options).filter(|_| layout.has_own_option);
        let (fibre_from, frame, criterion) = (chosen(0), chosen(1), chosen(2));
        Ok(Card {
            material,
            properties,
            fibre_from: match fibre_from {
                0 => FibreFrom::Card,
                1 => FibreFrom::Nodes,
                _ => FibreFrom::InitialValues,
            },
            rotation: if frame == 0 { Rotation::Fibre } else { Rotation::Polar },
            criterion: if criterion == 0 { Criterion::LargestPrincipal } else { Criterion::FibreStress },
            has_limits: own.is_some_and(|&value| whole(value) == 1),
        })
    }
}

/// The whole number that `value` is, or −1.
fn whole<T: Scalar>(value: T) -> i64 {
    let value: f64 = value.into();
    let integer = value as i64;
    if integer as f64 == value { integer } else { -1 }
}
