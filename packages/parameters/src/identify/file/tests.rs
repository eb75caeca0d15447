//! What a fit's file and its data say, read from files as machines export them.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::*;
use crate::identify::notes;

/// A tensile test on 0.05 mm² with a k_el of some 80 GPa.
const ROWS: &str =
    "0.200,7.58\n0.365,13.87\n0.530,20.93\n0.696,27.75\n0.861,34.56\n1.026,40.47\n1.191,46.54\n1.357,52.78\n";
const TENSION: &str = "[[data]]\nname = \"pull\"\nfile = \"data.csv\"\nloading = \"elongation\"\narea = 0.05\n";

/// The job of these tables with these data.
fn read(tables: &str, data: &[u8]) -> Result<Job, String> {
    static NUMBER: AtomicUsize = AtomicUsize::new(0);
    let number = NUMBER.fetch_add(1, Ordering::Relaxed);
    let folder = std::env::temp_dir().join(format!("toron-fits-{}-{number}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join("data.csv"), data).expect("data");
    std::fs::write(folder.join("fit.toml"), format!("units = \"mm-tonne-s\"\n{tables}")).expect("a file");
    let job = Job::read(&folder.join("fit.toml"));
    std::fs::remove_dir_all(&folder).expect("the folder can go");
    job.map_err(|error| error.to_string())
}

fn k_el(job: &Job) -> f64 {
    job.problem.fit().expect("a fit").values[0].expect("k_el")
}

#[test]
fn files_as_machines_export_them_are_one_test() {
    let plain = k_el(&read(TENSION, format!("strain (%),force (N)\n{ROWS}").as_bytes()).expect("a fit"));
    let commas = ROWS.replace(',', ";").replace('.', ",");
    let tensile = ROWS.replace('\n', ",1.0\n");
    let texts = [
        format!("strain / %,force / N\n{ROWS}"),
        format!("sep=,\nstrain (%),force (N)\n{ROWS}"),
        format!("sep=;\r\nStrain (%);Force (N)\r\n{}", commas.replace('\n', "\r\n")),
        format!("strain,force\n%,N\n{ROWS}"),
        format!("\"Strain\",\"Force\"\n\"(%)\",\"(N)\"\n{ROWS}"),
        format!("strain (%),force (N),\n{}", ROWS.replace('\n', ",\n")),
        format!("Zwick testXpert II\nSpecimen: 1\nDate: 2026-11-27\n\nstrain (%),force (N)\n{ROWS}"),
        format!("Specimen label,A1\nWidth,10.00,mm\nRate,2.00,mm/min\n\nTime,Strain,Force\n(s),(%),(N)\n{}", {
            ROWS.lines().enumerate().map(|(i, row)| format!("{i},{row}\n")).collect::<String>()
        }),
        format!("strain (%),force (N),Prüfgeschwindigkeit (mm/s)\n{tensile}"),
        format!("strain (%);force (N);Prüfer – Bemerkung\n{}", commas.replace('\n', ";Jürgen – gut\n")),
        format!("Strain [%]\tForce [kgf]\n{}", scaled('\t', 9.80665)),
        format!("Strain [%]\tForce [kg]\n{}", scaled('\t', 9.80665)),
        format!("Strain [%];Force [lbf]\n{}", scaled(';', 4.4482216152605)),
    ];
    for text in texts {
        let windows: Vec<u8> = text.chars().map(|c| if c == '–' { 0x96 } else { c as u8 }).collect();
        let utf_16 = [0xff, 0xfe].into_iter().chain(text.encode_utf16().flat_map(u16::to_le_bytes)).collect();
        for bytes in [text.as_bytes().to_vec(), windows, utf_16] {
            let job = read(TENSION, &bytes).unwrap_or_else(|error| panic!("{text}: {error}"));
            approx::assert_relative_eq!(k_el(&job), plain, max_relative = 1e-9);
            let said = "kg of the column Force is taken for kgf";
            assert_eq!(job.said.iter().any(|line| line.ends_with(said)), text.contains("[kg]"), "{:?}", job.said);
        }
    }
    // A minus of typesetters, and a comma that may stand for thousands.
    let compacted = "[[data]]\nfile = \"data.csv\"\nloading = \"compaction\"\n";
    let rows = "I_tc (-),energy (MPa)\n\u{2212}0.05,1\n\u{2212}0.06,2\n\u{2212}0.07,3\n\u{2212}0.08,4.5\n";
    read(compacted, rows.as_bytes()).expect("a fit");
    let error = read(TENSION, b"strain (%),force (N)\n0.2,\"1,250\"\n").map(|_| ()).expect_err("ambiguous");
    assert!(error.contains("the cell is \"1,250\"; allowed: a decimal point"), "{error}");
}

/// The rows with forces in another unit.
fn scaled(separator: char, unit: f64) -> String {
    let row = |row: &str| {
        let (strain, force) = row.split_once(',').expect("two cells");
        format!("{strain}{separator}{}\n", force.parse::<f64>().expect("a number") / unit)
    };
    ROWS.lines().map(row).collect()
}

#[test]
fn what_is_left_out_is_said_with_its_reason() {
    let plain = read(TENSION, format!("strain (%),force (N)\n{ROWS}").as_bytes()).expect("a fit");
    let table = format!("strain (%),force (N),excluded\n{}1.5,9,grip slipped\n", ROWS.replace('\n', ",\n"));
    let job = read(TENSION, table.as_bytes()).expect("a fit");
    assert_eq!(k_el(&job), k_el(&plain));
    assert!(
        job.said.len() == 1 && job.said[0].ends_with("data.csv: line 10 is left out: grip slipped"),
        "{:?}",
        job.said
    );
    let two = format!("{TENSION}{}", TENSION.replace("pull", "other"));
    let both = |excluded: &str| read(&format!("{two}{excluded}"), format!("strain (%),force (N)\n{ROWS}").as_bytes());
    let job = both("excluded = \"wrong gauge length\"\n").expect("a fit");
    assert_eq!(job.problem.sets.len(), 1);
    assert_eq!(job.said, ["data set other is left out: wrong gauge length"]);
    assert_eq!(both("").expect("a fit").problem.sets.len(), 2);
    let error = both("excluded = \" \"\n").map(|_| ()).expect_err("no reason");
    assert!(error.ends_with("excluded is empty; allowed: the reason in words"), "{error}");
    let error = read(&format!("{TENSION}excluded = \"all\"\n"), b"").map(|_| ()).expect_err("nothing is left");
    assert!(error.contains("nothing tells a parameter"), "{error}");
}

/// What fibres cannot be is said with and without a density, and of properties that are given.
#[test]
fn limits_of_fibres_apply_always() {
    let notes = |tables: &str, unit: &str| {
        let job = read(tables, format!("strain (%),force ({unit})\n{ROWS}").as_bytes()).expect("a fit");
        notes::notes(&job.problem, &job.problem.fit().expect("a fit")).join("\n")
    };
    for density in ["", "[yarn]\ndensity = 1.35e-9\n"] {
        for (unit, wrong) in [("N", false), ("kN", true), ("mN", true)] {
            let notes = notes(&format!("{density}{TENSION}"), unit);
            assert_eq!(notes.contains("0.5 to 1000 GPa, as fibres have: a force"), wrong, "{unit}: {notes}");
            assert!(!notes.contains("the wave along the fibre"), "{notes}");
        }
    }
    for (yarn, note) in [
        // The wave is that of a fibre, and nothing else is.
        (
            "density = 1.35e-6\n",
            "density is 1350 g/cm³; 0.2 to 9 g/cm³, as yarns of fibres have: it is most likely not in",
        ),
        ("density = 9e-13\n", "density is 9.000e-4 g/cm³; 0.2 to 9"),
        ("properties = { eps_lim = 3.5 }\n", "eps_lim is 350.0 %; 0.1 to 100 %, as fibres have: a strain"),
        ("properties = { k_ld = 2e7 }\n", "k_ld is 20000 GPa; at most 1000 GPa, as fibres have: a force"),
    ] {
        let notes = notes(&format!("[yarn]\n{yarn}{TENSION}"), "N");
        assert!(notes.contains(note), "{note}: {notes}");
    }
    // Each is that of some fibre, and both are not that of one.
    let notes = notes(&format!("[yarn]\ndensity = 1.35e-9\n{TENSION}"), "cN");
    assert!(notes.starts_with("the wave along the fibre has 0.7"), "{notes}");
}

#[test]
fn linearised_intervals_are_there_for_whom_they_suffice() {
    let data = format!("strain (%),force (N)\n{ROWS}");
    let job = read(&format!("intervals = \"linearised\"\n{TENSION}"), data.as_bytes()).expect("a fit");
    assert!(job.fit().expect("a fit").estimates.iter().all(|estimate| estimate.profile.is_none()));
    let fit = read(TENSION, data.as_bytes()).expect("a fit").fit().expect("a fit");
    assert!(fit.estimates.iter().all(|estimate| estimate.profile.is_some()) && fit.searches > 0, "{fit:?}");
}
