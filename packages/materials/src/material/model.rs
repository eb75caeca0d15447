//! The laws behind one interface: properties, memory, evaluation from the deformation gradient.

use nalgebra::{Matrix3, SMatrix, Vector3};

use super::laws::LawName;
use super::own_law::Own;
use super::preset::Guesses;
use toron::law::parameters::{HYPERELASTIC_PROPERTIES, LINEAR_ELASTIC_PROPERTIES, Property, STRESS};
use toron::law::resistance::{Resistance, ShearLimit};
use toron::law::state::{FAILURE_INDEX, FRICTIONAL_FAILED, INVARIANTS, LINEAR_LARGEST, LINEAR_STRESS, StateVariable};
use toron::law::{hyperelastic, linear_elastic};
use toron::law::{interface, status};
use toron::{Criterion, Hyperelastic, LinearElastic, Measure, Request, Rotation};

/// A law, prepared, and the properties that it was prepared from.
#[derive(Clone, Debug)]
pub enum Law {
    Hyperelastic {
        law: Hyperelastic<f64>,
        properties: hyperelastic::Properties<f64>,
    },
    LinearElastic {
        law: LinearElastic,
        properties: linear_elastic::Properties<f64>,
        frame: Rotation,
        criterion: Criterion,
    },
    Own(Own),
}

/// A law with its properties.
#[derive(Clone, Debug)]
pub struct Material {
    pub law: Law,
    /// Reference density, for wave speeds.
    pub density: Option<f64>,
    /// The preset's name, or the law's.
    pub label: String,
    /// What is other than the preset has it, as in `k_ld = 126 MPa; density = 1.44e-3 g/mm³`.
    pub own: String,
    pub origin: Origin,
    /// The temperature of its points, for a law that reads it.
    pub temperature: Option<f64>,
}

/// Where a material's values come from.
#[derive(Clone, Debug, Default)]
pub struct Origin {
    /// The preset's, on one line; empty without a preset.
    pub source: String,
    pub guesses: Guesses,
}

/// The history of a point: what it keeps from one increment to the next.
#[derive(Clone, Debug, PartialEq)]
pub struct Memory {
    /// Deformation gradient of the last increment, and the time at its end.
    pub f: Matrix3<f64>,
    pub time: f64,
    /// The law's state variables.
    pub state: Vec<f64>,
    /// The linear elastic law's axes, which follow the spin where that is its frame.
    axes: Matrix3<f64>,
}

/// dP/dF, both by columns 11 21 31 12 22 32 13 23 33.
pub type NominalTangent = SMatrix<f64, 9, 9>;

/// The material's response to a deformation gradient.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// Cauchy stress 11 22 33 12 23 31.
    pub cauchy: [f64; 6],
    pub memory: Memory,
    /// S_el, S_tc, S_td, S_ld, each 11 22 33 12 23 31; 0 for a law without modes.
    pub modes: [[f64; 6]; 4],
    /// ρ0 c² for a bound c of the wave speed.
    pub wave_modulus: f64,
}

impl Law {
    /// Checks the properties, in the order of the law's table, and prepares the law.
    ///
    /// # Errors
    /// The first property that is wrong.
    pub fn new(name: LawName, values: &[f64], frame: Rotation, criterion: Criterion) -> Result<Law, toron::Error> {
        match name {
            LawName::Hyperelastic => {
                let law = Hyperelastic::new(values)?;
                Ok(Law::Hyperelastic { law, properties: array(values).into() })
            }
            LawName::LinearElastic => {
                let law = LinearElastic::new(values)?;
                Ok(Law::LinearElastic { law, properties: array(values).into(), frame, criterion })
            }
            LawName::Own(law) => law.prepared(values).map(Law::Own),
        }
    }

