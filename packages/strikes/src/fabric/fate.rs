//! Whether it is certain that what strikes goes through, although torn ends still rub on it.
//!
//! Two bounds together, since neither is one of mechanics alone, and at some looks in a row. What still acts on it: the
//! mean force since the last look would have to be kept up for `REACH` radii to stop it. And what might still bear:
//! yarns ahead of it that are not torn where it strikes. Of each kind, a family of a ply, as many must be torn, and
//! each of those ahead may take as much energy as if the torn ones of its kind had taken all that the striker has lost.
//! Where both leave it moving, nothing that was seen in this shot stops it.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use crate::weave::model::{Model, Yarn};
use crate::weave::torn;
use toron_explicit_host::body::Body;
use toron_explicit_host::contact::RigidSurface;
use toron_explicit_host::lanes::Number;
use toron_explicit_host::solver::Solver;
use toron_explicit_host::striker::Striker;

/// How many times it is looked at on the way of one radius; the force is that since the last look.
const LOOKS: f64 = 48.0;
/// At so many looks in a row both bounds have to hold: ends that are pressed aside may push it for a moment.
const IN_A_ROW: u32 = 4;
/// For how many radii that force may act.
const REACH: f64 = 6.0;
/// A yarn that is torn farther from the aim than so many radii, at a clamp for instance, still has its middle ahead.
const WHERE_IT_STRIKES: f64 = 2.0;

/// The speed is the residual one when what the force over the last radius would take on one more is below this part of
/// the energy.
const LITTLE: f64 = 0.01;

/// How a shot went, and whether it is decided.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Fate {
    /// The square of the speed at the last look, and where that was.
    last: Option<[f64; 2]>,
    /// At how many looks up to the last one both bounds held.
    held: u32,
    /// Places and squares of the speed at the looks on the last radius, and at the one before it.
    way: VecDeque<[f64; 2]>,
}

impl Fate {
    /// Whether the mean force over the last radius would take less than `LITTLE` of the energy on one more.
    pub fn has_settled(&self, rigid: &RigidSurface) -> bool {
        let (Some(&[from, before]), Some(&[place, square])) = (self.way.front(), self.way.back()) else { return false };
        let (way, radius) = (from - place, rigid.radius);
        way >= radius && (before - square) / way * radius < LITTLE * square
    }

    pub fn is_decided(&self) -> bool {
        self.held >= IN_A_ROW
    }

    /// Takes a step's end; `struck_at` is the speed of the strike.
    pub fn follow<T: Number>(&mut self, panel: &Model, solver: &Solver<T>, rigid: &RigidSurface, struck_at: f64) {
        let Some(striker) = &solver.striker else { return };
        let (place, square, radius) = (striker.position, striker.velocity * striker.velocity, rigid.radius);
        if self.last.is_some_and(|[_, last]| last - place < radius / LOOKS) {
            return;
        }
        self.way.push_back([place, square]);
        while self.way.get(1).is_some_and(|[second, _]| second - place >= radius) {
            self.way.pop_front();
        }
        let Some([before, from]) = self.last.replace([square, place]) else { return };
        let rate = ((before - square) / (from - place)).max(0.0);
        let holds = square > REACH * radius * rate
            && square > may_take(panel, solver, striker, rigid) * (struck_at * struck_at - square);
        self.held = if holds { self.held + 1 } else { 0 };
    }
}

/// What yarns ahead might take, over all that has been taken; infinity where of some kind more are ahead than torn, or
/// nothing is torn.
fn may_take<T: Number>(panel: &Model, solver: &Solver<T>, striker: &Striker, rigid: &RigidSurface) -> f64 {
    let kind = |yarn: &Yarn| 2 * yarn.ply + yarn.family as usize;
    let kinds = panel.yarns.iter().map(kind).max().map_or(0, |last| last + 1);
    // Of each kind the yarns that are torn, and those ahead; a half counts as one half.
    let mut count = vec![[0.0; 2]; kinds];
    for (yarn, body) in panel.yarns.iter().zip(&solver.bodies) {
        let width = if yarn.halved { 0.5 } else { 1.0 };
        if is_torn(yarn, body, rigid) {
            count[kind(yarn)][0] += width;
        } else if is_ahead(body, striker.position, rigid) {
            count[kind(yarn)][1] += width;
        }
    }
    if count.iter().all(|[torn, _]| *torn == 0.0) {
        return f64::INFINITY;
    }
    let of_kind = |[torn, ahead]: [f64; 2]| match ahead {
        0.0 => 0.0,
        ahead if ahead > torn => f64::INFINITY,
        ahead => ahead / torn,
    };
    count.into_iter().map(of_kind).sum()
}

