//! `toron weave` on its example; `documents.rs` has what it prints.

use std::path::Path;
use std::process::Command;

use tiny_skia::Pixmap;

use toron_test_support::library::{ROOT, folder, run};
use toron_test_support::update::is_asked;

#[test]
fn the_example_is_meshed_and_drawn() {
    let output = folder("weave");
    let arguments = ["weave", "examples/fabric_impact/weave.toml", "-o"];
    run(Command::new(env!("CARGO_BIN_EXE_toron")).args(arguments).arg(&output).current_dir(ROOT), "");
    let mesh = std::fs::read_to_string(output.join("weave.vtu")).expect("a mesh");
    assert!(mesh.contains("NumberOfPoints=\"173424\" NumberOfCells=\"98136\""));
    assert!(output.join("weave.svg").metadata().expect("a picture").len() > 10_000);
    // Two squares of 604 and a cut, of a sheet of 1280: warp is blue, weft orange, and they cover about as much.
    let picture = Picture::read(&output.join("weave.png"));
    assert_eq!(picture.0.width(), 1920);
    let white = picture.share(|[red, green, blue]| red.min(green).min(blue) == 255);
    let warp = picture.share(|[red, _, blue]| blue > red + 40);
    let weft = picture.share(|[red, _, blue]| red > blue + 40);
    assert!((0.35..0.5).contains(&white), "{white}");
    assert!((0.24..0.33).contains(&warp) && (0.23..0.32).contains(&weft), "{warp} {weft}");
    if is_asked("pictures") {
        std::fs::copy(output.join("weave.png"), Path::new(ROOT).join("docs/images/weave.png")).expect("a copy");
    }
}

/// A picture's dots.
pub struct Picture(Pixmap);

impl Picture {
    pub fn read(file: &Path) -> Picture {
        Picture(Pixmap::load_png(file).unwrap_or_else(|error| panic!("{}: {error}", file.display())))
    }

    /// The part of the dots whose red, green and blue are such.
    pub fn share(&self, such: impl Fn([i32; 3]) -> bool) -> f64 {
        let dots = self.0.pixels();
        let colour = |dot: &tiny_skia::PremultipliedColorU8| [dot.red(), dot.green(), dot.blue()].map(i32::from);
        dots.iter().filter(|dot| such(colour(dot))).count() as f64 / dots.len() as f64
    }
}

/// In a system of millimetres and tonnes a density in g/mm³ is a thousand times too large.
#[test]
fn a_panel_that_no_fabric_weighs_is_warned_of() {
    let output = folder("weave-units");
    let scene = output.join("scene.toml");
    let text = "units = \"mm-tonne-s\"\n[weave]\npreset = \"kevlar-s706\"\n[weave.panel]\nshape = \"circle\"\nradius = 2.0\n\
                [material]\npreset = \"kevlar-km2-600\"\ndensity = 1.3514e-6\n";
    std::fs::write(&scene, text).expect("a file");
    let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
    let answer = program.arg("weave").arg(&scene).arg("-o").arg(&output).output().expect("it starts");
    let text = String::from_utf8(answer.stdout).expect("UTF-8");
    for warning in [
        "\nwarning: the wave along the fibre has 0.2468 km/s, and fibres have 1 to 20:\n  density or k_el is most likely not",
        "\nwarning: the panel weighs 177.",
    ] {
        assert!(answer.status.success() && text.contains(warning), "{text}");
    }
}

/// The scene of a strike has a panel as well.
#[test]
fn the_panel_of_a_strike_is_meshed() {
    let output = folder("weave-strike");
    let arguments = ["weave", "examples/fabric_impact/coarse.toml", "-o"];
    run(Command::new(env!("CARGO_BIN_EXE_toron")).args(arguments).arg(&output).current_dir(ROOT), "");
    let mesh = std::fs::read_to_string(output.join("weave.vtu")).expect("a mesh");
    assert!(mesh.contains("NumberOfCells=\"32688\""), "{}", &mesh[..200]);
}
