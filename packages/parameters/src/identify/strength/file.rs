//! The strengths of a file and where they come from. `docs/reference/fit-files.md` has the keys.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::identify::file::FitFile;
use crate::identify::reader::plain_name;
use toron::host::units::UnitSystem;
use toron::law::parameters::{Dimension, NUMBER, STRESS};
use toron_materials::data_table::{Cell, DataTable, Excluded};
use toron_materials::units::{self, LENGTH};
use toron_shared::checked::{Positive, value};
use toron_shared::error::Error;
use toron_shared::nearest::nearest;
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::{self, Source};
use toron_strikes::strength::fit::{self, Fit, Test};
use toron_strikes::strength::scales::{self, ScaleFit};

/// A table `[[strength]]`.
#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct SetFile {
    /// Of the set and its file. Default: `strength-1`, ….
    name: Option<Spanned<String>>,
    /// A CSV file, as for `[[data]]`.
    file: Spanned<String>,
    /// `{ strength = "Peak" }`: the column of a quantity. Default: the quantity's name.
    #[serde(default)]
    columns: BTreeMap<Spanned<String>, Spanned<String>>,
    /// Gauge length of all tests. Default: the column `length`.
    length: Option<Spanned<Positive>>,
    /// The length that the scale is of. Default: the shortest length.
    reference_length: Option<Positive>,
}

/// The quantities of a column: tests, or what was found at each length.
const STRENGTH: &str = "strength";
const LENGTHS: &str = "length";
const CENSORED: &str = "censored";
const SCALE: &str = "scale";
const MODULUS: &str = "modulus";
const QUANTITIES: [&str; 5] = [STRENGTH, LENGTHS, CENSORED, SCALE, MODULUS];

/// The sets of a file, and what they tell.
#[derive(Debug)]
pub struct StrengthJob {
    pub title: String,
    pub units: UnitSystem,
    pub sets: Vec<Set>,
    /// The files that were read, none of which is to be overwritten.
    pub inputs: Vec<PathBuf>,
}

/// What is known of a yarn's strength.
#[derive(Debug)]
pub struct Set {
    pub name: String,
    /// Of the strengths: a stress, or a strain.
    pub dimension: Dimension,
    pub found: Found,
    /// What there is to say of how the file was read, and what of it is left out.
    pub said: Vec<String>,
}

#[derive(Debug)]
pub enum Found {
    Tests {
        tests: Vec<Test>,
        /// Of each test in the file.
        lines: Vec<usize>,
        fit: Fit,
    },
    Scales {
        lengths: Vec<f64>,
        fit: ScaleFit,
        /// With half of the longest yarn added to each, as a cell might be.
        longer: Option<(f64, ScaleFit)>,
        /// Those found at each length; none where they are not given.
        moduli: Vec<f64>,
    },
}

impl StrengthJob {
    /// Reads the file and its data, and fits them; none where the file has no strengths.
    ///
    /// # Errors
    /// An input error that names file, line and what is allowed.
    pub fn read(path: &Path) -> Result<Option<StrengthJob>, Error> {
        let (name, text) = toml_file::read(path)?;
        let source = Source { name: &name, text: &text };
        let file: FitFile = source.parse()?;
        let Some(first) = file.strength.first() else { return Ok(None) };
        if file.has_properties() {
            let message =
                "[[strength]] beside tables for the law's properties; allowed: a file of its own, with title and units";
            return Err(source.error(first.span(), message));
        }
        let units = units::system(&source, &file.units)?;
        let (mut sets, mut inputs) = (Vec::new(), vec![path.to_path_buf()]);
        for (number, table) in (1..).zip(&file.strength) {
            let set = strengths(&source, number, table, &units)?;
            if sets.iter().any(|other: &Set| other.name == set.name) {
                let message = format!("set \"{}\" is there twice; allowed: a name of its own for each", set.name);
                return Err(source.error(table.span(), &message));
            }
            inputs.push(source.folder().join(table.get_ref().file.get_ref()));
            sets.push(set);
        }
        Ok(Some(StrengthJob { title: file.title.unwrap_or(name.clone()), units, sets, inputs }))
    }
}

/// A file of strengths, and what its columns are called.
struct Columns<'a> {
    table: DataTable,
    file: &'a SetFile,
    units: &'a UnitSystem,
    said: RefCell<Vec<String>>,
}

