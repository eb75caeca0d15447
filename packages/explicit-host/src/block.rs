//! Blocks of elements of one law: the history arrays, and the call of the law through its C entry.

use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::element::{Measures, Shapes};
use super::global_estimate::{Deformed, resist};
use super::instructions::{Loops, run_widest};
use super::lanes::{LANES, Lanes, Number, largest};
use super::medium::{Entry, Medium};
use super::own::Elements;
use super::rows::Rows;
use super::sliding;
use super::solid::{self, SOLID_VON_MISES, SOLID_WORK};
use super::stress::{Points, nominal_stress};
use super::viscosity::Viscosity;
use super::wave_bounds::{Section, bounds_at};
use toron::law::resistance::ShearLimit;
use toron::law::state::{FAILURE_INDEX, FRICTIONAL_FAILED, INVARIANTS, LINEAR_LARGEST, LINEAR_STRESS, LINEAR_WORK};
use toron::law::status;
use toron_c::{LinearElasticLaw, TORON_CRITERION_FIBRE};
use toron_materials::entries::blocks::{LinearFrame, LinearSolverBlock, SolverBlock, linear_elastic_block};
use toron_materials::entries::hosts::Given;

/// Elements a block: large enough for the entry's preparation to cost nothing, small enough for its arrays to stay in
/// the first cache (vector lengths of explicit solvers are of this order).
pub const BLOCK: usize = 128;
/// An element that may fail has collapsed also where its section is this many times as large as at rest. The law lets
/// sections grow, and what is left at torn ends would fill the hole and hold a striker that the yarns let through.
pub const SWOLLEN: f64 = 50.0;

/// Working arrays for one block at a time; they carry nothing over to the next.
#[derive(Debug)]
pub struct Scratch<T> {
    deformation_gradient: Vec<T>,
    modal: Vec<T>,
    /// Of a trial motion: its gradient by columns, then what resists it, and its hourglass modes.
    trial: Vec<T>,
    trial_modal: Vec<T>,
    stress: Vec<T>,
    /// P by columns.
    nominal: Vec<T>,
    measures: Measures<T>,
    wave_speed: Vec<T>,
    /// The shear that a section holds which slides.
    shear_limit: Vec<T>,
    /// 1 where an element's own step is too short.
    collapsed: Vec<T>,
    status: Vec<i32>,
}

impl<T: Number> Default for Scratch<T> {
    fn default() -> Self {
        let array = |components: usize| vec![T::default(); components * BLOCK];
        Scratch {
            deformation_gradient: array(9),
            modal: array(12),
            trial: array(9),
            trial_modal: array(12),
            stress: array(6),
            nominal: array(9),
            measures: Measures::new(BLOCK),
            wave_speed: array(1),
            shear_limit: array(1),
            collapsed: array(1),
            status: vec![0; BLOCK],
        }
    }
}

/// What is computed in a step beside the forces, and the lengths of steps.
#[derive(Clone, Copy, Debug, Default)]
pub struct StepOptions {
    /// Energies and invariants of the law.
    pub law_outputs: bool,
    /// The hourglass energy, which only the energy balance needs.
    pub energy_balance: bool,
    /// Length of the last step, and the time at its end.
    pub step: f64,
    pub time: f64,
    /// The stable step below which an element that may fail has collapsed, its fibre taken for tense.
    pub shortest: f64,
    /// Whether elements have failed: from then on those of a law of one's own may, of which it is not known before.
    pub has_failed: bool,
    /// The stable step at which damping is taken for a stiffness: the last one by the elements' bound.
    pub reference: f64,
    /// In a step with an iteration of the [global estimate](super::global_estimate), the last stable step: there damping
    /// is taken for a stiffness at it.
    pub trial: Option<f64>,
}

/// Sums over the blocks in a step.
#[derive(Clone, Debug, Default)]
pub struct Sums {
    /// Energy that viscosity has dissipated, and hourglass control where it slides.
    pub viscosity: f64,
    /// Energy in hourglass modes, and the part of it that elements deleted in this step release.
    pub hourglass: f64,
    pub released: f64,
    /// Elements deleted in this step, and how many of them because they have collapsed or turned inside out.
    pub deleted: Vec<usize>,
    pub collapsed: usize,
    /// The code of a law that has refused its call.
    pub refused: Option<i32>,
    /// Time spent inside the law's entries.
    pub law: Duration,
}

