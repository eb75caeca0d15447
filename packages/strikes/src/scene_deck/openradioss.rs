//! OpenRadioss: a starter file that includes the mesh, and an engine file.
//!
//! Fields are of 10 columns for whole numbers and names, of 20 for others.

use std::io::{self, Write};
use std::path::Path;

use super::command::{Naming, file, mesh_file};
use super::fields::number;
use super::model::{COLLAPSED, Contact, HOURGLASS, Model, Part, STEP_FACTOR, Strike};
use super::striker::{Striker, Surface};
use toron::host::units::UnitSystem;
use toron::law::parameters::STRESS;
use toron_materials::deck::openradioss::{Control, FibreFrom, lines, material_card, property_card};
use toron_shared::error::Error;
use toron_shared::short_number::short;

/// Whole numbers a line.
const PER_LINE: usize = 10;
/// Part of the contact's own stiffness, with which yarns do not rebound, and its damping, part of the critical one.
const STIFFNESS: f64 = 0.1;
const DAMPING: f64 = 0.05;
/// A node leaves a contact whose step is this fraction of the elements'. The contact stiffens without bound as its gap
/// closes, and where two surfaces pinch a node the step of the whole model would follow.
const CONTACT_STEP: f64 = 0.1;
/// The error of the energy, over the energy, at which the run ends. What hourglass control and contact take is an error
/// below 0, which is above −1. Long after a break free ends have gained energy without a bound, and the solver's own
/// limit is 10²⁰.
const ENERGY_ERROR: f64 = 1.0;
/// What is no viscosity: 0 is the solver's own.
const NONE: f64 = 1e-20;
/// How far inside the striker's surface its shells lie, where the contact begins, over a yarn's height. A touch more,
/// and nothing penetrates at the start.
const GAP: f64 = 0.25;
const SHELLS: f64 = 1.001;
/// Of the striker's shells: density over that of the fibre, so that they do not set the step, and at most this part of
/// its mass.
const DENSITY_RATIO: f64 = 5.0;
const MASS_OF_SHELLS: f64 = 0.2;
/// Cycles from one restart file to the next.
const RESTART: u32 = 20_000;
const PRINT: u32 = 100;

/// Numbers of the deck's blocks. Nodes, elements, parts, groups, ... are numbered each from the same first number on.
struct Ids {
    first: u32,
    nodes: u32,
    elements: u32,
    parts: u32,
    materials: u32,
    supports: u32,
}

impl Ids {
    fn of(model: &Model, naming: &Naming) -> Ids {
        Ids {
            first: naming.first,
            nodes: model.mesh.nodes.len() as u32,
            elements: model.mesh.elements.len() as u32,
            parts: model.parts.len() as u32,
            materials: model.materials.len() as u32,
            supports: model.supports.len() as u32,
        }
    }

    fn node(&self, index: u32) -> u32 {
        self.first + index
    }

    fn element(&self, index: u32) -> u32 {
        self.first + index
    }

    fn part(&self, index: u32) -> u32 {
        self.first + index
    }

    /// The striker's first node, and behind those of its quadrangles the one at its centre.
    fn striker_node(&self, index: u32) -> u32 {
        self.first + self.nodes + index
    }

    fn striker_part(&self) -> u32 {
        self.part(self.parts)
    }

    fn striker_material(&self) -> u32 {
        self.first + self.materials
    }

    /// Groups of nodes: those of the supports first.
    fn group(&self, group: Group) -> u32 {
        self.first + self.supports + group as u32
    }
}

/// Groups of nodes behind those of the supports; of surfaces the first two.
#[derive(Clone, Copy)]
enum Group {
    Yarns,
    Striker,
    Centre,
}

