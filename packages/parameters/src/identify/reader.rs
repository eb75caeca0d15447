//! Data sets from their files: columns with units, the range that is fitted, and what is wrong with the data, by file,
//! line and column.

use std::cell::RefCell;
use std::ops::RangeInclusive;

use nalgebra::Matrix3;

use super::checks::{self, Flaw};
use super::data::{Axis, DataSet, Loading, Toe};
use super::file::{DataFile, DeviationFile, LoadingName};
use super::parameter::{PARAMETERS, Parameter};
use super::path_file;
use super::quantities::{Abscissa, COMPACTED, DISTORTED, FAILED_AT, Invariant, Simple};
use super::response::{Measured, Modes};
use super::toe::{Curve, Found};
use toron::host::units::UnitSystem;
use toron::law::parameters::{Dimension, ENERGY_DENSITY, NUMBER};
use toron_materials::data_table::DataTable;
use toron_materials::units::unit;
use toron_shared::checked::{AboveZero, Bound, Checked, Positive};
use toron_shared::error::Error;
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::Source;

/// Weights beyond these leave nothing of the other sets, or of this one.
const WEIGHTS: RangeInclusive<f64> = 1e-6..=1e6;
/// The size of ordinates, in the units of the fit, that the squares can take: that of the properties themselves.
const ORDINATES: RangeInclusive<f64> = 1e-25..=1e25;

/// What the data sets of a file have in common.
pub struct Reader<'a> {
    pub source: &'a Source<'a>,
    pub units: &'a UnitSystem,
    pub known: &'a [Option<f64>; PARAMETERS],
    /// What there is to say of how the data were read.
    pub said: RefCell<Vec<String>>,
}

/// A column in use: its name in the file, its values in the units of the fit.
pub(super) struct Values {
    pub column: String,
    pub values: Vec<f64>,
}

