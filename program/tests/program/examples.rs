//! Every example load path against closed forms of the thesis, written out here and independent of the library.

use std::path::Path;

use toron::law::state::{ENERGIES, INVARIANTS};
use toron_materials::load_path::path::LoadPath;
use toron_materials::load_path::run::{self, End, History, Increment};
use toron_materials::material::laws::Laws;
use toron_materials::material::model::Law;

/// Kevlar KM2 600 in MPa: Tab. 4.3 and 4.5.
const K_EL: f64 = 82341.0;
const K_TC: f64 = 1055.0;
const P: f64 = 2.2;
const K_TD: f64 = 649.74;
const EPS_LIM: f64 = 0.0458;
const ALPHA: f64 = 1.8;
/// The linear elastic law: Tab. 4.4.
const E_1: f64 = 79414.0;
const SIGMA_LIM: f64 = 3637.0;

/// Closed forms and the library round differently, and the preset is converted from SI units.
const TOLERANCE: f64 = 1e-11;
/// What Newton's method leaves, over the stiffness: it stops at 1e-11 of the largest property.
const NEWTON: f64 = 1e-9;

fn load(name: &str) -> LoadPath {
    LoadPath::read(Laws::Toron, &Path::new(toron_test_support::library::ROOT).join("examples").join(name))
        .expect("the example is valid")
}

/// Runs an example of one point to its end.
fn only<'a>(path: &'a LoadPath) -> History<'a> {
    let mut histories = run::run(path, &|| {});
    assert_eq!(histories.len(), 1);
    let history = histories.remove(0);
    assert_eq!(history.end, End::Completed);
    history
}

#[track_caller]
fn assert_near(found: f64, expected: f64, tolerance: f64, scale: f64) {
    assert!((found - expected).abs() <= tolerance * scale, "found {found:e}, expected {expected:e}");
}

fn energy(increment: &Increment, mode: usize) -> f64 {
    increment.answer.memory.state[ENERGIES + mode]
}

fn invariant(increment: &Increment, mode: usize) -> f64 {
    increment.answer.memory.state[INVARIANTS + mode]
}

/// Every stress component, against the diagonal ones expected and none beside them.
#[track_caller]
fn assert_stress(increment: &Increment, diagonal: [f64; 3], tolerance: f64) {
    let scale = diagonal.iter().fold(1.0, |scale: f64, s| scale.max(s.abs()));
    for (k, &found) in increment.answer.cauchy.iter().enumerate() {
        assert_near(found, *diagonal.get(k).unwrap_or(&0.0), tolerance, scale);
    }
}

/// The increments up to and including the failing one; all of them carry stress.
fn intact<'a>(history: &'a History) -> &'a [Increment] {
    &history.increments[..=history.failure.expect("the point fails")]
}

#[track_caller]
fn assert_dead_after_failure(history: &History) {
    let failing = history.failure.expect("the point fails");
    let frozen = &history.increments[failing];
    assert!(history.increments.len() > failing + 1, "the path goes on after failure");
    for increment in &history.increments[failing + 1..] {
        assert_eq!(increment.answer.cauchy, [0.0; 6]);
        assert_eq!(increment.answer.memory.state, frozen.answer.memory.state);
        assert_eq!(increment.work, frozen.work);
    }
}

#[test]
fn fibre_tension_to_failure() {
    let path = load("fibre-tension.toml");
    let history = only(&path);
    for (n, increment) in intact(&history).iter().enumerate() {
        let stretch = 1.0 + 0.0005 * n as f64;
        let strain = stretch.ln();
        assert_near(increment.f.m11, stretch, TOLERANCE, 1.0);
        // The sides are free and feel nothing: they stay exactly where they are.
        assert_eq!((increment.f.m22, increment.f.m33), (1.0, 1.0));
        assert_stress(increment, [K_EL * strain / stretch, 0.0, 0.0], TOLERANCE);
        assert_near(increment.p.m11, K_EL * strain / stretch, TOLERANCE, 4000.0);
        assert_near(energy(increment, 0), 0.5 * K_EL * strain * strain, TOLERANCE, 100.0);
    }
    // The first of 0.05 % steps at or beyond 4.58 %.
    assert_eq!(history.failure, Some(92));
    assert_dead_after_failure(&history);
}