/// Returns the names of the files.
///
/// # Errors
/// A file cannot be written, or a material has no density.
pub fn write(model: &Model, naming: &Naming, output: &Path) -> Result<Vec<String>, Error> {
    let ids = Ids::of(model, naming);
    let shells = model.strike.as_ref().map(|strike| strike.striker.surface(SHELLS * GAP * strike.height));
    let mesh = mesh_file(output, format!("{}_mesh.inc", model.name), |out| {
        write_mesh(model, shells.as_ref(), naming, &ids, out)
    })?;
    let cards = cards(model, naming, &ids)?;
    // A panel alone is included in somebody's own model, which says when it begins and ends.
    let (Some(strike), Some(shells)) = (&model.strike, &shells) else {
        let name = format!("{}.inc", model.name);
        let panel = file(output, name, |out| {
            writeln!(out, "{}{cards}#include {mesh}", panel_header(model))?;
            supports(model, naming, &ids, out)
        })?;
        return Ok(vec![panel, mesh]);
    };
    let starter = file(output, format!("{}_0000.rad", model.name), |out| {
        write!(out, "{}{cards}", header(model, strike))?;
        writeln!(out, "# Nodes, elements, groups and surfaces.\n#include {mesh}")?;
        supports(model, naming, &ids, out)?;
        write_striker(model, strike, shells, naming, &ids, out)?;
        contacts(strike, naming, &ids, out)?;
        histories(strike, ids.striker_node(shells.nodes.len() as u32), naming, &ids, out)?;
        writeln!(out, "/END")
    })?;
    let engine = file(output, format!("{}_0001.rad", model.name), |out| write_engine(model, strike, out))?;
    Ok(vec![starter, engine, mesh])
}

fn panel_header(model: &Model) -> String {
    let [length, mass, time] = model.units.names();
    format!(
        "# {}\n# The panel of `{} --deck openradioss`, in {length}, {mass}, {time}, for a starter file of your own (#include).\n",
        model.title, model.source
    )
}

/// What the deck is, how it runs and what differs from our host.
fn header(model: &Model, strike: &Strike) -> String {
    let Model { title, source, name, .. } = model;
    let [length, mass, time] = model.units.names();
    let units = units(&model.units).map(|unit| format!("{unit:>20}")).concat();
    let (elements, parts) = (model.mesh.elements.len(), model.parts.len());
    let origin = model.origin("#");
    let yarn_contact = if strike.contact.is_some() { " and of the yarns" } else { "" };
    format!(
        "#RADIOSS STARTER
# {title}
# Case {name} of `{source} --deck openradioss`: {elements} elements in {parts} parts; units {length}, {mass}, {time}.
{origin}#
# Run it with the library libtoron_openradioss.so (toron's guide to OpenRadioss says how), in double precision.
# On one core, or on N threads with -nt N behind both:
#   starter_linux64_gf -i {name}_0000.rad -np 1 -dylib .../libtoron_openradioss.so
#   engine_linux64_gf -i {name}_0001.rad -dylib .../libtoron_openradioss.so
# On P domains, with the executable for MPI:
#   starter_linux64_gf -i {name}_0000.rad -np P -dylib .../libtoron_openradioss.so
#   mpirun -np P engine_linux64_gf_ompi -i {name}_0001.rad -dylib .../libtoron_openradioss.so
# On from the last restart file, {name}_0001_....rst: {name}_0002.rad, a copy of {name}_0001.rad with /RUN/{name}/2.
# Histories, of a run that has ended: th_to_csv {name}T01 (of OpenRadioss/Tools); then toron compare NAME.csv {name}T01.csv.
#
# What differs from toron's own solver:
# - bulk viscosity resists a change of volume with the fastest wave's speed, there along and across the fibre each with its own;
# - hourglass control is viscous (h is not the solver's own 0.1, which goes unstable sooner behind breaks), there elastic;
# - the step follows from the fastest wave in any direction, there from each direction's own;
# - the contact of the striker{yarn_contact} stiffens towards contact of the surfaces, there its stiffness is contact-stiffness;
# - the run goes on to its end when the striker has stopped or is through.
/BEGIN
{name}
      2022         0
{units}
{units}
/TITLE
{title}
"
    )
}

