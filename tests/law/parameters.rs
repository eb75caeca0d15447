//! Properties: what is refused and in which words, the tables, the presets, and their units.

use std::collections::HashSet;

use toron::host::units::UnitSystem;
use toron::law::description;
use toron::law::linear_elastic::{self, LinearElastic};
use toron::law::parameters::{
    self, DENSITY, HYPERELASTIC, HYPERELASTIC_PROPERTIES, LINEAR_ELASTIC, LINEAR_ELASTIC_PROPERTIES, NUMBER, PRESETS,
    STRESS, preset,
};
use toron::law::prepared::{PreparedHyperelastic, PreparedLinearElastic};
use toron::law::state::{self, StateVariable};
use toron::law::status;
use toron::{Error, Value};
use toron::{Hyperelastic, Properties};

const YARN: [f64; HYPERELASTIC_PROPERTIES] = [82.341e9, 1.055e9, 2.2, 0.64974e9, 0.0, 0.0458, 1.8, 0.0, 1.0, 0.0, 0.0];
const LINEAR: [f64; LINEAR_ELASTIC_PROPERTIES] = [79.414e9, 0.794e9, 0.126e9, 3.637e9, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0];

/// The refusal of the properties with one of them changed.
fn hyperelastic(index: usize, value: f64) -> Error {
    let mut properties = YARN;
    properties[index] = value;
    Hyperelastic::<f64>::new(&properties).expect_err("to be refused")
}

fn linear(index: usize, value: f64) -> Error {
    let mut properties = LINEAR;
    properties[index] = value;
    LinearElastic::new(&properties).expect_err("to be refused")
}

fn assert_error(error: Error, code: i32, message: &str) {
    assert_eq!(error.code(), code);
    assert_eq!(error.to_string(), message);
}

#[test]
fn count() {
    for (found, message) in
        [(0, "number of properties: 0 given, 11 needed"), (10, "number of properties: 10 given, 11 needed")]
    {
        assert_error(Hyperelastic::<f64>::new(&YARN[..found]).unwrap_err(), status::PROPERTY_COUNT, message);
    }
    let too_many = [YARN.as_slice(), &[0.0]].concat();
    let message = "number of properties: 12 given, 11 needed";
    assert_error(Hyperelastic::<f64>::new(&too_many).unwrap_err(), status::PROPERTY_COUNT, message);
    let message = "number of properties: 9 given, 10 needed";
    assert_error(LinearElastic::new(&LINEAR[..9]).unwrap_err(), status::PROPERTY_COUNT, message);
}

#[test]
fn messages_name_the_property_its_value_and_what_is_allowed() {
    let (bounds, finite) = (status::PROPERTY_OUT_OF_BOUNDS, status::PROPERTY_NOT_FINITE);
    let cases = [
        (
            0,
            -1.0,
            bounds,
            "property 1 (k_el, longitudinal elongation stiffness) is -1.0; allowed: a number from 0 to 1e25",
        ),
        (
            1,
            -1e9,
            bounds,
            "property 2 (k_tc, transverse compaction stiffness) is -1000000000.0; allowed: a number from 0 to 1e25",
        ),
        (2, 1.0, bounds, "property 3 (p, transverse compaction exponent) is 1.0; allowed: a number > 1, at most 40"),
        (2, 40.5, bounds, "property 3 (p, transverse compaction exponent) is 40.5; allowed: a number > 1, at most 40"),
        (2, 0.5, bounds, "property 3 (p, transverse compaction exponent) is 0.5; allowed: a number > 1, at most 40"),
        (
            3,
            f64::NAN,
            finite,
            "property 4 (k_td, transverse distortion stiffness) is NaN; allowed: a number from 0 to 1e25",
        ),
        (
            4,
            -0.25,
            bounds,
            "property 5 (k_ld, longitudinal shear stiffness, 0: fibres slip freely) is -0.25; \
             allowed: a number from 0 to 1e25",
        ),
        (
            5,
            f64::INFINITY,
            finite,
            "property 6 (eps_lim, engineering fibre strain at failure, 0: no failure) is infinity; allowed: a number from 0 to 1e25",
        ),
        (
            6,
            -1.8,
            bounds,
            "property 7 (alpha, weight of compaction in multiaxial failure, 0: uniaxial) is -1.8; \
             allowed: a number from 0 to 1e25",
        ),
        (
            7,
            -5e-324,
            bounds,
            "property 8 (beta, weight of distortion in multiaxial failure, 0: uniaxial) is -5e-324; \
             allowed: a number from 0 to 1e25",
        ),
        (
            9,
            f64::NEG_INFINITY,
            finite,
            "property 10 (m_2, fibre direction in the reference placement, any length) is -infinity; \
             allowed: a finite number, not all three 0",
        ),
    ];
    for (index, value, code, message) in cases {
        assert_error(hyperelastic(index, value), code, message);
    }
    let message = "property 3 (g, shear modulus, G12 = G23 = G31) is -0.126; allowed: a number from 0 to 1e25";
    assert_error(linear(2, -0.126), bounds, message);
    let message = "property 9 (n_2, second axis, made orthogonal to the fibre) is NaN; \
                   allowed: a finite number; all three 0: any axis across the fibre";
    assert_error(linear(8, f64::NAN), finite, message);
}

