//! What an input of Abaqus says of its user materials: constants, state variables, density, deletion, elements,
//! orientation, initial stress and state.

use std::collections::BTreeMap;
use std::path::Path;

use super::input::MOST_STATES;
use super::material::{MOST_FIELDS, Material, Plane};
use toron_shared::error::Error;
use toron_shared::keyword_file::abaqus::{self, Keyword, fields, label};
use toron_shared::keyword_file::files::text;
use toron_shared::keyword_file::line::Line;

/// A material with `*USER MATERIAL`.
#[derive(Clone, Debug, Default)]
pub struct User {
    /// As it stands in the file.
    name: String,
    /// Whether there is a `*USER MATERIAL`, and CONSTANTS of it.
    constants: Option<usize>,
    properties: Vec<f64>,
    states: usize,
    deletion: Option<usize>,
    density: Option<f64>,
    unsymmetric: bool,
    /// Of the section: the first element's type, whether there is an orientation, and the set.
    element: Option<String>,
    orientation: bool,
    set: Option<String>,
}

/// What the lines behind a keyword are of.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Data {
    None,
    Parameters,
    Properties,
    States,
    Density,
    Elements,
    /// Numbers of a set, or first, last and step.
    Set(bool),
    Stress,
    Solution,
    /// Of nodes: a field by its number, the temperature as 0.
    Field(usize),
    /// Of a composite section, whose layers name their materials.
    Layers,
}

#[derive(Default)]
struct Deck {
    materials: Vec<User>,
    parameters: BTreeMap<String, f64>,
    data: Option<Data>,
    /// Of the part: types of elements, sets of them by name, and sections: material, set, whether oriented.
    types: BTreeMap<i64, String>,
    sets: BTreeMap<String, Vec<i64>>,
    sections: Vec<(String, String, bool)>,
    /// Sets of cohesive elements that have stress, not traction.
    continua: Vec<String>,
    /// Of all parts: material, set, whether oriented, and the type of its elements. Materials stand behind them.
    used: Vec<(String, String, bool, Option<String>)>,
    /// The type of the elements that follow, or the name of the set.
    current: String,
    also: Option<String>,
    stresses: Vec<(String, Vec<f64>)>,
    solutions: Vec<(String, Vec<f64>)>,
    /// The values of fields at the beginning, of all sets of nodes.
    fields: Vec<(usize, f64)>,
    /// Whether a step has NLGEOM; none where there is no step.
    nonlinear: Option<bool>,
}

/// A number of state variables or constants, for which there is memory.
///
/// # Errors
/// It is none, or too large.
fn count(line: &Line<'_>, what: &str, field: &str) -> Result<usize, Error> {
    match line.number(what, field)? {
        count if count <= MOST_STATES => Ok(count),
        count => Err(line.error(&format!("{what} is {count}; allowed: 0 to {MOST_STATES}"))),
    }
}

