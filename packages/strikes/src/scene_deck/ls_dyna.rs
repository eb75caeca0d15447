//! LS-DYNA: a keyword file that includes the mesh. Eight fields of ten columns a line, but for nodes and elements.
//!
//! Not run: LS-DYNA was not at hand. Cards are as its keyword manual has them.

use std::io::{self, Write};
use std::path::Path;

use super::command::{Naming, file, mesh_file};
use super::fields::number;
use super::model::{COLLAPSED, Contact, Mesh, Model, Part, STEP_FACTOR, Strike};
use super::striker::{Striker, Surface};
use toron_materials::deck::ls_dyna::{Fibre, card, lines, number_of};
use toron_shared::error::Error;

/// Node and element numbers have eight columns.
const LARGEST: u64 = 99_999_999;
/// Whole numbers a line.
const PER_LINE: usize = 8;
/// Soft-constraint contact, whose stiffness follows from nodal masses and the step: that by the material's bulk
/// modulus, a fibre's, would be far too stiff across it. Its factor is the solver's own.
const SOFT: &str = "1";
const SOFT_FACTOR: f64 = 0.1;
/// Hourglass control by stiffness, with the exact volume.
const HOURGLASS: &str = "5";
/// Thickness of the striker's shells over its radius: nothing, where the contact takes the surface in their middle.
const THICKNESS: f64 = 1e-4;
/// Cycles from one restart file to the next.
const RESTART: u32 = 20_000;
const NU: f64 = 0.3;

/// Sets and other blocks behind those of the supports.
#[derive(Clone, Copy)]
enum Block {
    Yarns,
    Nodes,
    Watched,
}

struct Ids<'a> {
    first: u32,
    model: &'a Model,
}

impl Ids<'_> {
    fn node(&self, index: u32) -> u32 {
        self.first + index
    }

    fn striker_node(&self, index: u32) -> u32 {
        self.first + self.model.mesh.nodes.len() as u32 + index
    }

    fn part(&self, index: usize) -> u32 {
        self.first + index as u32
    }

    fn striker_part(&self) -> u32 {
        self.part(self.model.parts.len())
    }

    fn material(&self, index: usize) -> u32 {
        self.first + index as u32
    }

    fn striker_material(&self) -> u32 {
        self.material(self.model.materials.len())
    }

    fn set(&self, block: Block) -> u32 {
        self.first + self.model.supports.len() as u32 + block as u32
    }
}

/// Returns the names of the files.
///
/// # Errors
/// Numbers that have no room in their columns, a material without density, a file that cannot be written.
pub fn write(model: &Model, naming: &Naming, output: &Path) -> Result<Vec<String>, Error> {
    let shells = model.strike.as_ref().map(|strike| strike.striker.surface(0.0));
    let ids = Ids { first: naming.first, model };
    let count = |mesh: &Mesh| mesh.nodes.len().max(mesh.elements.len());
    let last = u64::from(naming.first) + (count(&model.mesh) + shells.as_ref().map_or(0, |s| s.nodes.len())) as u64;
    if last > LARGEST {
        let message = format!("--first-id {}: numbers go up to {last}; allowed in LS-DYNA: {LARGEST}", naming.first);
        return Err(Error::Input(message));
    }
    let mesh = mesh_file(output, format!("{}-mesh.k", model.name), |out| {
        write_mesh(model, shells.as_ref(), naming, &ids, out)
    })?;
    let cards = cards(model, naming, &ids)?;
    let main = file(output, format!("{}.k", model.name), |out| {
        write!(out, "{}", header(model))?;
        write!(out, "*KEYWORD\n*TITLE\n{}\n", model.title)?;
        if let Some(strike) = &model.strike {
            control(strike, out)?;
            output_of(strike, &ids, out)?;
        }
        write!(out, "{cards}")?;
        writeln!(out, "$ nodes, elements and sets\n*INCLUDE\n{mesh}")?;
        supports(model, &ids, out)?;
        if let (Some(strike), Some(shells)) = (&model.strike, &shells) {
            write_striker(model, &strike.striker, shells, naming, &ids, out)?;
            contacts(strike, naming, &ids, out)?;
        }
        writeln!(out, "*END")
    })?;
    Ok(vec![main, mesh])
}