#[test]
fn transverse_compaction() {
    let path = load("transverse-compaction.toml");
    for (n, increment) in only(&path).increments.iter().enumerate() {
        let stretch = 1.0 - 0.002 * n as f64;
        let i = -stretch.ln();
        let stress = -0.5 * P * K_TC * i.powf(P - 1.0) / (stretch * stretch);
        assert_stress(increment, [0.0, stress, stress], TOLERANCE);
        assert_near(energy(increment, 1), K_TC * i.powf(P), TOLERANCE, 40.0);
        assert_near(invariant(increment, 2), 0.0, 1e-15, 1.0);
    }
}

/// Cauchy stresses 22 and 33 of F = diag(λ, 1, l), where −I_tc = I_td = ½|ln l|.
fn flattened(stretch: f64, l: f64) -> [f64; 2] {
    let i = -0.5 * l.ln();
    let pressure = 0.5 * P * K_TC * i.powf(P - 1.0);
    let shear = 0.5 * K_TD * i;
    [(-pressure + shear) / (stretch * l), (-pressure - shear) / (stretch * l)]
}

#[test]
fn transverse_compression() {
    let path = load("transverse-compression.toml");
    for (n, increment) in only(&path).increments.iter().enumerate() {
        let l = 1.0 - 0.003 * n as f64;
        let i = -0.5 * l.ln();
        let [s22, s33] = flattened(1.0, l);
        assert_stress(increment, [0.0, s22, s33], TOLERANCE);
        assert_near(energy(increment, 1), K_TC * i.powf(P), TOLERANCE, 30.0);
        assert_near(energy(increment, 2), 0.5 * K_TD * i * i, TOLERANCE, 30.0);
    }
}

#[test]
fn spreading() {
    let path = load("spreading.toml");
    let history = only(&path);
    for increment in &history.increments[1..] {
        let (f22, f33) = (increment.f.m22, increment.f.m33);
        let (compaction, distortion) = (-0.5 * (f22 * f33).ln(), 0.5 * (f22 / f33).ln());
        // No force on the free side: distortion and compaction are in balance there.
        assert_near(K_TD * distortion, P * K_TC * compaction.powf(P - 1.0), NEWTON, K_EL);
        assert!(f22 > 1.0);
    }
    let last = history.increments.last().expect("there are increments");
    assert_near(last.f.m22, 1.0828613347321525, 1e-8, 1.0);
    assert_near(last.f.m33, 0.8, TOLERANCE, 1.0);
}

#[test]
fn longitudinal_shear() {
    let path = load("longitudinal-shear.toml");
    const K_LD: f64 = 50.0;
    for (n, increment) in only(&path).increments.iter().enumerate() {
        let slip = 0.005 * n as f64;
        assert_near(increment.answer.cauchy[3], K_LD * slip, TOLERANCE, 10.0);
        assert_near(increment.p.m12, K_LD * slip, TOLERANCE, 10.0);
        for k in [0, 1, 2, 4, 5] {
            assert_near(increment.answer.cauchy[k], 0.0, TOLERANCE, 10.0);
        }
        assert_near(energy(increment, 3), 0.5 * K_LD * slip * slip, TOLERANCE, 1.0);
        assert_near(invariant(increment, 3), slip, TOLERANCE, 1.0);
    }
}

