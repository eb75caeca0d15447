//! LS-DYNA: `*MAT_USER_DEFINED_MATERIAL_MODELS`, eight fields of ten columns a line.
//!
//! Free format and long fields would not say more: a field between commas may not be longer than its columns, and long
//! lines are not readable. A number keeps nine characters and a blank before it; what that rounds is named in a
//! comment.

use nalgebra::{Matrix3, Vector3};

use super::material::Material;
use toron_shared::error::Error;
use toron_shared::short_number::{EXACT, deviation, short};

/// The numbers of materials whose routines have the argument list that the shims know.
pub const NUMBERS: [u32; 8] = [41, 43, 44, 45, 47, 48, 49, 50];

const FIELDS: usize = 8;
const COLUMNS: usize = 10;

/// The fibre direction: one for the material, in global axes, or that of the material axes, by AOPT = 2 or as the
/// elements have them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fibre {
    Global,
    Axes,
    Elements,
}

/// # Errors
/// The material has no density.
pub fn card(material: &Material, id: u32, number: Option<u32>, fibre: Fibre) -> Result<String, Error> {
    let (interface, table, density) = (material.interface(), material.table(), material.density()?);
    let mut values = material.values.clone();
    if fibre != Fibre::Global {
        along_the_axes(material, &mut values);
    }
    let count = values.len();
    let constants: Vec<f64> = values.into_iter().chain(material.bulk_and_shear()).collect();
    let names: Vec<&str> = table.iter().map(|property| property.name).chain(["bulk", "shear"]).collect();
    let history = material.law.description().history();
    let [ortho, hyper] = if fibre == Fibre::Global { ["0", "1"] } else { ["1", "-1"] };

    let mut card = format!("*MAT_USER_DEFINED_MATERIAL_MODELS_TITLE\n{}\n", material.name);
    for comment in material.comments() {
        card += &format!("$ {comment}\n");
    }
    card += "$ bulk and shear set time step and contact stiffness: bulk + 4/3 shear is that of the wave along the fibre, or of a faster one at rest\n";
    card += "$ ihyper = 1 goes with iortho = 0, -1 with 1: F and stress are global. 1 with 1 gives wrong stress without a message\n";
    let rounded: Vec<&str> = [("ro", density)]
        .into_iter()
        .chain(names.iter().copied().zip(constants.iter().copied()))
        .filter(|&(_, value)| deviation(&short(value, COLUMNS - 1), value) > EXACT)
        .map(|(name, _)| name)
        .collect();
    if !rounded.is_empty() {
        card += &format!("$ rounded to the columns of a field: {}\n", rounded.join(", "));
    }
    let [id, mt] = [id, number.unwrap_or(interface.ls_dyna)].map(|number| number.to_string());
    let [lmc, bulk, shear, nhv] = [count + 2, count + 1, count + 2, history].map(|number| number.to_string());
    let numbers = [&id, &number_of(density), &mt, &lmc, &nhv, ortho, &bulk, &shear].map(str::to_string);
    card += &lines("mid ro mt lmc nhv iortho ibulk ig", &numbers);
    // Without itherm LS-DYNA does not tell the temperature.
    let thermal = if material.law.description().reads.temperature { "1" } else { "0" };
    card += &lines("ivect ifail itherm ihyper ieos lmca", &["0", "1", thermal, hyper, "0", "0"].map(String::from));
    match fibre {
        Fibre::Global => {}
        Fibre::Axes => card += &axes(material),
        Fibre::Elements => card += &axes_of_elements(),
    }
    for (names, constants) in names.chunks(FIELDS).zip(constants.chunks(FIELDS)) {
        let numbers: Vec<String> = constants.iter().map(|&value| number_of(value)).collect();
        card += &lines(&names.join(" "), &numbers);
    }
    Ok(card)
}

/// The directions of a law, in the material axes: those of the fibre and of a second direction, if the law has one that
/// is not along it.
fn along_the_axes(material: &Material, values: &mut [f64]) {
    let (a, d) = plane_of_the_axes(material);
    let e1 = a.normalize();
    let e3 = e1.cross(&d).normalize();
    let axes = Matrix3::from_columns(&[e1, e3.cross(&e1), e3]);
    for (i, direction) in material.law.description().directions.iter().enumerate() {
        let vector = Vector3::from(direction.of(&material.values));
        let local = match i {
            0 => Vector3::x(),
            _ if vector == Vector3::zeros() => vector,
            // The linear elastic law's second axis is made orthogonal to the fibre.
            1 if direction.may_be_zero => Vector3::y(),
            _ => axes.tr_mul(&vector),
        };
        values[direction.first..][..3].copy_from_slice(local.as_slice());
    }
}

/// The fibre, and a vector that with it spans the plane of the first two axes: the law's second direction, or another
/// one.
fn plane_of_the_axes(material: &Material) -> (Vector3<f64>, Vector3<f64>) {
    let directions = material.law.description().directions.iter().map(|direction| direction.of(&material.values));
    let mut vectors = directions.map(Vector3::from);
    let a = vectors.next().unwrap_or_else(Vector3::x);
    let apart = |d: &Vector3<f64>| a.cross(d).norm() > 1e-6 * a.norm() * d.norm();
    // Any vector across will do: z, or x for a fibre along z.
    let across = if a.x == 0.0 && a.y == 0.0 { Vector3::x() } else { Vector3::z() };
    (a, vectors.find(apart).unwrap_or(across))
}

/// AOPT = 2: a is the fibre, and d with it spans the plane of the first two axes.
fn axes(material: &Material) -> String {
    let (a, d) = plane_of_the_axes(material);
    let vector = |v: Vector3<f64>| v.iter().map(|&x| number_of(x)).collect::<Vec<_>>();
    let zero = || vec!["0.0".to_string(); 3];
    let first = [vec!["2.0".to_string(), "1".to_string()], zero(), vector(a)].concat();
    let second = [zero(), vector(d), vec!["0.0".to_string(), "0".to_string()]].concat();
    lines(AXES[0], &first) + &lines(AXES[1], &second)
}

/// AOPT = 0: the axes of *ELEMENT_SOLID_ORTHO.
fn axes_of_elements() -> String {
    let zeros = |count| vec!["0.0".to_string(); count];
    let first = [vec!["0.0".to_string(), "1".to_string()], zeros(6)].concat();
    let second = [zeros(7), vec!["0".to_string()]].concat();
    lines(AXES[0], &first) + &lines(AXES[1], &second)
}

/// The names of the fields of the axes.
const AXES: [&str; 2] = ["aopt macf xp yp zp a1 a2 a3", "v1 v2 v3 d1 d2 d3 beta ievts"];

/// A comment with the names of the fields, and their line.
pub fn lines(names: &str, fields: &[String]) -> String {
    // A name as wide as the field would run into the one before.
    let names: String =
        names.split(' ').map(|name| format!("{:>COLUMNS$}", &name[..name.len().min(COLUMNS - 1)])).collect();
    let fields: String = fields.iter().map(|field| format!("{field:>COLUMNS$}")).collect();
    format!("$#{}\n{fields}\n", &names[2..])
}

/// A number with a blank before it.
pub fn number_of(value: f64) -> String {
    short(value, COLUMNS - 1)
}
