//! stub
use std::path::Path;
use super::model::Model;
use super::reader::Scene;
use crate::common::error::Error;
pub fn write(_: &Path, _: &Path, _: &Scene, _: &Model) -> Result<(), Error> { Ok(()) }
