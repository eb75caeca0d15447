//! Abaqus/Explicit: an input file that includes the mesh. Names instead of numbers; a comma between values.
//!
//! Not run: Abaqus was not at hand. Options are as its keyword manual has them.

use std::io::{self, Write};
use std::path::Path;

use super::command::{Naming, file, mesh_file};
use super::model::{COLLAPSED, Contact, HOURGLASS, Mesh, Model, STEP_FACTOR, Strike};
use super::striker::{Striker, Surface};
use toron_materials::deck::abaqus::{self, Solver, card};
use toron_shared::error::Error;
use toron_shared::short_number::short;

/// Whole numbers a line.
const PER_LINE: usize = 16;
/// Restart files of a run.
const RESTARTS: u32 = 20;
/// What viscous hourglass control is taken to have as its factor where its scale is 1: the manual has scales and not
/// this factor, which is 0.1 in OpenRadioss and LS-DYNA, and 0.05 to 0.15 in Flanagan and Belytschko's paper (Int. J.
/// Numer. Meth. Eng. 17, 1981).
const HOURGLASS_OF_SCALE_1: f64 = 0.1;

/// What the names in a deck begin with, in capitals as the solver has them.
struct Names<'a> {
    prefix: String,
    model: &'a Model,
}

impl Names<'_> {
    fn prefixed(&self, name: &str) -> String {
        format!("{}{}", self.prefix, name.to_uppercase())
    }
}

/// Returns the names of the files.
///
/// # Errors
/// A material without density, a file that cannot be written.
pub fn write(model: &Model, naming: &Naming, output: &Path) -> Result<Vec<String>, Error> {
    let names = Names { prefix: naming.prefix.to_uppercase(), model };
    let shells = model.strike.as_ref().map(|strike| strike.striker.surface(0.0));
    let mesh = mesh_file(output, format!("{}-mesh.inp", model.name), |out| write_mesh(&names, naming.first, out))?;
    let mut files = vec![mesh.clone()];
    // Apart from the yarns: readers of meshes do not know its rigid elements.
    let striker = format!("{}-striker.inp", model.name);
    if let (Some(strike), Some(shells)) = (&model.strike, &shells) {
        files.push(mesh_file(output, striker.clone(), |out| {
            write_striker_mesh(&strike.striker, shells, &names, naming.first, out)
        })?);
    }
    let cards = cards(&names)?;
    let main = file(output, format!("{}.inp", model.name), |out| {
        write!(out, "{}", header(model))?;
        // A panel alone is included in somebody's own model.
        if model.strike.is_some() {
            write!(out, "*HEADING\n{}\n", model.title)?;
        }
        write!(out, "** nodes, elements and sets\n*INCLUDE, INPUT={mesh}\n{cards}")?;
        if let (Some(strike), Some(shells)) = (&model.strike, &shells) {
            writeln!(out, "*INCLUDE, INPUT={striker}")?;
            write_striker(&strike.striker, shells, &names, naming.first, out)?;
            contacts(strike, &names, out)?;
        }
        supports(&names, out)?;
        if let Some(strike) = &model.strike {
            step(strike, &names, out)?;
        }
        Ok(())
    })?;
    files.insert(0, main);
    if model.strike.is_some() {
        files.push(file(output, HISTORY.to_string(), |out| out.write_all(HISTORY_SCRIPT.as_bytes()))?);
    }
    Ok(files)
}

/// The script that makes a CSV of an output database.
const HISTORY: &str = "abaqus_history.py";
const HISTORY_SCRIPT: &str = include_str!("../../assets/abaqus_history.py");

