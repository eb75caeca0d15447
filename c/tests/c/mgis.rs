//! libtoron_mgis as MGIS and MTest load it: `ffi-tests/mgis` does what they do, on the library as it is shipped.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::{CStr, c_char};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::ptr::{null, null_mut};
use std::sync::LazyLock;

use libloading::Library;

use crate::c_programs::CASES;
use crate::symbols::defined;
use toron::host::mgis::{BehaviourDataView, INTEGRATED, StateView};
use toron_test_support::library::{LIBRARY, OWN_LAW, ROOT, SYSTEM, folder, run};

/// A program of `ffi-tests/mgis`; libtoron gives it the tables.
fn compile(name: &str) -> PathBuf {
    let program = folder(&format!("mgis-{name}")).join("program");
    let mut gcc = Command::new("gcc");
    gcc.args(["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O1"]);
    gcc.arg(format!("-I{ROOT}/include")).arg(format!("{ROOT}/ffi-tests/mgis/{name}.c")).arg(LIBRARY.join("libtoron.a"));
    run(gcc.args(SYSTEM).arg("-o").arg(&program), "gcc");
    program
}

static LOADER: LazyLock<PathBuf> = LazyLock::new(|| compile("loader"));

fn shared() -> PathBuf {
    LIBRARY.join("libtoron_mgis.so")
}

/// Loads all behaviours as `host` does, without a symbol if one is named.
fn load(host: &str, without: Option<&str>) -> Output {
    Command::new(&*LOADER).arg(shared()).arg(host).args(without).output().expect("the loader runs")
}

/// The symbols that a host cannot do without.
fn required(host: &str) -> BTreeSet<String> {
    let output = load(host, None);
    assert!(output.status.success(), "{output:?}");
    String::from_utf8_lossy(&output.stdout).lines().map(Into::into).collect()
}

/// Loading fails as soon as one of the symbols is missing, and says which.
#[test]
fn every_symbol_is_required() {
    let (mgis, mtest) = (required("mgis"), required("mtest"));
    // Of each behaviour: 27, one of them for each of the three hypotheses, and the names of the properties; MTest asks
    // for 9 more.
    assert_eq!((mgis.len(), mtest.len()), (3 * (27 + 2 + 1), 3 * (27 + 2 + 10)));
    assert!(mtest.is_superset(&mgis));
    for (host, symbols) in [("mgis", &mgis), ("mtest", &mtest)] {
        for symbol in symbols {
            let output = load(host, Some(symbol));
            let message = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(1), "{host} without {symbol}: {message}");
            assert!(message.ends_with(&format!(": no symbol {symbol}\n")), "{host} without {symbol}: {message}");
        }
    }
}

