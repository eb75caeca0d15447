//! From a drawing to its two files, SVG and PNG.

use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::sheet::Sheet;
use toron_shared::console::print_error;
use toron_shared::error::Error;

pub type Area<'a> = DrawingArea<&'a mut Sheet, Shift>;
pub type Drawn<T> = Result<T, Box<dyn std::error::Error>>;

/// Draws a picture of this width and height and writes it to two files.
///
/// # Errors
/// A file cannot be written.
pub fn write(svg: &Path, png: &Path, size: [u32; 2], paint: impl FnOnce(&Area) -> Drawn<()>) -> Result<(), Error> {
    let file_error = |file: &Path, error: &dyn std::fmt::Display| Error::Input(format!("{}: {error}", file.display()));
    let sheet = draw(size, paint).map_err(|error| file_error(svg, &error))?;
    if let Some(warning) = missing(svg, &sheet) {
        print_error(&warning);
    }
    std::fs::write(svg, sheet.svg()).map_err(|error| file_error(svg, &error))?;
    let pixels = sheet.png().map_err(|error| file_error(png, &error))?;
    std::fs::write(png, pixels).map_err(|error| file_error(png, &error))
}

/// A warning where the font lacks characters of the texts.
fn missing(file: &Path, sheet: &Sheet) -> Option<String> {
    let missing: Vec<String> = sheet.missing().iter().map(char::to_string).collect();
    let file = file.display();
    (!missing.is_empty()).then(|| {
        let missing = missing.join(" ");
        format!("warning: {file}: the font of the pictures lacks {missing}; boxes stand for them. It has Latin and Greek letters\n")
    })
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
