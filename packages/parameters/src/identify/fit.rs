//! The fit of all data sets: what is fitted with what, in which order, and the weights of sets whose noise is not
//! known.
//!
//! Sets that tell a common parameter are fitted together, and after those that tell what else they depend on: k_td from
//! transverse compression after W_tc is subtracted (Eq. 4.29). What comes first carries its uncertainty into what comes
//! after.

use nalgebra::{DMatrix, DVector};

use super::data::DataSet;
use super::least_squares::{self, Solution, Weighted};
use super::parameter::{PARAMETERS, Parameter, Values};
use super::uncertainty::{Estimate, Source, Uncertainty};
use toron::host::units::UnitSystem;
use toron_shared::error::Error;

/// Data sets and what is known besides.
#[derive(Clone, Debug)]
pub struct Problem {
    pub sets: Vec<DataSet>,
    /// The units of everything, and the yarn's density where it is known.
    pub units: UnitSystem,
    pub density: Option<f64>,
    /// Values that are given, and not fitted.
    pub known: [Option<f64>; PARAMETERS],
    /// Values for what is neither given nor fitted.
    pub fallback: [Option<f64>; PARAMETERS],
    /// What makes a known value uncertain: the derivative of each parameter by it, times its standard deviation.
    pub known_deviations: Vec<Values>,
    /// Where the search starts.
    pub start: Values,
}

/// The parameters that the data tell.
#[derive(Clone, Debug)]
pub struct Fit {
    /// Fitted, known, or what a set that needs them was given by the base preset or by default; else `None`.
    pub values: [Option<f64>; PARAMETERS],
    /// Of all parameters that have an interval, in the order of the property table.
    pub estimates: Vec<Estimate>,
    /// Of the estimates, in their order.
    pub correlations: DMatrix<f64>,
    /// One for each set.
    pub sets: Vec<SetFit>,
    pub groups: Vec<Group>,
    /// The errors of the estimates.
    pub uncertainty: Uncertainty,
    /// Parameters that a set should tell but does not.
    pub untold: Vec<(String, Parameter)>,
    /// So many further least squares the profile intervals took.
    pub searches: usize,
}

impl Fit {
    /// Whether the base preset gives a parameter, since neither the data nor the file do.
    pub fn is_of_base(&self, problem: &Problem, parameter: Parameter) -> bool {
        let index = parameter.index();
        let is_told =
            problem.known[index].is_some() || self.groups.iter().any(|group| group.parameters.contains(&parameter));
        !is_told && problem.fallback[index].is_some()
    }

    /// Whether two parameters were fitted together.
    pub fn together(&self, a: Parameter, b: Parameter) -> bool {
        self.groups.iter().any(|group| group.parameters.contains(&a) && group.parameters.contains(&b))
    }
}

/// How the law meets a set.
#[derive(Clone, Debug)]
pub struct SetFit {
    /// Measured less predicted.
    pub residuals: Vec<f64>,
    /// The standard deviation of each datum, as given or estimated.
    pub deviations: Vec<f64>,
    /// Data less the parameters that they have told.
    pub freedom: f64,
}

/// Sets that are fitted together.
#[derive(Clone, Debug)]
pub struct Group {
    /// Indices of the sets.
    pub sets: Vec<usize>,
    pub parameters: Vec<Parameter>,
    pub bounded: Vec<Parameter>,
    /// The weights of the data and the values at the end.
    pub weights: Vec<f64>,
    pub values: Values,
}

/// Indices of sets that are fitted together, and the parameters that they tell.
type Together = (Vec<usize>, Vec<Parameter>);

/// How often the noise of sets is estimated anew, and how well it has to agree with the last time.
const REWEIGHTINGS: usize = 200;
const AGREED: f64 = 1e-6;
/// No set is surer than this, over its largest ordinate: exact data would have no noise.
const LEAST_NOISE: f64 = 1e-10;
/// A set that is weighed against others has so many more points than it tells parameters: with fewer its noise is
/// anybody's guess.
const LEAST_FREEDOM: f64 = 2.0;
/// Columns of derivatives, each of length 1, are dependent where a combination is shorter than this.
const DEPENDENT: f64 = 1e-6;
/// A parameter takes part in such a combination above this share.
const INVOLVED: f64 = 0.1;

