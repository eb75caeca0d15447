//! The yarns of a scope, with their elements and their fibres.

use std::collections::HashMap;

use super::motion::Motion;
use super::orientation::{Distribution, Orientation};
use super::scope::{Kind, Member, Scope, Section};
use crate::common::error::Error;
use crate::common::keyword_file::line::Place;
use crate::weave::foreign::raw::Raw;

pub const PARTS: &str =
    "elements of the set of one *SOLID SECTION or, without sections, of *ELEMENT, ELSET=NAME or of *ELSET";

impl Scope {
    /// Adds the yarns to the mesh; what this has not may be `shared`.
    pub fn add_to(mut self, raw: &mut Raw, shared: &Scope) -> Result<(), Error> {
        if self.mesh.element.is_empty() {
            return Ok(());
        }
        let (prefix, whole, motion) = match &self.kind {
            Kind::Instance(name, place, motion) => {
                (format!("{name}."), Some((name.clone(), place.clone())), motion.clone())
            }
            _ => (String::new(), None, Motion::default()),
        };
        let mut yarns: Vec<(String, Vec<u64>, &Section)> = Vec::new();
        let named =
            [&self.sections, &self.of_elements, &self.of_sets].into_iter().find(|sections| !sections.is_empty());
        for section in named.into_iter().flatten() {
            let elements = self.yarn(section)?;
            if !elements.is_empty() {
                yarns.push((format!("{prefix}{}", section.set), elements, section));
            }
        }
        let mut all: Vec<u64> = self.mesh.element.keys().copied().collect();
        all.sort_unstable();
        // An instance of which nothing says more is a yarn.
        let whole = whole
            .filter(|_| named.is_none() && !all.is_empty())
            .map(|(name, place)| (name.clone(), Section { set: name, orientation: None, place }));
        if let Some((name, section)) = &whole {
            yarns.push((name.clone(), all, section));
        }
        let mut yarn = vec![None; self.mesh.element.len()];
        let free = self.free_directions(shared)?;
        let mut directions: Vec<Option<[f64; 3]>> = vec![None; yarn.len()];
        for (place, (_, elements, section)) in yarns.iter().enumerate() {
            let fibre = self.fibres(section, shared)?;
            for number in elements {
                let element = self.mesh.element[number];
                if yarn[element].replace(place).is_some_and(|other| other != place) {
                    let message =
                        format!("element {number} of set {} is of another yarn too; allowed: {PARTS}", section.set);
                    return Err(section.place.error(&message));
                }
                let direction = if section.orientation.is_some() { fibre(*number)? } else { free.get(number).copied() };
                directions[element] = direction.map(|direction| motion.turned(direction));
            }
        }
        self.mesh.places.iter_mut().for_each(|place| *place = motion.moved(*place));
        let names = yarns.into_iter().map(|(name, ..)| name).collect();
        self.mesh.add_to(raw, names, &yarn, &directions, PARTS)
    }

    /// The elements of a yarn; none where its set has no volumes.
    fn yarn(&self, section: &Section) -> Result<Vec<u64>, Error> {
        let Section { set, place, .. } = section;
        let found = self.members(set, place)?;
        if found.is_empty() {
            return Err(place.error(&format!("set {set} has no elements; allowed: a set of a yarn's elements")));
        }
        match found.iter().find(|number| !self.mesh.element.contains_key(number) && !self.others.contains(number)) {
            Some(number) => Err(place.error(&format!("set {set} has element {number}, which the file does not have"))),
            None => Ok(found.into_iter().filter(|number| self.mesh.element.contains_key(number)).collect()),
        }
    }

    /// The elements of a set, and of the sets in it; `place` is where something names it.
    fn members(&self, name: &str, place: &Place) -> Result<Vec<u64>, Error> {
        let mut found = Vec::new();
        self.collect(name, place, &mut Vec::new(), &mut found)?;
        Ok(found)
    }

    fn collect(&self, name: &str, place: &Place, path: &mut Vec<String>, found: &mut Vec<u64>) -> Result<(), Error> {
        if path.iter().any(|outer| outer == name) {
            return Err(place.error(&format!("set {name} has itself among its members; allowed: other sets")));
        }
        path.push(name.to_string());
        for member in self.sets.get(name).into_iter().flatten() {
            match member {
                Member::Element(number) => found.push(*number),
                // Numbers that no element has are no members: a set may not be larger than the mesh.
                Member::Range(range) => found.extend(self.in_range(*range)),
                Member::Set(inner) if self.sets.contains_key(inner) => self.collect(inner, place, path, found)?,
                Member::Set(inner) => {
                    return Err(
                        place.error(&format!("set {name} has the member {inner}, which the file does not have"))
                    );
                }
            }
        }
        path.pop();
        Ok(())
    }