impl abaqus::Reader for Deck {
    fn keyword(&mut self, keyword: &Keyword<'_>) -> Result<bool, Error> {
        let data = match keyword.name.as_str() {
            "PARAMETER" => Data::Parameters,
            "MATERIAL" => {
                let name = keyword.value("NAME").unwrap_or_default().to_string();
                self.materials.push(User { name, ..User::default() });
                Data::None
            }
            "USERMATERIAL" => self.user_material(keyword)?,
            "DEPVAR" => {
                let deletion = keyword.value("DELETE").map(|value| keyword.line.number("DELETE", value)).transpose()?;
                self.with_material(|material| material.deletion = deletion);
                Data::States
            }
            "DENSITY" => Data::Density,
            "ELEMENT" => {
                self.current = keyword.label("TYPE").unwrap_or_default();
                self.also = keyword.label("ELSET");
                Data::Elements
            }
            "ELSET" => {
                self.current = keyword.label("ELSET").unwrap_or_default();
                Data::Set(keyword.value("GENERATE").is_some())
            }
            "PART" | "ENDPART" => {
                self.resolve();
                Data::None
            }
            "STEP" => {
                let is = keyword.value("NLGEOM").is_some_and(|value| !value.eq_ignore_ascii_case("NO"));
                self.nonlinear = Some(self.nonlinear.unwrap_or(false) || is);
                Data::None
            }
            "INITIALCONDITIONS" => match (keyword.label("TYPE").as_deref(), keyword.value("USER")) {
                (Some("STRESS"), None) => Data::Stress,
                (Some("SOLUTION"), None) => Data::Solution,
                (Some("TEMPERATURE"), None) => Data::Field(0),
                (Some("FIELD"), None) => Data::Field(match keyword.value("VARIABLE") {
                    Some(value) => keyword.line.number("VARIABLE", value)?,
                    None => 1,
                }),
                _ => Data::None,
            },
            name if name.ends_with("SECTION") && keyword.value("COMPOSITE").is_some() => {
                self.current = keyword.label("ELSET").unwrap_or_default();
                Data::Layers
            }
            name if name.ends_with("SECTION") => {
                let response = keyword.label("RESPONSE").map(|response| response.replace(' ', ""));
                if name == "COHESIVESECTION" && response.is_none_or(|response| response != "TRACTIONSEPARATION") {
                    self.continua.extend(keyword.label("ELSET"));
                }
                if let (Some(material), Some(set)) = (keyword.label("MATERIAL"), keyword.label("ELSET")) {
                    self.sections.push((material, set, keyword.value("ORIENTATION").is_some()));
                }
                Data::None
            }
            _ => Data::None,
        };
        self.data = Some(data);
        Ok(data != Data::None)
    }

    fn data(&mut self, line: &Line<'_>) -> Result<(), Error> {
        if line.text.trim().is_empty() {
            return Ok(());
        }
        match self.data.unwrap_or(Data::None) {
            Data::None => {}
            Data::Parameters => {
                if let Some((name, value)) = line.text.split_once('=')
                    && let Ok(value) = line.real(name, value)
                {
                    self.parameters.insert(label(name.trim()), value);
                }
            }
            Data::Properties => {
                let values = self.numbers(line, 0)?;
                self.with_material(|material| material.properties.extend(values));
            }
            Data::States => {
                let states = count(line, "*DEPVAR", fields(line.text).next().unwrap_or_default())?;
                self.with_material(|material| material.states = states);
                // Further lines describe the variables.
                self.data = Some(Data::None);
            }
            Data::Density => {
                let density = self.numbers(line, 0)?.first().copied();
                self.with_material(|material| material.density = material.density.or(density));
                self.data = Some(Data::None);
            }
            Data::Elements => self.element(line),
            Data::Set(generated) => self.set(line, generated),
            Data::Stress | Data::Solution => self.initial(line)?,
            Data::Field(number) => {
                let value = self.numbers(line, 1)?.first().copied();
                self.fields.extend(value.map(|value| (number, value)));
            }
            // Thickness, points, material, angle.
            Data::Layers => {
                if let Some(material) = fields(line.text).nth(2).filter(|name| !name.is_empty()) {
                    self.sections.push((label(material), self.current.clone(), true));
                }
            }
        }
        Ok(())
    }
}

impl Deck {
    fn with_material(&mut self, set: impl FnOnce(&mut User)) {
        if let Some(material) = self.materials.last_mut() {
            set(material);
        }
    }

    fn user_material(&mut self, keyword: &Keyword<'_>) -> Result<Data, Error> {
        if keyword.label("TYPE").is_some_and(|kind| kind != "MECHANICAL") {
            return Ok(Data::None);
        }
        // Abaqus takes CONST too.
        let constants: usize = match keyword.value("CONSTANTS").or(keyword.value("CONST")) {
            Some(value) => count(&keyword.line, "CONSTANTS", value)?,
            None => return Err(keyword.line.error("*USER MATERIAL without CONSTANTS; allowed: CONSTANTS=NUMBER")),
        };
        let unsymmetric = keyword.value("UNSYMM").is_some();
        self.with_material(|material| {
            material.constants = Some(constants);
            material.unsymmetric = unsymmetric;
        });
        Ok(Data::Properties)
    }

