//! Functions of tensors against eigenvectors, and their derivatives where eigenvalues coincide.

use fastrand::Rng;
use nalgebra::{Matrix3, Rotation3, SymmetricEigen, Vector3};
use toron::user::Dual;
use toron::user::tensor::{exponential, inverse, logarithm, polar, square_root};
use toron::user::vector::Matrix;

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
