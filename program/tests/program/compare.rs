//! `toron compare` on the histories of one strike as four hosts write them; the folder's README says which of them are
//! from runs.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::weave::Picture;
use toron_test_support::library::{ROOT, folder, run};

const FILES: [&str; 4] = ["toron/scene.csv", "openradioss/sceneT01.csv", "ls-dyna", "abaqus/scene-history.csv"];

fn file(name: &str) -> PathBuf {
    Path::new(ROOT).join("program/tests/program/compare").join(name)
}

fn toron() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_toron"));
    command.arg("compare");
    command
}

/// The lines of the table by the titles of its columns.
fn table(output: &Path) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_path(output.join("compare.csv")).expect("a table");
    let titles: Vec<String> = reader.headers().expect("titles").iter().map(str::to_string).collect();
    let line = |record: csv::StringRecord| titles.iter().cloned().zip(record.iter().map(str::to_string)).collect();
    reader.records().map(|record| line(record.expect("a line"))).collect()
}

#[test]
fn four_hosts_tell_of_one_strike() {
    let output = folder("compare");
    let names = ["--names", "toron,OpenRadioss,LS-DYNA,Abaqus", "-o"];
    let said = run(toron().args(FILES.map(file)).args(names).arg(&output), "");
    let said = String::from_utf8(said.stdout).expect("a text");
    // Where viscosity is a part of the internal energy it has no column.
    assert!(said.contains("LS-DYNA has no viscosity_energy, friction_energy (-)"), "{said}");
    assert!(said.contains("OpenRadioss has no viscosity_energy (-)") && !said.contains("toron has no"), "{said}");
    let lines = table(&output);
    let number = |line: usize, title: &str| -> f64 {
        lines[line][title].parse().unwrap_or_else(|_| panic!("{title} of {line}: {}", lines[line][title]))
    };
    // The first two are from runs; printed with four digits.
    for (line, speed, energy, friction, deflection) in
        [(0, 132.6, 6082.0, 335.4, 2.242), (1, 133.1, 6128.0, 214.0, 2.164)]
    {
        assert_eq!((number(line, "speed_at_start (mm/ms)"), number(line, "residual_speed (mm/ms)")), (142.0, speed));
        assert!((number(line, "striker_energy (mJ)") - energy).abs() < 0.6, "{:?}", lines[line]);
        assert!((number(line, "friction_energy (mJ)") - friction).abs() < 0.6, "{:?}", lines[line]);
        assert!((number(line, "deflection (mm)") - deflection).abs() < 0.01, "{:?}", lines[line]);
        assert_eq!(number(line, "failed (ms)"), 0.018);
    }
    assert_eq!(lines[0]["speeds_apart (mm/ms)"], "-");
    // A quarter of 6973 mJ, in N mm there.
    assert!((number(1, "total_energy (mJ)") - 6972.0).abs() < 2.0);
    assert!((0.05..0.2).contains(&number(1, "speeds_apart (mm/ms)")), "{:?}", lines[1]);
    // The last two have the numbers of the second, as far as they print them; but for what LS-DYNA does not tell apart.
    for (line, host) in [(2, "LS-DYNA"), (3, "Abaqus")] {
        assert_eq!(lines[line]["host"], host);
        for (title, value) in lines[1].iter().filter(|(title, _)| !["history", "host"].contains(&title.as_str())) {
            if host == "LS-DYNA" && ["friction_energy (mJ)", "contact_energy (mJ)"].contains(&title.as_str()) {
                continue;
            }
            if title == "viscosity_energy (mJ)" {
                continue;
            }
            let (found, wanted): (f64, f64) = (number(line, title), value.parse().expect("a number"));
            // The kinetic energy of the yarns is a difference of two large ones, whose speeds have five digits.
            let close = 2e-3 * wanted.abs() + if title.starts_with("kinetic") { 1.0 } else { 2e-3 };
            let close = if title.starts_with("speeds_apart") { 0.02 } else { close };
            assert!((found - wanted).abs() <= close, "{host}: {title} is {found}, not {wanted}");
        }
    }
    assert_eq!(lines[2]["friction_energy (mJ)"], "-");
    // Blue, orange, green and pink lines.
    let picture = Picture::read(&output.join("compare.png"));
    for (colour, name) in [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167]].into_iter().zip(FILES) {
        assert!(picture.share(|dot| dot == colour) > 1e-5, "{name} is not drawn");
    }
}