    /// The same law, with its frame and criterion, with other properties.
    ///
    /// # Errors
    /// The first property that is wrong.
    pub fn with(&self, values: &[f64]) -> Result<Law, toron::Error> {
        let (frame, criterion) = match *self {
            Law::Hyperelastic { .. } | Law::Own(_) => (Rotation::Fibre, Criterion::LargestPrincipal),
            Law::LinearElastic { frame, criterion, .. } => (frame, criterion),
        };
        Law::new(self.name(), values, frame, criterion)
    }

    pub fn name(&self) -> LawName {
        match self {
            Law::Hyperelastic { .. } => LawName::Hyperelastic,
            Law::LinearElastic { .. } => LawName::LinearElastic,
            Law::Own(own) => LawName::Own(own.law),
        }
    }

    /// The properties of the hyperelastic law that a yarn has, with friction between its fibres or without.
    pub fn yarn(&self) -> Option<hyperelastic::Properties<f64>> {
        match self {
            Law::Hyperelastic { properties, .. } => Some(*properties),
            Law::Own(own) if own.is_frictional() => Some(array(&own.values).into()),
            Law::LinearElastic { .. } | Law::Own(_) => None,
        }
    }

    /// What resists the motions of an element.
    pub fn resistance(&self) -> Resistance {
        match self {
            Law::Hyperelastic { law, .. } => interface::Law::resistance(law),
            Law::LinearElastic { law, .. } => interface::Law::resistance(law),
            Law::Own(own) => own.resistance(),
        }
    }

    /// The most shear that viscosity and hourglass control may add to that of a section whose fibres slide.
    pub fn shear_limit(&self) -> Option<ShearLimit> {
        match self {
            Law::Hyperelastic { .. } | Law::LinearElastic { .. } => None,
            Law::Own(own) => own.shear_limit(),
        }
    }

    /// Bulk and shear modulus whose wave, K + 4G/3, is that along the fibre, or a faster one at rest.
    pub fn bulk_and_shear(&self) -> [f64; 2] {
        match self {
            Law::Hyperelastic { law, .. } => law.bulk_and_shear(),
            Law::LinearElastic { law, .. } => law.bulk_and_shear(),
            Law::Own(own) => own.bulk_and_shear(),
        }
    }
}

/// The values of a slice of N.
fn array<const N: usize>(values: &[f64]) -> [f64; N] {
    std::array::from_fn(|i| values[i])
}

/// The names of materials that follow one another, the first up to a place.
pub fn names(materials: &[Material], to: &str) -> String {
    let names: Vec<String> = materials.iter().map(Material::name).collect();
    names.join(&format!(" to {to}; then "))
}

