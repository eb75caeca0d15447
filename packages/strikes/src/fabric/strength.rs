//! The strength of each element of a panel's yarns.

use super::scene::Case;
use crate::scene_keys::keys::Reader;
use crate::strength::field;
use crate::strength::scatter::Strength;
use crate::weave::centre_line::CentreLines;
use crate::weave::cloth::Cloth;
use crate::weave::geometry::Family;
use crate::weave::layup::Ply;
use crate::weave::model::{Model, Yarn};
use crate::weave::panel::Place;
use toron_explicit_host::lanes::smallest;
use toron_shared::error::Error;

/// A case whose strength scatters.
pub struct PanelStrength<'a> {
    case: &'a Case,
    strength: &'a Strength,
    /// Of each ply's warp and weft.
    lines: Vec<[CentreLines<'a>; 2]>,
}

impl<'a> PanelStrength<'a> {
    pub fn of(case: &'a Case) -> Option<PanelStrength<'a>> {
        let lines = || case.cloth.plies().iter().map(|ply| ply.woven.centre_lines()).collect();
        case.strength.as_ref().map(|strength| PanelStrength { case, strength, lines: lines() })
    }

    /// The strength of each element of a yarn: the least of the cells that its section meets.
    pub fn strengths(&self, panel: &Model, yarn: &Yarn) -> Vec<f64> {
        let Ply { woven, .. } = &self.case.cloth.plies()[yarn.ply];
        let lines = &self.lines[yarn.ply][yarn.family as usize];
        let of = field::Yarn { ply: yarn.ply, family: own_family(woven.exchanged, yarn.family), number: yarn.number };
        let cells = self.strength.cells(of, lines.ends(&woven.panel, yarn.number, yarn.coordinate));
        let back = woven.panel.turn.back();
        let along = |[x, y, _]: [f64; 3]| back.rotate([x, y])[yarn.family as usize];
        // Those of a section follow one another.
        let mut last = ([f64::NAN; 2], 0.0);
        let strength = |element: &[u32; 8]| {
            let places = panel.corners(element).map(along);
            let piece = [
                places.into_iter().fold(f64::INFINITY, f64::min),
                places.into_iter().fold(f64::NEG_INFINITY, f64::max),
            ];
            if piece != last.0 {
                last = (piece, cells.least(piece.map(|place| lines.arc(yarn.number, place))));
            }
            last.1
        };
        panel.elements[yarn.elements.clone()].iter().map(strength).collect()
    }

    /// The failure limit of each element of a yarn, as the explicit host takes it; none where they are all the
    /// property's.
    pub fn limits(&self, panel: &Model, yarn: &Yarn) -> Option<Vec<f64>> {
        let material = self.case.material(yarn.ply, yarn.family);
        let limits: Vec<f64> =
            self.strengths(panel, yarn).into_iter().map(|strength| material.limit(strength)).collect();
        limits.iter().any(|&limit| limit != 0.0).then_some(limits)
    }

    /// The least strength of all elements.
    pub fn least(&self, panel: &Model) -> f64 {
        panel.yarns.iter().flat_map(|yarn| self.strengths(panel, yarn)).fold(f64::INFINITY, smallest)
    }
}

/// The family that the file calls so: in a quarter a ply is turned by exchanging warp and weft.
fn own_family(exchanged: bool, family: Family) -> usize {
    (if exchanged { family.other() } else { family }) as usize
}

impl Reader<'_> {
    /// The strength of a panel's yarns, whose materials have these names by ply and family.
    pub fn panel_strength(&self, cloth: &Cloth, materials: &[[String; 2]]) -> Result<Option<Strength>, Error> {
        let Some(table) = self.strength_table() else { return Ok(None) };
        let Cloth::Woven(layup) = cloth else {
            let message = "strength beside [mesh], whose yarns' arc lengths are not known; allowed: with [weave]";
            return Err(self.source.error(table.span(), message));
        };
        let of_family =
            |ply: &Ply, names: &[String; 2], family: Family| names[own_family(ply.woven.exchanged, family)].clone();
        let of_ply = |(ply, names): (&Ply, &[String; 2])| Family::BOTH.map(|family| of_family(ply, names, family));
        let mut plies = layup.plies.iter().zip(materials).map(of_ply);
        let first = plies.next();
        if plies.any(|ply| Some(ply) != first) {
            let message =
                "strength of plies whose yarns differ in their material; allowed: plies of one material a family";
            return Err(self.source.error(table.span(), message));
        }
        let lengths = layup.plies.iter().flat_map(|ply| {
            let lines = ply.woven.centre_lines();
            let length = |[start, end]: [f64; 2]| end - start;
            let of =
                |place: &Place| lines[place.family as usize].ends(&ply.woven.panel, place.number, place.coordinate);
            ply.woven.places.iter().map(|place| length(of(place))).collect::<Vec<f64>>()
        });
        self.strength(table, lengths).map(Some)
    }
}
