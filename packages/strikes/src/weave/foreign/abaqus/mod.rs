//! Abaqus inputs: `*NODE`, `*ELEMENT` of C3D8 and C3D6, a yarn for each `*SOLID SECTION`, its fibres by `*ORIENTATION`;
//! flat, or in parts that are instanced, as Abaqus/CAE writes them.
//!
//! TexGen writes flat files of dry fibres, with the directions in a file of their own beside the input.

mod keywords;
mod motion;
mod orientation;
mod scope;
mod yarns;

use std::collections::HashMap;

use super::raw::Raw;
use motion::Motion;
use scope::{Elements, Kind, Member, Scope, range};
use toron_shared::error::Error;
use toron_shared::keyword_file::abaqus::{self, Keyword, fields, label};
use toron_shared::keyword_file::line::Line;
use yarns::PARTS;

/// # Errors
/// What in the file is wrong, by line.
pub fn read(file: &str, text: &str) -> Result<Raw, Error> {
    let mut reader = Reader { scopes: vec![Scope::default()], ..Reader::default() };
    abaqus::read(file, text, &mut reader)?;
    reader.finish(file)
}

#[derive(Default)]
struct Reader {
    /// The file's own, and that of the part or instance which is being read.
    scopes: Vec<Scope>,
    parts: HashMap<String, Scope>,
    instances: Vec<Scope>,
    block: Block,
    in_step: bool,
}

/// What the lines after a keyword are.
#[derive(Clone, Default)]
enum Block {
    #[default]
    Nothing,
    Nodes,
    Elements(Elements),
    Set(String),
    Range(String),
    Table(String),
    Distribution(String),
    Orientation(String),
    Instance,
}

impl abaqus::Reader for Reader {
    fn keyword(&mut self, keyword: &Keyword<'_>) -> Result<bool, Error> {
        self.check_begun()?;
        self.block = self.block_of(keyword)?;
        Ok(!matches!(self.block, Block::Nothing))
    }

    fn data(&mut self, line: &Line<'_>) -> Result<(), Error> {
        let text = line.text.trim();
        if text.is_empty() && !matches!(self.block, Block::Instance) {
            return Ok(());
        }
        let fields: Vec<&str> = fields(text.strip_suffix(',').unwrap_or(text)).collect();
        let Some(scope) = self.scopes.last_mut() else { return Ok(()) };
        match &mut self.block {
            Block::Nothing => Ok(()),
            Block::Nodes => scope.add_node(line, &fields),
            Block::Elements(elements) => scope.add_elements(line, elements, &fields, text.ends_with(',')),
            Block::Set(name) => {
                let members = fields.iter().filter(|field| !field.is_empty()).map(|field| Member::of(field));
                scope.sets.entry(name.clone()).or_default().extend(members);
                Ok(())
            }
            Block::Range(name) => {
                let range = range(line, &fields)?;
                scope.sets.entry(name.clone()).or_default().push(range);
                Ok(())
            }
            Block::Table(name) => {
                scope.tables.entry(name.clone()).or_insert_with(|| label(fields[0]) == "COORD3D");
                Ok(())
            }
            Block::Distribution(name) => match scope.distributions.get_mut(name) {
                Some(distribution) => distribution.add(line, &fields),
                None => Ok(()),
            },
            Block::Orientation(name) => match scope.orientations.get_mut(name) {
                Some(orientation) => orientation.add(line, &fields),
                None => Ok(()),
            },
            Block::Instance => match &mut scope.kind {
                Kind::Instance(_, _, motion) => motion.add(line, &fields),
                _ => Ok(()),
            },
        }
    }
}