impl Reader<'_> {
    /// All data sets. `fibre` says whether the fibre's constants are given as well.
    ///
    /// # Errors
    /// An input error that names file, line and, in the data, column.
    pub(super) fn sets(&self, files: &[&Spanned<DataFile>], fibre: bool) -> Result<Vec<DataSet>, Error> {
        let mut sets = Vec::new();
        for (number, &file) in (1..).zip(files) {
            let set = self.set(number, file)?;
            if sets.iter().any(|other: &DataSet| other.name == set.name) {
                let message = format!("data set \"{}\" is there twice; allowed: a name of its own for each", set.name);
                return Err(self.source.error(file.span(), &message));
            }
            sets.push(set);
        }
        self.choose_fits(files, &mut sets)?;
        if fibre
            && let Some(index) = sets.iter().position(|set| set.fits.contains(&Parameter::KEl))
            && files[index].get_ref().fits.is_none()
        {
            let message = format!(
                "data set \"{}\" and [fibre] both tell k_el; allowed: one of them, or k_el among the data set's fits, which \
                 then counts",
                sets[index].name
            );
            return Err(self.source.error(files[index].span(), &message));
        }
        Ok(sets)
    }

    fn set(&self, number: usize, file: &Spanned<DataFile>) -> Result<DataSet, Error> {
        let (span, file) = (file.span(), file.get_ref());
        let table = self.table(file)?;
        let name = file.name.as_ref().map_or_else(|| format!("data-{number}"), |name| name.get_ref().clone());
        if !plain_name(&name) {
            let message =
                format!("data set \"{name}\"; allowed: letters, digits and - _ ., since files are named by it");
            return Err(self.source.error(file.name.as_ref().map_or(span.clone(), Spanned::span), &message));
        }
        let mut set = match (&file.loading, &file.path) {
            (Some(loading), None) => match loading.get_ref() {
                LoadingName::Elongation => self.simple(Simple::Elongation, file, &table)?,
                LoadingName::Compaction => self.simple(Simple::Compaction, file, &table)?,
                LoadingName::Compression => self.simple(Simple::Compression, file, &table)?,
                LoadingName::Failure => self.failure(file, &table)?,
                LoadingName::Biaxial | LoadingName::Plates => {
                    return Err(self.source.error(span.clone(), "no elastic section"));
                }
            },
            (None, Some(path)) => path_file::set(self, path, file, &table)?,
            _ => {
                let message = format!("data set \"{name}\": allowed: loading or path, one of the two");
                return Err(self.source.error(span.clone(), &message));
            }
        };
        set.name = name;
        set.place = last_place(&table);
        set.declared = format!("{}:{}", self.source.name, self.source.line(span));
        if let Some(weight) = &file.weight {
            let value = *weight.get_ref();
            if !WEIGHTS.contains(&value) {
                let message =
                    format!("weight is {value}; allowed: a number from {} to {}", WEIGHTS.start(), WEIGHTS.end());
                return Err(self.source.error(weight.span(), &message));
            }
            set.weight = value;
        }
        Ok(set)
    }

    /// A specimen that deforms as a whole in a known way.
    fn simple(&self, loading: Simple, file: &DataFile, table: &DataTable) -> Result<DataSet, Error> {
        let abscissae: Vec<_> = loading.abscissae().iter().map(|known| known.name).collect();
        let ordinates: Vec<_> = loading.ordinates().iter().map(|known| known.name).collect();
        self.require_known_columns(file, &[&abscissae[..], &ordinates[..]].concat())?;
        let abscissa = &loading.abscissae()[self.choice("abscissa", file, &file.abscissa, &abscissae, table)?];
        let ordinate = &loading.ordinates()[self.choice("ordinate", file, &file.ordinate, &ordinates, table)?];
        let x = self.abscissae(file, table, abscissa.name, abscissa.dimension)?;
        let y = self.column(file, table, ordinate.name, ordinate.dimension)?;
        let length = self.given("length", &file.length, abscissa.dimension == toron_materials::units::LENGTH, file)?;
        let area = self.given("area", &file.area, ordinate.dimension == toron_materials::units::FORCE, file)?;
        let mut x = x;
        let mut rows = self.rows(file, table, &x.values)?;
        let mut deviations = self.deviations(file, table, &rows, ordinate.dimension)?;
        let measured = (ordinate.measured)(area);
        let state = |value: f64| loading.gradient((abscissa.stretch)(value, length));
        let mut toe = None;
        if loading == Simple::Elongation && file.zero.is_none() && ordinate.dimension != ENERGY_DENSITY {
            let pick = |values: &[f64]| rows.iter().map(|&row| values[row] - abscissa.rest).collect::<Vec<f64>>();
            let shape = |distance: f64| per_stiffness(state(abscissa.rest + distance), measured);
            let ordinates: Vec<f64> = rows.iter().map(|&row| y.values[row]).collect();
            let (distances, known) = (pick(&x.values), deviations.as_deref());
            let found = Curve { x: &distances, y: &ordinates, deviations: known, shape }.toe();
            if let Some(found) = found {
                let keep: Vec<bool> = distances.iter().map(|&distance| distance >= found.end).collect();
                let kept = |i: &usize| keep[*i];
                deviations = deviations.map(|all| (0..rows.len()).filter(kept).map(|i| all[i]).collect());
                let left_out = keep.iter().filter(|keep| !**keep).count();
                rows = (0..rows.len()).filter(kept).map(|i| rows[i]).collect();
                x.values.iter_mut().for_each(|value| *value -= found.zero);
                let Found { zero, deviation, end } = found;
                toe = Some(Toe { zero, deviation, end, left_out, slopes: Vec::new() });
            }
        }
        let mut states: Vec<Matrix3<f64>> = Vec::new();
        for &row in &rows {
            let stretch = (abscissa.stretch)(x.values[row], length);
            if !loading.allows(stretch) {
                return Err(wrong(table, &x.column, row, &self.allowed(file, abscissa, &x, row)));
            }
            states.push(loading.gradient(stretch));
        }
        if let Some(toe) = &mut toe {
            const STEP: f64 = 1e-6;
            let slope = |&row: &usize| {
                let at = [x.values[row] + STEP, x.values[row]].map(|value| per_stiffness(state(value), measured));
                (at[0] - at[1]) / STEP
            };
            toe.slopes = rows.iter().map(slope).collect();
        }
        let mut set = self.assemble(
            Loading::Prescribed { states, measured },
            [(abscissa.name, abscissa.dimension), (ordinate.name, ordinate.dimension)],
            abscissa.rest,
            [&x, &y],
            &rows,
            deviations,
        );
        set.toe = toe;
        self.check(&set, table, &y.column, &rows)?;
        Ok(set)
    }

    /// What is allowed of an abscissa; of one before `zero`, how it is left out.
    fn allowed(&self, file: &DataFile, abscissa: &Abscissa, x: &Values, row: usize) -> String {
        match &file.zero {
            Some(zero) if x.values[row] < abscissa.rest => format!(
                "{}, less zero = {}: this one lies before it; leave such out by range = [{}, …], which counts from zero on",
                abscissa.allowed,
                zero.get_ref(),
                abscissa.rest
            ),
            _ => abscissa.allowed.to_string(),
        }
    }

    /// Strains at failure at some compactions and distortions.
    fn failure(&self, file: &DataFile, table: &DataTable) -> Result<DataSet, Error> {
        let unused = [("abscissa", &file.abscissa), ("ordinate", &file.ordinate)];
        if let Some((key, value)) = unused.into_iter().find_map(|(key, value)| Some((key, value.as_ref()?))) {
            let message =
                format!("{key} has no use with failure points; allowed: columns, where theirs have other names");
            return Err(self.source.error(value.span(), &message));
        }
        let names: Vec<&str> = FAILED_AT.iter().chain(&COMPACTED).chain(&DISTORTED).map(|known| known.name).collect();
        self.require_known_columns(file, &names)?;
        self.given("length", &file.length, false, file)?;
        self.given("area", &file.area, false, file)?;
        let (y, at) = self.invariants(file, table, &FAILED_AT)?.ok_or_else(|| {
            let names: Vec<&str> = FAILED_AT.iter().map(|known| known.name).collect();
            self.source.error(
                file.file.span(),
                &format!("{}: no column of the strain at failure; allowed: {}", table.name, names.join(", ")),
            )
        })?;
        let none = |table: &DataTable| vec![0.0; table.columns[0].values.len()];
        let compacted = self.invariants(file, table, &COMPACTED)?;
        let distorted = self.invariants(file, table, &DISTORTED)?;
        let compaction = compacted.as_ref().map_or_else(|| none(table), |(_, values)| values.clone());
        let distortion = distorted.as_ref().map_or_else(|| none(table), |(_, values)| values.clone());
        // A range is one of the column that is the abscissa.
        let over = compacted.as_ref().or(distorted.as_ref()).map(|(column, _)| column.values.values.as_slice());
        let rows = self.rows(file, table, over.unwrap_or(&compaction))?;
        let pick = |values: &[f64]| rows.iter().map(|&row| values[row]).collect::<Vec<f64>>();
        // The standard deviation of a strain is that of its logarithm times 1 + strain.
        let slope = |row: usize| match y.name {
            "strain" => 1.0 / (1.0 + y.values.values[row]),
            "stretch" => 1.0 / y.values.values[row],
            _ => 1.0,
        };
        let deviations = self.deviations(file, table, &rows, NUMBER)?;
        let deviations = deviations.map(|d| d.iter().zip(&rows).map(|(d, &row)| d * slope(row)).collect());
        let (name, over) = if compaction.iter().any(|&c| c != 0.0) || distorted.is_none() {
            ("-I_tc", &compaction)
        } else {
            ("I_td", &distortion)
        };
        let axis = |name: &str, values| Axis { name: name.to_string(), unit: "-".to_string(), values };
        Ok(DataSet {
            name: String::new(),
            place: String::new(),
            declared: String::new(),
            abscissa: axis(name, pick(over)),
            ordinate: axis("I_el at failure", pick(&at)),
            rest: 0.0,
            loading: Loading::Failure { compaction: pick(&compaction), distortion: pick(&distortion) },
            deviations,
            weight: 1.0,
            fits: Vec::new(),
            toe: None,
        })
    }

    /// The first of these invariants that the file has, checked.
    fn invariants(
        &self,
        file: &DataFile,
        table: &DataTable,
        known: &'static [Invariant],
    ) -> Result<Option<(FailureColumn, Vec<f64>)>, Error> {
        let Some(invariant) = known.iter().find(|known| self.has(file, table, known.name)) else { return Ok(None) };
        let values = self.column(file, table, invariant.name, NUMBER)?;
        let mut invariants = Vec::new();
        for (row, &value) in values.values.iter().enumerate() {
            let of = (invariant.of)(value);
            let strict = std::ptr::eq(known, &FAILED_AT[..]);
            if !of.is_finite() || of < 0.0 || (strict && !(of > 0.0 && of <= std::f64::consts::LN_2)) {
                return Err(wrong(table, &values.column, row, invariant.allowed));
            }
            invariants.push(of);
        }
        Ok(Some((FailureColumn { name: invariant.name, values }, invariants)))
    }

    /// The quantity that the file names, or else the first one of the known that is among the columns.
    fn choice(
        &self,
        key: &str,
        file: &DataFile,
        named: &Option<Spanned<String>>,
        known: &[&'static str],
        table: &DataTable,
    ) -> Result<usize, Error> {
        if let Some(name) = named {
            return known.iter().position(|known| known == name.get_ref()).ok_or_else(|| {
                let message =
                    format!("{key} is \"{}\"; allowed with this loading: {}", name.get_ref(), known.join(", "));
                self.source.error(name.span(), &message)
            });
        }
        known.iter().position(|known| self.has(file, table, known)).ok_or_else(|| {
            let columns: Vec<&str> = table.names().map(|(name, _)| name).collect();
            let message = format!(
                "{} has the columns {}, none of which is an {key} of this loading; allowed: {}, or columns = {{ {} = \"name in \
                 the file\" }}",
                table.name,
                columns.join(", "),
                known.join(", "),
                known[0]
            );
            self.source.error(file.file.span(), &message)
        })
    }

    /// Whether `columns` names quantities that there are.
    pub(super) fn require_known_columns(&self, file: &DataFile, known: &[&str]) -> Result<(), Error> {
        match file.columns.iter().find(|(key, _)| !known.contains(&key.get_ref().as_str())) {
            None => Ok(()),
            Some((key, _)) => {
                let message = format!("columns: \"{}\"; allowed: {}", key.get_ref(), known.join(", "));
                Err(self.source.error(key.span(), &message))
            }
        }
    }

    fn has(&self, file: &DataFile, table: &DataTable, quantity: &str) -> bool {
        file.columns.iter().any(|(key, _)| key.get_ref() == quantity) || table.has(quantity)
    }

    /// The data of a set, but for the lines that are left out.
    pub(super) fn table(&self, file: &DataFile) -> Result<DataTable, Error> {
        let table = DataTable::read_tests(&self.source.file("file", &file.file)?)?;
        for left_out in &table.excluded {
            self.say(&table, Some(format!("line {} is left out: {}", left_out.line, left_out.reason)));
        }
        Ok(table)
    }

    fn say(&self, table: &DataTable, said: Option<String>) {
        let said = said.map(|said| format!("{}: {said}", table.name));
        let mut all = self.said.borrow_mut();
        if let Some(said) = said.filter(|said| !all.contains(said)) {
            all.push(said);
        }
    }

    /// The column that holds a quantity: the one that `columns` names, or the one of the same name.
    pub(super) fn column(
        &self,
        file: &DataFile,
        table: &DataTable,
        quantity: &str,
        dimension: Dimension,
    ) -> Result<Values, Error> {
        let mapped = file.columns.iter().find(|(key, _)| key.get_ref() == quantity);
        let column = mapped.map_or(quantity, |(_, name)| name.get_ref().as_str());
        let (values, said) = table.forces(column, dimension, self.units)?;
        self.say(table, said);
        Ok(Values { column: table.own_name(column).to_string(), values })
    }

    /// The column of the abscissa, from where the specimen is at rest.
    pub(super) fn abscissae(
        &self,
        file: &DataFile,
        table: &DataTable,
        quantity: &str,
        dimension: Dimension,
    ) -> Result<Values, Error> {
        let mut column = self.column(file, table, quantity, dimension)?;
        if let Some(zero) = &file.zero {
            let zero = self.source.finite("zero", *zero.get_ref(), zero.span())?;
            column.values.iter_mut().for_each(|value| *value -= zero);
        }
        Ok(column)
    }

    /// A length or an area that a quantity needs.
    pub(super) fn given(
        &self,
        key: &str,
        value: &Option<Spanned<Positive>>,
        needed: bool,
        file: &DataFile,
    ) -> Result<f64, Error> {
        match value {
            Some(value) if !needed => {
                let message = format!("{key} has no use with these quantities; allowed: without it");
                Err(self.source.error(value.span(), &message))
            }
            Some(given) => Ok(given.value()),
            None if !needed => Ok(1.0),
            None => {
                let message = format!("{key} is missing: that of the specimen at rest; allowed: a finite number > 0");
                Err(self.source.error(file.file.span(), &message))
            }
        }
    }

    /// The rows in the range that is fitted.
    pub(super) fn rows(&self, file: &DataFile, table: &DataTable, abscissae: &[f64]) -> Result<Vec<usize>, Error> {
        let all = 0..abscissae.len();
        let Some(range) = &file.range else { return Ok(all.collect()) };
        let [from, to] = range.get_ref().0;
        let rows: Vec<usize> = all.filter(|&row| from <= abscissae[row] && abscissae[row] <= to).collect();
        if rows.is_empty() {
            let least = abscissae.iter().copied().fold(f64::INFINITY, f64::min);
            let most = abscissae.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let message = format!(
                "range is [{from}, {to}]; no line of {} is in it: in the units of this file they go from {least} to {most}",
                table.name
            );
            return Err(self.source.error(range.span(), &message));
        }
        Ok(rows)
    }

    /// The standard deviations of the ordinates in these rows.
    pub(super) fn deviations(
        &self,
        file: &DataFile,
        table: &DataTable,
        rows: &[usize],
        dimension: Dimension,
    ) -> Result<Option<Vec<f64>>, Error> {
        let Some(deviation) = &file.deviation else { return Ok(None) };
        match deviation.get_ref() {
            DeviationFile::Number(value) if AboveZero::allows(*value) => Ok(Some(vec![*value; rows.len()])),
            DeviationFile::Number(value) => {
                let message = format!("deviation is {value}; allowed: {}", AboveZero::ALLOWED);
                Err(self.source.error(deviation.span(), &message))
            }
            DeviationFile::Column(name) => {
                let (values, said) = table.forces(name, dimension, self.units)?;
                self.say(table, said);
                let bad = rows.iter().find(|&&row| values[row] <= 0.0);
                match bad {
                    Some(&row) => Err(wrong(table, name, row, "a number > 0: a standard deviation")),
                    None => Ok(Some(rows.iter().map(|&row| values[row]).collect())),
                }
            }
        }
    }

    /// A set out of its columns.
    pub(super) fn assemble(
        &self,
        loading: Loading,
        names: [(&str, Dimension); 2],
        rest: f64,
        columns: [&Values; 2],
        rows: &[usize],
        deviations: Option<Vec<f64>>,
    ) -> DataSet {
        let axis = |i: usize| Axis {
            name: names[i].0.to_string(),
            unit: unit(self.units, names[i].1),
            values: rows.iter().map(|&row| columns[i].values[row]).collect(),
        };
        DataSet {
            name: String::new(),
            place: String::new(),
            declared: String::new(),
            loading,
            abscissa: axis(0),
            ordinate: axis(1),
            rest,
            deviations,
            weight: 1.0,
            fits: Vec::new(),
            toe: None,
        }
    }

    /// Whether the ordinates rise from rest.
    pub(super) fn check(&self, set: &DataSet, table: &DataTable, column: &str, rows: &[usize]) -> Result<(), Error> {
        let distances: Vec<f64> = (0..set.len()).map(|i| set.distance(i)).collect();
        let noise = set.deviations.as_ref().map(|deviations| deviations.iter().copied().fold(0.0, f64::max));
        if !ORDINATES.contains(&set.largest()) {
            let (least, most) = ORDINATES.into_inner();
            let allowed = format!("values of which the largest is from {least:e} to {most:e} in the units of the fit");
            return Err(wrong(table, column, rows[0], &allowed));
        }
        if distances.iter().all(|&distance| distance == 0.0) {
            return Err(wrong(table, column, rows[0], "points away from rest: on the abscissa these are all at rest"));
        }
        match checks::flaw(&distances, &set.ordinate.values, noise) {
            None => Ok(()),
            Some(Flaw::Negative(point)) => {
                Err(wrong(table, column, rows[point], "a value >= 0: tension, or pressure where it is pressed"))
            }
            Some(Flaw::Unloads(point)) => {
                let allowed =
                    "loading only: from here on the curve comes back, and off the way it went; leave that out";
                Err(wrong(table, column, rows[point], allowed))
            }
            Some(Flaw::Falls(point, before)) => {
                let line = cell(table, column, rows[before]).0;
                let allowed = format!(
                    "no less than before within the noise, which line {line} has: an elastic {} rises from rest on; leave \
                     out unloading and failure by range",
                    set.ordinate.name
                );
                Err(wrong(table, column, rows[point], &allowed))
            }
        }
    }

    /// What each set tells: as the file says, or what its loading tells and nothing else does.
    fn choose_fits(&self, files: &[&Spanned<DataFile>], sets: &mut [DataSet]) -> Result<(), Error> {
        let compaction = |file: &&Spanned<DataFile>| {
            file.get_ref().loading.as_ref().is_some_and(|loading| *loading.get_ref() == LoadingName::Compaction)
        };
        let compacted = files.iter().any(compaction);
        for (file, set) in files.iter().zip(sets) {
            let file = file.get_ref();
            if let Some(names) = &file.fits {
                if names.is_empty() {
                    let message = format!("data set {}: fits is empty; allowed: a parameter at least", set.name);
                    return Err(Error::Input(format!("{}: {message}", set.declared)));
                }
                set.fits = names.iter().map(|name| self.parameter(name)).collect::<Result<_, _>>()?;
                continue;
            }
            let told: &[Parameter] = match file.loading.as_ref().map(|loading| *loading.get_ref()) {
                Some(LoadingName::Elongation) => &[Parameter::KEl],
                Some(LoadingName::Compaction) => &[Parameter::KTc, Parameter::P],
                Some(LoadingName::Compression) if compacted => &[Parameter::KTd],
                Some(LoadingName::Compression) => &[Parameter::KTc, Parameter::P, Parameter::KTd],
                Some(LoadingName::Failure) => &[Parameter::EpsLim, Parameter::Alpha, Parameter::Beta],
                Some(LoadingName::Biaxial | LoadingName::Plates) => &[],
                None => &[Parameter::KEl, Parameter::KTc, Parameter::P, Parameter::KTd, Parameter::KLd],
            };
            // What is given is not fitted; what the data do not depend on is no claim of theirs.
            let open = |parameter: &Parameter| told.contains(parameter) && self.known[parameter.index()].is_none();
            set.fits = set.depends_on()?.into_iter().filter(open).collect();
        }
        Ok(())
    }

    fn parameter(&self, name: &Spanned<String>) -> Result<Parameter, Error> {
        let parameter = Parameter::named(name.get_ref()).ok_or_else(|| {
            let known: Vec<&str> = super::parameter::ALL.iter().map(|parameter| parameter.name()).collect();
            self.source.error(name.span(), &format!("fits \"{}\"; allowed: {}", name.get_ref(), known.join(" ")))
        })?;
        if self.known[parameter.index()].is_some() {
            let message = format!(
                "{} is given in [yarn] properties; allowed there or among the fits, not both",
                parameter.name()
            );
            return Err(self.source.error(name.span(), &message));
        }
        Ok(parameter)
    }
}

