//! What LAMMPS reads: its input and the beads. `x` is along the yarn from mid-span, `y` against the blow, `z` across
//! the yarn.

use std::fmt::Write;

use super::model::{Model, Pressing, Striking, middle_stiffness};
use super::pressed;

/// The files of a run, in its folder.
pub const INPUT: &str = "in.lmp";
pub const BEADS: &str = "beads.lmp";
pub const HISTORY: &str = "history.txt";
pub const FRAMES: &str = "frames.txt";
pub const DONE: &str = "done.txt";
pub const RESTARTS: [&str; 2] = ["restart-1.lmp", "restart-2.lmp"];
/// The variable that the command line gives: the restart file from which the run goes on.
pub const RESTART: &str = "restart";

/// Beads within this part of a diameter beyond their contact are neighbours until one has moved by half of that.
const SKIN: f64 = 2.0 / 3.0;
/// Friction is that of a contact so much softer than the fibres' own, with a coefficient so much larger, where their
/// law is not linear: Coulomb's limit with hardly any force of its own.
const FAINT: f64 = 1e-4;
/// Columns of a line of the history before those of the stations, and of a station.
pub const COLUMNS: usize = 13;
pub const STATION_COLUMNS: usize = 4;

/// The beads and the trusses between them. A layer's beads follow each other, and layers go from mid-span to the clamp.
pub fn beads(model: &Model) -> String {
    let fibres = model.centres.len();
    let beads = model.all_beads();
    let bonds = fibres * (model.beads - 1);
    let carrier = model.carrier();
    let carriers = usize::from(carrier.is_some());
    let mut text = String::with_capacity(64 * beads);
    let _ = write!(
        text,
        "beads of {fibres} fibres\n\n{} atoms\n{} bonds\n{} atom types\n1 bond types\n2 extra special per atom\n\n",
        beads + carriers,
        bonds,
        1 + carriers
    );
    let far =
        model.centres.iter().flatten().fold(model.diameter, |far: f64, x| far.max(x.abs())) + 4.0 * model.diameter;
    let _ = writeln!(text, "{:e} {:e} xlo xhi", -model.spacing, model.half_length + model.spacing);
    let _ = write!(text, "{:e} {far:e} ylo yhi\n{:e} {far:e} zlo zhi\n\nAtoms # hybrid\n\n", -far, -far);
    // LAMMPS takes a sphere's density; the bead at mid-span stands for half a spacing, and so does the clamped one.
    let volume = std::f64::consts::PI / 6.0 * model.diameter.powi(3);
    for layer in 0..model.beads {
        let is_end = bonds > 0 && (layer == 0 || layer == model.beads - 1);
        let share = if is_end { 0.5 } else { 1.0 };
        let (x, density) = (layer as f64 * model.spacing, share * model.bead_mass / volume);
        for (fibre, [z, y]) in model.centres.iter().enumerate() {
            let id = layer * fibres + fibre + 1;
            let _ = writeln!(text, "{id} 1 {x:e} {y:e} {z:e} {} {:e} {density:e}", fibre + 1, model.diameter);
        }
    }
    if let Some(([z, y], mass)) = carrier {
        let density = mass / volume;
        let _ = writeln!(text, "{} 2 0 {y} {z} {} {:e} {density:e}", beads + 1, fibres + 1, model.diameter);
    }
    if bonds > 0 {
        text.push_str("\nBonds\n\n");
    }
    for first in 1..=bonds {
        let _ = writeln!(text, "{first} 1 {first} {}", first + fibres);
    }
    text
}

/// The input.
pub fn input(model: &Model) -> String {
    let mut text = String::new();
    head(&mut text, model);
    contact(&mut text, model);
    motion(&mut text, model);
    match &model.striker {
        Striking::Cylinder { .. } => cylinder(&mut text, model),
        Striking::Driven { ramp } => driven(&mut text, model, *ramp),
        Striking::Walls(pressing) => pressed::input::write(&mut text, model, pressing),
    }
    if !matches!(model.striker, Striking::Walls(_)) {
        measures(&mut text, model);
    }
    runs(&mut text, model);
    text
}