#[test]
fn compaction_then_tension() {
    let path = load("compaction-then-tension.toml");
    let history = only(&path);
    let i = -0.5 * 0.7f64.ln();
    for increment in &intact(&history)[70..] {
        let stretch = increment.f.m11;
        let [s22, s33] = flattened(stretch, 0.7);
        assert_stress(increment, [K_EL * stretch.ln() / (stretch * 0.7), s22, s33], TOLERANCE);
    }
    let limit = EPS_LIM.ln_1p() * (1.0 - ALPHA * i);
    let failing = history.failure.expect("the yarn fails");
    assert!(history.increments[failing].f.m11.ln() >= limit);
    assert!(history.increments[failing - 1].f.m11.ln() < limit);
    assert_eq!(failing, 70 + 81);
    assert_dead_after_failure(&history);
}

#[test]
fn rotation() {
    let path = load("rotation.toml");
    let history = only(&path);
    let at = |index: usize| &history.increments[index];
    let stress = |stretch: f64| K_EL * stretch.ln() / stretch;
    let before = at(30);
    assert_stress(before, [stress(1.03), 0.0, 0.0], TOLERANCE);
    for (n, increment) in history.increments[30..=75].iter().enumerate() {
        let (sine, cosine) = (2.0 * n as f64).to_radians().sin_cos();
        let expected = [cosine * cosine, sine * sine, 0.0, sine * cosine, 0.0, 0.0].map(|x| x * stress(1.03));
        for (found, expected) in increment.answer.cauchy.iter().zip(expected) {
            assert_near(*found, expected, TOLERANCE, stress(1.03));
        }
        assert_near(energy(increment, 0), 0.5 * K_EL * 1.03f64.ln().powi(2), TOLERANCE, 40.0);
        // F before the rotation does not move, so that not a digit of the work changes.
        assert_eq!((increment.f, increment.work), (before.f, before.work));
    }
    assert_stress(at(75), [0.0, stress(1.03), 0.0], TOLERANCE);
    assert_stress(at(85), [0.0, stress(1.04), 0.0], TOLERANCE);
}

#[test]
fn cycles() {
    let path = load("cycles.toml");
    let history = only(&path);
    assert_eq!(history.increments.len(), 1 + 3 * 60);
    let cycle = |n: usize| &history.increments[60 * n..=60 * (n + 1)];
    for n in 0..3 {
        let pulled = &cycle(n)[20];
        assert_near(pulled.p.m11, 2000.0, NEWTON, 2000.0);
        assert_near(K_EL * pulled.f.m11.ln() / pulled.f.m11, 2000.0, NEWTON, 2000.0);
        assert_near(pulled.f.m11, 1.0252143088375711, NEWTON, 1.0);
        let pressed = &cycle(n)[40];
        assert_near(energy(pressed, 1), K_TC * (-0.5 * 0.8f64.ln()).powf(P), TOLERANCE, 10.0);
        let released = &cycle(n)[60];
        for mode in 0..4 {
            assert_near(energy(released, mode), 0.0, 1e-12, 1.0);
        }
    }
}

#[test]
fn three_materials() {
    let path = load("laws.toml");
    let histories = run::run(&path, &|| {});
    let limits = [(EPS_LIM.ln_1p() * (1.0 + 0.5 * ALPHA * 0.7f64.ln())).exp(), 1.0 + EPS_LIM, (SIGMA_LIM / E_1).exp()];
    assert_eq!(histories.len(), limits.len());
    for (history, limit) in histories.iter().zip(limits) {
        assert_eq!(history.end, End::Completed);
        let failing = history.failure.expect("all three fail");
        assert!(history.increments[failing].f.m11 >= limit && history.increments[failing - 1].f.m11 < limit);
        assert_eq!(history.increments[failing + 1].answer.cauchy, [0.0; 6]);
        if let Law::LinearElastic { .. } = history.point.material.law {
            let increment = &history.increments[failing];
            assert_near(increment.answer.cauchy[0], E_1 * increment.f.m11.ln(), TOLERANCE, SIGMA_LIM);
        }
    }
}