/// Every property of both laws refuses NaN and infinities, and, where it is bounded, what lies below or above.
#[test]
fn every_property_is_checked() {
    type Refusal = fn(usize, f64) -> Error;
    for (table, refusal) in [(&HYPERELASTIC[..], hyperelastic as Refusal), (&LINEAR_ELASTIC[..], linear as Refusal)] {
        for (index, property) in table.iter().enumerate() {
            for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let error = refusal(index, value);
                assert_eq!(error.code(), status::PROPERTY_NOT_FINITE, "{}", property.name);
                assert!(error.to_string().contains(&format!("({}, ", property.name)));
            }
            if property.minimum.is_finite() {
                for value in [property.minimum.next_down(), property.maximum.next_up(), f64::MAX] {
                    let error = refusal(index, value);
                    assert_eq!(error.code(), status::PROPERTY_OUT_OF_BOUNDS, "{}", property.name);
                    assert!(error.to_string().ends_with(property.allowed), "{error}");
                }
            }
        }
    }
}

#[test]
fn single_precision_refuses_the_same() {
    let mut properties = YARN.map(|x| x as f32);
    properties[2] = 1.0;
    let message = "property 3 (p, transverse compaction exponent) is 1.0; allowed: a number > 1, at most 40";
    assert_error(Hyperelastic::<f32>::new(&properties).unwrap_err(), status::PROPERTY_OUT_OF_BOUNDS, message);
    properties[2] = f32::NAN;
    assert_eq!(Hyperelastic::<f32>::new(&properties).unwrap_err().code(), status::PROPERTY_NOT_FINITE);
}

/// In the digits that the caller has written: 0.1 in single precision is 0.10000000149011612.
#[test]
fn messages_have_the_digits_of_the_caller_s_precision() {
    let beta = "property 8 (beta, weight of distortion in multiaxial failure, 0: uniaxial) is -0.1; allowed: a number from 0 to 1e25";
    let mut properties = YARN;
    properties[7] = -0.1;
    let single = properties.map(|x| x as f32);
    assert_error(Hyperelastic::<f64>::new(&properties).unwrap_err(), status::PROPERTY_OUT_OF_BOUNDS, beta);
    assert_error(Hyperelastic::<f32>::new(&single).unwrap_err(), status::PROPERTY_OUT_OF_BOUNDS, beta);
    // What is that number in double precision has its digits there.
    properties[7] = (-0.1_f32).into();
    let digits = beta.replace("-0.1;", "-0.10000000149011612;");
    assert_error(Hyperelastic::<f64>::new(&properties).unwrap_err(), status::PROPERTY_OUT_OF_BOUNDS, &digits);

    let mut parallel = LINEAR.map(|x| x as f32);
    parallel[4..7].copy_from_slice(&[0.1, 0.2, 0.3]);
    parallel[7..].copy_from_slice(&[0.1, 0.2, 0.3]);
    let message =
        "properties 8 to 10 (second axis) are 0.1, 0.2, 0.3; allowed: any vector that is not along the fibre, or zero";
    assert_error(LinearElastic::<f32>::new(&parallel).unwrap_err(), status::PROPERTY_DIRECTION, message);
    let law = Hyperelastic::<f32>::new(&YARN.map(|x| x as f32)).expect("good");
    let message = "argument limit is -0.1; allowed: a finite number, not negative";
    assert_error(law.with_limit(-0.1).unwrap_err(), status::BAD_ARGUMENT, message);
    for (value, text) in [(1e-45, "1e-45"), (f32::MAX, "3.4028235e38"), (f32::NAN, "NaN"), (f32::INFINITY, "infinity")]
    {
        let error = Error::Argument { name: "x", value: Value::of(value), wanted: "nothing" };
        assert_eq!(error.to_string(), format!("argument x is {text}; allowed: nothing"));
    }
}