fn header(model: &Model) -> String {
    let Model { title, source, name, .. } = model;
    let [length, mass, time] = model.units.names();
    let (elements, parts) = (model.mesh.elements.len(), model.parts.len());
    let origin = model.origin("**");
    let mut text = format!(
        "** {title}
** Case {name} of `{source} --deck abaqus-explicit`: {elements} elements in {parts} yarns or parts of them;
** units {length}, {mass}, {time}. Not run: Abaqus was not at hand; options are as its keyword manual has them.
{origin}**
** Run it in double precision with the VUMAT and the library (toron's guide to Abaqus says how), on N cores, 1 or many:
**   abaqus job={name} user=abaqus_vumat_dp.f double=both cpus=N
** Later, on from the last restart file:  abaqus job={name} recover
** Histories as a table:                  abaqus python {HISTORY} {name}.odb {name}-history.csv
** Then:                                  toron compare NAME.csv {name}-history.csv
"
    );
    let panel_alone = "** A panel alone, for a model of your own: contact, striker and step are not in it.\n";
    let differences = "**
** What differs from toron's own solver:
** - bulk viscosity resists a change of volume with the fastest wave's speed, there along and across the fibre each with its own;
** - hourglass control is viscous, there elastic;
** - the step follows from the fastest wave in any direction, there from each direction's own;
** - the contact's penalty is the solver's own, there it is contact-stiffness;
** - no element is deleted because it has collapsed, there it is: distortion control resists that an element gets shorter than LENGTH
**   RATIO of its length, and what it takes is ALLDC;
** - the run goes on to its end when the striker has stopped or is through.
";
    text += if model.strike.is_some() { differences } else { panel_alone };
    for material in model.materials.iter().filter(|material| !material.has_default_options()) {
        text += &format!(
            "** - {}: frame and criterion are the material routine's own: fibre, largest principal stress.\n",
            material.name
        );
    }
    text
}

fn wide(value: f64) -> String {
    short(value, 19)
}

/// Materials, and a section for each part.
fn cards(names: &Names<'_>) -> Result<String, Error> {
    let model = names.model;
    let mut text = String::new();
    for material in &model.materials {
        text += &card(material, Solver::Explicit)?;
    }
    text += &format!(
        "** the fibre is the first axis of each element\n*ORIENTATION, NAME={0}, SYSTEM=RECTANGULAR, DEFINITION=COORDINATES\n\
         {1}\n1, 0.0\n\
         ** failed elements are deleted; an element that has collapsed is not, and would end the run when it is inverted: distortion control\n\
         ** keeps it from that (the cutoff of the deformation speed check is not for user materials)\n\
         ** hourglass control is viscous, with a factor of {3}: assumed to be {4} where the scale, here in the line of data, is 1\n\
         *SECTION CONTROLS, NAME={2}, ELEMENT DELETION=YES, HOURGLASS=VISCOUS, DISTORTION CONTROL=YES, LENGTH RATIO={5}\n{6},\n",
        names.prefixed("FIBRE-AXES"),
        names.prefixed("FIBRES"),
        names.prefixed("CONTROLS"),
        wide(HOURGLASS),
        wide(HOURGLASS_OF_SCALE_1),
        wide(COLLAPSED),
        wide(HOURGLASS / HOURGLASS_OF_SCALE_1)
    );
    for part in &model.parts {
        text += &format!(
            "*SOLID SECTION, ELSET={}, MATERIAL={}, ORIENTATION={}, CONTROLS={}\n",
            names.prefixed(&part.name),
            abaqus::name(&model.materials[part.material]),
            names.prefixed("FIBRE-AXES"),
            names.prefixed("CONTROLS")
        );
    }
    Ok(text)
}

fn write_mesh(names: &Names<'_>, first: u32, out: &mut impl Write) -> io::Result<()> {
    let model = names.model;
    let mesh = &model.mesh;
    writeln!(
        out,
        "** Included by {}.inp. Nodes of the yarns.\n*NODE, NSET={}",
        model.name,
        names.prefixed("YARN-NODES")
    )?;
    // The shortest digits that are this number and no other.
    for (number, [x, y, z]) in (first..).zip(&mesh.nodes) {
        writeln!(out, "{number}, {x:?}, {y:?}, {z:?}")?;
    }
    for part in &model.parts {
        let set = names.prefixed(&part.name);
        for wedge in [false, true] {
            let mut of_kind =
                part.elements.iter().filter(|&&element| mesh.is_wedge(element as usize) == wedge).peekable();
            if of_kind.peek().is_none() {
                continue;
            }
            writeln!(out, "*ELEMENT, TYPE={}, ELSET={set}", if wedge { "C3D6" } else { "C3D8R" })?;
            for &element in of_kind {
                write!(out, "{}", first + element)?;
                for node in nodes(mesh, element as usize) {
                    write!(out, ", {}", first + node)?;
                }
                writeln!(out)?;
            }
        }
    }
    writeln!(out, "*ELSET, ELSET={}", names.prefixed("YARNS"))?;
    for part in &model.parts {
        writeln!(out, "{}", names.prefixed(&part.name))?;
    }
    let (table, fibres) = (names.prefixed("FIBRE-TABLE"), names.prefixed("FIBRES"));
    writeln!(
        out,
        "** The fibre in the undeformed mesh, and a direction that spans the plane of the first two axes with it."
    )?;
    writeln!(out, "*DISTRIBUTION TABLE, NAME={table}\nCOORD3D, COORD3D")?;
    writeln!(out, "*DISTRIBUTION, NAME={fibres}, LOCATION=ELEMENT, TABLE={table}\n, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0")?;
    for (element, fibre) in (first..).zip(&mesh.fibre) {
        let [[a, b, c], [d, e, f]] = [*fibre, across(*fibre)];
        writeln!(out, "{element}, {a:?}, {b:?}, {c:?}, {d:?}, {e:?}, {f:?}")?;
    }
    for support in &model.supports {
        writeln!(out, "*NSET, NSET={}", names.prefixed(support.name))?;
        numbers(support.nodes.iter().map(|&node| first + node), out)?;
    }
    writeln!(out, "** all faces, those inside too: they come into contact when a deletion bares them")?;
    writeln!(
        out,
        "*SURFACE, NAME={0}, TYPE=ELEMENT\n{1},\n{1}, INTERIOR",
        names.prefixed("YARN-FACES"),
        names.prefixed("YARNS")
    )?;
    let Some(strike) = &model.strike else { return Ok(()) };
    writeln!(out, "*NSET, NSET={}\n{},", names.prefixed("DEFLECTION"), first + strike.deflection)?;
    if strike.fails {
        writeln!(out, "*ELSET, ELSET={}", names.prefixed("WATCHED"))?;
        numbers(strike.watched.iter().map(|&element| first + element), out)?;
    }
    Ok(())
}

/// Nodes and faces of the striker.
fn write_striker_mesh(
    striker: &Striker,
    shells: &Surface,
    names: &Names<'_>,
    first: u32,
    out: &mut impl Write,
) -> io::Result<()> {
    let mesh = &names.model.mesh;
    let node = |index: usize| first as usize + mesh.nodes.len() + index;
    writeln!(
        out,
        "** Included by {}.inp. The striker, its centre last.\n*NODE, NSET={}",
        names.model.name,
        names.prefixed("STRIKER-NODES")
    )?;
    for (i, [x, y, z]) in shells.nodes.iter().enumerate() {
        writeln!(out, "{}, {x:?}, {y:?}, {z:?}", node(i))?;
    }
    let [x, y, z] = striker.centre;
    writeln!(out, "*NODE, NSET={}\n{}, {x:?}, {y:?}, {z:?}", names.prefixed("STRIKER"), node(shells.nodes.len()))?;
    writeln!(out, "*ELEMENT, TYPE=R3D4, ELSET={}", names.prefixed("STRIKER-FACES"))?;
    for (element, face) in (first as usize + mesh.elements.len()..).zip(&shells.faces) {
        let [a, b, c, d] = face.map(|index| node(index as usize));
        writeln!(out, "{element}, {a}, {b}, {c}, {d}")?;
    }
    Ok(())
}

/// An element's nodes: of a wedge the two triangles.
fn nodes(mesh: &Mesh, element: usize) -> Vec<u32> {
    let nodes = mesh.elements[element];
    let kept: &[usize] = match mesh.is_wedge(element) {
        false => &[0, 1, 2, 3, 4, 5, 6, 7],
        true if nodes[0] == nodes[1] => &[1, 2, 3, 5, 6, 7],
        true => &[0, 1, 2, 4, 5, 6],
    };
    kept.iter().map(|&i| nodes[i]).collect()
}

/// Any direction that is not along the fibre.
fn across(fibre: [f64; 3]) -> [f64; 3] {
    if fibre[2].abs() < 0.7 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] }
}

