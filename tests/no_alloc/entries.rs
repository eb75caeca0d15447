//! No C entry allocates, whether the call is right or wrong.

use std::ffi::{c_char, c_int};
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

use allocation_counter::measure;
use toron::host::abaqus::Vumat;
use toron::host::c::*;
use toron::host::{abaqus, c, calculix, lsdyna};

const P: usize = TORON_HYPERELASTIC_PROPERTIES;
const L: usize = TORON_LINEAR_ELASTIC_PROPERTIES;
const S: usize = TORON_HYPERELASTIC_STATE;

const REST: [f64; 9] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// A yarn; without a meaning for the exponent; no number at all.
const YARNS: [[f64; P]; 3] = [
    [82.341, 1.055, 2.2, 0.64974, 0.1, 0.0458, 1.8, 0.0, 1.0, 0.0, 0.0],
    [82.341, 1.055, 0.5, 0.64974, 0.1, 0.0458, 1.8, 0.0, 1.0, 0.0, 0.0],
    [f64::NAN; P],
];

/// The same for the linear elastic law, the second one with both axes along the fibre.
const LINEAR: [[f64; L]; 3] = [
    [79.414, 0.794, 0.126, 3.637, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [79.414, 0.794, 0.126, 3.637, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0],
    [f64::NAN; L],
];

/// Stretched; inverted; not finite.
fn deformations() -> [[f64; 9]; 3] {
    [1.02, -1.0, f64::NAN].map(|f11| {
        let mut f = REST;
        f[0] = f11;
        f
    })
}

/// Calls an entry, and counts.
macro_rules! quiet {
    ($entry:path, $($argument:expr),* $(,)?) => {{
        let mut result = None;
        // SAFETY: every array is as long as the entry says, or null.
        #[allow(unused_unsafe)]
        let count = measure(|| result = Some(unsafe { $entry($($argument),*) })).count_total;
        assert_eq!(count, 0, "{} allocates", stringify!($entry));
        result.expect("called")
    }};
}

/// The names of all entries, from their definitions.
fn entries() -> Vec<String> {
    let sources = [
        ("c", include_str!("../../src/host/c/about.rs")),
        ("c", include_str!("../../src/host/c/tables.rs")),
        ("c", include_str!("../../src/host/c/points.rs")),
        ("c", include_str!("../../src/host/c/tangents.rs")),
        ("c", include_str!("../../src/host/c/blocks.rs")),
        ("c", include_str!("../../src/host/c/linear_elastic.rs")),
        ("abaqus", include_str!("../../src/host/abaqus.rs")),
        ("calculix", include_str!("../../src/host/calculix.rs")),
        ("lsdyna", include_str!("../../src/host/lsdyna.rs")),
    ];
    let name = |definition: &str| definition.split('(').next().map(str::to_owned);
    let named = |(module, source): (&str, &'static str)| {
        let definitions = source.split("extern \"C\" fn ").skip(1).filter_map(name);
        definitions.map(|name| format!("{module}::{name}")).collect::<Vec<_>>()
    };
    sources.into_iter().flat_map(named).collect()
}

/// A new entry has to be added to the calls below.
#[test]
fn every_entry_is_called() {
    let separator = |c: char| !c.is_alphanumeric() && c != '_' && c != ':';
    let words: Vec<_> = include_str!("entries.rs").split(separator).collect();
    let entries = entries();
    assert!(entries.len() > 20, "{entries:?}");
    for entry in entries {
        assert!(words.contains(&entry.as_str()), "{entry} is not called");
    }
}

#[test]
fn the_count_counts() {
    assert_eq!(measure(|| drop(std::hint::black_box(vec![1]))).count_total, 1);
}

#[test]
fn the_library_about_itself() {
    let mut text = [0 as c_char; 200];
    let names: [*const c_char; 4] = [c"k_el".as_ptr(), c"alive".as_ptr(), c"nothing".as_ptr(), null()];
    assert_eq!(quiet!(c::abi_version,), TORON_ABI_VERSION);
    assert!(!quiet!(c::version,).is_null());
    for code in -400..10 {
        assert!(quiet!(c::status_message, code, text.as_mut_ptr(), text.len()) > 0);
        quiet!(c::status_message, code, null_mut(), 0);
    }
    for law in -1..3 {
        let (properties, state) = (quiet!(c::property_count, law), quiet!(c::state_count, law));
        assert_eq!(properties < 0, !(0..2).contains(&law));
        assert_eq!(state < 0, properties < 0);
        for index in -1..12 {
            let mut row = MaybeUninit::uninit();
            quiet!(c::property, law, index, row.as_mut_ptr());
            quiet!(c::property, law, index, null_mut());
            quiet!(c::state_variable, law, index, row.as_mut_ptr());
            quiet!(c::state_variable, law, index, null_mut());
        }
        for name in names {
            quiet!(c::property_index, law, name);
            quiet!(c::state_index, law, name);
        }
    }
}

/// The entries that there are in both precisions.
macro_rules! both_precisions {
    ($test:ident, $t:ty, $preset:path, $validate:path, $point:path, $point_tangent:path, $block:path,
     $block_tangent:path, $vumat:path, $umat:path, $utan:path, $vector:path, $vector_tangent:path) => {
        #[test]
        fn $test() {
            let (mut values, mut density) = ([0.0 as $t; P], 0.0 as $t);
            for preset in [c"kevlar-km2-600".as_ptr(), c"nylon".as_ptr(), null()] {
                for units in [c"mm-kg-ms".as_ptr(), c"furlong".as_ptr(), null()] {
                    quiet!($preset, preset, units, values.as_mut_ptr(), P, &mut density);
                    quiet!($preset, preset, units, null_mut(), 3, null_mut());
                }
            }
            let (mut text, mut code) = ([0 as c_char; 200], 0);
            for yarn in YARNS.map(|yarn| yarn.map(|x| x as $t)) {
                let (yarn, message) = (yarn.as_ptr(), text.as_mut_ptr());
                quiet!($validate, yarn, P, message, 200, &mut code);
                quiet!($validate, yarn, 3, message, 200, &mut code);
                quiet!($validate, null(), P, null_mut(), 0, null_mut());
                for f in deformations().map(|f| f.map(|x| x as $t)) {
                    let (old, mut new, mut stress) = ([0.0 as $t; S], [0.0 as $t; S], [0.0 as $t; 6]);
                    let (mut modes, mut speed) = ([0.0 as $t; 24], 0.0 as $t);
                    let (s, m, fibre) = (stress.as_mut_ptr(), modes.as_mut_ptr(), [0.0 as $t, 1.0, 0.0]);
                    let (old, n, direction) = (old.as_ptr(), new.as_mut_ptr(), fibre.as_ptr());
                    quiet!($point, yarn, P, f.as_ptr(), direction, old, n, s, m, 1.0, &mut speed);
                    quiet!($point, yarn, P, null(), null(), null(), null_mut(), s, m, -1.0, &mut speed);
                    let mut tangent = [0.0 as $t; 81];
                    let c = tangent.as_mut_ptr();
                    for measure in -1..4 {
                        quiet!($point_tangent, yarn, P, f.as_ptr(), direction, old, n, s, measure, c);
                        quiet!($point_tangent, yarn, P, null(), null(), old, n, s, measure, null_mut());
                    }
                    let mut active = 0.0;
                    let block = Block {
                        n: 1,
                        leading_dimension: 1,
                        deformation_gradient: f.as_ptr(),
                        fibre: direction,
                        energies_old: null(),
                        invariants_old: null(),
                        failure_old: null(),
                        density: 1.0,
                        stress: s,
                        energies: null_mut(),
                        invariants: null_mut(),
                        failure: null_mut(),
                        modes: m,
                        wave_speed: &mut speed,
                        status: &mut code,
                        active: &mut active,
                        level: TORON_LEVEL_BEST,
                    };
                    quiet!($block, yarn, P, &block);
                    quiet!($block, yarn, P, &Block { level: 9, ..block });
                    quiet!($block, yarn, P, &Block { leading_dimension: 0, ..block });
                    quiet!($block, yarn, P, null());
                    for measure in -1..4 {
                        quiet!($block_tangent, yarn, P, &block, measure, c);
                    }
                    quiet!($block_tangent, yarn, P, null(), 0, null_mut());

                    let stretch = [f[0], f[4], f[8], 0.0, 0.0, 0.0];
                    let (zero, unit) = ([0.0 as $t; S], [1.0 as $t]);
                    let (mut energy, mut inelastic) = (0.0 as $t, 0.0 as $t);
                    let job = Vumat {
                        nblock: 1,
                        ndir: 3,
                        nshr: 3,
                        nstatev: S as i32,
                        nprops: P as i32,
                        step_time: 1.0,
                        total_time: 1.0,
                        props: yarn,
                        density: unit.as_ptr(),
                        strain_inc: zero.as_ptr(),
                        stretch_old: stretch.as_ptr(),
                        stretch_new: stretch.as_ptr(),
                        stress_old: zero.as_ptr(),
                        state_old: zero.as_ptr(),
                        ener_intern_old: zero.as_ptr(),
                        ener_inelas_old: zero.as_ptr(),
                        stress_new: s,
                        state_new: n,
                        ener_intern_new: &mut energy,
                        ener_inelas_new: &mut inelastic,
                    };
                    quiet!($vumat, &job);
                    quiet!($vumat, &Vumat { step_time: 0.0, total_time: 0.0, ..job });
                    quiet!($vumat, &Vumat { nshr: 1, ..job });
                    quiet!($vumat, null());

                    let mut history = [0.0 as $t; S + 9];
                    history[S..].copy_from_slice(&f);
                    let (h, mut failed) = (history.as_mut_ptr(), 0 as c_int);
                    quiet!($umat, yarn, s, h, S as i32, &mut failed);
                    quiet!($umat, yarn, s, h, 3, null_mut());
                    let [s1, s2, s3, s4, s5, s6] = [0, 1, 2, 3, 4, 5].map(|c| s.wrapping_add(c));
                    quiet!($vector, yarn, s1, s2, s3, s4, s5, s6, h, S as i32, 1, 1, 1, &mut failed);
                    quiet!($vector, yarn, s1, s2, s3, s4, s5, s6, h, S as i32, 0, 1, 1, &mut failed);
                    quiet!($utan, yarn, h, S as i32, c);
                    quiet!($utan, yarn, null(), 3, c);
                    quiet!($vector_tangent, yarn, h, S as i32, 1, 1, 1, c);
                    quiet!($vector_tangent, yarn, h, S as i32, 0, 1, 1, null_mut());
                }
            }
        }
    };
}

both_precisions!(
    double_precision,
    f64,
    c::preset_f64,
    c::hyperelastic_validate_f64,
    c::hyperelastic_point_f64,
    c::hyperelastic_point_tangent_f64,
    c::hyperelastic_block_f64,
    c::hyperelastic_block_tangent_f64,
    abaqus::vumat_f64,
    lsdyna::umat_f64,
    lsdyna::utan_f64,
    lsdyna::umat_vector_f64,
    lsdyna::utan_vector_f64
);
both_precisions!(
    single_precision,
    f32,
    c::preset_f32,
    c::hyperelastic_validate_f32,
    c::hyperelastic_point_f32,
    c::hyperelastic_point_tangent_f32,
    c::hyperelastic_block_f32,
    c::hyperelastic_block_tangent_f32,
    abaqus::vumat_f32,
    lsdyna::umat_f32,
    lsdyna::utan_f32,
    lsdyna::umat_vector_f32,
    lsdyna::utan_vector_f32
);

#[test]
fn double_precision_only() {
    let (mut bulk, mut shear) = (0.0, 0.0);
    for yarn in &YARNS {
        let yarn = yarn.as_ptr();
        quiet!(lsdyna::bulk_and_shear_f64, yarn, P, &mut bulk, &mut shear);
        quiet!(lsdyna::bulk_and_shear_f64, yarn, 3, &mut bulk, null_mut());
        for f in deformations() {
            let (mut stress, mut state, mut energy, mut step) = ([0.0; 6], [0.0; S], 0.0, 1.0);
            let (s, h) = (stress.as_mut_ptr(), state.as_mut_ptr());
            for count in [P as i32, -1] {
                let (f, n) = (f.as_ptr(), S as i32);
                quiet!(abaqus::umat_f64, s, h, &mut energy, &mut step, f, yarn, count, n, 3, 3, 1);
                let mut c = [0.0; 36];
                let (c, e) = (c.as_mut_ptr(), &mut energy);
                quiet!(abaqus::umat_tangent_f64, s, h, c, e, &mut step, f, yarn, count, n, 3, 3, 1);
                quiet!(abaqus::umat_tangent_f64, s, h, c, e, &mut step, f, yarn, count, n, 3, 1, 1);
            }
            let (mut least, mut direction) = (0.0, [0.0; 3]);
            let (w, n) = (&mut least, direction.as_mut_ptr());
            quiet!(c::hyperelastic_least_acoustic_eigenvalue_f64, yarn, P, f.as_ptr(), null(), w, n);
            quiet!(c::hyperelastic_least_acoustic_eigenvalue_f64, yarn, P, null(), null(), w, n);
            let (f, n) = (REST.as_ptr(), S as i32);
            quiet!(abaqus::umat_f64, s, h, &mut energy, &mut step, f, yarn, P as i32, n, 3, 3, 0);
            quiet!(abaqus::umat_f64, s, null_mut(), &mut energy, &mut step, f, yarn, P as i32, n, 3, 3, 1);
        }
    }
}

/// Right decks only: a wrong one ends the process.
#[test]
fn calculix() {
    let yarn = YARNS[0].as_ptr();
    // A strain that is not the linear one of any F below.
    let (strain, zeros) = ([1e3; 6], [0.0; S]);
    let (e, z, one, no, constants, n) = (strain.as_ptr(), zeros.as_ptr(), &1, &0, &(-100 - P as i32), &(S as i32));
    for f in deformations() {
        let (mut stress, mut stiff, mut state, mut step) = ([0.0; 6], [0.0; 21], [0.0; S], -1.0);
        let (s, c, h, f) = (stress.as_mut_ptr(), stiff.as_mut_ptr(), state.as_mut_ptr(), f.as_ptr());
        let name = [b' ' as c_char; 80];
        quiet!(
            calculix::hyperelastic,
            name.as_ptr(),
            one,
            one,
            constants,
            yarn,
            e,
            z,
            z,
            f,
            z,
            f,
            z,
            no,
            z,
            z,
            z,
            z,
            no,
            no,
            one,
            n,
            z,
            h,
            s,
            c,
            no,
            z,
            z,
            &mut step,
            no,
            80,
        );
        assert!(stress.iter().chain(&stiff).chain(&state).all(|x| x.is_finite()));
    }
}

#[test]
fn linear_elastic() {
    let (mut text, mut code) = ([0 as c_char; 200], 0);
    for yarn in &LINEAR {
        let (yarn_f32, yarn) = (yarn.map(|x| x as f32), yarn.as_ptr());
        let (mut axes, mut state, mut stress) = (REST, [0.0; TORON_LINEAR_ELASTIC_STATE], [0.0; 6]);
        let (a, h, s) = (axes.as_mut_ptr(), state.as_mut_ptr(), stress.as_mut_ptr());
        quiet!(c::linear_elastic_validate_f64, yarn, L, text.as_mut_ptr(), 200, &mut code);
        quiet!(c::linear_elastic_validate_f64, yarn, 3, null_mut(), 0, null_mut());
        quiet!(c::linear_elastic_axes_f64, yarn, L, a);
        quiet!(c::linear_elastic_axes_f64, yarn, L, null_mut());
        for f in deformations() {
            for rotation in -1..4 {
                quiet!(c::linear_elastic_step_f64, yarn, L, REST.as_ptr(), f.as_ptr(), null(), h, s, rotation, 0, a);
                quiet!(c::linear_elastic_step_f64, yarn, L, null(), f.as_ptr(), null(), h, s, rotation, 1, a);
                let mut tangent = [0.0; 81];
                let (c, r, f) = (tangent.as_mut_ptr(), REST.as_ptr(), f.as_ptr());
                for measure in -1..4 {
                    quiet!(c::linear_elastic_step_tangent_f64, yarn, L, r, f, null(), h, s, rotation, 0, a, measure, c);
                }
            }
            let narrow = (yarn_f32.as_ptr(), f.map(|x| x as f32), REST.map(|x| x as f32));
            let (mut axes_f32, mut state_f32, mut stress_f32) = (narrow.2, [0.0; TORON_LINEAR_ELASTIC_STATE], [0.0; 6]);
            let block = LinearBlock {
                n: 1,
                leading_dimension: 1,
                f_old: REST.as_ptr(),
                f_new: f.as_ptr(),
                axes: a,
                state_old: null(),
                state_new: h,
                stress: s,
                status: &mut code,
                level: TORON_LEVEL_BEST,
            };
            let block_f32 = LinearBlock {
                n: 1,
                leading_dimension: 1,
                f_old: narrow.2.as_ptr(),
                f_new: narrow.1.as_ptr(),
                axes: axes_f32.as_mut_ptr(),
                state_old: null(),
                state_new: state_f32.as_mut_ptr(),
                stress: stress_f32.as_mut_ptr(),
                status: &mut code,
                level: TORON_LEVEL_BEST,
            };
            for rotation in -1..4 {
                for criterion in -1..3 {
                    quiet!(c::linear_elastic_block_f64, yarn, L, &block, rotation, criterion);
                    quiet!(c::linear_elastic_block_f32, narrow.0, L, &block_f32, rotation, criterion);
                }
                quiet!(
                    c::linear_elastic_block_f64,
                    yarn,
                    L,
                    &LinearBlock { leading_dimension: 0, ..block },
                    rotation,
                    0
                );
            }
            quiet!(c::linear_elastic_block_f64, yarn, L, null(), 0, 0);
            quiet!(c::linear_elastic_block_f32, narrow.0, 3, null(), 0, 0);
            for criterion in -1..3 {
                quiet!(c::linear_elastic_increment_f64, yarn, L, f.as_ptr(), 1.0, null(), h, s, criterion);
                quiet!(c::linear_elastic_increment_f64, yarn, L, null(), 1.0, null(), h, s, criterion);
            }
        }
    }
}
