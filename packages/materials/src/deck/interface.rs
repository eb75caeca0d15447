//! Under which names and numbers the hosts find a law, and what they store for it. Counts of properties and state
//! variables are those of the law's tables.

use toron::host::laws::LibraryLaw;
use toron::host::openradioss::MyReal;

use crate::material::laws::{LawName, Names};

/// A law as the hosts find it.
#[derive(Debug)]
pub struct Interface {
    /// What Abaqus's names of materials begin with; `None` where the counts of properties and state variables tell the
    /// laws apart.
    pub abaqus: Option<&'static str>,
    /// LS-DYNA's number of the material, and with it of the routine: `umat41`.
    pub ls_dyna: u32,
    /// CalculiX's name of the material: `@`, the library's name without `lib` and `.so`, `_`, the law's.
    pub calculix: String,
    /// MGIS's and MTest's library, and name of the behaviour.
    pub library: &'static str,
    pub behaviour: &'static str,
    /// OpenRadioss: nn of `/MAT/USERnn`, and how many options stand behind the properties.
    pub openradioss: i32,
    pub options: usize,
}

impl Interface {
    pub fn of(law: LawName) -> Interface {
        match law.names() {
            Names::Library(&LibraryLaw { symbol, behaviour, user, umat, .. }) => Interface {
                abaqus: None,
                ls_dyna: umat,
                calculix: format!("@TORON_{symbol}"),
                library: "libtoron_mgis.so",
                behaviour,
                openradioss: user,
                options: f64::TORON.material(user).map_or(0, |material| material.layout.options),
            },
            Names::Own(law) => Interface {
                abaqus: Some(law.symbol),
                ls_dyna: 41,
                calculix: format!("@OWN_{}", law.symbol),
                library: "libOWN.so",
                behaviour: law.symbol,
                openradioss: law.number,
                // Where the fibre direction comes from.
                options: usize::from(law.description.has_fibre()),
            },
        }
    }
}