#[test]
fn directions() {
    let message = "properties 9 to 11 (fibre direction) are 0.0, 0.0, 0.0; allowed: any vector but zero";
    assert_error(hyperelastic(8, 0.0), status::PROPERTY_DIRECTION, message);
    let message = "properties 5 to 7 (fibre direction) are 0.0, 0.0, 0.0; allowed: any vector but zero";
    assert_error(linear(4, 0.0), status::PROPERTY_DIRECTION, message);

    for along in [[2.0, 0.0, 0.0], [-1e-9, 0.0, 0.0], [1.0, 1e-5, 0.0]] {
        let mut properties = LINEAR;
        properties[7..].copy_from_slice(&along);
        let error = LinearElastic::new(&properties).expect_err("parallel");
        assert_eq!(error.code(), status::PROPERTY_DIRECTION, "{along:?}");
    }
    let message = "properties 8 to 10 (second axis) are 2.0, 0.0, 0.0; \
                   allowed: any vector that is not along the fibre, or zero";
    assert_error(linear(7, 2.0), status::PROPERTY_DIRECTION, message);

    // Very long and very short vectors are directions too.
    for length in [1e-300, 1e-100, 1e100, 1e300] {
        let mut properties = YARN;
        properties[8..].copy_from_slice(&[length, -length, length]);
        assert!(Hyperelastic::<f64>::new(&properties).is_ok(), "{length:e}");
    }
}

#[test]
fn tables() {
    fn names<'a>(rows: impl Iterator<Item = &'a str>) {
        let mut seen = HashSet::new();
        for name in rows {
            assert!(seen.insert(name), "{name} stands twice");
            assert!(name.bytes().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == b'_'), "{name}");
        }
        assert!(!seen.is_empty());
    }
    names(HYPERELASTIC.iter().map(|row| row.name));
    names(LINEAR_ELASTIC.iter().map(|row| row.name));
    names(status::TABLE.iter().map(|row| row.1));
    let states: [&[StateVariable]; 2] = [&state::HYPERELASTIC, &state::LINEAR_ELASTIC];
    for table in states {
        names(table.iter().map(|row| row.name));
    }

    let places = [(state::ENERGIES, "w_el"), (state::INVARIANTS, "i_el"), (state::FAILURE_INDEX, "failure_index")];
    for (place, name) in places.into_iter().chain([(state::FAILED, "failed"), (state::ALIVE, "alive")]) {
        assert_eq!(state::HYPERELASTIC[place].name, name);
    }
    let places = [(state::LINEAR_STRESS, "s_11"), (state::LINEAR_LARGEST, "s_max"), (state::LINEAR_WORK, "work")];
    for (place, name) in places.into_iter().chain([(state::LINEAR_FAILED, "failed"), (state::LINEAR_ALIVE, "alive")]) {
        assert_eq!(state::LINEAR_ELASTIC[place].name, name);
    }
    for table in [HYPERELASTIC.as_slice(), LINEAR_ELASTIC.as_slice()] {
        for property in table {
            assert!(property.default.is_none_or(|value| value >= property.minimum), "{}", property.name);
        }
    }
}

#[test]
fn status_codes() {
    let codes = status::TABLE.map(|row| row.0);
    assert_eq!(HashSet::from(codes).len(), codes.len(), "a code stands twice");
    for (code, name, meaning) in status::TABLE {
        assert!(code == status::OK || (-399..=-101).contains(&code));
        assert_eq!((status::name(code), status::meaning(code)), (Some(name), Some(meaning)));
        assert_eq!(Error::Plain(code).to_string(), meaning);
    }
    assert_eq!(status::name(-999), None);
    assert_eq!(Error::Plain(-999).to_string(), "no such status code: -999");
    let argument = Error::Argument { name: "density", value: Value::Double(0.0), wanted: "a finite number > 0" };
    assert_error(argument, status::BAD_ARGUMENT, "argument density is 0.0; allowed: a finite number > 0");
}

