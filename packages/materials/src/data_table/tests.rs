use proptest::prelude::*;

use super::*;
use crate::units::FORCE;
use toron::law::parameters::{NUMBER, STRESS};

#[track_caller]
fn parse(text: &str) -> DataTable {
    DataTable::parse("data.csv", text).unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// What is wrong with a table, or with the first column that is none of numbers with a unit.
#[track_caller]
fn rejected(text: &str) -> String {
    let error = DataTable::parse("data.csv", text).map(|table| table.others.first().map(|other| other.error.clone()));
    error.unwrap_or_else(Some).unwrap_or_else(|| panic!("nothing is wrong with {text}")).to_string()
}

fn values(table: &DataTable, name: &str) -> Vec<f64> {
    table.column(name).expect("the column exists").values.iter().map(|cell| cell.value).collect()
}

#[test]
fn cells_keep_their_places() {
    let table =
        parse("\u{feff}# tests of March\r\n\r\n  travel [mm] ,\"force, top (N/(mm s))\"\r\n1,2\r\n#\r\n 3 , -4e1\r\n");
    assert_eq!(table.column("travel").expect("a column").unit.text, "mm");
    let force = table.column("force, top").expect("a column");
    assert_eq!((force.number, force.unit.text.as_str()), (2, "N/(mm s)"));
    assert_eq!(force.values, [Cell { value: 2.0, line: 4, column: 2 }, Cell { value: -40.0, line: 6, column: 2 }]);
    assert_eq!(table.error(6, 2, "odd").to_string(), "data.csv:6:2: column \"force, top\": odd");
}

#[test]
fn semicolons_allow_decimal_commas() {
    let comma = parse("strain (%);force (kN)\n1,5;-2\n0,25;3e2\n");
    assert_eq!((values(&comma, "strain"), values(&comma, "force")), (vec![1.5, 0.25], vec![-2.0, 300.0]));
    assert_eq!(values(&parse("strain (%);force (kN)\n1.5;2.0"), "strain"), [1.5]);
    // A comma that stands between names with units separates them; one in a name does not.
    assert!(rejected("strain (%),a;b (N)\n1,5;2\n").contains("the cell is \"5;2\""));
    let named = parse("strain, top (%);force (kN)\n1,5;-2\n");
    assert_eq!((values(&named, "strain, top"), values(&named, "force")), (vec![1.5], vec![-2.0]));
    let below = parse("strain, top;force\n%;kN\n1,5;-2\n");
    assert_eq!(values(&below, "strain, top"), [1.5]);
    // Between quotes it may stand between thousands.
    let quoted = rejected("strain (%),force (N)\n\"0,250\",\"1,5\"\n");
    let wanted = "column \"strain\": the cell is \"0,250\"; allowed: a decimal point; a decimal comma with ; or tabs";
    assert!(quoted.contains(wanted), "{quoted}");
}

/// What machines write besides names, units and numbers.
#[test]
fn forms_that_machines_export_are_one_table() {
    let rows = "0.2,7.5\n0.4,13.9\n";
    let semicolons = rows.replace(',', ";").replace('.', ",");
    for text in [
        format!("strain (%),force (N)\n{rows}"),
        format!("strain / %,force / N\n{rows}"),
        format!("sep=,\nstrain (%),force (N)\n{rows}"),
        format!("sep=;\nstrain (%);force (N)\n{semicolons}"),
        format!("Zwick testXpert II\nSpecimen: 1\nDate: 2026-11-27\n\nstrain (%),force (N)\n{rows}"),
        format!("strain (%),force (N),\n{}", rows.replace('\n', ",\n")),
        format!("strain (%),force (N)\n{}", rows.replace('\n', ",,\n")),
        format!("strain,force\n%,N\n{rows}"),
        format!("Specimen 1\nstrain;force;\n[%];[N];\n{semicolons}"),
    ] {
        let table = parse(&text);
        assert_eq!((values(&table, "strain"), values(&table, "force")), (vec![0.2, 0.4], vec![7.5, 13.9]), "{text}");
        assert_eq!(table.column("force").expect("a column").unit.text, "N");
    }
    let text = "strain (%),Prüfkraft (N)\n0.2,7.5\n";
    let utf_16 = |mark: [u8; 2], bytes: fn(u16) -> [u8; 2]| {
        mark.into_iter().chain(text.encode_utf16().flat_map(bytes)).collect::<Vec<u8>>()
    };
    let latin = text.chars().map(|c| c as u8).collect();
    let all = [
        text.as_bytes().to_vec(),
        latin,
        utf_16([0xff, 0xfe], u16::to_le_bytes),
        utf_16([0xfe, 0xff], u16::to_be_bytes),
    ];
    for bytes in all {
        assert_eq!(
            sheet::decoded(&bytes).map(|text| parse(&text).columns[1].name.clone()).as_deref(),
            Some("Prüfkraft")
        );
    }
}

/// A column of words needs no unit, and is an error where it is asked for alone.
#[test]
fn columns_of_words_are_left_alone() {
    let wanted = "2:1: the heading is \"Operator\"; allowed: a name and a unit, as in \"force (N)\"";
    for text in [
        "Preload (N);0,5\nOperator;strain (%);Remark (opt.)\nA;1,5;slipped, once\nB;0,25;\n",
        "Preload (N)\nOperator;strain;Remark\n;%;\nA;1,5;slipped, once\nB;0,25;-\n",
        "Preload (N)\nOperator;strain N/N;Remark\nA;1,5e-2;\nB;\u{2212}0,25;\n",
    ] {
        let table = parse(text);
        assert_eq!(table.columns.iter().map(|column| column.number).collect::<Vec<_>>(), [2], "{text}");
        let error = table.column("Operator").expect_err("words").to_string();
        assert!(error.trim_start_matches("data.csv:").starts_with(wanted), "{error}");
    }
    assert_eq!(values(&parse("a,b (mm)\nx,\u{2212}1.5\n"), "b"), [-1.5]);
    // The comma of words decides nothing about numbers.
    assert_eq!(values(&parse("a;b (mm)\nx, y;1.5\n"), "b"), [1.5]);
    let refused = parse("a (mm);b (mm)\n1;x\n").column("b").expect_err("no number").to_string();
    assert!(refused.starts_with("data.csv:2:2: column \"b\": the cell is \"x\""), "{refused}");
}

/// Machines begin names with capital letters.
#[test]
fn names_are_found_by_other_capital_letters() {
    let table = parse("Strain (%),FORCE (N),force (kN),Load (N),load (N)\n1,2,3,4,5\n");
    assert_eq!(values(&table, "strain"), [1.0]);
    assert_eq!(table.own_name("strain"), "Strain");
    // The same name comes first, and of two that are alike none is meant.
    assert_eq!((values(&table, "force"), values(&table, "Load")), (vec![3.0], vec![4.0]));
    assert!(!table.has("LOAD") && table.column("LOAD").is_err() && table.has("strain"));
}

#[test]
fn kilograms_and_pounds_are_taken_for_forces_where_one_is_wanted() {
    let table = parse("stress (kg/mm2),mass (kg),force (lb),strain (-)\n2,3,4,0.1\n");
    let units = UnitSystem::parse("mm-tonne-s").expect("a system");
    let (stress, said) = table.forces("stress", STRESS, &units).expect("a stress");
    assert!((stress[0] - 19.6133).abs() < 1e-12, "{stress:?}");
    assert_eq!(said.as_deref(), Some("kg/mm2 of the column stress is taken for kgf/mm2"));
    let (force, _) = table.forces("force", FORCE, &units).expect("a force");
    assert!((force[0] - 4.0 * 4.4482216152605).abs() < 1e-12, "{force:?}");
    let mass = Dimension { mass: 1, length: 0, time: 0, name: "mass" };
    assert_eq!(table.forces("mass", mass, &units), Ok((vec![0.003], None)));
    assert!(table.values("stress", STRESS, &units).is_err() && table.forces("strain", FORCE, &units).is_err());
}

#[test]
fn tests_with_a_reason_are_left_out() {
    let of = |text: &str| DataTable::of_tests(Sheet::parse("data.csv", text)?);
    let table = of("force (N),Excluded\n1,\n,slipped\n3,no\nx,broke in the grip\n").expect("a table");
    assert_eq!(values(&table, "force"), [1.0, 3.0]);
    let reason = |line, reason: &str| Excluded { line, reason: reason.to_string() };
    assert_eq!(table.excluded, [reason(3, "slipped"), reason(5, "broke in the grip")]);
    for (text, message) in [
        ("force (N),excluded\n1,yes\n", "data.csv:2:2: the cell is \"yes\"; allowed: the reason in words, or nothing"),
        ("force (N),excluded\n1,slipped\n", "data.csv:1:2: every line is left out; allowed: one at least that is not"),
    ] {
        let error = of(text).expect_err(message).to_string();
        assert_eq!(error.replace("column \"excluded\": ", ""), message);
    }
    // Who does not ask for tests has all lines.
    assert_eq!(values(&parse("force (N),excluded\n1,slipped\n"), "force"), [1.0]);
}

/// Windows writes dashes and quotes where Latin-1 has nothing, and UTF-16 without its mark.
#[test]
fn texts_of_windows_are_read() {
    let text = "v (m/s),Prüfling\n1.5,A–B\n";
    let windows: Vec<u8> = text.chars().map(|c| if c == '–' { 0x96 } else { c as u8 }).collect();
    let [little, big] = [u16::to_le_bytes, u16::to_be_bytes].map(|bytes| text.encode_utf16().flat_map(bytes).collect());
    for bytes in [windows, little, big] {
        assert_eq!(sheet::decoded(&bytes).as_deref(), Some(text));
    }
}

#[test]
fn any_line_break_ends_a_line() {
    for text in ["f (N)\n1\n2", "f (N)\r\n1\r\n2\r\n", "f (N)\r1\r2\r", "f (N)\n1\n \n2\n\n"] {
        assert_eq!(values(&parse(text), "f"), [1.0, 2.0]);
    }
}

#[test]
fn values_are_converted() {
    let table = parse("# by hand\nstrain (%),force (kN)\n1.5,0.1\n");
    let units = UnitSystem::parse("mm-tonne-s").expect("a system");
    assert_eq!(table.values("strain", NUMBER, &units), Ok(vec![0.015]));
    assert_eq!(table.values("force", FORCE, &units), Ok(vec![100.0]));
    let error = |name: &str, dimension| table.values(name, dimension, &units).expect_err("wrong").to_string();
    assert_eq!(
        error("strain", FORCE),
        "data.csv:2:1: column \"strain\": the unit is \"%\"; allowed: a unit of force, as N"
    );
    assert_eq!(error("force", NUMBER), "data.csv:2:2: column \"force\": the unit is \"kN\"; allowed: - or %");
    assert_eq!(error("Forces", FORCE), "data.csv:2: no column \"Forces\"; there are: strain, force");
}

#[test]
fn errors_name_file_line_and_column() {
    let heading = "allowed: a name and a unit, as in \"force (N)\", and \"(-)\" for a plain number";
    let empty = "data.csv:1:1: no header; allowed: columns as in \"displacement (mm), force (N)\"";
    let (one, two) = ("a (mm),b (N)\n", "column \"b\": ");
    let cases = [
        (String::new(), empty.to_string()),
        ("# nothing\n\n".to_string(), empty.to_string()),
        (one.to_string(), "1:1: column \"a\": no line of data follows the header; allowed: one at least".to_string()),
        ("#\na (mm),b\n1,2\n".to_string(), format!("2:2: the heading is \"b\"; {heading}")),
        ("a (mm),\n1,2\n".to_string(), format!("1:2: the heading is \"\"; {heading}")),
        ("(mm),b (N)\n1,2\n".to_string(), format!("1:1: the heading is \"(mm)\"; {heading}")),
        ("a mm)\n1\n".to_string(), format!("1:1: the heading is \"a mm)\"; {heading}")),
        (
            "a (mm),b (Mpa)\n1,2\n".to_string(),
            format!("1:2: the unit of \"b (Mpa)\": \"Mpa\" is not known; allowed: {}", unit_expression::ALLOWED),
        ),
        (
            "a (mm),b (N),a (s)\n1,2,3\n".to_string(),
            "1:3: the name \"a\" is that of column 1 as well; allowed: a name for each column".to_string(),
        ),
        (format!("{one}1\n"), format!("2:2: {two}number of cells: 1; allowed: 2, as in the header")),
        (format!("{one}1,2\n\n1,2,3\n"), "4:3: number of cells: 3; allowed: 2, as in the header".to_string()),
        (format!("{one}1,\n"), format!("2:2: {two}the cell is \"\"; allowed: a finite number")),
        (format!("{one}1,x\n"), format!("2:2: {two}the cell is \"x\"; allowed: a finite number")),
        (format!("{one}1,NaN\n"), format!("2:2: {two}the cell is \"NaN\"; allowed: a finite number")),
        (format!("{one}1,-inf\n"), format!("2:2: {two}the cell is \"-inf\"; allowed: a finite number")),
        (format!("{one}1,1e999\n"), format!("2:2: {two}the cell is \"1e999\"; allowed: a finite number")),
        (
            format!("{one}1,12 N\n"),
            format!("2:2: {two}the cell is \"12 N\"; a unit in a cell; units belong in the header"),
        ),
        (
            format!("{one}1,-1.5%\n"),
            format!("2:2: {two}the cell is \"-1.5%\"; a unit in a cell; units belong in the header"),
        ),
        (
            "a (mm);b (N)\n1,5;2\n1;1.234\n".to_string(),
            format!("3:2: {two}the cell is \"1.234\"; allowed: a finite number with a decimal comma, as in the rest"),
        ),
    ];
    for (text, wanted) in cases {
        let message = rejected(&text);
        assert_eq!(message.trim_start_matches("data.csv:"), wanted.trim_start_matches("data.csv:"), "{text}");
        assert!(message.starts_with("data.csv:"), "{message}");
    }
}

#[test]
fn a_file_that_cannot_be_read_is_named() {
    let folder = std::env::temp_dir().join(format!("toron-data-table-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join("latin.csv");
    std::fs::write(&path, b"a (mm)\nb (\xb5m)\n").expect("a file");
    let latin = DataTable::read(&path).expect_err("no number").to_string();
    std::fs::write(&path, b"PK\x03\x04").expect("a file");
    let binary = DataTable::read(&path).expect_err("no text").to_string();
    let missing = DataTable::read(&folder.join("none.csv")).expect_err("there is none").to_string();
    std::fs::remove_dir_all(&folder).expect("the folder can go");
    assert!(latin.contains("latin.csv:2:1: column \"a\": the cell is \"b (µm)\""), "{latin}");
    assert!(
        binary.ends_with("latin.csv: a workbook of a spreadsheet; allowed: a CSV file in UTF-8, UTF-16 or Latin-1"),
        "{binary}"
    );
    assert!(missing.contains("none.csv: "), "{missing}");
}

proptest! {
    #[test]
    fn no_text_panics(any in "(?s).*", alike in "[a(N)\\[\\],;\"#0-9.eE\r\n \u{feff}µ-]{0,60}") {
        for text in [any.clone(), alike.clone(), format!("a (N);b (%)\n{alike}"), format!("a (N),b [%]\n{any}")] {
            if let Ok(table) = DataTable::parse("data.csv", &text) {
                prop_assert!(table.columns.iter().all(|column| !column.values.is_empty()));
            }
        }
    }
}
