//! `bench` of a law of one's own: what a point of a block costs with each set of instructions, and whether the law's
//! `constants` and `respond` are in the kernels.

use std::hint::black_box;
use std::path::Path;

use clap::Args;

use super::command::processor;
use super::timing::Best;
use crate::material::laws::Laws;
use crate::material::own_law::{Own, OwnLaw};
use crate::material::preset::Preset;
use toron::Level;
use toron_shared::console::{print, print_error};
use toron_shared::error::Error;

#[derive(Args)]
pub struct Arguments {
    /// The properties: a file NAME.toml, as `params --preset` takes it.
    #[arg(long)]
    preset: String,
}

/// Points of a call, and the leading dimension of its arrays, which is no power of two.
const POINTS: usize = 1000;
const LEADING_DIMENSION: usize = 1037;
const ROUNDS: usize = 40;

/// With four points in a register in place of two, a point takes about half of the time; of a law whose functions are
/// called, the calls remain, and what they call has been compiled for two.
const SHARE: f64 = 0.75;

/// Prints nanoseconds a point, and to the standard error a warning where the formulas cannot have been inlined.
///
/// # Errors
/// A build without optimisation, a wrong property.
pub fn run(law: &'static OwnLaw, arguments: &Arguments) -> Result<(), Error> {
    if cfg!(debug_assertions) {
        return Err(Error::Input("bench is for a program built with --release".into()));
    }
    let laws = Laws::Own(law);
    let preset =
        Preset::find(laws, &arguments.preset, Path::new(""), |message| Error::Input(format!("--preset: {message}")))?;
    let own = law.prepared(&preset.complete(&preset.units)?).map_err(|error| preset.law_error(&error))?;
    let times = measured(&own)?;
    let head = format!("{} on {}\n\nnanoseconds a point of a block of {POINTS}\n", law.symbol, processor());
    let row = |&(level, time): &(Level, f64)| format!("{:<10}{time:>8.2}\n", level.name());
    print(&(head + &times.iter().map(row).collect::<String>()));
    if let Some(warning) = warning(&times) {
        print_error(&format!("{}: warning: {warning}\n", laws.program()));
    }
    Ok(())
}

/// Stress and state at points that are strained a little, with every set of instructions that the processor has.
fn measured(own: &Own) -> Result<Vec<(Level, f64)>, Error> {
    let levels: Vec<Level> = Level::ALL.into_iter().filter(|&level| level <= Level::best()).collect();
    let mut points = own.at_rest(POINTS, LEADING_DIMENSION, None);
    points.wave_modulus.clear();
    for (k, entry) in points.f.iter_mut().enumerate() {
        *entry += 1e-3 * ((k * 37 % 211) as f64 / 211.0 - 0.5);
    }
    let mut best = vec![Best::default(); levels.len()];
    for _ in 0..ROUNDS {
        for (&level, best) in levels.iter().zip(&mut best) {
            points.level = Some(level);
            best.time(|| own.try_step(black_box(&mut points))).map_err(|error| Error::Evaluation(error.to_string()))?;
        }
    }
    let nanoseconds = |best: Best| best.seconds.map_or(f64::NAN, |seconds| seconds * 1e9 / POINTS as f64);
    Ok(levels.into_iter().zip(best.into_iter().map(nanoseconds)).collect())
}

fn warning(times: &[(Level, f64)]) -> Option<String> {
    let of = |wanted: Level| times.iter().find(|(level, _)| *level == wanted).map(|&(_, time)| time);
    let share = of(Level::Avx2)? / of(Level::Baseline)?;
    (share > SHARE).then(|| {
        format!(
            "with AVX2 a point takes {share:.2} of its time without it, where about half is usual: probably something in the law is \
             called and not inlined. Functions need #[inline(always)], numbers no closure, map, from_fn or iterator"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_law_that_is_called_is_warned_of() {
        assert_eq!(warning(&[(Level::Baseline, 12.0), (Level::Avx2, 5.0)]), None);
        assert_eq!(warning(&[(Level::Baseline, 12.0)]), None);
        let text = warning(&[(Level::Baseline, 30.0), (Level::Avx2, 33.0), (Level::Avx512, 30.0)]).expect("a warning");
        assert!(text.starts_with("with AVX2 a point takes 1.10 of its time without it"), "{text}");
    }
}
