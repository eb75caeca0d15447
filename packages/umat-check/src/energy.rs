//! Work and energies: whether a potential has the stress, what SSE is, what closed cycles give, and what is dissipated.

use std::f64::consts::TAU;

use fastrand::Rng;
use nalgebra::Matrix3;

use super::call::Session;
use super::finding::{Finding, NOT_FINITE, Question, Verdict};
use super::histories::{direction, gradient};
use super::kinematics::exp;
use super::material::{Material, Reads};
use super::point::{Failure, Point};

const CYCLES: usize = 12;
/// Increments of a cycle; every second one is a cycle too, which says how sure the sum is.
const INCREMENTS: usize = 240;
/// Work of a cycle of a hyperelastic law, as a part of the work on its way.
const CLOSED: f64 = 1e-6;
/// Energy that a dissipative law may give, likewise: its integration in time has an error.
const GAINED: f64 = 1e-3;
/// The same of a rate law, whose elastic part has no potential (hypoelasticity).
const GAINED_BY_RATE: f64 = 3e-2;
/// Increments of a straight path on which SSE is compared.
const STRAIGHT: usize = 64;
/// Times as many in the same time, where the first do not suffice.
const FINER: usize = 4;
/// Decrease of the dissipation, as a part of the work, that is rounding.
const REGAINED: f64 = 1e-9;
/// By how much of the work the dissipation may be more than it.
const MORE: f64 = 5e-2;
/// What is left of a difference that comes from the increments, at most; they are a quarter.
const LEFT: f64 = 0.6;

/// The work of a closed cycle.
struct Cycle {
    work: f64,
    /// By how much every second increment alone gives another sum.
    unsure: f64,
    /// Of the amounts on the way.
    way: f64,
}

/// Half the logarithm of the range of stretches.
fn size(material: &Material) -> f64 {
    material.stretch.iter().fold(f64::INFINITY, |size, stretch| size.min(stretch.ln().abs().max(1e-3))).min(0.3)
}

/// F = 1 + A sin t + B (1 - cos t), once round from the virgin state. The sum over equal parts is exact to all orders
/// for what is smooth.
fn cycle(session: &mut Session, rng: &mut Rng, parts: usize) -> Result<Option<Cycle>, String> {
    let size = 0.7 * size(session.material);
    let a = gradient(rng, session.material) * size;
    let b = gradient(rng, session.material) * (0.5 * size);
    // Without NLGEOM the same of the strain.
    let of_strain = |matrix: Matrix3<f64>| (matrix + matrix.transpose()) * 0.5;
    let [a, b] = if session.material.small_strain { [of_strain(a), of_strain(b)] } else { [a, b] };
    let mut point = Point::undeformed(session, [1, 1]);
    let (mut work, mut way, mut every_second) = (0.0, 0.0, 0.0);
    for k in 1..=parts {
        let t = TAU * k as f64 / parts as f64;
        let change = a * t.sin() + b * (1.0 - t.cos());
        let f = match (k == parts, session.material.small_strain) {
            (true, _) => Matrix3::identity(),
            (false, true) => exp(&change),
            (false, false) => Matrix3::identity() + change,
        };
        let time_step = session.material.time_step;
        match point.advance_in(session, &f, time_step) {
            Ok(_) => {}
            Err(Failure::Refused) => return Ok(None),
            Err(Failure::NotFinite(_)) => return Err("not finite in a closed cycle".to_string()),
        }
        let rate = a * t.cos() + b * t.sin();
        let power = power(&point, &rate, session.material) * TAU / parts as f64;
        work += power;
        way += power.abs();
        if k % 2 == 0 {
            every_second += 2.0 * power;
        }
    }
    Ok(Some(Cycle { work, unsure: (work - every_second).abs(), way }))
}

