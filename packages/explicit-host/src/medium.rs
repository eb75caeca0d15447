//! A material as the explicit host uses it: its law's properties, and the wave speeds and moduli that viscosity and
//! hourglass control take from them.

use super::lanes::Number;
use super::solid::{SOLID_FAILED, SOLID_STATE, Solid};
use super::wave_bounds::wave_bounds;
use toron::law::parameters::LINEAR_ELASTIC_PROPERTIES;
use toron::law::wave_bounds::WaveBounds;
use toron::law::{description, hyperelastic, linear_elastic};
use toron::{Criterion, Rotation};
use toron_c::{FrictionalLaw, HyperelasticLaw, LinearElasticLaw, TORON_CRITERION_FIBRE, TORON_CRITERION_PRINCIPAL};
use toron_materials::entries::blocks::{LinearFrame, prepared, prepared_frictional, prepared_linear};
use toron_materials::material::model::{Law, Material};
use toron_shared::error::Error;

/// Coefficients of hourglass control and viscosity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Control {
    /// Fraction of the stiffness with which a material would resist the modes.
    pub hourglass: f64,
    /// Coefficients of viscosity: linear, quadratic, and against a change of the section's shape.
    pub linear: f64,
    pub quadratic: f64,
    pub shape: f64,
    /// Whether the stable step tells waves along the fibre from those across it, where it can.
    pub by_direction: bool,
}

/// Names of the energy densities: the hyperelastic law's modes, and the work of the linear elastic law and the solid,
/// which have no modes.
pub const ENERGY_NAMES: [&str; 5] = ["w_el", "w_tc", "w_td", "w_ld", "work"];

/// A law as its C entry takes it, or a solid of the host's own.
#[derive(Clone, Debug)]
pub enum Entry<T> {
    Hyperelastic(HyperelasticLaw<T>),
    Frictional(FrictionalLaw<T>),
    /// With the modulus along the fibre.
    LinearElastic {
        law: LinearElasticLaw<T>,
        modulus: f64,
        frame: LinearFrame,
        criterion: i32,
    },
    Solid(Solid),
}

/// A material as the host uses it.
#[derive(Clone, Debug)]
pub struct Medium<T> {
    pub entry: Entry<T>,
    pub density: f64,
    pub control: Control,
    /// The modulus of hourglass control.
    pub hourglass: f64,
    pub bounds: WaveBounds,
    /// Whether elements may fail, and the linear elastic law's stress at failure.
    pub fails: bool,
    pub strength: f64,
    /// Wave speed at rest along the fibre, a bound of it for the wave that compacts the section, and that of the one
    /// that changes its shape; for viscosity.
    pub wave_speed: f64,
    pub compaction_speed: f64,
    pub distortion_speed: f64,
}

/// A yarn law, prepared.
///
/// # Errors
/// A property is wrong.
fn yarn_entry<T: Number>(material: &Material) -> Result<Entry<T>, Error> {
    let values: Vec<T> = material.values().into_iter().map(T::from_f64).collect();
    let entry = match &material.law {
        Law::Own(_) => prepared_frictional(&values).map(Entry::Frictional),
        _ => prepared(&values).map(Entry::Hyperelastic),
    };
    entry.map_err(Error::Input)
}

impl<T: Number> Medium<T> {
    /// # Errors
    /// The frame is the spin's, which needs axes of its own; a property that is wrong.
    pub fn new(material: &Material, density: f64, control: Control) -> Result<Self, Error> {
        // What resists a section's distortion: the modes bend and shear elements mostly across the fibre.
        let (entry, along, across, shear, distortion, strength) = match (&material.law, material.law.yarn()) {
            (_, Some(yarn)) => {
                // W = k_tc |I_tc|^p + ½ k_td I_td² by one transverse logarithmic strain, of which I_tc and I_td are
                // half; with p >= 2 this is its stiffness at |I_tc| = 1, and less before. I_td is half of a shear, too.
                // Fibres that slide hold less.
                let hyperelastic::Properties { k_el, k_tc, p, k_td, .. } = yarn;
                let across = (p * (p - 1.0) * k_tc + k_td) / 4.0;
                (yarn_entry(material)?, k_el, across, k_td / 4.0, k_td, 0.0)
            }
            (&Law::LinearElastic { law, properties, frame, criterion }, None) => {
                let values = <[f64; LINEAR_ELASTIC_PROPERTIES]>::from(properties);
                let frame = match frame {
                    Rotation::Fibre => LinearFrame::Fibre,
                    Rotation::Polar => LinearFrame::Polar,
                    Rotation::Spin => {
                        return Err(Error::Input("frame is \"spin\"; allowed here: fibre, polar".to_string()));
                    }
                };
                let criterion = match criterion {
                    Criterion::LargestPrincipal => TORON_CRITERION_PRINCIPAL,
                    Criterion::FibreStress => TORON_CRITERION_FIBRE,
                };
                let prepared = prepared_linear(&values.map(T::from_f64)).map_err(Error::Input)?;
                let linear_elastic::Properties { e_1, e_2, g, sigma_lim, .. } = properties;
                let entry = Entry::LinearElastic { law: prepared, modulus: e_1, frame, criterion };
                (entry, law.wave_modulus(), e_2, g, e_2, sigma_lim)
            }
            (Law::Hyperelastic { .. } | Law::Own(_), None) => {
                let allowed = "hyperelastic, linear-elastic, frictional";
                return Err(Error::Input(format!("the law is {}; allowed here: {allowed}", material.law_name())));
            }
        };
        Ok(Medium {
            entry,
            density,
            control,
            hourglass: control.hourglass * distortion,
            bounds: if control.by_direction { wave_bounds(material) } else { WaveBounds::Isotropic },
            fails: material.can_fail(),
            strength,
            wave_speed: (along / density).sqrt(),
            compaction_speed: (across / density).sqrt(),
            distortion_speed: (shear / density).sqrt(),
        })
    }

    /// A solid whose nodes do not move along its fibre.
    pub fn of_solid(solid: Solid, density: f64, control: Control) -> Self {
        let speed = |modulus: f64| (modulus / density).sqrt();
        Medium {
            entry: Entry::Solid(solid),
            density,
            control,
            hourglass: control.hourglass * solid.g_23,
            bounds: WaveBounds::Isotropic,
            fails: false,
            strength: 0.0,
            wave_speed: speed(solid.c_22),
            compaction_speed: speed(solid.c_22),
            distortion_speed: speed(solid.g_23),
        }
    }

    /// The law's number of state variables, and where the latch stands among them.
    pub fn state(&self) -> (usize, usize) {
        let law = match self.entry {
            Entry::Hyperelastic(_) => &description::HYPERELASTIC,
            Entry::Frictional(_) => &description::FRICTIONAL,
            Entry::LinearElastic { .. } => &description::LINEAR_ELASTIC,
            Entry::Solid(_) => return (SOLID_STATE, SOLID_FAILED),
        };
        (law.state.len(), law.failed)
    }
}
