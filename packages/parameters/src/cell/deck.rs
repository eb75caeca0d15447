//! The deck: a model and a load as CalculiX reads them. Lengths are in diameters, stresses in [`STRESS_UNIT`] of e_2.

use std::fmt::Write;

use super::model::{Edge, Model};
use super::scene::{Fibre, Load};

/// The unit of stress inside CalculiX, over the fibre's e_2.
pub const STRESS_UNIT: f64 = 1e-3;
/// Stiffness of the contact, as pressure over depth: this many times e_2 a diameter, in a cell and in a box. The fibres
/// of a box slide along each other's facets, and where contact is stiff CalculiX does not find the equilibrium.
const NORMAL: [f64; 2] = [4000.0, 300.0];
/// The slope of sticking, over the normal stiffness, in a cell and in a box.
const STICK: [f64; 2] = [0.1, 0.01];
/// Stiffness of a grounding spring over e_2 times the thickness.
pub const SPRING: f64 = 1e-4;
/// The first increment over the others, in a box: its fibres are free to turn until they touch, and CalculiX finds out
/// in small steps only which do. It lengthens the increments by itself then.
const FIRST_OF_BOX: f64 = 0.1;
/// Iterations after which CalculiX takes a smaller increment: faces that open and close in turn do so for ever.
const ITERATIONS: usize = 20;
/// The part of the contact that CalculiX opens at random when it takes an increment again: none, so that a deck has one
/// result.
const OPENED: f64 = 0.0;
/// By what CalculiX divides the contact's stiffness when it takes an increment again. Its own 100 lets the fibres run
/// into each other so far that they do not come back.
const RELAXATION: usize = 1;
/// Increments in all, with those that CalculiX takes again; and the smallest, as a part of the load.
const MOST_INCREMENTS: usize = 2000;
const SMALLEST: f64 = 1e-6;

/// Names by which the printed results call the sets.
pub const FIBRES: &str = "FIBRES";
pub const MIDDLE: &str = "MIDDLE";
pub const SPRUNG: &str = "SPRUNG";

/// What a deck is made for.
#[derive(Clone, Copy)]
pub struct Task<'a> {
    pub model: &'a Model,
    pub fibre: &'a Fibre,
    pub friction: f64,
    pub load: Load,
    /// The stretch at the end; it falls from 1 with the time, which goes from 0 to 1.
    pub last_stretch: f64,
    pub increments: usize,
}

/// The deck's text.
pub fn text(task: &Task) -> String {
    let mut deck = Deck { text: String::new(), task, starts: starts(task.model) };
    deck.mesh();
    deck.layers();
    deck.springs();
    deck.materials();
    deck.contacts();
    deck.sets();
    deck.first_step();
    deck.step();
    deck.text
}

/// The name of the set of a support's nodes.
pub fn support_name(number: usize) -> String {
    format!("SUPPORT{number}")
}

/// The number of a node of the front layer; those behind and the springs' fixed ends follow.
pub fn front(node: usize) -> usize {
    node + 1
}

/// The first element of each body.
fn starts(model: &Model) -> Vec<usize> {
    let counts = model.bodies.iter().map(|body| body.quads.len());
    counts.scan(1, |next, count| Some(std::mem::replace(next, *next + count))).collect()
}

struct Deck<'a> {
    text: String,
    task: &'a Task<'a>,
    starts: Vec<usize>,
}

