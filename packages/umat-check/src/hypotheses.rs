//! In what way a tangent is wrong: what it would be with each of the usual mistakes, beside what it is.

use nalgebra::Matrix3;

use super::kinematics::{Components, Layout, Modulus, places, tensor, unit_strain};
use super::material::direct;

/// The right tangent at one state, and what the usual mistakes are made of.
pub struct ExactTangent {
    /// The modulus.
    pub truth: Modulus,
    /// Whether it is that of the Jaumann rate of the Kirchhoff stress, and not the plain ∂Δσ/∂Δε.
    pub jaumann: bool,
    pub stress: Components,
    /// On the law's axes.
    pub f: Matrix3<f64>,
    /// Moduli of other increments from the state: unloading a little, in no time, going on a little, in a long time.
    pub intact: Vec<Modulus>,
}

/// A mistake, and what the modulus is with it.
pub struct Hypothesis {
    pub kinds: Vec<&'static str>,
    pub text: String,
    pub modulus: Modulus,
    /// A factor of each state's own, or one for all of them, is still to be found.
    pub factor: Factor,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Factor {
    One,
    OfEachState,
    OfAllStates,
}

fn map(of: impl Fn(usize, usize) -> f64) -> Modulus {
    std::array::from_fn(|i| std::array::from_fn(|j| of(i, j)))
}

/// σ⊗I.
pub fn stress_by_volume(stress: &Components, components: usize) -> Modulus {
    map(|i, j| {
        let known = i < components && j < components;
        if known && places(components)[j].0 == places(components)[j].1 { stress[i] } else { 0.0 }
    })
}

/// D·σ + σ·D, the terms between the Jaumann rate and that of Oldroyd and Truesdell.
fn stress_terms(stress: &Components, components: usize) -> Modulus {
    let stress = tensor(stress, components);
    columns(components, |unit| unit * stress + stress * unit)
}

/// A linear map of symmetric tensors, by its columns.
fn columns(components: usize, of: impl Fn(Matrix3<f64>) -> Matrix3<f64>) -> Modulus {
    let columns: Vec<Matrix3<f64>> = (0..components).map(|j| of(unit_strain(components, j))).collect();
    map(|i, j| if i < components && j < components { columns[j][places(components)[i]] } else { 0.0 })
}

/// The modulus applied to a strain.
fn applied(modulus: &Modulus, strain: &Matrix3<f64>, components: usize) -> Matrix3<f64> {
    let strain = super::kinematics::of_strain(strain, components);
    tensor(&std::array::from_fn(|i| modulus[i].iter().zip(&strain).map(|(entry, part)| entry * part).sum()), components)
}

pub fn sum(a: &Modulus, b: &Modulus, factor: f64) -> Modulus {
    map(|i, j| a[i][j] + factor * b[i][j])
}

pub fn times(a: &Modulus, factor: f64) -> Modulus {
    map(|i, j| factor * a[i][j])
}

/// The modulus of the Green–Naghdi rate, from that of the Jaumann rate: the material turns otherwise than the spin.
fn green_naghdi(jaumann: &Modulus, stress: &Components, f: &Matrix3<f64>, components: usize) -> Option<Modulus> {
    let squared = (f * f.transpose()).symmetric_eigen();
    let axes = squared.eigenvectors;
    let stretch = squared.eigenvalues.map(f64::sqrt);
    let stress = tensor(stress, components);
    let turning = columns(components, |unit| {
        // On the axes of V, without spin: Ṙ Rᵀ has (v_j - v_i) / (v_i + v_j) D_ij.
        let local = axes.transpose() * unit * axes;
        let spin = Matrix3::from_fn(|i, j| (stretch[i] - stretch[j]) / (stretch[i] + stretch[j]) * local[(i, j)]);
        let spin = axes * spin * axes.transpose();
        stress * spin - spin * stress
    });
    let modulus = sum(jaumann, &turning, 1.0);
    modulus.iter().flatten().all(|entry| entry.is_finite()).then_some(modulus)
}

/// ∂S/∂E, from the spatial modulus of the Truesdell rate.
fn material(spatial: &Modulus, f: &Matrix3<f64>, components: usize) -> Option<Modulus> {
    let inverse = f.try_inverse()?;
    let volume = f.determinant();
    Some(columns(components, |unit| {
        // E-dot = Fᵀ D F, S-dot = J F⁻¹ (c : D) F⁻ᵀ.
        let rate = inverse.transpose() * unit * inverse;
        inverse * applied(spatial, &rate, components) * inverse.transpose() * volume
    }))
}

/// The moduli of other rates.
fn other_rates(exact: &ExactTangent, components: usize) -> Vec<(&'static str, Modulus)> {
    let ExactTangent { truth, stress, f, .. } = exact;
    let by_volume = stress_by_volume(stress, components);
    let terms = stress_terms(stress, components);
    let spatial = sum(truth, &terms, -1.0);
    let nowhere = [[f64::NAN; 6]; 6];
    let mut rates = vec![
        ("the terms of the stress are missing (Truesdell, Oldroyd)", spatial),
        ("the terms of the stress twice", sum(truth, &terms, 1.0)),
        ("the terms of the stress have the wrong sign", sum(truth, &terms, -2.0)),
        ("half of the terms of the stress", sum(truth, &terms, -0.5)),
    ];
    if exact.jaumann {
        rates.push(("the Jaumann rate of the Cauchy stress: σ⊗I is missing", sum(truth, &by_volume, -1.0)));
        rates.push(("the Oldroyd rate of the Cauchy stress", sum(&spatial, &by_volume, -1.0)));
        let green_naghdi = green_naghdi(truth, stress, f, components);
        rates.push(("the Green–Naghdi rate", green_naghdi.unwrap_or(nowhere)));
        rates.push(("∂S/∂E on the reference", material(&spatial, f, components).unwrap_or(nowhere)));
    } else {
        rates.push(("σ⊗I with the wrong sign", sum(truth, &by_volume, -1.0)));
        rates.push((
            "the terms of the stress added to a rate law's, with σ⊗I",
            sum(&sum(truth, &terms, 1.0), &by_volume, 1.0),
        ));
    }
    rates
}

/// The moduli with shears that are those of the tensor in some place.
fn shears_of_tensors(truth: &Modulus, components: usize) -> Vec<(String, Modulus)> {
    let mut found = Vec::new();
    let mut add = |text: String, modulus: Modulus| found.push((text, modulus));
    let direct = direct(components);
    let shear = |i: usize| i >= direct;
    for (text, factor) in [("twice", 2.0), ("half", 0.5), ("four times", 4.0), ("a quarter of", 0.25)] {
        let of =
            |scaled: &dyn Fn(usize, usize) -> bool| map(|i, j| truth[i][j] * if scaled(i, j) { factor } else { 1.0 });
        add(format!("{text} the columns of shears"), of(&|_, j| shear(j)));
        add(format!("{text} the rows of shears"), of(&|i, _| shear(i)));
        add(format!("{text} the shears by shears"), of(&|i, j| shear(i) && shear(j)));
        add(format!("{text} the shears' diagonal"), of(&|i, j| shear(i) && i == j));
        add(format!("{text} shears by normals"), of(&|i, j| shear(i) != shear(j)));
    }
    for (text, factor) in
        [("each shear twice, in rows and in columns", 2.0_f64), ("half of each shear, in rows and in columns", 0.5)]
    {
        let scaled = |i: usize, j: usize| factor.powi(i32::from(shear(i)) + i32::from(shear(j)));
        add(text.to_string(), map(|i, j| truth[i][j] * scaled(i, j)));
    }
    found
}

/// The modulus that each usual mistake gives at a state, always in the same order.
pub fn usual_mistakes(exact: &ExactTangent, layout: Layout) -> Vec<Hypothesis> {
    let components = layout.components;
    let ExactTangent { truth, stress, f, .. } = exact;
    let mut found = Vec::new();
    let mut add = |kinds: &[&'static str], text: &str, modulus: Modulus, factor: Factor| {
        found.push(Hypothesis { kinds: kinds.to_vec(), text: text.to_string(), modulus, factor });
    };
    let terms = stress_terms(stress, components);
    let volume = f.determinant();
    let spatial = sum(truth, &terms, -1.0);
    let nowhere = [[f64::NAN; 6]; 6];

    let rates = other_rates(exact, components);
    for (text, modulus) in &rates {
        add(&["another rate"], text, *modulus, Factor::One);
    }
    add(&["1/J"], "1/J is missing: the Kirchhoff stress's", times(truth, volume), Factor::One);
    add(&["1/J"], "1/J twice", times(truth, 1.0 / volume), Factor::One);
    add(
        &["1/J"],
        "1/J is missing but in the terms of the stress",
        sum(&times(&spatial, volume), &terms, 1.0),
        Factor::One,
    );
    add(&["1/J"], "1/J is missing in the terms of the stress", sum(&spatial, &terms, volume), Factor::One);
    for (text, modulus) in &rates {
        add(&["another rate", "1/J"], &format!("{text}; without 1/J"), times(modulus, volume), Factor::One);
    }

    add(&["transposed"], "rows and columns are exchanged", map(|i, j| truth[j][i]), Factor::One);
    add(&["symmetrised"], "the symmetric part", map(|i, j| 0.5 * (truth[i][j] + truth[j][i])), Factor::One);
    add(&["symmetrised"], "the upper triangle on both sides", map(|i, j| truth[i.min(j)][i.max(j)]), Factor::One);
    add(&["symmetrised"], "the lower triangle on both sides", map(|i, j| truth[i.max(j)][i.min(j)]), Factor::One);

    for (text, modulus) in shears_of_tensors(truth, components) {
        add(&["tensor shears"], &text, modulus, Factor::One);
    }
    if components == 6 {
        let exchanged = |i: usize| if i >= 4 { 9 - i } else { i };
        let name = "13 and 23 exchanged";
        add(&[name], "rows and columns", map(|i, j| truth[exchanged(i)][exchanged(j)]), Factor::One);
        add(&[name], "rows", map(|i, j| truth[exchanged(i)][j]), Factor::One);
        add(&[name], "columns", map(|i, j| truth[i][exchanged(j)]), Factor::One);
    }
    let others = [
        ("intact", "the modulus of unloading"),
        ("intact", "the modulus without time"),
        ("continuum", "the modulus of a vanishing increment, not that of the increment (the consistent one)"),
        ("relaxed", "the modulus of a very long increment"),
    ];
    for (index, (kind, text)) in others.into_iter().enumerate() {
        let modulus = exact.intact.get(index).copied().unwrap_or(nowhere);
        add(&[kind], text, modulus, Factor::One);
        if index == 0 {
            add(&["intact"], "the undamaged modulus, in proportion to that of unloading", modulus, Factor::OfEachState);
        }
    }
    add(&["scale"], "all of it", *truth, Factor::OfAllStates);
    // A traction has neither volume nor tensor.
    let of_traction = ["transposed", "symmetrised", "intact", "continuum", "relaxed", "scale"];
    found.retain(|hypothesis| !layout.traction || of_traction.contains(&hypothesis.kinds[0]));
    found
}
