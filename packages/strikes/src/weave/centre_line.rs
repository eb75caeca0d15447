//! Arc lengths along the yarns of a weave, whatever its mesh.
//!
//! The centre line that a mesh has is a polygon, whose amplitude depends on the mesh. This one is the curve behind it:
//! along the outline of the crossed yarn and its tangent, with the amplitude at which straight yarns lie upon each
//! other.

use super::geometry::{Family, Weave, profile};
use super::panel::{Centre, Panel};
use super::reader::Woven;

/// Chords of the curve from a crossing to half way to the next.
const CHORDS: usize = 512;

/// The centre lines of a family.
#[derive(Clone, Debug)]
pub struct CentreLines<'a> {
    weave: &'a Weave,
    family: Family,
    /// From a crossing to half way to the next, along the weave.
    half_pitch: f64,
    /// Arc lengths from a crossing to the ends of the chords, where the yarn changes sides.
    arcs: Vec<f64>,
    /// The origin, along the weave from the crossing with the yarn numbered 0.
    origin: f64,
}

impl CentreLines<'_> {
    pub fn new(weave: &Weave, family: Family, centre: Centre) -> CentreLines<'_> {
        let crossed = weave.thread(family.other());
        let half_pitch = 0.5 * crossed.pitch;
        let heights = profile(crossed, 0.5 * crossed.width, CHORDS, weave.flat_amplitude());
        let chord = half_pitch / CHORDS as f64;
        let mut arcs = vec![0.0];
        arcs.extend(heights.windows(2).scan(0.0, |arc, pair| {
            *arc += chord.hypot(pair[1] - pair[0]);
            Some(*arc)
        }));
        let origin = if centre == Centre::Gap { -half_pitch } else { 0.0 };
        CentreLines { weave, family, half_pitch, arcs, origin }
    }

    /// The arc length of a yarn from the plane through the origin to a place along the weave, counted from there.
    pub fn arc(&self, yarn: i64, place: f64) -> f64 {
        self.beyond_crossing(yarn, self.origin + place) - self.beyond_crossing(yarn, self.origin)
    }

    /// The arc lengths of a yarn's ends, where the outline cuts it: also of that part of a quarter's which is a mirror
    /// image.
    pub fn ends(&self, panel: &Panel, yarn: i64, coordinate: f64) -> [f64; 2] {
        panel.interval(self.family, coordinate).map(|end| self.arc(yarn, end))
    }

    /// The same from the crossing with the yarn numbered 0.
    fn beyond_crossing(&self, yarn: i64, place: f64) -> f64 {
        let halves = (place / self.half_pitch).floor();
        let beside = place - halves * self.half_pitch;
        let half = halves as i64;
        let whole: f64 = (half.min(0)..half.max(0)).map(|half| self.of_half(yarn, half, self.half_pitch)).sum();
        (if half < 0 { -whole } else { whole }) + self.of_half(yarn, half, beside)
    }

    /// The arc length from the start of a half pitch, numbered from the crossing with yarn 0, to a place in it.
    fn of_half(&self, yarn: i64, half: i64, place: f64) -> f64 {
        let crossed = half.div_euclid(2);
        if self.is_over(yarn, crossed) == self.is_over(yarn, crossed + 1) {
            return place;
        }
        // The second half runs towards the next crossing.
        if half.rem_euclid(2) == 0 {
            self.of_arc(place)
        } else {
            self.arcs[CHORDS] - self.of_arc(self.half_pitch - place)
        }
    }

    /// The arc length from a crossing to a place before half way to the next.
    fn of_arc(&self, place: f64) -> f64 {
        let position = (place / self.half_pitch * CHORDS as f64).clamp(0.0, CHORDS as f64);
        let chord = (position as usize).min(CHORDS - 1);
        self.arcs[chord] + (position - chord as f64) * (self.arcs[chord + 1] - self.arcs[chord])
    }

    fn is_over(&self, yarn: i64, crossed: i64) -> bool {
        let [warp, weft] = if self.family == Family::Warp { [yarn, crossed] } else { [crossed, yarn] };
        self.weave.pattern.warp_is_over(warp, weft) == (self.family == Family::Warp)
    }
}