/// Length last, as the solver asks for them: mass, length, time; what it has no name for as a number of kg, m, s.
fn units(units: &UnitSystem) -> [String; 3] {
    let [length, mass, time] = units.names();
    let factor = |name: &str, si: f64| match name {
        "tonne" | "t" => "Mg".to_string(),
        "m" | "cm" | "mm" | "kg" | "g" | "mg" | "s" | "ms" => name.to_string(),
        _ => short(si, 19),
    };
    let si = |dimension| units.scale(dimension).convert(1.0, &toron::host::units::Scale::SI);
    use toron_materials::units::{LENGTH, MASS, TIME};
    [factor(mass, si(MASS)), factor(length, si(LENGTH)), factor(time, si(TIME))]
}

/// Materials, the property of all elements, and the parts.
fn cards(model: &Model, naming: &Naming, ids: &Ids) -> Result<String, Error> {
    let fibre_from = fibre_from(model, naming);
    let mut text = match fibre_from {
        FibreFrom::Card => "# Materials: the fibre is along x in all elements (fibre_from = 0).\n",
        FibreFrom::Nodes => {
            "# Materials: the fibre goes from nodes 1 to 4 of each element to nodes 5 to 8 (fibre_from = 1).\n"
        }
        FibreFrom::InitialValues => {
            "# Materials: the fibre of each element is an initial value, /INIBRI/AUX (fibre_from = 2).\n"
        }
    }
    .to_string();
    for (i, material) in model.materials.iter().enumerate() {
        text += &material_card(material, ids.first + i as u32, fibre_from)?;
    }
    let control = model.strike.as_ref().map_or(Control::default(), |strike| Control {
        // The solver squares it.
        quadratic: strike.control.quadratic.sqrt().max(NONE),
        linear: strike.control.linear.max(NONE),
        hourglass: HOURGLASS,
    });
    text += "# One point, viscous hourglass control, h; bulk viscosity from the scene's viscosity: q_a^2 quadratic, q_b linear.\n";
    text += &property_card(&format!("{}yarns", naming.prefix), ids.first, control);
    text += "# A part for each yarn; in a panel of two laws one for each of its materials.\n";
    for (i, Part { name, material, .. }) in model.parts.iter().enumerate() {
        let (part, material) = (ids.part(i as u32), ids.first + *material as u32);
        text += &part_card(part, &format!("{}{name}", naming.prefix), ids.first, material);
    }
    Ok(text)
}

fn part_card(id: u32, name: &str, property: u32, material: u32) -> String {
    format!("/PART/{id}\n{name}\n#  prop_ID    mat_ID subset_ID\n{property:>10}{material:>10}{:>10}\n", 0)
}

/// What the model or the user says of the cards.
fn fibre_from(model: &Model, naming: &Naming) -> FibreFrom {
    let of_mesh = if model.mesh.straight { FibreFrom::Card } else { FibreFrom::Nodes };
    naming.fibre_from.unwrap_or(of_mesh)
}

