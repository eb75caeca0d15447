//! A scene from its TOML file. The format is described in `docs/reference/fabric-files.md`.

use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;

use super::file::{PanelKeys, Rim, SceneFile, ShapeName};
use super::scene::{Case, Scene, StrikerDensity};
use crate::cases::{self, CaseTables};
use crate::scene_keys::keys::{Precision, Reader, Table, read_cases};
use crate::scene_keys::shots::read_shots;
use crate::weave::cloth::Cloth;
use crate::weave::cloth::read_cloth;
use crate::weave::file::{PlyTables, plies};
use crate::weave::layup::Ply;
use crate::weave::panel::Part;
use toron::law::parameters::DENSITY;
use toron_explicit_host::contact::{RigidSurface, Shape};
use toron_explicit_host::medium::Control;
use toron_explicit_host::mutual_contact::Parameters;
use toron_explicit_host::struck::blow::DENSITIES;
use toron_explicit_host::struck::plan::Plan;
use toron_materials::material::file::MaterialFile;
use toron_materials::material::laws::Laws;
use toron_materials::material::model::Material;
use toron_materials::units;
use toron_shared::checked::{Checked, Positive, value};
use toron_shared::error::Error;
use toron_shared::layers::entries;
use toron_shared::numbers::number;
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::{self, Numbers, Source};

/// Samples of a history where the file does not say otherwise.
const SAMPLES: f64 = 400.0;
/// Friction of the striker and of the yarns, where the file gives none: the thesis's.
const FRICTION: [f64; 2] = [0.23, 0.18];
/// Over a yarn's height: how near nodes are to faces that are looked at in every step, and how deep they may be.
const MARGIN: f64 = 0.8;
const DEEPEST: f64 = 0.5;
/// The part of the yarns' mass that torn ends may be lent, if the file gives none, and at most.
const SHRED_MASS: f64 = 0.0;
const MOST_SHRED_MASS: f64 = 1e-3;
/// A mass and a density that differ by less than this part are the same.
const SAME_MASS: f64 = 0.02;

impl Scene {
    /// Reads the file.
    ///
    /// # Errors
    /// An input error that names file, line, value and what is allowed.
    pub fn read(path: &Path) -> Result<Scene, Error> {
        Scene::read_with(Laws::Toron, path)
    }

    /// The same for a program with these laws.
    ///
    /// # Errors
    /// An input error that names file, line, value and what is allowed.
    pub fn read_with(laws: Laws, path: &Path) -> Result<Scene, Error> {
        let (name, text) = toml_file::read(path)?;
        Scene::parse_with(laws, &name, &text)
    }

    /// The scene that `text` describes; `name` stands for the file in messages.
    ///
    /// # Errors
    /// An input error that names file, line, value and what is allowed.
    pub fn parse(name: &str, text: &str) -> Result<Scene, Error> {
        Scene::parse_with(Laws::Toron, name, text)
    }

    /// The same for a program with these laws.
    ///
    /// # Errors
    /// An input error that names file, line, value and what is allowed.
    pub fn parse_with(laws: Laws, name: &str, text: &str) -> Result<Scene, Error> {
        let source = Source { name, text };
        let tables = source.tables()?;
        cases::check::<Table<PanelKeys>>(&source, tables.get_ref())?;
        let file: SceneFile = source.parse()?;
        let units = units::system(&source, &file.units)?;
        let cloth = Arc::new(read_cloth(&source, tables.get_ref(), &units, None)?);
        let beside = ["weave", "ply", "mesh"];
        let cases = read_cases((&source, laws, &units), tables.get_ref(), &beside, &["summary"], |reader, case| {
            let cloth = reader.cloth(case, &cloth)?;
            let threads = reader.threads(case, &cloth)?;
            reader.panel_case(&case.table.target, cloth, threads, case.name.clone())
        })?;
        let inner = || cases.iter().map(|case| case.zones.inner());
        let shots = file.shots.as_ref().map(|shots| read_shots(&source, shots, &units, inner())).transpose()?;
        Ok(Scene { title: file.title.unwrap_or_else(|| name.to_string()), units, cases, shots })
    }
}

/// Materials of warp and weft of each ply.
type Threads = Vec<[Option<Box<Material>>; 2]>;
type PanelCase<'t> = CaseTables<'t, Table<PanelKeys>>;