/// Numbers of a body's nodes: where they are and what forces are added up there, and the same of a trial motion in a
/// step with an iteration.
pub struct Nodal<'a, T> {
    pub displacement: &'a [[T; 3]],
    pub forces: &'a mut [[T; 3]],
    pub trial: &'a [[T; 3]],
    pub resisted: &'a mut [[T; 3]],
}

/// Before the law is called: from displacements to deformation gradients and hourglass modes.
struct Deform<'a, T> {
    shapes: &'a Shapes<T>,
    displacement: &'a [[T; 3]],
    slid: &'a Rows<T>,
    scratch: &'a mut Scratch<T>,
}

/// After it: from stresses to nodal forces.
struct Forces<'a, T> {
    block: &'a mut ElementBlock<T>,
    medium: &'a Medium<T>,
    scratch: &'a mut Scratch<T>,
    options: StepOptions,
    sums: &'a mut Sums,
    forces: &'a mut [[T; 3]],
    trial: &'a [[T; 3]],
    resisted: &'a mut [[T; 3]],
}

impl<T: Number> Loops for Deform<'_, T> {
    #[inline(always)]
    fn run(self) {
        let Scratch { deformation_gradient, modal, .. } = self.scratch;
        self.shapes.deform(self.displacement, self.slid, deformation_gradient, modal);
    }
}

impl<T: Number> Loops for Forces<'_, T> {
    #[inline(always)]
    fn run(self) {
        let Forces { block, medium, scratch, options, sums, forces, trial, resisted } = self;
        block.shapes.measure(&scratch.deformation_gradient, &mut scratch.measures);
        let StepOptions { step, .. } = options;
        let ElementBlock { shapes, history, .. } = &mut *block;
        let Scratch { measures, deformation_gradient, modal, shear_limit, .. } = &mut *scratch;
        let limit = if history.slid.is_empty() { &[][..] } else { &shear_limit[..] };
        sums.viscosity += history.viscosity.advance(medium, shapes, measures, &history.intact, limit, step);
        let mut shared = 0.0;
        if !history.slid.is_empty() {
            let of = sliding::Elements { f: deformation_gradient, measures, intact: &history.intact, limit };
            let slid = sliding::slide([medium.hourglass, medium.least_shear], shapes, of, &mut history.slid, modal);
            (sums.viscosity, shared) = (sums.viscosity + slid.lost, slid.shared);
        }
        block.bound_step(medium, scratch, options, shared);
        let point = Points {
            deformation_gradient: &scratch.deformation_gradient,
            stress: &scratch.stress,
            viscosity: &block.history.viscosity,
        };
        nominal_stress(block.shapes.stride, &point, &mut scratch.nominal);
        let History { intact, slid, .. } = &block.history;
        block.shapes.forces(&scratch.nominal, &scratch.modal, intact, slid, forces);
        if let Some(reference) = options.trial {
            block.resist(medium, scratch, reference, trial, resisted);
        }
    }
}

/// Elements of one medium, with their history.
#[derive(Clone, Debug)]
pub struct ElementBlock<T> {
    pub shapes: Shapes<T>,
    /// The body's number of the first element, and the number of the medium.
    pub first: usize,
    pub medium: usize,
    pub history: History<T>,
    /// ln(1 + ε_lim), or the linear elastic law's strength, of each element where they have limits of their own; else
    /// empty.
    limit: Vec<T>,
    /// Of this step: what limits the next one, and how much of it is viscosity's; the largest of a whole group of
    /// [`LANES`].
    pub rates: Vec<T>,
    pub viscous: Vec<T>,
    /// What a corner resists alone, at most.
    pub corners: Vec<T>,
    pub group_rates: Vec<T>,
}

/// What a block's elements remember from step to step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct History<T> {
    /// State variables, component-major.
    state: Vec<T>,
    /// 1, or 0 once the element is deleted.
    pub intact: Vec<T>,
    viscosity: Viscosity<T>,
    /// Of hourglass control where sections slide, see [`sliding`]; else empty.
    slid: Rows<T>,
    /// The deformation gradient at the start of the step, of the linear elastic law and of laws of one's own.
    f_old: Vec<T>,
}