#[test]
fn presets() {
    assert_eq!(preset("kevlar-km2-600").expect("known").values, YARN);
    assert_eq!(preset("kevlar-km2-600-linear").expect("known").values, LINEAR);
    assert!(preset("kevlar").is_none());
    assert!(Hyperelastic::<f64>::new(&YARN).is_ok() && Hyperelastic::<f32>::new(&YARN.map(|x| x as f32)).is_ok());
    assert!(LinearElastic::new(&LINEAR).is_ok());
    let names = PRESETS.iter().map(|preset| preset.name).collect::<HashSet<_>>();
    assert_eq!(names.len(), PRESETS.len());
    for preset in &PRESETS {
        assert!(toron::law::bounds::check(preset.table(), preset.values).is_ok(), "{}", preset.name);
        assert_eq!(preset.density, 1351.4);
    }
}

/// Decimal systems convert without a rounding of their own: 82.341 GPa keeps its digits; 1351.4 kg/m³, whose last
/// digit is rounded before and after, keeps them to one unit in the last place.
#[test]
fn units() {
    let cases: [(&str, f64, f64); 8] = [
        ("si", 82.341e9, 1351.4),
        ("m-kg-s", 82.341e9, 1351.4),
        ("mm-tonne-s", 82341.0, 1.3514e-9),
        ("mm-t-s", 82341.0, 1.3514e-9),
        ("mm-kg-ms", 82.341, 1.3514e-6),
        ("mm-g-ms", 82341.0, 1.3514e-3),
        ("cm-g-us", 0.82341, 1.3514),
        ("um-mg-us", 0.082341, 1.3514e-9),
    ];
    for (name, modulus, density) in cases {
        let system = UnitSystem::parse(name).expect(name);
        assert_eq!(system.from_si(82.341e9, STRESS), modulus, "{name}");
        let converted = system.from_si(1351.4, DENSITY);
        assert!((density.next_down()..=density.next_up()).contains(&converted), "{name}: {converted:e}");
        assert_eq!(system.from_si(2.2, NUMBER), 2.2, "{name}");
    }
}

/// The inch systems: 1 psi = 6894.757293168361 Pa, a slinch is lbf s²/in, a slug lbf s²/ft.
#[test]
fn inch_and_foot() {
    let relative = |x: f64, y: f64| (x / y - 1.0).abs();
    let inch = UnitSystem::parse("in-slinch-s").expect("known");
    assert!(relative(inch.from_si(82.341e9, STRESS), 82.341e9 / 6894.757293168361) < 1e-15);
    // Water, 1000 kg/m³, is 62.42796 lb/ft³ and 9.357255e-5 slinch/in³.
    assert!(relative(inch.from_si(1000.0, DENSITY), 9.357254687402184e-5) < 1e-14);
    let foot = UnitSystem::parse("ft-slug-s").expect("known");
    assert!(relative(foot.from_si(6894.757293168361, STRESS), 144.0) < 1e-14);
}

#[test]
fn names_of_unit_systems() {
    let parse = UnitSystem::parse;
    assert_eq!(parse(" SI "), Some(UnitSystem::SI));
    assert_eq!(parse("s, kg, m"), Some(UnitSystem::SI), "in any order");
    assert_eq!(parse("tonne-mm-s").map(|system| system.names()), Some(["mm", "tonne", "s"]));
    for name in ["", "mm", "mm-kg", "mm-kg-parsec", "mm-cm-s", "mm-kg-ms-s", "mm kg ms"] {
        assert_eq!(parse(name), None, "{name}");
    }
}

/// The texts of the tables fit the characters that the C interface has for them, the terminating null included.
#[test]
fn texts_fit_the_rows_of_the_c_interface() {
    let properties = parameters::HYPERELASTIC.iter().chain(&parameters::LINEAR_ELASTIC);
    let properties = properties.map(|row| (row.name, row.symbol, row.dimension.name, row.allowed, row.meaning));
    let variables = state::HYPERELASTIC.iter().chain(&state::LINEAR_ELASTIC);
    let variables = variables.map(|row| (row.name, row.symbol, row.dimension.name, "", row.meaning));
    for (name, symbol, unit, allowed, meaning) in properties.chain(variables) {
        assert!(name.len() < 24 && symbol.len() < 24 && unit.len() < 24, "{name}");
        assert!(allowed.len() < 80 && meaning.len() < 100, "{name}");
    }
}

