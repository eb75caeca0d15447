//! The shape of a weave: centre lines and sections, at the stations where elements end.

use super::pattern::Pattern;
use super::section::{Columns, Section, Thread};
use toron_shared::numbers::number;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Along x.
    Warp,
    /// Along y.
    Weft,
}

impl Family {
    pub const BOTH: [Family; 2] = [Family::Warp, Family::Weft];

    pub fn other(self) -> Family {
        if self == Family::Warp { Family::Weft } else { Family::Warp }
    }

    pub fn name(self) -> &'static str {
        if self == Family::Warp { "warp" } else { "weft" }
    }

    /// x and y of what is `along` its yarns from the origin and `across` them.
    pub fn placed(self, along: f64, across: f64) -> [f64; 2] {
        if self == Family::Warp { [along, across] } else { [across, along] }
    }
}

/// What a weave is, and how fine its mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Weave {
    pub pattern: Pattern,
    /// Warp and weft.
    pub threads: [Thread; 2],
    /// Elements along a yarn from one crossing to the next: an even number.
    pub along: usize,
    pub columns: usize,
    pub rows: usize,
    /// The least distance between the faces of crossing yarns.
    pub clearance: f64,
}

impl Weave {
    pub fn thread(&self, family: Family) -> &Thread {
        &self.threads[family as usize]
    }

    /// The length of an element along x or y: yarns of the other family are crossed at its pitch.
    pub fn step(&self, family: Family) -> f64 {
        self.thread(family.other()).pitch / self.along as f64
    }

    /// The amplitude of straight yarns that lie upon each other, which needs no mesh; those that bend have hardly
    /// another.
    pub(super) fn flat_amplitude(&self) -> f64 {
        0.25 * (self.threads[0].height + self.threads[1].height) + 0.5 * self.clearance
    }

    /// The same weave turned by a right angle, where its pattern is its own mirror image by planes normal to x and to
    /// y.
    pub fn exchanged(&self) -> Weave {
        let [warp, weft] = self.threads;
        Weave { pattern: self.pattern.exchanged(), threads: [weft, warp], ..self.clone() }
    }

    /// Says what cannot be meshed.
    ///
    /// # Errors
    /// What is wrong, and what is allowed.
    pub fn check(&self) -> Result<(), String> {
        if self.along < 2 || !self.along.is_multiple_of(2) || self.columns == 0 || self.rows == 0 {
            return Err("along is an even number from 2 on, columns and rows are at least 1".to_string());
        }
        Family::BOTH.into_iter().try_for_each(|family| self.check_thread(family))
    }

    /// Says what of a family cannot be meshed.
    ///
    /// # Errors
    /// What is wrong, and what is allowed.
    pub fn check_thread(&self, family: Family) -> Result<(), String> {
        let name = family.name();
        let Thread { pitch, width, height, .. } = *self.thread(family);
        if [pitch, width, height, self.clearance].iter().any(|size| !(size.is_finite() && *size > 0.0)) {
            return Err(format!("{name}: pitch, width, height and clearance; allowed: finite numbers > 0"));
        }
        let most = pitch - 2.0 * self.clearance;
        if width > most {
            return Err(format!(
                "{name}.width is {width}; allowed: up to {}, its pitch less twice the clearance",
                number(most)
            ));
        }
        if height > width {
            return Err(format!("{name}.height is {height}; allowed: up to its width, {width}"));
        }
        Ok(())
    }
}

/// A weave whose centre lines have an amplitude.
///
/// Station k of a yarn is k elements from the crossing with the yarn numbered 0. A section stands upright there, and
/// its height is the yarn's over the cosine of the centre line's slope: across the fibre it is the yarn's own, and the
/// mesh has the volume of area times length. Upright columns make both yarns of a crossing meet in faces that are
/// nearly parallel everywhere: one rises over the other's outline as its own outline falls.
#[derive(Clone, Debug)]
pub struct Geometry {
    pub weave: Weave,
    pub columns: [Columns; 2],
    /// The height of the centre lines at crossings.
    pub amplitude: f64,
    /// Heights at the stations from a crossing to half way to the next, where the yarn changes sides.
    profiles: [Vec<f64>; 2],
}