impl<T: Number> ElementBlock<T> {
    pub fn new(
        elements: &[[u32; 8]],
        fibre: &[[f64; 3]],
        first: usize,
        coordinates: &[[f64; 3]],
        medium: usize,
        of: &Medium<T>,
    ) -> Self {
        let shapes = Shapes::<T>::new(elements, fibre, coordinates, of.hourglass);
        let (stride, one) = (shapes.stride, T::from_f64(1.0));
        ElementBlock {
            first,
            medium,
            history: History {
                state: vec![T::default(); of.state().0 * stride],
                intact: vec![one; stride],
                viscosity: Viscosity::new(&shapes),
                slid: if of.shear_limit.is_some() { sliding::fresh(shapes.n) } else { Rows::new(0, 0) },
                f_old: shapes.at_rest(),
            },
            limit: Vec::new(),
            rates: vec![T::default(); stride],
            viscous: vec![T::default(); stride],
            corners: vec![T::default(); stride],
            group_rates: vec![T::default(); stride / LANES],
            shapes,
        }
    }

    /// Gives each element a failure limit of its own: ln(1 + ε_lim), or the linear elastic law's strength.
    pub fn limit(&mut self, limits: &[f64]) {
        self.limit = limits.iter().map(|&limit| T::from_f64(limit)).collect();
    }

    /// From the nodes' displacements to their forces; updates the history.
    pub fn advance(
        &mut self,
        medium: &Medium<T>,
        Nodal { displacement, forces, trial, resisted }: Nodal<'_, T>,
        scratch: &mut Scratch<T>,
        options: StepOptions,
        sums: &mut Sums,
    ) {
        run_widest(Deform { shapes: &self.shapes, displacement, slid: &self.history.slid, scratch });
        let start = Instant::now();
        let code = self.call_law(medium, scratch, options);
        sums.refused = sums.refused.or(refused(code));
        sums.law += start.elapsed();
        // Elements that cannot be evaluated are deleted before their forces are assembled; those that have failed or
        // collapsed exert their last stress.
        let others = sums.deleted.len();
        self.delete(medium, scratch, sums, |block, scratch, i| scratch.status[i] != status::OK && block.is_intact(i));
        sums.collapsed += sums.deleted.len() - others;
        self.limit_shear(medium, scratch);
        run_widest(Forces { block: self, medium, scratch, options, sums, forces, trial, resisted });
        let (latch, stride) = (medium.state().1, self.shapes.stride);
        self.delete(medium, scratch, sums, |block, _, i| {
            block.history.state[latch * stride + i] != T::default() && block.is_intact(i)
        });
        let failed = sums.deleted.len();
        self.delete(medium, scratch, sums, |block, scratch, i| {
            let fails = medium.fails || options.has_failed && matches!(medium.entry, Entry::Own(_));
            fails && scratch.collapsed[i] != T::default() && block.is_intact(i)
        });
        sums.collapsed += sums.deleted.len() - failed;
        if options.energy_balance {
            let intact = (0..self.shapes.n).filter(|&i| self.is_intact(i));
            sums.hourglass += intact.map(|i| self.shapes.hourglass_energy(i, &scratch.modal)).sum::<f64>();
        }
    }

