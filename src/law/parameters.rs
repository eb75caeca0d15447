//! The property tables of both laws and their presets, from which messages, the C interface, documents and decks are
//! made.

/// The physical dimension of a quantity, as exponents of mass, length and time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dimension {
    /// The exponents.
    pub mass: i32,
    pub length: i32,
    pub time: i32,
    /// How the dimension is written in tables.
    pub name: &'static str,
}

/// A number, and a stress.
pub const NUMBER: Dimension = Dimension { mass: 0, length: 0, time: 0, name: "-" };
pub const STRESS: Dimension = Dimension { mass: 1, length: -1, time: -2, name: "stress" };
/// Energy per reference volume has the dimension of a stress; the name distinguishes the two.
pub const ENERGY_DENSITY: Dimension = Dimension { mass: 1, length: -1, time: -2, name: "energy/volume" };
/// Mass per volume.
pub const DENSITY: Dimension = Dimension { mass: 1, length: -3, time: 0, name: "density" };

/// One property of a law.
#[derive(Debug, PartialEq)]
pub struct Property {
    /// The name in tables, decks and messages.
    pub name: &'static str,
    /// The symbol of the thesis.
    pub symbol: &'static str,
    /// Its unit follows from it and the system of units.
    pub dimension: Dimension,
    /// The default value; `None` if the user must give one.
    pub default: Option<f64>,
    /// The least allowed value, and whether that value itself is excluded.
    pub minimum: f64,
    pub minimum_excluded: bool,
    /// The greatest allowed value.
    pub maximum: f64,
    /// The allowed values in words.
    pub allowed: &'static str,
    /// What it is, in words.
    pub meaning: &'static str,
}

/// A row of the table for a property from 0 to 1e25.
pub const fn positive_or_zero(
    name: &'static str,
    symbol: &'static str,
    dimension: Dimension,
    default: Option<f64>,
    meaning: &'static str,
) -> Property {
    Property {
        name,
        symbol,
        dimension,
        default,
        minimum: 0.0,
        minimum_excluded: false,
        maximum: 1e25,
        allowed: "a number from 0 to 1e25",
        meaning,
    }
}

/// A row of the table for a property above 0, at most 1e25.
pub const fn positive(
    name: &'static str,
    symbol: &'static str,
    dimension: Dimension,
    default: Option<f64>,
    meaning: &'static str,
) -> Property {
    let zero_too = positive_or_zero(name, symbol, dimension, default, meaning);
    Property { minimum_excluded: true, allowed: "a number > 0, at most 1e25", ..zero_too }
}

/// A row of the table for a component of a direction.
pub const fn component(name: &'static str, symbol: &'static str, default: f64, meaning: &'static str) -> Property {
    Property {
        name,
        symbol,
        dimension: NUMBER,
        default: Some(default),
        minimum: f64::NEG_INFINITY,
        minimum_excluded: false,
        maximum: f64::INFINITY,
        allowed: "a finite number, not all three 0",
        meaning,
    }
}

/// Number of properties of the hyperelastic law.
pub const HYPERELASTIC_PROPERTIES: usize = 11;
/// Indices among the properties of the hyperelastic law: the strain at failure, the weights of multiaxial failure, and
/// the first component of the fibre direction.
pub const EPS_LIM: usize = place(&HYPERELASTIC, "eps_lim");
pub const ALPHA: usize = place(&HYPERELASTIC, "alpha");
pub const BETA: usize = place(&HYPERELASTIC, "beta");
pub const FIBRE: usize = place(&HYPERELASTIC, "m_1");

/// The properties of the hyperelastic law, in the order in which every host passes them (Eq. 4.10–4.15, section 4.4.2).
pub static HYPERELASTIC: [Property; HYPERELASTIC_PROPERTIES] = YARN;

const YARN: [Property; HYPERELASTIC_PROPERTIES] = [
    positive_or_zero("k_el", "k_el", STRESS, None, "longitudinal elongation stiffness"),
    positive_or_zero("k_tc", "k_tc", STRESS, None, "transverse compaction stiffness"),
    Property {
        name: "p",
        symbol: "p",
        dimension: NUMBER,
        default: None,
        minimum: 1.0,
        minimum_excluded: true,
        maximum: 40.0,
        allowed: "a number > 1, at most 40",
        meaning: "transverse compaction exponent",
    },
    positive_or_zero("k_td", "k_td", STRESS, None, "transverse distortion stiffness"),
    positive_or_zero("k_ld", "k_ld", STRESS, Some(0.0), "longitudinal shear stiffness, 0: fibres slip freely"),
    positive_or_zero("eps_lim", "ε_lim", NUMBER, Some(0.0), "engineering fibre strain at failure, 0: no failure"),
    positive_or_zero("alpha", "α", NUMBER, Some(0.0), "weight of compaction in multiaxial failure, 0: uniaxial"),
    positive_or_zero("beta", "β", NUMBER, Some(0.0), "weight of distortion in multiaxial failure, 0: uniaxial"),
    component("m_1", "m1", 1.0, "fibre direction in the reference placement, any length"),
    component("m_2", "m2", 0.0, "fibre direction in the reference placement, any length"),
    component("m_3", "m3", 0.0, "fibre direction in the reference placement, any length"),
];

/// Number of properties of the law with friction.
pub const FRICTIONAL_PROPERTIES: usize = 13;