/// Nodes and elements of yarns and striker, groups and surfaces: all that is long.
fn write_mesh(
    model: &Model,
    shells: Option<&Surface>,
    naming: &Naming,
    ids: &Ids,
    out: &mut impl Write,
) -> io::Result<()> {
    let mesh = &model.mesh;
    writeln!(
        out,
        "# Included by the deck {}. Nodes of the yarns, then of the striker, its centre last.\n/NODE",
        model.name
    )?;
    let centre = model.strike.as_ref().map(|strike| &strike.striker.centre);
    let of_striker = shells.into_iter().flat_map(|shells| &shells.nodes).chain(centre);
    for (number_of, place) in (ids.first..).zip(mesh.nodes.iter().chain(of_striker)) {
        let [x, y, z] = place.map(|x| number(x, 20));
        writeln!(out, "{number_of:>10}{x}{y}{z}")?;
    }
    writeln!(out, "# Nodes 1 to 4 are a section of the yarn, 5 to 8 the next one.")?;
    for (i, part) in model.parts.iter().enumerate() {
        writeln!(out, "/BRICK/{}", ids.part(i as u32))?;
        for &element in &part.elements {
            write!(out, "{:>10}", ids.element(element))?;
            for node in mesh.elements[element as usize] {
                write!(out, "{:>10}", ids.node(node))?;
            }
            writeln!(out)?;
        }
    }
    if fibre_from(model, naming) == FibreFrom::InitialValues {
        write_fibres(model, ids, out)?;
    }
    for (i, support) in model.supports.iter().enumerate() {
        writeln!(out, "/GRNOD/NODE/{}\n{}{}", ids.first + i as u32, naming.prefix, support.name)?;
        numbers(support.nodes.iter().map(|&node| ids.node(node)), out)?;
    }
    if !mesh.faces.is_empty() {
        let id = ids.group(Group::Yarns);
        writeln!(out, "# What of the yarns can touch something: no cut ends, no planes of symmetry.")?;
        writeln!(out, "/SURF/SEG/{id}\n{}yarns", naming.prefix)?;
        for (segment, face) in (1..).zip(&mesh.faces) {
            let [a, b, c, d] = face.map(|node| ids.node(node));
            writeln!(out, "{segment:>10}{a:>10}{b:>10}{c:>10}{d:>10}")?;
        }
    }
    writeln!(out, "/GRNOD/PART/{}\n{}yarns", ids.group(Group::Yarns), naming.prefix)?;
    numbers((0..ids.parts).map(|part| ids.part(part)), out)?;
    let Some(shells) = shells else { return Ok(()) };
    writeln!(out, "/SHELL/{}", ids.striker_part())?;
    for (element, face) in (ids.element(ids.elements)..).zip(&shells.faces) {
        let [a, b, c, d] = face.map(|node| ids.striker_node(node));
        writeln!(out, "{element:>10}{a:>10}{b:>10}{c:>10}{d:>10}")?;
    }
    Ok(())
}

/// The fibre of each element as initial user variables, behind the law's state, which is 0.
fn write_fibres(model: &Model, ids: &Ids, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "# The fibre of each element: its last three user variables here.\n/INIBRI/AUX")?;
    for part in &model.parts {
        let state = model.materials[part.material].state_table().len();
        for &element in &part.elements {
            let (id, count) = (ids.element(element), state + 3);
            writeln!(out, "{id:>10}{:>10}{:>10}{:>10}{:>20}{count:>10}", 1, 8, 1, "")?;
            let values = std::iter::repeat_n(0.0, state).chain(model.mesh.fibre[element as usize]);
            for (i, value) in values.enumerate() {
                let end = if i + 1 == count || i % 3 == 2 { "\n" } else { "" };
                write!(out, "{}{end}", number(value, 20))?;
            }
        }
    }
    Ok(())
}

/// Ten whole numbers a line.
fn numbers(numbers: impl Iterator<Item = u32>, out: &mut impl Write) -> io::Result<()> {
    for (i, number) in numbers.enumerate() {
        if i > 0 && i % PER_LINE == 0 {
            writeln!(out)?;
        }
        write!(out, "{number:>10}")?;
    }
    writeln!(out)
}

fn supports(model: &Model, naming: &Naming, ids: &Ids, out: &mut impl Write) -> io::Result<()> {
    let named = model.supports.iter().enumerate().filter(|(_, support)| support.fixed.contains(&true));
    for (i, support) in named {
        let id = ids.first + i as u32;
        let fixed = support.fixed.map(|fixed| if fixed { "1" } else { "0" }).concat();
        writeln!(out, "# {}: {}", support.name, support.key)?;
        write!(out, "{}", bcs(id, &format!("{}{}", naming.prefix, support.name), &format!("{fixed} 000"), id))?;
    }
    Ok(())
}

