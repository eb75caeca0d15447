//! What LAMMPS reads of walls, and the lines that it writes of a section between them.

use std::fmt::Write;

use crate::fibres::input::HISTORY;
use crate::fibres::model::{Model, Pressing};

/// Columns of a line of the history.
pub const COLUMNS: usize = 19;

/// The walls, what brakes the beads, and the lines.
pub fn write(text: &mut String, model: &Model, pressing: &Pressing) {
    let Pressing { walls, closing, duration, half, stiffness, braking, .. } = *pressing;
    let _ = write!(
        text,
        "fix along fibres setforce 0 NULL NULL\n\
         fix brake fibres viscous {braking:e}\n\n\
         variable part equal {:e}*(1-cos(PI*time/{duration:e}))\n\
         variable rate equal {:e}*sin(PI*time/{duration:e})\n",
        0.5 * closing,
        0.5 * closing * std::f64::consts::PI / duration
    );
    let (mut faces, mut power) = (String::new(), String::from("0"));
    let contact = format!("{:e} 0 {:e}", 0.5 * stiffness, 0.5 * model.diameter);
    for ((name, half), closes) in ["z", "y"].into_iter().zip(half).zip(walls.pairs()) {
        let Some(closes) = closes else { continue };
        let place = if closes { format!("{half:e}*(1-v_part)") } else { format!("{half:e}") };
        let _ = write!(text, "variable {name}hi equal {place}\nvariable {name}lo equal -v_{name}hi\n");
        let _ = write!(faces, " &\n    {name}lo v_{name}lo {contact} {name}hi v_{name}hi {contact}");
        if closes {
            // The faces are counted as they are given.
            let first = faces.matches("lo v_").count() * 2 - 1;
            let _ = write!(power, "+{half:e}*v_rate*(abs(f_walls[{first}])+abs(f_walls[{}]))", first + 1);
        }
    }
    let _ = write!(
        text,
        "fix walls fibres wall/harmonic{faces}\n\
         variable power equal {power}\n\n\
         compute kinetic fibres ke\n\
         compute contacts all pe pair\n\
         compute each fibres pe/atom pair\n\
         compute inside middle reduce sum c_each\n\
         variable yy atom y*y\nvariable zz atom z*z\nvariable yz atom y*z\n\
         compute places fibres reduce ave z y v_zz v_yz v_yy\n\
         compute inner middle reduce ave z y v_zz v_yz v_yy\n\
         fix mean all ave/time 1 {sample} {sample} v_power c_kinetic\n",
        sample = model.sample
    );
    let mut line = String::from(
        "$(step) $(time:%.9g) $(v_part:%.9g) $(f_mean[1]:%.9g) $(f_mean[2]:%.9g) $(c_kinetic:%.9g) $(c_contacts:%.9g) \
         $(c_inside:%.9g) $(f_walls:%.9g)",
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
