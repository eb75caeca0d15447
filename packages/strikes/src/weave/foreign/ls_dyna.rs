//! LS-DYNA keyword files: `*NODE`, `*ELEMENT_SOLID` or `*ELEMENT_SOLID_ORTHO`, a yarn for each part.

use std::collections::HashMap;

use super::raw::{Numbered, Raw};
use toron_shared::error::Error;
use toron_shared::keyword_file::line::{Line, Place};
use toron_shared::keyword_file::ls_dyna::{self, Card, Keyword, Transform};

const PARTS: &str = "elements of a part";

/// Keywords that change neither nodes nor solid elements nor the fibres in them, by how they begin: laws, sections,
/// contacts, loads, controls, results, curves, coordinate systems and sets that something else has to name, and
/// elements that are no solids, which are the striker's or a clamp's.
const WITHOUT_EFFECT: [&str; 48] = [
    "*TITLE",
    "*COMMENT",
    "*PARAMETER",
    "*DATABASE_",
    "*TERMINATION_",
    "*INTERFACE_",
    "*EOS_",
    "*HOURGLASS",
    "*DAMPING_",
    "*SECTION_",
    "*INTEGRATION_",
    "*PART_INERTIA",
    "*PART_CONTACT",
    "*PART_PRINT",
    "*PART_ATTACHMENT_NODES",
    "*ELEMENT_SHELL",
    "*ELEMENT_BEAM",
    "*ELEMENT_DISCRETE",
    "*ELEMENT_MASS",
    "*ELEMENT_INERTIA",
    "*ELEMENT_SEATBELT",
    "*ELEMENT_PLOTEL",
    "*SET_",
    "*BOUNDARY_",
    "*CONSTRAINED_",
    "*CONTACT",
    "*FRICTION",
    "*RIGIDWALL_",
    "*LOAD_",
    "*INITIAL_VELOCITY",
    "*INITIAL_STRESS_",
    "*INITIAL_STRAIN_",
    "*INITIAL_TEMPERATURE",
    "*SENSOR_",
    "*USER_",
    "*MODULE",
    "*DEFINE_CURVE",
    "*DEFINE_TABLE",
    "*DEFINE_FUNCTION",
    "*DEFINE_COORDINATE_",
    "*DEFINE_VECTOR",
    "*DEFINE_SD_ORIENTATION",
    "*DEFINE_BOX",
    "*DEFINE_PLANE",
    "*DEFINE_FRICTION",
    "*DEFINE_TRANSFORMATION",
    "*DEFINE_CONTACT_",
    "*DEFINE_MATERIAL_HISTORIES",
];
/// Of `*CONTROL_…` by their whole names, those with _ at the end by how they begin: others refine, move or delete what
/// is there.
const CONTROLS: &str = "
    ACCURACY ACOUSTIC_ ALE BULK_VISCOSITY CHECK_SHELL CONTACT COUPLING CPM CPU DEBUG DISCRETE_ELEMENT DYNAMIC_RELAXATION EFG ENERGY
    EOS_USER_LIBRARY EXPLICIT_THERMAL_ EXPLOSIVE_SHADOW FREQUENCY_ HOURGLASS IMPLICIT_ LSDA MAT MPP_ NONLOCAL OUTPUT PARALLEL
    PORE_FLUID PZELECTRIC REQUIRE_REVISION RIGID SEGMENTS_IN_ALE_COUPLING SHELL SOLID SOLUTION SPH SPH_INCOMPRESSIBLE SPOTWELD_BEAM
    STAGED_CONSTRUCTION START STEADY_STATE_ROLLING STRUCTURED STRUCTURED_TERM SUBCYCLE SUBCYCLE_ TERMINATION THERMAL_ TIMESTEP UNITS
    VIBRO_ACOUSTIC";
