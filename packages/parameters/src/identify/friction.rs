//! µ and c of the law with friction, from sections that slide: in the plane of p_t and q less its dilatancy each is a
//! point on the line q = µ p_t + c, one whose sides are free where q = p_t, at c/(1 − µ).

use nalgebra::{DMatrix, DVector};

use super::sliding::{Mean, scatter};
use super::uncertainty::quantile;
use toron::law::parameters::{FRICTIONAL, place};
use toron_shared::error::Error;

/// Of the law's properties.
pub const MU: usize = place(&FRICTIONAL, "mu");
pub const C: usize = place(&FRICTIONAL, "cohesion");
/// Pressures tell µ and c apart where the largest is so many times the least.
const APART: f64 = 1.5;
/// Degrees of freedom from which on the differences of sections say how sure their line is.
const ENOUGH: f64 = 2.0;
/// How often the line is fitted, with errors that follow from the line before.
const ROUNDS: usize = 4;
/// No mean is surer than this part of itself: exact data would have no noise.
const LEAST_NOISE: f64 = 1e-9;

/// A section that slides.
#[derive(Clone, Debug)]
pub struct Sliding {
    pub name: String,
    /// File and line where the fit names it.
    pub declared: String,
    /// Whether its sides are free.
    pub is_free: bool,
    /// Means over parts of the way.
    pub parts: Vec<Mean>,
}

/// A set as a point: the pressure, the deviator less its dilatancy, and the standard error of that.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    pub p_t: f64,
    pub q: f64,
    error: f64,
    pub is_free: bool,
}

impl Point {
    /// The standard error of q less that of the line; noise of a section with free sides moves it along q = p_t, by 1 −
    /// µ of that off the line. What slides under pressure has its error scaled.
    fn off_line(&self, mu: f64, scale: f64) -> f64 {
        self.error * if self.is_free { 1.0 - mu } else { scale }
    }
}

/// A property, and its 95 % interval where the data tell it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Told {
    pub value: f64,
    pub error: f64,
    pub low: f64,
    pub high: f64,
}

/// What came of the sets.
#[derive(Clone, Debug, Default)]
pub struct Friction {
    /// None where it is given, or c where the data tell µ p_t + c at one pressure alone and c is 0.
    pub mu: Option<Told>,
    pub c: Option<Told>,
    /// µ and c, as told or given.
    pub values: [f64; 2],
    /// c/(1 − µ), by sections with free sides.
    pub free: Option<Told>,
    /// The pressures of the data, from the least to the largest.
    pub pressures: [f64; 2],
    /// The sets.
    pub points: Vec<Point>,
}

/// µ and c from these sets, with what the file gives of them; `untold` is c where nothing tells it.
///
/// # Errors
/// The data tell neither, or do not suffice for what is not given.
pub fn fit(sets: &[Sliding], given: [Option<f64>; 2], untold: f64) -> Result<Friction, Error> {
    let Some(first) = sets.first() else { return Ok(Friction::default()) };
    let refused = |message: &str| Err(Error::Input(format!("{}: {message}", first.declared)));
    if given[0].is_some() && given[1].is_some() {
        return refused(
            "mu and cohesion are both given in [yarn] properties; allowed: one of them, or no data that tell them",
        );
    }
    let points = points(sets);
    let pressures = points.iter().map(|point| point.p_t);
    let range = [pressures.clone().fold(f64::INFINITY, f64::min), pressures.fold(f64::NEG_INFINITY, f64::max)];
    let free: Vec<&Point> = points.iter().filter(|point| point.is_free).collect();
    if given[0].is_none() && free.len() == points.len() {
        return refused(
            "sections with free sides tell cohesion/(1 − mu) alone; missing: data with loading = \"biaxial\", which tell mu, or mu \
             in [yarn] properties",
        );
    }
    // What is sought: µ where it is not given, c where pressures tell it apart.
    let apart = range[1] > APART * range[0];
    let sought = [given[0].is_none(), given[1].is_none() && (given[0].is_some() || apart)];
    let start = [given[0].unwrap_or(0.0), given[1].unwrap_or(untold)];
    let mut found = line(&points, start, sought);
    let unbounded = found;
    let mut bounded = sought;
    if found[1].value < 0.0 {
        bounded[1] = false;
        found = line(&points, [start[0], 0.0], bounded);
        found[1] = Told { value: 0.0, low: 0.0, high: unbounded[1].high.max(0.0), ..unbounded[1] };
    }
    if sought[0] && unbounded[0].high < 0.0 {
        return refused(&format!(
            "mu would be {:.4}, with 95 % from {:.4} to {:.4}; allowed: {}. Is q half the principal stress of the side that is \
             pressed less that of the other, pressure positive?",
            unbounded[0].value, unbounded[0].low, unbounded[0].high, FRICTIONAL[MU].allowed
        ));
    }
    if found[0].value < 0.0 {
        let c = line(&points, [0.0, start[1]], [false, sought[1]])[1];
        let c = Told { value: c.value.max(0.0), high: c.high.max(0.0), ..c };
        found = [Told { value: 0.0, low: 0.0, high: unbounded[0].high.max(0.0), ..unbounded[0] }, c];
    }
    if found[0].value >= FRICTIONAL[MU].maximum {
        return refused(&format!("mu would be {:.4}; allowed: {}", found[0].value, FRICTIONAL[MU].allowed));
    }
    let clamped = |told: Told, most: f64| Told { low: told.low.max(0.0), high: told.high.min(most), ..told };
    let values = found.map(|told| told.value);
    Ok(Friction {
        mu: sought[0].then(|| clamped(found[0], FRICTIONAL[MU].maximum)),
        c: sought[1].then(|| clamped(found[1], f64::INFINITY)),
        values,
        free: of_free(&free),
        pressures: range,
        points,
    })
}