    /// From the deformation gradients to stresses and wave speeds; updates the history. Returns the entry's code.
    fn call_law(&mut self, medium: &Medium<T>, scratch: &mut Scratch<T>, options: StepOptions) -> i32 {
        match &medium.entry {
            Entry::Hyperelastic(law) => self.solver_block(medium, scratch, options).arrays().call(Given::Prepared(law)),
            // The slip is remembered whether elements may fail or not, and the kernels are compiled for all of the
            // state.
            Entry::Frictional(law) => {
                let all = SolverBlock { energies: true, failure: true, ..self.solver_block(medium, scratch, options) };
                all.call_frictional(law)
            }
            Entry::LinearElastic { law, frame, criterion, .. } => {
                let code = self.call_linear_elastic(law, *frame, *criterion, scratch);
                scratch.wave_speed.fill(T::from_f64(medium.wave_speed));
                code
            }
            Entry::Own(own) => {
                let History { state, f_old, .. } = &mut self.history;
                own.advance(Elements {
                    n: self.shapes.n,
                    stride: self.shapes.stride,
                    f_old,
                    f: &scratch.deformation_gradient,
                    state,
                    stress: &mut scratch.stress,
                    density: T::from_f64(medium.density),
                    wave_speed: &mut scratch.wave_speed,
                    status: &mut scratch.status,
                    step: options.step,
                    time: options.time,
                })
            }
            Entry::Solid(solid) => {
                let Shapes { n, stride, .. } = self.shapes;
                let Scratch { deformation_gradient, stress, wave_speed, status, .. } = scratch;
                let to = solid::Block { stress, state: &mut self.history.state, wave_speed, status };
                solid.evaluate_block(medium.density, deformation_gradient, n, stride, to);
                status::OK
            }
        }
    }

    /// The shear that the sections hold, by the law and the state that it has left.
    fn limit_shear(&self, medium: &Medium<T>, scratch: &mut Scratch<T>) {
        if let Some(limit) = &medium.shear_limit {
            for i in 0..self.shapes.n {
                let at = limit.at(self.variable(ShearLimit::ENERGY, i), self.variable(ShearLimit::INVARIANT, i));
                scratch.shear_limit[i] = T::from_f64(at);
            }
        }
    }

