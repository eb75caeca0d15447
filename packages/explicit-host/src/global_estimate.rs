//! A global estimate of the stable step: the largest eigenvalue of all bodies together, by a power iteration that goes
//! on while they move.
//!
//! Bounds element by element ([`step_limit`](super::step_limit)) add the wave along the fibre of an element to the
//! contact at its nodes, and these have different modes. Here a trial motion x of all nodes becomes M⁻¹A x, one
//! iteration every 32 steps. A has the form that bounds the law's stiffness in each element, hourglass control, twice
//! the viscosity over the step, the springs of contact as if all of them stuck, and the ties.
//!
//! Every part of a settled motion grows by the largest eigenvalue in an iteration. The estimate is the largest growth
//! of any group of nodes, which is no less than the growth of the whole: a stiffer region shows in its own group before
//! its motion is larger than the others'. For that, no group's motion may become smaller than a part of the largest
//! one. A group that is lifted to this part grows by less than the largest eigenvalue, so that this does not raise the
//! estimate once the motion has settled.
//!
//! What the iteration may not have seen yet is bounded: the step is never longer than what each element's own waves and
//! viscosity, and the contact at each node, allow without safety; what the elements' bound has grown by since the last
//! iteration is added; and after a jump of the bound it holds alone until the motion has settled again. It also holds
//! alone once an element has failed.

#![expect(clippy::needless_range_loop, reason = "what is inlined for certain: see Lanes")]

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::body::Body;
use super::element::Measures;
use super::lanes::{LANES, Lanes, Number, add, combine, cross, dot, largest, less, load};
use super::medium::Medium;
use super::mutual_contact::MutualContact;
use super::striker::Striker;
use super::wave_bounds::{Section, bounds_at};

/// Nodes whose growth is looked at together.
const GROUP: usize = 1024;
/// No group's motion is smaller than this part of the largest one.
const LEAST: f64 = 1e-2;
/// Iterations until the motion has settled, from noise; until then there is one in every step, and no estimate.
const SETTLED: u64 = 20;
/// Steps from one iteration to the next.
const EVERY: u64 = 32;
/// If the elements' bound is so many times what it was at the last iteration, it holds alone for this many iterations,
/// one a step.
const JUMP: f64 = 1.1;
const AFTER_JUMP: u64 = 8;
/// The estimate falls no faster in an iteration, once it has settled.
const FADE: f64 = 0.9;

/// Springs of contact count as so many times as stiff: what touches and lets go near its longest stable step makes
/// energy.
pub const CONTACT: f64 = 1.2;

/// What a body knows of its trial motion in a step.
#[derive(Clone, Debug, Default)]
pub struct Trial<T> {
    /// Minus A x.
    pub resisted: Vec<[T; 3]>,
    /// Of each group, after the iteration, and the largest of what they have grown by.
    sizes: Vec<f64>,
    growth: f64,
}

impl<T: Number> Trial<T> {
    /// Before an iteration of this motion, which begins as noise.
    pub fn start(&mut self, motion: &mut Vec<[T; 3]>, nodes: usize) {
        self.resisted.clear();
        self.resisted.resize(nodes, [T::default(); 3]);
        if motion.is_empty() {
            let mut random = fastrand::Rng::with_seed(1);
            let mut number = || T::from_f64(random.f64() - 0.5);
            motion.extend((0..nodes).map(|_| [number(), number(), number()]));
        }
    }
}

/// What is known of the largest eigenvalue.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Estimate {
    iterations: u64,
    rate: f64,
    /// The stable step that stood for Δt in the damping, and the elements' bound then.
    reference: f64,
    bound: f64,
    /// Steps since the last iteration.
    steps: u64,
}

impl Estimate {
    /// Whether there is an iteration in the coming step.
    pub fn is_due(&self) -> bool {
        self.iterations < SETTLED || self.steps >= EVERY
    }

    /// Takes an iteration's growth over.
    pub fn take(&mut self, growth: f64, reference: f64) {
        self.iterations += 1;
        let left = if self.iterations > SETTLED { FADE * self.rate } else { 0.0 };
        self.rate = largest(growth, left);
        (self.reference, self.steps) = (reference, 0);
    }

