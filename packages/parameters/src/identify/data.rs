//! Measured data and what the law says to them.

use nalgebra::Matrix3;

use super::parameter::{ALL, PARAMETERS, Parameter, Values};
use super::path_response::PathResponse;
use super::response::{Measured, Modes, Response};
use toron_shared::error::Error;

/// The fibre direction of the prescribed states: the first axis.
const FIBRE: [f64; 3] = [1.0, 0.0, 0.0];
/// Parameters at which a set's derivatives show what it can tell: each has an influence.
const TRIAL: Values = [1.0, 1.0, 2.2, 1.0, 1.0, 0.04, 1.0, 1.0];
/// A derivative below this fraction of the largest is none.
const INSENSITIVE: f64 = 1e-12;

/// A curve: the state of each point, the value measured there, and how sure it is.
#[derive(Clone, Debug)]
pub struct DataSet {
    pub name: String,
    /// File, last line and column, for messages.
    pub place: String,
    /// File and line where the fit names it.
    pub declared: String,
    pub loading: Loading,
    /// What the plot is drawn over; the ordinates are what is fitted.
    pub abscissa: Axis,
    pub ordinate: Axis,
    /// The abscissa at rest.
    pub rest: f64,
    /// The standard deviation of each ordinate where it is known; else it is estimated, one for the set.
    pub deviations: Option<Vec<f64>>,
    /// Multiplies the squares of this set.
    pub weight: f64,
    /// The parameters that this set may tell.
    pub fits: Vec<Parameter>,
    /// The slack that the curve began with, where it was found and taken off.
    pub toe: Option<Toe>,
}

/// The slack of a tensile test, as its own curve shows it; on the abscissa of the file, in the units of the fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Toe {
    /// From where the abscissae count, and its standard deviation.
    pub zero: f64,
    pub deviation: f64,
    /// So many points up to here are left out.
    pub end: f64,
    pub left_out: usize,
    /// By how much each prediction grows with the abscissa, at a k_el of 1.
    pub slopes: Vec<f64>,
}

/// A column of the data, in the units of the fit.
#[derive(Clone, Debug)]
pub struct Axis {
    pub name: String,
    pub unit: String,
    pub values: Vec<f64>,
}

/// The states of a set, from which the law predicts its ordinates.
#[derive(Clone, Debug)]
pub enum Loading {
    /// Deformation gradients that are known as a whole, the fibre along the first axis.
    Prescribed { states: Vec<Matrix3<f64>>, measured: Measured },
    /// A load path, some of whose components follow from equilibrium.
    Path(Box<PathResponse>),
    /// The elongation invariant at failure, at a compaction ⟨−I_tc⟩ and a distortion I_td.
    Failure { compaction: Vec<f64>, distortion: Vec<f64> },
}

impl Loading {
    /// The predictions for all points, with their derivatives.
    ///
    /// # Errors
    /// Why the law has no answer.
    pub fn responses(&self, values: &Values) -> Result<Vec<Response>, String> {
        match self {
            Loading::Prescribed { states, measured } => {
                states.iter().map(|f| Ok(Modes::at(f, FIBRE, values)?.response(*measured, values))).collect()
            }
            Loading::Path(path) => path.responses(values),
            Loading::Failure { compaction, distortion } => {
                Ok(compaction.iter().zip(distortion).map(|(&c, &d)| failure(c, d, values)).collect())
            }
        }
    }

    /// Those points of the loading that `keep` names.
    fn subset(&self, keep: &[usize]) -> Loading {
        let pick = |values: &[f64]| keep.iter().map(|&i| values[i]).collect();
        match self {
            Loading::Prescribed { states, measured } => {
                Loading::Prescribed { states: keep.iter().map(|&i| states[i]).collect(), measured: *measured }
            }
            Loading::Path(path) => Loading::Path(Box::new(path.subset(keep))),
            Loading::Failure { compaction, distortion } => {
                Loading::Failure { compaction: pick(compaction), distortion: pick(distortion) }
            }
        }
    }
}

/// I_el where I_el/I_lim + α⟨−I_tc⟩ + β I_td = 1 (section 4.4.2), I_lim = ln(1 + ε_lim).
fn failure(compaction: f64, distortion: f64, values: &Values) -> Response {
    let of = |parameter: Parameter| values[parameter.index()];
    let limit = of(Parameter::EpsLim).ln_1p();
    let rest = 1.0 - of(Parameter::Alpha) * compaction - of(Parameter::Beta) * distortion;
    let mut response = Response { value: limit * rest, ..Response::default() };
    response.gradient[Parameter::EpsLim.index()] = rest / (1.0 + of(Parameter::EpsLim));
    response.gradient[Parameter::Alpha.index()] = -limit * compaction;
    response.gradient[Parameter::Beta.index()] = -limit * distortion;
    response
}

impl DataSet {
    pub fn len(&self) -> usize {
        self.ordinate.values.len()
    }

    pub fn is_empty(&self) -> bool {
        self.ordinate.values.is_empty()
    }

    /// The largest ordinate, by its size.
    pub fn largest(&self) -> f64 {
        self.ordinate.values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()))
    }

    /// How far a point is from rest, on the abscissa.
    pub fn distance(&self, point: usize) -> f64 {
        (self.abscissa.values[point] - self.rest).abs()
    }

    /// The parameters on which the data depend.
    ///
    /// # Errors
    /// The law has no answer.
    pub fn depends_on(&self) -> Result<Vec<Parameter>, Error> {
        let trial = match &self.loading {
            Loading::Path(path) => path.trial(),
            _ => TRIAL,
        };
        let refused = |reason| Error::Evaluation(format!("data set {}: {reason}", self.name));
        let mut sizes = [0.0_f64; PARAMETERS];
        for response in self.loading.responses(&trial).map_err(refused)? {
            for ((size, derivative), value) in sizes.iter_mut().zip(response.gradient).zip(trial) {
                *size = size.max((derivative * if value == 0.0 { 1.0 } else { value }).abs());
            }
        }
        let largest = sizes.iter().copied().fold(0.0, f64::max);
        Ok(ALL.into_iter().filter(|parameter| sizes[parameter.index()] > INSENSITIVE * largest).collect())
    }

    /// The set of those points that are at most this far from rest.
    pub fn up_to(&self, distance: f64) -> DataSet {
        self.of(|i| self.distance(i) <= distance)
    }

    /// The set of those points that `keep` names.
    pub fn of(&self, keep: impl Fn(usize) -> bool) -> DataSet {
        let keep: Vec<usize> = (0..self.len()).filter(|&i| keep(i)).collect();
        let pick = |values: &[f64]| keep.iter().map(|&i| values[i]).collect();
        let axis = |axis: &Axis| Axis { values: pick(&axis.values), ..axis.clone() };
        DataSet {
            loading: self.loading.subset(&keep),
            abscissa: axis(&self.abscissa),
            ordinate: axis(&self.ordinate),
            deviations: self.deviations.as_deref().map(pick),
            toe: self.toe.as_ref().map(|toe| Toe { slopes: pick(&toe.slopes), ..toe.clone() }),
            ..self.clone()
        }
    }
}
