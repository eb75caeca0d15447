//! The input of a check: a file in TOML, and the arguments of the command, which replace its keys.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use toron_shared::spanned::Spanned;

use super::expect::Expected;
use super::expect_keys::{self, Expect};
use super::finding::Question;
use super::inp::{self, Given};
use super::material::{DEFAULT_NAME, Explicit, LARGEST_SEPARATION, MOST_FIELDS, Material, Plane, Traits};
use toron_shared::checked::{Checked, Positive, value};
use toron_shared::error::Error;
use toron_shared::toml_file::{Source, read};

/// The keys of a file.
#[derive(Clone, Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct File {
    /// CMNAME, up to 80 ASCII characters. Default: `MATERIAL`.
    name: Option<Spanned<String>>,
    /// PROPS. Default: none.
    properties: Option<Vec<f64>>,
    /// NSTATV, up to 100000. Default: as many as `initial` has.
    statev: Option<usize>,
    /// STATEV at the beginning; SDVINI is called, and UEXTERNALDB before all. Default: 0.
    initial: Option<Spanned<Vec<f64>>>,
    /// STRESS at the beginning, as many as `ntens`; SIGINI is called. Default: 0.
    stress: Option<Spanned<Vec<f64>>>,
    /// NTENS: 6 (solids), 4 (plane strain, axisymmetric), 3 (plane stress), 2 (shells of revolution), 1 (trusses);
    /// with `separation` 3 (COH3D), 2 (COH2D, COHAX), 1. Default: 6.
    ntens: Option<Spanned<usize>>,
    /// What elements have four components. Default: a strain 33 is asked too, and only warned of.
    plane: Option<Plane>,
    /// The range of principal stretches, lowest and highest: what the law is for. Default: `[0.9, 1.1]`.
    stretch: Option<Spanned<Vec<f64>>>,
    /// The largest separation of a cohesive element, as STRAN has it. Default: none.
    separation: Option<Positive>,
    /// The norm of the logarithmic strain of one increment; with `separation` of the separation. Default: 0.01.
    increment: Option<Positive>,
    /// TEMP. Default: 0.
    temperature: Option<Spanned<f64>>,
    /// PREDEF, up to eight; DPRED is 0. Default: none.
    fields: Option<Spanned<Vec<f64>>>,
    /// DTIME. Default: 1.
    dtime: Option<Positive>,
    /// What you promise of the law: `"hyperelastic"`, `"dissipative"`, `"isotropic"`. Default: none.
    traits: Option<Spanned<Vec<String>>>,
    /// As with `*ORIENTATION`: axes that turn with the material, DROT = 1. Default: `false`.
    orientation: Option<bool>,
    /// `false` where the job is geometrically linear: strains add up. Default: `true`.
    nlgeom: Option<bool>,
    /// Directions of three numbers in the reference configuration. Default: none.
    fibres: Option<Spanned<Vec<Vec<f64>>>>,
    /// The seed of the random states. Default: 1.
    seed: Option<u64>,
    /// Of a VUMAT: of the undeformed material. Default: 2, by which energies per mass and per volume are told apart.
    density: Option<Positive>,
    /// Of a VUMAT: DELETE of `*DEPVAR`, the state variable that is 0 where the point is deleted. Default: none.
    deletion: Option<Spanned<usize>>,
    /// Of a VUMAT: what defgradOld and defgradNew are, R U (`"RU"`) or U (`"U"`). Default: `"RU"`.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["RU", "U"])))]
    defgrad: Option<Spanned<String>>,
    /// [Known answers](reference/check-lines.md#expect). Default: none.
    #[serde(default)]
    expect: Vec<Expect>,
    /// By the name of a line: the figure up to which it is a warning. Default: none.
    #[serde(default)]
    allow: BTreeMap<String, Spanned<Positive>>,
    /// Several [materials](reference/check-lines.md#material) in one file. Default: one, of the keys above.
    #[serde(default, rename = "material")]
    materials: Vec<MaterialKeys>,
}