    /// The elements in a range, upwards.
    fn in_range(&self, [first, last, step]: [u64; 3]) -> Vec<u64> {
        let is_there = |number: &u64| self.mesh.element.contains_key(number) || self.others.contains(number);
        let count = self.mesh.element.len() + self.others.len();
        if (last - first) / step <= count as u64 {
            return (0..=(last - first) / step).map(|i| first + i * step).filter(is_there).collect();
        }
        let inside = |number: &u64| (first..=last).contains(number) && (number - first).is_multiple_of(step);
        let mut found: Vec<u64> = self.mesh.element.keys().chain(&self.others).copied().filter(inside).collect();
        found.sort_unstable();
        found
    }

    /// The direction of each element by a section's orientation.
    fn fibres<'a>(
        &'a self,
        section: &Section,
        shared: &'a Scope,
    ) -> Result<impl Fn(u64) -> Result<Option<[f64; 3]>, Error> + 'a, Error> {
        let place = section.place.clone();
        let missing = |name: &str| {
            section.place.error(&format!("ORIENTATION={name}, which the file does not have; allowed: an *ORIENTATION"))
        };
        let orientation = match &section.orientation {
            Some(name) => {
                let own = self.orientations.get(name).or(shared.orientations.get(name));
                Some(own.ok_or_else(|| missing(name))?)
            }
            None => None,
        };
        let by_element = match orientation.and_then(Orientation::distribution) {
            Some(name) => {
                let own = self.distributions.get(&name).or(shared.distributions.get(&name));
                let place = orientation.map_or(&section.place, |orientation| &orientation.place);
                let missing = || place.error(&format!("*DISTRIBUTION {name}, which the file does not have"));
                let distribution = own.ok_or_else(missing)?;
                if self.is_of_vectors(distribution, shared) == Some(false) {
                    return Err(
                        place.error(&format!("*DISTRIBUTION {name} is of no vectors; allowed: COORD3D, COORD3D"))
                    );
                }
                Some(distribution.by_element(&|name, place| self.members(name, place), &self.mesh.element)?)
            }
            None => None,
        };
        Ok(move |number: u64| {
            let Some(orientation) = orientation else { return Ok(None) };
            let of_element = match &by_element {
                Some(all) => {
                    let wanted = || place.error(&format!("*DISTRIBUTION has no direction of element {number}"));
                    Some(*all.get(&number).ok_or_else(wanted)?)
                }
                None => None,
            };
            orientation.fibre(of_element).map(Some)
        })
    }

    /// Whether the entries of a distribution are vectors, where its table is there.
    fn is_of_vectors(&self, distribution: &Distribution, shared: &Scope) -> Option<bool> {
        let table = distribution.table.as_ref()?;
        self.tables.get(table).or(shared.tables.get(table)).copied()
    }

    /// Directions by elements of a distribution that no orientation names.
    fn free_directions(&self, shared: &Scope) -> Result<HashMap<u64, [f64; 3]>, Error> {
        let taken: Vec<String> = self.orientations.values().filter_map(Orientation::distribution).collect();
        let mut free: Vec<(&String, &Distribution)> =
            self.distributions.iter().filter(|(name, _)| !taken.contains(*name)).collect();
        free.retain(|(_, distribution)| self.is_of_vectors(distribution, shared).unwrap_or(true));
        free.sort_by_key(|(_, distribution)| distribution.place.line);
        match &free[..] {
            [] => Ok(HashMap::new()),
            [(_, distribution)] => {
                let all = distribution.by_element(&|name, place| self.members(name, place), &self.mesh.element)?;
                Ok(all.into_iter().map(|(number, (direction, _))| (number, direction)).collect())
            }
            [_, (name, second), ..] => {
                let message = format!(
                    "a second *DISTRIBUTION of vectors, {name}; allowed: one, or an *ORIENTATION that names each"
                );
                Err(second.place.error(&message))
            }
        }
    }
}