impl Deck<'_> {
    fn line(&mut self, line: impl std::fmt::Display) {
        let _ = writeln!(self.text, "{line}");
    }

    fn back(&self, node: usize) -> usize {
        self.task.model.nodes.len() + front(node)
    }

    /// The fixed end of the springs of the sprung node of this number.
    fn ghost(&self, number: usize) -> usize {
        2 * self.task.model.nodes.len() + 1 + number
    }

    /// A layer of elements, one thick.
    fn mesh(&mut self) {
        let model = self.task.model;
        self.line("*NODE, NSET=ALL");
        for (node, [x, y]) in model.nodes.iter().enumerate() {
            self.line(format_args!("{}, {x:.12}, {y:.12}, 0.", front(node)));
            self.line(format_args!("{}, {x:.12}, {y:.12}, 1.", self.back(node)));
        }
        for (number, &node) in model.sprung.iter().enumerate() {
            let [x, y] = model.nodes[node];
            self.line(format_args!("{}, {x:.12}, {y:.12}, 0.", self.ghost(number)));
        }
        for (body, start) in model.bodies.iter().zip(self.starts.clone()) {
            self.line("*ELEMENT, TYPE=C3D8, ELSET=ALL");
            for (i, quad) in body.quads.iter().enumerate() {
                let nodes: Vec<usize> =
                    quad.iter().map(|&node| front(node)).chain(quad.iter().map(|&node| self.back(node))).collect();
                self.line(format_args!("{}, {}", start + i, list(&nodes)));
            }
        }
    }

    /// Plane strain: what lies behind moves as the front does, and not along the fibres. Half the unknowns. A support
    /// holds both.
    fn layers(&mut self) {
        let model = self.task.model;
        let mut supported = vec![[false; 2]; model.nodes.len()];
        for support in &model.supports {
            for &node in &support.nodes {
                supported[node][support.axis] = true;
            }
        }
        self.line("*BOUNDARY\nALL, 3, 3\n*EQUATION");
        for (node, supported) in supported.iter().enumerate() {
            for axis in (1..=2).filter(|axis| !supported[axis - 1]) {
                self.line(format_args!("2\n{}, {axis}, 1., {}, {axis}, -1.", self.back(node), front(node)));
            }
        }
    }

    /// From each sprung node to a node that moves affinely.
    fn springs(&mut self) {
        let model = self.task.model;
        let mut next = 1 + model.bodies.iter().map(|body| body.quads.len()).sum::<usize>();
        for axis in 1..=2 {
            if model.sprung.is_empty() {
                return;
            }
            self.line(format_args!("*ELEMENT, TYPE=SPRING2, ELSET=SPRINGS{axis}"));
            for (number, &node) in model.sprung.iter().enumerate() {
                self.line(format_args!("{next}, {}, {}", front(node), self.ghost(number)));
                next += 1;
            }
            // CalculiX takes a number such as 5e-2 here for no number.
            let stiffness = SPRING / STRESS_UNIT;
            self.line(format_args!("*SPRING, ELSET=SPRINGS{axis}\n{axis}, {axis}\n{stiffness:.9}"));
        }
    }

    /// The fibre's axis 1 is the deck's third; a wall is rigid since all of its nodes are moved.
    fn materials(&mut self) {
        let fibre = self.task.fibre;
        let stress = |value: f64| value / (STRESS_UNIT * fibre.e_2);
        let [e_1, e_2, g_12, g_23] = [fibre.e_1, fibre.e_2, fibre.g_12, fibre.g_23].map(stress);
        let nu_21 = fibre.nu_12 * fibre.e_2 / fibre.e_1;
        let nu_23 = fibre.nu_23;
        self.line("*MATERIAL, NAME=FIBRE\n*ELASTIC, TYPE=ENGINEERING CONSTANTS");
        self.line(format_args!(
            "{e_2:.12e}, {e_2:.12e}, {e_1:.12e}, {nu_23:.12e}, {nu_21:.12e}, {nu_21:.12e}, {g_23:.12e}, {g_12:.12e},"
        ));
        self.line(format_args!("{g_12:.12e}, 293.\n*SOLID SECTION, ELSET=ALL, MATERIAL=FIBRE"));
    }

    fn contacts(&mut self) {
        let boxed = usize::from(!self.task.model.sprung.is_empty());
        let normal = NORMAL[boxed] / STRESS_UNIT;
        let stick = STICK[boxed] * normal;
        for (name, friction) in [("ROUGH", self.task.friction), ("SMOOTH", 0.0)] {
            self.line(format_args!("*SURFACE INTERACTION, NAME={name}"));
            self.line(format_args!("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{normal:.9e}"));
            if friction > 0.0 {
                self.line(format_args!("*FRICTION\n{friction}, {stick:.9e}"));
            }
        }
        for (number, contact) in self.task.model.contacts.iter().enumerate() {
            for (side, (body, edges)) in [("S", &contact.slave), ("M", &contact.master)] {
                self.line(format_args!("*SURFACE, NAME={side}{number}, TYPE=ELEMENT"));
                for &Edge { quad, edge } in edges {
                    // The faces of C3D8 after its two layers, S1 and S2.
                    self.line(format_args!("{}, S{}", self.starts[*body] + quad, 3 + edge));
                }
            }
            let name = if contact.friction { "ROUGH" } else { "SMOOTH" };
            self.line(format_args!("*CONTACT PAIR, INTERACTION={name}, TYPE=SURFACE TO SURFACE\nS{number}, M{number}"));
        }
    }

    fn sets(&mut self) {
        let model = self.task.model;
        let elements = |deck: &mut Self, name: &str, bodies: &[usize]| {
            deck.line(format_args!("*ELSET, ELSET={name}, GENERATE"));
            for &body in bodies {
                let start = deck.starts[body];
                deck.line(format_args!("{start}, {}", start + model.bodies[body].quads.len() - 1));
            }
        };
        elements(self, FIBRES, &(0..model.fibres).collect::<Vec<_>>());
        elements(self, MIDDLE, &model.middle);
        let last_of_fibres = model.bodies[..model.fibres].iter().flat_map(|body| body.quads.iter().flatten()).max();
        let last = last_of_fibres.map_or(1, |&node| front(node));
        self.line(format_args!("*NSET, NSET=FRONT, GENERATE\n1, {last}"));
        for (number, support) in model.supports.iter().enumerate() {
            self.line(format_args!("*NSET, NSET={}", support_name(number)));
            for &node in &support.nodes {
                self.line(format_args!("{}, {}", front(node), self.back(node)));
            }
        }
        if !model.sprung.is_empty() {
            self.line(format_args!("*NSET, NSET={SPRUNG}"));
            for &node in &model.sprung {
                self.line(format_args!("{},", front(node)));
            }
        }
    }

    /// Nothing moves. In its first step CalculiX takes what overlaps at the start of an increment for an initial
    /// overlap, which it lets go as the step goes on: contact would have its stiffness at the end of the load only.
    /// TIMERESET: the load's time starts from 0.
    fn first_step(&mut self) {
        self.line("*STEP, NLGEOM\n*STATIC, TIMERESET\n1., 1.");
        self.boundary([1.0, 1.0]);
        // Energies are to be had in a later step only if they are in the first.
        self.line(format_args!("*EL PRINT, ELSET={FIBRES}, TOTALS=ONLY\nELSE\n*END STEP"));
    }

    fn step(&mut self) {
        let model = self.task.model;
        let increment = 1.0 / self.task.increments as f64;
        self.line(format_args!("*STEP, NLGEOM, INC={MOST_INCREMENTS}\n*STATIC"));
        let first = if model.sprung.is_empty() { increment } else { FIRST_OF_BOX * increment };
        self.line(format_args!("{first:.12}, 1., {SMALLEST:e}, {increment:.12}"));
        self.line(format_args!("*CONTROLS, PARAMETERS=CONTACT\n0.001, {OPENED:.1}, {RELAXATION}, {ITERATIONS}"));
        self.boundary(self.task.load.stretches(self.task.last_stretch));
        for set in [FIBRES, MIDDLE] {
            self.line(format_args!("*EL PRINT, ELSET={set}, TOTALS=ONLY\nELSE"));
        }
        for number in 0..model.supports.len() {
            self.line(format_args!("*NODE PRINT, NSET={}, TOTALS=ONLY\nRF", support_name(number)));
        }
        if !model.sprung.is_empty() {
            self.line(format_args!("*NODE PRINT, NSET={SPRUNG}\nU"));
        }
        self.line("*NODE FILE, NSET=FRONT\nU\n*EL FILE, NSET=FRONT\nS\n*END STEP");
    }

    /// Where the supports and the springs' fixed ends are at the end of a step.
    fn boundary(&mut self, stretches: [f64; 2]) {
        let model = self.task.model;
        self.line("*BOUNDARY");
        for (number, support) in model.supports.iter().enumerate() {
            let (axis, moved) = (support.axis + 1, (stretches[support.axis] - 1.0) * support.at + 0.0);
            self.line(format_args!("{}, {axis}, {axis}, {moved:.12e}", support_name(number)));
        }
        for (number, &node) in model.sprung.iter().enumerate() {
            let ghost = self.ghost(number);
            for (axis, (stretch, place)) in stretches.into_iter().zip(model.nodes[node]).enumerate() {
                self.line(format_args!("{ghost}, {0}, {0}, {1:.12e}", axis + 1, (stretch - 1.0) * place));
            }
        }
    }
}

fn list(numbers: &[usize]) -> String {
    numbers.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
}