    /// The rate in a step of this bound of the elements, if it is less; no less than `least`.
    pub fn rate(&mut self, bound: f64, least: f64) -> Option<f64> {
        let has_jumped = bound > JUMP * self.bound;
        if has_jumped {
            self.iterations = self.iterations.min(SETTLED - AFTER_JUMP);
        }
        if has_jumped || self.steps == 0 {
            self.bound = bound;
        }
        self.steps += 1;
        let rate = largest(self.rate + (bound - self.bound).max(0.0), least);
        (self.iterations >= SETTLED && rate < bound).then_some(rate)
    }

    /// The stable step of a rate: in a shorter step than the reference there is more damping.
    pub fn stable_step(&self, rate: f64) -> f64 {
        let step = 2.0 / rate.sqrt();
        if step < self.reference { step * step / self.reference } else { step }
    }
}

/// An iteration, where the elements' part of it has been added up; returns the largest growth.
pub fn iterate<T: Number>(bodies: &mut [Body<T>], mutual: &MutualContact, striker: Option<&Striker>) -> f64 {
    mutual.resist(bodies);
    if let Some(striker) = striker {
        for (contact, body) in striker.contacts.iter().zip(&mut *bodies) {
            contact.resist(&body.state.trial, &mut body.trial.resisted);
        }
    }
    bodies.par_iter_mut().for_each(Body::iterate);
    let sizes = bodies.iter().flat_map(|body| &body.trial.sizes);
    let most = sizes.fold(0.0, |most, &size| largest(size, most));
    bodies.par_iter_mut().for_each(|body| body.scale_trial(most));
    bodies.iter().map(|body| body.trial.growth).fold(0.0, |most, growth| largest(growth, most))
}

impl<T: Number> Body<T> {
    /// The largest rate of an element without contact, or of the contact at a node.
    pub fn rate_alone(&self) -> f64 {
        let own = self.blocks.iter().flat_map(|block| &block.group_rates);
        own.fold(self.most_contact, |most, &rate| largest(most, rate.into()))
    }

    /// From what resists the trial motion to the next one, not scaled yet.
    fn iterate(&mut self) {
        let Trial { resisted, sizes, growth } = &mut self.trial;
        for tie in &self.ties {
            let force = std::mem::take(&mut resisted[tie.node as usize]);
            for (corner, share) in tie.parts() {
                for i in 0..3 {
                    resisted[corner][i] += T::from_f64(share) * force[i];
                }
            }
        }
        sizes.clear();
        *growth = 0.0;
        let motions = self.state.trial.chunks_mut(GROUP).zip(resisted.chunks(GROUP));
        let masses = self.mobility.chunks(GROUP).zip(self.mass.chunks(GROUP));
        for ((motions, resisted), (mobilities, masses)) in motions.zip(masses) {
            let (mut before, mut after) = (0.0, 0.0);
            for (((x, force), mobility), mass) in motions.iter_mut().zip(resisted).zip(mobilities).zip(masses) {
                for i in 0..3 {
                    // Directions that are not free take no part.
                    let old: f64 = if mobility[i] > T::default() { x[i].into() } else { 0.0 };
                    x[i] = force[i] * mobility[i];
                    let new: f64 = x[i].into();
                    before += mass * old * old;
                    after += mass * new * new;
                }
            }
            *growth = largest(if before == 0.0 { 0.0 } else { (after / before).sqrt() }, *growth);
            sizes.push(after.sqrt());
        }
    }

    /// Scales the trial motion by the largest size of all groups, and lifts what is too small.
    fn scale_trial(&mut self, most: f64) {
        let motion = &mut self.state.trial;
        for (nodes, &size) in motion.chunks_mut(GROUP).zip(&self.trial.sizes) {
            let factor = T::from_f64(if size > 0.0 { (1.0 / most).max(LEAST / size) } else { 0.0 });
            for component in nodes.as_flattened_mut() {
                *component = factor * *component;
            }
        }
        for tie in &self.ties {
            let mut follows = [T::default(); 3];
            for (corner, share) in tie.parts() {
                for i in 0..3 {
                    follows[i] += T::from_f64(share) * motion[corner][i];
                }
            }
            motion[tie.node as usize] = follows;
        }
    }
}

