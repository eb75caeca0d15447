//! Tests in which a section slides, from their files: a biaxial test, whose sides keep a pressure, or plates without
//! sides.

use super::file::{DataFile, LoadingName};
use super::friction::Sliding;
use super::reader::{Reader, plain_name, wrong};
use super::sliding::{Line, blocks, first_beyond};
use toron::law::parameters::{NUMBER, STRESS};
use toron_shared::error::Error;
use toron_shared::spanned::Spanned;

/// The last part of I_td's rise that counts where no range is given, and the parts of that whose scatter says how sure
/// the mean is.
const LAST: f64 = 0.5;
const PARTS: usize = 5;
/// A test's columns: half the sum and half the difference of the section's principal Kirchhoff stresses, and its
/// invariants.
const BIAXIAL: [&str; 4] = ["p_t", "q", "I_tc", "I_td"];
const PLATES: [&str; 2] = ["p_t", "I_td"];

/// Whether a data set is such a test.
pub(super) fn is_sliding(file: &DataFile) -> bool {
    file.loading.as_ref().is_some_and(|l| matches!(l.get_ref(), LoadingName::Biaxial | LoadingName::Plates))
}

/// All such tests of a file.
///
/// # Errors
/// An input error that names file, line and, in the data, column.
pub(super) fn sets(reader: &Reader, files: &[Spanned<DataFile>]) -> Result<Vec<Sliding>, Error> {
    let numbered = (1..).zip(files.iter().filter(|file| is_sliding(file.get_ref())));
    let sets: Vec<Sliding> = numbered.map(|(number, file)| set(reader, number, file)).collect::<Result<_, _>>()?;
    Ok(sets)
}

fn set(reader: &Reader, number: usize, spanned: &Spanned<DataFile>) -> Result<Sliding, Error> {
    let file = spanned.get_ref();
    let is_free = file.loading.as_ref().is_some_and(|loading| *loading.get_ref() == LoadingName::Plates);
    let name = file.name.as_ref().map_or_else(|| format!("sliding-{number}"), |name| name.get_ref().clone());
    let error = |message: &str| reader.source.error(spanned.span(), &format!("data set \"{name}\": {message}"));
    if !plain_name(&name) {
        return Err(error("allowed: a name of letters, digits and - _ ."));
    }
    refuse_others(file).map_err(|message| error(&message))?;
    let table = reader.table(file)?;
    reader.require_known_columns(file, if is_free { &PLATES } else { &BIAXIAL })?;
    let pressure = reader.column(file, &table, "p_t", STRESS)?;
    let i_td = reader.column(file, &table, "I_td", NUMBER)?.values;
    let (q, i_tc) = if is_free {
        // Sides bear nothing.
        (pressure.values.clone(), vec![0.0; i_td.len()])
    } else {
        (reader.column(file, &table, "q", STRESS)?.values, reader.column(file, &table, "I_tc", NUMBER)?.values)
    };
    let line = |row: usize| Line { p_t: pressure.values[row], q: q[row], i_tc: i_tc[row], i_td: i_td[row] };
    let lines: Vec<Line> = (0..i_td.len()).map(line).collect();
    let [least, most] =
        lines.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], l| [a.min(l.i_td), b.max(l.i_td)]);
    let [from, to] = file.range.as_ref().map_or([most - LAST * (most - least), most], |range| range.get_ref().0);
    let first = first_beyond(&lines, from).filter(|_| from < to);
    let Some(first) = first else {
        return Err(error(&format!(
            "no line has an I_td from {from} to {to}; allowed: a range within {least} to {most}"
        )));
    };
    let last = first_beyond(&lines[first..], to).map_or(lines.len() - 1, |length| first + length);
    if let Some(row) = (first..=last).find(|&row| lines[row].p_t < 0.0) {
        return Err(wrong(&table, &pressure.column, row, "a value >= 0: pressure"));
    }
    let parts = blocks(&lines[first..=last], PARTS);
    if parts.len() < PARTS {
        let message =
            format!("I_td has to rise under pressure through {PARTS} parts of the range, and does in {}", parts.len());
        return Err(error(&message));
    }
    let declared = format!("{}:{}", reader.source.name, reader.source.line(spanned.span()));
    Ok(Sliding { name, declared, is_free, parts })
}

/// Keys of other loadings.
fn refuse_others(file: &DataFile) -> Result<(), String> {
    let given = [
        ("path", file.path.is_some()),
        ("abscissa", file.abscissa.is_some()),
        ("ordinate", file.ordinate.is_some()),
        ("length", file.length.is_some()),
        ("area", file.area.is_some()),
        ("zero", file.zero.is_some()),
        ("deviation", file.deviation.is_some()),
        ("weight", file.weight.is_some()),
        ("fits", file.fits.is_some()),
    ];
    match given.into_iter().find(|(_, is_given)| *is_given) {
        Some((key, _)) => Err(format!("{key} has no use with this loading; allowed: without it")),
        None => Ok(()),
    }
}
