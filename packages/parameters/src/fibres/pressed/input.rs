//! What LAMMPS reads of walls, and the lines that it writes of a section between them.

use std::fmt::Write;

use crate::fibres::input::HISTORY;
use crate::fibres::model::{Model, Pressing};
use crate::fibres::scene::{Pair, Walls};

/// Columns of a line of the history.
pub const COLUMNS: usize = 23;
/// The pairs of walls as variables are called: across the yarn and along the blow.
const AXES: [&str; 2] = ["z", "y"];

/// The walls, what brakes the beads, and the lines.
pub fn write(text: &mut String, model: &Model, pressing: &Pressing) {
    let _ = writeln!(text, "fix along fibres setforce 0 NULL NULL\nfix brake fibres viscous {:e}\n", pressing.braking);
    course(text, model, pressing);
    walls(text, model, pressing);
    if pressing.walls == Walls::Biaxial {
        carrier(text, model, pressing);
    }
    measures(text, model);
}

/// The part of the way that is gone, and its rate: half cosines, one for each leg.
fn course(text: &mut String, model: &Model, pressing: &Pressing) {
    let Pressing { closing, duration, legs, consolidation, .. } = *pressing;
    let start = consolidation as f64 * model.step;
    let rate = std::f64::consts::PI * f64::from(legs) / (duration - start);
    let (since, from) = if consolidation > 0 {
        (format!("(time-{start:e})"), format!("(step>{consolidation})*"))
    } else {
        ("time".to_string(), String::new())
    };
    let _ = write!(
        text,
        "variable part equal {from}{:e}*(1-cos({rate:e}*{since}))\n\
         variable rate equal {from}{:e}*sin({rate:e}*{since})\n",
        0.5 * closing,
        0.5 * closing * rate
    );
}

/// Where the walls are; their power, and the section's Kirchhoff stresses times its volume at rest: a wall's force
/// times the way between the two, in the mean of the two.
fn walls(text: &mut String, model: &Model, pressing: &Pressing) {
    let Pressing { walls, half, stiffness, .. } = *pressing;
    let carrier = model.all_beads() + 1;
    let contact = format!("{:e} 0 {:e}", 0.5 * stiffness, 0.5 * model.diameter);
    let (mut faces, mut power, mut stresses) = (String::new(), String::from("0"), String::new());
    for ((name, half), pair) in AXES.into_iter().zip(half).zip(walls.pairs()) {
        let Some(pair) = pair else {
            let _ = write!(stresses, "variable {name}hi equal 0\nvariable {name}stress equal 0\n");
            continue;
        };
        // Place and speed of the upper one.
        let (place, speed) = match (pair, walls) {
            (Pair::Stay, _) => (format!("{half:e}"), None),
            (Pair::KeepPressure, _) => (format!("{name}[{carrier}]"), Some(format!("v{name}[{carrier}]"))),
            (Pair::Close, Walls::Biaxial) => (
                format!("{name}[{carrier}]*(1-v_part)"),
                Some(format!("(v{name}[{carrier}]*(1-v_part)-{name}[{carrier}]*v_rate)")),
            ),
            (Pair::Close, _) => (format!("{half:e}*(1-v_part)"), Some(format!("(-{half:e}*v_rate)"))),
        };
        let _ = write!(text, "variable {name}hi equal {place}\nvariable {name}lo equal -v_{name}hi\n");
        let _ = write!(faces, " &\n    {name}lo v_{name}lo {contact} {name}hi v_{name}hi {contact}");
        // The faces are counted as they are given.
        let first = faces.matches("lo v_").count() * 2 - 1;
        let _ = write!(
            stresses,
            "variable {name}push equal abs(f_walls[{first}])+abs(f_walls[{}])\n\
             variable {name}stress equal v_{name}push*v_{name}hi\n",
            first + 1
        );
        if let Some(speed) = speed {
            let _ = write!(power, "-v_{name}push*{speed}");
        }
    }
    let _ = write!(text, "fix walls fibres wall/harmonic{faces}\n{stresses}variable power equal {power}\n\n");
}

/// A bead that touches nothing is at the corner of the walls that move by forces, carries their mass, and is moved by
/// what the pressure has over the section. Once this has settled, top and bottom close from where the bead is.
fn carrier(text: &mut String, model: &Model, pressing: &Pressing) {
    let Pressing { pressure, braking, consolidation, .. } = *pressing;
    let start = consolidation as f64 * model.step;
    let _ = write!(
        text,
        "group carrier id {}\n\
         fix carrier carrier nve\n\
         fix slow carrier viscous {:e}\n\
         variable pressure equal {pressure:e}*(1-(step<{consolidation})*0.5*(1+cos(PI*time/{start:e})))\n\
         variable zmove equal v_zpush-v_pressure*{length:e}*v_yhi\n\
         variable ymove equal (step<{consolidation})*(v_ypush-v_pressure*{length:e}*v_zhi)\n\
         fix move carrier addforce 0 v_ymove v_zmove\n\n",
        model.all_beads() + 1,
        braking * model.all_beads() as f64,
        // The face of two walls over half the way between the others.
        length = 4.0 * model.spacing
    );
}

/// What a line of the history says.
fn measures(text: &mut String, model: &Model) {
    let _ = write!(
        text,
        "compute kinetic fibres ke\n\
         compute contacts all pe pair\n\
         compute each fibres pe/atom pair\n\
         compute inside middle reduce sum c_each\n\
         variable yy atom y*y\nvariable zz atom z*z\nvariable yz atom y*z\n\
         compute places fibres reduce ave z y v_zz v_yz v_yy\n\
         compute inner middle reduce ave z y v_zz v_yz v_yy\n\
         fix mean all ave/time 1 {sample} {sample} v_power c_kinetic v_zstress v_ystress\n",
        sample = model.sample
    );
    let mut line = String::from(
        "$(step) $(time:%.9g) $(v_part:%.9g) $(f_mean[1]:%.9g) $(f_mean[2]:%.9g) $(c_kinetic:%.9g) $(c_contacts:%.9g) \
         $(c_inside:%.9g) $(f_walls:%.9g) $(f_mean[3]:%.9g) $(f_mean[4]:%.9g) $(v_zhi:%.12g) $(v_yhi:%.12g)",
    );
    for group in ["places", "inner"] {
        for i in 1..=5 {
            let _ = write!(line, " $(c_{group}[{i}]:%.15g)");
        }
    }
    debug_assert_eq!(line.matches("$(").count(), COLUMNS);
    let _ = write!(
        text,
        "fix history all print {} &\n    \"{line}\" &\n    append {HISTORY} screen no title \"\"\n",
        model.sample
    );
}