impl Geometry {
    /// The weave with this amplitude, whatever its clearance then is.
    pub fn new(weave: &Weave, amplitude: f64) -> Geometry {
        let columns = weave.threads.each_ref().map(|thread| Columns::new(thread, weave.columns));
        let profiles = Family::BOTH.map(|family| {
            let crossed = family.other();
            profile(weave.thread(crossed), columns[crossed as usize].half_width(), weave.along / 2, amplitude)
        });
        Geometry { weave: weave.clone(), columns, amplitude, profiles }
    }

    pub fn columns(&self, family: Family) -> &Columns {
        &self.columns[family as usize]
    }

    /// Whether a yarn is over (1) or under (-1) the one that it crosses.
    fn side(&self, family: Family, yarn: i64, crossed: i64) -> f64 {
        let [warp, weft] = if family == Family::Warp { [yarn, crossed] } else { [crossed, yarn] };
        if self.weave.pattern.warp_is_over(warp, weft) == (family == Family::Warp) { 1.0 } else { -1.0 }
    }

    /// The centre line's height at a station: straight between crossings on one side.
    pub fn centre(&self, family: Family, yarn: i64, station: i64) -> f64 {
        let along = self.weave.along as i64;
        let crossed = (station + along / 2).div_euclid(along);
        let beside = station - crossed * along;
        let side = self.side(family, yarn, crossed);
        if side == self.side(family, yarn, crossed + beside.signum()) {
            return side * self.amplitude;
        }
        side * self.profiles[family as usize][beside.unsigned_abs() as usize]
    }

    /// The slope of the centre line from a station to the next.
    pub fn slope(&self, family: Family, yarn: i64, station: i64) -> f64 {
        let rise = self.centre(family, yarn, station + 1) - self.centre(family, yarn, station);
        rise / self.weave.step(family)
    }

    /// The length of the centre line over that of its projection, from a station to the next.
    pub fn stretch(&self, family: Family, yarn: i64, station: i64) -> f64 {
        self.slope(family, yarn, station).hypot(1.0)
    }

    /// What an upright height is of one across the fibre: the mean of the elements before and behind.
    pub fn upright(&self, family: Family, yarn: i64, station: i64) -> f64 {
        0.5 * (self.stretch(family, yarn, station - 1) + self.stretch(family, yarn, station))
    }

    /// The length of a family's centre lines over the length of the panel that they cross, less 1.
    pub fn crimp(&self, family: Family) -> f64 {
        let [warps, wefts] = self.weave.pattern.repeat();
        let [yarns, crossed] = if family == Family::Warp { [warps, wefts] } else { [wefts, warps] };
        let stations = (crossed * self.weave.along) as i64;
        let length = |yarn: usize| (0..stations).map(|k| self.stretch(family, yarn as i64, k)).sum::<f64>();
        (0..yarns).map(length).sum::<f64>() / (yarns as f64 * stations as f64) - 1.0
    }

    /// The steepest slope of all centre lines.
    pub fn steepest(&self) -> f64 {
        let drop = |family: Family| {
            let heights = &self.profiles[family as usize];
            heights.windows(2).map(|pair| pair[0] - pair[1]).fold(0.0, f64::max) / self.weave.step(family)
        };
        drop(Family::Warp).max(drop(Family::Weft))
    }
}

/// Heights from a crossing to where the yarn is half way to the other side: along the outline of the crossed yarn,
/// which it lies on, then along the tangent that reaches height 0 there.
pub(super) fn profile(crossed: &Thread, half_width: f64, steps: usize, amplitude: f64) -> Vec<f64> {
    let half_pitch = 0.5 * crossed.pitch;
    let outline = |x: f64| amplitude - 0.5 * crossed.height + crossed.half_height(x / half_width);
    // The tangent touches where the line to the end is steepest; the slope rises up to there, then falls.
    let slope = |x: f64| outline(x) / (half_pitch - x);
    let touch = if crossed.section == Section::Rectangle { half_width } else { maximum(slope, half_width) };
    let height = |step: usize| {
        let x = half_pitch * step as f64 / steps as f64;
        if x < touch { outline(x) } else { slope(touch) * (half_pitch - x) }
    };
    (0..=steps).map(height).collect()
}

/// Where a function that rises, then falls, is largest between 0 and `end`.
fn maximum(function: impl Fn(f64) -> f64, end: f64) -> f64 {
    let [mut low, mut high] = [0.0, end];
    for _ in 0..100 {
        let [left, right] = [(2.0 * low + high) / 3.0, (low + 2.0 * high) / 3.0];
        if function(left) < function(right) {
            low = left;
        } else {
            high = right;
        }
    }
    0.5 * (low + high)
}
