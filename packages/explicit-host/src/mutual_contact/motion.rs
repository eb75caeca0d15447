//! How far parts of bodies have moved against one another: what was apart cannot touch before that is as much as the
//! gap.
//!
//! A body is cut into slabs along the direction in which it is largest, at rest. A face's corners lie in its slab and
//! the ones beside it, and so do those of the faces around it. In every step each slab has a box around its nodes'
//! motions; two slabs have moved against each other by no more than what is between the farthest ends of their boxes. A
//! panel that goes down as one has moved far and its yarns hardly against each other.

use std::ops::Range;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::bounds::Bounds;
use super::surface::Surface;

/// Slabs that are closer than this many times the margin are followed in pairs, all others by the fastest.
const NEAR: f64 = 8.0;
/// Slabs that may go no farther than this many margins are searched together with those that are due.
const SOON: f64 = 0.5;
/// Pairs that a thread takes at a time.
const SHARE: usize = 8192;

/// Two slabs by their numbers, and how far they may go before what was farther than the margin may touch.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Approach {
    slabs: [u32; 2],
    until: f64,
}

/// What is to be searched since something that was farther than the margin may touch now.
pub enum Due {
    All,
    /// These slabs and what is near them.
    Slabs(Vec<[u32; 2]>),
}

/// The motion of all bodies' slabs since the last search of all.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct Motion {
    /// The number of each body's first slab, and of all slabs.
    first: Vec<u32>,
    /// In the order of their slabs, of which the first is the lower one; where those of each begin.
    approaches: Vec<Approach>,
    starts: Vec<u32>,
    /// How far the two of each may have moved against each other since the last search of all.
    moved: Vec<f64>,
    /// By slabs that are far from each other.
    far: f64,
    /// How the nodes of each slab and of those beside it have moved in the last step.
    #[serde(skip)]
    of_slabs: Vec<Bounds>,
}

impl Motion {
    pub fn new(surfaces: &[Surface]) -> Motion {
        let mut first = vec![0];
        for surface in surfaces {
            first.push(first[first.len() - 1] + surface.slabs as u32);
        }
        let starts = vec![0; first[first.len() - 1] as usize + 1];
        // Before the first search.
        Motion { first, starts, far: f64::INFINITY, ..Motion::default() }
    }

    /// The numbers of bodies and of slabs.
    pub fn bodies(&self) -> usize {
        self.first.len() - 1
    }

    pub fn slabs(&self) -> usize {
        self.first[self.bodies()] as usize
    }

    /// The number of a body's slab among all.
    #[inline(always)]
    pub fn slab(&self, body: usize, slab: u16) -> usize {
        self.first[body] as usize + usize::from(slab)
    }

    /// The numbers of a body's slabs among all.
    pub fn slabs_of(&self, body: usize) -> Range<usize> {
        self.first[body] as usize..self.first[body + 1] as usize
    }

    /// The body of a slab.
    pub fn body(&self, slab: u32) -> usize {
        self.first.partition_point(|&first| first <= slab) - 1
    }

    /// Adds the motion of a step.
    pub fn advance(&mut self, surfaces: &[Surface], margin: f64) -> Due {
        self.of_slabs.clear();
        let mut all = Bounds::EMPTY;
        for surface in surfaces {
            let own = &surface.moved_by_slab;
            for slab in 0..own.len() {
                let (before, after) = (slab.saturating_sub(1), (slab + 1).min(own.len() - 1));
                self.of_slabs.push(own[before].with(own[slab]).with(own[after]));
                all = all.with(own[slab]);
            }
        }
        self.far += all.largest_difference(&all).max(0.0);
        if self.far >= NEAR * margin {
            return Due::All;
        }
        let of_slabs = &self.of_slabs;
        let advance = |due: bool, (approach, moved): (&Approach, &mut f64)| {
            let [a, b] = approach.slabs.map(|slab| &of_slabs[slab as usize]);
            *moved += a.largest_difference(b).max(0.0);
            *moved >= approach.until || due
        };
        let advance_all = |(part, moved): (&[Approach], &mut [f64])| part.iter().zip(moved).fold(false, advance);
        let parts = self.approaches.par_chunks(SHARE).zip(self.moved.par_chunks_mut(SHARE));
        let mut due = Vec::new();
        if parts.map(advance_all).reduce(|| false, |a, b| a | b) {
            // Those that would be due soon as well: searches then are rarer.
            for (approach, moved) in self.approaches.iter_mut().zip(&self.moved) {
                if moved + SOON * margin >= approach.until {
                    approach.until = moved + margin;
                    due.push(approach.slabs);
                }
            }
        }
        Due::Slabs(due)
    }

    /// Has the next step search everything.
    #[cfg(test)]
    pub fn lose_track(&mut self) {
        self.far = f64::INFINITY;
    }

    /// Begins anew from where the bodies are.
    pub fn restart(&mut self, surfaces: &[Surface], margin: f64) {
        let mut places: Vec<(Bounds, u32)> = Vec::with_capacity(self.starts.len());
        for (body, surface) in surfaces.iter().enumerate() {
            places.extend(surface.places_by_slab().into_iter().map(|place| (place, body as u32)));
        }
        // The boxes in the order of their lower ends: those near a box follow it, until one begins beyond its upper
        // end.
        let mut order: Vec<u32> = (0..places.len() as u32).collect();
        order.sort_by(|&a, &b| places[a as usize].0.low[0].total_cmp(&places[b as usize].0.low[0]));
        let (places, order) = (&places[..], &order[..]);
        let near = |place: usize| {
            let (own, body) = places[order[place] as usize];
            let end = own.high[0] + NEAR * margin;
            let following = order[place + 1..].iter().take_while(move |&&slab| places[slab as usize].0.low[0] <= end);
            let near = following.filter(|&&slab| {
                let (other, of) = &places[slab as usize];
                *of != body && own.gap(other) <= NEAR * margin
            });
            near.map(|&slab| [slab.min(order[place]), slab.max(order[place])]).collect::<Vec<_>>()
        };
        let found: Vec<Vec<[u32; 2]>> = (0..order.len()).into_par_iter().map(near).collect();
        let mut slabs = found.concat();
        slabs.sort_unstable();
        self.approaches = slabs.into_iter().map(|slabs| Approach { slabs, until: margin }).collect();
        self.moved.clear();
        self.moved.resize(self.approaches.len(), 0.0);
        self.far = 0.0;
        let slabs = self.starts.len() - 1;
        self.starts.clear();
        self.starts.push(0);
        for slab in 0..slabs as u32 {
            let from = self.starts[slab as usize];
            let own = self.approaches[from as usize..].partition_point(|approach| approach.slabs[0] == slab);
            self.starts.push(from + own as u32);
        }
    }

    /// The number of two bodies' slabs among those that are followed; `None` where they were far from each other.
    pub fn between(&self, [a, b]: [usize; 2], [in_a, in_b]: [u16; 2]) -> Option<u32> {
        let (a, b) = (self.first[a] + u32::from(in_a), self.first[b] + u32::from(in_b));
        let (lower, upper) = (a.min(b), a.max(b));
        let [start, end] = [0, 1].map(|i| self.starts[lower as usize + i] as usize);
        let found = self.approaches[start..end].binary_search_by_key(&upper, |approach| approach.slabs[1]);
        found.ok().map(|place| (start + place) as u32)
    }

    /// How far the two have moved against each other; 0 where none are followed.
    #[inline(always)]
    pub fn moved(&self, number: u32) -> f64 {
        self.moved.get(number as usize).copied().unwrap_or(0.0)
    }
}
