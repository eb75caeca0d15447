//! A material as the explicit host uses it: its law's properties, and the wave speeds and moduli that viscosity and
//! hourglass control take from them.

use super::lanes::Number;
use super::own::OwnEntry;
use super::sliding::LEAST;
use super::solid::{SOLID_FAILED, SOLID_STATE, Solid};
use super::wave_bounds::wave_bounds;
use toron::law::description;
use toron::law::resistance::{Resistance, ShearLimit};
use toron::law::wave_bounds::WaveBounds;
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

/// Names of the energy densities: the yarn laws' modes, and the work of the linear elastic law and the solid, or the
/// energy of a law of one's own, which have no modes.
pub const ENERGY_NAMES: [&str; 5] = ["w_el", "w_tc", "w_td", "w_ld", "work"];

/// A law of the library as its C entry takes it, a law of one's own, or a solid of the host's.
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
    Own(OwnEntry<T>),
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
    /// What viscosity of the shape and hourglass control across the fibre stay below, of a section that slides.
    pub shear_limit: Option<ShearLimit>,
    /// What hourglass control may hold in any case.
    pub least_shear: f64,
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

impl<T: Number> Entry<T> {
    /// A material's law, prepared, and the linear elastic law's stress at failure.
    ///
    /// # Errors
    /// The frame is the spin's, which needs axes of its own; a property that is wrong; a law of one's own that the host
    /// cannot run.
    fn new(material: &Material) -> Result<(Self, f64), Error> {
        let values: Vec<T> = material.values().into_iter().map(T::from_f64).collect();
        let yarn = match &material.law {
            Law::Hyperelastic { .. } => prepared(&values).map(Entry::Hyperelastic),
            Law::Own(own) if own.is_frictional() => prepared_frictional(&values).map(Entry::Frictional),
            Law::Own(own) => return OwnEntry::new(own).map(|entry| (Entry::Own(entry), 0.0)),
            Law::LinearElastic { properties, frame, criterion, .. } => {
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
                let law = prepared_linear(&values).map_err(Error::Input)?;
                let entry = Entry::LinearElastic { law, modulus: properties.e_1, frame, criterion };
                return Ok((entry, properties.sigma_lim));
            }
        };
        yarn.map(|entry| (entry, 0.0)).map_err(Error::Input)
    }
}

impl<T: Number> Medium<T> {
    /// Whether its stiffness is bounded by direction, not by the law's wave speed alone.
    pub fn is_bounded_by_direction(&self) -> bool {
        !matches!(self.bounds, WaveBounds::Isotropic)
    }

    /// # Errors
    /// As for the law's entry: a property that is wrong, a law that the host cannot run.
    pub fn new(material: &Material, density: f64, control: Control) -> Result<Self, Error> {
        let (entry, strength) = Entry::new(material)?;
        let Resistance { along, across, shape, hourglass } = material.law.resistance();
        Ok(Medium {
            entry,
            density,
            control,
            hourglass: control.hourglass * hourglass,
            shear_limit: material.law.shear_limit(),
            least_shear: LEAST * hourglass,
            bounds: if control.by_direction { wave_bounds(material) } else { WaveBounds::Isotropic },
            fails: material.can_fail(),
            strength,
            wave_speed: (along / density).sqrt(),
            compaction_speed: (across / density).sqrt(),
            distortion_speed: (shape / density).sqrt(),
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
            shear_limit: None,
            least_shear: 0.0,
            bounds: WaveBounds::Isotropic,
            fails: false,
            strength: 0.0,
            wave_speed: speed(solid.c_22),
            compaction_speed: speed(solid.c_22),
            distortion_speed: speed(solid.g_23),
        }
    }

    /// The number of state variables that are kept, and where the latch stands among them.
    pub fn state(&self) -> (usize, usize) {
        let law = match &self.entry {
            Entry::Hyperelastic(_) => &description::HYPERELASTIC,
            Entry::Frictional(_) => &description::FRICTIONAL,
            Entry::LinearElastic { .. } => &description::LINEAR_ELASTIC,
            Entry::Own(own) => return (own.rows(), own.failed),
            Entry::Solid(_) => return (SOLID_STATE, SOLID_FAILED),
        };
        (law.state.len(), law.failed)
    }

    /// The place of the energy lost among them, of a law that tells it.
    pub fn lost(&self) -> Option<usize> {
        match &self.entry {
            Entry::Frictional(_) => description::FRICTIONAL.lost,
            Entry::Own(own) => own.lost(),
            Entry::Hyperelastic(_) | Entry::LinearElastic { .. } | Entry::Solid(_) => None,
        }
    }
}
