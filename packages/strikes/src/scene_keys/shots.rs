//! The table `[shots]` of a scene: how a series of shots differs from the one that the scene describes.
//! `docs/guides/v50.md` has the keys; `toron v50` fires them.

use serde::Deserialize;

use crate::v50::designs::OF_RANGE;
use toron::host::units::UnitSystem;
use toron_materials::material::model::Material;
use toron_shared::checked::{Checked, NotNegative, Positive, value};
use toron_shared::error::Error;
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::{Numbers, Source};

/// Shots of a series, at most: files number them.
const MOST_SHOTS: i64 = 1_000_000;
/// Of two shots a curve has no more to say than the shots themselves.
const FEWEST_SHOTS: i64 = 2;
const SEED: u64 = 1;
/// Over the scene's end: how long a shot may take that is not decided there.
const EXTENSION: f64 = 2.0;
const MOST_EXTENSION: f64 = 100.0;
/// Over the range: a step up or down, the first guess of the deviation, and how narrow the bracket of a limit is.
const STEP: f64 = 0.1;
const DEVIATION: f64 = 0.125;
const TOLERANCE: f64 = 0.02;
/// A bracket of so little of the fastest speed has no numbers between its ends, but for a few.
const LEAST_TOLERANCE: f64 = 1e-9;

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct ShotsFile {
    /// Of shots, 2 or more.
    number: Spanned<i64>,
    /// The slowest and the fastest: the range, in which V50 should be.
    speeds: Spanned<Numbers<2>>,
    /// How the speeds are [chosen](guides/v50.md#designs). Default: `langlie`.
    design: Option<DesignName>,
    /// Speed, of `up-and-down`; up to the whole range. Default: a tenth of the range.
    step: Option<Spanned<Positive>>,
    /// First guess of the limit speed's standard deviation, for `d-optimal` and `3pod`, there up to a sixth of the
    /// range. Default: an eighth of the range.
    deviation: Option<Spanned<Positive>>,
    /// Standard deviation of a shot's speed, up to half of the range. No shot is slower than a tenth of what it was to
    /// be. Default: 0.
    scatter: Option<Spanned<NotNegative>>,
    /// `fixed` is where the scene aims. `cell` is anywhere in one repeat of the pattern about that place (of a `[mesh]`
    /// two pitches each way), all places alike; its corners must lie within the panel. A quarter is struck in its
    /// middle alone. Default: `fixed`.
    aim: Option<AimName>,
    /// Of all that is chance. Default: 1.
    seed: Option<u64>,
    /// How many times the scene's `end` a shot may take, 1 to 100. Default: 2.
    extension: Option<Spanned<Positive>>,
    /// Width of the bracket of `--limit`, a speed: 10⁻⁹ of the fastest one or more, and less than the range. Default: a
    /// fiftieth of the range.
    tolerance: Option<Spanned<Positive>>,
    /// Range of speeds within which the mean of [test houses](guides/v50.md#what-test-houses-print) is taken. Default:
    /// none.
    spread: Option<Positive>,
}

/// How the speeds are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum DesignName {
    Even,
    #[default]
    Langlie,
    UpAndDown,
    DOptimal,
    #[serde(rename = "3pod")]
    ThreePod,
}

/// Where shots meet the panel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum AimName {
    /// Where the scene aims.
    #[default]
    Fixed,
    /// Anywhere in a cell of the weave about that place.
    Cell,
}

/// A series of shots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shots {
    pub number: usize,
    pub speeds: [f64; 2],
    pub design: DesignName,
    /// A step up or down.
    pub step: f64,
    /// The first guess of the deviation of the limit speed.
    pub deviation: f64,
    /// The standard deviation of a shot's speed from what it was to be.
    pub scatter: f64,
    pub aim: AimName,
    pub seed: u64,
    /// How many times the scene's end a shot may take.
    pub extension: f64,
    /// How narrow the bracket of a limit without scatter is.
    pub tolerance: f64,
    /// The spread within which test houses take their mean, if one is given.
    pub spread: Option<f64>,
}