fn head(text: &mut String, model: &Model) {
    let fibres = model.centres.len();
    let beads = model.all_beads();
    let skin = SKIN * model.diameter;
    // What walls press keeps its place along the fibres.
    let boundary = if matches!(model.striker, Striking::Walls(_)) { "f s s" } else { "s m m" };
    // Where a truss breaks near a border between two processors, both must know the beads around it to the third
    // neighbour.
    let reach = 3.5 * model.longest.unwrap_or(1.2 * model.spacing).max(model.diameter) + skin;
    let _ = write!(
        text,
        "# {fibres} fibres as rows of {} beads: x along the yarn from mid-span, y against the blow, z across\n\
         units micro # um, pg, us: m/s, nN, fJ\n\
         atom_style hybrid bond sphere\n\
         atom_modify map array\n\
         processors * 1 1\n\
         boundary {boundary}\n\
         newton on\n\
         comm_modify vel yes cutoff {reach:e}\n\
         special_bonds lj 0 1 1\n\
         if \"$(is_defined(variable,{RESTART}))\" then \"read_restart ${{{RESTART}}}\" else \"read_data {BEADS}\"\n\n",
        model.beads
    );
    if let Striking::Walls(Pressing { middle, .. }) = model.striker {
        let _ =
            write!(text, "group fibres id 1:{beads}\ngroup free id 1:{beads}\ngroup middle id 1:{}\n", middle.fibres);
    } else {
        yarn_groups(text, model);
    }
    let _ = write!(
        text,
        "\nneighbor {skin:e} bin\n\
         neigh_modify every 1 delay 0 check yes exclude molecule/intra all binsize {:e}\n",
        model.diameter + skin
    );
    if model.carrier().is_some() {
        text.push_str("neigh_modify exclude type 1 2\n");
    }
    let _ = write!(
        text,
        "timestep {:e}\n\nbond_style harmonic\nbond_coeff 1 {:e} {:e}\n",
        model.step,
        0.5 * model.truss,
        model.spacing
    );
}

/// Layers of beads.
fn yarn_groups(text: &mut String, model: &Model) {
    let (fibres, beads) = (model.centres.len(), model.all_beads());
    let layers = |first: usize, last: usize| format!("{}:{}", first * fibres + 1, (last + 1) * fibres);
    let _ = write!(
        text,
        "group fibres id 1:{beads}\n\
         group symmetry id {}\n\
         group clamp id {}\n\
         group free subtract all symmetry clamp\n",
        layers(0, 0),
        layers(model.beads - 1, model.beads - 1)
    );
    for (number, &station) in (1..).zip(&model.stations) {
        let _ = writeln!(text, "group station{number} id {}", layers(station, station));
    }
    if model.near > 0 {
        let _ = write!(text, "group near id {}\ngroup projectile id {}\n", layers(0, model.near - 1), beads + 1);
    }
}

/// The contact of fibres: LAMMPS has Coulomb's friction for a linear contact.
fn contact(text: &mut String, model: &Model) {
    let [a, b, c] = model.contact;
    let (friction, sticking) = (model.friction, model.sticking);
    if model.centres.len() == 1 {
        let _ = writeln!(text, "pair_style zero {:e}\npair_coeff * *", model.diameter);
    } else if is_linear(model) && !matches!(model.striker, Striking::Walls(_)) {
        let _ = writeln!(text, "pair_style gran/hooke {a:e} NULL 0 {sticking:e} {friction:e} 1\npair_coeff * *");
    } else {
        let energy = format!("\"{:e}*d^2+{:e}*d^3+{:e}*d^4; d=radi+radj-r\"", a / 2.0, b / 3.0, c / 4.0);
        let cutoff = model.diameter;
        if friction == 0.0 {
            let _ = writeln!(text, "pair_style lepton/sphere {cutoff:e}\npair_coeff * * {energy}");
        } else {
            let [stiffness, friction] = [FAINT * middle_stiffness(model.contact), friction / FAINT];
            let _ = write!(
                text,
                "pair_style hybrid/overlay lepton/sphere {cutoff:e} &\n    \
                 gran/hooke {stiffness:e} NULL 0 {sticking:e} {friction:e} 1\n\
                 pair_coeff * * lepton/sphere {energy}\n\
                 pair_coeff * * gran/hooke\n"
            );
        }
    }
}