impl Problem {
    /// The parameters, their intervals, and how the law meets the data.
    ///
    /// # Errors
    /// The data do not suffice, or the law has no answer to them.
    pub fn fit(&self) -> Result<Fit, Error> {
        let mut state = State::new(self);
        for (sets, parameters) in self.groups()? {
            state.fit_group(sets, parameters)?;
        }
        Ok(state.finish())
    }

    /// Sets that share a parameter, in the order in which they are fitted: each after those that tell what it depends
    /// on.
    fn groups(&self) -> Result<Vec<Together>, Error> {
        let mut groups: Vec<Together> = Vec::new();
        for (index, set) in self.sets.iter().enumerate() {
            let (mut sets, mut parameters) = (vec![index], set.fits.clone());
            let joined: Vec<_> =
                groups.extract_if(.., |(_, known)| known.iter().any(|other| parameters.contains(other))).collect();
            for (other_sets, other_parameters) in joined {
                sets.extend(other_sets);
                parameters.extend(other_parameters);
            }
            sets.sort_unstable();
            parameters.sort_unstable();
            parameters.dedup();
            groups.push((sets, parameters));
        }
        let mut ordered = Vec::new();
        while !groups.is_empty() {
            let mut ready = None;
            for (index, (sets, _)) in groups.iter().enumerate() {
                let needs = sensitive(&sets.iter().map(|&set| &self.sets[set]).collect::<Vec<_>>())?;
                let told_later = |(other, (_, told)): (usize, &Together)| {
                    other != index && told.iter().any(|parameter| needs.contains(parameter))
                };
                if !groups.iter().enumerate().any(told_later) {
                    ready = Some(index);
                    break;
                }
            }
            let Some(index) = ready else {
                let set = &self.sets[groups[0].0[0]];
                return Err(Error::Input(format!(
                    "{}: data set {} and others each depend on what the other tells; allowed: the same fits for both, which \
                     fits them together",
                    set.declared, set.name
                )));
            };
            ordered.push(groups.remove(index));
        }
        Ok(ordered)
    }
}

/// What has been fitted so far.
struct State<'a> {
    problem: &'a Problem,
    values: [Option<f64>; PARAMETERS],
    uncertainty: Uncertainty,
    sets: Vec<Option<SetFit>>,
    groups: Vec<Group>,
    untold: Vec<(String, Parameter)>,
}