    /// The numbers of a line behind its first fields; a name in angle brackets is a parameter.
    fn numbers(&self, line: &Line<'_>, skipped: usize) -> Result<Vec<f64>, Error> {
        let mut all: Vec<&str> = fields(line.text).skip(skipped).collect();
        if all.last().is_some_and(|last| last.is_empty()) {
            all.pop();
        }
        let number = |field: &str| match field.strip_prefix('<').and_then(|name| name.strip_suffix('>')) {
            Some(name) => self.parameters.get(&label(name.trim())).copied().ok_or_else(|| {
                line.error(&format!("<{name}> has no number; allowed: {name} = NUMBER behind *PARAMETER"))
            }),
            None => line.real("a number", field),
        };
        all.into_iter().map(number).collect()
    }

    fn element(&mut self, line: &Line<'_>) {
        let Some(Ok(number)) = fields(line.text).next().map(str::parse::<i64>) else { return };
        self.types.insert(number, self.current.clone());
        if let Some(set) = &self.also {
            self.sets.entry(set.clone()).or_default().push(number);
        }
    }

    fn set(&mut self, line: &Line<'_>, generated: bool) {
        let numbers: Vec<i64> = fields(line.text).filter_map(|field| field.parse().ok()).collect();
        // One of them is enough to find the type.
        let first = if generated { numbers.first().copied().into_iter().collect() } else { numbers };
        self.sets.entry(self.current.clone()).or_default().extend(first);
    }

    fn initial(&mut self, line: &Line<'_>) -> Result<(), Error> {
        let of = if self.data == Some(Data::Stress) { &self.stresses } else { &self.solutions };
        let first = fields(line.text).next().unwrap_or_default();
        // A line of numbers alone goes on with the one before; a set or an element's number begins.
        let goes_on = first.contains('.') && !of.is_empty();
        let values = self.numbers(line, usize::from(!goes_on))?;
        let of = if self.data == Some(Data::Stress) { &mut self.stresses } else { &mut self.solutions };
        match of.last_mut().filter(|_| goes_on) {
            Some((_, known)) => known.extend(values),
            None => of.push((label(first.rsplit('.').next().unwrap_or(first)), values)),
        }
        Ok(())
    }

    /// What the sections of a part say of the materials.
    fn resolve(&mut self) {
        for (material, set, oriented) in std::mem::take(&mut self.sections) {
            let numbers = self.sets.get(&set).and_then(|numbers| numbers.first());
            let mut element = numbers.and_then(|number| self.types.get(number)).cloned();
            if self.continua.contains(&set) {
                element = element.map(|element| format!("{element} without RESPONSE=TRACTION SEPARATION"));
            }
            self.used.push((material, set, oriented, element));
        }
        self.types.clear();
        self.sets.clear();
    }
}

/// The user materials of an input, laid over what else is known of each.
///
/// # Errors
/// The file cannot be read or is not valid, or it has no user material.
pub fn read(file: &Path, of: impl Fn(&str) -> Material, given: Given) -> Result<Vec<Material>, Error> {
    let name = file.display().to_string();
    let bytes = std::fs::read(file).map_err(|error| Error::Input(format!("{name}: {error}")))?;
    let mut deck = Deck::default();
    abaqus::read(&name, &text(&bytes), &mut deck)?;
    deck.resolve();
    for (material, set, oriented, element) in deck.used.clone() {
        if let Some(known) = deck.materials.iter_mut().find(|known| label(&known.name) == material) {
            known.orientation |= oriented;
            known.element = known.element.take().or(element);
            known.set = Some(set);
        }
    }
    let users: Vec<&User> = deck.materials.iter().filter(|material| material.constants.is_some()).collect();
    if users.is_empty() {
        return Err(Error::Input(format!("{name}: no *USER MATERIAL; allowed: an input with one or several")));
    }
    users.into_iter().map(|user| deck.material(&name, user, of(&user.name), given)).collect()
}

