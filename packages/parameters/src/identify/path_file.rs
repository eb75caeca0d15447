//! Data along a load path: which column of the data drives which component of the path's last step, and what the law
//! predicts.

use super::data::{DataSet, Loading};
use super::file::DataFile;
use super::path_response::PathResponse;
use super::reader::{Reader, wrong};
use super::response::{Measured, Quantity};
use toron::law::parameters::{Dimension, NUMBER, STRESS};
use toron_materials::data_table::DataTable;
use toron_materials::load_path::element::Hexahedron;
use toron_materials::load_path::newton::{COMPONENT_NAMES, COMPONENTS};
use toron_materials::load_path::path::{LoadPath, Target};
use toron_materials::material::laws::Laws;
use toron_materials::material::model::Law;
use toron_materials::units::{ENERGY, FORCE, LENGTH};
use toron_shared::error::Error;
use toron_shared::spanned::Spanned;

/// Data at the very ends of a step may be off by this, as a part of it.
const ROUNDING: f64 = 1e-9;
const AXES: [&str; 3] = ["x", "y", "z"];

/// A column that drives the path: a component of F, or the displacement that belongs to one.
struct Driver {
    dimension: Dimension,
    component: usize,
    /// F = rest + factor × value.
    rest: f64,
    factor: f64,
}

/// The data set of a table along the path of a file.
pub(super) fn set(
    reader: &Reader,
    path: &Spanned<String>,
    file: &DataFile,
    table: &DataTable,
) -> Result<DataSet, Error> {
    let source = reader.source;
    let name = source.file("path", path)?;
    let text = std::fs::read_to_string(&name)
        .map_err(|error| source.error(path.span(), &format!("path {}: {error}", name.display())))?;
    let load_path = LoadPath::parse(Laws::Toron, &name.display().to_string(), &text)?;
    let refuse = |message: &str| Err(source.error(path.span(), &format!("path {}: {message}", name.display())));
    if load_path.points.len() > 1 {
        return refuse("it has several points; allowed: one material");
    }
    if load_path.units != *reader.units {
        return refuse("it is in other units; allowed: those of the fit");
    }
    if !matches!(load_path.points[0].material.law, Law::Hyperelastic { .. }) {
        return refuse("its material is linear elastic; allowed: the hyperelastic law");
    }
    if load_path.steps.iter().any(|step| step.rotation.is_some()) {
        return refuse("it has a rotation; allowed: none, since forces are those before it");
    }
    let driver = driver(reader, file, &load_path.element)?;
    let (measured, dimension) = measured(reader, file, &load_path.element)?;
    let [Some(abscissa), Some(ordinate)] = [&file.abscissa, &file.ordinate].map(|name| name.as_ref().map(plain)) else {
        return refuse("data along a path need abscissa and ordinate");
    };
    reader.require_known_columns(file, &[abscissa, ordinate])?;
    reader.given("length", &file.length, false, file)?;
    reader.given("area", &file.area, false, file)?;
    let x = reader.abscissae(file, table, abscissa, driver.dimension)?;
    let y = reader.column(file, table, ordinate, dimension)?;
    let rows = reader.rows(file, table, &x.values)?;
    let Some([start, end]) = ramp(&load_path, driver.component) else {
        let message = format!(
            "F{} is not driven in its last step from a known value; allowed: F = {{ {0} = value }}, and no P there before",
            COMPONENT_NAMES[driver.component]
        );
        return refuse(&message);
    };
    let mut fractions = Vec::new();
    for &row in &rows {
        let fraction = (driver.rest + driver.factor * x.values[row] - start) / (end - start);
        if !(-ROUNDING..=1.0 + ROUNDING).contains(&fraction) {
            let component = COMPONENT_NAMES[driver.component];
            let allowed =
                format!("what lies in the last step of {}, F{component} from {start} to {end}", name.display());
            return Err(wrong(table, &x.column, row, &allowed));
        }
        fractions.push(fraction.clamp(0.0, 1.0));
    }
    let deviations = reader.deviations(file, table, &rows, dimension)?;
    let rest = (start - driver.rest) / driver.factor;
    let loading = Loading::Path(Box::new(PathResponse::new(load_path, fractions, measured)));
    let names = [(written(&file.abscissa), driver.dimension), (written(&file.ordinate), dimension)];
    let set = reader.assemble(loading, names, rest, [&x, &y], &rows, deviations);
    require_the_law_s_sign(reader, file, &set)?;
    reader.check(&set, table, &y.column, &rows)?;
    Ok(set)
}

/// The name as the file has it, with its sign.
fn written(name: &Option<Spanned<String>>) -> &str {
    name.as_ref().map_or("", |name| name.get_ref())
}

