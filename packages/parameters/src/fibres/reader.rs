//! A scene from its TOML file. The format is described in `docs/reference/fibre-files.md`.

use std::ops::Range;
use std::path::Path;

use super::file::{CaseFile, FibreFile, PackingName, SceneFile, SectionName, StrikerName};
use super::scene::{Case, Contact, Fibre, Outline, Packing, Scene, SectionLaw, Striker, Walls};
use toron::host::units::UnitSystem;
use toron_materials::material::laws::Laws;
use toron_materials::material::preset::Preset;
use toron_materials::units::{self, SPEED};
use toron_shared::checked::{Checked, value};
use toron_shared::error::Error;
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::{self, Source};
use toron_strikes::cases::{self, CaseTables};

/// A bead takes some 600 bytes in LAMMPS, and its identifiers have 31 bits.
const MOST_BEADS: f64 = 1e9;
/// Samples of a history where the file does not say otherwise.
const SAMPLES: f64 = 200.0;
/// The step as a part of the largest that is stable, where the file does not say otherwise.
const STEP: f64 = 0.4;
/// How the speed of a driven section comes in, in the time that the wave of elongation takes from bead to bead: at
/// once, it would be overshot by a quarter.
const RAMP: f64 = 64.0;
/// How beads that walls press are braked, where the file does not say otherwise.
const DAMPING: f64 = 0.05;
/// Speeds of the wave along a fibre, in m/s.
const WAVES: Range<f64> = 1e2..1e5;
/// The files that cases have in common, by their names without the ending: the fit's too.
pub const COMMON: [&str; 4] = ["summary", "pressed", "fit", "parameters"];

impl Scene {
    /// Reads the file.
    ///
    /// # Errors
    /// An input error that names file, line, value and what is allowed.
    pub fn read(path: &Path) -> Result<Scene, Error> {
        let (name, text) = toml_file::read(path)?;
        Scene::parse(&name, &text)
    }

    /// The scene that `text` describes; `name` stands for the file in messages.
    ///
    /// # Errors
    /// An input error that names file, line, value and what is allowed.
    pub fn parse(name: &str, text: &str) -> Result<Scene, Error> {
        let source = Source { name, text };
        let tables = source.tables()?;
        cases::check::<CaseFile>(&source, tables.get_ref())?;
        let file: SceneFile = source.parse()?;
        let units = units::system(&source, &file.units)?;
        let read = |case: CaseTables<CaseFile>| {
            if let Some(given) = case.own_table.name.as_ref().filter(|name| is_of_fit(name.get_ref())) {
                let message =
                    format!("case \"{}\", as tables of the fit are called; allowed: another beginning", case.name);
                return Err(source.error(given.span(), &message));
            }
            Reader { source: &source, units: &units, file: &case.table, span: case.span() }.case(case.name.clone())
        };
        let cases = cases::cases(&source, tables.get_ref(), &[], &COMMON)?;
        let cases = cases.into_iter().map(read).collect::<Result<Vec<Case>, Error>>()?;
        Ok(Scene { title: file.title.unwrap_or_else(|| name.to_string()), units, cases })
    }
}

/// Whether a table of the fit may be called so.
fn is_of_fit(name: &str) -> bool {
    name.to_ascii_lowercase().starts_with("fit-")
}

/// A case's table and what is needed to read it.
struct Reader<'a> {
    source: &'a Source<'a>,
    units: &'a UnitSystem,
    file: &'a CaseFile,
    /// The place that errors name for keys that are missing.
    span: Range<usize>,
}

