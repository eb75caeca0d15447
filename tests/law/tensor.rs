//! Functions of tensors against eigenvectors, and their derivatives where eigenvalues coincide.

use fastrand::Rng;
use nalgebra::{Matrix3, Rotation3, SymmetricEigen, Vector3};
use toron::user::Dual;
use toron::user::tensor::{eigenvalues, exponential, inverse, logarithm, polar, square_root};
use toron::user::vector::Matrix;
use toron_test_support::exact::{Exact, exact, rounded};

type Function<R> = fn(&Matrix<R>) -> Matrix<R>;

/// A symmetric matrix, in some axes, whose eigenvalues are made of numbers between 0 and 1.
fn symmetric(rng: &mut Rng, eigenvalue: impl Fn(f64) -> f64) -> Matrix3<f64> {
    let eigenvalues = [0, 1, 2].map(|_| eigenvalue(rng.f64()));
    turned(rng, eigenvalues)
}

/// One with these eigenvalues.
fn turned(rng: &mut Rng, eigenvalues: [f64; 3]) -> Matrix3<f64> {
    let axis = Vector3::from_fn(|_, _| rng.f64() - 0.5);
    let q = Rotation3::new(6.0 * axis).into_inner();
    let a = q * Matrix3::from_diagonal(&eigenvalues.into()) * q.transpose();
    0.5 * (a + a.transpose())
}

/// f of a symmetric matrix, by its eigenvectors.
fn by_eigenvectors(a: &Matrix3<f64>, f: impl Fn(f64) -> f64) -> Matrix3<f64> {
    let SymmetricEigen { eigenvectors, eigenvalues } = a.symmetric_eigen();
    eigenvectors * Matrix3::from_diagonal(&eigenvalues.map(f)) * eigenvectors.transpose()
}

#[track_caller]
fn assert_near(found: &Matrix<f64>, expected: &Matrix3<f64>, allowed: f64, what: &str) {
    let off = (Matrix3::from(*found) - expected).amax();
    assert!(off <= allowed * expected.amax(), "{what}: off by {off:e}: {found:?}, {expected}");
}

#[test]
fn values_are_those_of_the_eigenvectors() {
    let mut rng = Rng::with_seed(1);
    for _ in 0..2000 {
        let spread = 4.0 * rng.f64();
        let a = symmetric(&mut rng, |x| 10_f64.powf(spread * (x - 0.5)));
        let (columns, condition) = (a.data.0, 10_f64.powf(spread));
        assert_near(&square_root(&columns), &by_eigenvectors(&a, f64::sqrt), 1.7e-15 * condition, "root");
        // A rounding of A is one of the logarithm, however small that is.
        let exact = by_eigenvectors(&a, f64::ln);
        assert_near(&logarithm(&columns), &exact, 1.1e-14 * condition / exact.amax().min(1.0), "logarithm");
        assert_near(&inverse(&columns), &by_eigenvectors(&a, |x| 1.0 / x), 1.4e-15 * condition, "inverse");
        let small = symmetric(&mut rng, |x| 4.0 * (x - 0.5));
        assert_near(&exponential(&small.data.0), &by_eigenvectors(&small, f64::exp), 1.8e-14, "exponential");
    }
}

#[test]
fn a_small_strain_keeps_its_digits() {
    let mut rng = Rng::with_seed(2);
    for strain in [1e-12, 1e-8, 1e-4] {
        let a = turned(&mut rng, [1.0 + strain, 1.0 - 2.0 * strain, 1.0]);
        let off = (Matrix3::from(logarithm(&a.data.0)) - (a - Matrix3::identity())).amax();
        assert!(off <= 3.0 * strain * strain + 2e-15, "{strain}: {off:e}");
    }
}

#[test]
fn a_deformation_is_a_rotation_of_its_stretch() {
    let mut rng = Rng::with_seed(3);
    for _ in 0..500 {
        let u = symmetric(&mut rng, |x| 0.3 + 2.0 * x);
        let r = Rotation3::new(Vector3::from_fn(|_, _| 3.0 * (rng.f64() - 0.5))).into_inner();
        let (rotation, stretch) = polar(&(r * u).data.0);
        assert_near(&rotation, &r, 2.5e-15, "rotation");
        assert_near(&stretch, &u, 1.4e-15, "stretch");
    }
}

/// The derivative of f at `a` in the direction `h`, by dual numbers.
fn slope(f: Function<Dual<f64>>, a: &Matrix3<f64>, h: &Matrix3<f64>) -> Matrix<f64> {
    let dual = std::array::from_fn(|c| std::array::from_fn(|r| Dual::new(a[(r, c)], h[(r, c)])));
    f(&dual).map(|column| column.map(|entry| entry.slope))
}

#[test]
fn derivatives_are_right_where_eigenvalues_coincide() {
    let mut rng = Rng::with_seed(4);
    let (one, zero) = (Matrix3::identity(), Matrix3::zeros());
    for _ in 0..50 {
        let h = symmetric(&mut rng, |x| x - 0.5);
        assert_near(&slope(square_root, &one, &h), &(0.5 * h), 1e-14, "root at 1");
        assert_near(&slope(logarithm, &one, &h), &h, 1e-13, "logarithm at 1");
        assert_near(&slope(exponential, &zero, &h), &h, 1e-13, "exponential at 0");
        assert_near(&slope(inverse, &one, &h), &-h, 1e-14, "inverse at 1");
        for eigenvalues in [[0.5, 2.0, 2.0], [0.2, 0.7, 3.0]] {
            let a = turned(&mut rng, eigenvalues);
            let difference = |f: Function<f64>| {
                let step = 1e-5;
                let at = |s: f64| Matrix3::from(f(&(a + s * h).data.0));
                (at(step) - at(-step)) / (2.0 * step)
            };
            assert_near(&slope(square_root, &a, &h), &difference(square_root), 1e-8, "slope of the root");
            assert_near(&slope(logarithm, &a, &h), &difference(logarithm), 1e-8, "slope of the logarithm");
            assert_near(&slope(exponential, &a, &h), &difference(exponential), 1e-8, "slope of the exponential");
        }
    }
}