fn header(model: &Model) -> String {
    let Model { title, source, name, .. } = model;
    let [length, mass, time] = model.units.names();
    let (elements, parts) = (model.mesh.elements.len(), model.parts.len());
    let origin = model.origin("$");
    let mut text = format!(
        "$ {title}
$ Case {name} of `{source} --deck ls-dyna`: {elements} elements in {parts} parts; units {length}, {mass}, {time}.
{origin}$ Not run: LS-DYNA was not at hand; the cards are as its keyword manual has them.
$
$ Run it in double precision, with an executable that has the shim and the library in it (toron's guide to LS-DYNA says how).
$ On one core, or on N threads:  ls-dyna i={name}.k ncpu=N memory=200m
$ On P domains (MPP):            mpirun -np P mppdyna i={name}.k memory=200m
$ On from a restart file:        ls-dyna i={name}.k r=d3dump01
$ Histories: glstat, matsum, rcforc, nodout, rbdout; of MPP by l2a binout*. Then toron compare NAME.csv FOLDER.
"
    );
    let panel_alone = "$ A panel alone, for a model of your own: contact, striker, time and output are not in it.\n";
    let differences = "$
$ What differs from toron's own solver:
$ - bulk viscosity resists a change of volume with the fastest wave's speed, there along and across the fibre each with its own;
$ - the step follows from the fastest wave in any direction (bulk and shear of the material), there from each direction's own;
$ - the contact's stiffness follows from masses and step (SOFT = 1), there it is contact-stiffness;
$ - an element has collapsed by its step (DTMIN with ERODE = 1), in any direction;
$ - the run goes on to its end when the striker has stopped or is through.
";
    text += if model.strike.is_some() { differences } else { panel_alone };
    for material in model.materials.iter().filter(|material| !material.has_default_options()) {
        text += &format!(
            "$ - {}: frame and criterion are the material routine's own: fibre, largest principal stress.\n",
            material.name
        );
    }
    text
}

/// A line of numbers and its comment.
fn row(names: &str, fields: &[Field]) -> String {
    let fields: Vec<String> = fields.iter().map(Field::text).collect();
    lines(names, &fields)
}

enum Field {
    Whole(u32),
    Real(f64),
    Text(&'static str),
}

use Field::{Real, Text, Whole};

impl Field {
    fn text(&self) -> String {
        match self {
            Whole(number) => number.to_string(),
            Real(value) => number_of(*value),
            Text(text) => (*text).to_string(),
        }
    }
}

fn control(strike: &Strike, out: &mut impl Write) -> io::Result<()> {
    let [quadratic, linear] = [strike.control.quadratic, strike.control.linear];
    // What deletes collapsed elements: below this part of the first step.
    let (least, erode) = if strike.fails { (COLLAPSED, 1) } else { (0.0, 0) };
    write!(
        out,
        "$ end; an element that may fail has collapsed when its step is DTMIN of the first one\n*CONTROL_TERMINATION\n{}",
        row(
            "endtim endcyc dtmin endeng endmas nosol",
            &[Real(strike.end), Whole(0), Real(least), Real(0.0), Real(0.0), Whole(0)]
        )
    )?;
    write!(
        out,
        "$ the factor of the stable step; no mass is scaled\n*CONTROL_TIMESTEP\n{}",
        row(
            "dtinit tssfac isdo tslimt dt2ms lctm erode ms1st",
            &[Real(0.0), Real(STEP_FACTOR), Whole(0), Real(0.0), Real(0.0), Whole(0), Whole(erode), Whole(0)]
        )
    )?;
    write!(
        out,
        "$ viscosity: quadratic and linear; energies of hourglass control and of contact are calculated\n\
         *CONTROL_BULK_VISCOSITY\n{}*CONTROL_ENERGY\n{}",
        row("q1 q2 type", &[Real(quadratic), Real(linear), Whole(1)]),
        row("hgen rwen slnten rylen", &[Whole(2), Whole(2), Whole(2), Whole(1)])
    )?;
    write!(
        out,
        "$ wedges become pentahedra of one point (ELFORM 115), as the section has it; ESORT = 1 would give them two (ELFORM 15)\n\
         *CONTROL_SOLID\n{}",
        row("esort fmatrx niptets swlocl", &[Whole(2), Whole(0), Whole(4), Whole(1)])
    )
}

/// Histories, the animations with the state variables of the law, and restart files.
fn output_of(strike: &Strike, ids: &Ids<'_>, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "$ sample: energies (glstat, by part matsum), forces of contact, deflection, the striker's motion")?;
    for name in ["GLSTAT", "MATSUM", "RCFORC", "NODOUT", "RBDOUT"] {
        let fields = [Real(strike.sample), Whole(0), Whole(0), Whole(1)];
        write!(out, "*DATABASE_{name}\n{}", row("dt binary lcur ioopt", &fields))?;
    }
    write!(
        out,
        "$ the panel's deflection\n*DATABASE_HISTORY_NODE\n{}",
        row("id1", &[Whole(ids.node(strike.deflection))])
    )?;
    let materials = &ids.model.materials;
    if strike.fails {
        let state = materials.iter().map(|material| material.state_table().len()).max().unwrap_or_default() as u32;
        write!(
            out,
            "$ elements that may fail first, with their history variables\n*DATABASE_ELOUT\n{}\
             *DATABASE_HISTORY_SOLID_SET\n{}",
            row("dt binary lcur ioopt option1", &[Real(strike.sample), Whole(0), Whole(0), Whole(1), Whole(state)]),
            row("id1", &[Whole(ids.set(Block::Watched))])
        )?;
    }
    let history: Vec<String> = materials
        .iter()
        .map(|material| {
            let description = material.law.description();
            let shown = description.energies.clone().chain([description.failed]);
            let named = shown.map(|i| format!("#{} {}", i + 1, material.state_table()[i].name));
            format!("$ {}: {}\n", material.name, named.collect::<Vec<_>>().join(", "))
        })
        .collect();
    let most = materials.iter().map(|material| material.state_table().len()).max().unwrap_or_default() as u32;
    write!(
        out,
        "$ frames, with these history variables\n{}*DATABASE_EXTENT_BINARY\n{}*DATABASE_BINARY_D3PLOT\n{}",
        history.concat(),
        row(
            "neiph neips maxint strflg sigflg epsflg rltflg engflg",
            &[Whole(most), Whole(0), Whole(3), Whole(0), Whole(1), Whole(1), Whole(1), Whole(1)]
        ),
        row("dt lcdt beam npltc psetid", &[Real(strike.frame), Whole(0), Whole(0), Whole(0), Whole(0)])
    )?;
    write!(
        out,
        "$ cycles from one restart file to the next\n*DATABASE_BINARY_D3DUMP\n{}",
        row("cycl", &[Whole(RESTART)])
    )
}

/// Materials, sections, hourglass control and parts.
fn cards(model: &Model, naming: &Naming, ids: &Ids<'_>) -> Result<String, Error> {
    let mut text = "$ the fibre is the first axis of each element, *ELEMENT_SOLID_ORTHO\n".to_string();
    for (i, material) in model.materials.iter().enumerate() {
        text += &card(material, ids.material(i), None, Fibre::Elements)?;
    }
    text += "$ one point\n*SECTION_SOLID\n";
    text += &row("secid elform aet", &[Whole(ids.first), Whole(1), Whole(0)]);
    if let Some(strike) = &model.strike {
        text += "$ hourglass: by stiffness; the solver takes QM of bulk + 4/3 shear, our host its part of the distortion's modulus\n";
        for (i, (material, modulus)) in model.materials.iter().zip(&strike.hourglass).enumerate() {
            let [bulk, shear] = material.bulk_and_shear();
            let part = modulus / (bulk + 4.0 / 3.0 * shear);
            text += "*HOURGLASS\n";
            text += &row(
                "hgid ihq qm ibq q1 q2 qb/vdc qw",
                &[
                    Whole(ids.material(i)),
                    Text(HOURGLASS),
                    Real(part),
                    Whole(1),
                    Real(strike.control.quadratic),
                    Real(strike.control.linear),
                    Real(part),
                    Real(part),
                ],
            );
        }
    }
    text += "$ a part for each yarn; in a panel of two laws one for each of its materials\n";
    for (i, Part { name, material, .. }) in model.parts.iter().enumerate() {
        let hourglass = if model.strike.is_some() { ids.material(*material) } else { 0 };
        text +=
            &part_card(ids.part(i), &format!("{}{name}", naming.prefix), ids.first, ids.material(*material), hourglass);
    }
    Ok(text)
}

fn part_card(id: u32, name: &str, section: u32, material: u32, hourglass: u32) -> String {
    let fields = [id, section, material, 0, hourglass, 0, 0, 0].map(Whole);
    format!("*PART\n{name}\n{}", row("pid secid mid eosid hgid grav adpopt tmid", &fields))
}

fn write_mesh(
    model: &Model,
    shells: Option<&Surface>,
    naming: &Naming,
    ids: &Ids<'_>,
    out: &mut impl Write,
) -> io::Result<()> {
    let mesh = &model.mesh;
    writeln!(out, "$ Included by {}.k. Nodes of the yarns, then of the striker.\n*KEYWORD\n*NODE", model.name)?;
    writeln!(out, "$#   nid               x               y               z      tc      rc")?;
    let of_striker = shells.into_iter().flat_map(|shells| &shells.nodes);
    for (number_of, place) in (ids.first..).zip(mesh.nodes.iter().chain(of_striker)) {
        let [x, y, z] = place.map(|x| number(x, 16));
        writeln!(out, "{number_of:>8}{x}{y}{z}{:>8}{:>8}", 0, 0)?;
    }
    writeln!(
        out,
        "$ a: the fibre in the undeformed mesh; d: with it in the plane of the first two axes\n*ELEMENT_SOLID_ORTHO"
    )?;
    writeln!(out, "$#   eid     pid      n1      n2      n3      n4      n5      n6      n7      n8")?;
    writeln!(
        out,
        "$#            a1              a2              a3\n$#            d1              d2              d3"
    )?;
    for (i, part) in model.parts.iter().enumerate() {
        for &element in &part.elements {
            write!(out, "{:>8}{:>8}", ids.node(element), ids.part(i))?;
            for node in nodes(mesh, element as usize) {
                write!(out, "{:>8}", ids.node(node))?;
            }
            writeln!(out)?;
            let fibre = mesh.fibre[element as usize];
            for vector in [fibre, across(fibre)] {
                let [x, y, z] = vector.map(|x| number(x, 16));
                writeln!(out, "{x}{y}{z}")?;
            }
        }
    }
    if let Some(shells) = shells {
        writeln!(out, "*ELEMENT_SHELL\n$#   eid     pid      n1      n2      n3      n4")?;
        for (element, face) in (ids.node(mesh.elements.len() as u32)..).zip(&shells.faces) {
            write!(out, "{element:>8}{:>8}", ids.striker_part())?;
            for node in face {
                write!(out, "{:>8}", ids.striker_node(*node))?;
            }
            writeln!(out)?;
        }
    }
    for (i, support) in model.supports.iter().enumerate() {
        let numbers = support.nodes.iter().map(|&node| ids.node(node));
        set("NODE_LIST", ids.first + i as u32, &format!("{}{}", naming.prefix, support.name), numbers, out)?;
    }
    let parts = (0..model.parts.len()).map(|part| ids.part(part));
    set("PART_LIST", ids.set(Block::Yarns), &format!("{}yarns", naming.prefix), parts, out)?;
    let last = ids.node(mesh.nodes.len() as u32 - 1);
    let range = [ids.first, last].into_iter();
    writeln!(out, "$ all nodes of the yarns, those inside too")?;
    set("NODE_LIST_GENERATE", ids.set(Block::Nodes), &format!("{}nodes of yarns", naming.prefix), range, out)?;
    if let Some(strike) = model.strike.as_ref().filter(|strike| strike.fails) {
        let watched = strike.watched.iter().map(|&element| ids.node(element));
        set("SOLID", ids.set(Block::Watched), &format!("{}watched", naming.prefix), watched, out)?;
    }
    writeln!(out, "*END")
}

/// An element's nodes: of a wedge first the quadrangle without its edge, then that edge, each node of it twice.
fn nodes(mesh: &Mesh, element: usize) -> [u32; 8] {
    let [a, b, c, d, e, f, g, h] = mesh.elements[element];
    if !mesh.is_wedge(element) {
        return [a, b, c, d, e, f, g, h];
    }
    if a == b { [d, c, g, h, a, a, e, e] } else { [b, a, e, f, c, c, g, g] }
}

/// Any direction that is not along the fibre.
fn across(fibre: [f64; 3]) -> [f64; 3] {
    if fibre[2].abs() < 0.7 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] }
}