fn numbers(numbers: impl Iterator<Item = u32>, out: &mut impl Write) -> io::Result<()> {
    for (i, number) in numbers.enumerate() {
        match i % PER_LINE {
            0 if i == 0 => write!(out, "{number}")?,
            0 => write!(out, "\n{number}")?,
            _ => write!(out, ", {number}")?,
        }
    }
    writeln!(out)
}

/// A rigid body with a point mass.
fn write_striker(
    striker: &Striker,
    shells: &Surface,
    names: &Names<'_>,
    first: u32,
    out: &mut impl Write,
) -> io::Result<()> {
    let mesh = &names.model.mesh;
    let [reference, faces, point] = ["STRIKER", "STRIKER-FACES", "STRIKER-MASS"].map(|name| names.prefixed(name));
    let centre = first as usize + mesh.nodes.len() + shells.nodes.len();
    let element = first as usize + mesh.elements.len() + shells.faces.len();
    writeln!(
        out,
        "** the striker: {} of radius {}; mass: the scene's, or the part that the model has",
        striker.described(),
        wide(striker.radius)
    )?;
    writeln!(out, "*RIGID BODY, REF NODE={reference}, ELSET={faces}")?;
    writeln!(
        out,
        "*ELEMENT, TYPE=MASS, ELSET={point}\n{element}, {centre}\n*MASS, ELSET={point}\n{},",
        wide(striker.mass)
    )?;
    writeln!(out, "*SURFACE, NAME={}, TYPE=ELEMENT\n{faces}, SPOS", names.prefixed("STRIKER-SURFACE"))?;
    let axis = striker.axis();
    writeln!(out, "*BOUNDARY")?;
    for dof in (1..=6).filter(|&dof| dof != axis + 1) {
        writeln!(out, "{reference}, {dof}, {dof}")?;
    }
    writeln!(out, "** speed\n*INITIAL CONDITIONS, TYPE=VELOCITY\n{reference}, {}, {}", axis + 1, wide(striker.velocity))
}