/// The keys of one of several materials.
#[derive(Clone, Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
struct MaterialKeys {
    /// Default: that of the file.
    name: Option<Spanned<String>>,
    /// Default: those of the file.
    properties: Option<Vec<f64>>,
    /// Default: that of the file.
    statev: Option<usize>,
    /// Default: that of the file.
    initial: Option<Spanned<Vec<f64>>>,
    /// Default: those of the file.
    traits: Option<Spanned<Vec<String>>>,
    /// Default: those of the file.
    fibres: Option<Spanned<Vec<Vec<f64>>>>,
}

/// Arguments of the command that replace keys of the file.
#[derive(Clone, Debug, Default)]
pub struct Overrides {
    pub properties: Option<Vec<f64>>,
    pub states: Option<usize>,
    pub components: Option<usize>,
    pub separation: Option<f64>,
    pub plane: Option<Plane>,
    pub traits: Option<Vec<String>>,
    pub name: Option<String>,
    pub orientation: bool,
    pub seed: Option<u64>,
    /// An input of Abaqus.
    pub deck: Option<PathBuf>,
}

/// Materials, and how wrong which line may be.
#[derive(Debug)]
pub struct Input {
    pub materials: Vec<Material>,
    pub allowed: BTreeMap<String, f64>,
}

/// Longest CMNAME.
const LONGEST_NAME: usize = 80;
/// The largest count of STATEV's entries, and of a card's constants, that is allowed.
pub(crate) const MOST_STATES: usize = 100_000;

/// Reads the file, if there is one: the one named, or the one beside the law.
///
/// # Errors
/// It cannot be read, or says what is not allowed.
pub fn input(law: &Path, file: Option<&Path>, overrides: &Overrides) -> Result<Input, Error> {
    let beside = law.with_extension("toml");
    let file: Option<PathBuf> = file.map(Path::to_path_buf).or_else(|| beside.is_file().then_some(beside));
    let (name, text) = match &file {
        Some(file) => read(file)?,
        None => ("the arguments".to_string(), String::new()),
    };
    let mut input = parse(&Source { name: &name, text: &text }, overrides)?;
    if let Some(deck) = &overrides.deck {
        let given = Given {
            properties: overrides.properties.is_some(),
            states: overrides.states.is_some(),
            components: overrides.components.is_some(),
        };
        let known = input.materials;
        let of = |name: &str| {
            let same = known.iter().find(|material| material.name.eq_ignore_ascii_case(name));
            same.or(known.first()).cloned().unwrap_or_default()
        };
        input.materials = inp::read(deck, of, given)?;
        if let Some(name) = &overrides.name {
            input.materials.retain(|material| material.name.eq_ignore_ascii_case(name));
            if input.materials.is_empty() {
                return Err(Error::Input(format!("{}: no user material {name}", deck.display())));
            }
        }
    }
    for material in &mut input.materials {
        // The axes of a truss or of a shell of revolution are its own.
        material.orientation |= material.is_diagonal();
    }
    Ok(input)
}

fn parse(source: &Source, overrides: &Overrides) -> Result<Input, Error> {
    let file: File = source.parse()?;
    let mut allowed = BTreeMap::new();
    for (key, value) in &file.allow {
        if Question::parse(key).is_none() {
            let names = Question::names();
            return Err(source.error(value.span(), &format!("allow has {key}; allowed: {names}")));
        }
        allowed.insert(key.clone(), value.value());
    }
    let owns = if file.materials.is_empty() { vec![MaterialKeys::default()] } else { file.materials.clone() };
    let materials: Result<Vec<Material>, Error> =
        owns.iter().map(|own| material(source, &file, own, overrides)).collect();
    let mut materials = materials?;
    for material in &mut materials {
        let mut given = file.expect.iter();
        let is_of_it =
            |expect: &Expect| expect.material.as_ref().is_none_or(|name| name.eq_ignore_ascii_case(&material.name));
        material.expected.retain(|_| given.next().is_some_and(is_of_it));
    }
    Ok(Input { materials, allowed })
}

