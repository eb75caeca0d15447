//! A metal by von Mises: Hencky's elasticity, and a yield stress that grows with the plastic strain.
//!
//! F = F_e F_p with det F_p = 1 and b = F_e F_eᵀ. W = ½ K (ln J)² + G |dev ½ ln b|² per reference volume, so that τ = K
//! ln J 1 + 2G dev ½ ln b, and plastic flow along dev τ where q = √(3/2) |dev τ| reaches the yield stress
//!
//! ```text
//! y(α) = y_0 + (y_s − y_0)(1 − exp(−δα)) + h α                          (Voce, J. Inst. Met. 74, 1948)
//! ```
//!
//! α being the equivalent plastic strain. With the exponential of the flow over a step (Weber and Anand, Comput.
//! Methods Appl. Mech. Engrg. 79, 1990; Simo, ibid. 99, 1992) the return is that of small strains, in ½ ln b with C_p⁻¹
//! held: α grows by the root x of q − 3G x = y(α + x), and dev τ shrinks by 1 − 3G x/q. Newton's steps from 0 fall
//! short of x and never pass it, since y is concave.
//!
//! The state has C_p⁻¹ − 1, a tensor of the reference placement, which no host turns. Of the plastic work y dα the part
//! y_0 dα is lost; what the yield stress has grown by is counted as stored.

use toron::user::parameters::{NUMBER, Property, STRESS, positive, positive_or_zero};
use toron::user::state::{ALIVE, ENERGY_DENSITY, FAILED, StateVariable, variable};
use toron::user::tensor::{exponential, inverse, logarithm};
use toron::user::vector::{Matrix, product, scaled, square_norm, sum, transposed};
use toron::user::{Description, Reads, Real, Resistance, Response, Step, UserMaterial};
use toron::{Error, Value, status};

#[derive(Clone, Copy, Debug, Default)]
pub struct PlasticSolid;

static PROPERTIES: [Property; 6] = [
    positive("bulk", "K", STRESS, None, "bulk modulus"),
    positive("shear", "G", STRESS, None, "shear modulus"),
    positive("yield", "y0", STRESS, None, "yield stress at first"),
    positive("saturation", "ys", STRESS, None, "yield stress that it grows to, at least that at first"),
    positive_or_zero("rate", "δ", NUMBER, Some(0.0), "how fast it grows, by plastic strain"),
    positive_or_zero("hardening", "h", STRESS, Some(0.0), "slope of the yield stress in the end"),
];

static STATE: [StateVariable; 11] = [
    variable("stored", "W", ENERGY_DENSITY, "energy stored per reference volume"),
    variable("lost", "D", ENERGY_DENSITY, "energy lost per reference volume"),
    variable("plastic", "α", NUMBER, "equivalent plastic strain"),
    variable("c_11", "Cp11", NUMBER, "inverse plastic metric less 1"),
    variable("c_22", "Cp22", NUMBER, "inverse plastic metric less 1"),
    variable("c_33", "Cp33", NUMBER, "inverse plastic metric less 1"),
    variable("c_12", "Cp12", NUMBER, "inverse plastic metric"),
    variable("c_23", "Cp23", NUMBER, "inverse plastic metric"),
    variable("c_31", "Cp31", NUMBER, "inverse plastic metric"),
    FAILED,
    ALIVE,
];

/// Newton's steps: more than any metal needs; the step is refused where they are not enough.
const STEPS: usize = 16;
/// Roundings that may be left of q − 3G x − y, of which q and y_s are the largest terms.
const LEFT: f64 = 16.0;

/// The constants of the formulas.
#[derive(Clone, Copy)]
pub struct Constants<R> {
    bulk: R,
    shear: R,
    first: R,
    /// y_s − y_0.
    growth: R,
    rate: R,
    hardening: R,
}

impl<R: Real> Constants<R> {
    /// y(α), and its slope.
    #[inline(always)]
    fn yield_stress(&self, plastic: R) -> (R, R) {
        let gone = self.growth * (-(self.rate * plastic)).exp();
        let linear = self.hardening.mul_add(plastic, self.first + self.growth);
        (linear - gone, self.rate.mul_add(gone, self.hardening))
    }

    /// What the yield stress has grown by, times dα, up to α.
    #[inline(always)]
    fn stored(&self, plastic: R) -> R {
        let (half, one) = (R::splat(0.5), R::splat(1.0));
        let slow = self.rate.le(R::splat(0.0));
        let rate = R::select(slow, one, self.rate);
        let gone = (one - (-(rate * plastic)).exp()) / rate;
        let of_growth = R::select(slow, R::splat(0.0), self.growth * (plastic - gone));
        (half * self.hardening * plastic).mul_add(plastic, of_growth)
    }

    /// x of q − 3G x = y(α + x), and where it has been found.
    #[inline(always)]
    fn increment(&self, q: R, plastic: R) -> (R, R::Mask) {
        let triple = R::splat(3.0) * self.shear;
        let (mut x, mut k) = (R::splat(0.0), 0);
        while k < STEPS {
            let (stress, slope) = self.yield_stress(plastic + x);
            x += (q - triple * x - stress) / (triple + slope);
            k += 1;
        }
        let (stress, _) = self.yield_stress(plastic + x);
        let off = (q - triple * x - stress).abs();
        (x, off.le(R::splat(LEFT * R::EPSILON) * (q + self.first + self.growth)))
    }
}

