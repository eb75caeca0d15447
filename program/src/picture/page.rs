//! From a drawing to its two files, SVG and PNG.

use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::sheet::Sheet;
use crate::common::error::Error;

pub type Area<'a> = DrawingArea<&'a mut Sheet, Shift>;
pub type Drawn<T> = Result<T, Box<dyn std::error::Error>>;

/// Draws a picture of this width and height and writes it to two files.
///
/// # Errors
/// A file cannot be written.
pub fn write(svg: &Path, png: &Path, size: [u32; 2], paint: impl FnOnce(&Area) -> Drawn<()>) -> Result<(), Error> {
    let file_error = |file: &Path, error: &dyn std::fmt::Display| Error::Input(format!("{}: {error}", file.display()));
    let sheet = draw(size, paint).map_err(|error| file_error(svg, &error))?;
    std::fs::write(svg, sheet.svg()).map_err(|error| file_error(svg, &error))?;
    let pixels = sheet.png().map_err(|error| file_error(png, &error))?;
    std::fs::write(png, pixels).map_err(|error| file_error(png, &error))
}

pub(super) fn draw(size: [u32; 2], paint: impl FnOnce(&Area) -> Drawn<()>) -> Drawn<Sheet> {
    let mut sheet = Sheet::new(size)?;
    let root = sheet.into_drawing_area();
    root.fill(&WHITE)?;
    paint(&root)?;
    root.present()?;
    drop(root);
    Ok(sheet)
}
