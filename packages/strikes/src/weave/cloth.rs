//! What is struck: a panel that is woven here, or one of a mesh file.

use std::ops::Range;

use toml::de::DeValue;

use crate::weave::foreign::reader::foreign;
use crate::weave::reader::layup;

use super::figures::Figures;
use super::file;
use super::foreign::reader::Foreign;
use super::layup::{Layup, Ply};
use super::model::Model;
use super::panel::{Outline, Part};
use toron::host::units::UnitSystem;
use toron_shared::error::Error;
use toron_shared::layers::entries;
use toron_shared::numbers::number;
use toron_shared::toml_file::Source;

#[derive(Clone, Debug)]
pub enum Cloth {
    Woven(Layup),
    Foreign(Box<Foreign>),
}

impl Cloth {
    pub fn model(&self) -> Model {
        match self {
            Cloth::Woven(layup) => layup.model(),
            Cloth::Foreign(foreign) => foreign.model.clone(),
        }
    }

    /// Of each ply, in the model of this; a mesh is one ply.
    pub fn figures(&self, model: &Model) -> Vec<Figures> {
        match self {
            Cloth::Woven(layup) => {
                let plies = layup.plies.iter().enumerate();
                plies.map(|(number, ply)| Figures::of(model, number, &ply.woven.geometry)).collect()
            }
            Cloth::Foreign(foreign) => vec![foreign.figures],
        }
    }

    /// Beyond this distance from the centre the mesh is coarse; nowhere without.
    pub fn coarse_radius(&self) -> Option<f64> {
        self.plies().first().and_then(|ply| ply.woven.panel.coarse).map(|coarse| coarse.radius)
    }

    /// The part of the panel that is modelled.
    pub fn part(&self) -> Part {
        match self {
            Cloth::Woven(layup) => layup.part(),
            Cloth::Foreign(foreign) => foreign.part,
        }
    }

    /// The least distance of two yarns at rest.
    pub fn clearance(&self) -> f64 {
        match self {
            Cloth::Woven(layup) => layup.clearance,
            Cloth::Foreign(foreign) => foreign.clearance,
        }
    }

    /// The least and the largest height of a yarn.
    pub fn yarn_heights(&self) -> [f64; 2] {
        match self {
            Cloth::Woven(layup) => layup.yarn_heights(),
            Cloth::Foreign(foreign) => {
                [foreign.heights[0].min(foreign.heights[1]), foreign.heights[0].max(foreign.heights[1])]
            }
        }
    }

    /// The plies that are woven here.
    pub fn plies(&self) -> &[Ply] {
        match self {
            Cloth::Woven(layup) => &layup.plies,
            Cloth::Foreign(_) => &[],
        }
    }

    /// What to say of yarns that the mesh makes too long or too short.
    pub fn crimp(&self) -> &[String] {
        match self {
            Cloth::Woven(layup) => &layup.crimp,
            Cloth::Foreign(foreign) => &foreign.crimp,
        }
    }

    /// Elements that reach into another yarn.
    pub fn overlapping(&self) -> &[usize] {
        match self {
            Cloth::Woven(_) => &[],
            Cloth::Foreign(foreign) => &foreign.checks.overlapping,
        }
    }

    /// The edges of the cell by which the ply that is struck repeats itself: along its warp and along its weft. The
    /// pattern of a mesh is not known, and taken for plain.
    pub fn cell(&self) -> [[f64; 2]; 2] {
        match self {
            Cloth::Woven(layup) => {
                let woven = &layup.plies[0].woven;
                let ([warps, wefts], [warp, weft]) =
                    (woven.geometry.weave.pattern.repeat(), woven.geometry.weave.threads);
                let turn = woven.panel.turn;
                [turn.rotate([wefts as f64 * weft.pitch, 0.0]), turn.rotate([0.0, warps as f64 * warp.pitch])]
            }
            Cloth::Foreign(foreign) => [[2.0 * foreign.pitch[1], 0.0], [0.0, 2.0 * foreign.pitch[0]]],
        }
    }

    /// That a place is within the panel's outline; of a mesh, whose outline is not known, within the box about its
    /// nodes.
    ///
    /// # Errors
    /// It lies outside: what is allowed.
    pub fn covers(&self, place: [f64; 2]) -> Result<(), String> {
        let ends = match self {
            Cloth::Woven(layup) => match layup.plies[0].woven.panel.outline {
                Outline::Circle(radius) if place[0].hypot(place[1]) <= radius => return Ok(()),
                Outline::Circle(radius) => {
                    return Err(format!("within the panel's outline, up to {} from the middle", number(radius)));
                }
                Outline::Rectangle(half) => half.map(|half| [-half, half]),
            },
            Cloth::Foreign(foreign) => foreign.extent(),
        };
        if ends.iter().zip(place).all(|([low, high], at)| (*low..=*high).contains(&at)) {
            return Ok(());
        }
        let [x, y] = ends.map(|ends| ends.map(number).join(" to "));
        Err(format!("within the panel's outline, x from {x} and y from {y}"))
    }

    /// The pitches of warp and weft of each ply.
    pub fn pitches(&self) -> Vec<[f64; 2]> {
        match self {
            Cloth::Woven(layup) => {
                layup.plies.iter().map(|ply| ply.woven.geometry.weave.threads.map(|thread| thread.pitch)).collect()
            }
            Cloth::Foreign(foreign) => vec![foreign.pitch],
        }
    }

    /// The largest pitch.
    pub fn pitch(&self) -> f64 {
        self.pitches().into_iter().flatten().fold(0.0, f64::max)
    }
}

/// The table `[weave]` with its `[[ply]]`, or `[mesh]`, of these. `case` is the place of the weave that a case has
/// otherwise.
///
/// # Errors
/// Neither or both are there, or what is wrong with the one.
pub fn read_cloth<'t>(
    source: &Source<'t>,
    tables: &DeValue<'t>,
    units: &UnitSystem,
    case: Option<Range<usize>>,
) -> Result<Cloth, Error> {
    let plies = entries(tables.get("ply"));
    match (tables.get("weave"), tables.get("mesh")) {
        (Some(weave), None) => layup(source, &file::plies(source, weave, plies)?, units, case).map(Cloth::Woven),
        (None, Some(mesh)) => match plies.first() {
            Some(ply) => Err(source.error(ply.span(), "[[ply]] beside [mesh]; allowed: with [weave]")),
            None => foreign(source, &source.read(mesh)?, units).map(|foreign| Cloth::Foreign(Box::new(foreign))),
        },
        (Some(_), Some(mesh)) => Err(source.error(mesh.span(), "[mesh] beside [weave]; allowed: one of them")),
        (None, None) => Err(source.error(0..0, "[weave] is missing; allowed: [weave], or [mesh] with a file")),
    }
}
