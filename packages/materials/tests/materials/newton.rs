//! Newton's method with the laws' tangents: the residual falls quadratically.

use nalgebra::Matrix3;
use toron::law::parameters;
use toron::law::stress::first_piola_kirchhoff;
use toron::{Criterion, Rotation};
use toron_materials::load_path::newton::{self, Prescribed, Solution};
use toron_materials::material::model::{Law, Material};

fn material(preset: &str, frame: Rotation, changed: &[(usize, f64)]) -> Material {
    let preset = parameters::preset(preset).expect("a preset");
    let mut values = preset.values.to_vec();
    for &(index, value) in changed {
        values[index] = value;
    }
    let law = Law::new(preset.into(), &values, frame, Criterion::LargestPrincipal).expect("valid properties");
    Material {
        law,
        density: None,
        label: preset.name.into(),
        own: String::new(),
        origin: Default::default(),
        temperature: None,
    }
}

/// The way to the deformation gradient at which the law carries the stress of `target`, from `start`.
fn way(material: &Material, start: &Matrix3<f64>, target: &Matrix3<f64>) -> Solution {
    let memory = material.at_rest();
    let stress = |f: &Matrix3<f64>| {
        let (cauchy, tangent) = material.tangent(f, 0.0, &memory)?;
        Ok((first_piola_kirchhoff(&cauchy, f), tangent))
    };
    let (wanted, _) = stress(target).expect("a state");
    // The first column and the diagonal are free, the rest is prescribed: no rotation is left to choose.
    let prescribed = newton::COMPONENTS.map(|(i, j)| {
        if j == 0 || i == j { Prescribed::Stress(wanted[(i, j)]) } else { Prescribed::Gradient(target[(i, j)]) }
    });
    newton::solve(&stress, start, &prescribed, material.stress_scale()).expect("a solution")
}

/// Every residual small enough to be in the quadratic regime is followed by one below a multiple of its square: over
/// the largest stiffness, a residual of the softest mode counts for some hundred times as much.
fn assert_quadratic(name: &str, solution: &Solution, scale: f64) {
    let relative: Vec<_> = solution.residuals.iter().map(|r| r / scale).collect();
    println!("{name}: {relative:?}");
    assert!(relative.len() <= 8, "{name}: {relative:?}");
    let small = relative.windows(2).filter(|pair| pair[0] < 1e-4).collect::<Vec<_>>();
    assert!(small.len() >= 2, "{name}: {relative:?}");
    for pair in small {
        assert!(pair[1] <= 1e3 * pair[0] * pair[0] + 1e-13, "{name}: {relative:?}");
    }
}

#[test]
fn residuals_fall_quadratically() {
    let target = Matrix3::new(1.03, 0.02, 0.01, 0.05, 0.88, 0.04, -0.04, 0.03, 0.92);
    // Compacted already: at I_tc = 0 the area has no stiffness.
    let start = Matrix3::new(1.01, 0.02, 0.01, 0.02, 0.95, 0.04, -0.02, 0.03, 0.96);
    let yarn = material("kevlar-km2-600", Rotation::Fibre, &[(4, 1e9), (5, 0.0)]);
    assert_quadratic("hyperelastic", &way(&yarn, &start, &target), yarn.stress_scale());
    for frame in [Rotation::Fibre, Rotation::Polar, Rotation::Spin] {
        let linear = material("kevlar-km2-600-linear", frame, &[(3, 0.0)]);
        assert_quadratic(&format!("linear elastic, {frame:?}"), &way(&linear, &start, &target), linear.stress_scale());
    }
}