/// P : Ḟ = J σ : (Ḟ F⁻¹), or without NLGEOM σ : ε̇.
fn power(point: &Point, rate: &Matrix3<f64>, material: &Material) -> f64 {
    if material.small_strain {
        return point.global_stress(material).dot(rate);
    }
    let Some(inverse) = point.f.try_inverse() else { return f64::NAN };
    point.global_stress(material).dot(&(rate * inverse)) * material.volume(&point.f)
}

/// Whether a potential has the stress.
pub fn cycles(session: &mut Session, reads: Reads) -> Finding {
    let material = session.material;
    let declared = material.traits;
    if !material.has_work() {
        return Finding::new(
            Question::Cycles,
            Verdict::NotAsked,
            None,
            "without a strain across the work there is not known",
        );
    }
    if !declared.hyperelastic && !declared.dissipative {
        return Finding::new(
            Question::Cycles,
            Verdict::NotAsked,
            None,
            "neither hyperelastic nor dissipative is declared",
        );
    }
    let mut rng = Rng::with_seed(material.seed ^ 0xc1);
    let (mut worst, mut unsure, mut gained, mut asked) = (0.0_f64, 0.0_f64, f64::INFINITY, 0);
    for _ in 0..CYCLES {
        let found = match cycle(session, &mut rng, INCREMENTS) {
            Ok(Some(found)) if found.way > 0.0 => found,
            Ok(_) => continue,
            Err(text) => return Finding::new(Question::Cycles, Verdict::Wrong, None, text).with(NOT_FINITE),
        };
        asked += 1;
        worst = worst.max((found.work.abs() - 10.0 * found.unsure).max(0.0) / found.way);
        unsure = unsure.max(found.unsure / found.way);
        gained = gained.min((found.work + 10.0 * found.unsure) / found.way);
    }
    if asked == 0 {
        return Finding::new(Question::Cycles, Verdict::NotSure, None, "no cycle was closed, or there was no stress");
    }
    if declared.hyperelastic {
        let text = format!("{asked} closed cycles give or take no work");
        if worst <= CLOSED {
            return Finding::new(Question::Cycles, Verdict::Right, Some(worst), text);
        }
        let text = format!(
            "closed cycles give or take up to {worst:.1e} of the work on their way: no potential has this stress"
        );
        return Finding::new(Question::Cycles, Verdict::Wrong, Some(worst), text).with("no energy");
    }
    if gained < -(if reads == Reads::Total { GAINED } else { GAINED_BY_RATE }) {
        let text = format!("a closed cycle from the virgin state gives {:.1e} of the work on its way", -gained);
        return Finding::new(Question::Cycles, Verdict::Wrong, Some(-gained), text).with("energy gained");
    }
    let text = format!("{asked} closed cycles from the virgin state give no work");
    Finding::new(Question::Cycles, Verdict::Right, Some((-gained).max(0.0)), text)
}

/// What SSE, SPD and SCD are along straight paths from rest and back.
struct Reported {
    /// The largest difference of SSE, or of SSE + SPD + SCD, from W and from W/J, as parts of the largest W.
    from_work: [f64; 2],
    elastic_alone_from_work: [f64; 2],
    untouched: bool,
    dissipated_untouched: bool,
    /// The largest decrease of SPD + SCD, there and back, as a part of W: of them, and of them times J, where they are
    /// per current volume.
    regained: [f64; 2],
    /// By how much SPD + SCD are more than W and W/J, likewise.
    excess: f64,
    /// SPD + SCD at the far ends of the paths, all together.
    dissipated: f64,
}