/// What is measured of a state along the fibre at a k_el of 1; NaN where the law has no answer.
fn per_stiffness(state: Matrix3<f64>, measured: Measured) -> f64 {
    let mut one = [1.0; PARAMETERS];
    one[Parameter::P.index()] = 2.0; // 1 is no exponent of the law
    Modes::at(&state, [1.0, 0.0, 0.0], &one)
        .map_or(f64::NAN, |modes| modes.response(measured, &one).gradient[Parameter::KEl.index()])
}

/// Whether files can be named by it.
pub(super) fn plain_name(name: &str) -> bool {
    !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || "-_.".contains(c))
}

/// File, last line and first column.
fn last_place(table: &DataTable) -> String {
    let last = table.columns.first().and_then(|column| column.values.last());
    last.map_or_else(|| table.name.clone(), |cell| format!("{}:{}:{}", table.name, cell.line, cell.column))
}

/// A column of failure points.
struct FailureColumn {
    name: &'static str,
    values: Values,
}

/// The error of a value, in the words of its file: value and unit as they stand there.
pub(super) fn wrong(table: &DataTable, column: &str, row: usize, allowed: &str) -> Error {
    let (line, number, value) = cell(table, column, row);
    table.error(line, number, &format!("the value is {value}; allowed: {allowed}"))
}

/// Line, column and text of a value.
fn cell(table: &DataTable, column: &str, row: usize) -> (usize, usize, String) {
    table.column(column).map_or((0, 0, String::new()), |column| {
        let cell = column.values[row];
        let unit = if column.unit.text == "-" { String::new() } else { format!(" {}", column.unit.text) };
        (cell.line, cell.column, format!("{}{unit}", cell.value))
    })
}
