//! Whether the yarns of a mesh are as long as those of the weave.
//!
//! The centre line of a mesh is a polygon, and its sections are polygons too, which keep their clearance only with a
//! larger amplitude than the curves behind them. What a coarse mesh's yarns are too long is slack: they carry nothing
//! until it is pulled out.

use super::centre_line::CentreLines;
use super::geometry::{Family, Geometry, Weave};
use super::panel::Centre;
use toron_shared::numbers::number;

/// The crimp of a mesh may differ by this from that of the weave. It is a strain; in the panel of the tutorial, struck
/// at 25 m/s, 0.6 % of slack make the deflection 18 % larger, in proportion this 7 %.
pub const LARGEST: f64 = 0.0025;
/// Meshes that are tried for an advice, by elements along a yarn from a crossing to the next, and across its section.
/// The last one stands for the weave: finer ones have hardly another crimp.
const MESHES: [[usize; 2]; 8] = [[6, 4], [6, 6], [8, 6], [10, 8], [12, 10], [16, 12], [24, 18], [32, 24]];

/// The length of yarns over that of the panel which they cross, less 1; of warp and weft.
pub type Crimp = [f64; 2];

fn meshed(geometry: &Geometry) -> Crimp {
    Family::BOTH.map(|family| geometry.crimp(family))
}

fn with_mesh(weave: &Weave, [along, columns]: [usize; 2]) -> Option<Crimp> {
    Weave { along, columns, ..weave.clone() }.solve().ok().as_ref().map(meshed)
}

/// Of the smooth centre lines, over the whole pattern.
fn smooth(weave: &Weave) -> Crimp {
    let [warps, wefts] = weave.pattern.repeat();
    Family::BOTH.map(|family| {
        let [yarns, crossed] = if family == Family::Warp { [warps, wefts] } else { [wefts, warps] };
        let length = crossed as f64 * weave.thread(family.other()).pitch;
        let lines = CentreLines::new(weave, family, Centre::Crossing);
        (0..yarns as i64).map(|yarn| lines.arc(yarn, length)).sum::<f64>() / (yarns as f64 * length) - 1.0
    })
}

pub fn differ(one: Crimp, other: Crimp) -> bool {
    one.iter().zip(other).any(|(one, other)| (one - other).abs() > LARGEST)
}

/// Of warp and weft.
pub fn percent(crimp: Crimp) -> String {
    crimp.map(|crimp| format!("{} %", number(100.0 * crimp))).join(" and ")
}

/// What to say of a mesh whose yarns are too long or too short, and which one will do.
pub fn warning(geometry: &Geometry) -> Option<String> {
    let (weave, found) = (&geometry.weave, meshed(geometry));
    // A fine mesh takes longer to solve, and tells nothing else unless sections have corners that meet, or yarns hardly
    // room to bend.
    if !differ(found, smooth(weave)) {
        return None;
    }
    let fine = with_mesh(weave, MESHES[MESHES.len() - 1]).filter(|&fine| differ(found, fine))?;
    let finer = MESHES.into_iter().filter(|[along, columns]| along * columns > weave.along * weave.columns);
    let mut will_do = finer.filter(|&mesh| with_mesh(weave, mesh).is_some_and(|crimp| !differ(crimp, fine)));
    let advice = match will_do.next() {
        Some([along, columns]) => format!("take along = {along} and columns = {columns}"),
        None => "take more elements along and columns".to_string(),
    };
    Some(format!(
        "with along = {} and columns = {} the yarns of warp and weft have a crimp of {},\n\
         and with a fine mesh {}, more than {} % apart: yarns that are too long are slack at first: {advice}",
        weave.along,
        weave.columns,
        percent(found),
        percent(fine),
        100.0 * LARGEST
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::weave::pattern::Pattern;
    use crate::weave::preset::Preset;
    use crate::weave::section::{Section, Thread};
    use toron::host::units::UnitSystem;

    /// A plain weave of ellipses: pitch, width and height.
    fn weave([pitch, width, height]: [f64; 3], [along, columns]: [usize; 2]) -> Weave {
        let thread = Thread { pitch, section: Section::Ellipse, width, height };
        Weave { pattern: Pattern::plain(), threads: [thread; 2], along, columns, rows: 2, clearance: 1e-3 }
    }

    fn warned(weave: &Weave) -> Option<String> {
        warning(&weave.solve().expect("it has room"))
    }

    /// The tutorial's panel, and one of Twaron with wide yarns: their coarse meshes are far too long, and those that
    /// the warnings name are not. The preset's coarse mesh is 0.15 % off.
    #[test]
    fn slack_is_found_and_the_mesh_that_is_named_will_do() {
        for sizes in [[1.18, 0.95, 0.128], [1.4286, 1.2, 0.085]] {
            let text = warned(&weave(sizes, [4, 4])).expect("a warning");
            let number = |key: &str| {
                let behind = &text[text.rfind(key).expect(key) + key.len()..];
                behind.split(' ').next().and_then(|number| number.parse::<usize>().ok()).expect("a number")
            };
            let named = [number("along = "), number("columns = ")];
            assert!(named[0] * named[1] > 16, "{text}");
            assert_eq!(warned(&weave(sizes, named)), None, "{text}");
        }
        let units = UnitSystem::parse("mm-g-ms").expect("units");
        let preset = Preset::find("kevlar-s706").expect("a preset").weave(&units);
        for [along, columns] in [[4, 4], [8, 6], [16, 12]] {
            assert_eq!(warned(&Weave { along, columns, ..preset.clone() }), None);
        }
    }

    /// Corners of rectangles meet where the other yarn descends, on any mesh: a fine one is not as short as the smooth
    /// line.
    #[test]
    fn a_fine_mesh_stands_for_the_weave_where_the_smooth_line_does_not() {
        let rectangle = |mesh: [usize; 2]| {
            let mut weave = weave([0.747, 0.5337, 0.115], mesh);
            weave.threads.iter_mut().for_each(|thread| thread.section = Section::Rectangle);
            weave
        };
        let fine = rectangle([32, 24]);
        assert!(differ(meshed(&fine.solve().expect("it has room")), smooth(&fine)));
        assert_eq!(warned(&fine), None);
        assert!(warned(&rectangle([4, 4])).expect("a warning").contains("take along = 16 and columns = 12"));
    }
}