/// Each path in so many increments, in the same time.
fn reported(session: &mut Session, increments: usize) -> Result<Option<Reported>, String> {
    let time_step = session.material.time_step * STRAIGHT as f64 / increments as f64;
    let mut rng = Rng::with_seed(session.material.seed ^ 0xe1);
    let zero = [0.0_f64; 2];
    let mut all = Reported {
        from_work: zero,
        elastic_alone_from_work: zero,
        untouched: true,
        dissipated_untouched: true,
        regained: zero,
        excess: 0.0,
        dissipated: 0.0,
    };
    let mut asked = 0;
    for _ in 0..8 {
        let strain = direction(&mut rng, session.material) * size(session.material);
        let mut point = Point::undeformed(session, [1, 1]);
        let (mut work, mut largest, mut power_before, mut volume_before) = (0.0, 0.0_f64, 0.0, 1.0);
        let mut differences = Vec::new();
        // There and back.
        let back = (0..increments).rev().map(|k| (k, -1.0));
        for (k, sense) in (1..=increments).map(|k| (k, 1.0)).chain(back) {
            let f = exp(&(strain * (k as f64 / increments as f64)));
            let before = point.energies;
            match point.advance_in(session, &f, time_step) {
                Ok(_) => {}
                Err(Failure::Refused) if sense < 0.0 => break,
                Err(Failure::Refused) => return Ok(None),
                Err(Failure::NotFinite(_)) => return Err("not finite on a straight path there and back".to_string()),
            }
            // τ : D along a path of constant D.
            let volume = session.material.volume(&f);
            let power = point.global_stress(session.material).dot(&strain) * volume / increments as f64;
            work += 0.5 * sense * (power + power_before);
            power_before = power;
            largest = largest.max(work.abs());
            let [elastic, plastic, creep] = point.energies;
            all.untouched &= elastic == 0.0;
            all.dissipated_untouched &= plastic == 0.0 && creep == 0.0;
            let sum = elastic + plastic + creep;
            let (by_volume, lost, lost_before) = (work / volume, plastic + creep, before[1] + before[2]);
            differences.push((
                [(elastic - work).abs(), (elastic - by_volume).abs()],
                [(sum - work).abs(), (sum - by_volume).abs()],
                [lost_before - lost, lost_before * volume_before - lost * volume],
                lost - work.max(by_volume),
            ));
            volume_before = volume;
            if k == increments {
                all.dissipated += plastic + creep;
            }
        }
        if largest > 0.0 {
            asked += 1;
            for (elastic, sum, regained, excess) in differences {
                for i in 0..2 {
                    all.regained[i] = all.regained[i].max(regained[i] / largest);
                    all.elastic_alone_from_work[i] = all.elastic_alone_from_work[i].max(elastic[i] / largest);
                    all.from_work[i] = all.from_work[i].max(sum[i] / largest);
                }
                all.excess = all.excess.max(excess / largest);
            }
        }
    }
    Ok((asked > 0).then_some(all))
}

/// Of the work: what is no energy at all.
const NO_ENERGY: f64 = 1e8;

/// What SSE is.
pub fn energy(session: &mut Session) -> Finding {
    if !session.material.has_work() {
        return Finding::new(
            Question::Energy,
            Verdict::NotAsked,
            None,
            "without a strain across the work there is not known",
        );
    }
    let found = match reported(session, STRAIGHT) {
        Ok(Some(found)) => found,
        Ok(None) => {
            return Finding::new(Question::Energy, Verdict::NotSure, None, "no path without smaller increments");
        }
        Err(text) => return Finding::new(Question::Energy, Verdict::Wrong, None, text).with(NOT_FINITE),
    };
    if found.untouched {
        return Finding::new(Question::Energy, Verdict::NotReported, None, "SSE is not set");
    }
    let hyperelastic = session.material.traits.hyperelastic;
    let compared = |found: &Reported| {
        if hyperelastic && found.dissipated_untouched {
            ("SSE", found.elastic_alone_from_work)
        } else {
            ("SSE + SPD + SCD", found.from_work)
        }
    };
    let (of, differences) = compared(&found);
    let (name, figure) = if differences[0] <= differences[1] { ("W", differences[0]) } else { ("W/J", differences[1]) };
    // The sum along the path has an error of its own, and a law that adds up work has another.
    let near = if hyperelastic { 2e-3 } else { 3e-2 };
    if figure <= near {
        return Finding::new(Question::Energy, Verdict::Right, Some(figure), format!("{of} is {name}, the work done"));
    }
    if figure > NO_ENERGY {
        let text =
            format!("{of} is no energy, {figure:.0e} times the work: it is set from a variable that is not set?");
        let verdict = if hyperelastic { Verdict::Wrong } else { Verdict::Warning };
        return Finding::new(Question::Energy, verdict, None, text).with("SSE");
    }
    let text = format!("{of} differs from the work done by {:.1e} of W, {:.1e} of W/J", differences[0], differences[1]);
    let declared = session.material.traits;
    if !hyperelastic && !declared.dissipative {
        // Growth, for one, brings energy along.
        let text = format!("{text}; neither hyperelastic nor dissipative is declared");
        return Finding::new(Question::Energy, Verdict::NotAsked, Some(figure), text);
    }
    // A law that adds up work has an error of its increments.
    if !hyperelastic && let Ok(Some(finer)) = reported(session, FINER * STRAIGHT) {
        let (_, differences) = compared(&finer);
        let least = differences[0].min(differences[1]);
        if least < LEFT * figure {
            let text = format!("{of} comes nearer to {name} with smaller increments: {least:.1e} in a quarter of them");
            return Finding::new(Question::Energy, Verdict::Right, Some(figure), text);
        }
    }
    let verdict = if hyperelastic { Verdict::Wrong } else { Verdict::Warning };
    Finding::new(Question::Energy, verdict, Some(figure), text).with("SSE")
}