fn is_linear(model: &Model) -> bool {
    model.contact[1..] == [0.0; 2]
}

fn motion(text: &mut String, model: &Model) {
    text.push_str("\nfix motion free nve\n");
    if let Some(longest) = model.longest {
        let _ = writeln!(text, "fix breaks fibres bond/break 1 1 {longest:e}");
    }
}

/// The projectile: a bead that touches nothing carries its mass, and a cylinder moves with that bead.
fn cylinder(text: &mut String, model: &Model) {
    let Striking::Cylinder { radius, held, friction, stiffness, height, .. } = model.striker else { return };
    let bead = model.all_beads() + 1;
    let rate = model.sticking;
    let speed = model.speed;
    // What has come from beyond mid-span in a broken yarn has met its mirror image there.
    let _ = write!(
        text,
        "fix along symmetry setforce 0 NULL NULL\n\
         fix across symmetry nve\n\
         fix mirror free wall/reflect xlo 0 units box\n\n\
         if \"!$(is_defined(variable,{RESTART}))\" then \"velocity projectile set 0 {:e} 0\"\n\
         variable way equal y[{bead}]\n\
         variable speed equal vy[{bead}]\n\
         region cylinder cylinder z 0 {height:e} {radius:e} INF INF side out move NULL v_way NULL\n\
         fix wall near wall/gran/region granular hooke {stiffness:e} 1e-6 tangential linear_nohistory {:e} {friction:e} &\n    \
         damping mass_velocity region cylinder contacts\n\
         compute push near reduce sum f_wall[3]\n\
         variable rub atom f_wall[2]*vx+f_wall[3]*(vy-v_speed)+f_wall[4]*vz\n\
         compute rub near reduce sum v_rub\n",
        -speed,
        1e6 * rate
    );
    if !held {
        text.push_str("variable back equal -c_push\nfix back projectile addforce 0 v_back 0\nfix straight projectile setforce 0 NULL 0\n");
    }
    let _ = write!(
        text,
        "variable depth atom f_wall[1]*({:e}-sqrt((x-f_wall[5])^2+(y-f_wall[6])^2+(z-f_wall[7])^2))\n\
         compute depth near reduce sumsq v_depth\n\
         variable pressed equal {:e}*c_depth\n",
        0.5 * model.diameter,
        0.5 * stiffness
    );
}

/// The middle of the fibres is moved; its speed comes in as half a cosine.
fn driven(text: &mut String, model: &Model, ramp: f64) {
    let speed = model.speed;
    let (way, velocity) = if ramp > 0.0 {
        let part = format!("time<{ramp:e}");
        let way = format!("ternary({part},0.5*(time-{ramp:e}/PI*sin(PI*time/{ramp:e})),time-0.5*{ramp:e})");
        (way, format!("ternary({part},0.5*(1-cos(PI*time/{ramp:e})),1)"))
    } else {
        ("time".to_string(), "1".to_string())
    };
    let _ = write!(
        text,
        "variable none equal 0\n\
         variable way equal -{speed:e}*{way}\n\
         variable speed equal -{speed:e}*{velocity}\n\
         fix drive symmetry move variable v_none v_way v_none v_none v_speed v_none\n\
         compute push symmetry reduce sum fy\n\
         variable rub equal -c_push*v_speed\n\
         variable pressed equal 0\n"
    );
}

