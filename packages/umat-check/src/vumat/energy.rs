//! enerInternNew is the work done per mass, and enerInelasNew never falls.

use std::io;

use fastrand::Rng;

use super::super::finding::{Finding, Question, Verdict};
use super::super::histories::direction;
use super::super::kinematics::exp;
use super::call::Session;
use super::point::{self, tensor};

/// Increments of a straight path, how many times as many where the first do not suffice, and how many paths.
const STRAIGHT: usize = 64;
const FINER: usize = 4;
const PATHS: usize = 8;
/// Of the largest work: what the sums along a path may err, of a hyperelastic law and of others.
const NEAR: f64 = 2e-3;
const NEAR_OF_OTHERS: f64 = 3e-2;
/// Of the largest work: what rounding may take away.
const ROUNDING: f64 = 1e-9;
/// By how much of the work the dissipation may be more than it.
const MORE: f64 = 5e-2;
/// Of the work: the least dissipation that is one, and one that is next to nothing.
const LEAST: f64 = 1e-3;
const NOTHING: f64 = 1e-5;
/// From this error on a known factor is no coincidence, whatever the law.
const FACTOR: f64 = 0.5;
/// What is left of a difference that comes from the increments, at most; they are a quarter.
const LEFT: f64 = 0.6;

/// What may be in enerInternNew: the work over these.
const KINDS: [&str; 3] = ["per mass", "per volume of the undeformed material", "per volume of the deformed material"];

struct Reported {
    /// The largest difference of enerInternNew from each of [`KINDS`], of the largest, and from the work over each
    /// property, that of the undeformed and of the deformed volume.
    differences: Vec<f64>,
    untouched: bool,
    inelastic_untouched: bool,
    /// The largest decrease of enerInelasNew, of the largest work.
    regained: f64,
    /// By how much enerInelasNew is more than the work, likewise.
    excess: f64,
    /// enerInelasNew at the ends of the paths, of the work per volume.
    by_volume: f64,
}

/// Each path in so many increments.
fn reported(session: &mut Session, increments: usize) -> io::Result<Option<Reported>> {
    let mut rng = Rng::with_seed(session.material.seed ^ 0xe1);
    let density = session.material.explicit.density;
    let size = session.material.stretch.iter().map(|stretch| stretch.ln().abs()).fold(0.0, f64::max).clamp(1e-3, 0.3);
    let properties = &session.material.properties.clone();
    let mut all = Reported {
        differences: vec![0.0; 3 + 2 * properties.len()],
        untouched: true,
        inelastic_untouched: true,
        regained: 0.0,
        excess: 0.0,
        by_volume: 0.0,
    };
    let mut asked = 0;
    for _ in 0..PATHS {
        let strain = direction(&mut rng, session.material) * size;
        let path: Vec<_> = (1..=increments).map(|k| exp(&(strain * (k as f64 / increments as f64)))).collect();
        let found = point::history(session, &path)?;
        let (mut work, mut power_before, mut inelastic_before) = (0.0, 0.0, 0.0);
        let (mut of_deformed, mut deformed_before) = (0.0, 0.0);
        let mut rows = Vec::new();
        let mut largest = 0.0_f64;
        for (found, f) in found.iter().zip(&path) {
            let volume = f.determinant();
            // τ : D along a path of constant D, on axes that do not turn.
            let power = tensor(&found.stress).dot(&strain) * volume / increments as f64;
            work += 0.5 * (power + power_before);
            power_before = power;
            of_deformed += 0.5 * (power / volume + deformed_before);
            deformed_before = power / volume;
            let [internal, inelastic] = found.energies;
            all.untouched &= internal == 0.0;
            all.inelastic_untouched &= inelastic == 0.0;
            let regained: f64 = inelastic_before - inelastic;
            inelastic_before = inelastic;
            let wanted = [density, 1.0, volume].into_iter().map(|by| work / by);
            let wanted = wanted.chain(properties.iter().flat_map(|by| [work / by, of_deformed / by]));
            let differences: Vec<f64> = wanted.map(|wanted| (internal - wanted).abs()).collect();
            rows.push((differences, regained, inelastic * density - work));
            largest = largest.max(work.abs());
        }
        if largest > 0.0 {
            all.by_volume = all.by_volume.max(inelastic_before / largest);
            asked += 1;
            for (differences, regained, excess) in rows {
                let scales = [density, 1.0, 1.0].into_iter().chain(properties.iter().flat_map(|by| [*by; 2]));
                for (i, (difference, by)) in differences.into_iter().zip(scales).enumerate() {
                    let part = difference * by.abs() / largest;
                    all.differences[i] = all.differences[i].max(if part.is_nan() { f64::INFINITY } else { part });
                }
                all.regained = all.regained.max(regained * density / largest);
                all.excess = all.excess.max(excess / largest);
            }
        }
    }
    Ok((asked > 0).then_some(all))
}

