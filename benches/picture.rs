//! The picture of the speed report, drawn from the report that lies in `benches/results`.
//! `cargo xtask update pictures` writes it anew there: no bench is needed.

#[path = "report/plot.rs"]
mod plot;

use std::path::Path;
use toron_test_support::update::is_asked;

#[test]
fn the_speed_report_has_its_picture() {
    let results = Path::new(env!("CARGO_MANIFEST_DIR")).join("results");
    let report = std::fs::read_to_string(results.join("speed.json")).expect("the report, which `cargo bench` writes");
    let writes = is_asked("pictures");
    let folder = if writes { results.clone() } else { Path::new(env!("CARGO_TARGET_TMPDIR")).to_path_buf() };
    plot::write(&report, &folder).expect("a picture");
    let drawn = std::fs::read_to_string(folder.join("speed.svg")).expect("an SVG");
    let committed = std::fs::read_to_string(results.join("speed.svg")).expect("an SVG");
    assert!(drawn == committed, "benches/results/speed.svg is not the picture of speed.json");
    let png = std::fs::read(folder.join("speed.png")).expect("a PNG");
    assert!(png.starts_with(b"\x89PNG\r\n"));
}

/// The README's and the documents' ratios are those of the report.
#[test]
fn documents_have_the_ratios_of_the_report() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let text = |file: &str| {
        let text = std::fs::read_to_string(root.join(file)).expect("a file of the repository");
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let report: serde_json::Value = serde_json::from_str(&text("benches/results/speed.json")).expect("JSON");
    let ratio = |name: &str| {
        let ratios = report["ratios"].as_array().expect("ratios");
        let row = ratios.iter().find(|row| row["name"].as_str().is_some_and(|found| found.starts_with(name)));
        row.and_then(|row| row["times"]["median"].as_f64()).expect("a ratio of the report")
    };
    let [loops, scalar] = ["fastest Fortran loop / f64 block", "scalar Fortran / f64 block"].map(ratio);
    let copy = ratio("f64 block / copy limit");
    let (readme, method) = (text("README.md"), text("docs/results/speed.md"));
    let takes = format!("The fastest Fortran loop takes {loops:.2} times as long as a block call of the library");
    for said in [takes, format!("the thesis's formula in scalar Fortran {scalar:.0} times.")] {
        assert!(readme.contains(&said), "README.md does not say: {said}");
    }
    let takes = format!("the fastest Fortran loop takes {loops:.2} times as long as the f64 block");
    let copied = format!("the block takes {copy:.1} of the time of an ordinary copy");
    for said in [takes, format!("the scalar Fortran form {scalar:.0} times"), copied] {
        assert!(method.contains(&said), "docs/results/speed.md does not say: {said}");
    }
}