/// The sets' means. All that slide under pressure have the same error, over their pressures: few parts of one test do
/// not tell their own.
fn points(sets: &[Sliding]) -> Vec<Point> {
    let of = |set: &Sliding| {
        let [p_t, pressures] = scatter(&set.parts.iter().map(|part| part.p_t).collect::<Vec<_>>());
        let [mu, variance] = scatter(&set.parts.iter().map(Mean::mu).collect::<Vec<_>>());
        if set.is_free { (p_t, p_t, pressures / (p_t * p_t)) } else { (p_t, mu * p_t, variance) }
    };
    let pooled = |free: bool| {
        let variances: Vec<f64> = sets.iter().filter(|set| set.is_free == free).map(|set| of(set).2).collect();
        (variances.iter().sum::<f64>() / variances.len() as f64).sqrt().max(LEAST_NOISE)
    };
    let mut errors = [pooled(false), pooled(true)];
    let free: Vec<f64> = sets.iter().filter(|set| set.is_free).map(|set| of(set).0).collect();
    if free.len() as f64 > ENOUGH {
        let [mean, variance] = scatter(&free);
        errors[1] = ((variance * free.len() as f64).sqrt() / mean).max(LEAST_NOISE);
    }
    let point = |set: &Sliding| {
        let (p_t, q, _) = of(set);
        Point { p_t, q, error: errors[usize::from(set.is_free)] * p_t, is_free: set.is_free }
    };
    sets.iter().map(point).collect()
}

/// The straight line's µ and c, of which those that are not sought stay; by least squares.
fn line(points: &[Point], start: [f64; 2], sought: [bool; 2]) -> [Told; 2] {
    let columns: Vec<usize> = (0..2).filter(|&i| sought[i]).collect();
    let mut told = start.map(|value| Told { value, error: 0.0, low: value, high: value });
    let sliding: Vec<usize> = (0..points.len()).filter(|&i| !points[i].is_free).collect();
    // Of several sections their differences count: a section's own parts in turn store and give back what is elastic.
    let told_by_them = if sliding.len() < points.len() { 1 } else { columns.len() };
    let differences = sliding.len().saturating_sub(told_by_them) as f64;
    let freedom = if differences >= ENOUGH { differences } else { 4.0 * points.len() as f64 };
    let free = points.len() - sliding.len();
    let of_free = if free as f64 > ENOUGH { free as f64 - 1.0 } else { freedom };
    let mut scale = 1.0;
    for _ in 0..ROUNDS {
        let values = told.map(|told| told.value);
        let errors: Vec<f64> = points.iter().map(|point| point.off_line(values[0], scale)).collect();
        let factor = |point: usize, column: usize| if column == 0 { points[point].p_t } else { 1.0 } / errors[point];
        let kept = |point: usize| (0..2).filter(|&i| !sought[i]).map(|i| start[i] * factor(point, i)).sum::<f64>();
        let matrix = DMatrix::from_fn(points.len(), columns.len(), |row, i| factor(row, columns[i]));
        let rhs = DVector::from_fn(points.len(), |row, _| points[row].q / errors[row] - kept(row));
        let sizes: Vec<f64> = matrix.column_iter().map(|column| column.norm()).collect();
        let scaled = DMatrix::from_fn(points.len(), columns.len(), |row, i| matrix[(row, i)] / sizes[i]);
        let Some(inverse) = (scaled.transpose() * &scaled).try_inverse() else { return told };
        let solution = &inverse * (scaled.transpose() * &rhs);
        for (i, &column) in columns.iter().enumerate() {
            let value = solution[i] / sizes[i];
            let error = inverse[(i, i)].sqrt() / sizes[i];
            let half = quantile(if column == 1 { freedom.min(of_free) } else { freedom }) * error;
            told[column] = Told { value, error, low: value - half, high: value + half };
        }
        if differences >= ENOUGH {
            let residuals = rhs - scaled * solution;
            let squares = sliding.iter().map(|&row| residuals[row].powi(2)).sum::<f64>();
            scale *= (squares / differences).sqrt().max(LEAST_NOISE);
        }
    }
    told
}