/// Of `*MAT_…` those without axes, by name and number: by its AOPT any other one may turn the fibres.
const WITHOUT_AXES: &str = "
    ADD_EROSION 1 ELASTIC ELASTIC_FLUID 3 PLASTIC_KINEMATIC 4 ELASTIC_PLASTIC_THERMAL 5 SOIL_AND_FOAM 6 VISCOELASTIC 7 BLATZ-KO_RUBBER
    9 NULL 10 ELASTIC_PLASTIC_HYDRO 12 ISOTROPIC_ELASTIC_PLASTIC 13 ISOTROPIC_ELASTIC_FAILURE 15 JOHNSON_COOK 18 POWER_LAW_PLASTICITY
    19 STRAIN_RATE_DEPENDENT_PLASTICITY 20 RIGID 24 PIECEWISE_LINEAR_PLASTICITY 27 MOONEY-RIVLIN_RUBBER 57 LOW_DENSITY_FOAM
    63 CRUSHABLE_FOAM OGDEN_RUBBER 81 PLASTICITY_WITH_DAMAGE 98 SIMPLIFIED_JOHNSON_COOK 110 JOHNSON_HOLMQUIST_CERAMICS
    111 JOHNSON_HOLMQUIST_CONCRETE 123 MODIFIED_PIECEWISE_LINEAR_PLASTICITY";
/// What is in the names of contacts that put nodes onto the surface to which they are tied, unless with an offset.
const TIED: [&str; 2] = ["TIED", "SPOTWELD"];

/// # Errors
/// What in the file is wrong, by line.
pub fn read(file: &str, text: &str) -> Result<Raw, Error> {
    let mut reader = Reader { offsets: vec![[0; 3]], ..Reader::default() };
    ls_dyna::read(file, text, &mut reader)?;
    reader.finish()
}

#[derive(Default)]
struct Reader {
    mesh: Numbered,
    /// The number of an element's part, in the order of the elements.
    part: Vec<u64>,
    directions: Vec<Option<[f64; 3]>>,
    /// Titles of parts by their numbers, and where they are.
    titles: Vec<(u64, String, Place)>,
    /// Elements that are no solids have parts too.
    others: bool,
    next: Next,
    /// Where the element began that was read last.
    last: Option<Place>,
    /// What is added to the numbers of nodes, elements and parts, file by file.
    offsets: Vec<[i64; 3]>,
    /// The first material that may give elements other fibres than they have by themselves.
    axes: Option<Error>,
}

/// What the next card is.
#[derive(Clone, Default)]
enum Next {
    #[default]
    Node,
    /// The first card of an element, and whether two of axes follow its nodes.
    Element(bool),
    NodesOf(u64, bool),
    Fibre,
    Second,
    Title,
    Part(String),
    Material(Orthotropic),
    /// Cards that nothing is read from.
    Passed,
}

/// The next card of a material whose AOPT is read.
#[derive(Clone, Copy)]
enum Orthotropic {
    /// This one is a title.
    Titled(&'static Orthotropic),
    /// So many cards before the one with AOPT, and its field there.
    Before(usize, usize),
    /// The first card of a user's law, which says whether there is an AOPT.
    User,
}

/// A material's cards by its name behind `*MAT_`; none that are read where it has no axes.
///
/// # Errors
/// It may have axes, and they are not read.
fn material(name: &str) -> Result<Option<Orthotropic>, ()> {
    let (name, is_titled) = name.strip_suffix("_TITLE").map_or((name, false), |name| (name, true));
    let name = name.trim_start_matches('0');
    let orthotropic = match name {
        "2" | "ORTHOTROPIC_ELASTIC" => &Orthotropic::Before(1, 3),
        "41" | "42" | "43" | "44" | "45" | "46" | "47" | "48" | "49" | "50" | "USER_DEFINED_MATERIAL_MODELS" => {
            &Orthotropic::User
        }
        _ if WITHOUT_AXES.split_whitespace().any(|known| known == name) => return Ok(None),
        _ => return Err(()),
    };
    Ok(Some(if is_titled { Orthotropic::Titled(orthotropic) } else { *orthotropic }))
}

impl ls_dyna::Reader for Reader {
    fn keyword(&mut self, keyword: &Keyword<'_>) -> Result<bool, Error> {
        self.check_last()?;
        let name = keyword.name.as_str();
        self.next = match name {
            "*NODE" => Next::Node,
            "*ELEMENT_SOLID" => Next::Element(false),
            "*ELEMENT_SOLID_ORTHO" => Next::Element(true),
            "*PART" => Next::Title,
            _ if name.starts_with("*MAT_") => match material(&name["*MAT_".len()..]) {
                Ok(cards) => cards.map_or(Next::Passed, Next::Material),
                Err(()) => {
                    self.turns_fibres(&keyword.line, &format!("{name}, whose AOPT is not read"));
                    Next::Passed
                }
            },
            _ => {
                if !WITHOUT_EFFECT.iter().any(|begin| name.starts_with(begin)) && !is_control(name) {
                    let message = format!(
                        "{name}; allowed: *ELEMENT_SOLID and *ELEMENT_SOLID_ORTHO, *NODE, *PART, *INCLUDE, *INCLUDE_TRANSFORM, and \
                         keywords that leave nodes, elements and fibres as they are"
                    );
                    return Err(keyword.line.error(&message));
                }
                let is_tied = name.starts_with("*CONTACT") && TIED.iter().any(|tied| name.contains(tied));
                if is_tied && !name.contains("OFFSET") {
                    let message = format!("{name}, which moves nodes; allowed: tied contacts with OFFSET");
                    return Err(keyword.line.error(&message));
                }
                self.others |= name.starts_with("*ELEMENT") || name.starts_with("*PART");
                return Ok(false);
            }
        };
        Ok(true)
    }

