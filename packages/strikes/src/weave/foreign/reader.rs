//! A panel from the mesh file that a scene names.

use std::fmt;

use super::checks::Checks;
use super::crimp::Paths;
use super::file::MeshFile;
use super::raw::Raw;
use super::{abaqus, ls_dyna, vtu};
use crate::weave::figures::Figures;
use crate::weave::geometry::Family;
use crate::weave::model::{Model, Yarn};
use crate::weave::panel::{MOST_ELEMENTS, Part};
use toron::host::units::UnitSystem;
use toron_materials::unit_expression::Unit;
use toron_materials::units::LENGTH;
use toron_shared::checked::value;
use toron_shared::error::Error;
use toron_shared::keyword_file::files::text;
use toron_shared::numbers::number;
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::Source;

/// Volume over area of woven fabrics in m: ten times less and more than the thinnest and the thickest ones.
const THICKNESS: [f64; 2] = [3e-6, 3e-2];

/// A panel of a mesh file, in the scene's units.
#[derive(Clone)]
pub struct Foreign {
    /// The name of the file, for messages and reports.
    pub file: String,
    pub model: Model,
    pub part: Part,
    /// The least distance between yarns: the scene's, or measured; 0 where they meet.
    pub clearance: f64,
    /// Of warp and weft: the scene's, or measured.
    pub heights: [f64; 2],
    /// Of warp and weft: the mean distance from a yarn to the next.
    pub pitch: [f64; 2],
    pub figures: Figures,
    /// What to say of yarns whose waves the mesh cuts short.
    pub crimp: Vec<String>,
    pub checks: Checks,
}

/// What tells one mesh from another, without the mesh: runs are known again by it.
impl fmt::Debug for Foreign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Foreign { model, part, clearance, heights, .. } = self;
        let mut sum = crc32fast::Hasher::new();
        let numbers = model.nodes.iter().chain(&model.fibre).flatten();
        numbers.for_each(|number| sum.update(&number.to_le_bytes()));
        model.elements.iter().flatten().for_each(|node| sum.update(&node.to_le_bytes()));
        let checksum = sum.finalize();
        f.debug_struct("Foreign")
            .field("checksum", &checksum)
            .field("part", part)
            .field("clearance", clearance)
            .field("heights", heights)
            .finish_non_exhaustive()
    }
}

impl Foreign {
    /// The least and the largest x, and the same of y.
    pub fn extent(&self) -> [[f64; 2]; 2] {
        [0, 1].map(|axis| {
            let places = self.model.nodes.iter().map(|node| node[axis]);
            places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
        })
    }

    /// What to say of a blow that is nearer to an edge of a whole mesh than to its middle; `length` is the unit.
    pub fn off_middle(&self, blow: [f64; 2], length: &str) -> Option<String> {
        let extent = self.extent();
        let middle = extent.map(|[low, high]| 0.5 * (low + high));
        let is_off = |axis: usize| (blow[axis] - middle[axis]).abs() > 0.25 * (extent[axis][1] - extent[axis][0]);
        (self.part == Part::Whole && (is_off(0) || is_off(1))).then(|| {
            let target = self.nearest_crossing(middle).unwrap_or(middle);
            let shift = [0, 1].map(|axis| number(blow[axis] - target[axis])).join(", ");
            let [x, y] = extent.map(|ends| ends.map(number).join(" to "));
            format!(
                "the blow is at ({}) {length}, nearer to an edge of the mesh than to its middle, x from {x} and y from {y}:\n\
                 add [{shift}] to mesh.shift, and it is at the crossing that is nearest to the middle",
                blow.map(number).join(", ")
            )
        })
    }