/// # Errors
/// The system has no memory.
pub fn energy(session: &mut Session) -> io::Result<Finding> {
    let Some(found) = reported(session, STRAIGHT)? else {
        return Ok(Finding::new(Question::Energy, Verdict::NotSure, None, "there was no work"));
    };
    if found.untouched {
        return Ok(Finding::new(Question::Energy, Verdict::NotReported, None, "enerInternNew is not set"));
    }
    let hyperelastic = session.material.traits.hyperelastic;
    let near = if hyperelastic { NEAR } else { NEAR_OF_OTHERS };
    let figure = found.differences[0];
    if figure <= near {
        let text = "enerInternNew is the work done per mass";
        return Ok(Finding::new(Question::Energy, Verdict::Right, Some(figure), text));
    }
    let by_property = |n: usize| found.differences[KINDS.len() + 2 * n].min(found.differences[KINDS.len() + 2 * n + 1]);
    let of_property = |&n: &usize| by_property(n) <= near;
    if let Some(n) = (0..session.material.properties.len()).find(of_property).filter(|_| found.differences[1] > near) {
        let text =
            format!("enerInternNew is the work done per mass, by the density PROPS({}) and not that passed in", n + 1);
        return Ok(Finding::new(Question::Energy, Verdict::Right, Some(by_property(n)), text));
    }
    // The density handed over is that in the middle of the increment.
    let finer = reported(session, FINER * STRAIGHT)?.map_or(f64::INFINITY, |finer| finer.differences[0]);
    if finer < LEFT * figure {
        let text = format!(
            "enerInternNew comes nearer to the work done per mass with smaller increments: {finer:.1e} in a quarter of them"
        );
        return Ok(Finding::new(Question::Energy, Verdict::Right, Some(figure), text));
    }
    let text = format!("enerInternNew differs from the work done per mass by {figure:.1e} of it");
    let verdict = if hyperelastic { Verdict::Wrong } else { Verdict::Warning };
    Ok(match (1..KINDS.len()).find(|&i| found.differences[i] <= near) {
        Some(i) => {
            let verdict = if figure > FACTOR { Verdict::Wrong } else { verdict };
            Finding::new(Question::Energy, verdict, Some(figure), format!("{text}: it is {}", KINDS[i])).with(KINDS[i])
        }
        None => Finding::new(Question::Energy, verdict, Some(figure), text).with("enerInternNew"),
    })
}

/// # Errors
/// The system has no memory.
pub fn dissipation(session: &mut Session) -> io::Result<Finding> {
    let line = |verdict, figure, text: &str| Finding::new(Question::Dissipation, verdict, figure, text);
    Ok(match reported(session, STRAIGHT)? {
        None => line(Verdict::NotSure, None, "there was no work"),
        Some(found) if found.inelastic_untouched => line(Verdict::NotReported, None, "enerInelasNew stays 0"),
        Some(found) if found.regained > ROUNDING => {
            let text = format!("enerInelasNew falls by {:.1e} of the work done", found.regained);
            line(Verdict::Wrong, Some(found.regained), &text).with("energy gained")
        }
        Some(found) if found.excess > MORE && more_than_work(session, found.excess)? => {
            let text =
                format!("enerInelasNew is more than the work done per mass, by up to {:.1e} of it", found.excess);
            line(Verdict::Warning, Some(found.excess), &text).with("more than the work")
        }
        Some(found) if found.by_volume > LEAST && found.by_volume * session.material.explicit.density < NOTHING => {
            let part = found.by_volume * session.material.explicit.density;
            let text = format!(
                "enerInelasNew is {part:.1e} of the work done per mass, and {:.1e} of that per volume: is it per volume?",
                found.by_volume
            );
            line(Verdict::Warning, Some(part), &text).with(KINDS[1])
        }
        Some(found) => line(Verdict::Right, Some(found.regained.max(0.0)), "enerInelasNew never falls"),
    })
}

/// Whether the dissipation is more than the work with smaller increments too.
fn more_than_work(session: &mut Session, excess: f64) -> io::Result<bool> {
    let finer = reported(session, FINER * STRAIGHT)?.map_or(0.0, |finer| finer.excess);
    Ok(finer > MORE && finer > LEFT * excess)
}