/// Whether some yarn that is not torn where it strikes is in the striker's way.
pub fn anything_ahead<T: Number>(panel: &Model, solver: &Solver<T>, rigid: &RigidSurface) -> bool {
    let Some(striker) = &solver.striker else { return false };
    let ahead =
        |(yarn, body): (&Yarn, &Body<T>)| is_ahead(body, striker.position, rigid) && !is_torn(yarn, body, rigid);
    panel.yarns.iter().zip(&solver.bodies).any(ahead)
}

fn is_torn<T: Number>(yarn: &Yarn, body: &Body<T>, rigid: &RigidSurface) -> bool {
    if body.state.deleted.is_empty() {
        return false;
    }
    let elements = &body.mesh.elements;
    let is_far = |element: usize| {
        let place = body.mesh.nodes[elements[element][0] as usize];
        beside(place, rigid) > WHERE_IT_STRIKES * rigid.radius
    };
    torn::is_torn(yarn, elements, |element| body.is_intact(element) || is_far(element))
}

/// Whether a node of a yarn is within the radius and below the striker's centre.
fn is_ahead<T: Number>(body: &Body<T>, centre: f64, rigid: &RigidSurface) -> bool {
    let inside = |place: [f64; 3]| place[2] < centre && beside(place, rigid) < rigid.radius;
    (0..body.mesh.nodes.len()).any(|node| inside(body.position(node)) && !body.is_loose(node))
}

