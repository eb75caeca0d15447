//! A scene: fibres, how they lie, what strikes them, and the cases that differ from one another. All in the scene's
//! units.

use std::path::PathBuf;

use serde::Deserialize;
use toron::host::units::UnitSystem;
use toron::law::parameters::Dimension;

/// The cases of a file, and what they have in common.
#[derive(Clone, Debug)]
pub struct Scene {
    pub title: String,
    pub units: UnitSystem,
    pub cases: Vec<Case>,
}

/// One run.
#[derive(Clone, Debug)]
pub struct Case {
    pub name: String,
    pub fibre: Fibre,
    /// From the plane of symmetry at mid-span to the clamp.
    pub half_length: f64,
    /// Between the beads of a fibre; a whole number of them makes the half length.
    pub spacing: f64,
    pub fibres: usize,
    pub outline: Outline,
    pub packing: Packing,
    pub contact: Contact,
    /// Coulomb's coefficient between fibres.
    pub friction: f64,
    pub striker: Striker,
    /// Of the projectile, or of the section that is driven; walls have none.
    pub speed: f64,
    pub end: f64,
    /// Time between two lines of the history.
    pub sample: f64,
    /// When the fibres are drawn, and their strain along the yarn is written.
    pub pictures: Vec<f64>,
    /// The step, as a part of the largest that is stable.
    pub step: f64,
    /// A history of `toron impact` that is drawn beside.
    pub law: Option<PathBuf>,
}

/// A fibre: a truss whose tension is linear in its stretch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fibre {
    pub diameter: f64,
    pub modulus: f64,
    pub density: f64,
    /// A truss that is stretched by this breaks; without it none does.
    pub strain_at_failure: Option<f64>,
}

impl Fibre {
    pub fn area(&self) -> f64 {
        std::f64::consts::FRAC_PI_4 * self.diameter * self.diameter
    }
}

/// What the section's fibres lie in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outline {
    /// An ellipse of this width over its height, as large as the fibres need.
    Aspect(f64),
    /// An ellipse of this width and height, into which they must go.
    Size([f64; 2]),
    /// A box of about this width over its height, whose walls they touch.
    Box(f64),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Packing {
    Hexagonal,
    /// As dense as fibres get that are stuck at random.
    Random {
        seed: u64,
    },
}

/// The force between fibres over the depth of their contact: a₁δ + a₂δ² + a₃δ³ on this length of fibre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    pub coefficients: [f64; 3],
    pub length: f64,
}

impl Contact {
    pub fn is_linear(&self) -> bool {
        self.coefficients[1..] == [0.0; 2]
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Striker {
    /// A rigid cylinder across the yarn.
    Cylinder {
        radius: f64,
        /// Of the whole projectile: half of it strikes the half that is computed.
        mass: f64,
        /// Whether it keeps its speed.
        held: bool,
        friction: f64,
        /// Of its contact with a fibre: force over depth, on the contact's length of fibre.
        stiffness: f64,
    },
    /// The middle of every fibre is moved; the speed comes in as half a cosine of this duration.
    Driven { ramp: f64 },
    /// Walls without friction press the section, from rest to rest as half a cosine, until this part of the way between
    /// two that close is gone. Beads are braked at this rate, over the frequency √(a₁/m) of a bead on a contact.
    Walls {
        walls: Walls,
        closing: f64,
        damping: f64,
        /// That the sides keep in a biaxial test, else 0.
        pressure: f64,
        /// Whether walls go back to where they were and close once more.
        reload: bool,
        law: Option<SectionLaw>,
    },
}

/// What a yarn's law says of its section: W_tc = k_tc ⟨−I_tc⟩^p and W_td = ½ k_td I_td².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionLaw {
    pub k_tc: f64,
    pub p: f64,
    pub k_td: f64,
}

impl SectionLaw {
    /// W_tc + W_td.
    pub fn energy(&self, [i_tc, i_td]: [f64; 2]) -> f64 {
        self.k_tc * (-i_tc).max(0.0).powf(self.p) + 0.5 * self.k_td * i_td * i_td
    }
}

/// The walls of a box around the section, and which of them close.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Walls {
    /// All four.
    AllSides,
    /// Top and bottom, between sides that are held.
    TopAndBottom,
    /// The sides, between top and bottom that are held.
    Sides,
    /// Top and bottom, and there are no sides.
    Plates,
    /// Top and bottom, between sides that keep a pressure, which has pressed the section from all sides before.
    Biaxial,
}

/// What two walls that face each other do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pair {
    Close,
    Stay,
    KeepPressure,
}

impl Walls {
    /// As the scene calls it.
    pub fn name(self) -> &'static str {
        match self {
            Walls::AllSides => "all-sides",
            Walls::TopAndBottom => "top-and-bottom",
            Walls::Sides => "sides",
            Walls::Plates => "plates",
            Walls::Biaxial => "biaxial",
        }
    }

    /// What the two walls across the yarn's width do, if they are there; and those across its height.
    pub fn pairs(self) -> [Option<Pair>; 2] {
        match self {
            Walls::AllSides => [Some(Pair::Close); 2],
            Walls::TopAndBottom => [Some(Pair::Stay), Some(Pair::Close)],
            Walls::Sides => [Some(Pair::Close), Some(Pair::Stay)],
            Walls::Plates => [None, Some(Pair::Close)],
            Walls::Biaxial => [Some(Pair::KeepPressure), Some(Pair::Close)],
        }
    }
}

/// The unit of the contact's coefficient of this power.
pub fn contact_dimension(power: usize) -> Dimension {
    Dimension { mass: 1, length: 1 - power as i32, time: -2, name: "contact coefficient" }
}

pub const MASS: Dimension = Dimension { mass: 1, length: 0, time: 0, name: "mass" };