/// What of translations and rotations is fixed.
fn bcs(id: u32, name: &str, fixed: &str, group: u32) -> String {
    format!("/BCS/{id}\n{name}\n#  Tra rot   skew_ID  grnod_ID\n{fixed:>10}{:>10}{group:>10}\n", 0)
}

/// A rigid body of shells.
fn write_striker(
    model: &Model,
    strike: &Strike,
    shells: &Surface,
    naming: &Naming,
    ids: &Ids,
    out: &mut impl Write,
) -> io::Result<()> {
    let striker = &strike.striker;
    let (Striker { radius, mass, velocity, .. }, offset) = (striker, GAP * strike.height);
    let fixed = [0, 1, 2].map(|axis| if axis == striker.axis() { "0" } else { "1" }).concat() + " 111";
    let prefix = &naming.prefix;
    let (material, part, centre) =
        (ids.striker_material(), ids.striker_part(), ids.striker_node(shells.nodes.len() as u32));
    let [group, centre_group] = [Group::Striker, Group::Centre].map(|group| ids.group(group));
    let yarn = &model.materials[0];
    let [bulk, shear] = yarn.bulk_and_shear();
    let modulus = bulk + 4.0 / 3.0 * shear;
    let volume = shells.area() * 2.0 * offset;
    let density = (DENSITY_RATIO * yarn.density_if_any().unwrap_or_default()).min(MASS_OF_SHELLS * mass / volume);
    let wide = |value: f64| short(value, 19);
    writeln!(
        out,
        "# The striker: {} of radius {}, {} inside which its shells lie: the contact begins there.\n\
         # Modulus ({}) and density of the shells serve the contact and the step alone.",
        striker.described(),
        wide(*radius),
        wide(offset),
        yarn.unit(STRESS)
    )?;
    write!(out, "/MAT/LAW1/{material}\n{prefix}striker\n")?;
    write!(out, "{}{}", lines(&["RHO_I"], &[wide(density)]), lines(&["E", "nu"], &[wide(modulus), wide(0.3)]))?;
    write!(out, "/PROP/SHELL/{material}\n{prefix}striker\n{}", shell_property(2.0 * offset))?;
    write!(out, "{}", part_card(part, &format!("{prefix}striker"), material, material))?;
    write!(out, "/GRNOD/PART/{group}\n{prefix}striker\n{part:>10}\n")?;
    write!(out, "/GRNOD/NODE/{centre_group}\n{prefix}centre of the striker\n{centre:>10}\n")?;
    write!(out, "/SURF/PART/{group}\n{prefix}striker\n{part:>10}\n")?;
    writeln!(
        out,
        "# The scene's mass, or the part of it that the model has, {}, is this and that of the shells.",
        wide(*mass)
    )?;
    let rest = wide(mass - density * volume);
    write!(
        out,
        "/RBODY/{part}\n{prefix}striker\n\
         #  node_ID   sens_ID   Skew_ID    Ispher                Mass   grnd_ID     Ikrem      ICoG   surf_ID\n\
         {centre:>10}{:>10}{:>10}{:>10}{rest:>20}{group:>10}{:>10}{:>10}{:>10}\n\
         #                Jxx                 Jyy                 Jzz\n{:>20}{:>20}{:>20}\n\
         #                Jxy                 Jyz                 Jxz\n{:>20}{:>20}{:>20}\n\
         #  Ioptoff\n{:>10}\n",
        0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0
    )?;
    write!(out, "{}", bcs(ids.first + ids.supports, &format!("{prefix}striker"), &fixed, centre_group))?;
    let velocities =
        [0, 1, 2].map(|axis| format!("{:>20}", if axis == striker.axis() { wide(*velocity) } else { "0".into() }));
    for (number, group) in [(ids.first, group), (ids.first + 1, centre_group)] {
        write!(
            out,
            "# speed\n/INIVEL/TRA/{number}\n{prefix}striker\n\
             #                 Vx                  Vy                  Vz   Gnod_id   Skew_id\n{}{group:>10}{:>10}\n",
            velocities.concat(),
            0
        )?;
    }
    Ok(())
}

