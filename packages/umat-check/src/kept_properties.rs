//! Whether a library keeps the properties of the material that it was first called with.

use super::child::{ChildReply, Ending, Task};
use super::finding::{Finding, Question, Verdict};
use super::material::Material;
use toron_shared::error::Error;

/// By what the properties of the other material differ.
const OTHER: f64 = 1.04;

/// Runs a task in a child of its own.
type Run<'a> = dyn FnMut(Task) -> Result<Result<ChildReply, Ending>, Error> + 'a;

/// Another material with other PROPS and another CMNAME, after the first one and alone; none where the answers are the
/// same, or the law refuses that material.
///
/// # Errors
/// The child cannot be started.
pub fn kept_between_materials(run: &mut Run, material: &Material) -> Result<Option<Finding>, Error> {
    let properties = material.properties.iter().map(|property| property * OTHER).collect();
    let other = Material { name: format!("{}-B", material.name), properties, ..material.clone() };
    let mut stresses = |after: bool| {
        let task = Task::Other { material: Box::new(other.clone()), after };
        Ok(run(task)?.ok().and_then(|reply| match reply {
            ChildReply::Bits(bits) => Some(bits),
            _ => None,
        }))
    };
    let (alone, after) = (stresses(false)?, stresses(true)?);
    let (Some(alone), Some(after)) = (alone, after) else { return Ok(None) };
    if alone == after || alone.is_empty() {
        return Ok(None);
    }
    let text = "another material (other PROPS and CMNAME) has another stress if the first was called before: PROPS, or what \
                follows from them, are kept from the first call (SAVE, DATA)";
    Ok(Some(Finding::new(Question::Repeat, Verdict::Wrong, None, text).with("properties kept")))
}
