//! `toron weave`: from the file of a weave to its mesh, figures and picture.

use std::fmt::Write;
use std::path::Path;

use super::reader::Scene;
use super::{picture, report, vtu};
use toron_shared::console::print;
use toron_shared::error::Error;
use toron_shared::run_directory::{RunDirectory, Writes, file_error};

/// What the files are called.
pub const NAME: &str = "weave";

/// Meshes the panel of a scene, which was read from `path`, prints its figures, and writes the mesh and a picture of it
/// to the directory `output`.
///
/// # Errors
/// The input, or a file that cannot be written.
pub fn run(scene: &Scene, path: &Path, output: &Path) -> Result<(), Error> {
    let model = scene.cloth.model();
    let writes = Writes { command: "weave", files: vec![path], names: vec![NAME.to_string()], ..Writes::default() };
    let _directory = RunDirectory::lock(output, writes)?.claim()?;
    let mut text = report::report(scene, &model);
    let [mesh, svg, png] = ["vtu", "svg", "png"].map(|ending| output.join(format!("{NAME}.{ending}")));
    std::fs::write(&mesh, vtu::unstructured_grid(&model)).map_err(|error| file_error(&mesh, &error))?;
    picture::write(&svg, &png, scene, &model)?;
    let _ =
        writeln!(text, "\nFiles in {}: weave.vtu for ParaView, the picture weave.svg and weave.png", output.display());
    print(&text);
    Ok(())
}