/// What elements' resistance follows from.
pub struct Deformed<'a, T> {
    pub f: &'a [T],
    pub stress: &'a [T],
    pub measures: &'a Measures<T>,
    pub wave_speed: &'a [T],
    pub intact: &'a [T],
}

/// From the gradient by X of a trial motion, by columns, to the nominal stress that resists it.
#[inline(always)]
pub fn resist<T: Number>(medium: &Medium<T>, stride: usize, of: &Deformed<'_, T>, twice: f64, trial: &mut [T]) {
    let Deformed { f, stress, measures, wave_speed, intact } = *of;
    let section = Section {
        volume_ratio: &measures.volume_ratio,
        stretch_square: &measures.stretch_square,
        metric: &measures.metric,
    };
    let (zero, one, half) = (Lanes::zero(), Lanes::constant(1.0), Lanes::constant(0.5));
    let (density, damping) = (Lanes::constant(medium.density), Lanes::constant(twice * medium.density));
    for group in 0..stride / LANES {
        let first = group * LANES;
        let active = measures.active(intact, first);
        let speed = Lanes::at(wave_speed, first);
        let own = speed * speed * density;
        let bounds = bounds_at(&medium.bounds, own, f, stress, &section, stride, first);
        let [nu_m, nu_t, eta] = load(&measures.viscosities, stride, first);
        let elongation = bounds.returning * bounds.elongation + damping * nu_m;
        let compaction = bounds.compaction + damping * nu_t;
        let distortion = bounds.distortion + damping * eta;
        let (tension, all_round) = (bounds.tension, bounds.all_round);
        let [f0, f1, f2, f3, f4, f5, f6, f7, f8] = load(f, stride, first);
        let [u, v, w] = [[f0, f1, f2], [f3, f4, f5], [f6, f7, f8]];
        let per_ratio = (one / Lanes::at(&measures.volume_ratio, first)).only_where(active);
        let per_stretch = one / Lanes::at(&measures.stretch_square, first).sqrt();
        // Rows of F's inverse.
        let r = [scaled(per_ratio, cross(v, w)), scaled(per_ratio, cross(w, u)), scaled(per_ratio, cross(u, v))];
        let [h0, h1, h2, h3, h4, h5, h6, h7, h8] = load(trial, stride, first);
        let h = [[h0, h1, h2], [h3, h4, h5], [h6, h7, h8]];
        let m = scaled(per_stretch, u);
        let gm = scaled(per_stretch, h[0]);
        let along = dot(m, gm);
        let turning = less(gm, along, m);
        let growth = dot(h[0], r[0]) + dot(h[1], r[1]) + dot(h[2], r[2]) - along;
        for j in 0..3 {
            // m·r, r across the fibre, h r, and the section's part of sym h times that.
            let slant = if j == 0 { per_stretch } else { zero };
            let q = less(r[j], slant, m);
            let mut gr = [zero, zero, zero];
            let mut e = [zero, zero, zero];
            for k in 0..3 {
                gr = less(gr, zero - dot(r[k], r[j]), h[k]);
                e = add(e, combine(half * dot(r[k], q), h[k], half * dot(h[k], q), r[k]));
            }
            let e = less(e, dot(e, m), m);
            let of_fibre = combine(elongation * along * slant, m, tension * slant, turning);
            let section = combine((compaction - distortion) * growth, q, distortion + distortion, e);
            let p = add(add(of_fibre, section), scaled(all_round, gr));
            for i in 0..3 {
                p[i].only_where(active).store(trial, (i + 3 * j) * stride + first);
            }
        }
    }
}

#[inline(always)]
fn scaled<T: Number>(k: Lanes<T>, a: [Lanes<T>; 3]) -> [Lanes<T>; 3] {
    [k * a[0], k * a[1], k * a[2]]
}

#[cfg(test)]
mod tests;
