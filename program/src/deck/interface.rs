//! Under which names and numbers the hosts find a law, and what they store for it. Counts of properties and state variables are
//! those of the law's tables.

use toron::host::openradioss::card::{self, Layout};
use toron::law::description::{self, Description};

use crate::material::preset::LawName;

/// A law as the hosts see it.
#[derive(Debug)]
pub struct Interface {
    pub law: &'static Description,
    /// LS-DYNA's number of the material, and with it of the routine: `umat41`.
    pub ls_dyna: u32,
    /// CalculiX's name of the material.
    pub calculix: &'static str,
    /// MGIS's and MTest's name of the behaviour.
    pub behaviour: &'static str,
    /// OpenRadioss: nn of `/MAT/USERnn` and the options behind the properties.
    pub openradioss: &'static Layout,
}

static HYPERELASTIC: Interface = Interface {
    law: &description::HYPERELASTIC,
    ls_dyna: 41,
    calculix: "@TORON_HYPERELASTIC",
    behaviour: "ToronHyperelastic",
    openradioss: &card::HYPERELASTIC,
};

static LINEAR_ELASTIC: Interface = Interface {
    law: &description::LINEAR_ELASTIC,
    ls_dyna: 43,
    calculix: "@TORON_LINEARELASTIC",
    behaviour: "ToronLinearElastic",
    openradioss: &card::LINEAR_ELASTIC,
};

impl Interface {
    pub fn of(law: LawName) -> &'static Interface {
        match law {
            LawName::Hyperelastic => &HYPERELASTIC,
            LawName::LinearElastic => &LINEAR_ELASTIC,
        }
    }
}