impl Reader {
    fn block_of(&mut self, keyword: &Keyword<'_>) -> Result<Block, Error> {
        let name = keyword.name.as_str();
        if self.in_step {
            self.in_step = name != "ENDSTEP";
            return keywords::check_in_step(keyword).map(|()| Block::Nothing);
        }
        match name {
            "PART" | "INSTANCE" => return self.begin(keyword),
            "ENDPART" | "ENDINSTANCE" => return self.end(keyword),
            "STEP" => {
                self.in_step = true;
                return Ok(Block::Nothing);
            }
            "NODE" | "ELEMENT" | "ELSET" | "SOLIDSECTION" | "DISTRIBUTIONTABLE" | "DISTRIBUTION" | "ORIENTATION" => {}
            _ => return keywords::check(keyword).map(|()| Block::Nothing),
        }
        match self.scopes.last_mut() {
            Some(scope) => scope.block(keyword),
            None => Ok(Block::Nothing),
        }
    }

    fn begin(&mut self, keyword: &Keyword<'_>) -> Result<Block, Error> {
        let Keyword { line, name, .. } = keyword;
        if let [_, .., open] = &self.scopes[..] {
            return Err(line.error(&format!("*{name} in {}; allowed: behind its end", open.kind.name())));
        }
        let own = keyword.needed("NAME")?;
        if name == "PART" {
            keyword.allow(&["NAME"])?;
            self.scopes.push(Scope { kind: Kind::Part(own, line.place()), ..Scope::default() });
            return Ok(Block::Nothing);
        }
        keyword.allow(&["NAME", "PART"])?;
        let part = keyword.needed("PART")?;
        let wanted =
            || line.error(&format!("*INSTANCE of {part}, which the file does not have; allowed: a *PART before it"));
        let scope = self.parts.get(&part).ok_or_else(wanted)?.clone();
        self.scopes.push(Scope { kind: Kind::Instance(own, line.place(), Motion::default()), ..scope });
        Ok(Block::Instance)
    }

    fn end(&mut self, keyword: &Keyword<'_>) -> Result<Block, Error> {
        let Keyword { line, name, .. } = keyword;
        let wrong = || line.error(&format!("{}; allowed: behind what it ends", keyword.title()));
        let scope = if self.scopes.len() > 1 { self.scopes.pop() } else { None };
        let scope = scope.ok_or_else(wrong)?;
        match (scope.kind.clone(), name.as_str()) {
            (Kind::Part(part, _), "ENDPART") => {
                if self.parts.insert(part.clone(), scope).is_some() {
                    return Err(line.error(&format!("there is a part {part} already; allowed: each name once")));
                }
            }
            (Kind::Instance(..), "ENDINSTANCE") => self.instances.push(scope),
            _ => return Err(wrong()),
        }
        Ok(Block::Nothing)
    }

    /// That the element which was read last has all its nodes.
    fn check_begun(&self) -> Result<(), Error> {
        let Block::Elements(Elements { nodes: Some(nodes), begun: Some((numbers, place)), .. }) = &self.block else {
            return Ok(());
        };
        let found = numbers.len() - 1;
        Err(place.error(&format!("element {} has {found} nodes; allowed: {nodes}", numbers[0])))
    }

    fn finish(mut self, file: &str) -> Result<Raw, Error> {
        self.check_begun()?;
        if let [_, .., open] = &self.scopes[..] {
            return Err(Error::Input(format!(
                "{file}: {} has no end; allowed: *END PART, *END INSTANCE",
                open.kind.name()
            )));
        }
        let mut raw = Raw::default();
        let own = self.scopes.pop().unwrap_or_default();
        let flat = self.instances.is_empty();
        for scope in self.instances {
            scope.add_to(&mut raw, &own)?;
        }
        if !flat {
            own.check_without_elements()?;
        }
        if flat || !own.mesh.element.is_empty() {
            let shared = Scope::default();
            own.add_to(&mut raw, &shared)?;
        }
        if raw.yarns.is_empty() {
            return Err(Error::Input(format!("{file}: nothing says which elements are a yarn; allowed: {PARTS}")));
        }
        Ok(raw)
    }
}