impl Woven {
    /// Of warp and weft.
    pub fn centre_lines(&self) -> [CentreLines<'_>; 2] {
        Family::BOTH.map(|family| CentreLines::new(&self.geometry.weave, family, self.panel.centre))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::weave::geometry::Geometry;
    use crate::weave::pattern::Pattern;
    use crate::weave::preset::Preset;
    use toron::host::units::UnitSystem;

    fn weave(rows: &[&str]) -> Weave {
        let units = UnitSystem::parse("mm-g-ms").expect("units");
        let weave = Preset::find("kevlar-s706").expect("a preset").weave(&units);
        let rows: Vec<String> = rows.iter().map(|row| (*row).to_string()).collect();
        Weave { pattern: Pattern::parse(&rows).expect("a pattern"), ..weave }
    }

    /// Over many pitches it is as long as a fine mesh's centre line, whose amplitude is hardly another.
    #[test]
    fn arc_lengths_are_those_of_a_fine_mesh() {
        for rows in [&["ou", "uo"][..], &["oouu", "uoou", "uuoo", "ouuo"]] {
            let fine = Weave { along: 64, columns: 24, ..weave(rows) };
            let geometry = fine.solve().expect("it has room");
            for family in Family::BOTH {
                let lines = CentreLines::new(&fine, family, Centre::Crossing);
                let place = 12.0 * fine.thread(family.other()).pitch;
                let found = [lines.arc(1, place), -lines.arc(1, -place)].map(|arc| arc / place - 1.0);
                assert!((found[0] / found[1] - 1.0).abs() < 1e-9, "{found:?}");
                assert!((found[0] / geometry.crimp(family) - 1.0).abs() < 0.04, "{found:?} {}", geometry.crimp(family));
                // Piece by piece too.
                for station in -100..100 {
                    let [from, to] = [station, station + 1].map(|k| lines.arc(1, fine.step(family) * f64::from(k)));
                    let meshed = fine.step(family) * geometry.stretch(family, 1, i64::from(station));
                    assert!(((to - from) / meshed - 1.0).abs() < 2e-3, "{station}: {} {meshed}", to - from);
                }
            }
        }
    }

    /// To the bit: a mesh has no part in it.
    #[test]
    fn a_mesh_does_not_change_arc_lengths() {
        let [coarse, fine] = [(4, 4, 2), (16, 12, 4)].map(|(along, columns, rows)| Weave {
            along,
            columns,
            rows,
            ..weave(&["ou", "uo"])
        });
        assert_ne!(coarse.solve().map(|of| of.amplitude), fine.solve().map(|of: Geometry| of.amplitude));
        for family in Family::BOTH {
            let [a, b] = [&coarse, &fine].map(|weave| CentreLines::new(weave, family, Centre::Crossing));
            assert!((-300..300).all(|i| a.arc(2, 0.1 * f64::from(i)) == b.arc(2, 0.1 * f64::from(i))));
        }
    }

    /// The gap lies half a pitch before the crossing.
    #[test]
    fn the_origin_may_be_a_gap() {
        let weave = weave(&["ouuo", "uoou", "uoou", "ouuo"]);
        let [crossing, gap] =
            [Centre::Crossing, Centre::Gap].map(|centre| CentreLines::new(&weave, Family::Weft, centre));
        let half = 0.5 * weave.thread(Family::Warp).pitch;
        for place in [-3.3, -0.1, 0.0, 0.2, 5.0] {
            let wanted = crossing.arc(0, place - half) - crossing.arc(0, -half);
            assert!((gap.arc(0, place) - wanted).abs() < 1e-12);
        }
        assert_eq!(gap.arc(0, 0.0), 0.0);
    }
}