impl Columns<'_> {
    fn name<'a>(&'a self, quantity: &'a str) -> &'a str {
        let own = self.file.columns.iter().find(|(key, _)| key.get_ref() == quantity);
        own.map_or(quantity, |(_, name)| name.get_ref())
    }

    fn has(&self, quantity: &str) -> bool {
        let known = self.file.columns.iter().any(|(key, _)| key.get_ref() == quantity);
        known || self.table.has(quantity)
    }

    fn cells(&self, quantity: &str) -> Result<&[Cell], Error> {
        self.table.column(self.name(quantity)).map(|column| &column.values[..])
    }

    fn error(&self, cell: &Cell, message: &str) -> Error {
        self.table.error(cell.line, cell.column, message)
    }

    fn positive(&self, quantity: &str, dimension: Dimension) -> Result<Vec<f64>, Error> {
        let (values, said) = self.table.forces(self.name(quantity), dimension, self.units)?;
        self.said.borrow_mut().extend(said);
        match values.iter().zip(self.cells(quantity)?).find(|(value, _)| **value <= 0.0) {
            None => Ok(values),
            Some((_, cell)) => Err(self.error(cell, &format!("the value is {}; allowed: a number > 0", cell.value))),
        }
    }

    /// Strengths or scales, which are stresses or strains.
    fn strengths(&self, quantity: &str) -> Result<(Vec<f64>, Dimension), Error> {
        let unit = &self.table.column(self.name(quantity))?.unit;
        let dimension = if unit.measures(NUMBER) { NUMBER } else { STRESS };
        self.positive(quantity, dimension).map(|values| (values, dimension))
    }

    /// No column is passed over that is called nearly as one that the file might have.
    ///
    /// # Errors
    /// One would be.
    fn check_names(&self) -> Result<(), Error> {
        let missing = || QUANTITIES.into_iter().filter(|quantity| !self.has(quantity));
        let is_read = |name: &str| QUANTITIES.iter().any(|quantity| self.table.own_name(self.name(quantity)) == name);
        for (name, number) in self.table.names().filter(|(name, _)| !is_read(name)) {
            if let Some(meant) = nearest(&name.to_lowercase(), missing()) {
                let message = format!(
                    "it is not read, did you mean {meant}? allowed: the name {meant}, columns = {{ {meant} = \"{name}\" }}, or a name that \
                     is less alike"
                );
                return Err(self.table.error(self.table.header, number, &message));
            }
        }
        Ok(())
    }

    /// Whether each test has broken.
    fn broken(&self, count: usize) -> Result<Vec<bool>, Error> {
        if !self.has(CENSORED) {
            return Ok(vec![true; count]);
        }
        let wanted = "allowed: 0 of a yarn that has broken between the grips, 1 of one that is stronger, as where it has slipped";
        let broken = |cell: &Cell| match cell.value {
            0.0 => Ok(true),
            1.0 => Ok(false),
            value => Err(self.error(cell, &format!("the value is {value}; {wanted}"))),
        };
        self.cells(CENSORED)?.iter().map(broken).collect()
    }
}