impl UserMaterial for PlasticSolid {
    const DESCRIPTION: Description = Description {
        title: "metal by von Mises",
        properties: &PROPERTIES,
        state: &STATE,
        directions: &[],
        energies: 0..1,
        failed: 9,
        alive: 10,
        reads: Reads::NOTHING,
        lost: Some(1),
        refusal: Some("the return to the yield surface does not converge"),
    };
    type Properties<R: Real> = [R; 6];
    type State<R: Real> = [R; 9];
    type Constants<R: Real> = Constants<R>;

    fn check(&[_, _, first, saturation, ..]: &[f64; 6]) -> Result<(), Error> {
        if saturation < first {
            let wanted = "a number from the first yield stress on";
            return Err(Error::Argument { name: "saturation", value: Value::of(saturation), wanted });
        }
        Ok(())
    }

    #[inline(always)]
    fn constants<R: Real>(&[bulk, shear, first, saturation, rate, hardening]: &[R; 6]) -> Constants<R> {
        Constants { bulk, shear, first, growth: saturation - first, rate, hardening }
    }

    #[inline(always)]
    fn respond<R: Real>(c: &Constants<R>, step: &Step<R, [R; 9]>) -> Response<R, [R; 9]> {
        let (zero, one, half) = (R::splat(0.0), R::splat(1.0), R::splat(0.5));
        let [_, lost, plastic, c_11, c_22, c_33, c_12, c_23, c_31] = step.state;
        let metric = [[one + c_11, c_12, c_31], [c_12, one + c_22, c_23], [c_31, c_23, one + c_33]];
        // The part of b that keeps the volume.
        let shrunk = (R::splat(-2.0 / 3.0) * step.log_jacobian()).exp();
        let trial = scaled(shrunk, &product(&product(&step.f, &metric), &transposed(&step.f)));
        let strain = deviator(&scaled(half, &logarithm(&symmetric(&trial))));
        let length = square_norm(&strain);
        // √(3/2) |2G ε|, and 0 with a slope where there is no strain.
        let none = length.le(zero);
        let q = R::splat(6.0_f64.sqrt()) * c.shear * R::select(none, zero, R::select(none, one, length).sqrt());
        let (limit, _) = c.yield_stress(plastic);
        let yields = limit.lt(q);
        let (x, converged) = c.increment(R::select(yields, q, limit), plastic);
        let x = R::select(yields, x, zero);
        let kept = one - R::splat(3.0) * c.shear * x / R::select(yields, q, one);
        let elastic = scaled(kept, &strain);
        let volume = step.log_jacobian();
        let inverse_jacobian = step.jacobian.reciprocal();
        let (twice, pressure) = (R::splat(2.0) * c.shear * inverse_jacobian, c.bulk * volume * inverse_jacobian);
        let e = &elastic;
        let stress = [
            twice.mul_add(e[0][0], pressure),
            twice.mul_add(e[1][1], pressure),
            twice.mul_add(e[2][2], pressure),
            twice * e[1][0],
            twice * e[2][1],
            twice * e[0][2],
        ];
        let plastic = plastic + x;
        let of_volume = half * c.bulk * volume * volume;
        let stored = c.shear.mul_add(square_norm(e), of_volume) + c.stored(plastic);
        // C_p⁻¹ = F⁻¹ b F⁻ᵀ of the strain that is kept; what did not yield keeps its own.
        let back = inverse(&step.f);
        let of_shape = exponential(&scaled(R::splat(2.0), e));
        let new = scaled(one / shrunk, &product(&product(&back, &of_shape), &transposed(&back)));
        let keep = |new: R, old: R| R::select(yields, new, old);
        let state = [
            stored,
            c.first.mul_add(x, lost),
            plastic,
            keep(new[0][0] - one, c_11),
            keep(new[1][1] - one, c_22),
            keep(new[2][2] - one, c_33),
            keep(new[1][0], c_12),
            keep(new[2][1], c_23),
            keep(new[0][2], c_31),
        ];
        let fault = R::splat(f64::from(status::LAW));
        Response { status: R::select(converged, zero, fault), ..Response::new(stress, state) }
    }

    fn resistance(&[bulk, shear, ..]: &[f64; 6]) -> Option<Resistance> {
        let modulus = bulk + 4.0 / 3.0 * shear;
        Some(Resistance { along: modulus, across: modulus, shape: shear, hourglass: shear })
    }
}

/// A less a third of its trace.
#[inline(always)]
fn deviator<R: Real>(a: &Matrix<R>) -> Matrix<R> {
    let mean = R::splat(1.0 / 3.0) * (a[0][0] + a[1][1] + a[2][2]);
    sum(a, -mean, &toron::user::tensor::identity())
}

/// Without what roundings have made of a symmetric matrix.
#[inline(always)]
fn symmetric<R: Real>(a: &Matrix<R>) -> Matrix<R> {
    scaled(R::splat(0.5), &sum(a, R::splat(1.0), &transposed(a)))
}