/// A library of a law of one's own has what MGIS and MTest require of a behaviour, under the law's name, its names from
/// its table, and returns the law's stress.
#[test]
fn a_law_of_ones_own() {
    let path = OWN_LAW.join("libown_law_double.so");
    let exported = defined(&path, &["-D"]);
    for symbol in required("mtest").iter().filter_map(|symbol| symbol.strip_prefix("ToronHyperelastic_")) {
        assert!(exported.contains(&format!("REINFORCED_{symbol}")), "{symbol}");
    }
    // SAFETY: the library runs nothing when it is loaded.
    let library = unsafe { Library::new(path) }.expect("the library");
    let properties = ["mu", "lambda", "k", "stretch_lim", "m_1", "m_2", "m_3"];
    assert_eq!(names(&library, "REINFORCED", "MaterialProperties"), properties);
    assert_eq!(names(&library, "REINFORCED", "InternalStateVariables"), ["energy", "stretch", "failed", "alive"]);
    let (mu, lambda, k, stretch) = (0.8, 1.2, 20.0, 1.1_f64);
    for hypothesis in ["Tridimensional", "PlaneStrain", "Axisymmetrical"] {
        // SAFETY: the symbol is such a function.
        let function = *unsafe { library.get::<Integrate>(format!("REINFORCED_{hypothesis}").as_bytes()) }.expect("it");
        let f = [stretch, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let (stress, state) = integrate(function, &[mu, lambda, k, 0.0, 2.0, 0.0, 0.0], &f, 4);
        let (elongation, volume) = (stretch * stretch - 1.0, lambda * stretch.ln());
        let along = (mu * elongation + volume + 2.0 * k * elongation * stretch * stretch) / stretch;
        let wanted = [along, volume / stretch, volume / stretch, 0.0, 0.0, 0.0];
        for (found, wanted) in stress.into_iter().zip(wanted) {
            assert!((found - wanted).abs() <= 1e-14 * along, "{hypothesis}: {found}, not {wanted}");
        }
        assert_eq!(state[1..], [stretch, 0.0, 1.0], "{hypothesis}");
    }
}

/// The names of one of a behaviour's lists.
fn names(library: &Library, behaviour: &str, list: &str) -> Vec<String> {
    // SAFETY: the symbols have these types, and the names are C strings.
    unsafe {
        let count = library.get::<*const u16>(format!("{behaviour}_n{list}").as_bytes()).expect("a count");
        let texts = library.get::<*const *const c_char>(format!("{behaviour}_{list}").as_bytes()).expect("names");
        (0..usize::from(**count)).map(|i| CStr::from_ptr(*texts.add(i)).to_string_lossy().into_owned()).collect()
    }
}

/// What the library gives to the outside: what hosts require, the bounds, and two texts; and libtoron has nothing of
/// it.
#[test]
fn nothing_else_is_exported() {
    let exported = defined(&shared(), &["-D"]);
    let required = required("mtest");
    let optional = |symbol: &&String| {
        let bound = symbol.ends_with("Bound");
        !bound && !symbol.ends_with("_mfront_ept") && !symbol.ends_with("_src")
    };
    assert_eq!(exported.iter().filter(optional).cloned().collect::<BTreeSet<_>>(), required);
    let static_library = defined(&LIBRARY.join("libtoron.a"), &[]);
    assert!(static_library.len() > 100 && static_library.is_disjoint(&exported), "libtoron.a");
}

#[test]
fn points() {
    run(Command::new(compile("points")).arg(shared()).arg(&*CASES), "");
}

/// An `extern "C"` function of a behaviour.
type Integrate = unsafe extern "C" fn(*mut BehaviourDataView) -> i32;

/// One step from rest without a tangent: the Cauchy stress and the state.
fn integrate(function: Integrate, properties: &[f64], f: &[f64; 9], variables: usize) -> ([f64; 6], Vec<f64>) {
    let (rest, mut k, mut rdt) = ([1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0; 3], 1.0);
    let (mut old, mut new, mut stress, mut energy) = (vec![0.0; variables], vec![0.0; variables], [0.0; 6], 0.0);
    let s0 = StateView {
        gradients: rest.as_ptr(),
        thermodynamic_forces: stress.as_mut_ptr(),
        mass_density: null(),
        material_properties: properties.as_ptr(),
        internal_state_variables: old.as_mut_ptr(),
        stored_energy: &mut energy,
        dissipated_energy: null_mut(),
        external_state_variables: null(),
    };
    let s1 = StateView { gradients: f.as_ptr(), internal_state_variables: new.as_mut_ptr(), ..s0 };
    let (error_message, speed_of_sound) = (null_mut(), null_mut());
    let mut view =
        BehaviourDataView { error_message, dt: 1.0, k: k.as_mut_ptr(), rdt: &mut rdt, speed_of_sound, s0, s1 };
    // SAFETY: the arrays have the sizes that the symbols tell.
    assert_eq!(unsafe { function(&mut view) }, INTEGRATED);
    (stress, new)
}

/// The properties of a deck of MTest and its F at the end, given to the behaviour that it names, give what it says in
/// comments.
#[test]
fn the_deck_for_mtest_says_what_the_behaviour_returns() {
    let deck =
        std::fs::read_to_string(Path::new(ROOT).join("examples/one-element/mtest/yarn.mtest")).expect("the deck");
    let behaviour = deck.lines().find_map(|line| line.strip_prefix("@Behaviour<generic> 'libtoron_mgis.so' '"));
    let behaviour = behaviour.expect("a behaviour").trim_end_matches("';");
    let rows = |keyword: &str| -> BTreeMap<String, f64> {
        deck.lines().filter_map(|line| line.strip_prefix(keyword)).map(named).collect()
    };
    // SAFETY: the library runs nothing when it is loaded.
    let library = unsafe { Library::new(shared()) }.expect("the library");
    let names = |list| names(&library, behaviour, list);
    // SAFETY: the symbol is such a function.
    let function = *unsafe { library.get::<Integrate>(format!("{behaviour}_Tridimensional").as_bytes()) }.expect("it");
    let given = rows("@MaterialProperty<constant> ");
    let properties: Vec<f64> = names("MaterialProperties").iter().map(|name| given[name]).collect();
    assert_eq!(given.len(), properties.len());
    let gradients = rows("@ImposedDeformationGradient<evolution> ");
    let f = ["FXX", "FYY", "FZZ", "FXY", "FYX", "FXZ", "FZX", "FYZ", "FZY"].map(|name| gradients[name]);
    let variables = names("InternalStateVariables");
    let (stress, state) = integrate(function, &properties, &f, variables.len());
    let stresses = ["SXX", "SYY", "SZZ", "SXY", "SXZ", "SYZ"].map(String::from).into_iter().zip(stress);
    let found: BTreeMap<_, _> = stresses.chain(variables.into_iter().zip(state)).collect();
    let expected = rows("// at the end: ");
    assert!(expected.len() >= 6, "{expected:?}");
    for (name, wanted) in expected {
        assert!((found[&name] - wanted).abs() <= 1e-9 * wanted.abs(), "{name}: {}, not {wanted}", found[&name]);
    }
}

/// A quoted name, and the last number behind it.
fn named(text: &str) -> (String, f64) {
    let (_, text) = text.split_once('\'').expect("a quoted name");
    let (name, rest) = text.split_once('\'').expect("a quoted name");
    let number = |word: &str| word.parse().ok();
    let value = rest.split([' ', '{', '}', ':', ',', ';']).rev().find_map(number);
    (name.to_string(), value.unwrap_or_else(|| panic!("a number: {rest}")))
}
