//! Whether a yarn is torn through.

use super::model::{Piece, Yarn};

/// Whether nothing joins a yarn's ends any more. Of a grid, in some piece of the yarn, every line of elements along it
/// has lost one; else no way leads from one end to the other over intact elements that share nodes. Elements and their
/// nodes are numbered in the yarn.
pub fn is_torn(yarn: &Yarn, elements: &[[u32; 8]], intact: impl Fn(usize) -> bool) -> bool {
    if yarn.pieces.is_empty() {
        return ends_are_apart(yarn, elements, intact);
    }
    yarn.pieces.iter().any(|piece| every_line_is_broken(piece, &intact))
}

fn every_line_is_broken(piece: &Piece, intact: impl Fn(usize) -> bool) -> bool {
    let lines = piece.grid.elements_per_layer();
    let elements = lines * piece.grid.layers;
    let broken = |line: usize| (line..elements).step_by(lines).any(|element| !intact(piece.first_element + element));
    (0..lines).all(broken)
}

fn ends_are_apart(yarn: &Yarn, elements: &[[u32; 8]], intact: impl Fn(usize) -> bool) -> bool {
    let mut groups = Groups::new(yarn.nodes.len());
    for (_, element) in elements.iter().enumerate().filter(|(number, _)| intact(*number)) {
        element.iter().for_each(|&node| groups.join(element[0], node));
    }
    let [starts, ends] = yarn.ends.each_ref().map(|nodes| {
        let mut of_end: Vec<u32> =
            nodes.iter().map(|&node| groups.representative(node - yarn.nodes.start as u32)).collect();
        of_end.sort_unstable();
        of_end
    });
    !starts.iter().any(|group| ends.binary_search(group).is_ok())
}

/// Into how many pieces that share no nodes so many nodes fall.
pub fn pieces(nodes: usize, elements: &[[u32; 8]]) -> usize {
    let mut groups = Groups::new(nodes);
    for element in elements {
        element.iter().for_each(|&node| groups.join(element[0], node));
    }
    (0..nodes as u32).filter(|&node| groups.representative(node) == node).count()
}

/// Nodes that are joined have one number, that of one of them.
pub struct Groups(Vec<u32>);

impl Groups {
    pub fn new(count: usize) -> Groups {
        Groups((0..count as u32).collect())
    }

    /// The node whose number those joined with this one have.
    pub fn representative(&mut self, mut node: u32) -> u32 {
        while self.0[node as usize] != node {
            let next = self.0[node as usize];
            self.0[node as usize] = self.0[next as usize];
            node = next;
        }
        node
    }

    pub fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.representative(a), self.representative(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::weave::geometry::Family;
    use crate::weave::model::Grid;

    /// Two elements side by side and three one after another.
    #[test]
    fn a_yarn_is_torn_where_no_way_leads_from_end_to_end() {
        let grid = Grid { layers: 3, columns: 2, rows: 1 };
        let places = (0..3).flat_map(|layer| (0..2).map(move |column| [layer, column, 0]));
        let elements: Vec<[u32; 8]> = places.map(|place| grid.corners(place).map(|node| node as u32)).collect();
        let section = |number: usize| grid.section(number).map(|node| node as u32).collect();
        let of_grid = Yarn {
            ply: 0,
            family: Family::Warp,
            number: 0,
            coordinate: 0.0,
            halved: false,
            nodes: 0..24,
            elements: 0..6,
            faces: 0..0,
            ends: [section(0), section(3)],
            pieces: vec![Piece::whole(grid)],
            ties: Vec::new(),
        };
        let foreign = Yarn { pieces: Vec::new(), ..of_grid.clone() };
        let torn = |yarn: &Yarn, deleted: &[usize]| is_torn(yarn, &elements, |element| !deleted.contains(&element));
        for (deleted, through) in
            [(&[][..], false), (&[2], false), (&[2, 3], true), (&[4, 5], true), (&[0, 1, 2, 3, 4, 5], true)]
        {
            assert_eq!([torn(&of_grid, deleted), torn(&foreign, deleted)], [through; 2], "{deleted:?}");
        }
        // Both lines are broken, but elements beside each other share nodes.
        assert_eq!([torn(&of_grid, &[0, 5]), torn(&foreign, &[0, 5])], [true, false]);
    }
}