/// Data that count the other way than the law's answer would be fitted by nothing at all.
fn require_the_law_s_sign(reader: &Reader, file: &DataFile, set: &DataSet) -> Result<(), Error> {
    let Loading::Path(path) = &set.loading else { return Ok(()) };
    let refused = |reason: String| Error::Evaluation(format!("{}: along its path {reason}", file.file.get_ref()));
    let responses = set.loading.responses(&path.trial()).map_err(refused)?;
    let product: f64 = responses.iter().zip(&set.ordinate.values).map(|(response, y)| response.value * y).sum();
    if product >= 0.0 {
        return Ok(());
    }
    let name = written(&file.ordinate);
    let other = name.strip_prefix('-').map_or_else(|| format!("-{name}"), str::to_string);
    let message = format!(
        "the data have the other sign than the law's {name}; allowed: ordinate = \"{other}\", if they count that way"
    );
    Err(reader.source.error(file.ordinate.as_ref().map_or(0..0, Spanned::span), &message))
}

/// The name without its sign.
fn plain(name: &Spanned<String>) -> &str {
    name.get_ref().trim_start_matches('-')
}

/// −1 for a name that begins with a minus.
fn sign(name: &Spanned<String>) -> f64 {
    if name.get_ref().starts_with('-') { -1.0 } else { 1.0 }
}

fn driver(reader: &Reader, file: &DataFile, element: &Hexahedron) -> Result<Driver, Error> {
    let missing = || {
        reader.source.error(file.file.span(), "data along a path need an abscissa; allowed: F33, -displacement_z, …")
    };
    let name = file.abscissa.as_ref().ok_or_else(missing)?;
    let component =
        plain(name).strip_prefix('F').and_then(|name| COMPONENT_NAMES.iter().position(|known| *known == name));
    if let Some(component) = component {
        return Ok(Driver { dimension: NUMBER, component, rest: 0.0, factor: sign(name) });
    }
    let axis = plain(name).strip_prefix("displacement_").and_then(|name| AXES.iter().position(|known| *known == name));
    let Some(axis) = axis else {
        let message = format!(
            "abscissa is \"{}\"; allowed along a path: F11 to F33, displacement_x, _y or _z, with a minus in front where the \
             data count the other way",
            name.get_ref()
        );
        return Err(reader.source.error(name.span(), &message));
    };
    // Of the face towards +x, +y or +z, the opposite one at rest: F − 1 over the edge.
    Ok(Driver { dimension: LENGTH, component: 4 * axis, rest: 1.0, factor: sign(name) / element.size[axis] })
}

fn measured(reader: &Reader, file: &DataFile, element: &Hexahedron) -> Result<(Measured, Dimension), Error> {
    let missing =
        || reader.source.error(file.file.span(), "data along a path need an ordinate; allowed: -force_z_z, P33, …");
    let name = file.ordinate.as_ref().ok_or_else(missing)?;
    let plain = plain(name);
    if plain == "stored_energy" {
        return Ok((Measured { quantity: Quantity::Energy, factor: sign(name) * element.volume() }, ENERGY));
    }
    let component = plain.strip_prefix('P').and_then(|name| COMPONENT_NAMES.iter().position(|known| *known == name));
    if let Some(component) = component {
        let (row, column) = COMPONENTS[component];
        return Ok((Measured { quantity: Quantity::Nominal(row, column), factor: sign(name) }, STRESS));
    }
    let axis = |name: &str| AXES.iter().position(|known| *known == name);
    let force = plain.strip_prefix("force_").and_then(|name| name.split_once('_'));
    let Some((Some(face), Some(direction))) = force.map(|(face, direction)| (axis(face), axis(direction))) else {
        let message = format!(
            "ordinate is \"{}\"; allowed along a path: force_x_x to force_z_z, P11 to P33, stored_energy, with a minus in front \
             where the data count the other way",
            name.get_ref()
        );
        return Err(reader.source.error(name.span(), &message));
    };
    let factor = sign(name) * element.areas()[face];
    Ok((Measured { quantity: Quantity::Nominal(direction, face), factor }, FORCE))
}

/// The component of F at both ends of the last step; `None` unless it is driven there, and known before.
fn ramp(path: &LoadPath, component: usize) -> Option<[f64; 2]> {
    let (row, column) = COMPONENTS[component];
    let mut value = Some(if row == column { 1.0 } else { 0.0 });
    let (last, before) = path.steps.split_last()?;
    for step in before {
        match step.targets[component] {
            Some(Target::Gradient(end)) => value = Some(end),
            Some(Target::Stress(_)) => value = None,
            Some(Target::Hold) | None => {}
        }
    }
    match (value, last.targets[component]) {
        (Some(start), Some(Target::Gradient(end))) if start != end => Some([start, end]),
        _ => None,
    }
}