fn shell_property(thickness: f64) -> String {
    format!(
        "#   Ishell    Ismstr     Ish3n    Idrill                            P_thick_fail\n\
         {:>10}{:>10}{:>10}{:>10}{:>40}\n\
         #                 hm                  hf                  hr                  dm                  dn\n\
         {:>20}{:>20}{:>20}{:>20}{:>20}\n\
         #        N   Istrain               Thick              Ashear              Ithick     Iplas\n\
         {:>10}{:>10}{:>20}{:>20}{:>20}{:>10}\n",
        0,
        0,
        0,
        0,
        0,
        0,
        0,
        0,
        0,
        0,
        0,
        0,
        short(thickness, 19),
        0,
        0,
        0
    )
}

fn contacts(strike: &Strike, naming: &Naming, ids: &Ids, out: &mut impl Write) -> io::Result<()> {
    let [yarns, striker] = [Group::Yarns, Group::Striker].map(|group| ids.group(group));
    writeln!(
        out,
        "# friction: the yarns' nodes, those within them too, for when the elements above them are gone, on the striker. Idel = 2:\n\
         # faces of deleted elements and nodes of none leave the contact, and what that bares stays in it."
    )?;
    let (friction, offset) = (strike.striker.friction, GAP * strike.height);
    write!(out, "{}", type7(ids.first, &format!("{}striker", naming.prefix), [yarns, striker], friction, offset))?;
    let Some(Contact { friction, clearance }) = strike.contact else { return Ok(()) };
    writeln!(out, "# yarn-friction; the gap is [weave] clearance: nodes of the yarns on faces of the yarns.")?;
    write!(out, "{}", type7(ids.first + 1, &format!("{}yarns", naming.prefix), [yarns, yarns], friction, clearance))
}

/// A contact of a group of nodes with a surface.
fn type7(id: u32, name: &str, [nodes, surface]: [u32; 2], friction: f64, gap: f64) -> String {
    let [stiffness, friction, gap, damping] = [STIFFNESS, friction, gap, DAMPING].map(|value| short(value, 19));
    format!(
        "/INTER/TYPE7/{id}\n{name}\n\
         # grnod_id   surf_id      Istf      Ithe      Igap                Ibag      Idel     Icurv      Iadm\n\
         {nodes:>10}{surface:>10}         4         0         0                   0         2         0         0\n\
         #          Fscalegap             Gap_max             Fpenmax                         Itied\n\
         {0:>20}{0:>20}{0:>20}{1:>20}{0:>10}\n\
         #              Stmin               Stmax   Percent_mesh_size               dtmin  Irem_gap   Irem_i2\n\
         {0:>20}{0:>20}{0:>20}{0:>20}{0:>10}{0:>10}\n\
         #              Stfac                Fric              GAPmin              Tstart               Tstop\n\
         {stiffness:>20}{friction:>20}{gap:>20}{0:>20}{0:>20}\n\
         #      IBC                        Inacti               VIS_S               VIS_F              Bumult\n       \
         000{1:>20}{2:>10}{damping:>20}{0:>20}{0:>20}\n\
         #    Ifric    Ifiltr               Xfreq     Iform   sens_ID   fct_IDF             AscaleF   fric_ID\n\
         {0:>10}{0:>10}{0:>20}{3:>10}{0:>10}{0:>10}{0:>20}{0:>10}\n",
        0, "", 6, 2
    )
}

