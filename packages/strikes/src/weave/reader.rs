//! A weave and its panel from a TOML file. `docs/reference/fabric-files.md` has the keys.

use std::ops::Range;
use std::path::Path;

use super::cloth::Cloth;
use super::coarse::{Coarse, ROWS as COARSE_ROWS};
use super::file::{PanelFile, PatternFile, PlyTables, SceneFile, ShapeName, ThreadFile, WeaveFile};
use super::geometry::{Family, Geometry, Weave};
use super::layup::{Laid, Layup};
use super::model::Model;
use super::panel::{MOST_ELEMENTS, Outline, Panel, Part, Place, Turn};
use super::pattern::Pattern;
use super::preset::{ALONG, CLEARANCE, COLUMNS, PRESETS, Preset, ROWS};
use super::section::{Section, Thread};
use crate::weave::cloth::read_cloth;
use toron::host::units::UnitSystem;
use toron_materials::material::file::read_material;
use toron_materials::material::laws::Laws;
use toron_materials::material::model::Material;
use toron_materials::units::{self, LENGTH};
use toron_shared::checked::{Checked, Positive, value};
use toron_shared::error::Error;
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::{self, Source};

/// A panel whose weave is solved, ready to be meshed.
#[derive(Clone, Debug)]
pub struct Woven {
    pub geometry: Geometry,
    pub panel: Panel,
    pub places: Vec<Place>,
    /// Turned by a right angle by exchanging warp and weft, as in a quarter.
    pub exchanged: bool,
}

impl Woven {
    pub fn model(&self) -> Model {
        Model::of(&self.geometry, &self.panel, &self.places)
    }

    pub fn elements(&self) -> usize {
        let weave = &self.geometry.weave;
        let of_yarn =
            |place: &Place| -> usize { self.panel.spans(weave, place).iter().map(|span| span.elements(place)).sum() };
        self.places.iter().map(of_yarn).sum()
    }
}

/// What a scene of a weave alone is.
#[derive(Clone, Debug)]
pub struct Scene {
    pub title: String,
    pub units: UnitSystem,
    pub cloth: Cloth,
    /// Whether it is the scene of a strike.
    pub is_struck: bool,
    /// Of the yarns of warp and weft of each ply; empty where the scene names none.
    pub materials: Vec<[Material; 2]>,
}

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
        let file: SceneFile = source.parse()?;
        let units = units::system(&source, &file.units)?;
        let material = file.material.as_ref();
        let material = material
            .map(|table| read_material(&source, Laws::Toron, table.get_ref(), &units, table.span()))
            .transpose()?;
        let cloth = read_cloth(&source, source.tables()?.get_ref(), &units, None)?;
        let of_all = |material: Material| vec![[material.clone(), material]; cloth.pitches().len()];
        let materials = material.map_or(Vec::new(), of_all);
        Ok(Scene {
            title: file.title.unwrap_or_else(|| name.to_string()),
            is_struck: file.scene.is_some(),
            cloth,
            materials,
            units,
        })
    }
}

/// The plies of these tables. `case` is the place of the weave that a case has otherwise: what does not go together is
/// then its mistake.
pub fn layup(
    source: &Source<'_>,
    plies: &[PlyTables],
    units: &UnitSystem,
    case: Option<Range<usize>>,
) -> Result<Layup, Error> {
    if let Some(distance) = plies[0].own.as_ref().and_then(|ply| ply.get_ref().distance.as_ref()) {
        let message = "distance of the first [[ply]]; allowed: in those below it";
        return Err(source.error(distance.span(), message));
    }
    let laid = plies.iter().map(|ply| laid(source, ply, units, case.clone())).collect::<Result<Vec<Laid>, Error>>()?;
    let elements: usize = laid.iter().map(|laid| laid.woven.elements()).sum();
    if let Some(first) = plies[0].own.as_ref().filter(|_| elements as f64 > MOST_ELEMENTS) {
        let message = format!("the plies have {elements} elements; allowed: up to {MOST_ELEMENTS:.0e}");
        return Err(source.error(first.span(), &message));
    }
    Ok(Layup::new(laid))
}