    fn card(&mut self, card: &Card<'_>) -> Result<(), Error> {
        let line = &card.line;
        self.next = match std::mem::take(&mut self.next) {
            next @ (Next::Node | Next::Element(_)) if card.is_blank() => next,
            Next::Node => {
                let [number, x, y, z] = card.fields([8, 16, 16, 16])?;
                let place = [line.real("x", x)?, line.real("y", y)?, line.real("z", z)?];
                let number = self.numbered(line, "a node's number", number, 0)?;
                self.mesh.add_node(line, number, place)?;
                Next::Node
            }
            Next::Element(axes) => {
                self.last = Some(line.place());
                let [element, part, nodes @ ..]: [&str; 10] = card.fields([8; 10])?;
                self.part.push(self.numbered(line, "a part's number", part, 2)?);
                let element = self.numbered(line, "an element's number", element, 1)?;
                // The older format has all numbers on one line.
                if nodes.iter().all(|node| node.is_empty()) {
                    Next::NodesOf(element, axes)
                } else {
                    self.element(line, element, nodes, axes)?
                }
            }
            Next::NodesOf(element, axes) => {
                let [nodes @ .., ninth, tenth]: [&str; 10] = card.fields([8; 10])?;
                if [ninth, tenth].iter().any(|node| !matches!(*node, "" | "0")) {
                    let message =
                        format!("element {element} has ten nodes; allowed: eight, of a hexahedron or a wedge");
                    return Err(line.error(&message));
                }
                self.element(line, element, nodes, axes)?
            }
            Next::Fibre => {
                let axis: [&str; 3] = card.fields([16; 3])?;
                let [x, y, z] = axis.map(|field| line.real("a direction", field));
                self.directions.push(Some([x?, y?, z?]));
                Next::Second
            }
            Next::Second => {
                let axis: [&str; 3] = card.fields([16; 3])?;
                let [x, y, z] = axis.map(|field| line.real("a direction", field));
                // Without it the card before has an angle by which the law's own axes are turned.
                if [x?, y?, z?] == [0.0; 3] {
                    return Err(line
                        .error("vector d is 0; allowed: two vectors, in whose plane the fibre and another axis are"));
                }
                Next::Element(true)
            }
            Next::Passed => Next::Passed,
            Next::Material(Orthotropic::Titled(cards)) => Next::Material(*cards),
            Next::Material(Orthotropic::User) => {
                let fields: [&str; 8] = card.fields([10; 8])?;
                // Without material axes there are no cards of them.
                let has_axes = line.real("IORTHO", fields[5])? != 0.0;
                if has_axes { Next::Material(Orthotropic::Before(1, 0)) } else { Next::Passed }
            }
            Next::Material(Orthotropic::Before(0, place)) => {
                let fields: [&str; 8] = card.fields([10; 8])?;
                let aopt = line.real("AOPT", fields[place])?;
                if aopt != 0.0 {
                    self.turns_fibres(line, &format!("AOPT is {aopt}, which is not read"));
                }
                Next::Passed
            }
            Next::Material(Orthotropic::Before(cards, place)) => Next::Material(Orthotropic::Before(cards - 1, place)),
            Next::Title => Next::Part(line.text.trim().to_string()),
            Next::Part(title) => {
                let [number] = card.fields([10])?;
                // Blank lines may stand behind the last part.
                if title.is_empty() && number.is_empty() {
                    Next::Title
                } else {
                    let number = self.numbered(line, "a part's number", number, 2)?;
                    let name = if title.is_empty() { format!("part {number}") } else { title };
                    self.titles.push((number, name, line.place()));
                    Next::Title
                }
            }
        };
        Ok(())
    }

