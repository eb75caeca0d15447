//! How the mass of a node is shared by its elements, and mass that is lent to what is torn.
//!
//! Whatever the shares, no body has a higher frequency than the highest of its elements, each against its shares. A
//! thin element at a yarn's edge swings faster than its neighbours, and gets more of the nodes that it has with them. A
//! node keeps the mass of the elements that it has lost, so that those left there swing against more than their own. An
//! element beside a hole that is squeezed or drawn out may take the step far below the first one. Its nodes may get
//! mass, where no whole element is: one all of whose nodes have all their elements. Momentum is kept; what that takes
//! of the kinetic energy is a term of the balance.

use super::body::Body;
use super::lanes::Number;
use super::medium::Medium;

/// By this part of itself a node gets heavier in a step, up to so many times what it was at first.
const GROWTH: f64 = 0.5;
const HEAVIEST: f64 = 8.0;

/// The elements at each node, in their order, each with how many of its corners are there.
#[derive(Debug, Default)]
pub struct Adjacency {
    starts: Vec<u32>,
    elements: Vec<u32>,
}

impl Adjacency {
    fn new(nodes: usize, elements: &[[u32; 8]]) -> Adjacency {
        let mut starts = vec![0; nodes + 1];
        for &node in elements.iter().flatten() {
            starts[node as usize + 1] += 1;
        }
        for node in 0..nodes {
            starts[node + 1] += starts[node];
        }
        let (mut next, mut of) = (starts.clone(), vec![0; elements.len() * 8]);
        for (number, element) in elements.iter().enumerate() {
            for &node in element {
                of[next[node as usize] as usize] = number as u32;
                next[node as usize] += 1;
            }
        }
        Adjacency { starts, elements: of }
    }

    /// One with several corners at the node comes as often.
    pub fn at(&self, node: usize) -> &[u32] {
        &self.elements[self.starts[node] as usize..self.starts[node + 1] as usize]
    }
}

/// What was lent in a step: mass, and the kinetic energy that it has cost.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lent {
    pub mass: f64,
    pub energy: f64,
}

impl<T: Number> Body<T> {
    fn elements_at(&mut self, node: usize) -> &[u32] {
        if self.adjacency.starts.is_empty() {
            self.adjacency = Adjacency::new(self.mesh.nodes.len(), &self.mesh.elements);
        }
        self.adjacency.at(node)
    }

    /// By how much of its nodes an element is in need, for its volume.
    fn need(&self, element: u32) -> f64 {
        self.state.needs.get(element as usize).copied().unwrap_or(1.0)
    }

    /// Shares the nodes' masses anew, by what each element limits the step to.
    pub fn share_masses(&mut self, media: &[Medium<T>]) {
        let mut needs = Vec::with_capacity(self.mesh.elements.len());
        for block in &self.blocks {
            for i in 0..block.shapes.n {
                needs.push(self.need((block.first + i) as u32) * self.rate_of(block, i).sqrt());
            }
        }
        if needs.iter().all(|need| need.is_finite() && *need > 0.0) {
            self.state.needs = needs;
            self.weigh(media, 0..self.mesh.nodes.len() as u32);
        }
    }

    /// What a node weighs by its elements at first, and the sum of that of those that are left, times their needs.
    fn weights(&mut self, media: &[Medium<T>], node: usize) -> [f64; 2] {
        let (mut all, mut left) = (0.0, 0.0);
        for element in self.elements_at(node).to_vec() {
            let (block, i) = self.element(element as usize);
            let mass = media[block.medium].density * block.shapes.corner_volume(i);
            all += mass;
            left += if block.is_intact(i) { mass * self.need(element) } else { 0.0 };
        }
        [all, left]
    }

    /// Weighs anew what is left at these nodes.
    pub fn weigh(&mut self, media: &[Medium<T>], nodes: impl Iterator<Item = u32>) {
        let mut elements: Vec<u32> = Vec::new();
        for node in nodes {
            elements.extend_from_slice(self.elements_at(node as usize));
        }
        elements.sort_unstable();
        elements.dedup();
        for element in elements {
            if !self.is_intact(element as usize) {
                continue;
            }
            let corners = self.mesh.elements[element as usize];
            let heavier = corners.map(|node| {
                let [all, left] = self.weights(media, node as usize);
                (all + self.state.lent.get(node as usize).copied().unwrap_or(0.0)) * self.need(element) / left
            });
            let place = self.blocks.partition_point(|block| block.first <= element as usize) - 1;
            let block = &mut self.blocks[place];
            block.shapes.weigh(element as usize - block.first, heavier);
        }
    }