fn laid(source: &Source<'_>, ply: &PlyTables, units: &UnitSystem, case: Option<Range<usize>>) -> Result<Laid, Error> {
    let own = ply.own.as_ref().map(Spanned::get_ref);
    let otherwise = own.and_then(|own| own.weave.as_ref()).map(Spanned::span).or(case);
    let blamed = |place: Range<usize>| match &otherwise {
        Some(otherwise) if !otherwise.contains(&place.start) => otherwise.clone(),
        _ => place,
    };
    let angle = own.and_then(|own| own.angle.as_ref());
    let woven = woven(source, &ply.weave, angle, units, blamed)?;
    let distance = own.map_or(0.0, |own| value(&own.distance).unwrap_or(woven.geometry.weave.clearance));
    Ok(Laid { woven, angle: angle.map_or(0.0, |angle| *angle.get_ref()), distance })
}

/// A ply. `blamed` is the place that errors name for a key at some place which does not go together with others.
fn woven(
    source: &Source<'_>,
    table: &Spanned<WeaveFile>,
    angle: Option<&Spanned<f64>>,
    units: &UnitSystem,
    blamed: impl Fn(Range<usize>) -> Range<usize>,
) -> Result<Woven, Error> {
    let file = table.get_ref();
    let base = file.preset.as_ref().map(|name| weave_preset(source, name, units)).transpose()?;
    let warp =
        thread(source, Family::Warp, file.warp.as_ref(), base.as_ref().map(|base| &base.threads[0]), table.span())?;
    let of_weft = base.as_ref().map_or(&warp, |base| &base.threads[1]);
    let weft = thread(source, Family::Weft, file.weft.as_ref(), Some(of_weft), table.span())?;
    let mut weave = Weave {
        pattern: pattern(source, file, base, table.span())?,
        threads: [warp, weft],
        along: value(&file.along).unwrap_or(ALONG),
        columns: value(&file.columns).unwrap_or(COLUMNS),
        rows: value(&file.rows).unwrap_or(ROWS),
        clearance: value(&file.clearance).unwrap_or(units.from_si(CLEARANCE, LENGTH)),
    };
    if let Some(along) = file.along.as_ref().filter(|_| !weave.along.is_multiple_of(2)) {
        return Err(source.error(along.span(), &format!("along is {}; allowed: an even number", weave.along)));
    }
    for (family, given) in Family::BOTH.into_iter().zip([&file.warp, &file.weft]) {
        let given =
            given.as_ref().map(Spanned::get_ref).and_then(|given| given.width.as_ref().or(given.height.as_ref()));
        let place = blamed(given.map_or(table.span(), Spanned::span));
        weave.check_thread(family).map_err(|message| source.error(place, &message))?;
    }
    let wanted = "panel is missing; allowed: a table with shape and radius or half";
    let of_panel = file.panel.as_ref().ok_or_else(|| source.error(table.span(), wanted))?;
    let mut panel = panel(source, of_panel)?;
    let part = of_panel.get_ref().part.as_ref().map_or(of_panel.span(), Spanned::span);
    panel.check_mirror_planes(&weave).map_err(|message| source.error(blamed(part), &message))?;
    let exchanged = match angle {
        Some(angle) => turn(source, &mut panel, angle)?,
        None => false,
    };
    if exchanged {
        weave = weave.exchanged();
    }
    let places = panel.places(&weave).map_err(|message| source.error(blamed(of_panel.span()), &message))?;
    if let Some(radius) = &of_panel.get_ref().coarse_radius {
        panel.check_coarse_radius(&weave, &places).map_err(|message| source.error(blamed(radius.span()), &message))?;
    }
    let geometry = weave.solve().map_err(|message| source.error(table.span(), &message))?;
    Ok(Woven { geometry, panel, places, exchanged })
}

/// Turns a ply; true where its warp and weft are to be exchanged for it.
fn turn(source: &Source<'_>, panel: &mut Panel, angle: &Spanned<f64>) -> Result<bool, Error> {
    let degrees = source.finite("angle", *angle.get_ref(), angle.span())?;
    if panel.part == Part::Whole {
        panel.turn = Turn::degrees(degrees);
        return Ok(false);
    }
    if degrees.rem_euclid(90.0) != 0.0 {
        let message = format!("angle is {degrees} in a quarter; allowed: multiples of 90, or part = \"whole\"");
        return Err(source.error(angle.span(), &message));
    }
    Ok(degrees.rem_euclid(180.0) != 0.0)
}

