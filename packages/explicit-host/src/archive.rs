//! What a run has to remember, as bytes: a run that goes on from them has the same bits as one that was not
//! interrupted.
//!
//! Writing and reading go the same way over the same states, so that they cannot differ in order. A state has no
//! hand-written list of its fields: it is a structure apart from what follows from the scene (meshes, materials,
//! supports), which is not written.

use serde::Serialize;
use serde::de::DeserializeOwned;

/// Takes the values that it is given, or replaces them.
#[derive(Debug)]
pub enum Archive<'a> {
    Writes(Vec<u8>),
    Reads(&'a [u8]),
}

impl Archive<'_> {
    /// Writes a value, or reads it back.
    ///
    /// # Errors
    /// The bytes end, or are no such value.
    pub fn keep<V: Serialize + DeserializeOwned>(&mut self, value: &mut V) -> Result<(), postcard::Error> {
        match self {
            Archive::Writes(bytes) => *bytes = postcard::to_extend(value, std::mem::take(bytes))?,
            Archive::Reads(bytes) => (*value, *bytes) = postcard::take_from_bytes(bytes)?,
        }
        Ok(())
    }
}