fn set(kind: &str, id: u32, name: &str, numbers: impl Iterator<Item = u32>, out: &mut impl Write) -> io::Result<()> {
    write!(out, "*SET_{kind}_TITLE\n{name}\n{id:>10}")?;
    for (i, number) in numbers.enumerate() {
        if i % PER_LINE == 0 {
            writeln!(out)?;
        }
        write!(out, "{number:>10}")?;
    }
    writeln!(out)
}

fn supports(model: &Model, ids: &Ids<'_>, out: &mut impl Write) -> io::Result<()> {
    let fixed = model.supports.iter().enumerate().filter(|(_, support)| support.fixed.contains(&true));
    for (i, support) in fixed {
        let [x, y, z] = support.fixed.map(|fixed| Whole(u32::from(fixed)));
        let fields = [Whole(ids.first + i as u32), Whole(0), x, y, z, Whole(0), Whole(0), Whole(0)];
        write!(out, "$ {}: {}\n*BOUNDARY_SPC_SET\n", support.name, support.key)?;
        write!(out, "{}", row("nsid cid dofx dofy dofz dofrx dofry dofrz", &fields))?;
    }
    Ok(())
}

/// A rigid part of shells, whose density makes up its mass.
fn write_striker(
    model: &Model,
    striker: &Striker,
    shells: &Surface,
    naming: &Naming,
    ids: &Ids<'_>,
    out: &mut impl Write,
) -> io::Result<()> {
    let [bulk, shear] = model.materials[0].bulk_and_shear();
    let modulus = bulk + 4.0 / 3.0 * shear;
    // Translations held, by the numbers of the keyword: y and z, z and x, x and y.
    let held = [5, 6, 4][striker.axis()];
    let thickness = THICKNESS * striker.radius;
    let density = striker.mass / (shells.area() * thickness);
    let (part, material) = (ids.striker_part(), ids.striker_material());
    let prefix = &naming.prefix;
    writeln!(
        out,
        "$ the striker: {} of radius {}; density x thickness x surface is the scene's mass, or the model's\n\
         $ part of it, {}; modulus for the contact alone; it moves along {} and does not turn",
        striker.described(),
        number_of(striker.radius),
        number_of(striker.mass),
        ["x", "y", "z"][striker.axis()]
    )?;
    write!(
        out,
        "*MAT_RIGID_TITLE\n{prefix}striker\n{}{}{}",
        row(
            "mid ro e pr n couple m alias",
            &[Whole(material), Real(density), Real(modulus), Real(NU), Real(0.0), Real(0.0), Real(0.0), Real(0.0)]
        ),
        row("cmo con1 con2", &[Real(1.0), Whole(held), Whole(7)]),
        row("lco/a1 a2 a3 v1 v2 v3", &[Real(0.0), Real(0.0), Real(0.0), Real(0.0), Real(0.0), Real(0.0)])
    )?;
    write!(
        out,
        "*SECTION_SHELL\n{}{}",
        row(
            "secid elform shrf nip propt qr/irid icomp setyp",
            &[Whole(material), Whole(2), Real(1.0), Whole(2), Whole(1), Whole(0), Whole(0), Whole(1)]
        ),
        row("t1 t2 t3 t4", &[Real(thickness), Real(thickness), Real(thickness), Real(thickness)])
    )?;
    write!(out, "{}", part_card(part, &format!("{prefix}striker"), material, material, 0))?;
    let velocity = [0, 1, 2].map(|axis| Real(if axis == striker.axis() { striker.velocity } else { 0.0 }));
    let [x, y, z] = velocity;
    write!(
        out,
        "$ speed\n*INITIAL_VELOCITY_RIGID_BODY\n{}",
        row("pid vx vy vz vxr vyr vzr icid", &[Whole(part), x, y, z, Real(0.0), Real(0.0), Real(0.0), Whole(0)])
    )
}

