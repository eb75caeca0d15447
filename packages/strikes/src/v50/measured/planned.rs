//! An experiment that goes on: which shots of a table have been fired at which asked speeds, and which are still to be.

use super::words::{Meaning, plain};
use super::{Choice, Shots, columns, named, of_contrary, only_one, speed_in, unit_of};
use crate::v50::curve::Fate;
use crate::v50::designs::Fired;
use toron_materials::data_table::sheet::{Row, Sheet};
use toron_materials::unit_expression::Unit;
use toron_shared::error::Error;

/// What a column of asked speeds may be called.
const ASKED: [&str; 12] = [
    "asked",
    "asked speed",
    "asked velocity",
    "nominal",
    "nominal speed",
    "nominal velocity",
    "target",
    "target speed",
    "target velocity",
    "planned speed",
    "sollgeschwindigkeit",
    "vitesse demandée",
];

/// The shots of an experiment, in the order of the table.
#[derive(Clone, Debug)]
pub struct Planned {
    /// The file, as messages have it.
    pub name: String,
    /// Of all speeds.
    pub unit: Unit,
    pub fired: Vec<Fired>,
    /// Lines and speeds of shots that are still to be fired.
    pub pending: Vec<(usize, f64)>,
    /// The lines of shots that have no fate.
    pub without_fate: Vec<usize>,
    pub left_out: Vec<(usize, String)>,
    pub notes: Vec<String>,
}

impl Planned {
    /// Reads a sheet, that may have a header alone; `asked` is the column of the asked speeds, where its name does not
    /// tell.
    ///
    /// # Errors
    /// An input error that names file, line and column, what is there and what is allowed.
    pub fn of(sheet: &Sheet, choice: &Choice, asked: Option<&str>) -> Result<Planned, Error> {
        let shots = Shots::of(sheet, choice)?;
        let asked = asked_column(sheet, asked, shots.speed)?;
        let (mut fired, mut pending, mut without_fate) = (Vec::new(), Vec::new(), Vec::new());
        for row in &shots.kept {
            let was_asked = |(place, unit): &(usize, Unit)| {
                let is_told = !row.cells[*place].is_empty();
                let value = is_told.then(|| speed_in(sheet, row, *place)).transpose()?;
                Ok(value.map(|value| unit.scale.convert(value, &shots.unit.scale)))
            };
            let nominal = asked.as_ref().map(was_asked).transpose()?.flatten();
            let has_speed = !row.cells[shots.speed].is_empty();
            match shots.words.meaning(&row.cells[shots.outcome]) {
                Meaning::None => {
                    let is_blank = plain(&row.cells[shots.outcome]).is_empty();
                    let planned = match (&asked, nominal) {
                        // A speed that was measured is that of a shot.
                        (Some(_), nominal) => nominal.filter(|_| !has_speed),
                        (None, _) => has_speed.then(|| shots.speed_of(sheet, row)).transpose()?,
                    };
                    match planned.filter(|_| is_blank) {
                        Some(speed) => pending.push((row.line, speed)),
                        None if has_speed || nominal.is_some() => without_fate.push(row.line),
                        None => {}
                    }
                }
                of => {
                    let speed = shots.speed_of(sheet, row)?;
                    let fate = Fate { speed, through: of == Meaning::Perforation };
                    fired.push(Fired { nominal: nominal.unwrap_or(speed), fate });
                }
            }
        }
        let mut notes = shots.notes(sheet);
        notes.push(of_asked(sheet, asked.as_ref(), &shots.kept));
        notes.extend(of_contrary(&fired.iter().map(|shot| shot.fate).collect::<Vec<_>>()));
        let Shots { unit, left_out, .. } = shots;
        Ok(Planned { name: sheet.name.clone(), unit, fired, pending, without_fate, left_out, notes })
    }

    pub fn count(&self, through: bool) -> usize {
        self.fired.iter().filter(|shot| shot.fate.through == through).count()
    }
}

/// The column of the asked speeds and its unit; none where all speeds stand in one.
fn asked_column(sheet: &Sheet, asked: Option<&str>, speed: usize) -> Result<Option<(usize, Unit)>, Error> {
    let found = match asked {
        Some(name) => Some(named(sheet, "--asked", name)?),
        None => {
            let mut found = columns(sheet, &ASKED);
            found.retain(|&place| place != speed);
            match found[..] {
                [] => None,
                _ => Some(only_one(sheet, &found, "the asked speed", "--asked", "one")?),
            }
        }
    };
    found.filter(|&place| place != speed).map(|place| Ok((place, unit_of(sheet, place)?))).transpose()
}

fn of_asked(sheet: &Sheet, asked: Option<&(usize, Unit)>, rows: &[&Row]) -> String {
    match asked {
        Some((place, _)) => {
            let missing = rows.iter().filter(|row| row.cells[*place].is_empty()).count();
            let rest = match missing {
                0 => String::new(),
                1 => "; one shot has none, and counts as asked for as it was measured".to_string(),
                _ => format!("; {missing} shots have none, and count as asked for as they were measured"),
            };
            format!("Asked speed: column {}, \"{}\"{rest}.", place + 1, sheet.headings[*place].text)
        }
        None => "No column of asked speeds (--asked COLUMN): the measured ones count as asked for.".to_string(),
    }
}