impl Reader<'_> {
    /// What a case strikes: the scene's panel, where it has nothing otherwise.
    fn cloth(&self, case: &PanelCase, of_scene: &Arc<Cloth>) -> Result<Arc<Cloth>, Error> {
        let PanelKeys { weave, ply, mesh, .. } = &case.own_table.target;
        if weave.is_none() && ply.is_none() && mesh.is_none() {
            return Ok(of_scene.clone());
        }
        let own = weave.as_ref().map(Spanned::span);
        Ok(Arc::new(read_cloth(self.source, case.data.get_ref(), self.units, own)?))
    }

    fn panel_case(&self, file: &PanelKeys, cloth: Arc<Cloth>, threads: Threads, name: String) -> Result<Case, Error> {
        let keys = self.keys;
        let plan = self.panel_plan(file, &name)?;
        let stiffness = self.needed("contact-stiffness", &keys.contact_stiffness)?;
        let [_, height] = cloth.yarn_heights();
        let pressed_at_rest = cloth.coarse_radius().is_none();
        let [friction, of_yarns] = FRICTION;
        let zones = self.zones(|| self.needed("hyperelastic-radius", &file.hyperelastic_radius))?;
        let material = |own: &Option<Box<Material>>| own.as_deref().unwrap_or(zones.inner()).name();
        let materials: Vec<[String; 2]> = threads.iter().map(|ply| ply.each_ref().map(material)).collect();
        let strength = self.panel_strength(&cloth, &materials)?;
        let (mass, striker_density) = self.mass_and_density(file)?;
        Ok(Case {
            striker: RigidSurface {
                shape: shape(file),
                radius: self.needed("radius", &keys.radius)?,
                stiffness,
                friction: value(&keys.friction).unwrap_or(friction),
                aim: self.aim(file, &cloth)?,
            },
            cloth,
            speed: self.speed(zones.inner())?,
            zones,
            threads,
            strength,
            mass,
            striker_density,
            held: file.rim != Some(Rim::Free),
            mutual: Parameters {
                stiffness,
                friction: value(&file.yarn_friction).unwrap_or(of_yarns),
                margin: MARGIN * height,
                deepest: DEEPEST * height,
                // The chords of a coarse mesh go into each other where the yarns that they stand for touch.
                pressed_at_rest,
            },
            control: Control { by_direction: true, ..self.control() },
            shred_mass: self.shred_mass(file)?,
            plan,
            single_precision: keys.precision != Some(Precision::F64),
            name,
        })
    }

    fn shred_mass(&self, file: &PanelKeys) -> Result<f64, Error> {
        let Some(given) = &file.shred_mass else { return Ok(SHRED_MASS) };
        let part = given.value();
        if part <= MOST_SHRED_MASS {
            return Ok(part);
        }
        let message = format!("shred-mass is {part}; allowed: 0 to {MOST_SHRED_MASS}, a part of the yarns' mass");
        Err(self.source.error(given.span(), &message))
    }

    fn panel_plan(&self, file: &PanelKeys, name: &str) -> Result<Plan, Error> {
        let plan = self.plan(name, SAMPLES)?;
        match &file.residual {
            Some(residual) if *residual.get_ref() && !plan.decides => {
                let message = "residual is true; allowed: with until = \"decided\"; other runs go on to the end anyway";
                Err(self.source.error(residual.span(), message))
            }
            residual => Ok(Plan { settles: residual.as_ref().is_some_and(|residual| *residual.get_ref()), ..plan }),
        }
    }

    /// Where the panel is struck; a part of one is struck where its planes of symmetry meet.
    fn aim(&self, file: &PanelKeys, cloth: &Cloth) -> Result<[f64; 2], Error> {
        let Some(aim) = &file.aim else { return Ok([0.0; 2]) };
        let Numbers([x, y]) = *aim.get_ref();
        let allowed = match cloth.part() {
            Part::Quarter => "with part = \"whole\"".to_string(),
            Part::Whole => match cloth.covers([x, y]) {
                Ok(()) => return Ok([x, y]),
                Err(allowed) => allowed,
            },
        };
        Err(self.source.error(aim.span(), &format!("aim is [{x}, {y}]; allowed: {allowed}")))
    }

    /// What the yarns of each ply are made of, warp and weft, where the tables say it; a mesh is one ply.
    fn threads(&self, case: &PanelCase, cloth: &Cloth) -> Result<Threads, Error> {
        let data = case.data.get_ref();
        let Some(weave) = data.get("weave") else { return Ok(vec![[None, None]]) };
        let of_ply = |(tables, laid): (PlyTables, &Ply)| {
            let [warp, weft] = tables.materials.map(|file| self.thread_material(file));
            let [warp, weft] = [warp?, weft?];
            Ok(if laid.woven.exchanged { [weft, warp] } else { [warp, weft] })
        };
        plies(self.source, weave, entries(data.get("ply")))?.into_iter().zip(cloth.plies()).map(of_ply).collect()
    }

    /// What the yarns of a family are made of, if a table says it: a material of the case's law.
    fn thread_material(&self, file: Option<Spanned<MaterialFile>>) -> Result<Option<Box<Material>>, Error> {
        let Some(file) = file else { return Ok(None) };
        let Some(law) = self.keys.law().table() else {
            let message = "material of a family of yarns, or of a ply, with law = \"hybrid\"; allowed: hyperelastic, linear-elastic, \
                           frictional";
            return Err(self.source.error(file.span(), message));
        };
        self.material(law, &Some(file)).map(|material| Some(Box::new(material)))
    }

    /// The mass of what strikes, and its density: from the file's mass, which must be one that its volume can have, or
    /// from the file's density.
    fn mass_and_density(&self, file: &PanelKeys) -> Result<(f64, StrikerDensity), Error> {
        let keys = self.keys;
        let volume = self.volume(file)?;
        let in_si = |density: f64| density / self.units.from_si(1.0, DENSITY);
        let Some(given) = &file.striker_density else {
            let mass = self.needed("mass", &keys.mass)?;
            let density = volume.map(|volume| in_si(mass / volume));
            if let (Some(given), Some(volume), Some(density)) = (&keys.mass, volume, density) {
                self.check_density(file, density, volume, given)?;
            }
            return Ok((mass, StrikerDensity { density, is_told: false }));
        };
        let density = given.value();
        if !DENSITIES.contains(&in_si(density)) {
            let [least, most] =
                [DENSITIES.start(), DENSITIES.end()].map(|density| number(density * self.units.from_si(1.0, DENSITY)));
            let message = format!("striker-density is {density}; allowed: what solids have, {least} to {most}");
            return Err(self.source.error(given.span(), &message));
        }
        let told = StrikerDensity { density: Some(in_si(density)), is_told: true };
        let of_volume = volume.map(|volume| density * volume);
        match (&keys.mass, of_volume) {
            (None, Some(mass)) => Ok((mass, told)),
            (None, None) => {
                let wanted = "mass is missing; allowed: a finite number > 0, or length beside striker-density";
                Err(self.source.error(self.span.clone(), wanted))
            }
            (Some(mass), None) => Ok((mass.value(), told)),
            (Some(place), Some(of_volume)) => {
                let mass = place.value();
                if (mass - of_volume).abs() <= SAME_MASS * of_volume {
                    return Ok((mass, told));
                }
                let message = format!(
                    "mass is {mass}, and striker-density {} with the sizes of the {} makes {}; allowed: one of the two, or both the same",
                    given.value(),
                    shape(file).name(),
                    number(of_volume)
                );
                Err(self.source.error(place.span(), &message))
            }
        }
    }

    /// That a density in kg/m³, of this volume, is one that solids have.
    fn check_density(
        &self,
        file: &PanelKeys,
        density: f64,
        volume: f64,
        given: &Spanned<Positive>,
    ) -> Result<(), Error> {
        if DENSITIES.contains(&density) {
            return Ok(());
        }
        let (radius, name, units) =
            (number(value(&self.keys.radius).unwrap_or(0.0)), shape(file).name(), self.units.names().join("-"));
        let [least, most] = [DENSITIES.start(), DENSITIES.end()]
            .map(|density| number(density * volume * self.units.from_si(1.0, DENSITY)));
        let message = format!(
            "mass is {}, of a {name} with radius {radius}: {} kg/m³; allowed: {least} to {most}, of {} to {} kg/m³;\n\
             mass or a length is most likely not in the units of the file, {units}",
            given.value(),
            number(density),
            DENSITIES.start(),
            DENSITIES.end(),
        );
        Err(self.source.error(given.span(), &message))
    }

    /// The volume of what strikes; none of a cylinder whose length is not given.
    fn volume(&self, file: &PanelKeys) -> Result<Option<f64>, Error> {
        let radius = self.needed("radius", &self.keys.radius)?;
        let (section, half_sphere) = (PI * radius * radius, 2.0 / 3.0 * PI * radius.powi(3));
        Ok(match (file.shape(), value(&file.length)) {
            (ShapeName::Sphere, _) => Some(2.0 * half_sphere),
            (ShapeName::Flat, length) => length.map(|length| section * length),
            (ShapeName::Hemisphere, Some(length)) if length < radius => {
                let span = file.length.as_ref().map_or(self.span.clone(), Spanned::span);
                let message = format!("length is {length}; allowed: the radius of its end, {radius}, or more");
                return Err(self.source.error(span, &message));
            }
            (ShapeName::Hemisphere, length) => length.map(|length| half_sphere + section * (length - radius)),
        })
    }
}

fn shape(file: &PanelKeys) -> Shape {
    match file.shape() {
        ShapeName::Sphere => Shape::Sphere,
        ShapeName::Flat => Shape::Flat,
        ShapeName::Hemisphere => Shape::Hemisphere,
    }
}