/// Histories; the global energies are in every history.
fn histories(strike: &Strike, centre: u32, naming: &Naming, ids: &Ids, out: &mut impl Write) -> io::Result<()> {
    let prefix = &naming.prefix;
    writeln!(
        out,
        "# Histories: the striker, the panel's deflection, the force between them, elements that may fail first (OFF)."
    )?;
    writeln!(out, "/TH/NODE/{}\n{prefix}striker\n{}", ids.first, columns(&["DX", "DY", "DZ", "VX", "VY", "VZ"]))?;
    writeln!(out, "{centre:>10}{:>10}striker", 0)?;
    writeln!(out, "{:>10}{:>10}deflection", ids.node(strike.deflection), 0)?;
    let interfaces = 1 + u32::from(strike.contact.is_some());
    writeln!(out, "/TH/INTER/{}\n{prefix}contacts\n{}", ids.first + 1, columns(&["DEF"]))?;
    numbers((0..interfaces).map(|i| ids.first + i), out)?;
    if strike.fails {
        writeln!(out, "/TH/BRIC/{}\n{prefix}watched\n{}", ids.first + 2, columns(&["OFF"]))?;
        for &element in &strike.watched {
            writeln!(out, "{:>10}{:>10}watched", ids.element(element), 0)?;
        }
    }
    Ok(())
}

fn columns(names: &[&str]) -> String {
    names.iter().map(|name| format!("{name:<10}")).collect()
}

fn write_engine(model: &Model, strike: &Strike, out: &mut impl Write) -> io::Result<()> {
    let Model { name, source, .. } = model;
    let wide = |value: f64| short(value, 19);
    writeln!(out, "#RADIOSS ENGINE\n# The engine's part of {name}_0000.rad, which says what it is and how to run it.")?;
    writeln!(out, "/VERS/2022\n# end, of `{source}`\n/RUN/{name}/1\n{:>20}", wide(strike.end))?;
    writeln!(out, "# The factor of the stable step; no mass is scaled.\n/DT\n{} 0.0", wide(STEP_FACTOR))?;
    if strike.fails {
        writeln!(out, "# An element that may fail has collapsed when its step is {COLLAPSED} of the first one.")?;
        writeln!(out, "/DT/BRICK/DEL\n{} {}", wide(STEP_FACTOR), wide(COLLAPSED * strike.step))?;
    }
    writeln!(out, "# A node leaves a contact that would make the step shorter than this.")?;
    writeln!(out, "/DT/INTER/DEL\n{} {}", wide(STEP_FACTOR), wide(CONTACT_STEP * strike.step))?;
    writeln!(out, "# The run ends, with a restart file, a last line of histories and a last picture, when the energy")?;
    writeln!(out, "# has doubled with nothing put in: behind a break it may grow without a bound.")?;
    writeln!(out, "/STOP\n{} 0 0 1 1", wide(ENERGY_ERROR))?;
    writeln!(out, "# sample\n/TFILE\n{}", wide(strike.sample))?;
    writeln!(out, "# frames\n/ANIM/DT\n0.0 {}", wide(strike.frame))?;
    writeln!(out, "/ANIM/VECT/DISP\n/ANIM/VECT/VEL")?;
    for comment in user_variables(model) {
        writeln!(out, "{comment}")?;
    }
    writeln!(out, "# Cycles from one restart file to the next.\n/RFILE\n{RESTART}\n/PRINT/-{PRINT}")
}

/// The energies by mode, and the failure index or the latch, by the laws' tables.
fn user_variables(model: &Model) -> Vec<String> {
    let mut lines = Vec::new();
    let mut asked = std::collections::BTreeSet::new();
    for material in &model.materials {
        let description = material.law.description();
        let shown = description.energies.clone().chain([description.failed]);
        let shown: Vec<usize> = shown.collect();
        let names: Vec<String> =
            shown.iter().map(|&i| format!("USR{} {}", i + 1, material.state_table()[i].name)).collect();
        lines.push(format!("# {}: {}", material.name, names.join(", ")));
        asked.extend(shown);
    }
    lines.extend(asked.into_iter().map(|i| format!("/ANIM/BRICK/USR{}", i + 1)));
    lines
}