#[test]
fn without_rbdout_the_speed_is_that_of_matsum() {
    let output = folder("compare-matsum");
    let run_of = output.join("run");
    std::fs::create_dir_all(&run_of).expect("a folder");
    for name in ["glstat", "matsum", "scene.k"] {
        std::fs::copy(file("ls-dyna").join(name), run_of.join(name)).expect("a copy");
    }
    run(toron().arg(&run_of).arg("-o").arg(&output), "");
    let line = &table(&output)[0];
    assert_eq!((line["residual_speed (mm/ms)"].as_str(), line["deflection (mm)"].as_str()), ("133.1", "-"));
}

#[test]
fn what_is_no_history_is_refused() {
    let output = folder("compare-refused");
    let said = |arguments: &[&Path], more: &[&str]| -> String {
        let Output { status, stderr, .. } =
            toron().args(arguments).args(more).arg("-o").arg(output.join("out")).output().expect("it runs");
        assert_eq!(status.code(), Some(2));
        String::from_utf8_lossy(&stderr).into_owned()
    };
    let write = |name: &str, text: &str| {
        let path = output.join(name);
        std::fs::write(&path, text).expect("a file");
        path
    };
    let radioss = std::fs::read_to_string(file(FILES[1])).expect("a history");
    let alone = write("aloneT01.csv", &radioss);
    let message = said(&[&alone], &[]);
    assert!(message.contains("its units are not told") && message.contains("alone_0000.rad"), "{message}");
    run(toron().arg(&alone).args(["--deck-units", "mm-tonne-s", "--part", "0.25", "-o"]).arg(output.join("told")), "");
    for (name, text, expected) in [
        ("notes.csv", "a,b\n1,2\n".to_string(), "notes.csv:1: begins with \"a,b\""),
        ("lessT01.csv", radioss.replace("KINETIC ENERGY", "K"), "lessT01.csv:1: no column KINETIC ENERGY"),
        ("strikerT01.csv", radioss.replace("18212 striker", "18212 node"), "no column of /TH/NODE with DX to VZ"),
        ("cutT01.csv", radioss.trim_end()[..radioss.len() - 40].to_string(), "cutT01.csv:21: number of cells"),
        ("wordT01.csv", radioss.replacen("0.000000e+00", "nan", 1), "wordT01.csv:2: time is \"nan\""),
        ("bare-history.csv", "time,Assembly:ALLKE\n0,1\n".to_string(), "no column :V1"),
        ("bare.csv", "time (ms),speed (mm/ms)\n0,1\n".to_string(), "no column \"force\""),
    ] {
        let message = said(&[&write(name, &text)], &["--deck-units", "mm-tonne-s"]);
        assert!(
            message.contains(expected) && (message.contains("allowed: ") || message.contains("there are: ")),
            "{message}"
        );
    }
    let empty = output.join("empty");
    std::fs::create_dir_all(&empty).expect("a folder");
    assert!(said(&[&empty], &[]).contains("no glstat; allowed: a folder with glstat, rbdout"));
    let mine = file(FILES[0]);
    assert!(said(&[&mine], &["--names", "a,b"]).contains("--names has 2 for 1 histories"));
    assert!(said(&[&mine], &["--units", "miles"]).contains("--units miles; allowed: "));
    assert!(said(&[&mine], &["--part", "2"]).contains("--part 2; allowed: "));
    assert!(said(&[&mine], &["--part", "0.5"]).contains("--part is given; allowed: with --deck-units"));
    write("oddT01.csv", &radioss);
    write("odd_0000.rad", "# toron compare: units furlong, part of the whole: 0.25\n");
    assert!(said(&[&output.join("oddT01.csv")], &[]).contains("odd_0000.rad:1: the deck says"));
}