fn contacts(strike: &Strike, names: &Names<'_>, out: &mut impl Write) -> io::Result<()> {
    let [yarns, striker] = ["YARN-FACES", "STRIKER-SURFACE"].map(|name| names.prefixed(name));
    let pair = |interaction: &str, friction: f64| {
        format!("*SURFACE INTERACTION, NAME={}\n*FRICTION\n{},\n", names.prefixed(interaction), wide(friction))
    };
    write!(out, "** friction: of the striker\n{}", pair("ON-STRIKER", strike.striker.friction))?;
    if let Some(Contact { friction, .. }) = strike.contact {
        write!(out, "** yarn-friction: of the yarns among themselves\n{}", pair("ON-YARNS", friction))?;
    }
    writeln!(out, "*CONTACT\n*CONTACT INCLUSIONS\n{yarns}, {striker}")?;
    if strike.contact.is_some() {
        writeln!(out, "{yarns}, {yarns}")?;
    }
    writeln!(out, "*CONTACT PROPERTY ASSIGNMENT\n{yarns}, {striker}, {}", names.prefixed("ON-STRIKER"))?;
    if strike.contact.is_some() {
        writeln!(out, "{yarns}, {yarns}, {}", names.prefixed("ON-YARNS"))?;
    }
    writeln!(out, "** nodes of no element leave the contact\n*CONTACT CONTROLS ASSIGNMENT, NODAL EROSION=YES")
}

fn supports(names: &Names<'_>, out: &mut impl Write) -> io::Result<()> {
    for support in names.model.supports.iter().filter(|support| support.fixed.contains(&true)) {
        writeln!(out, "** {}: {}\n*BOUNDARY", support.name, support.key)?;
        for (i, _) in support.fixed.iter().enumerate().filter(|(_, fixed)| **fixed) {
            writeln!(out, "{}, {1}, {1}", names.prefixed(support.name), i + 1)?;
        }
    }
    Ok(())
}

fn step(strike: &Strike, names: &Names<'_>, out: &mut impl Write) -> io::Result<()> {
    let [reference, deflection] = ["STRIKER", "DEFLECTION"].map(|name| names.prefixed(name));
    // The solver squares the quadratic coefficient.
    let viscosity = [strike.control.linear, strike.control.quadratic.sqrt()].map(wide).join(", ");
    writeln!(
        out,
        "** end; the factor of the stable step; no mass is scaled\n*STEP, NLGEOM=YES\n*DYNAMIC, EXPLICIT, SCALE FACTOR={}\n, {}\n\
         ** viscosity: linear, and the root of the quadratic one\n*BULK VISCOSITY\n{viscosity}",
        wide(STEP_FACTOR),
        wide(strike.end)
    )?;
    writeln!(out, "*RESTART, WRITE, NUMBER INTERVAL={RESTARTS}, OVERLAY")?;
    let frames = (strike.end / strike.frame).round();
    writeln!(
        out,
        "** frames; the state variables are named by *DEPVAR\n*OUTPUT, FIELD, NUMBER INTERVAL={frames}\n*NODE OUTPUT\nU, V\n\
         *ELEMENT OUTPUT\nS, SDV, STATUS"
    )?;
    writeln!(
        out,
        "** sample: what {HISTORY} writes\n*OUTPUT, HISTORY, TIME INTERVAL={}\n\
         *NODE OUTPUT, NSET={reference}\nU, V, A\n*NODE OUTPUT, NSET={deflection}\nU\n\
         *ENERGY OUTPUT\nALLKE, ALLIE, ALLSE, ALLVD, ALLAE, ALLDC, ALLFD, ALLPW, ALLWK, ETOTAL",
        wide(strike.sample)
    )?;
    if strike.fails {
        let failed = names.model.materials.iter().map(|material| material.law.description().failed + 1);
        let failed: std::collections::BTreeSet<usize> = failed.collect();
        let names_of: Vec<String> = failed.iter().map(|number| format!("SDV{number}")).collect();
        writeln!(
            out,
            "** elements that may fail first: their latch\n*ELEMENT OUTPUT, ELSET={}\n{}",
            names.prefixed("WATCHED"),
            names_of.join(", ")
        )?;
    }
    writeln!(out, "*END STEP")
}