/// The mean of sections with free sides.
fn of_free(points: &[&Point]) -> Option<Told> {
    let [value, variance] = scatter(&points.iter().map(|point| point.p_t).collect::<Vec<_>>());
    let own = points.iter().map(|point| point.error * point.error).sum::<f64>() / (points.len() * points.len()) as f64;
    let (variance, freedom) = match points.len() {
        0 => return None,
        1 => (own, 4.0),
        count if count as f64 > ENOUGH => (variance, count as f64 - 1.0),
        count => (own, 4.0 * count as f64),
    };
    let half = quantile(freedom) * variance.sqrt();
    Some(Told { value, error: variance.sqrt(), low: (value - half).max(0.0), high: value + half })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::sliding::{Line, blocks, first_beyond};
    use std::marker::PhantomData;

    use toron::law::parameters::FRICTIONAL_PROPERTIES as PROPERTIES;
    use toron::law::state::FRICTIONAL_STATE as STATE;
    use toron_materials::entries::step::Step;

    /// The section of the law between sides that keep a pressure, in MPa, while its height falls by a fifth: the last
    /// half of the way, in five parts.
    fn by_the_law(name: &str, [mu, c]: [f64; 2], pressure: f64, is_free: bool) -> Sliding {
        let mut properties = [0.0; PROPERTIES];
        properties[..5].copy_from_slice(&[82.0e3, 1055.0, 2.2, 650.0, 0.0]);
        (properties[8], properties[MU], properties[C]) = (1.0, mu, c);
        let mut state = [0.0; STATE];
        // Kirchhoff stresses across and along the press.
        let respond = |state: &[f64; STATE], [across, along]: [f64; 2]| {
            let f = [1.0, 0.0, 0.0, 0.0, across, 0.0, 0.0, 0.0, along];
            let law = PhantomData::<toron::Frictional>;
            let step = Step { properties: &properties, f: &f, state, tangent: false, line: 0, law };
            let answer = step.point::<f64>(false);
            assert_eq!(answer.status, 0, "{across} {along}");
            ([1, 2].map(|i| across * along * answer.stress[i]), answer.state)
        };
        let balance = |state: &[f64; STATE], stretches: &dyn Fn(f64) -> [f64; 2]| {
            let (mut low, mut high): (f64, f64) = (0.5, 2.0);
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                let sides = respond(state, stretches(middle)).0[0];
                if sides < -pressure { low = middle } else { high = middle }
            }
            stretches(0.5 * (low + high))
        };
        let rest = balance(&state, &|stretch| [stretch, stretch])[0];
        let mut lines = Vec::new();
        for step in 0..=200 {
            let along = rest * (1.0 - 0.001 * f64::from(step));
            let stretches = balance(&state, &|across| [across, along]);
            let ([across, pressed], new) = respond(&state, stretches);
            state = new;
            let [i_tc, i_td] = [stretches[0] * along, stretches[0] / along].map(|ratio| 0.5 * ratio.ln());
            lines.push(Line { p_t: -0.5 * (across + pressed), q: 0.5 * (across - pressed), i_tc, i_td });
        }
        let middle = first_beyond(&lines, 0.5 * lines[200].i_td).expect("the way");
        Sliding {
            name: name.to_string(),
            declared: "fit.toml:1".to_string(),
            is_free,
            parts: blocks(&lines[middle..], 5),
        }
    }

    #[track_caller]
    fn assert_told(told: Option<Told>, value: f64) {
        let told = told.expect("it is told");
        assert!((told.value / value - 1.0).abs() < 1e-6, "{told:?} instead of {value}");
        assert!(told.low <= value * (1.0 + 1e-6) && value * (1.0 - 1e-6) <= told.high, "{told:?}: {value}");
    }

    /// What the law's own section does tells its µ and c: by two pressures, or by one and a press with free sides.
    #[test]
    fn the_laws_own_friction_comes_back() {
        let law = [0.25, 0.4];
        let [low, high] = [5.0, 20.0].map(|pressure| by_the_law("biaxial", law, pressure, false));
        let free = by_the_law("plates", law, 0.0, true);
        for sets in [vec![low.clone(), high], vec![low.clone(), free]] {
            let found = fit(&sets, [None; 2], 0.0).expect("they suffice");
            assert_told(found.mu, law[0]);
            assert_told(found.c, law[1]);
            let told = sets.iter().any(|set| set.is_free).then_some(law[1] / (1.0 - law[0]));
            assert_eq!(found.free.is_some(), told.is_some());
            told.inspect(|&value| assert_told(found.free, value));
        }
        let without = by_the_law("biaxial", [0.25, 0.0], 10.0, false);
        assert_told(fit(&[without], [None; 2], 0.0).expect("it suffices").mu, 0.25);
        // Where c is given, one pressure is enough; where µ is, free sides are.
        assert_told(fit(&[low], [None, Some(0.4)], 0.0).expect("it suffices").mu, 0.25);
        assert_told(fit(&[by_the_law("plates", law, 0.0, true)], [Some(0.25), None], 0.0).expect("it suffices").c, 0.4);
    }

    #[test]
    fn what_is_missing_is_named() {
        let free = by_the_law("plates", [0.25, 0.4], 0.0, true);
        let said = fit(std::slice::from_ref(&free), [None; 2], 0.0).expect_err("it tells c/(1 − µ)").to_string();
        assert!(said.contains("missing: data with loading = \"biaxial\", which tell mu"), "{said}");
        let said = fit(&[free], [Some(0.25), Some(0.4)], 0.0).expect_err("nothing is left").to_string();
        assert!(said.contains("both given"), "{said}");
        // With the signs of q exchanged the sections would give back what they lose.
        let mut exchanged = by_the_law("biaxial", [0.25, 0.0], 10.0, false);
        exchanged.parts.iter_mut().for_each(|part| part.q = -part.q);
        let said = fit(&[exchanged], [None; 2], 0.0).expect_err("friction takes").to_string();
        assert!(said.contains("allowed: a number from 0 to below 1. Is q half"), "{said}");
        // One pressure tells µ p_t + c; c is its default then.
        let one = by_the_law("biaxial", [0.25, 0.4], 10.0, false);
        let p_t = one.parts[0].p_t;
        let found = fit(&[one], [None; 2], 0.0).expect("it suffices");
        assert_eq!((found.c, found.values[1]), (None, 0.0));
        assert_told(found.mu, 0.25 + 0.4 / p_t);
    }

    /// Sections that differ: the interval is Student's, of their means.
    #[test]
    fn sections_that_differ_widen_the_interval() {
        let set = |mu: f64| {
            let part = |_| Mean { range: [0.1, 0.2], p_t: 10.0, q: 10.0 * mu, dilatancy: 0.0 };
            let parts = (0..5).map(part).collect();
            Sliding { name: "set".to_string(), declared: "fit.toml:1".to_string(), is_free: false, parts }
        };
        let told = fit(&[0.18, 0.19, 0.20, 0.21, 0.22].map(set), [None; 2], 0.0).expect("they suffice").mu.expect("mu");
        // The scatter is √(0.001/4) = 0.01581, over √5, times t(4) = 2.776.
        assert!((told.value - 0.2).abs() < 1e-12 && (told.error - 0.007_071).abs() < 1e-5, "{told:?}");
        assert!((told.high - 0.2 - 2.776_445 * 0.007_071).abs() < 1e-5, "{told:?}");
        let negative = fit(&[-0.02, -0.01, 0.0].map(set), [None; 2], 0.0).expect("they suffice").mu.expect("mu");
        assert_eq!((negative.value, negative.low), (0.0, 0.0));
    }
}
