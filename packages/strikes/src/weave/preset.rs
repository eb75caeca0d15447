//! Weaves that are known by name.

use toron::host::units::UnitSystem;

use super::geometry::Weave;
use super::pattern::Pattern;
use super::section::{Section, Thread};
use toron_materials::units::LENGTH;

/// Elements of a weave where a scene does not say otherwise, and the clearance in metres.
pub const ALONG: usize = 8;
pub const COLUMNS: usize = 6;
pub const ROWS: usize = 2;
pub const CLEARANCE: f64 = 1e-6;

/// A weave of which warp and weft are alike, lengths in metres.
pub struct Preset {
    pub name: &'static str,
    pub source: &'static str,
    pattern: fn() -> Pattern,
    thread: Thread,
}

const INCH: f64 = 25.4e-3;

pub static PRESETS: [Preset; 1] = [Preset {
    name: "kevlar-s706",
    source: "Kevlar S706: plain, 34 by 34 yarns of Kevlar KM2 600 an inch",
    pattern: Pattern::plain,
    thread: Thread { pitch: INCH / 34.0, section: Section::Ellipse, width: 0.5337e-3, height: 0.115e-3 },
}];

impl Preset {
    pub fn find(name: &str) -> Option<&'static Preset> {
        PRESETS.iter().find(|preset| preset.name == name)
    }

    /// The weave in these units, with the usual mesh.
    pub fn weave(&self, units: &UnitSystem) -> Weave {
        let length = |metres: f64| units.from_si(metres, LENGTH);
        let Thread { pitch, section, width, height } = self.thread;
        let thread = Thread { pitch: length(pitch), section, width: length(width), height: length(height) };
        Weave {
            pattern: (self.pattern)(),
            threads: [thread; 2],
            along: ALONG,
            columns: COLUMNS,
            rows: ROWS,
            clearance: length(CLEARANCE),
        }
    }
}
