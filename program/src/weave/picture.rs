//! stub
use super::model::Model;
use super::reader::Scene;
use crate::common::error::Error;
use std::path::Path;
pub fn write(_: &Path, _: &Path, _: &Scene, _: &Model) -> Result<(), Error> {
    Ok(())
}