/// The series of a scene whose cases begin with these materials under the blow.
///
/// # Errors
/// An input error that names file, line, value and what is allowed.
pub fn read_shots<'m>(
    source: &Source<'_>,
    file: &ShotsFile,
    units: &UnitSystem,
    materials: impl Iterator<Item = &'m Material>,
) -> Result<Shots, Error> {
    let Numbers([low, high]) = *file.speeds.get_ref();
    let error = |key: &str, value: &dyn std::fmt::Display, span, allowed: &str| {
        Err(source.error(span, &format!("{key} is {value}; allowed: {allowed}")))
    };
    if !(low > 0.0 && low < high && high.is_finite()) {
        let allowed = "the slowest and then the fastest speed, two different finite numbers > 0";
        return error("speeds", &format!("[{low}, {high}]"), file.speeds.span(), allowed);
    }
    for material in materials {
        let bears = material.bears_strike("the fastest of speeds", high, units);
        bears.map_err(|message| source.error(file.speeds.span(), &message))?;
    }
    let number = *file.number.get_ref();
    if !(FEWEST_SHOTS..=MOST_SHOTS).contains(&number) {
        let allowed = format!(
            "{FEWEST_SHOTS} to {MOST_SHOTS}; 20 or more give an interval that is of use (toron v50 --simulate \
             shows how wide it is)"
        );
        return error("number", &number, file.number.span(), &allowed);
    }
    let design = file.design.unwrap_or_default();
    let by_guess = [DesignName::DOptimal, DesignName::ThreePod];
    for (key, value, of, with) in [
        ("step", &file.step, &[DesignName::UpAndDown][..], "design = \"up-and-down\""),
        ("deviation", &file.deviation, &by_guess[..], "design = \"d-optimal\" or design = \"3pod\""),
    ] {
        if let Some(value) = value.as_ref().filter(|_| !of.contains(&design)) {
            return error(key, &value.value(), value.span(), &format!("with {with}"));
        }
    }
    let range = high - low;
    let most = OF_RANGE * range;
    if let Some(given) = file.deviation.as_ref().filter(|value| design == DesignName::ThreePod && value.value() > most)
    {
        let allowed = format!("up to {most} with design = \"3pod\", a sixth of the range of speeds");
        return error("deviation", &given.value(), given.span(), &allowed);
    }
    let extension = value(&file.extension).unwrap_or(EXTENSION);
    if let Some(given) = file.extension.as_ref().filter(|_| !(1.0..=MOST_EXTENSION).contains(&extension)) {
        return error("extension", &extension, given.span(), &format!("1 to {MOST_EXTENSION}"));
    }
    let tolerance = value(&file.tolerance).unwrap_or(TOLERANCE * range);
    let least = LEAST_TOLERANCE * high;
    if let Some(given) = file.tolerance.as_ref().filter(|_| !(least..range).contains(&tolerance)) {
        let allowed = format!("{least:.3e} or more, and less than the range of speeds, {range}");
        return error("tolerance", &tolerance, given.span(), &allowed);
    }
    let scatter = value(&file.scatter).unwrap_or(0.0);
    let step = value(&file.step).unwrap_or(STEP * range);
    for (key, value, given, most, what) in [
        ("scatter", scatter, file.scatter.as_ref().map(Spanned::span), 0.5 * range, "half of the range of speeds"),
        ("step", step, file.step.as_ref().map(Spanned::span), range, "the range of speeds"),
    ] {
        if let Some(span) = given.filter(|_| value > most) {
            return error(key, &value, span, &format!("up to {most}, {what}"));
        }
    }
    Ok(Shots {
        number: number as usize,
        speeds: [low, high],
        design,
        step,
        deviation: value(&file.deviation).unwrap_or(DEVIATION * range),
        scatter,
        aim: file.aim.unwrap_or_default(),
        seed: file.seed.unwrap_or(SEED),
        extension,
        tolerance: tolerance.max(least),
        spread: value(&file.spread),
    })
}
