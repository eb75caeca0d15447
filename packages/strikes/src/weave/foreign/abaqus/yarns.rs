//! The yarns of a scope, with their elements and their fibres.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::motion::Motion;
use super::orientation::{Distribution, Orientation, Points};
use super::scope::{Kind, Member, Scope, Section};
use crate::weave::foreign::raw::Raw;
use toron_shared::error::Error;
use toron_shared::keyword_file::line::Place;

pub const PARTS: &str =
    "elements of the set of one *SOLID SECTION or, without sections, of *ELEMENT, ELSET=NAME or of *ELSET";

/// Elements by their numbers, and what says that they are a yarn.
struct Yarn {
    name: String,
    elements: Vec<u64>,
    section: Section,
}

impl Scope {
    /// Adds the yarns to the mesh; the table of a distribution may be in `shared`.
    ///
    /// # Errors
    /// What of them is wrong.
    pub fn add_to(mut self, raw: &mut Raw, shared: &Scope) -> Result<(), Error> {
        if self.mesh.element.is_empty() {
            return Ok(());
        }
        let yarns = self.yarns()?;
        let free = self.free_directions(shared)?;
        let motion = if let Kind::Instance(_, _, motion) = &self.kind { motion.clone() } else { Motion::default() };
        let mut known = HashMap::new();
        let mut yarn = vec![None; self.mesh.element.len()];
        let mut directions: Vec<Option<[f64; 3]>> = vec![None; yarn.len()];
        for (place, Yarn { elements, section, .. }) in yarns.iter().enumerate() {
            let fibres = self.fibres(section, elements, shared, &mut known)?;
            for (i, number) in elements.iter().enumerate() {
                let element = self.mesh.element[number];
                if yarn[element].replace(place).is_some_and(|other| other != place) {
                    let message =
                        format!("element {number} of set {} is of another yarn too; allowed: {PARTS}", section.set);
                    return Err(section.place.error(&message));
                }
                let direction = fibres.as_ref().map_or_else(|| free.get(number).copied(), |fibres| Some(fibres[i]));
                directions[element] = direction.map(|direction| motion.turned(direction));
            }
        }
        self.mesh.places.iter_mut().for_each(|place| *place = motion.moved(*place));
        self.mesh.add_to(raw, yarns.into_iter().map(|yarn| yarn.name).collect(), &yarn, &directions, PARTS)
    }

    /// That nothing outside the parts says what fibres of elements in them are.
    ///
    /// # Errors
    /// A section, or directions that nothing takes.
    pub fn check_without_elements(&self) -> Result<(), Error> {
        if !self.mesh.element.is_empty() {
            return Ok(());
        }
        let directions = self.distributions.values().filter(|one| self.is_of_vectors(one, self).unwrap_or(true));
        let outside = self.sections.iter().map(|section| (&section.place, "*SOLID SECTION"));
        let mut outside = outside.chain(directions.map(|one| (&one.place, "*DISTRIBUTION of vectors")));
        let what = |(place, what): (&Place, &str)| {
            place.error(&format!("{what} outside the parts; allowed: in the part, or in the instance, of its elements"))
        };
        outside.next().map_or(Ok(()), |one| Err(what(one)))
    }

    /// What is a yarn: by sections, else by sets; an instance without either is one.
    fn yarns(&self) -> Result<Vec<Yarn>, Error> {
        let mut sections = [&self.sections, &self.of_elements, &self.of_sets].into_iter();
        match (sections.find(|sections| !sections.is_empty()), &self.kind) {
            (Some(sections), kind) => {
                let mut yarns = Vec::new();
                for section in sections {
                    let name = match kind {
                        Kind::Instance(instance, ..) => format!("{instance}.{}", section.set),
                        _ => section.set.clone(),
                    };
                    yarns.push(Yarn { name, elements: self.elements(section)?, section: section.clone() });
                }
                yarns.retain(|yarn| !yarn.elements.is_empty());
                Ok(yarns)
            }
            (None, Kind::Instance(name, place, _)) => {
                let mut elements: Vec<u64> = self.mesh.element.keys().copied().collect();
                elements.sort_unstable();
                let section = Section { set: name.clone(), orientation: None, place: place.clone() };
                Ok(vec![Yarn { name: name.clone(), elements, section }])
            }
            (None, _) => Ok(Vec::new()),
        }
    }

    /// The elements of a section; none where its set has no volumes.
    fn elements(&self, section: &Section) -> Result<Vec<u64>, Error> {
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

    /// The directions of a section's elements by its orientation, if it has one; `known` are the distributions that
    /// sections before it have named.
    fn fibres(
        &self,
        Section { orientation, place, .. }: &Section,
        elements: &[u64],
        shared: &Scope,
        known: &mut HashMap<String, HashMap<u64, Points>>,
    ) -> Result<Option<Vec<[f64; 3]>>, Error> {
        let Some(name) = orientation else { return Ok(None) };
        // A section of a part names what is in the part, which turns with its instances: axes outside it would not.
        let missing = |is_outside: bool| {
            if is_outside {
                "stands outside the part; allowed: in the part, or in the instance"
            } else {
                "the file does not have; allowed: an *ORIENTATION, and its *DISTRIBUTION"
            }
        };
        let orientation = self.orientations.get(name).ok_or_else(|| {
            let missing = missing(shared.orientations.contains_key(name));
            place.error(&format!("ORIENTATION={name}, which {missing}"))
        })?;
        let Some(name) = orientation.distribution() else {
            return Ok(Some(vec![orientation.fibre(None)?; elements.len()]));
        };
        let wrong = |what: &str| orientation.place.error(&format!("*DISTRIBUTION {name}{what}"));
        let distribution = self.distributions.get(&name).ok_or_else(|| {
            let missing = missing(shared.distributions.contains_key(&name));
            wrong(&format!(", which {missing}"))
        })?;
        if self.is_of_vectors(distribution, shared) == Some(false) {
            return Err(wrong(" is of no vectors; allowed: COORD3D, COORD3D"));
        }
        let all = match known.entry(name.clone()) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(new) => {
                new.insert(distribution.by_element(&|name, place| self.members(name, place), &self.mesh.element)?)
            }
        };
        let of_element = |number: &u64| match all.get(number) {
            Some(points) => orientation.fibre(Some(*points)),
            None => Err(wrong(&format!(" has no direction of element {number}"))),
        };
        elements.iter().map(of_element).collect::<Result<_, _>>().map(Some)
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
