//! The standard reinforcing model: a compressible neo-Hookean solid with one family of fibres.
//!
//! W = ½ μ (I1 − 3) − μ ln J + ½ Λ (ln J)² + ½ k (I4 − 1)² per reference volume, with I1 = tr FᵀF, I4 = a·a and a = Fm,
//! the image of the unit fibre direction m; it fails where the stretch of the fibre reaches a limit.

pub mod plastic;
pub mod viscoelastic;

use toron::user::parameters::{NUMBER, Property, STRESS, component, positive, positive_or_zero};
use toron::user::state::{ALIVE, ENERGY_DENSITY, FAILED, StateVariable, variable};
use toron::user::vector::{dot, image, scale, transposed};
use toron::user::{Description, Direction, Reads, Real, Resistance, Response, Step, UserMaterial};

#[derive(Clone, Copy, Debug, Default)]
pub struct ReinforcedSolid;

static PROPERTIES: [Property; 7] = [
    positive("mu", "μ", STRESS, None, "shear modulus of the solid"),
    positive_or_zero("lambda", "Λ", STRESS, None, "first Lamé constant of the solid"),
    positive_or_zero("k", "k", STRESS, None, "stiffness of the fibres"),
    positive_or_zero("stretch_lim", "λ_lim", NUMBER, Some(0.0), "fibre stretch at failure, 0: no failure"),
    component("m_1", "m1", 1.0, "fibre direction in the reference placement, any length"),
    component("m_2", "m2", 0.0, "fibre direction in the reference placement, any length"),
    component("m_3", "m3", 0.0, "fibre direction in the reference placement, any length"),
];

static STATE: [StateVariable; 4] = [
    variable("energy", "W", ENERGY_DENSITY, "energy per reference volume"),
    variable("stretch", "λ", NUMBER, "stretch of the fibre"),
    FAILED,
    ALIVE,
];

/// The constants of the formulas.
#[derive(Clone, Copy)]
pub struct Constants<R> {
    mu: R,
    lambda: R,
    k: R,
    /// The square of the stretch at failure, or infinity.
    limit: R,
}

impl UserMaterial for ReinforcedSolid {
    const DESCRIPTION: Description = Description {
        title: "standard reinforcing model",
        properties: &PROPERTIES,
        state: &STATE,
        directions: &[Direction::fibre(4)],
        energies: 0..1,
        failed: 2,
        alive: 3,
        reads: Reads::NOTHING,
        lost: None,
        refusal: None,
    };
    type Properties<R: Real> = [R; 7];
    type State<R: Real> = [R; 2];
    type Constants<R: Real> = Constants<R>;

    #[inline(always)]
    fn constants<R: Real>(&[mu, lambda, k, stretch, ..]: &[R; 7]) -> Constants<R> {
        let fails = R::splat(0.0).lt(stretch);
        Constants { mu, lambda, k, limit: R::select(fails, stretch * stretch, R::splat(f64::INFINITY)) }
    }

    #[inline(always)]
    fn respond<R: Real>(c: &Constants<R>, step: &Step<R, [R; 2]>) -> Response<R, [R; 2]> {
        let (one, half) = (R::splat(1.0), R::splat(0.5));
        let ([x, y, z], a) = (transposed(&step.f), image(&step.f, step.fibre));
        let (inverse, logarithm, square) = (step.jacobian.reciprocal(), step.log_jacobian(), dot(a, a));
        let elongation = square - one;
        // σ = (μ (b − 1) + Λ ln J 1 + 2k (I4 − 1) a⊗a)/J, where b = FFᵀ has the products of the rows of F.
        let (solid, volume) = (c.mu * inverse, c.lambda * logarithm * inverse);
        let w = scale((c.k + c.k) * elongation * inverse, a);
        let (b_11, b_22, b_33) = (dot(x, x), dot(y, y), dot(z, z));
        let stress = [
            w[0].mul_add(a[0], solid.mul_add(b_11 - one, volume)),
            w[1].mul_add(a[1], solid.mul_add(b_22 - one, volume)),
            w[2].mul_add(a[2], solid.mul_add(b_33 - one, volume)),
            w[0].mul_add(a[1], solid * dot(x, y)),
            w[1].mul_add(a[2], solid * dot(y, z)),
            w[2].mul_add(a[0], solid * dot(z, x)),
        ];
        let first = half * ((b_11 - one) + (b_22 - one) + (b_33 - one)) - logarithm;
        let second = (c.lambda * logarithm).mul_add(logarithm, c.k * elongation * elongation);
        let energy = c.mu.mul_add(first, half * second);
        Response { failed: c.limit.le(square), ..Response::new(stress, [energy, square.sqrt()]) }
    }

    /// For a direction n and a polarisation u, unit vectors, ρ0 c² is at most (Λ (1 − ln J) + μ)(n·u)² + μ n·bn + 4k
    /// (a·n)²(a·u)² + 2k (I4 − 1)(a·n)²; no eigenvalue of b exceeds the largest sum of a row.
    #[inline(always)]
    fn wave_modulus<R: Real>(c: &Constants<R>, step: &Step<R, [R; 2]>, _: &Response<R, [R; 2]>) -> Option<R> {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        let ([x, y, z], a) = (transposed(&step.f), image(&step.f, step.fibre));
        let (xy, yz, zx) = (dot(x, y).abs(), dot(y, z).abs(), dot(z, x).abs());
        let largest = (dot(x, x) + xy + zx).max(dot(y, y) + xy + yz).max(dot(z, z) + yz + zx);
        let (square, volume) = (dot(a, a), c.lambda * (one - step.log_jacobian()) + c.mu);
        let fibres = c.k * square * (R::splat(4.0) * square + R::splat(2.0) * (square - one).max(zero));
        Some(volume.max(zero) + c.mu * largest + fibres)
    }

    /// Waves along and across the fibres; what holds a section's shape is the solid alone.
    fn resistance(&[mu, lambda, k, ..]: &[f64; 7]) -> Option<Resistance> {
        let across = lambda + 2.0 * mu;
        Some(Resistance { along: across + 4.0 * k, across, shape: mu, hourglass: mu })
    }
}