fn weave_preset(source: &Source<'_>, name: &Spanned<String>, units: &UnitSystem) -> Result<Weave, Error> {
    let preset = Preset::find(name.get_ref()).ok_or_else(|| {
        let known = PRESETS.each_ref().map(|preset| preset.name).join(", ");
        source.error(name.span(), &format!("preset \"{}\"; allowed: {known}", name.get_ref()))
    })?;
    Ok(preset.weave(units))
}

fn pattern(source: &Source<'_>, file: &WeaveFile, base: Option<Weave>, span: Range<usize>) -> Result<Pattern, Error> {
    let allowed = "allowed: plain, or rows of o (over) and u (under), one a warp yarn";
    let Some(pattern) = &file.pattern else {
        let missing = || source.error(span, &format!("pattern is missing; {allowed}, or a preset"));
        return base.map(|base| base.pattern).ok_or_else(missing);
    };
    match pattern.get_ref() {
        PatternFile::Name(name) if name == "plain" => Ok(Pattern::plain()),
        PatternFile::Name(name) => Err(source.error(pattern.span(), &format!("pattern is \"{name}\"; {allowed}"))),
        PatternFile::Rows(rows) => Pattern::parse(rows).map_err(|message| source.error(pattern.span(), &message)),
    }
}

/// The keys of a family; those left out are the preset's, or the warp's.
fn thread(
    source: &Source<'_>,
    family: Family,
    table: Option<&Spanned<ThreadFile>>,
    base: Option<&Thread>,
    span: Range<usize>,
) -> Result<Thread, Error> {
    let none = ThreadFile::default();
    let file = table.map_or(&none, Spanned::get_ref);
    let span = table.map_or(span, Spanned::span);
    let length = |key: &str, given: Option<f64>, of_base: Option<f64>| {
        let (family, allowed) = (family.name(), Positive::allowed());
        let message = format!("{family}.{key} is missing; allowed: {allowed}, or a preset of the weave");
        given.or(of_base).ok_or_else(|| source.error(span.clone(), &message))
    };
    Ok(Thread {
        pitch: length("pitch", value(&file.pitch), base.map(|base| base.pitch))?,
        section: file.section.or(base.map(|base| base.section)).unwrap_or(Section::Ellipse),
        width: length("width", value(&file.width), base.map(|base| base.width))?,
        height: length("height", value(&file.height), base.map(|base| base.height))?,
    })
}

fn panel(source: &Source<'_>, table: &Spanned<PanelFile>) -> Result<Panel, Error> {
    let file = table.get_ref();
    let missing =
        |key: &str, allowed: &str| source.error(table.span(), &format!("panel.{key} is missing; allowed: {allowed}"));
    let shape = file.shape.ok_or_else(|| missing("shape", "circle, rectangle"))?;
    let foreign = match shape {
        ShapeName::Circle => file.half.as_ref().map(|half| (half.span(), "half, of a rectangle; allowed: radius")),
        ShapeName::Rectangle => {
            file.radius.as_ref().map(|radius| (radius.span(), "radius, of a circle; allowed: half"))
        }
    };
    if let Some((span, message)) = foreign {
        return Err(source.error(span, &format!("panel has {message}")));
    }
    let outline = match shape {
        ShapeName::Circle => {
            Outline::Circle(value(&file.radius).ok_or_else(|| missing("radius", &Positive::allowed()))?)
        }
        ShapeName::Rectangle => {
            let half = file.half.as_ref().ok_or_else(|| missing("half", "half sizes along x and y, each > 0"))?;
            Outline::Rectangle(half.get_ref().0.map(|half| half.value()))
        }
    };
    let part = file.part.as_ref().map_or(Part::Whole, |part| *part.get_ref());
    let coarse = match (&file.coarse_radius, &file.coarse_rows) {
        (Some(radius), rows) => Some(Coarse { radius: radius.value(), rows: value(rows).unwrap_or(COARSE_ROWS) }),
        (None, Some(rows)) => {
            return Err(source.error(rows.span(), "coarse-rows without coarse-radius; allowed: beside it"));
        }
        (None, None) => None,
    };
    Ok(Panel { outline, part, centre: file.centre.unwrap_or_default(), turn: Turn::NONE, coarse })
}