    fn nearest_crossing(&self, place: [f64; 2]) -> Option<[f64; 2]> {
        let crossings = self.model.crossings.iter().map(|crossing| crossing.place);
        let distance = |[x, y]: &[f64; 2]| (x - place[0]).hypot(y - place[1]);
        crossings.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// Names and values for the terminal; `length` is the unit.
    pub fn rows(&self, length: &str) -> Vec<(&'static str, String)> {
        let [warp, weft] = self.pitch.map(number);
        let [x, y] = self.extent().map(|ends| ends.map(number).join(" to "));
        let mut rows = vec![
            ("pitch of warp and weft", format!("{warp} {length}, {weft} {length}")),
            ("extent", format!("x from {x} {length}, y from {y} {length}")),
        ];
        if let Some([x, y]) = self.nearest_crossing([0.0; 2]) {
            rows.push(("crossing nearest to the origin", format!("({}, {}) {length}", number(x), number(y))));
        }
        rows.extend(self.checks.rows(length));
        rows
    }
}

/// The table `[mesh]`: reads its file and checks what is in it.
///
/// # Errors
/// What is wrong with the table or the file, with file, line, value and what is allowed.
pub fn foreign(source: &Source<'_>, table: &Spanned<MeshFile>, units: &UnitSystem) -> Result<Foreign, Error> {
    let keys = table.get_ref();
    let missing = "file is missing; allowed: the name of a mesh file, .inp, .k, .key or .vtu";
    let name = keys.file.as_ref().ok_or_else(|| source.error(table.span(), missing))?;
    let place = source.file("mesh.file", name)?;
    let file = place.display().to_string();
    let bytes = std::fs::read(&place).map_err(|error| source.error(name.span(), &format!("{file}: {error}")))?;
    let ending = place.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_lowercase();
    let mut raw = match ending.as_str() {
        "inp" => abaqus::read(&file, &text(&bytes))?,
        "k" | "key" | "dyn" => ls_dyna::read(&file, &text(&bytes))?,
        "vtu" => vtu::read(&file, &bytes)?,
        _ => {
            let message = format!("mesh.file is \"{}\"; allowed: .inp, .k, .key or .vtu", name.get_ref());
            return Err(source.error(name.span(), &message));
        }
    };
    let factor = keys.units.as_ref().map_or(Ok(1.0), |unit| length_unit(source, unit, units))?;
    let shift = keys.shift.as_ref().map_or([0.0; 2], |shift| shift.get_ref().0);
    place_nodes(&mut raw, factor, shift).map_err(|message| Error::Input(format!("{file}: {message}")))?;
    let part = keys.part.unwrap_or_default();
    let model = raw.model(part).map_err(|message| Error::Input(format!("{file}: {message}")))?;
    let checks = Checks::of(&model);
    checks.refuse().map_err(|message| Error::Input(format!("{file}: {message}")))?;
    let pitch = pitch(&model);
    let paths = Paths::of(&model);
    let of_paths = paths.map_or_else(|| crimp(&model), |paths| paths.meshed);
    let figures = Figures::with(&model, 0, of_paths, covered(&model, pitch));
    let thickness = figures.volume_by_area() / units.from_si(1.0, LENGTH);
    if !(THICKNESS[0]..=THICKNESS[1]).contains(&thickness) {
        let [least, most] = THICKNESS.map(|size| number(1e3 * size));
        let span = keys.units.as_ref().map_or(name.span(), Spanned::span);
        let message = format!(
            "{file} has yarns of {} mm³ on a mm²; allowed: {least} to {most}, in mesh.units = \"{}\"",
            number(1e3 * thickness),
            keys.units.as_ref().map_or(units.names()[0], |units| units.get_ref())
        );
        return Err(source.error(span, &message));
    }
    Ok(Foreign {
        part,
        clearance: value(&keys.clearance).unwrap_or(checks.clearance),
        heights: value(&keys.height).map_or(checks.heights, |height| [height; 2]),
        pitch,
        file,
        model,
        figures,
        crimp: paths.and_then(|paths| paths.warning()).into_iter().collect(),
        checks,
    })
}

/// The unit of the file's lengths in the scene's.
fn length_unit(source: &Source<'_>, name: &Spanned<String>, units: &UnitSystem) -> Result<f64, Error> {
    let unit = Unit::parse(name.get_ref()).ok().filter(|unit| unit.measures(LENGTH));
    let unit = unit.ok_or_else(|| {
        let message = format!("mesh.units is \"{}\"; allowed: a unit of length, as mm, m, um, in", name.get_ref());
        source.error(name.span(), &message)
    })?;
    Ok(unit.convert(1.0, units))
}

/// Brings the nodes into the scene's units, and then to their place.
fn place_nodes(raw: &mut Raw, factor: f64, [x, y]: [f64; 2]) -> Result<(), String> {
    if raw.elements.is_empty() {
        return Err("the file has no elements; allowed: hexahedra and wedges".to_string());
    }
    if raw.elements.len() as f64 > MOST_ELEMENTS {
        return Err(format!("the file has {} elements; allowed: up to {MOST_ELEMENTS:.0e}", raw.elements.len()));
    }
    for node in &mut raw.nodes {
        *node = [factor * node[0] + x, factor * node[1] + y, factor * node[2]];
        if node.iter().any(|x| !x.is_finite()) {
            return Err(format!("a node is at {node:?}; allowed: finite coordinates"));
        }
    }
    Ok(())
}

/// Of yarns whose elements stand in no sections: the length of the fibres over that of the panel which they cross,
/// less 1.
fn crimp(model: &Model) -> [f64; 2] {
    Family::BOTH.map(|family| {
        let yarns = model.yarns.iter().filter(|yarn| yarn.family == family);
        let (mut length, mut crossed) = (0.0, 0.0);
        for element in yarns.flat_map(|yarn| yarn.elements.clone()) {
            // A yarn's section is the same everywhere: its length is in proportion to the volume.
            let volume = toron_explicit_host::hexahedron::Edges::of(&model.corners(&model.elements[element])).volume();
            (length, crossed) = (length + volume, crossed + volume * model.fibre[element][family as usize].abs());
        }
        length / crossed - 1.0
    })
}

/// The area that the yarns of warp and weft cover, each its pitch wide.
fn covered(model: &Model, pitch: [f64; 2]) -> [f64; 2] {
    Family::BOTH.map(|family| {
        let area = |yarn: &Yarn| {
            let [low, high] = model.extent(yarn, family as usize);
            (high - low) * pitch[family as usize] * if yarn.halved { 0.5 } else { 1.0 }
        };
        model.yarns.iter().filter(|yarn| yarn.family == family).map(area).sum()
    })
}

/// The mean distance from a yarn of a family to the next; of a single one, what the others cross.
fn pitch(model: &Model) -> [f64; 2] {
    Family::BOTH.map(|family| {
        let yarns: Vec<&Yarn> = model.yarns.iter().filter(|yarn| yarn.family == family).collect();
        match &yarns[..] {
            [first, .., last] => (last.coordinate - first.coordinate) / (yarns.len() - 1) as f64,
            _ => {
                let others = model.yarns.iter().filter(|yarn| yarn.family != family);
                let extents = others.map(|yarn| model.extent(yarn, 1 - family as usize));
                let [low, high] = extents
                    .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [from, to]| [low.min(from), high.max(to)]);
                high - low
            }
        }
    })
}