fn contacts(strike: &Strike, naming: &Naming, ids: &Ids<'_>, out: &mut impl Write) -> io::Result<()> {
    let (yarns, striker) = (ids.set(Block::Yarns), ids.striker_part());
    writeln!(
        out,
        "$ friction: the yarns' nodes on the striker, those within them too, for when the elements above them are gone\n\
         $ IGNORE = 1: assumed to keep every node of a contact in its place, also where a clearance is near rounding"
    )?;
    write!(
        out,
        "{}",
        contact(
            "ERODING_NODES_TO_SURFACE",
            (ids.first, &format!("{}striker", naming.prefix)),
            [ids.set(Block::Nodes), striker, 4, 3],
            strike.striker.friction
        )
    )?;
    let Some(Contact { friction, .. }) = strike.contact else { return Ok(()) };
    writeln!(out, "$ yarn-friction: the yarns among themselves; faces that a deletion bares are in it")?;
    let name = format!("{}yarns", naming.prefix);
    write!(out, "{}", contact("ERODING_SINGLE_SURFACE", (ids.first + 1, &name), [yarns, 0, 2, 0], friction))
}

fn contact(
    kind: &str,
    (id, name): (u32, &str),
    [slave, master, of_slave, of_master]: [u32; 4],
    friction: f64,
) -> String {
    let zero = || Real(0.0);
    format!(
        "*CONTACT_{kind}_ID\n{id:>10}{name}\n{}{}{}{}{}{}{}",
        row(
            "ssid msid sstyp mstyp sboxid mboxid spr mpr",
            &[Whole(slave), Whole(master), Whole(of_slave), Whole(of_master), Whole(0), Whole(0), Whole(1), Whole(1)]
        ),
        row(
            "fs fd dc vc vdc penchk bt dt",
            &[Real(friction), Real(friction), zero(), zero(), Real(DAMPING), Whole(0), zero(), Text("1.0e20")]
        ),
        row(
            "sfs sfm sst mst sfst sfmt fsf vsf",
            &[Real(1.0), Real(1.0), zero(), zero(), Real(1.0), Real(1.0), Real(1.0), Real(1.0)]
        ),
        row("isym erosop iadj", &[Whole(1), Whole(1), Whole(1)]),
        row(
            "soft sofscl lcidab maxpar sbopt depth bsort frcfrq",
            &[Text(SOFT), Real(SOFT_FACTOR), Whole(0), Text("1.025"), Whole(2), Whole(2), Whole(0), Whole(1),]
        ),
        row(
            "penmax thkopt shlthk snlog isym i2d3d sldthk sldstf",
            &[zero(), Whole(0), Whole(0), Whole(0), Whole(0), Whole(0), zero(), zero()]
        ),
        row("igap ignore", &[Whole(1), Whole(1)])
    )
}

/// Damping of the contact, in per cent of the critical one.
const DAMPING: f64 = 5.0;
