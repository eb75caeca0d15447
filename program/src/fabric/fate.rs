//! Whether it is certain that what strikes goes through, although torn ends still rub on it.
//!
//! Two bounds together, each with a margin, since neither is one of mechanics alone. What still acts on it: the mean force over the
//! last sixteenth of a radius would have to be kept up for `REACH` radii to stop it. And what might still bear: yarns that are not
//! torn and whose axes lie ahead of it, in its way. Each of them may take as much energy as was taken by each torn one so far, if these
//! took all that the striker has lost. Where the two leave it moving, nothing that was seen in this shot stops it.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::explicit::body::Body;
use crate::explicit::contact::Rigid;
use crate::explicit::lanes::Number;
use crate::explicit::projectile::Projectile;
use crate::explicit::solver::Solver;
use crate::weave::model::{Model, Yarn};
use crate::weave::torn;

/// How many times it is looked at on the way of one radius; the force is that since the last look.
const LOOKS: f64 = 16.0;
/// For how many radii that force may act.
const REACH: f64 = 6.0;

/// How a shot went, and whether it is decided.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Fate {
    /// The square of the speed at the last look, and where that was.
    last: Option<[f64; 2]>,
    pub is_decided: bool,
}

impl Fate {
    /// Takes a step's end; `struck_at` is the speed of the strike.
    pub fn follow<T: Number>(&mut self, panel: &Model, solver: &Solver<T>, rigid: &Rigid, struck_at: f64) {
        let Some(striker) = &solver.projectile else { return };
        let (place, square, radius) = (striker.position, striker.velocity * striker.velocity, rigid.radius);
        if self.last.is_some_and(|[_, last]| last - place < radius / LOOKS) {
            return;
        }
        let Some([before, from]) = self.last.replace([square, place]) else { return };
        let rate = ((before - square) / (from - place)).max(0.0);
        self.is_decided = square > REACH * radius * rate && {
            let [torn, ahead] = bearing(panel, solver, striker, rigid);
            torn > 0.0 && square * torn > ahead * (struck_at * struck_at - square)
        };
    }
}

/// How many yarns are torn, and how many that are not lie in the striker's way; a half counts as one.
fn bearing<T: Number>(panel: &Model, solver: &Solver<T>, striker: &Projectile, rigid: &Rigid) -> [f64; 2] {
    let mut count = [0.0; 2];
    for (yarn, body) in panel.yarns.iter().zip(&solver.bodies) {
        let width = if yarn.halved { 0.5 } else { 1.0 };
        if torn::is_torn(yarn, &body.mesh.elements, |element| body.is_intact(element)) {
            count[0] += width;
        } else if is_ahead(yarn, body, striker.position, rigid) {
            count[1] += width;
        }
    }
    count
}

/// Whether the axis of a yarn, or of one without a grid some node, is within the radius and below the striker's centre.
fn is_ahead<T: Number>(yarn: &Yarn, body: &Body<T>, centre: f64, rigid: &Rigid) -> bool {
    let [x, y] = rigid.aim;
    let inside = |place: Vector3<f64>| place.z < centre && (place.x - x).hypot(place.y - y) < rigid.radius;
    if yarn.pieces.is_empty() {
        return (0..yarn.nodes.len()).any(|node| inside(body.position(node).into()));
    }
    yarn.pieces.iter().any(|piece| {
        (0..=piece.grid.layers).any(|section| {
            let nodes = piece.grid.section(section).map(|node| Vector3::from(body.position(piece.first_node + node)));
            inside(nodes.sum::<Vector3<f64>>() / piece.grid.nodes_per_section() as f64)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabric::model;
    use crate::fabric::scene::Scene;
    use crate::weave::geometry::Family;

    /// Whether it is decided after some looks at a sphere that was struck at this speed, has 50 m/s and loses so much from look to look, in
    /// a panel some of whose yarns are torn.
    fn decided(is_torn: impl Fn(&Yarn) -> bool, struck_at: f64, slower: f64) -> bool {
        let text = "units = \"mm-g-ms\"\n[weave]\npreset = \"kevlar-s706\"\nalong = 4\ncolumns = 2\n\
             [weave.panel]\nshape = \"circle\"\nradius = 3.0\npart = \"quarter\"\n\
             [scene]\nspeed = 60.0\nmass = 0.03\nradius = 1.0\ncontact-stiffness = 1e5\nend = 1.0\nfailure = \"uniaxial\"\n";
        let scene = Scene::parse("patch.toml", text).expect("a scene");
        let panel = scene.cases[0].cloth.model();
        let mut solver = model::solver::<f64>(&scene.cases[0], &panel).expect("a panel");
        for (yarn, body) in panel.yarns.iter().zip(&mut solver.bodies).filter(|(yarn, _)| is_torn(yarn)) {
            body.delete(&yarn.pieces[0].grid.layer(0).collect::<Vec<_>>());
        }
        let mut fate = Fate::default();
        solver.projectile.as_mut().expect("it strikes").velocity = -50.0;
        fate.follow(&panel, &solver, &scene.cases[0].sphere, struck_at);
        let striker = solver.projectile.as_mut().expect("it strikes");
        striker.position -= 1.01 / LOOKS;
        striker.velocity += slower;
        fate.follow(&panel, &solver, &scene.cases[0].sphere, struck_at);
        fate.is_decided
    }

    #[test]
    fn what_is_torn_and_exerts_no_force_decides() {
        assert!(decided(|_| true, 200.0, 0.0));
        assert!(!decided(|_| false, 60.0, 0.0), "nothing is torn");
        // Kept up for six radii its force would take 2 × 50 m/s × 0.263 m/s × 16/1.01 × 6, the square of 50 m/s.
        assert!(decided(|_| true, 200.0, 0.25) && !decided(|_| true, 200.0, 0.27), "it is braked");
    }

    #[test]
    fn yarns_ahead_that_might_take_the_rest_leave_it_open() {
        // A third of those that are torn, or more: a third of what was lost is less than what is left, or more.
        let warp = |yarn: &Yarn| yarn.family == Family::Warp;
        assert!(decided(warp, 60.0, 0.0));
        assert!(!decided(warp, 120.0, 0.0));
    }
}
