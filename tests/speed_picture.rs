//! The picture of the speed report, drawn from the report that lies in `benches/results`.
//! `TORON_WRITE_PICTURES=1` writes it anew there: no bench is needed.

#[path = "../benches/report/plot.rs"]
mod plot;

use std::path::Path;

#[test]
fn the_speed_report_has_its_picture() {
    let results = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/results");
    let report = std::fs::read_to_string(results.join("speed.json")).expect("the report, which `cargo bench` writes");
    let writes = std::env::var_os("TORON_WRITE_PICTURES").is_some();
    let folder = if writes { results.clone() } else { Path::new(env!("CARGO_TARGET_TMPDIR")).to_path_buf() };
    plot::write(&report, &folder).expect("a picture");
    let drawn = std::fs::read_to_string(folder.join("speed.svg")).expect("an SVG");
    let committed = std::fs::read_to_string(results.join("speed.svg")).expect("an SVG");
    assert!(drawn == committed, "benches/results/speed.svg is not the picture of speed.json");
    let png = std::fs::read(folder.join("speed.png")).expect("a PNG");
    assert!(png.starts_with(b"\x89PNG\r\n"));
}