/// Whether SPD + SCD ever decrease.
pub fn dissipation(session: &mut Session) -> Finding {
    if !session.material.has_work() {
        return Finding::new(
            Question::Dissipation,
            Verdict::NotAsked,
            None,
            "without a strain across the work there is not known",
        );
    }
    if !session.material.traits.dissipative {
        return Finding::new(Question::Dissipation, Verdict::NotAsked, None, "dissipative is not declared");
    }
    match reported(session, STRAIGHT) {
        Err(text) => Finding::new(Question::Dissipation, Verdict::Wrong, None, text).with(NOT_FINITE),
        Ok(None) => Finding::new(Question::Dissipation, Verdict::NotSure, None, "no path without smaller increments"),
        Ok(Some(found)) if found.dissipated_untouched => {
            Finding::new(Question::Dissipation, Verdict::NotReported, None, "SPD and SCD are not set")
        }
        Ok(Some(found)) => accumulated(session, &found),
    }
}

/// A text for the report where SPD + SCD are set.
fn accumulated(session: &mut Session, found: &Reported) -> Finding {
    let finer = reported(session, FINER * STRAIGHT).ok().flatten();
    let part = finer.as_ref().map_or(f64::NAN, |finer| finer.dissipated) / found.dissipated;
    if part < 2.0 / FINER as f64 {
        let text = format!(
            "SPD + SCD are those of the increment alone (with a quarter of the increment {part:.2} of them): they are to be added to \
             the values passed in"
        );
        return Finding::new(Question::Dissipation, Verdict::Wrong, None, text).with("not accumulated");
    }
    let regained = found.regained[0].min(found.regained[1]);
    if regained > REGAINED {
        let text = format!("SPD + SCD decrease by {regained:.1e} of the work done");
        return Finding::new(Question::Dissipation, Verdict::Wrong, Some(regained), text).with("energy gained");
    }
    // What a stress from the beginning has stored is no work.
    let stored = Point::undeformed(session, [1, 1]).stress.iter().any(|stress| *stress != 0.0);
    let least = finer.map_or(0.0, |finer| finer.excess);
    if !stored && least > MORE && least > LEFT * found.excess {
        let text = format!("SPD + SCD are more than the work done, by up to {:.1e} of it", found.excess);
        return Finding::new(Question::Dissipation, Verdict::Wrong, Some(found.excess), text)
            .with("more than the work");
    }
    let text = "SPD + SCD never decrease, there and back";
    Finding::new(Question::Dissipation, Verdict::Right, Some(regained.max(0.0)), text)
}