impl<'a> State<'a> {
    fn new(problem: &'a Problem) -> State<'a> {
        let lengths = problem.sets.iter().map(DataSet::len);
        State {
            problem,
            values: problem.known,
            uncertainty: Uncertainty::new(lengths, &problem.known_deviations),
            sets: vec![None; problem.sets.len()],
            groups: Vec::new(),
            untold: Vec::new(),
        }
    }

    fn fit_group(&mut self, indices: Vec<usize>, mut parameters: Vec<Parameter>) -> Result<(), Error> {
        let problem = self.problem;
        let sets: Vec<&DataSet> = indices.iter().map(|&set| &problem.sets[set]).collect();
        self.drop_untold(&sets, &mut parameters)?;
        self.require_the_rest(&sets, &parameters)?;
        require_enough(&sets, &parameters)?;
        let mut start = problem.start;
        for (start, known) in start.iter_mut().zip(self.values) {
            *start = known.unwrap_or(*start);
        }
        let (solution, weights, fits) = reweighted(&sets, &parameters, &start)?;
        let free: Vec<Parameter> = parameters.iter().copied().filter(|p| !solution.bounded.contains(p)).collect();
        require_independent(&sets, &solution, &weights, &free)?;
        for (&index, fit) in indices.iter().zip(fits) {
            self.uncertainty.describe(index, Source { freedom: fit.freedom }, &fit.deviations);
            self.sets[index] = Some(fit);
        }
        self.uncertainty.add(&indices, &solution, &weights, &parameters);
        let mut first = 0;
        for &index in &indices {
            let set = &problem.sets[index];
            if let Some(toe) = &set.toe {
                let mut shift = DVector::zeros(weights.len());
                for (i, slope) in toe.slopes.iter().enumerate() {
                    shift[first + i] = -solution.values[Parameter::KEl.index()] * slope * toe.deviation;
                }
                let freedom = self.sets[index].as_ref().map_or(f64::INFINITY, |fit| fit.freedom - 1.0);
                self.uncertainty.add_zero(index, Source { freedom }, &shift, &solution, &weights, &parameters);
            }
            first += set.len();
        }
        for &parameter in &parameters {
            self.values[parameter.index()] = Some(solution.values[parameter.index()]);
        }
        let Solution { values, bounded, .. } = solution;
        self.groups.push(Group { sets: indices, parameters, bounded, weights, values });
        Ok(())
    }

    /// Parameters on which none of the group's data depends.
    fn drop_untold(&mut self, sets: &[&DataSet], parameters: &mut Vec<Parameter>) -> Result<(), Error> {
        let sensitive = sensitive(sets)?;
        for &parameter in parameters.iter().filter(|parameter| !sensitive.contains(parameter)) {
            let names: Vec<&str> = sets.iter().map(|set| set.name.as_str()).collect();
            self.untold.push((names.join(", "), parameter));
        }
        parameters.retain(|parameter| sensitive.contains(parameter));
        Ok(())
    }

    /// Every parameter that the data depend on has to be fitted or known.
    fn require_the_rest(&mut self, sets: &[&DataSet], parameters: &[Parameter]) -> Result<(), Error> {
        for parameter in sensitive(sets)?.into_iter().filter(|parameter| !parameters.contains(parameter)) {
            let index = parameter.index();
            let default = parameter.property().default;
            self.values[index] = self.values[index].or(self.problem.fallback[index]).or(default);
            if self.values[index].is_none() {
                return Err(Error::Input(format!(
                    "{}: data set {} depends on {name}, which is neither among its fits nor told before it; allowed: {name} among \
                     its fits or in [yarn] properties, or data that tell it ({})",
                    sets[0].declared,
                    sets[0].name,
                    parameter.told_by(),
                    name = parameter.name()
                )));
            }
        }
        Ok(())
    }

    fn finish(self) -> Fit {
        let fitted: Vec<Parameter> = self.groups.iter().flat_map(|group| group.parameters.clone()).collect();
        let bounded: Vec<Parameter> = self.groups.iter().flat_map(|group| group.bounded.clone()).collect();
        let (estimates, correlations) = self.uncertainty.estimates(&self.values, &fitted, &bounded);
        Fit {
            values: self.values,
            estimates,
            correlations,
            // Every set is in a group.
            sets: self.sets.into_iter().flatten().collect(),
            groups: self.groups,
            uncertainty: self.uncertainty,
            untold: self.untold,
            searches: 0,
        }
    }
}

/// The parameters on which data of these sets depend.
fn sensitive(sets: &[&DataSet]) -> Result<Vec<Parameter>, Error> {
    let mut parameters = Vec::new();
    for set in sets {
        parameters.extend(set.depends_on()?);
    }
    parameters.sort_unstable();
    parameters.dedup();
    Ok(parameters)
}

/// As many data as parameters, and one more where the noise is to be estimated.
fn require_enough(sets: &[&DataSet], parameters: &[Parameter]) -> Result<(), Error> {
    let data: usize = sets.iter().map(|set| set.len()).sum();
    let estimated = sets.iter().any(|set| set.deviations.is_none());
    let least = parameters.len() + usize::from(estimated);
    if data >= least {
        return Ok(());
    }
    let names: Vec<&str> = parameters.iter().map(|parameter| parameter.name()).collect();
    let shortest = sets.iter().min_by_key(|set| set.len()).map_or("", |set| set.place.as_str());
    let points = if data == 1 { "1 point" } else { &format!("{data} points") };
    Err(Error::Input(format!("{shortest}: {points} for {}; allowed: {least} or more", names.join(", "))))
}

/// No parameter may be made up for by others.
fn require_independent(
    sets: &[&DataSet],
    solution: &Solution,
    weights: &[f64],
    free: &[Parameter],
) -> Result<(), Error> {
    if free.is_empty() {
        return Ok(());
    }
    let decomposition = normalised(solution, weights, free).svd(false, true);
    let (least, Some(directions)) = (decomposition.singular_values.imin(), &decomposition.v_t) else { return Ok(()) };
    if decomposition.singular_values[least] > DEPENDENT {
        return Ok(());
    }
    let direction = directions.row(least);
    let involved = free.iter().zip(direction.iter()).filter(|(_, part)| part.abs() > INVOLVED);
    let names: Vec<&str> = involved.map(|(parameter, _)| parameter.name()).collect();
    let place = sets[0].declared.as_str();
    let sets: Vec<&str> = sets.iter().map(|set| set.name.as_str()).collect();
    Err(Error::Input(format!(
        "{place}: data set {}: the data tell only a combination of {}: a change of one is made up for by the others; allowed: give one of \
         them in [yarn] properties, or add data in which they act apart",
        sets.join(", "),
        names.join(" and ")
    )))
}

/// Least squares whose weights are the inverse variances: the known ones, and for other sets what the residuals show,
/// estimated anew until they agree.
fn reweighted(
    sets: &[&DataSet],
    parameters: &[Parameter],
    start: &Values,
) -> Result<(Solution, Vec<f64>, Vec<SetFit>), Error> {
    let mut noise: Vec<f64> = sets.iter().map(|set| set.largest().max(f64::MIN_POSITIVE)).collect();
    let mut start = *start;
    for round in 0..REWEIGHTINGS {
        let weights: Vec<f64> = sets.iter().zip(&noise).flat_map(|(set, &noise)| set.weights(noise)).collect();
        let data = Weighted { sets, weights: &weights };
        // After the first time the answer is near.
        let minimise = if round == 0 { least_squares::minimise } else { least_squares::search };
        let named = |reason: String| Error::Evaluation(format!("{}: {reason}", sets[0].declared));
        let solution = minimise(data, parameters, &start).map_err(named)?;
        start = solution.values;
        let leverages = leverages(&solution, &weights, parameters);
        let (mut fits, mut first, mut change) = (Vec::new(), 0, 0.0_f64);
        let least = if sets.len() > 1 { LEAST_FREEDOM } else { 0.0 };
        for (set, noise) in sets.iter().zip(&mut noise) {
            let rows = first..first + set.len();
            let residuals: Vec<f64> = rows.clone().map(|i| -solution.residuals[i]).collect();
            let freedom = set.len() as f64 - rows.map(|i| leverages[i]).sum::<f64>();
            if set.deviations.is_none() {
                if freedom < least {
                    return Err(Error::Input(format!(
                        "{}: data set {} has too few points ({}) to tell its noise beside its parameters; allowed: its deviation, or \
                         more points",
                        set.declared,
                        set.name,
                        set.len()
                    )));
                }
                let squares: f64 = residuals.iter().map(|r| r * r).sum();
                let estimate = (squares / freedom.max(f64::MIN_POSITIVE)).sqrt().max(LEAST_NOISE * set.largest());
                change = change.max((estimate / *noise).ln().abs());
                *noise = estimate;
            }
            let deviations = set.deviations.clone().unwrap_or_else(|| vec![*noise; set.len()]);
            let freedom = if set.deviations.is_some() { f64::INFINITY } else { freedom };
            fits.push(SetFit { residuals, deviations, freedom });
            first += set.len();
        }
        // A set alone has the same answer whatever its noise.
        if change < AGREED || sets.len() == 1 {
            let weights = sets.iter().zip(&noise).flat_map(|(set, &noise)| set.weights(noise)).collect();
            return Ok((solution, weights, fits));
        }
    }
    Err(Error::Evaluation(format!(
        "{}: the noise of data set {} and of those that are fitted with it cannot be told apart; allowed: their deviations",
        sets[0].declared, sets[0].name
    )))
}

/// How much of each prediction its own datum decides.
pub(super) fn leverages(solution: &Solution, weights: &[f64], parameters: &[Parameter]) -> Vec<f64> {
    let free: Vec<Parameter> = parameters.iter().copied().filter(|p| !solution.bounded.contains(p)).collect();
    if free.is_empty() {
        return vec![0.0; weights.len()];
    }
    let q = normalised(solution, weights, &free).qr().q();
    q.row_iter().map(|row| row.norm_squared()).collect()
}

/// The weighted derivatives by some parameters, each column of length 1: then the units do not matter.
fn normalised(solution: &Solution, weights: &[f64], parameters: &[Parameter]) -> DMatrix<f64> {
    let columns = parameters.iter().map(|parameter| {
        let column = solution.gradients.column(parameter.index());
        let weighted = column.iter().zip(weights).map(|(gradient, weight)| gradient * weight.sqrt());
        DVector::from_iterator(weights.len(), weighted).normalize()
    });
    DMatrix::from_columns(&columns.collect::<Vec<_>>())
}

impl DataSet {
    /// The weights of the squares, with this noise where none is known.
    fn weights(&self, noise: f64) -> Vec<f64> {
        let of = |deviation: f64| self.weight / (deviation * deviation);
        match &self.deviations {
            Some(deviations) => deviations.iter().map(|&deviation| of(deviation)).collect(),
            None => vec![of(noise); self.len()],
        }
    }
}