    /// The arrays of a yarn law.
    fn solver_block<'a>(
        &'a mut self,
        medium: &Medium<T>,
        scratch: &'a mut Scratch<T>,
        options: StepOptions,
    ) -> SolverBlock<'a, T> {
        let wave_speed = &mut scratch.wave_speed[..];
        SolverBlock {
            n: self.shapes.n,
            leading_dimension: self.shapes.stride,
            deformation_gradient: &scratch.deformation_gradient,
            state: &mut self.history.state,
            state_old: None,
            energies: options.law_outputs,
            failure: medium.fails,
            limit: (!self.limit.is_empty()).then_some(&self.limit),
            stress: &mut scratch.stress,
            wave_speed: Some((T::from_f64(medium.density), wave_speed)),
            tangent: None,
            status: &mut scratch.status,
        }
    }

    fn call_linear_elastic(
        &mut self,
        law: &LinearElasticLaw<T>,
        frame: LinearFrame,
        criterion: i32,
        scratch: &mut Scratch<T>,
    ) -> i32 {
        let stride = self.shapes.stride;
        let arrays = LinearSolverBlock {
            n: self.shapes.n,
            leading_dimension: stride,
            f_old: &self.history.f_old,
            f_new: &scratch.deformation_gradient,
            state: &mut self.history.state,
            limit: (!self.limit.is_empty()).then_some(&self.limit),
            stress: &mut scratch.stress,
            status: &mut scratch.status,
        };
        let code = linear_elastic_block(law, arrays, frame, criterion);
        self.history.f_old.copy_from_slice(&scratch.deformation_gradient[..9 * stride]);
        code
    }

    /// What limits the step, for each element: Δt² ω² + 2 Δt d ≤ 4 for all of its motions, divided by the square of the
    /// reference step, which stands for Δt in the damping. Which elements have collapsed.
    ///
    /// By the law's bounds A, G, C, D, I of the stiffness (`toron::law::wave_bounds`), and with S of [`Measures`], motions
    /// along the fibre have the stiffnesses (A + I) m·S m by gradients along it and I S_t by those across at most.
    /// Motions across it have (G + I) m·S m and (C + D) tr S_t + I S_t: what compacts is one component of the gradient,
    /// and what distorts two at right angles, each no larger than by the sum over the corners. Each has its own damping;
    /// the largest eigenvalue of such a pair is that of a 2 × 2 matrix. Nothing couples motions along and across but what
    /// I counts in both.
    #[inline(always)]
    fn bound_step(&mut self, medium: &Medium<T>, scratch: &mut Scratch<T>, options: StepOptions, shared: f64) {
        let (one, four) = (Lanes::constant(1.0), Lanes::constant(4.0));
        let StepOptions { shortest, reference, .. } = options;
        let [own, at_rest] = self.shapes.hourglass_frequency;
        let shared = largest(at_rest, shared);
        let [own, shared] = match self.shapes.lightest {
            None => [own, shared],
            // Unlike masses couple the modes with linear fields.
            Some(lightest) => [own / lightest, (own + shared) / lightest],
        };
        let [own, shared] = [Lanes::constant(own / medium.density), Lanes::constant(shared / medium.density)];
        let section = Section {
            volume_ratio: &scratch.measures.volume_ratio,
            stretch_square: &scratch.measures.stretch_square,
            metric: &scratch.measures.metric,
        };
        let per_density = Lanes::constant(1.0 / medium.density);
        let twice = Lanes::constant(2.0 / reference);
        let corner_part = Lanes::constant(self.shapes.corner_part);
        let [square, twice_shortest] = [Lanes::constant(shortest * shortest), Lanes::constant(2.0 * shortest)];
        let most_swollen = Lanes::constant(SWOLLEN * SWOLLEN);
        for group in 0..self.shapes.stride / LANES {
            let first = group * LANES;
            let active = scratch.measures.active(&self.history.intact, first);
            let speed = Lanes::at(&scratch.wave_speed, first);
            let (f, stress) = (&scratch.deformation_gradient, &scratch.stress);
            let isotropic = speed * speed;
            let own_modulus = isotropic * Lanes::constant(medium.density);
            let stride = self.shapes.stride;
            let bounds = bounds_at(&medium.bounds, own_modulus, f, stress, &section, stride, first);
            let all_round = bounds.all_round * per_density;
            let measures = &scratch.measures;
            let [spread_along, spread_across] =
                [Lanes::at(&measures.spread_along, first), Lanes::at(&measures.spread_across, first)];
            let slanting = four * Lanes::at(&measures.slanting, first);
            let stretching = bounds.returning * bounds.elongation * per_density + all_round;
            let turning = bounds.tension * per_density + all_round;
            let deforming = (bounds.compaction + bounds.distortion) * per_density;
            let trace = Lanes::at(&measures.trace_across, first);
            let along = Motions {
                stiff: [stretching * spread_along, all_round * spread_across],
                coupling: stretching * all_round * slanting,
                damped: [Lanes::at(&measures.damping_along, first), Lanes::zero()],
            };
            // As if the fibre were tense however short it is.
            let stretching = bounds.elongation * per_density + all_round;
            let tense = Motions {
                stiff: [stretching * spread_along, all_round * spread_across],
                coupling: stretching * all_round * slanting,
                damped: along.damped,
            };
            // What deforms couples by no more than √C + √(2 D), the square of which is at most 4 (C + D).
            let across = Motions {
                stiff: [turning * spread_along, deforming * trace + all_round * spread_across],
                coupling: turning * (four * deforming + all_round) * slanting,
                damped: [Lanes::zero(), Lanes::at(&measures.damping_across, first)],
            };
            let viscous = twice * along.damped[0].max(across.damped[1]);
            let rate = (own.max(along.rate(one, twice).max(across.rate(one, twice))) + shared).only_where(active);
            rate.store(&mut self.rates, first);
            viscous.only_where(active).store(&mut self.viscous, first);
            self.group_rates[group] = T::from_f64(rate.largest());
            let damped_corners = twice * Lanes::at(&measures.damping_at_corners, first);
            let corner_along = along.stiff[0] + all_round * trace + twice * along.damped[0];
            let corner_across = across.stiff[0] + (deforming + all_round) * trace + damped_corners;
            (corner_part * corner_along.max(corner_across) + own).store(&mut self.corners, first);
            // As in the body's stable step.
            let most = tense.rate(square, twice_shortest).max(across.rate(square, twice_shortest));
            let most = (square * own).max(most) + square * shared;
            let ratio = Lanes::at(&measures.volume_ratio, first);
            let swollen = ratio * ratio - most_swollen * Lanes::at(&measures.stretch_square, first);
            let collapsed = (most - four).max(swollen).only_where(active);
            one.only_where(collapsed).store(&mut scratch.collapsed, first);
        }
    }

    /// Adds to what resists a trial motion of the nodes, by the forms of stiffness and damping that bound the law's and
    /// viscosity's, and hourglass control.
    #[inline(always)]
    fn resist(
        &self,
        medium: &Medium<T>,
        scratch: &mut Scratch<T>,
        reference: f64,
        motion: &[[T; 3]],
        resisted: &mut [[T; 3]],
    ) {
        let (shapes, History { intact, slid, .. }) = (&self.shapes, &self.history);
        let Scratch { deformation_gradient: f, trial, trial_modal, stress, measures, wave_speed, .. } = scratch;
        shapes.gradient_of(motion, slid, trial, trial_modal);
        let of = Deformed { f, stress, measures, wave_speed, intact };
        resist(medium, shapes.stride, &of, 2.0 / reference, trial);
        shapes.forces(trial, trial_modal, intact, slid, resisted);
    }

    /// Deletes the selected elements, and sets the latch where the law has not.
    fn delete(
        &mut self,
        medium: &Medium<T>,
        scratch: &Scratch<T>,
        sums: &mut Sums,
        selected: impl Fn(&Self, &Scratch<T>, usize) -> bool,
    ) {
        let latch = medium.state().1 * self.shapes.stride;
        for i in 0..self.shapes.n {
            if selected(self, scratch, i) {
                self.history.intact[i] = T::default();
                self.history.state[latch + i] = T::from_f64(1.0);
                self.history.viscosity.remove(i);
                sums.released += self.shapes.hourglass_energy(i, &scratch.modal);
                sums.deleted.push(self.first + i);
            }
        }
    }

    #[inline]
    pub fn is_intact(&self, i: usize) -> bool {
        self.history.intact[i] != T::default()
    }

    #[inline]
    fn variable(&self, row: usize, i: usize) -> f64 {
        self.history.state[row * self.shapes.stride + i].into()
    }

    /// The law's Cauchy stress 11 22 33 12 23 31 of each element, without viscosity and hourglass control: evaluated
    /// again where the nodes are now, since the host does not keep it. The history stays as it is.
    ///
    /// # Errors
    /// The law's code where it refuses its call.
    pub fn stress(&self, medium: &Medium<T>, displacement: &[[T; 3]]) -> Result<Vec<[f64; 6]>, i32> {
        let mut scratch = Scratch::default();
        run_widest(Deform { shapes: &self.shapes, displacement, slid: &self.history.slid, scratch: &mut scratch });
        let options = StepOptions { reference: 1.0, ..StepOptions::default() };
        let code = self.clone().call_law(medium, &mut scratch, options);
        let Shapes { n, stride, .. } = self.shapes;
        let component = |row: usize, i: usize| -> f64 { scratch.stress[row * stride + i].into() };
        let of = |i: usize| std::array::from_fn(|row| component(row, i));
        refused(code).map_or_else(|| Ok((0..n).map(of).collect()), Err)
    }

    /// The yarn laws' invariants; other laws have none, and 0 here.
    pub fn invariants(&self, medium: &Medium<T>, i: usize) -> [f64; 4] {
        match medium.entry {
            Entry::Hyperelastic(_) | Entry::Frictional(_) => {
                std::array::from_fn(|mode| self.variable(INVARIANTS + mode, i))
            }
            Entry::LinearElastic { .. } | Entry::Own(_) | Entry::Solid(_) => [0.0; 4],
        }
    }

    /// Energy densities, as [`ENERGY_NAMES`](super::medium::ENERGY_NAMES) has them.
    pub fn energies(&self, medium: &Medium<T>, i: usize) -> [f64; 5] {
        match &medium.entry {
            Entry::Hyperelastic(_) | Entry::Frictional(_) => {
                let [el, tc, td, ld] = std::array::from_fn(|mode| self.variable(mode, i));
                [el, tc, td, ld, 0.0]
            }
            Entry::LinearElastic { .. } => [0.0, 0.0, 0.0, 0.0, self.variable(LINEAR_WORK, i)],
            Entry::Own(own) => [0.0, 0.0, 0.0, 0.0, own.energies().map(|row| self.variable(row, i)).sum()],
            Entry::Solid(_) => [0.0, 0.0, 0.0, 0.0, self.variable(SOLID_WORK, i)],
        }
    }

    /// The density of the energy that friction between the fibres has taken, or that a law of one's own has lost.
    pub fn lost(&self, medium: &Medium<T>, i: usize) -> f64 {
        medium.lost().map_or(0.0, |row| self.variable(row, i))
    }

    /// 1 at the failure limit, 0 without one.
    pub fn failure_index(&self, medium: &Medium<T>, i: usize) -> f64 {
        match &medium.entry {
            Entry::Hyperelastic(_) => self.variable(FAILURE_INDEX, i),
            Entry::Frictional(_) => self.variable(FRICTIONAL_FAILED - 1, i),
            Entry::LinearElastic { .. } if !medium.fails => 0.0,
            // It tells nothing but whether it has failed.
            Entry::Own(own) => self.variable(own.failed, i),
            Entry::Solid(_) => 0.0,
            Entry::LinearElastic { criterion, .. } if *criterion == TORON_CRITERION_FIBRE => {
                self.variable(LINEAR_STRESS, i) / self.strength(medium, i)
            }
            Entry::LinearElastic { .. } => self.variable(LINEAR_LARGEST, i) / self.strength(medium, i),
        }
    }

    /// The linear elastic law's strength of an element.
    fn strength(&self, medium: &Medium<T>, i: usize) -> f64 {
        self.own_limit(i).filter(|&limit| limit > 0.0).unwrap_or(medium.strength)
    }

    /// The failure limit that an element has of its own, 0 where it is the property's; none where no element has one.
    pub fn own_limit(&self, i: usize) -> Option<f64> {
        self.limit.get(i).map(|&limit| limit.into())
    }

    /// The von Mises stress of a solid; the laws do not keep theirs.
    pub fn von_mises(&self, medium: &Medium<T>, i: usize) -> Option<f64> {
        matches!(medium.entry, Entry::Solid(_)).then(|| self.variable(SOLID_VON_MISES, i))
    }

    /// Logarithmic strain along the fibre, or the first axis: the invariant, the linear elastic law's stress along it
    /// over E1, or from the deformation gradient; a solid does not keep it.
    pub fn elongation(&self, medium: &Medium<T>, i: usize) -> f64 {
        match &medium.entry {
            Entry::Hyperelastic(_) | Entry::Frictional(_) => self.variable(INVARIANTS, i),
            Entry::LinearElastic { modulus, .. } => self.variable(LINEAR_STRESS, i) / modulus,
            Entry::Own(_) => {
                let component = |c: usize| -> f64 { self.history.f_old[c * self.shapes.stride + i].into() };
                0.5 * (0..3).map(|c| component(c).powi(2)).sum::<f64>().ln()
            }
            Entry::Solid(_) => 0.0,
        }
    }
}