impl Reader<'_> {
    fn missing(&self, key: &str, allowed: &str) -> Error {
        self.source.error(self.span.clone(), &format!("{key} is missing; allowed: {allowed}"))
    }

    fn needed<V: Checked>(&self, key: &str, given: &Option<V>) -> Result<V::Value, Error> {
        self.source.needed(key, given, self.span.clone())
    }

    /// A number above 0, up to a value that a key of this name has; or the default.
    fn up_to(&self, key: &str, value: &Option<Spanned<f64>>, most: (&str, f64), default: f64) -> Result<f64, Error> {
        let Some(value) = value else { return Ok(default) };
        let number = *value.get_ref();
        if number > 0.0 && number <= most.1 {
            return Ok(number);
        }
        let message = format!("{key} is {number}; allowed: a number > 0, up to {} = {}", most.0, most.1);
        Err(self.source.error(value.span(), &message))
    }

    fn case(&self, name: String) -> Result<Case, Error> {
        let file = self.file;
        let end = self.needed("end", &file.end)?;
        let fibre = self.fibre()?;
        let [half_length, spacing] = self.lengths(&fibre)?;
        let fibres = self.fibres(half_length / spacing)?;
        let is_pressed = file.striker() == StrikerName::Walls;
        let case = Case {
            fibre,
            half_length,
            spacing,
            fibres,
            outline: self.outline()?,
            packing: self.packing(),
            contact: self.contact(&fibre, fibres)?,
            friction: value(&file.friction).unwrap_or(0.0),
            striker: self.striker(&fibre, spacing)?,
            speed: if is_pressed { 0.0 } else { self.needed("speed", &file.speed)? },
            end,
            sample: self.up_to("sample", &file.sample, ("end", end), end / SAMPLES)?,
            pictures: self.source.pictures(&file.pictures, &name, end)?,
            step: self.up_to("step", &file.step, ("the largest stable one", 1.0), STEP)?,
            law: file.law.as_ref().map(|law| self.source.file("law", law)).transpose()?,
            name,
        };
        Ok(case)
    }

    /// The half length and the spacing. Between walls no bead moves along the fibres: one of a diameter's length stands
    /// for each.
    fn lengths(&self, fibre: &Fibre) -> Result<[f64; 2], Error> {
        let file = self.file;
        if file.striker() == StrikerName::Walls {
            return Ok([fibre.diameter; 2]);
        }
        let half_length = self.needed("half-length", &file.half_length)?;
        let spacing = self.needed("spacing", &file.spacing)?;
        if spacing > 0.5 * half_length {
            let message =
                format!("spacing is {spacing}; allowed: a number > 0, up to half of half-length = {half_length}");
            return Err(self.source.error(file.spacing.as_ref().map_or(self.span.clone(), Spanned::span), &message));
        }
        Ok([half_length, spacing])
    }

    fn fibre(&self) -> Result<Fibre, Error> {
        let Some(table) = &self.file.fibre else {
            return Err(self.missing("fibre", "{ diameter, modulus, density, strain-at-failure }"));
        };
        let FibreFile { diameter, modulus, density, strain_at_failure } = table.get_ref();
        let [modulus, density] = [self.needed("modulus", modulus)?, self.needed("density", density)?];
        // Outside of this no fibre is, and the units are not those that were meant.
        let wave = (modulus / density).sqrt() / self.units.from_si(1.0, SPEED);
        if !WAVES.contains(&wave) {
            let message = format!(
                "modulus and density make a wave of {wave:.3e} m/s; allowed: {:.0e} to {:.0e} m/s",
                WAVES.start, WAVES.end
            );
            return Err(self.source.error(table.span(), &message));
        }
        Ok(Fibre {
            diameter: self.needed("diameter", diameter)?,
            modulus,
            density,
            strain_at_failure: value(strain_at_failure),
        })
    }

    fn fibres(&self, beads: f64) -> Result<usize, Error> {
        let count = self.needed("fibres", &self.file.fibres)?;
        let all = count as f64 * beads;
        if let Some(given) = self.file.fibres.as_ref().filter(|_| all > MOST_BEADS) {
            let message = format!("fibres of this spacing make {all:.2e} beads; allowed: up to {MOST_BEADS:.0e}");
            return Err(self.source.error(given.span(), &message));
        }
        Ok(count)
    }

    fn outline(&self) -> Result<Outline, Error> {
        let file = self.file;
        let [aspect, width, height] = [value(&file.aspect), value(&file.width), value(&file.height)];
        match (file.section(), aspect, width, height) {
            (SectionName::Circle, _, Some(width), _) => Ok(Outline::Size([width; 2])),
            (SectionName::Circle, ..) => Ok(Outline::Aspect(1.0)),
            (SectionName::Box, aspect, ..) => Ok(Outline::Box(aspect.unwrap_or(1.0))),
            (SectionName::Ellipse, None, Some(width), Some(height)) => Ok(Outline::Size([width, height])),
            (SectionName::Ellipse, Some(aspect), None, None) => Ok(Outline::Aspect(aspect)),
            (SectionName::Ellipse, ..) => {
                let message = "section is ellipse; allowed: with aspect, or with width and height";
                Err(self.source.error(self.span.clone(), message))
            }
        }
    }

    fn packing(&self) -> Packing {
        match self.file.packing() {
            PackingName::Hexagonal => Packing::Hexagonal,
            PackingName::Random => Packing::Random { seed: self.file.seed.as_ref().map_or(1, |seed| *seed.get_ref()) },
        }
    }

    /// The force rises with the depth, up to half a fibre.
    fn contact(&self, fibre: &Fibre, fibres: usize) -> Result<Contact, Error> {
        let allowed = "one to three coefficients of a force that rises with the depth, up to a fibre's radius";
        let length = value(&self.file.contact_length).unwrap_or(fibre.diameter);
        let Some(given) = &self.file.contact else {
            // A single fibre meets no other.
            let none = Contact { coefficients: [0.0; 3], length };
            return if fibres == 1 { Ok(none) } else { Err(self.missing("contact", allowed)) };
        };
        let list = given.get_ref();
        let mut coefficients = [0.0; 3];
        if (1..=3).contains(&list.len()) {
            coefficients[..list.len()].copy_from_slice(list);
        }
        let [a, b, c] = coefficients;
        let slope = |part: usize| {
            let depth = 0.5 * fibre.diameter * part as f64 / 100.0;
            a + 2.0 * b * depth + 3.0 * c * depth * depth
        };
        if !(0..=100).all(|part| slope(part) > 0.0) {
            let message = format!("contact is {list:?}; allowed: {allowed}");
            return Err(self.source.error(given.span(), &message));
        }
        Ok(Contact { coefficients, length })
    }

    /// The law's section of a preset.
    fn law(&self, name: &Spanned<String>) -> Result<SectionLaw, Error> {
        let error = |message: &str| self.source.error(name.span(), message);
        let preset = Preset::find(Laws::Toron, name.get_ref(), self.source.folder(), error)?;
        let values = preset.complete(self.units)?;
        let value = |property: &str| {
            let index = preset.law.table().iter().position(|known| known.name == property);
            index.map(|index| values[index]).ok_or_else(|| {
                error(&format!("preset \"{}\" has no {property}; allowed: one of the hyperelastic law", name.get_ref()))
            })
        };
        Ok(SectionLaw { k_tc: value("k_tc")?, p: value("p")?, k_td: value("k_td")? })
    }

    fn striker(&self, fibre: &Fibre, spacing: f64) -> Result<Striker, Error> {
        let file = self.file;
        if file.striker() == StrikerName::Driven {
            let default = RAMP * spacing / (fibre.modulus / fibre.density).sqrt();
            return Ok(Striker::Driven { ramp: value(&file.ramp).unwrap_or(default) });
        }
        if file.striker() == StrikerName::Walls {
            return Ok(Striker::Walls {
                walls: file.walls.as_ref().map_or(Walls::AllSides, |walls| *walls.get_ref()),
                closing: self.needed("closing", &file.closing)?,
                damping: value(&file.damping).unwrap_or(DAMPING),
                pressure: if file.is_biaxial() { self.needed("pressure", &file.pressure)? } else { 0.0 },
                reload: file.reload.as_ref().is_some_and(|reload| *reload.get_ref()),
                law: file.preset.as_ref().map(|name| self.law(name)).transpose()?,
            });
        }
        let held = file.held.as_ref().is_some_and(|held| *held.get_ref());
        Ok(Striker::Cylinder {
            radius: self.needed("radius", &file.radius)?,
            mass: if held && file.mass.is_none() { 0.0 } else { self.needed("mass", &file.mass)? },
            held,
            friction: value(&file.projectile_friction).unwrap_or(0.0),
            stiffness: self.needed("projectile-stiffness", &file.projectile_stiffness)?,
        })
    }
}