/// The properties of the law with friction: those of the hyperelastic law, and the friction.
pub static FRICTIONAL: [Property; FRICTIONAL_PROPERTIES] = {
    let [k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, m_1, m_2, m_3] = YARN;
    let mu = Property {
        name: "mu",
        symbol: "µ",
        dimension: NUMBER,
        default: None,
        minimum: 0.0,
        minimum_excluded: false,
        maximum: MOST_FRICTION,
        allowed: "a number from 0 to below 1",
        meaning: "friction of the section: sine of its angle of friction",
    };
    let cohesion =
        positive_or_zero("cohesion", "c", STRESS, Some(0.0), "distortion stress that fibres hold without pressure");
    [k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, m_1, m_2, m_3, mu, cohesion]
};

/// The greatest number below 1, in both precisions.
const MOST_FRICTION: f64 = 1.0 - f32::EPSILON as f64 / 2.0;

/// Number of properties of the linear elastic law.
pub const LINEAR_ELASTIC_PROPERTIES: usize = 10;
/// Indices among the properties of the linear elastic law: the stress at failure, and the first components of the fibre
/// direction and of the second axis.
pub const SIGMA_LIM: usize = place(&LINEAR_ELASTIC, "sigma_lim");
pub(crate) const LINEAR_FIBRE: usize = place(&LINEAR_ELASTIC, "m_1");
pub(crate) const LINEAR_SECOND_AXIS: usize = place(&LINEAR_ELASTIC, "n_1");

/// The properties of the linear elastic orthotropic law (Tab. 4.4).
pub static LINEAR_ELASTIC: [Property; LINEAR_ELASTIC_PROPERTIES] = [
    positive_or_zero("e_1", "E1", STRESS, None, "Young's modulus along the fibre"),
    positive_or_zero("e_2", "E2", STRESS, None, "Young's modulus across the fibre, E2 = E3"),
    positive_or_zero("g", "G", STRESS, None, "shear modulus, G12 = G23 = G31"),
    positive_or_zero("sigma_lim", "σ_lim", STRESS, Some(0.0), "largest principal stress at failure, 0: no failure"),
    component("m_1", "m1", 1.0, "fibre direction in the reference placement, any length"),
    component("m_2", "m2", 0.0, "fibre direction in the reference placement, any length"),
    component("m_3", "m3", 0.0, "fibre direction in the reference placement, any length"),
    Property {
        allowed: "a finite number; all three 0: any axis across the fibre",
        ..component("n_1", "n1", 0.0, "second axis, made orthogonal to the fibre")
    },
    Property {
        allowed: "a finite number; all three 0: any axis across the fibre",
        ..component("n_2", "n2", 0.0, "second axis, made orthogonal to the fibre")
    },
    Property {
        allowed: "a finite number; all three 0: any axis across the fibre",
        ..component("n_3", "n3", 0.0, "second axis, made orthogonal to the fibre")
    },
];

/// Whether two names are the same, at compile time too.
pub const fn same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut i = 0;
    while i < a.len() && i < b.len() && a[i] == b[i] {
        i += 1;
    }
    i == a.len() && i == b.len()
}

/// The index of the property of this name; for constants: a name that the table does not have is an error at compile
/// time.
pub const fn place(table: &[Property], name: &str) -> usize {
    let mut i = 0;
    while !same(table[i].name, name) {
        i += 1;
    }
    i
}

/// A named set of properties in SI units, and the density of the same yarn.
#[derive(Debug)]
pub struct Preset {
    /// The name in files.
    pub name: &'static str,
    /// The properties of its law.
    pub properties: &'static [Property],
    /// One value for each of them.
    pub values: &'static [f64],
    /// Reference density in kg/m³.
    pub density: f64,
    /// Where the values come from.
    pub source: &'static str,
}

impl Preset {
    /// The rows of which `values` has the values.
    pub fn table(&self) -> &'static [Property] {
        self.properties
    }
}

/// The presets of the library.
pub static PRESETS: [Preset; 3] = [
    Preset {
        name: "kevlar-km2-600",
        properties: &HYPERELASTIC,
        values: &[82.341e9, 1.055e9, 2.2, 0.64974e9, 0.0, 0.0458, 1.8, 0.0, 1.0, 0.0, 0.0],
        density: 1351.4,
        source: "Kevlar KM2 600 denier: del Sorbo 2019, Tab. 4.3, 4.5 (multiaxial failure); woven: k_ld 5 to 20 MPa",
    },
    Preset {
        name: "kevlar-km2-600-linear",
        properties: &LINEAR_ELASTIC,
        values: &[79.414e9, 0.794e9, 0.126e9, 3.637e9, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        density: 1351.4,
        source: "Kevlar KM2 600 denier, 400 fibres: del Sorbo 2019, Tab. 4.4",
    },
    Preset {
        name: "kevlar-km2-600-frictional",
        properties: &FRICTIONAL,
        values: &[82.341e9, 1.055e9, 2.2, 0.64974e9, 0.0, 0.0458, 1.8, 0.0, 1.0, 0.0, 0.0, 0.15, 0.0],
        density: 1351.4,
        source: "Kevlar KM2 600 denier: del Sorbo 2019, Tab. 4.3, 4.5 (multiaxial failure); friction: fibre models",
    },
];

/// The preset of this name; `None` if there is none.
pub fn preset(name: &str) -> Option<&'static Preset> {
    PRESETS.iter().find(|preset| preset.name == name)
}