/// What a line of the history says: [`COLUMNS`] of the run, [`STATION_COLUMNS`] of each station.
fn measures(text: &mut String, model: &Model) {
    let [stride, repeats] = [model.stride, model.sample / model.stride];
    let rub = if model.near > 0 { "c_rub" } else { "v_rub" };
    let _ = write!(
        text,
        "\ncompute kinetic fibres ke\n\
         compute trusses all pe bond\n\
         variable left equal bonds\n\
         variable square atom vx*vx+vy*vy+vz*vz\n\
         compute fastest fibres reduce max v_square\n\
         compute length fibres bond/local dist\n\
         compute longest fibres reduce max c_length inputs local\n"
    );
    if model.centres.len() == 1 {
        text.push_str("variable contact equal 0\n");
    } else if is_linear(model) {
        let _ = write!(
            text,
            "compute force fibres pair/local force\n\
             compute forces fibres reduce sumsq c_force inputs local\n\
             variable contact equal {:e}*c_forces\n",
            0.5 / model.contact[0]
        );
    } else {
        text.push_str("compute contacts all pe pair\nvariable contact equal c_contacts\n");
    }
    let _ = writeln!(text, "fix mean all ave/time {stride} {repeats} {} c_push {rub}", model.sample);
    let mut line = String::from(
        "$(step) $(time:%.9g) $(v_speed:%.9g) $(v_way:%.9g) $(f_mean[1]:%.9g) $(f_mean[2]:%.9g) $(c_kinetic:%.9g) \
         $(c_trusses:%.9g) $(v_contact:%.9g) $(v_pressed:%.9g) $(v_left) $(c_fastest:%.9g) $(c_longest:%.9g)",
    );
    for number in 1..=model.stations.len() {
        for (i, mode) in ["min", "max", "ave", "avesq"].into_iter().enumerate() {
            let _ = writeln!(text, "compute {mode}{number} station{number} reduce {mode} z");
            debug_assert!(i < STATION_COLUMNS);
            let _ = write!(line, " $(c_{mode}{number}:%.9g)");
        }
    }
    let _ = write!(
        text,
        "fix history all print {} &\n    \"{line}\" &\n    append {HISTORY} screen no title \"\"\n",
        model.sample
    );
    if model.near == 0 {
        let _ = write!(
            text,
            "dump frames fibres custom {} {FRAMES} id x y z vy\ndump_modify frames sort id append yes format float %.9g\n",
            model.sample
        );
    }
}

fn runs(text: &mut String, model: &Model) {
    let _ = write!(
        text,
        "\nthermo_style custom step time bonds\n\
         thermo {}\n\
         thermo_modify lost error\n\
         restart {} {} {}\n",
        model.restart, model.restart, RESTARTS[0], RESTARTS[1]
    );
    let mut stops = model.frames.clone();
    let consolidation = match model.striker {
        Striking::Walls(Pressing { consolidation, .. }) if consolidation > 0 => Some(consolidation),
        _ => None,
    };
    stops.extend(consolidation);
    stops.sort_unstable();
    stops.dedup();
    // A run that goes on from a restart file has some of these behind it.
    for stop in &stops {
        let _ = writeln!(text, "if \"$(step) < {stop}\" then \"run {stop} upto\"");
        if consolidation == Some(*stop) {
            let _ = writeln!(text, "if \"$(step) == {stop}\" then \"velocity carrier set NULL 0 NULL\"");
        }
        if !model.frames.contains(stop) {
            continue;
        }
        let last = match model.striker {
            Striking::Cylinder { .. } => "vy",
            Striking::Walls(_) => "c_each",
            // All instants are in one file.
            Striking::Driven { .. } => continue,
        };
        let _ = writeln!(
            text,
            "if \"$(step) == {stop}\" then \"write_dump fibres custom {} id x y z {last} modify sort id format float %.9g\"",
            frame(*stop)
        );
    }
    let _ =
        write!(text, "if \"$(step) < {}\" then \"run {} upto\"\nprint done file {DONE}\n", model.steps, model.steps);
}

/// The file of the beads at a step.
pub fn frame(step: u64) -> String {
    format!("frame-{step}.txt")
}