/// What the arguments of the command say already.
#[derive(Clone, Copy, Debug, Default)]
pub struct Given {
    pub properties: bool,
    pub states: bool,
    pub components: bool,
}

impl Deck {
    fn material(&self, file: &str, user: &User, known: Material, given: Given) -> Result<Material, Error> {
        let mut material = known;
        material.name.clone_from(&user.name);
        material.deck = Some(file.to_string());
        material.unsymmetric = Some(user.unsymmetric);
        // Without NLGEOM nothing turns, which is as if the axes turned along.
        material.small_strain |= self.nonlinear == Some(false);
        material.orientation |= user.orientation || material.small_strain;
        if !given.properties {
            let constants = user.constants.unwrap_or(0);
            material.remarks.extend(
                (user.properties.len() != constants)
                    .then(|| format!("CONSTANTS is {constants}, and there are {} numbers", user.properties.len())),
            );
            material.properties.clone_from(&user.properties);
            material.properties.resize(constants, 0.0);
        }
        if !given.states {
            material.initial.resize(user.states, 0.0);
        }
        let of_set = |all: &[(String, Vec<f64>)]| {
            all.iter()
                .find(|(set, _)| user.set.as_ref() == Some(set) || all.len() == 1)
                .map(|(_, values)| values.clone())
        };
        if let Some(values) = of_set(&self.solutions) {
            for (state, value) in material.initial.iter_mut().zip(values) {
                *state = value;
            }
        }
        for number in 0..=MOST_FIELDS {
            let mut values = self.fields.iter().filter(|(of, _)| *of == number).map(|(_, value)| *value);
            // Nodes are not followed to materials: where they differ nothing is known.
            let Some(value) = values.next().filter(|first| values.all(|other| other == *first)) else { continue };
            match number {
                0 => material.temperature = value,
                _ => {
                    material.fields.resize(material.fields.len().max(number), 0.0);
                    material.fields[number - 1] = value;
                }
            }
        }
        if let Some(element) = user.element.as_deref().filter(|_| !given.components) {
            (material.components, material.plane) = of_element(element).ok_or_else(|| {
                let allowed = "solids, plane, axisymmetric, shell and membrane elements, trusses, or --ntens";
                Error::Input(format!("{file}: {} is of {element}; allowed: {allowed}", user.name))
            })?;
            let is_cohesive = element.starts_with("COH");
            if is_cohesive != material.separation.is_some() {
                let allowed = "the largest separation with cohesive elements, and with no others (--separation)";
                return Err(Error::Input(format!("{file}: {} is of {element}; allowed: {allowed}", user.name)));
            }
        }
        if let Some(values) = of_set(&self.stresses) {
            for (stress, value) in material.stress.iter_mut().zip(values) {
                *stress = value;
            }
        }
        material.explicit.density = user.density.filter(|density| *density > 0.0).unwrap_or(material.explicit.density);
        material.explicit.deletion = user.deletion.or(material.explicit.deletion);
        if let Some(deletion) = material.explicit.deletion.filter(|deletion| *deletion > material.initial.len()) {
            let allowed = format!("1 to {}", material.initial.len());
            return Err(Error::Input(format!("{file}: DELETE is {deletion} in {}; allowed: {allowed}", user.name)));
        }
        Ok(material)
    }
}