fn strengths(source: &Source<'_>, number: usize, table: &Spanned<SetFile>, units: &UnitSystem) -> Result<Set, Error> {
    let (span, file) = (table.span(), table.get_ref());
    let name = file.name.as_ref().map_or_else(|| format!("strength-{number}"), |name| name.get_ref().clone());
    if !plain_name(&name) {
        let message = format!("set \"{name}\"; allowed: letters, digits and - _ ., since files are named by it");
        return Err(source.error(file.name.as_ref().map_or(span, Spanned::span), &message));
    }
    if let Some((key, _)) = file.columns.iter().find(|(key, _)| !QUANTITIES.contains(&key.get_ref().as_str())) {
        let message = format!("columns has {}; allowed: {}", key.get_ref(), QUANTITIES.join(", "));
        return Err(source.error(key.span(), &message));
    }
    let table_of_tests = DataTable::read_tests(&source.file("file", &file.file)?)?;
    let left_out = |left_out: &Excluded| format!("line {} is left out: {}", left_out.line, left_out.reason);
    let said = RefCell::new(table_of_tests.excluded.iter().map(left_out).collect());
    let columns = Columns { table: table_of_tests, file, units, said };
    columns.check_names()?;
    let (length, reference) = (value(&file.length), value(&file.reference_length));
    if let (Some(given), true) = (&file.length, columns.has(LENGTHS)) {
        return Err(source.error(given.span(), "length beside a column length; allowed: one of them"));
    }
    let lengths = |count: usize| match length {
        Some(length) => Ok(vec![length; count]),
        None if columns.has(LENGTHS) => columns.positive(LENGTHS, LENGTH),
        None => {
            let message =
                format!("set \"{name}\" has no length; allowed: length, or a column of it, as \"length (mm)\"");
            Err(source.error(span.clone(), &message))
        }
    };
    // The shortest has the most of the scatter's strengths.
    let reference = |lengths: &[f64]| reference.unwrap_or(lengths.iter().copied().fold(f64::INFINITY, f64::min));
    let refused = |message: String| source.error(span.clone(), &format!("set \"{name}\": {message}"));
    let of_scales = columns.has(SCALE);
    if of_scales == columns.has(STRENGTH) {
        let message = "one column of the two: strength of each test, or scale at each length".to_string();
        return Err(refused(message));
    }
    let (values, dimension) = columns.strengths(if of_scales { SCALE } else { STRENGTH })?;
    let lengths = lengths(values.len())?;
    let reference = reference(&lengths);
    let found = if of_scales {
        let fit = scales::fit(&lengths, &values, reference).map_err(refused)?;
        let cell = 0.5 * lengths.iter().copied().fold(0.0, f64::max);
        let longer: Vec<f64> = lengths.iter().map(|length| length + cell).collect();
        let longer = scales::fit(&longer, &values, reference).ok().map(|fit| (cell, fit));
        let moduli = if columns.has(MODULUS) { columns.positive(MODULUS, NUMBER)? } else { Vec::new() };
        Found::Scales { lengths, fit, longer, moduli }
    } else {
        let tests = values.iter().zip(&lengths).zip(columns.broken(values.len())?);
        let tests: Vec<Test> = tests.map(|((&strength, &length), broken)| Test { strength, length, broken }).collect();
        let fit = fit::fit(&tests, reference).map_err(refused)?;
        let lines = columns.cells(STRENGTH)?.iter().map(|cell| cell.line).collect();
        Found::Tests { tests, lines, fit }
    };
    Ok(Set { name: name.clone(), dimension, found, said: columns.said.into_inner() })
}

