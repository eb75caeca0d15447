//! A viscoelastic solid: a compressible neo-Hookean one beside a Maxwell branch, whose stress relaxes.
//!
//! Second Piola–Kirchhoff stress S = μ (1 − C⁻¹) + Λ ln J C⁻¹ + Q, C = FᵀF. The branch has the stress E = μ₁ (1 − C⁻¹)
//! at once, and loses it at the rate of its relaxation time τ, Q' + Q/τ = E'; with E linear in time over a step of
//! length Δt, to second order in Δt/τ (Simo, Comput. Methods Appl. Mech. Engrg. 60, 1987),
//!
//! ```text
//! Q ← exp(−Δt/τ) Q + exp(−½Δt/τ) (E − E_old)
//! ```
//!
//! Q and E are tensors of the reference placement, which no host turns. After a sudden stretch that is held, Q is E
//! exp(−t/τ) exactly.

use toron::user::parameters::{Dimension, Property, STRESS, positive, positive_or_zero};
use toron::user::state::{ALIVE, FAILED, StateVariable, variable};
use toron::user::vector::{cofactors, dot, transposed};
use toron::user::{Description, Reads, Real, Response, Step, UserMaterial};

#[derive(Clone, Copy, Debug, Default)]
pub struct ViscoelasticSolid;

const TIME: Dimension = Dimension { mass: 0, length: 0, time: 1, name: "time" };

static PROPERTIES: [Property; 4] = [
    positive("mu", "μ", STRESS, None, "shear modulus at rest"),
    positive_or_zero("lambda", "Λ", STRESS, None, "first Lamé constant"),
    positive_or_zero("mu_1", "μ1", STRESS, None, "shear modulus of the branch"),
    positive("tau", "τ", TIME, None, "relaxation time of the branch"),
];

static STATE: [StateVariable; 14] = [
    variable("q_11", "Q11", STRESS, "stress of the branch"),
    variable("q_22", "Q22", STRESS, "stress of the branch"),
    variable("q_33", "Q33", STRESS, "stress of the branch"),
    variable("q_12", "Q12", STRESS, "stress of the branch"),
    variable("q_23", "Q23", STRESS, "stress of the branch"),
    variable("q_31", "Q31", STRESS, "stress of the branch"),
    variable("e_11", "E11", STRESS, "stress that the branch would have without time"),
    variable("e_22", "E22", STRESS, "stress that the branch would have without time"),
    variable("e_33", "E33", STRESS, "stress that the branch would have without time"),
    variable("e_12", "E12", STRESS, "stress that the branch would have without time"),
    variable("e_23", "E23", STRESS, "stress that the branch would have without time"),
    variable("e_31", "E31", STRESS, "stress that the branch would have without time"),
    FAILED,
    ALIVE,
];

/// The constants of the formulas.
#[derive(Clone, Copy)]
pub struct Constants<R> {
    mu: R,
    lambda: R,
    mu_1: R,
    /// 1/τ.
    rate: R,
}

impl UserMaterial for ViscoelasticSolid {
    const DESCRIPTION: Description = Description {
        title: "viscoelastic solid",
        properties: &PROPERTIES,
        state: &STATE,
        directions: &[],
        energies: 0..0,
        failed: 12,
        alive: 13,
        reads: Reads { time_increment: true, ..Reads::NOTHING },
        lost: None,
        refusal: None,
    };
    type Properties<R: Real> = [R; 4];
    type State<R: Real> = [R; 12];
    type Constants<R: Real> = Constants<R>;

    #[inline(always)]
    fn constants<R: Real>(&[mu, lambda, mu_1, tau]: &[R; 4]) -> Constants<R> {
        Constants { mu, lambda, mu_1, rate: R::splat(1.0) / tau }
    }

    #[inline(always)]
    fn respond<R: Real>(c: &Constants<R>, step: &Step<R, [R; 12]>) -> Response<R, [R; 12]> {
        let (one, half) = (R::splat(1.0), R::splat(0.5));
        let passed = half * step.time_increment * c.rate;
        let kept = (-passed).exp();
        let [q_11, q_22, q_33, q_12, q_23, q_31, old @ ..] = step.state;
        let inverse = step.jacobian.reciprocal();
        // C⁻¹ = BᵀB with B = F⁻ᵀ, whose columns are the cofactors over J.
        let (_, b) = cofactors(&step.f);
        let over = inverse * inverse;
        let [b_11, b_22, b_33] = [dot(b[0], b[0]) * over, dot(b[1], b[1]) * over, dot(b[2], b[2]) * over];
        let [b_12, b_23, b_31] = [dot(b[0], b[1]) * over, dot(b[1], b[2]) * over, dot(b[2], b[0]) * over];
        let m = -c.mu_1;
        let now = [m * (b_11 - one), m * (b_22 - one), m * (b_33 - one), m * b_12, m * b_23, m * b_31];
        let mut q = [q_11, q_22, q_33, q_12, q_23, q_31];
        let mut i = 0;
        while i < 6 {
            q[i] = kept * (kept.mul_add(q[i], now[i] - old[i]));
            i += 1;
        }
        // σ = (μ (FFᵀ − 1) + Λ ln J 1 + FQFᵀ)/J.
        let [x, y, z] = transposed(&step.f);
        let rows = [x, y, z];
        let (mut fq, mut k) = (rows, 0);
        while k < 3 {
            let r = rows[k];
            fq[k] = [dot(r, [q[0], q[3], q[5]]), dot(r, [q[3], q[1], q[4]]), dot(r, [q[5], q[4], q[2]])];
            k += 1;
        }
        let (solid, volume) = (c.mu * inverse, c.lambda * step.log_jacobian() * inverse);
        let stress = [
            inverse.mul_add(dot(fq[0], x), solid.mul_add(dot(x, x) - one, volume)),
            inverse.mul_add(dot(fq[1], y), solid.mul_add(dot(y, y) - one, volume)),
            inverse.mul_add(dot(fq[2], z), solid.mul_add(dot(z, z) - one, volume)),
            inverse.mul_add(dot(fq[0], y), solid * dot(x, y)),
            inverse.mul_add(dot(fq[1], z), solid * dot(y, z)),
            inverse.mul_add(dot(fq[2], x), solid * dot(z, x)),
        ];
        let [e_11, e_22, e_33, e_12, e_23, e_31] = now;
        let [q_11, q_22, q_33, q_12, q_23, q_31] = q;
        Response::new(stress, [q_11, q_22, q_33, q_12, q_23, q_31, e_11, e_22, e_33, e_12, e_23, e_31])
    }
}