/// NTENS of an element's type, and of four components which they are.
fn of_element(name: &str) -> Option<(usize, Option<Plane>)> {
    let begins = |letters: &[&str]| letters.iter().any(|letters| name.starts_with(letters));
    if begins(&["CPE", "CGPE"]) {
        Some((4, Some(Plane::Strain)))
    } else if begins(&["CAX"]) {
        Some((4, Some(Plane::Axisymmetric)))
    } else if begins(&["CPS", "S3", "S4", "S8", "SC", "STRI", "M3D"]) {
        Some((3, None))
    } else if begins(&["B3", "PIPE", "SAXA", "MGAX"]) || name.contains(' ') {
        None
    } else if begins(&["COH3D"]) {
        Some((3, None))
    } else if begins(&["COH", "SAX", "MAX"]) {
        Some((2, None))
    } else if begins(&["T2", "T3", "B2"]) {
        Some((1, None))
    } else {
        // Solids, and what a user element may be.
        Some((6, None))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_layer_of_a_shell_is_in_plane_stress() {
        let mut deck = Deck::default();
        let text = "*Element, type=S4R, elset=PLY\n1, 1, 2, 3, 4\n*Shell Section, elset=PLY, composite\n0.2, 3, UD, 45., Ply-1\n";
        abaqus::read("deck.inp", text, &mut deck).expect("valid");
        deck.resolve();
        let [(material, _, oriented, element)] = &deck.used[..] else { panic!("one layer") };
        assert_eq!(
            (material.as_str(), *oriented, element.as_deref().and_then(of_element)),
            ("UD", true, Some((3, None)))
        );
        assert_eq!(
            ["COH3D8", "T3D2", "SAX1", "B31"].map(of_element),
            [Some((3, None)), Some((1, None)), Some((2, None)), None]
        );
    }

    #[test]
    fn counts_are_bounded() {
        for (text, message) in [
            ("*Material, name=A\n*Depvar\n100001,\n", "deck.inp:3: *DEPVAR is 100001; allowed: 0 to 100000"),
            ("*User Material, constants=999999999999\n", "deck.inp:1: CONSTANTS is 999999999999; allowed: 0 to 100000"),
        ] {
            let error = abaqus::read("deck.inp", text, &mut Deck::default()).expect_err(text);
            assert_eq!(error.to_string(), message);
        }
    }

    /// Some public inputs have FILE=.
    #[test]
    fn an_include_is_named_by_input() {
        let error = abaqus::read("deck.inp", "*Include, file=sec.inp\n", &mut Deck::default()).expect_err("refused");
        assert!(error.to_string().contains("allowed: INPUT=, as Abaqus's manual has it"), "{error}");
    }

    #[test]
    fn a_deck_says_what_its_materials_are() {
        let deck = "*Parameter\nBULK = 20.\n*Part, name=P\n*Element, type=CPE4R\n7, 1, 2, 3, 4\n*Elset, elset=ALL, generate\n\
                    7, 7, 1\n*Solid Section, elset=ALL, material=Soft, orientation=O\n,\n*End Part\n*Material, name=SOFT\n\
                    *Density\n7.8e-9,\n*Depvar, delete=2\n3,\n1, A, \"first\"\n*User Material, const=2, unsymm\n0.8, <BULK>\n\
                    *Initial Conditions, type=FIELD, variable=2\nI.LEFT, 5.\nI.RIGHT, 5.\n\
                    *Initial Conditions, type=TEMPERATURE\nI.LEFT, 5.\nI.RIGHT, 6.\n\
                    *Initial Conditions, type=STRESS\nI.ALL, -1., -2., -3.\n*Initial Conditions, type=SOLUTION\nI.ALL, 4., 5.\n\
                    *Step, nlgeom=YES\n*Static\n*End Step\n";
        let file = std::env::temp_dir().join(format!("umat-check-{}.inp", std::process::id()));
        std::fs::write(&file, deck).expect("a file");
        let materials = read(&file, |_| Material::default(), Given::default());
        std::fs::remove_file(&file).expect("it is there");
        let material = &materials.expect("valid")[0];
        assert_eq!((material.name.as_str(), &material.properties[..]), ("SOFT", &[0.8, 20.0][..]));
        assert_eq!((material.initial.clone(), material.explicit.deletion), (vec![4.0, 5.0, 0.0], Some(2)));
        assert_eq!((material.components, material.plane), (4, Some(Plane::Strain)));
        assert_eq!((material.stress[2], material.explicit.density), (-3.0, 7.8e-9));
        assert_eq!((&material.fields[..], material.temperature), (&[0.0, 5.0][..], 0.0));
        assert!(material.orientation && material.unsymmetric == Some(true));
    }
}
