//! The mechanical model: fibres and rigid walls, where they touch, and what moves them. Lengths are in diameters.

use super::disc::Disc;

/// An edge of a quadrilateral, from its corner `edge` to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    pub quad: usize,
    pub edge: usize,
}

/// Which of a body's quadrilaterals and edges are meant are counted from 0 within the body.
#[derive(Clone, Debug)]
pub struct Body {
    pub centre: [f64; 2],
    pub quads: Vec<[usize; 4]>,
    /// The edges that can touch another body, and the middle of each.
    pub rim: Vec<(Edge, [f64; 2])>,
}

/// Two surfaces that can touch: a body each, and the edges of it.
#[derive(Clone, Debug)]
pub struct Contact {
    pub slave: (usize, Vec<Edge>),
    pub master: (usize, Vec<Edge>),
    pub friction: bool,
}

/// Nodes that a load moves along an axis as a line of the plane at this coordinate: by (stretch − 1) times it.
#[derive(Clone, Debug)]
pub struct Support {
    pub axis: usize,
    pub at: f64,
    pub nodes: Vec<usize>,
}

#[derive(Clone, Debug, Default)]
pub struct Model {
    pub nodes: Vec<[f64; 2]>,
    /// Fibres first, then walls.
    pub bodies: Vec<Body>,
    pub fibres: usize,
    pub contacts: Vec<Contact>,
    pub supports: Vec<Support>,
    /// Nodes that weak springs draw to where an affine deformation takes them.
    pub sprung: Vec<usize>,
    /// The fibres from which the energy is read, and the reference area that is theirs, voids included.
    pub middle: Vec<usize>,
    pub middle_area: f64,
    /// The reference area of the whole.
    pub area: f64,
    /// The fibres' part of the area from which the energy is read.
    pub fraction: f64,
    /// Whether the picture continues the model by mirror images at its edges.
    pub mirrored: bool,
    /// Width and height.
    pub size: [f64; 2],
}

/// A side of the model where a wall stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Side {
    Left,
    Right,
    Bottom,
    Top,
}

impl Side {
    fn axis(self) -> usize {
        usize::from(matches!(self, Side::Bottom | Side::Top))
    }
}

/// A wall's thickness, and what it is longer at each end than the model: it also stands where others move in or bulge
/// out.
const WALL: f64 = 0.2;
const OVERHANG: f64 = 0.5;
/// Coordinates closer than this are the same.
const ROUNDING: f64 = 1e-9;

impl Model {
    /// Adds a fibre, which must come before all walls; returns its number.
    pub fn add_fibre(&mut self, disc: &Disc, centre: [f64; 2]) -> usize {
        let first = self.nodes.len();
        let placed = disc.nodes.iter().map(|node| [0, 1].map(|axis| centre[axis] + node[axis]));
        self.nodes.extend(placed);
        let quads: Vec<[usize; 4]> = disc.quads.iter().map(|quad| quad.map(|node| first + node)).collect();
        let rim =
            disc.rim.iter().map(|&quad| (Edge { quad, edge: 1 }, self.middle_of([quads[quad][1], quads[quad][2]])));
        let body = Body { centre, rim: rim.collect(), quads };
        self.bodies.push(body);
        self.fibres += 1;
        self.fibres - 1
    }

    /// Adds a rigid wall along a side, which the load moves with it; returns its number.
    pub fn add_wall(&mut self, side: Side) -> usize {
        let [width, height] = self.size;
        let (low, high) = ([-OVERHANG; 2], [width + OVERHANG, height + OVERHANG]);
        let ([left, right], [bottom, top], edge, at) = match side {
            Side::Left => ([-WALL, 0.0], [low[1], high[1]], 1, 0.0),
            Side::Right => ([width, width + WALL], [low[1], high[1]], 3, width),
            Side::Bottom => ([low[0], high[0]], [-WALL, 0.0], 2, 0.0),
            Side::Top => ([low[0], high[0]], [height, height + WALL], 0, height),
        };
        let first = self.nodes.len();
        self.nodes.extend([[left, bottom], [right, bottom], [right, top], [left, top]]);
        let quad = [0, 1, 2, 3].map(|node| first + node);
        let middle = self.middle_of([quad[edge], quad[(edge + 1) % 4]]);
        self.bodies.push(Body { centre: middle, quads: vec![quad], rim: vec![(Edge { quad: 0, edge }, middle)] });
        self.supports.push(Support { axis: side.axis(), at, nodes: quad.to_vec() });
        self.supports.push(Support { axis: 1 - side.axis(), at: 0.0, nodes: quad.to_vec() });
        self.bodies.len() - 1
    }

    /// Makes an axis' line a line of symmetry for these fibres: their nodes on it move with it.
    pub fn add_symmetry(&mut self, fibres: &[usize], axis: usize, at: f64) {
        let mut nodes: Vec<usize> =
            fibres.iter().flat_map(|&fibre| self.bodies[fibre].quads.iter().flatten()).copied().collect();
        nodes.retain(|&node| (self.nodes[node][axis] - at).abs() < ROUNDING);
        nodes.sort_unstable();
        nodes.dedup();
        self.supports.push(Support { axis, at, nodes });
    }

    /// Lets two fibres touch, each with the part of its rim that lies within `angle` of the other's centre.
    pub fn add_contact(&mut self, slave: usize, master: usize, angle: f64) {
        let [a, b] = [slave, master].map(|body| self.bodies[body].centre);
        let towards = [b[0] - a[0], b[1] - a[1]];
        let contact = Contact {
            slave: (slave, self.facing(slave, towards, angle)),
            master: (master, self.facing(master, towards.map(|x| -x), angle)),
            friction: true,
        };
        self.contacts.push(contact);
    }

    /// Lets a fibre touch a wall, without friction.
    pub fn add_wall_contact(&mut self, fibre: usize, wall: usize, side: Side, angle: f64) {
        let towards = match side {
            Side::Left => [-1.0, 0.0],
            Side::Right => [1.0, 0.0],
            Side::Bottom => [0.0, -1.0],
            Side::Top => [0.0, 1.0],
        };
        let edges = self.bodies[wall].rim.iter().map(|(edge, _)| *edge).collect();
        let slave = (fibre, self.facing(fibre, towards, angle));
        self.contacts.push(Contact { slave, master: (wall, edges), friction: false });
    }

    /// The edges of a fibre's rim whose direction from its centre lies within `angle` of this one.
    fn facing(&self, fibre: usize, towards: [f64; 2], angle: f64) -> Vec<Edge> {
        let body = &self.bodies[fibre];
        let length = towards[0].hypot(towards[1]);
        let faces = |middle: &[f64; 2]| {
            let [x, y] = [0, 1].map(|axis| middle[axis] - body.centre[axis]);
            (x * towards[0] + y * towards[1]) / (x.hypot(y) * length) > angle.cos()
        };
        body.rim.iter().filter(|(_, middle)| faces(middle)).map(|(edge, _)| *edge).collect()
    }

    fn middle_of(&self, [a, b]: [usize; 2]) -> [f64; 2] {
        [0, 1].map(|axis| 0.5 * (self.nodes[a][axis] + self.nodes[b][axis]))
    }
}