    /// Weighs all that is torn, after the state has been read.
    pub fn weigh_all(&mut self, media: &[Medium<T>]) {
        for (node, lent) in self.state.lent.clone().into_iter().enumerate().filter(|(_, lent)| *lent > 0.0) {
            self.set_mass(node, lent);
        }
        if !self.state.needs.is_empty() {
            self.weigh(media, 0..self.mesh.nodes.len() as u32);
        } else if !self.state.deleted.is_empty() {
            let nodes: Vec<u32> =
                (0..self.mesh.nodes.len() as u32).filter(|&node| self.has_lost(node as usize)).collect();
            let lent = (0..self.state.lent.len() as u32).filter(|&node| self.state.lent[node as usize] > 0.0);
            let nodes: Vec<u32> = nodes.into_iter().chain(lent).collect();
            self.weigh(media, nodes.into_iter());
        }
    }

    fn set_mass(&mut self, node: usize, lent: f64) {
        self.mass[node] = self.first_mass[node] + lent;
        let per_mass = T::from_f64(1.0 / self.mass[node]);
        for mobility in self.mobility[node].iter_mut().filter(|mobility| **mobility != T::default()) {
            *mobility = per_mass;
        }
    }

    /// Lends mass to the nodes of what limits the step above this rate, up to `left` in all.
    pub fn lend(&mut self, media: &[Medium<T>], rate: f64, left: f64) -> Lent {
        let mut nodes: Vec<u32> = Vec::new();
        for block in &self.blocks {
            for i in (0..block.shapes.n).filter(|&i| block.is_intact(i) && self.rate_of(block, i) > rate) {
                nodes.extend(block.shapes.nodes[i]);
            }
        }
        nodes.sort_unstable();
        nodes.dedup();
        nodes.retain(|&node| self.may_borrow(node as usize));
        self.state.lent.resize(self.mesh.nodes.len(), 0.0);
        let mut given = Lent::default();
        for &node in &nodes {
            let node = node as usize;
            let (first, before) = (self.first_mass[node], self.mass[node]);
            let more = (GROWTH * before).min(HEAVIEST * first - before).min(left - given.mass);
            if more <= 0.0 {
                continue;
            }
            self.state.lent[node] += more;
            self.set_mass(node, self.state.lent[node]);
            let kept = before / self.mass[node];
            let mut square = 0.0;
            for v in &mut self.state.velocity[node] {
                let speed: f64 = (*v).into();
                square += speed * speed;
                *v = T::from_f64(kept * speed);
            }
            given.mass += more;
            given.energy += 0.5 * before * square * (1.0 - kept);
        }
        self.weigh(media, nodes.into_iter());
        given
    }