    fn begin_file(&mut self, transform: &Transform) -> Result<(), Error> {
        self.check_last()?;
        let Transform { place, offsets, factors: [_, _, length], transformation } = transform;
        if *transformation != 0 {
            let message =
                format!("*INCLUDE_TRANSFORM with the transformation {transformation}; allowed: 0, offsets alone");
            return Err(place.error(&message));
        }
        if *length != 1.0 {
            let message =
                format!("*INCLUDE_TRANSFORM with the factor {length} of lengths; allowed: 1, and units in [mesh]");
            return Err(place.error(&message));
        }
        let before = self.offsets.last().copied().unwrap_or_default();
        self.offsets.push(std::array::from_fn(|i| before[i] + offsets[i]));
        Ok(())
    }

    fn end_file(&mut self) {
        self.offsets.pop();
    }
}

fn is_control(name: &str) -> bool {
    let is = |rest: &str, known: &str| rest == known || known.ends_with('_') && rest.starts_with(known);
    name.strip_prefix("*CONTROL_").is_some_and(|rest| CONTROLS.split_whitespace().any(|known| is(rest, known)))
}

impl Reader {
    /// That the element which was read last has all its cards.
    fn check_last(&self) -> Result<(), Error> {
        match (&self.next, &self.last) {
            (Next::NodesOf(..) | Next::Fibre | Next::Second, Some(place)) => {
                Err(place.error("an element without all its cards; allowed: its nodes, and two vectors with _ORTHO"))
            }
            _ => Ok(()),
        }
    }

    /// Fibres may be turned there: refused where an element has no direction of its own.
    fn turns_fibres(&mut self, line: &Line<'_>, what: &str) {
        let allowed = "allowed: AOPT = 0 of *MAT_ORTHOTROPIC_ELASTIC and user-defined laws, materials without axes, directions by \
                       *ELEMENT_SOLID_ORTHO, or a file without materials";
        self.axes.get_or_insert_with(|| line.error(&format!("{what}; {allowed}")));
    }

    /// A number of a node (0), an element (1) or a part (2) with the file's offset.
    fn numbered(&self, line: &Line<'_>, what: &str, field: &str, kind: usize) -> Result<u64, Error> {
        let number: u64 = line.number(what, field)?;
        let offset = self.offsets.last().map_or(0, |offsets| offsets[kind]);
        let allowed = "allowed: a number from 1 on, and a sum from 1 on";
        let wrong = || line.error(&format!("{what} is {number} with an offset of {offset}; {allowed}"));
        let sum = number.checked_add_signed(offset);
        sum.filter(|&sum| offset == 0 || (number > 0 && sum > 0)).ok_or_else(wrong)
    }

    fn element(&mut self, line: &Line<'_>, element: u64, nodes: [&str; 8], axes: bool) -> Result<Next, Error> {
        let mut numbers = [0; 8];
        for (number, field) in numbers.iter_mut().zip(nodes) {
            *number = self.numbered(line, &format!("a node of element {element}"), field, 0)?;
        }
        self.mesh.add_element(line.place(), element, numbers)?;
        if axes {
            return Ok(Next::Fibre);
        }
        self.directions.push(None);
        Ok(Next::Element(false))
    }

    fn finish(self) -> Result<Raw, Error> {
        self.check_last()?;
        if let Some(error) = self.axes.filter(|_| self.directions.iter().any(Option::is_none)) {
            return Err(error);
        }
        let mut numbers = self.part.clone();
        numbers.sort_unstable();
        numbers.dedup();
        let place = |number: &u64| numbers.binary_search(number).ok();
        let empty = self.titles.iter().find(|(number, ..)| !self.others && place(number).is_none());
        if let Some((number, title, line)) = empty {
            return Err(line.error(&format!("part {number}, {title}, has no elements; allowed: a yarn's elements")));
        }
        let titles: HashMap<u64, &str> =
            self.titles.iter().map(|(number, title, _)| (*number, title.as_str())).collect();
        let name =
            |number: &u64| titles.get(number).map_or_else(|| format!("part {number}"), |name| (*name).to_string());
        let yarn: Vec<Option<usize>> = self.part.iter().map(place).collect();
        let mut raw = Raw::default();
        self.mesh.add_to(&mut raw, numbers.iter().map(name).collect(), &yarn, &self.directions, PARTS)?;
        Ok(raw)
    }
}