fn material(source: &Source, file: &File, own: &MaterialKeys, overrides: &Overrides) -> Result<Material, Error> {
    let components = match (overrides.components, &file.ntens) {
        (Some(components), _) => allowed_components(components).map_err(Error::Input)?,
        (None, Some(ntens)) => {
            allowed_components(*ntens.get_ref()).map_err(|message| source.error(ntens.span(), &message))?
        }
        (None, None) => 6,
    };
    let separation = separation(source, file, components, overrides)?;
    let name = match (&overrides.name, own.name.as_ref().or(file.name.as_ref())) {
        (Some(name), _) => allowed_name(name).map_err(Error::Input)?,
        (None, Some(name)) => allowed_name(name.get_ref()).map_err(|message| source.error(name.span(), &message))?,
        (None, None) => DEFAULT_NAME.to_string(),
    };
    let initial = initial_state(source, file, own, overrides)?;
    let properties =
        overrides.properties.clone().or(own.properties.clone()).or(file.properties.clone()).unwrap_or_default();
    let key = if overrides.properties.is_some() { "--props" } else { &format!("{}: properties", source.name) };
    all_finite(key, &properties)?;
    all_finite(&format!("{}: initial", source.name), &initial)?;
    let stretch = match &file.stretch {
        _ if separation.is_some() => [(-LARGEST_SEPARATION).exp(), LARGEST_SEPARATION.exp()],
        None => [0.9, 1.1],
        Some(stretch) => match stretch.get_ref()[..] {
            [low, high] if low > 0.0 && low <= 1.0 && high >= 1.0 && low < high && high.is_finite() => [low, high],
            _ => {
                let message = "stretch is not a range; allowed: [lowest, highest] with 0 < lowest <= 1 <= highest";
                return Err(source.error(stretch.span(), message));
            }
        },
    };
    Ok(Material {
        name,
        properties,
        stress: initial_stress(source, file.stress.as_ref(), components)?,
        components,
        stretch,
        separation,
        increment: match (value(&file.increment), separation) {
            (Some(increment), Some(largest)) => increment * LARGEST_SEPARATION / largest,
            (given, _) => given.unwrap_or(0.01),
        },
        temperature: match &file.temperature {
            Some(value) => source.finite("temperature", *value.get_ref(), value.span())?,
            None => 0.0,
        },
        fields: fields(source, file.fields.as_ref())?,
        time_step: value(&file.dtime).unwrap_or(1.0),
        traits: traits(source, own.traits.as_ref().or(file.traits.as_ref()), overrides)?,
        plane: overrides.plane.or(file.plane),
        orientation: overrides.orientation || file.orientation.unwrap_or(false) || file.nlgeom == Some(false),
        small_strain: file.nlgeom == Some(false),
        fibres: fibres(source, own.fibres.as_ref().or(file.fibres.as_ref()))?,
        seed: overrides.seed.or(file.seed).unwrap_or(1),
        explicit: explicit(source, file, initial.len())?,
        initial,
        deck: None,
        unsymmetric: None,
        remarks: Vec::new(),
        symbol: None,
        expected: known_answers(source, file, components)?,
    })
}

/// The largest separation of a cohesive element.
fn separation(source: &Source, file: &File, components: usize, overrides: &Overrides) -> Result<Option<f64>, Error> {
    let separation = overrides.separation.or(value(&file.separation));
    let key = if overrides.separation.is_some() { "separation" } else { &format!("{}: separation", source.name) };
    match separation {
        Some(largest) if !(largest > 0.0 && largest.is_finite()) => {
            Err(Error::Input(format!("{key} is {largest}; allowed: a finite number > 0")))
        }
        Some(largest) if components > 3 && overrides.deck.is_none() => Err(Error::Input(format!(
            "{key} is {largest}, and ntens {components}; allowed with ntens 3 (COH3D), 2 (COH2D, COHAX) and 1"
        ))),
        given => Ok(given),
    }
}