/// Motions along the fibre, or across it: what resists them by gradients along it and across, four times the square of
/// what couples these, and their damping.
struct Motions<T> {
    stiff: [Lanes<T>; 2],
    coupling: Lanes<T>,
    damped: [Lanes<T>; 2],
}

impl<T: Number> Motions<T> {
    /// The largest of `square` times what resists and `twice` times what damps: Δt² and 2 Δt, or 1 and 2/Δt.
    #[inline(always)]
    fn rate(&self, square: Lanes<T>, twice: Lanes<T>) -> Lanes<T> {
        let [along, across] = self.stiff;
        let [damped_along, damped_across] = self.damped;
        let [along, across] = [square * along + twice * damped_along, square * across + twice * damped_across];
        larger_of_pair(along, across, square * square * self.coupling)
    }
}

/// The larger eigenvalue of a 2 × 2 matrix, by its diagonal and four times the square of what is beside it.
#[inline(always)]
fn larger_of_pair<T: Number>(a: Lanes<T>, b: Lanes<T>, coupling: Lanes<T>) -> Lanes<T> {
    let apart = a - b;
    Lanes::constant(0.5) * (a + b + (apart * apart + coupling).sqrt())
}

/// The code of a call that the law refuses, whatever the points: bad properties, counts, arguments.
fn refused(code: i32) -> Option<i32> {
    (code != status::OK && code > status::INVERTED).then_some(code)
}