/// The eigenvalues of a symmetric matrix, the largest first: the roots of its characteristic polynomial in 320 binary
/// digits, by bisection between those of the polynomial's slope.
fn exact_eigenvalues(a: &Matrix3<f64>) -> [f64; 3] {
    let e = |i: usize, j: usize| exact(a[(i, j)]);
    let (zero, two, three) = (exact(0.0), exact(2.0), exact(3.0));
    let trace = e(0, 0) + e(1, 1) + e(2, 2);
    let minor = |i: usize, j: usize| e(i, i) * e(j, j) - e(i, j) * e(i, j);
    let second = minor(0, 1) + minor(1, 2) + minor(2, 0);
    let determinant = e(0, 0) * minor(1, 2) - e(0, 1) * (e(0, 1) * e(2, 2) - e(1, 2) * e(0, 2))
        + e(0, 2) * (e(0, 1) * e(1, 2) - e(1, 1) * e(0, 2));
    let polynomial = |x: &Exact| ((x - &trace) * x + &second) * x - &determinant;
    let root = |low: Exact, high: Exact| {
        let (mut low, mut high) = (low, high);
        for _ in 0..250 {
            let middle = (&low + &high) / &two;
            let same = (polynomial(&middle) > zero) == (polynomial(&high) > zero);
            if same { high = middle } else { low = middle }
        }
        rounded(&low)
    };
    // Where the slope 3x² − 2 tr x + second is 0.
    let square = &trace * &trace - &three * &second;
    let mut spread = exact(rounded(&square).max(0.0).sqrt());
    for _ in 0..8 {
        if spread > zero {
            spread = (&spread + &square / &spread) / &two;
        }
    }
    let far = exact(4.0 * a.amax());
    let (low, high) = ((&trace - &spread) / &three, (&trace + &spread) / &three);
    [root(high.clone(), far.clone()), root(low.clone(), high), root(-far, low)]
}

/// Eigenvalues that are far from one another, near, and the same to the last digits.
#[test]
fn eigenvalues_are_right_however_near_they_are() {
    let mut rng = Rng::with_seed(5);
    let mut worst: f64 = 0.0;
    for number in 0..300 {
        let gap = 10_f64.powf(-17.0 * rng.f64());
        let size = 10_f64.powf(40.0 * (rng.f64() - 0.5));
        let a = match number % 3 {
            0 => symmetric(&mut rng, |x| size * (x - 0.5)),
            1 => turned(&mut rng, [size, size * (1.0 + gap), -0.3 * size]),
            _ => turned(&mut rng, [size, size * (1.0 + gap), size * (1.0 - 0.4 * gap)]),
        };
        let (found, exact) = (eigenvalues(&a.data.0), exact_eigenvalues(&a));
        assert!(found[0] >= found[1] && found[1] >= found[2]);
        for (found, exact) in found.into_iter().zip(exact) {
            worst = worst.max((found - exact).abs() / a.amax());
        }
    }
    assert!(worst <= 4.0 * f64::EPSILON, "off by {} roundings", worst / f64::EPSILON);
    for a in [Matrix3::zeros(), Matrix3::identity(), Matrix3::from_diagonal(&Vector3::new(-1.0, 3.0, 2.0))] {
        let mut exact: [f64; 3] = [a[(0, 0)], a[(1, 1)], a[(2, 2)]];
        exact.sort_by(|a, b| b.total_cmp(a));
        assert_eq!(eigenvalues(&a.data.0), exact);
    }
}

/// Of each where they differ, and of what is made of all alike where they do not.
#[test]
fn eigenvalues_have_derivatives() {
    let mut rng = Rng::with_seed(6);
    let of = |a: &Matrix3<f64>, h: &Matrix3<f64>| {
        eigenvalues(&std::array::from_fn(|c| std::array::from_fn(|r| Dual::new(a[(r, c)], h[(r, c)]))))
    };
    for number in 0..200 {
        let h = symmetric(&mut rng, |x| x - 0.5);
        let a = turned(&mut rng, [1.0, 2.5, -0.7]);
        let SymmetricEigen { eigenvectors, eigenvalues } = a.symmetric_eigen();
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| eigenvalues[j].total_cmp(&eigenvalues[i]));
        for (found, i) in of(&a, &h).into_iter().zip(order) {
            let n = eigenvectors.column(i);
            let slope = (n.transpose() * h * n)[0];
            assert!((found.slope - slope).abs() < 1e-14, "{} {slope}", found.slope);
        }
        // Σ λ³ = tr A³, whose derivative is 3 A² : Ȧ.
        let gap = [0.0, 1e-16, 1e-12, 1e-8, 1e-3][number % 5];
        for a in [turned(&mut rng, [1.0, 1.0 + gap, 2.0]), turned(&mut rng, [1.0, 1.0, 1.0 + gap]), Matrix3::identity()]
        {
            let found: f64 = of(&a, &h).iter().map(|x| (*x * *x * *x).slope).sum();
            let exact = 3.0 * (a * a * h).trace();
            assert!((found - exact).abs() < 2e-14, "{found} {exact} {gap:e}");
        }
    }
}
