//! Where formulas as they are printed lose digits: the errors of the stress by family of the truth's points, of the
//! library, of Eq. 4.14 in double precision and of the same in Fortran, beside what the input allows. The table stands
//! in docs/results/validation.md.

// The bench uses more of them.
#[allow(dead_code)]
mod baselines;

use std::collections::BTreeMap;

use baselines::{fortran, literal};
use nalgebra::Matrix3;
use toron::law::state::HYPERELASTIC_STATE;
use toron::{Hyperelastic, Request};
use toron_materials::bench::scene::Scene;
use toron_test_support::truth::{Case, cases, far_cases};

const START: [f64; HYPERELASTIC_STATE] = [0.0; HYPERELASTIC_STATE];
const ROUNDING: f64 = f64::EPSILON / 2.0;

/// The worst of a family: what the input allows, and relative errors of the three; the library's in roundings of the
/// input.
#[derive(Default)]
struct Worst {
    points: usize,
    allowed: f64,
    errors: [f64; 3],
    roundings: f64,
}

fn of_library(case: &Case, f: &Matrix3<f64>) -> [f64; 6] {
    Hyperelastic::<f64>::new(&case.properties()).expect("properties").point(f, &START, Request::ALL).stress
}

fn of_literal(case: &Case, f: &Matrix3<f64>) -> [f64; 6] {
    literal::point(&baselines::yarn(&case.properties()), f, &START).0
}

/// A number with one digit; what is no number is as wrong as can be.
fn short(x: f64) -> String {
    match x {
        0.0 => "0".into(),
        _ if x < 1e100 => format!("{x:.0e}"),
        _ => "NaN".into(),
    }
}

#[test]
fn errors_by_family() {
    let fortran = fortran::rows().next().expect("a row").expect("gfortran compiles it");
    let mut families = BTreeMap::<String, Worst>::new();
    for case in cases().into_iter().chain(far_cases()) {
        let f = case.deformation_gradient();
        let mut scene = Scene::new(1, std::iter::repeat(f));
        fortran.run(&case.properties(), &mut scene);
        let stresses = [of_library(&case, &f), of_literal(&case, &f), scene.points[0].stress];
        let errors = stresses.map(|stress| case.stress_errors(&stress));
        let worst = families.entry(case.category.clone()).or_default();
        worst.points += 1;
        worst.allowed = worst.allowed.max(case.condition().map_or(0.0, |k| ROUNDING * (1.0 + k)));
        worst.roundings = worst.roundings.max(errors[0][0] / ROUNDING);
        for (worst, [_, relative]) in worst.errors.iter_mut().zip(errors) {
            *worst = worst.max(relative);
        }
    }
    println!(
        "| family | points | the input allows | library | Eq. 4.14 | Eq. 4.14 in Fortran |\n|---|---|---|---|---|---|"
    );
    for (name, worst) in &families {
        let numbers = [worst.allowed].into_iter().chain(worst.errors).map(short).collect::<Vec<_>>().join(" | ");
        println!("| {} | {} | {numbers} |", name.replace('_', " "), worst.points);
    }
    // As they stand in `FOUND`.
    families.iter().for_each(|(name, worst)| println!("(\"{name}\", {:.2}),", worst.roundings));
    assert_eq!(families.values().map(|worst| worst.points).sum::<usize>(), 496);
    for (name, worst) in &families {
        let (_, found) = FOUND.into_iter().find(|(family, _)| family == name).expect("a family");
        assert!(worst.roundings <= 1.1 * found + 0.01, "{name}: {} roundings, found were {found}", worst.roundings);
    }
}

/// The library's worst errors, in roundings of the input; a tenth more is allowed.
const FOUND: [(&str, f64); 34] = [
    ("asinh_switch", 0.54),
    ("compaction", 0.65),
    ("degenerate", 0.43),
    ("degenerate_rotated", 0.78),
    ("distortion", 0.46),
    ("expansion", 0.70),
    ("exponent", 0.98),
    ("failure", 0.69),
    ("fibre_compression", 0.37),
    ("fibre_direction", 1.21),
    ("flattened", 0.74),
    ("inflated", 0.24),
    ("inflated_oblique", 0.35),
    ("kld_large", 0.49),
    ("moderate", 0.62),
    ("near_an_axis", 1.56),
    ("near_axis2", 0.74),
    ("nearly_axis", 0.84),
    ("quarter_ratio", 0.45),
    ("rest", 0.00),
    ("s_tiny", 0.20),
    ("shear", 0.73),
    ("short_fibre", 0.48),
    ("simple_shear", 0.95),
    ("slip", 0.44),
    ("slip_along_axes", 0.66),
    ("slip_along_axes_sheared", 0.43),
    ("slip_huge", 0.32),
    ("slip_moderate", 1.20),
    ("slip_sheared", 3.74),
    ("small", 0.17),
    ("stiff_shear", 0.48),
    ("turn_huge", 0.48),
    ("units", 0.55),
];