/// How far a place is from the striker's axis.
fn beside([x, y, _]: [f64; 3], rigid: &RigidSurface) -> f64 {
    (x - rigid.aim[0]).hypot(y - rigid.aim[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabric::scene::Scene;
    use crate::fabric::solver;
    use crate::weave::geometry::Family;

    /// A sphere with a radius of 1 mm and 50 m/s above a quarter of a disc of 3 mm.
    struct Shot {
        scene: Scene,
        panel: Model,
        solver: Solver<f64>,
    }

    impl Shot {
        fn new(plies: &str) -> Shot {
            let text = format!(
                "units = \"mm-g-ms\"\n[weave]\npreset = \"kevlar-s706\"\nalong = 4\ncolumns = 2\n\
                 [weave.panel]\nshape = \"circle\"\nradius = 3.0\npart = \"quarter\"\n{plies}\
                 [scene]\nspeed = 60.0\nmass = 0.03\nradius = 1.0\ncontact-stiffness = 1e5\nend = 1.0\nfailure = \"uniaxial\"\n"
            );
            let scene = Scene::parse("patch.toml", &text).expect("a scene");
            let panel = scene.cases[0].cloth.model();
            let mut solver = solver::build::<f64>(&scene.cases[0], &panel).expect("a panel");
            solver.striker.as_mut().expect("it strikes").velocity = -50.0;
            Shot { scene, panel, solver }
        }

        /// Tears these yarns in the middle, or at the rim.
        fn tear(mut self, is_torn: impl Fn(&Yarn) -> bool, at_rim: bool) -> Shot {
            for (yarn, body) in self.panel.yarns.iter().zip(&mut self.solver.bodies).filter(|(yarn, _)| is_torn(yarn)) {
                let grid = yarn.pieces[0].grid;
                let layer = if at_rim { grid.layers - 1 } else { 0 };
                body.delete(&grid.layer(layer).collect::<Vec<_>>());
            }
            self
        }

        /// Whether it is decided when it was struck at this speed, loses so much from look to look, and has been looked
        /// at so many times.
        fn decided(mut self, struck_at: f64, slower: f64, looks: u32) -> bool {
            let (mut fate, sphere) = (Fate::default(), &self.scene.cases[0].striker);
            fate.follow(&self.panel, &self.solver, sphere, struck_at);
            for _ in 0..looks {
                let striker = self.solver.striker.as_mut().expect("it strikes");
                striker.position -= 1.01 / LOOKS;
                striker.velocity += slower;
                fate.follow(&self.panel, &self.solver, sphere, struck_at);
            }
            fate.is_decided()
        }
    }

    #[test]
    fn what_is_torn_and_exerts_no_force_decides() {
        let torn = || Shot::new("").tear(|_| true, false);
        assert!(torn().decided(200.0, 0.0, IN_A_ROW));
        assert!(!torn().decided(200.0, 0.0, IN_A_ROW - 1), "it may be pushed for a moment");
        assert!(!Shot::new("").decided(60.0, 0.0, IN_A_ROW), "nothing is torn");
        // Kept up for six radii its force would take 2 × 50 m/s × 0.088 m/s × 48/1.01 × 6, the square of 50 m/s.
        assert!(torn().decided(200.0, 0.085, IN_A_ROW) && !torn().decided(200.0, 0.09, IN_A_ROW), "it is braked");
    }

    /// A sphere that loses so much speed from look to look, for so many looks.
    fn settled(slower: f64, looks: u32) -> bool {
        let mut shot = Shot::new("").tear(|_| true, false);
        let (mut fate, sphere) = (Fate::default(), &shot.scene.cases[0].striker);
        for _ in 0..=looks {
            fate.follow(&shot.panel, &shot.solver, sphere, 60.0);
            let striker = shot.solver.striker.as_mut().expect("it strikes");
            striker.position -= 1.01 / LOOKS;
            striker.velocity += slower;
        }
        fate.has_settled(sphere)
    }

    /// Over a radius, 48 looks of 1.01/48, 50 m/s lose 1 % of their energy by 0.25 m/s.
    #[test]
    fn a_speed_is_the_residual_one_when_a_radius_takes_little_of_it() {
        assert!(settled(0.0, 48) && settled(0.005, 48) && !settled(0.0056, 48));
        assert!(!settled(0.0, 47), "it has not gone a radius");
        // What was lost before the last radius does not count.
        let mut fate = Fate { way: VecDeque::from([[9.0, 3600.0], [1.0, 2500.0], [0.5, 2500.0]]), ..Fate::default() };
        let rigid = Shot::new("").scene.cases[0].striker;
        fate.way.push_back([0.0, 2500.0]);
        assert!(!fate.has_settled(&rigid));
        fate.way.pop_front();
        assert!(fate.has_settled(&rigid));
    }

    #[test]
    fn yarns_ahead_that_might_take_the_rest_leave_it_open() {
        // Of each family the yarns at 0, which is halved, and at 0.75 and 1.49 mm are torn where it strikes; one of
        // 0.75 mm is not.
        let most = |yarn: &Yarn| yarn.family == Family::Warp || yarn.number != 1;
        let shot = || Shot::new("").tear(most, false);
        // One over those torn of its kind: so much of what was lost is less than what is left, or more.
        assert!(shot().decided(70.0, 0.0, IN_A_ROW));
        assert!(!shot().decided(120.0, 0.0, IN_A_ROW));
        // Of its kind more are ahead than torn.
        let one = |yarn: &Yarn| yarn.family == Family::Warp || yarn.number == 0;
        assert!(!Shot::new("").tear(one, false).decided(50.1, 0.0, IN_A_ROW));
        // No weft yarn has shown what it bears.
        let warp = |yarn: &Yarn| yarn.family == Family::Warp;
        assert!(!Shot::new("").tear(warp, false).decided(50.1, 0.0, IN_A_ROW));
    }

    #[test]
    fn what_is_torn_at_the_rim_is_ahead() {
        assert!(!Shot::new("").tear(|_| true, true).decided(200.0, 0.0, IN_A_ROW));
    }

    /// The sphere has gone through the first one of two plies, and nothing touches it.
    #[test]
    fn another_ply_leaves_it_open() {
        let plies = "[[ply]]\n[[ply]]\ndistance = 5.0\n";
        let first = || Shot::new(plies).tear(|yarn| yarn.ply == 0, false);
        assert!(!first().decided(50.1, 0.0, IN_A_ROW));
        let ahead = |shot: Shot| anything_ahead(&shot.panel, &shot.solver, &shot.scene.cases[0].striker);
        assert!(ahead(first()) && !ahead(first().tear(|yarn| yarn.ply == 1, false)));
    }
}
