//! The polar decomposition F = R U as a host forms it, in extended precision and rounded once.

use twofloat::TwoFloat;

type Matrix = [[TwoFloat; 3]; 3];

/// R and U of F = R U, each entry rounded once from some 30 digits.
///
/// det R = 1, so that U of an inverted F has a negative determinant. A singular F, or one that is not finite, has no
/// decomposition: then R = 1 and U = F.
pub fn polar_decomposition(f: &[[f64; 3]; 3]) -> ([[f64; 3]; 3], [[f64; 3]; 3]) {
    const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let wide = f.map(|row| row.map(TwoFloat::from));
    match rotation(&wide) {
        Some(r) => {
            let u = product(&transpose(&r), &wide);
            let half = TwoFloat::from(0.5);
            let symmetric: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| half * (u[i][j] + u[j][i])));
            (round(&r), round(&symmetric))
        }
        None => (IDENTITY, *f),
    }
}

/// Newton's iteration X ← ½(κX + (κX)⁻ᵀ), scaled while it is far from a rotation.
fn rotation(f: &Matrix) -> Option<Matrix> {
    let mut x = *f;
    let mut scaled = true;
    for _ in 0..60 {
        let cofactors = cofactors(&x);
        let determinant = (0..3).map(|i| x[0][i] * cofactors[0][i]).fold(TwoFloat::from(0.0), |a, b| a + b);
        if !(f64::from(determinant).is_normal()) {
            return None;
        }
        let dual = cofactors.map(|row| row.map(|entry| entry / determinant));
        let kappa = if scaled { f64::sqrt(norm(&dual) / norm(&x)) } else { 1.0 };
        let next: Matrix = std::array::from_fn(|i| {
            std::array::from_fn(|j| (x[i][j] * kappa + dual[i][j] / kappa) * TwoFloat::from(0.5))
        });
        let change: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| next[i][j] - x[i][j]));
        x = next;
        if !norm(&change).is_finite() {
            return None;
        }
        if norm(&change) < 1e-2 {
            scaled = false;
        }
        // Quadratic: the step after one of 1e-16 is at the rounding of the extended numbers.
        if norm(&change) < 1e-17 {
            let negative = f64::from(determinant) < 0.0;
            return Some(if negative { x.map(|row| row.map(|entry| -entry)) } else { x });
        }
    }
    None
}

fn cofactors(a: &Matrix) -> Matrix {
    std::array::from_fn(|i| {
        let (i1, i2) = ((i + 1) % 3, (i + 2) % 3);
        std::array::from_fn(|j| {
            let (j1, j2) = ((j + 1) % 3, (j + 2) % 3);
            a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1]
        })
    })
}

fn transpose(a: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]))
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j]))
}

fn norm(a: &Matrix) -> f64 {
    a.iter().flatten().map(|&entry| f64::from(entry).powi(2)).sum::<f64>().sqrt()
}

fn round(a: &Matrix) -> [[f64; 3]; 3] {
    a.map(|row| row.map(f64::from))
}