/// The numbers of a prepared law in their order: if they or their meaning change, so must the tag in
/// `c/functions/src/prepared.rs`.
#[test]
fn prepared_laws_hold_these_numbers() {
    let law = Hyperelastic::new(&[82341.0, 1055.0, 2.25, 649.74, 10.0, 0.0458, 1.8, 0.1, 2.0, 0.0, 0.0]).expect("good");
    let limit = 0.0458_f64.ln_1p();
    let numbers = PreparedHyperelastic::from(&law).0;
    let wanted = [
        82341.0,
        1055.0,
        2.25,
        649.74,
        10.0,
        1.25,
        1.25,
        0.0,
        1.25 * std::f64::consts::LOG2_E,
        f64::MIN_POSITIVE * f64::from(1 << 20),
        0.0,
        limit,
        1.0 / limit,
        0.0,
        1.8,
        0.1,
        1.0,
        0.0,
        0.0,
        0.0,
        1.0,
        0.0,
        0.0,
        0.0,
        1.0,
        1.0,
    ];
    for (k, (found, wanted)) in numbers.into_iter().zip(wanted).enumerate() {
        assert!((found - wanted).abs() <= 4.0 * f64::EPSILON * wanted.abs(), "number {k}: {found}, {wanted}");
    }
    let linear =
        LinearElastic::<f64>::new(&[79414.0, 794.0, 126.0, 3637.0, 2.0, 0.0, 0.0, 0.0, 0.0, 3.0]).expect("good");
    let wanted = [
        79414.0, 794.0, 794.0, 126.0, 126.0, 126.0, 3637.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0,
    ];
    assert_eq!(PreparedLinearElastic::from(&linear).0, wanted);
}

/// Asserts that these fields have the values of the rows of the same names, whose values are their places.
macro_rules! assert_rows {
    ($properties:ident, $table:ident, $($field:ident)*) => {
        $(assert_eq!($properties.$field, parameters::place(&$table, stringify!($field)), stringify!($field));)*
    };
}

#[test]
fn properties_by_name_are_the_rows_of_the_tables() {
    let places = core::array::from_fn(|i| i);
    let properties = Properties::from(places);
    assert_rows!(properties, HYPERELASTIC, k_el k_tc p k_td k_ld eps_lim alpha beta);
    assert_eq!(properties.fibre, ["m_1", "m_2", "m_3"].map(|name| parameters::place(&HYPERELASTIC, name)));
    assert_eq!(<[usize; parameters::HYPERELASTIC_PROPERTIES]>::from(properties), places);

    let places = core::array::from_fn(|i| i);
    let properties = linear_elastic::Properties::from(places);
    assert_rows!(properties, LINEAR_ELASTIC, e_1 e_2 g sigma_lim);
    assert_eq!(properties.fibre, ["m_1", "m_2", "m_3"].map(|name| parameters::place(&LINEAR_ELASTIC, name)));
    assert_eq!(properties.second_axis, ["n_1", "n_2", "n_3"].map(|name| parameters::place(&LINEAR_ELASTIC, name)));
    assert_eq!(<[usize; parameters::LINEAR_ELASTIC_PROPERTIES]>::from(properties), places);
}

#[test]
fn descriptions_say_where_the_tables_have_what() {
    for law in [&description::HYPERELASTIC, &description::LINEAR_ELASTIC] {
        let property = |place: usize| law.properties[place].name;
        let fibre: Vec<&str> = law.fibre_components().map(property).collect();
        assert_eq!(fibre, ["m_1", "m_2", "m_3"], "{}", law.title);
        let second = law.directions.get(1);
        assert_eq!(second.map(|second| property(second.first)), second.map(|_| "n_1"), "{}", law.title);
        assert_eq!([law.failed, law.alive].map(|place| law.state[place].name), ["failed", "alive"], "{}", law.title);
        let energies: Vec<usize> = law.energies.clone().collect();
        let rows: Vec<usize> =
            (0..law.state.len()).filter(|&i| law.state[i].dimension.name == "energy/volume").collect();
        assert_eq!(energies, rows, "{}", law.title);
    }
    assert_eq!([description::HYPERELASTIC.history(), description::LINEAR_ELASTIC.history()], [11, 19]);
}