impl Set {
    /// Modulus, scale and reference length.
    pub fn law(&self) -> (fit::Estimate, fit::Estimate, f64) {
        match &self.found {
            Found::Tests { fit: Fit { modulus, scale, reference_length, .. }, .. } => {
                (*modulus, *scale, *reference_length)
            }
            Found::Scales { fit: ScaleFit { modulus, scale, reference_length, .. }, .. } => {
                (*modulus, *scale, *reference_length)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::strength::report;

    /// What a file says of these data.
    fn read(keys: &str, data: &str) -> Result<StrengthJob, String> {
        use std::sync::atomic::{AtomicUsize, Ordering};
        static NUMBER: AtomicUsize = AtomicUsize::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let folder = std::env::temp_dir().join(format!("toron-strengths-{}-{number}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let text = format!("units = \"mm-tonne-s\"\n[[strength]]\nfile = \"data.csv\"\n{keys}");
        std::fs::write(folder.join("data.csv"), data).expect("data");
        std::fs::write(folder.join("fit.toml"), text).expect("a file");
        let job = StrengthJob::read(&folder.join("fit.toml"));
        std::fs::remove_dir_all(&folder).expect("the folder can go");
        job.map(|job| job.expect("it has strengths")).map_err(|error| error.to_string())
    }

    const TESTS: &str =
        "length (mm),strength (GPa),censored (-)\n50,2,0\n50,2.2,0\n50,1.9,1\n200,1.8,0\n200,1.9,0\n200,1.6,0\n";

    #[test]
    fn strengths_are_read_with_their_lengths_and_units() {
        let job = read("", TESTS).expect("a fit");
        let Found::Tests { tests, fit, .. } = &job.sets[0].found else { panic!("{job:?}") };
        assert_eq!(tests[2], Test { strength: 1900.0, length: 50.0, broken: false });
        assert_eq!((tests.len(), fit.reference_length), (6, 50.0));
        let said = report::report(&job);
        assert!(
            said.contains("6 tests at 2 lengths, 5 of which have broken") && said.contains("MPa at 50 mm"),
            "{said}"
        );
        // Strains at one length, in columns of other names.
        let strains = "Peak (%),Slip (-)\n2.0,0\n2.4,0\n2.1,1\n";
        let keys = "name = \"warp\"\nlength = 20.0\nreference_length = 50.0\n\
                    columns = { strength = \"Peak\", censored = \"Slip\" }\n";
        let job = read(keys, strains).expect("a fit");
        let table = report::table(&job, &job.sets[0]);
        assert!(table.contains("[scene.strength]\n") && table.contains("\nstrain = 0.02"), "{table}");
        // What was found at each length.
        let scales = "length (mm),scale (MPa),modulus (-)\n50,1933,21.7\n125,1829,11.5\n200,1795,14.3\n";
        let job = read("reference_length = 100.0\n", scales).expect("a fit");
        let said = report::report(&job);
        assert!(said.contains("scales at 3 lengths") && said.contains("contradict one law of Weibull if"), "{said}");
        assert!(said.contains("MPa at 100 mm"), "{said}");
    }

    /// A yarn of another kind is named, and left out with a reason alone.
    #[test]
    fn a_test_that_decides_is_named() {
        let strengths = [1902.0, 1925.0, 1946.0, 1942.0, 1924.0, 1529.0, 2171.0, 1770.0, 1690.0, 1849.0, 20.0];
        let file = |reason: &str| {
            let rows = strengths.map(|strength| format!("{strength},{}\n", if strength == 20.0 { reason } else { "" }));
            format!("Strength (MPa),excluded\n{}", rows.concat())
        };
        let said = |reason: &str| {
            let job = read("length = 50.0\n", &file(reason)).expect("a fit");
            let text = report::report(&job) + &report::table(&job, &job.sets[0]);
            text.split_whitespace().collect::<Vec<_>>().join(" ")
        };
        let text = said("");
        assert!(text.contains("m is decided by one test, 20 MPa of line 12: without it m is 12.653 (95 %: 7.436 to 19.008), and 2.3277 with it"), "{text}");
        assert!(text.contains("line 12 has 20 MPa; 0.05 to 12 GPa, as fibres have"), "{text}");
        let text = said("cut by the clamp");
        assert!(!text.contains("decided") && !text.contains("as fibres have"), "{text}");
        assert_eq!(text.matches("line 12 is left out: cut by the clamp").count(), 2, "{text}");
    }

    #[test]
    fn bad_strengths_are_named() {
        let of = |from: &str, to: &str| read("", &TESTS.replace(from, to));
        for (from, to, message) in [
            (
                "50,2,0",
                "50,2,2",
                "data.csv:2:3: column \"censored\": the value is 2; allowed: 0 of a yarn that has broken",
            ),
            ("50,2,0", "50,-2,0", "data.csv:2:2: column \"strength\": the value is -2; allowed: a number > 0"),
            ("50,2,0", "0,2,0", "data.csv:2:1: column \"length\": the value is 0; allowed: a number > 0"),
            ("(GPa)", "(mm)", "the unit is \"mm\"; allowed: a unit of stress, as MPa"),
            (
                "censored (-)",
                "Censord (-)",
                "data.csv:1:3: column \"Censord\": it is not read, did you mean censored? allowed: the name censored, columns = \
                 { censored = \"Censord\" }",
            ),
            ("censored (-)", "censord (-)", "column \"censord\": it is not read, did you mean censored?"),
            ("length (mm)", "Lenght (mm)", "column \"Lenght\": it is not read, did you mean length?"),
            ("strength (GPa)", "load (GPa)", "one column of the two: strength of each test, or scale at each length"),
            ("length (mm)", "place (mm)", "has no length; allowed: length, or a column of it"),
        ] {
            let error = of(from, to).map(|_| ()).expect_err(to);
            assert!(error.contains(message), "{message}: {error}");
        }
        for (keys, message) in [
            ("length = 50.0\n", "length beside a column length; allowed: one of them"),
            ("reference_length = 0.0\n", "reference_length is 0.0; allowed: a finite number > 0"),
            (
                "columns = { strain = \"a\" }\n",
                "columns has strain; allowed: strength, length, censored, scale, modulus",
            ),
            ("columns = { strength = \"a\" }\n", "no column \"a\"; there are: length, strength, censored"),
            (
                "[yarn]\nname = \"a\"\n",
                "[[strength]] beside tables for the law's properties; allowed: a file of its own",
            ),
            ("name = \"a/b\"\n", "set \"a/b\"; allowed: letters, digits"),
            ("[[strength]]\nfile = \"data.csv\"\nname = \"strength-1\"\n", "set \"strength-1\" is there twice"),
        ] {
            let error = read(keys, TESTS).map(|_| ()).expect_err(keys);
            assert!(error.contains(message), "{message}: {error}");
        }
        let slipped = "length (mm),strength (MPa),censored (-)\n50,2,1\n50,3,1\n";
        let error = read("", slipped).map(|_| ()).expect_err("none has broken");
        assert!(error.contains("set \"strength-1\": no test has broken; allowed: two at least that have"), "{error}");
    }
}
