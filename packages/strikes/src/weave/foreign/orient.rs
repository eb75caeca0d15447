//! Foreign elements turned as the model has them: axis 0 along the fibre, axis 1 upwards.

use nalgebra::Vector3;

use toron_explicit_host::hexahedron::Edges;

/// Corner c of an element stands on the upper side of axis i where bit i of c is set: solvers number them so.
const CORNERS: [usize; 8] = [0, 1, 3, 2, 4, 5, 7, 6];
/// The fibre of a wedge is this near to the edges between its triangles, as a cosine.
const ALONG_WEDGE: f64 = 0.5;

/// An element whose corners may be turned.
pub struct Corners<'a> {
    pub nodes: [u32; 8],
    pub places: &'a [[f64; 3]],
}

impl<'a> Corners<'a> {
    /// Of an element with its nodes as solvers number them.
    pub fn new(solver: [u32; 8], places: &'a [[f64; 3]]) -> Corners<'a> {
        Corners { nodes: CORNERS.map(|corner| solver[corner]), places }
    }

    fn place(&self, node: u32) -> Vector3<f64> {
        Vector3::from(self.places[node as usize])
    }

    /// The volume that the element has where its faces are plane.
    pub fn volume(&self) -> f64 {
        Edges::of(&self.nodes.map(|node| self.places[node as usize])).volume()
    }

    /// The means of the edges along the three axes.
    fn axes(&self) -> [Vector3<f64>; 3] {
        [0, 1, 2].map(|axis| {
            let sign = |corner: usize| if corner >> axis & 1 == 1 { 0.25 } else { -0.25 };
            (0..8).map(|corner| self.place(self.nodes[corner]) * sign(corner)).sum()
        })
    }

    /// The triangles of a wedge, whose nodes are joined one by one; `None` of a hexahedron.
    ///
    /// # Errors
    /// The number of the nodes, where it is neither.
    pub fn wedge(&self) -> Result<Option<[[u32; 3]; 2]>, usize> {
        let mut all = self.nodes.to_vec();
        all.sort_unstable();
        all.dedup();
        if all.len() == 8 {
            return Ok(None);
        }
        for axis in 0..3 {
            let lower = (0..8).filter(|corner| corner >> axis & 1 == 0);
            let mut pairs: Vec<[u32; 2]> = lower.map(|c| [self.nodes[c], self.nodes[c | 1 << axis]]).collect();
            pairs.sort_unstable();
            pairs.dedup();
            if let (6, &[a, b, c]) = (all.len(), &pairs[..]) {
                return Ok(Some([[a[0], b[0], c[0]], [a[1], b[1], c[1]]]));
            }
        }
        Err(all.len())
    }

    /// The axis nearest to a direction, with the same sense.
    pub fn nearest_axis(&self, direction: Vector3<f64>) -> Vector3<f64> {
        let axes = match self.wedge() {
            Ok(Some(triangles)) => vec![self.between(triangles)],
            _ => self.axes().to_vec(),
        };
        let cosine = |axis: &Vector3<f64>| axis.dot(&direction) / axis.norm();
        let nearest = axes.into_iter().max_by(|a, b| cosine(a).abs().total_cmp(&cosine(b).abs()));
        nearest.map_or(direction, |axis| if axis.dot(&direction) < 0.0 { -axis } else { axis })
    }

    fn between(&self, [from, to]: [[u32; 3]; 2]) -> Vector3<f64> {
        let sum = |nodes: [u32; 3]| nodes.iter().map(|&node| self.place(node)).sum::<Vector3<f64>>();
        (sum(to) - sum(from)) / 3.0
    }

    /// The nodes by corners whose axis 0 is nearest to the fibre and of whose others axis 1 is nearest to z.
    ///
    /// # Errors
    /// What the element is, if that cannot be.
    pub fn along(&self, fibre: Vector3<f64>) -> Result<[u32; 8], String> {
        match self.wedge() {
            Ok(None) => Ok(self.turned(fibre)),
            Ok(Some(triangles)) => self.wedge_along(triangles, fibre),
            Err(nodes) => Err(format!("has {nodes} different nodes; allowed: 8 of a hexahedron, 6 of a wedge")),
        }
    }

    /// One of the 24 rotations, so that a hexahedron which is inside out stays so.
    fn turned(&self, fibre: Vector3<f64>) -> [u32; 8] {
        let axes = self.axes().map(|axis| axis.normalize());
        let best = |direction: Vector3<f64>, taken: Option<usize>| {
            let free = (0..3).filter(|&axis| Some(axis) != taken);
            let nearness = |axis: usize| axes[axis].dot(&direction).abs();
            free.max_by(|&a, &b| nearness(a).total_cmp(&nearness(b))).unwrap_or(0)
        };
        let first = best(fibre, None);
        let second = best(Vector3::z(), Some(first));
        let order = [first, second, 3 - first - second];
        let reversed = |axis: usize, direction: Vector3<f64>| axes[axis].dot(&direction) < 0.0;
        let (against, downwards) = (reversed(first, fibre), reversed(second, Vector3::z()));
        // An odd order of the axes, like each that is reversed, turns the element inside out.
        let odd = (second + 3 - first) % 3 != 1;
        let flipped = [against, downwards, odd ^ against ^ downwards];
        std::array::from_fn(|corner| {
            let bit = |axis: usize| (corner >> axis & 1 == 1) ^ flipped[axis];
            let old = (0..3).map(|axis| usize::from(bit(axis)) << order[axis]).sum::<usize>();
            self.nodes[old]
        })
    }

    /// A wedge as a hexahedron: the edge that is nearest to z stands across from the tip.
    fn wedge_along(&self, [from, to]: [[u32; 3]; 2], fibre: Vector3<f64>) -> Result<[u32; 8], String> {
        let along = self.between([from, to]);
        let cosine = along.dot(&fibre) / along.norm();
        if cosine.is_nan() || cosine.abs() < ALONG_WEDGE {
            let angle = cosine.abs().acos().to_degrees();
            return Err(format!(
                "is a wedge with triangles along the fibre, which is {angle:.0}° off their axis; allowed: triangles across it"
            ));
        }
        let [start, end] = if cosine > 0.0 { [from, to] } else { [to, from] };
        let across = |tip: usize| {
            let [a, b] = [(tip + 1) % 3, (tip + 2) % 3].map(|i| self.place(start[i]) + self.place(end[i]));
            (b - a).z.abs() / (b - a).norm()
        };
        let tip = (0..3).max_by(|&a, &b| across(a).total_cmp(&across(b))).unwrap_or(0);
        let height = |i: usize| self.place(start[i]).z + self.place(end[i]).z;
        let [a, b] = [(tip + 1) % 3, (tip + 2) % 3];
        let [lower, upper] = if height(a) <= height(b) { [a, b] } else { [b, a] };
        let [p, q, r] = [tip, lower, upper].map(|i| self.place(start[i]));
        // Axis 2 goes to the right where axis 0 looks away and axis 1 upwards.
        let tip_is_right = fibre.cross(&(r - q)).dot(&(p - q)) > 0.0;
        let section = if tip_is_right { [lower, upper, tip, tip] } else { [tip, tip, lower, upper] };
        Ok(std::array::from_fn(|corner| if corner & 1 == 0 { start } else { end }[section[corner >> 1]]))
    }
}