/// STATEV at the beginning.
fn initial_state(source: &Source, file: &File, own: &MaterialKeys, overrides: &Overrides) -> Result<Vec<f64>, Error> {
    let given = own.initial.as_ref().or(file.initial.as_ref());
    let mut initial = given.map_or(Vec::new(), |initial| initial.get_ref().clone());
    let states = overrides.states.or(own.statev).or(file.statev).unwrap_or(initial.len());
    if states > MOST_STATES {
        let key = if overrides.states.is_some() { "statev" } else { &format!("{}: statev", source.name) };
        return Err(Error::Input(format!("{key} is {states}; allowed: 0 to {MOST_STATES}")));
    }
    if let Some(given) = given
        && states < initial.len()
    {
        if overrides.states.is_none() {
            let message = format!("initial has {} numbers; allowed: up to {states}, as statev says", initial.len());
            return Err(source.error(given.span(), &message));
        }
        initial.truncate(states);
    }
    initial.resize(states, 0.0);
    Ok(initial)
}

fn known_answers(source: &Source, file: &File, components: usize) -> Result<Vec<Expected>, Error> {
    file.expect.iter().map(|given| expect_keys::expected(source, given, components)).collect()
}

fn initial_stress(source: &Source, given: Option<&Spanned<Vec<f64>>>, components: usize) -> Result<[f64; 6], Error> {
    let mut stress = [0.0; 6];
    if let Some(given) = given {
        if given.get_ref().len() != components || given.get_ref().iter().any(|value| !value.is_finite()) {
            let message = format!("stress has {} numbers; allowed: {components} finite ones", given.get_ref().len());
            return Err(source.error(given.span(), &message));
        }
        stress[..components].copy_from_slice(given.get_ref());
    }
    Ok(stress)
}

fn fields(source: &Source, given: Option<&Spanned<Vec<f64>>>) -> Result<Vec<f64>, Error> {
    let Some(given) = given else { return Ok(Vec::new()) };
    let fields = given.get_ref();
    if fields.len() > MOST_FIELDS || fields.iter().any(|field| !field.is_finite()) {
        let message = format!("fields has {} numbers; allowed: up to {MOST_FIELDS} finite ones", fields.len());
        return Err(source.error(given.span(), &message));
    }
    Ok(fields.clone())
}

fn all_finite(key: &str, numbers: &[f64]) -> Result<(), Error> {
    match numbers.iter().position(|number| !number.is_finite()) {
        Some(at) => Err(Error::Input(format!("{key}: number {} is {}; allowed: finite numbers", at + 1, numbers[at]))),
        None => Ok(()),
    }
}

fn allowed_name(name: &str) -> Result<String, String> {
    if name.len() > LONGEST_NAME || !name.is_ascii() {
        return Err(format!("name is \"{name}\"; allowed: up to {LONGEST_NAME} ASCII characters"));
    }
    Ok(name.to_string())
}

/// Not 1, by which energies per mass and per volume are told apart.
const DENSITY: f64 = 2.0;

fn explicit(source: &Source, file: &File, states: usize) -> Result<Explicit, Error> {
    if let Some(deletion) = &file.deletion
        && !(1..=states).contains(deletion.get_ref())
    {
        let message = format!("deletion is {}; allowed: a state variable, 1 to {states}", deletion.get_ref());
        return Err(source.error(deletion.span(), &message));
    }
    let stretch_alone = match &file.defgrad {
        None => false,
        Some(frame) => match frame.get_ref().as_str() {
            "RU" => false,
            "U" => true,
            other => return Err(source.error(frame.span(), &format!("defgrad is \"{other}\"; allowed: \"RU\", \"U\""))),
        },
    };
    let deletion = file.deletion.as_ref().map(|deletion| *deletion.get_ref());
    let density = value(&file.density).unwrap_or(DENSITY);
    Ok(Explicit { called: false, density, deletion, stretch_alone, single: None })
}

fn allowed_components(components: usize) -> Result<usize, String> {
    match components {
        6 | 4 | 3 | 2 | 1 => Ok(components),
        _ => Err(format!(
            "ntens is {components}; allowed: 6 (solids), 4 (plane strain, axisymmetric), 3 (plane stress), 2 \
             (shells of revolution: 11 and 22), 1 (trusses), 3 and 2 of cohesive elements too (separation); the extra equation of \
             hybrid elements and UVARM are not checked"
        )),
    }
}

