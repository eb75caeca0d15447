//! The committed C header is what cbindgen makes of the source today. `cargo xtask update headers` writes it anew.

use std::path::Path;

use toron_test_support::library::ROOT;
use toron_test_support::update::is_asked;

use toron::law::status;

/// Constants and structures, then what is exported.
const SOURCES: [&str; 17] = [
    "src/law/status.rs",
    "c/functions/src/constants.rs",
    "src/host/constants.rs",
    "src/host/tables.rs",
    "src/host/arguments.rs",
    "c/functions/src/prepared.rs",
    "src/host/point_and_block.rs",
    "src/host/linear_elastic.rs",
    "src/host/abaqus/vumat.rs",
    "c/functions/src/about.rs",
    "c/functions/src/tables.rs",
    "c/functions/src/hyperelastic.rs",
    "c/functions/src/frictional.rs",
    "c/functions/src/linear_elastic.rs",
    "c/functions/src/abaqus.rs",
    "c/functions/src/lsdyna.rs",
    "c/functions/src/openradioss.rs",
];

fn generated() -> String {
    let root = Path::new(ROOT);
    let mut config = cbindgen::Config::from_file(root.join("cbindgen.toml")).expect("cbindgen.toml");
    for (_, name, _) in status::TABLE {
        let name = name.to_uppercase();
        config.export.rename.insert(name.clone(), format!("TORON_{name}"));
    }
    let mut builder = cbindgen::Builder::new().with_config(config);
    for source in SOURCES {
        builder = builder.with_src(root.join(source));
    }
    let mut header = Vec::new();
    builder.generate().expect("a header").write(&mut header);
    String::from_utf8(header).expect("UTF-8")
}

#[test]
fn the_committed_header_is_current() {
    let path = Path::new(ROOT).join("include/toron.h");
    let generated = generated();
    if is_asked("headers") {
        std::fs::write(&path, &generated).expect("include/toron.h is writable");
    }
    let committed = std::fs::read_to_string(&path).expect("include/toron.h");
    assert!(committed == generated, "include/toron.h is not current: cargo xtask update headers");
}

#[test]
fn every_status_code_is_in_the_header() {
    let header = generated();
    for (code, name, _) in status::TABLE {
        let line = format!("#define TORON_{} {code}\n", name.to_uppercase());
        assert!(header.contains(&line), "{line}");
    }
}