impl Material {
    /// The law's table of properties.
    pub fn table(&self) -> &'static [Property] {
        self.law.name().table()
    }

    /// The law's table of state variables.
    pub fn state_table(&self) -> &'static [StateVariable] {
        self.law.name().description().state
    }

    /// The label, and what is other than the preset has it.
    pub fn name(&self) -> String {
        if self.own.is_empty() { self.label.clone() } else { format!("{} ({})", self.label, self.own) }
    }

    pub fn law_name(&self) -> &'static str {
        match &self.law {
            Law::Hyperelastic { .. } => "hyperelastic",
            Law::LinearElastic { .. } => "linear elastic",
            Law::Own(own) => &own.law.name,
        }
    }

    /// Unit fibre direction in the reference placement; the first axis of a law without fibre.
    pub fn fibre(&self) -> Vector3<f64> {
        match &self.law {
            Law::Hyperelastic { properties: hyperelastic::Properties { fibre, .. }, .. }
            | Law::LinearElastic { properties: linear_elastic::Properties { fibre, .. }, .. } => {
                Vector3::from(*fibre).normalize()
            }
            Law::Own(own) => Vector3::from(own.axes()[0]),
        }
    }

    /// Whether the law has a fibre.
    pub fn has_fibre(&self) -> bool {
        self.law.name().description().has_fibre()
    }

    /// The properties in the order of [`table`](Self::table).
    pub fn values(&self) -> Vec<f64> {
        match &self.law {
            Law::Hyperelastic { properties, .. } => <[f64; HYPERELASTIC_PROPERTIES]>::from(*properties).to_vec(),
            Law::LinearElastic { properties, .. } => <[f64; LINEAR_ELASTIC_PROPERTIES]>::from(*properties).to_vec(),
            Law::Own(own) => own.values.clone(),
        }
    }

    /// What counts as a small stress is measured by this: the largest of the properties that are a stress, or the bulk
    /// modulus of a law of which nothing is known.
    pub fn stress_scale(&self) -> f64 {
        if let Law::Own(own) = &self.law {
            return own.bulk_and_shear()[0];
        }
        let stresses = self.table().iter().zip(self.values()).filter(|(property, _)| property.dimension == STRESS);
        stresses.map(|(_, value)| value).fold(0.0, f64::max)
    }

    /// The memory of a point at rest.
    pub fn at_rest(&self) -> Memory {
        let axes = match &self.law {
            Law::Hyperelastic { .. } | Law::Own(_) => Matrix3::identity(),
            Law::LinearElastic { law, .. } => law.reference_axes(),
        };
        let state = if let Law::Own(own) = &self.law { own.fresh() } else { vec![0.0; self.state_table().len()] };
        Memory { f: Matrix3::identity(), time: 0.0, state, axes }
    }

    /// The stress and the new memory at the deformation gradient `f` and the time `time`, for a law that reads it.
    ///
    /// # Errors
    /// The law's status code where it cannot be evaluated.
    pub fn evaluate(&self, f: &Matrix3<f64>, time: f64, memory: &Memory, request: Request) -> Result<Answer, i32> {
        let mut axes = memory.axes;
        let none = [[0.0; 6]; 4];
        let (status, cauchy, state, modes, wave_modulus) = match &self.law {
            Law::Hyperelastic { law, .. } => {
                let point = law.point(f, &array(&memory.state), request);
                (point.status, point.stress, point.state.to_vec(), point.modes, point.wave_modulus)
            }
            Law::LinearElastic { law, frame, criterion, .. } => {
                let point = law.step(&memory.f, f, &array(&memory.state), *frame, *criterion, &mut axes);
                (point.status, point.stress, point.state.to_vec(), none, law.wave_modulus())
            }
            Law::Own(own) => {
                let point = own.point([&memory.f, f], [memory.time, time], self.temperature, &memory.state, None);
                (point.status[0], array(&point.stress), point.state, none, point.wave_modulus[0])
            }
        };
        let memory = Memory { f: *f, time, state, axes };
        if status == status::OK { Ok(Answer { cauchy, memory, modes, wave_modulus }) } else { Err(status) }
    }

    /// The Cauchy stress at the deformation gradient `f` and the time `time`, and dP/dF.
    ///
    /// # Errors
    /// The law's status code where it cannot be evaluated.
    pub fn tangent(&self, f: &Matrix3<f64>, time: f64, memory: &Memory) -> Result<([f64; 6], NominalTangent), i32> {
        let (cauchy, nominal, status) = match &self.law {
            Law::Hyperelastic { law, .. } => {
                let request = Request { stress: true, ..Request::default() };
                let (point, nominal) = law.point_with_nominal(&f.data.0, None, &array(&memory.state), request);
                (point.stress, nominal, point.status)
            }
            Law::LinearElastic { law, frame, criterion, .. } => {
                let (mut axes, old) = (memory.axes, array(&memory.state));
                let (point, tangent) = law.step_with_tangent(&memory.f, f, &old, *frame, *criterion, &mut axes);
                (point.stress, tangent.nominal(f, &point.stress), point.status)
            }
            Law::Own(own) => {
                let times = [memory.time, time];
                let measure = Some(Measure::Nominal);
                let point = own.point([&memory.f, f], times, self.temperature, &memory.state, measure);
                // By rows there.
                let nominal = std::array::from_fn(|entry| point.tangent[entry % 9 * 9 + entry / 9]);
                (array(&point.stress), nominal, point.status[0])
            }
        };
        if status == status::OK { Ok((cauchy, NominalTangent::from_column_slice(&nominal))) } else { Err(status) }
    }

    /// Whether the point has failed.
    pub fn failed(&self, memory: &Memory) -> bool {
        memory.state[self.law.name().description().failed] != 0.0
    }

    /// Energy per reference volume: the sum of the four modes', or the linear elastic law's work; 0 of a law that
    /// counts none.
    pub fn energy(&self, memory: &Memory) -> f64 {
        memory.state[self.law.name().description().energies.clone()].iter().sum()
    }

    /// Energy lost per reference volume; `None` of a law that loses none.
    pub fn lost_energy(&self, memory: &Memory) -> Option<f64> {
        let law = self.law.name().description();
        law.lost.map(|_| law.lost_energy(&memory.state))
    }

    /// Whether the law counts energies.
    pub fn has_energy(&self) -> bool {
        !self.law.name().description().energies.is_empty()
    }

    /// 1 at the failure limit, 0 without one. The linear elastic law's is its criterion's stress over σ_lim. None of a
    /// law that tells nothing but whether it has failed.
    pub fn failure_index(&self, memory: &Memory) -> Option<f64> {
        match &self.law {
            Law::Hyperelastic { .. } => Some(memory.state[FAILURE_INDEX]),
            Law::Own(own) if own.is_frictional() => Some(memory.state[FRICTIONAL_FAILED - 1]),
            Law::LinearElastic { properties: linear_elastic::Properties { sigma_lim, .. }, criterion, .. } => {
                let stress = match criterion {
                    Criterion::LargestPrincipal => memory.state[LINEAR_LARGEST],
                    Criterion::FibreStress => memory.state[LINEAR_STRESS],
                };
                Some(if *sigma_lim == 0.0 { 0.0 } else { stress / sigma_lim })
            }
            Law::Own(_) => None,
        }
    }

    /// The terms of the hyperelastic law's failure index: I_el/I_lim, α⟨−I_tc⟩, β I_td; their sum counts in tension
    /// only. None of other laws.
    pub fn failure_terms(&self, memory: &Memory) -> Option<[f64; 3]> {
        let Law::Hyperelastic { properties: hyperelastic::Properties { eps_lim, alpha, beta, .. }, .. } = self.law
        else {
            return None;
        };
        let [i_el, i_tc, i_td] = [0, 1, 2].map(|mode| memory.state[INVARIANTS + mode]);
        Some([i_el / eps_lim.ln_1p(), alpha * (-i_tc).max(0.0), beta * i_td])
    }

    /// The stiffness against longitudinal shear, which the yarn laws alone may lack.
    pub fn longitudinal_shear(&self) -> Option<f64> {
        self.law.yarn().map(|yarn| yarn.k_ld)
    }

    /// Whether there is a limit of the failure index at all.
    pub fn can_fail(&self) -> bool {
        self.strength() > 0.0
    }

    /// The nominal strain at failure, or the linear elastic law's stress; 0 without failure.
    pub fn strength(&self) -> f64 {
        match (&self.law, self.law.yarn()) {
            (_, Some(yarn)) => yarn.eps_lim,
            (Law::LinearElastic { properties, .. }, None) => properties.sigma_lim,
            (Law::Hyperelastic { .. } | Law::Own(_), None) => 0.0,
        }
    }

    /// What the law takes as the limit of a point that has this strength; 0 where the property has it.
    pub fn limit(&self, strength: f64) -> f64 {
        match self.law.yarn() {
            _ if strength == self.strength() => 0.0,
            Some(_) => strength.ln_1p(),
            None => strength,
        }
    }
}