    /// Whether a node has elements, none of which is whole, and moves by itself.
    fn may_borrow(&mut self, node: usize) -> bool {
        if self.is_loose(node) || self.first_mass[node] <= 0.0 || self.mobility[node].contains(&T::default()) {
            return false;
        }
        let elements = self.elements_at(node).to_vec();
        elements.into_iter().all(|element| {
            let element = element as usize;
            !self.is_intact(element) || self.is_torn(&self.mesh.elements[element])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::archive::Archive;
    use crate::medium::Control;
    use crate::mesh::{Section, Yarn};
    use toron::law::parameters;
    use toron::{Criterion, Rotation};
    use toron_materials::material::model::{Law, Material, Origin};

    /// A bar of 6 × 2 × 2 cubes of 1 mm, whose nodes move each otherwise.
    fn bar() -> (Body<f64>, Vec<Medium<f64>>) {
        let preset = parameters::preset("kevlar-km2-600").expect("it exists");
        let law = Law::new(preset.into(), preset.values, Rotation::Fibre, Criterion::LargestPrincipal).expect("valid");
        let (label, own, origin) = (String::new(), String::new(), Origin::default());
        let material = Material { law, density: Some(preset.density), label, own, origin, temperature: None };
        let control = Control { hourglass: 0.1, linear: 0.06, quadratic: 1.5, shape: 0.2, by_direction: false };
        let media = vec![Medium::new(&material, preset.density, control).expect("valid")];
        let section = Section::Rectangle;
        let yarn = Yarn { section, length: 6e-3, height: 2e-3, width: 2e-3, layers: 6, rows: 2, columns: 2 };
        let mut body = Body::new(yarn.mesh(), &media, |_| 0);
        for (node, v) in body.state.velocity.iter_mut().enumerate() {
            *v = [node as f64, 3.0 - node as f64, 0.5];
        }
        (body, media)
    }

    fn momentum(body: &Body<f64>) -> [f64; 3] {
        let of = |i: usize| body.mass.iter().zip(&body.state.velocity).map(|(mass, v)| mass * v[i]).sum();
        [0, 1, 2].map(of)
    }

    fn kinetic(body: &Body<f64>) -> f64 {
        let squares = body.state.velocity.iter().map(|v| v.iter().map(|v| v * v).sum::<f64>());
        body.mass.iter().zip(squares).map(|(mass, square)| 0.5 * mass * square).sum()
    }

    /// Half of a layer in the middle is torn, and everything limits the step.
    fn torn() -> (Body<f64>, Vec<Medium<f64>>) {
        let (mut body, media) = bar();
        body.delete(&[8, 9]);
        body.blocks.iter_mut().for_each(|block| block.rates.fill(1.0));
        (body, media)
    }

    #[test]
    fn mass_is_lent_to_torn_ends_alone_and_no_momentum_comes_of_it() {
        let (mut body, media) = torn();
        let (before, energy, first) = (momentum(&body), kinetic(&body), body.mass.clone());
        let lent = body.lend(&media, 0.5, f64::INFINITY);
        for (node, (&mass, &first)) in body.mass.iter().zip(&first).enumerate() {
            let elements: Vec<usize> =
                (0..body.mesh.elements.len()).filter(|&e| body.mesh.elements[e].contains(&(node as u32))).collect();
            let whole = |&e: &usize| body.is_intact(e) && !body.is_torn(&body.mesh.elements[e]);
            let borrows = !elements.iter().any(whole) && elements.iter().any(|&e| body.is_intact(e));
            assert!((mass / first - if borrows { 1.0 + GROWTH } else { 1.0 }).abs() < 1e-15, "{node}");
        }
        let added: f64 = body.mass.iter().sum::<f64>() - first.iter().sum::<f64>();
        assert!(lent.mass > 0.0 && (lent.mass / added - 1.0).abs() < 1e-12);
        for (found, expected) in momentum(&body).into_iter().zip(before) {
            assert!((found - expected).abs() < 1e-12 * expected.abs(), "{found} {expected}");
        }
        assert!(lent.energy > 0.0 && (energy - kinetic(&body) - lent.energy).abs() < 1e-12 * energy);
        // No node gets heavier than so many times what it was, and no more is lent than there is.
        (0..20).for_each(|_| _ = body.lend(&media, 0.5, f64::INFINITY));
        let most = body.mass.iter().zip(&first).map(|(mass, first)| mass / first).fold(0.0, f64::max);
        assert!((most - HEAVIEST).abs() < 1e-12, "{most}");
        let (mut body, media) = torn();
        let given = body.lend(&media, 0.5, 0.3 * lent.mass).mass;
        assert!((given / lent.mass - 0.3).abs() < 1e-12, "{given}");
    }

    /// What follows from the state is there again when it has been read.
    #[test]
    fn shares_and_lent_masses_are_read_back_to_the_bit() {
        let (mut body, media) = torn();
        body.share_masses(&media);
        body.state.needs[3] = 2.5;
        body.weigh_all(&media);
        body.lend(&media, 0.5, f64::INFINITY);
        let mut archive = Archive::Writes(Vec::new());
        body.archive(&media, &mut archive).expect("it is written");
        let Archive::Writes(bytes) = archive else { panic!("it was written") };
        let (mut other, _) = bar();
        other.archive(&media, &mut Archive::Reads(&bytes)).expect("it is read");
        assert!(body.mass == other.mass && body.mobility == other.mobility);
        let spread = |body: &Body<f64>| format!("{:?}", body.blocks[0].shapes);
        assert_eq!(spread(&body), spread(&other));
    }
}