fn traits(source: &Source, file: Option<&Spanned<Vec<String>>>, overrides: &Overrides) -> Result<Traits, Error> {
    let mut traits = Traits::default();
    let unknown = |name: &str| format!("trait \"{name}\"; allowed: {}", Traits::ALLOWED);
    if let Some(names) = &overrides.traits {
        for name in names {
            if !traits.declare(name) {
                return Err(Error::Input(unknown(name)));
            }
        }
        return Ok(traits);
    }
    let Some(names) = file else { return Ok(traits) };
    for name in names.get_ref() {
        if !traits.declare(name) {
            return Err(source.error(names.span(), &unknown(name)));
        }
    }
    Ok(traits)
}

fn fibres(source: &Source, fibres: Option<&Spanned<Vec<Vec<f64>>>>) -> Result<Vec<[f64; 3]>, Error> {
    let Some(fibres) = fibres else { return Ok(Vec::new()) };
    let direction = |numbers: &Vec<f64>| {
        let direction = <[f64; 3]>::try_from(numbers.clone()).ok()?;
        let length = direction.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
        (length.is_finite() && length > 0.0).then(|| direction.map(|entry| entry / length))
    };
    let all = fibres.get_ref().iter().map(direction).collect::<Option<Vec<_>>>();
    all.ok_or_else(|| source.error(fibres.span(), "a fibre is no direction; allowed: three numbers, not all 0"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<Input, String> {
        parse(&Source { name: "law.toml", text }, &Overrides::default()).map_err(|error| error.to_string())
    }

    #[test]
    fn keys_of_the_file_and_of_its_materials() {
        let input = of("statev = 3\ntraits = [\"isotropic\"]\n[allow]\ntangent = 0.05\n[[material]]\nname = \"A\"\n\
                        properties = [1.0]\n[[material]]\nname = \"B\"\nproperties = [2.0]\ninitial = [1.0, 2.0]\n")
        .expect("valid");
        assert_eq!(input.materials.len(), 2);
        assert_eq!(input.materials[1].initial, [1.0, 2.0, 0.0]);
        assert!(input.materials[0].traits.isotropic && input.allowed["tangent"] == 0.05);
    }

    #[test]
    fn what_is_not_allowed_is_named() {
        for (text, message) in [
            ("ntens = 5", "law.toml:1: ntens is 5; allowed: 6 (solids)"),
            ("\nstretch = [1.1, 1.2]", "law.toml:2: stretch is not a range"),
            ("traits = [\"elastic\"]", "law.toml:1: trait \"elastic\"; allowed: hyperelastic"),
            ("fibres = [[0.0, 0.0, 0.0]]", "law.toml:1: a fibre is no direction"),
            ("statev = 1\ninitial = [1.0, 2.0]", "law.toml:2: initial has 2 numbers"),
            ("[allow]\ntangents = 1.0", "law.toml:2: allow has tangents; allowed: build, deck, memory, rest"),
            ("properties = [1.0, nan]", "law.toml: properties: number 2 is NaN; allowed: finite numbers"),
            ("initial = [inf]", "law.toml: initial: number 1 is inf; allowed: finite numbers"),
            ("statev = 100001", "law.toml: statev is 100001; allowed: 0 to 100000"),
            ("separation = 0.1", "law.toml: separation is 0.1, and ntens 6; allowed with ntens 3"),
            ("deletion = 1", "law.toml:1: deletion is 1; allowed: a state variable, 1 to 0"),
            ("defgrad = \"R\"", "law.toml:1: defgrad is \"R\"; allowed: \"RU\", \"U\""),
            ("[[expect]]\nstrain = [0.1]\nstress = [1.0]", "law.toml:2: strain is no path; allowed: 6 numbers"),
            (
                "[[expect]]\nstrain = [0, 0, 0, 0, 0, 0]\nstress = [1.0, 0, 0, 0, 0, 0]",
                "law.toml:3: a known answer without source",
            ),
            ("fields = [1, 2, 3, 4, 5, 6, 7, 8, 9]", "law.toml:1: fields has 9 numbers; allowed: up to 8"),
            ("dtime = 0.0", "law.toml:1: dtime is 0.0; allowed: a finite number > 0"),
        ] {
            let error = of(text).expect_err(text);
            assert!(error.starts_with(message), "{error}");
        }
    }
}
