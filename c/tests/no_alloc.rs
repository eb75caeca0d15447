//! No C entry allocates, whether the call is right or wrong: a binary of its own, since it counts in the allocator.

use std::ffi::{c_char, c_int};
use std::ptr::{null, null_mut};

use allocation_counter::measure;
use toron::host::abaqus::{ExplicitLaw, StandardLaw, Vumat};
use toron::host::calculix::{Behaviour, CalculixLaw};
use toron::host::lsdyna::{Umat, UmatVector, UserRoutines, Utan, UtanVector, When};
use toron::host::mgis::{BehaviourDataView, MgisLaw, StateView};
use toron::host::openradioss::{Group, ListingLine, MaterialCard};
use toron::host::{abaqus, calculix, mgis, openradioss};
use toron::law::block::Circumstances;
use toron::{Hyperelastic, LinearElastic};
use toron_c::*;

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

/// The same for the law with friction, the second one without a meaning for µ.
const FRICTIONAL: [[f64; TORON_FRICTIONAL_PROPERTIES]; 3] = [
    [82.341, 1.055, 2.2, 0.64974, 0.1, 0.0458, 1.8, 0.0, 1.0, 0.0, 0.0, 0.25, 0.0],
    [82.341, 1.055, 2.2, 0.64974, 0.1, 0.0458, 1.8, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0],
    [f64::NAN; TORON_FRICTIONAL_PROPERTIES],
];

/// The same for a law of one's own, the second one without a shear modulus.
const REINFORCED: [[f64; 7]; 3] = [[0.8, 1.2, 20.0, 0.0, 1.0, 0.0, 0.0], [0.0; 7], [f64::NAN; 7]];

type OwnLaw = toron::law::user::User<reinforced_solid::ReinforcedSolid, f64>;

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
    ($entry:expr, $($argument:expr),* $(,)?) => {{
        let mut result = None;
        // SAFETY: every array is as long as the entry says, or null.
        #[allow(unused_unsafe)]
        let count = measure(|| result = Some(unsafe { $entry($($argument),*) })).count_total;
        assert_eq!(count, 0, "{} allocates", stringify!($entry));
        result.expect("called")
    }};
}

/// The names of the functions that a source defines, each behind one of these words.
fn defined<'a>(source: &'a str, words: &'a str) -> impl Iterator<Item = &'a str> {
    source.split(words).skip(1).filter_map(|text| text.split_once("fn ")?.1.split(['(', '<']).next())
}

/// The names of all entries: of C functions that compute themselves, of the routines of hosts that others call.
fn entries() -> Vec<String> {
    let functions = [
        include_str!("../functions/src/about.rs"),
        include_str!("../functions/src/tables.rs"),
        include_str!("../functions/src/hyperelastic.rs"),
        include_str!("../functions/src/linear_elastic.rs"),
        include_str!("../functions/src/frictional.rs"),
    ];
    let functions = functions.into_iter().flat_map(|source| defined(source, "#[unsafe(no_mangle)]").map(str::to_owned));
    let hosts = [
        ("calculix", include_str!("../../src/host/calculix.rs")),
        ("mgis", include_str!("../../src/host/mgis/hyperelastic.rs")),
        ("mgis", include_str!("../../src/host/mgis/step.rs")),
    ];
    let hosts = hosts
        .into_iter()
        .flat_map(|(host, source)| defined(source, "\npub unsafe ").map(move |name| format!("{host}::{name}")));
    let groups = include_str!("../functions/src/openradioss.rs").split("unsafe { ").skip(1);
    let groups = groups.filter_map(|call| Some(format!("openradioss::{}", call.split_once('(')?.0)));
    // These have a name for each law, which is called by the law's type.
    let traits = [
        ("StandardLaw", include_str!("../../src/host/abaqus/umat.rs")),
        ("ExplicitLaw", include_str!("../../src/host/abaqus/vumat.rs")),
        ("UserRoutines", include_str!("../../src/host/lsdyna/mod.rs")),
    ];
    let methods = traits.into_iter().flat_map(|(name, source)| {
        let body = source.split_once(&format!("pub trait {name}")).and_then(|(_, rest)| rest.split_once("\n}"));
        defined(body.expect("a trait").0, "    unsafe ").map(|name| format!("::{name}"))
    });
    functions.chain(hosts).chain(groups).chain(methods).collect()
}

/// A new entry has to be added to the calls below.
#[test]
fn every_entry_is_called() {
    let separator = |c: char| !c.is_alphanumeric() && c != '_' && c != ':';
    let words: Vec<&str> = include_str!("no_alloc.rs").split(separator).collect();
    let entries = entries();
    assert!(entries.len() > 20, "{entries:?}");
    for entry in entries {
        let is_it = |word: &&str| if entry.starts_with("::") { word.ends_with(&entry) } else { **word == entry };
        assert!(words.iter().any(is_it), "{entry} is not called");
    }
}

#[test]
fn the_count_counts() {
    assert_eq!(measure(|| drop(std::hint::black_box(vec![1]))).count_total, 1);
}

/// Room for a message.
const ROOM: usize = TORON_MESSAGE_CAPACITY;

#[test]
fn the_library_about_itself() {
    let mut text = [0 as c_char; ROOM];
    let t = text.as_mut_ptr();
    let names: [*const c_char; 4] = [c"k_el".as_ptr(), c"alive".as_ptr(), c"nothing".as_ptr(), null()];
    assert_eq!(quiet!(toron_abi_version,), TORON_ABI_VERSION);
    assert!(!quiet!(toron_version,).is_null());
    for code in -400..10 {
        quiet!(toron_status_message, code, t, ROOM);
        quiet!(toron_status_message, code, null_mut(), 0);
    }
    for law in -1..4 {
        let properties = quiet!(toron_property_count, law, t, ROOM);
        let state = quiet!(toron_state_count, law, null_mut(), 0);
        assert_eq!(properties < 0, !(0..3).contains(&law));
        assert_eq!(state < 0, properties < 0);
        for index in -1..16 {
            // SAFETY: numbers, which may be 0.
            let mut row = unsafe { std::mem::zeroed::<TableRow>() };
            quiet!(toron_property, law, index, &mut row, t, ROOM);
            row.size = size_of::<TableRow>();
            quiet!(toron_property, law, index, &mut row, t, ROOM);
            quiet!(toron_property, law, index, null_mut(), t, ROOM);
            quiet!(toron_state_variable, law, index, &mut row, t, ROOM);
            quiet!(toron_state_variable, law, index, null_mut(), null_mut(), 0);
        }
        for name in names {
            quiet!(toron_property_index, law, name, t, ROOM);
            quiet!(toron_state_index, law, name, t, ROOM);
        }
    }
}

/// The entries that there are in both precisions.
macro_rules! both_precisions {
    ($test:ident, $t:ty, $preset:path, $prepare:path, $point:path, $point_with_properties:path, $block:path,
     $block_with_properties:path) => {
        #[test]
        fn $test() {
            let mut text = [0 as c_char; ROOM];
            let t = text.as_mut_ptr();
            let (mut values, mut density) = ([0.0 as $t; P], 0.0 as $t);
            for preset in [c"kevlar-km2-600".as_ptr(), c"nylon".as_ptr(), null()] {
                for units in [c"mm-kg-ms".as_ptr(), c"furlong".as_ptr(), null()] {
                    quiet!($preset, preset, units, values.as_mut_ptr(), P, &mut density, t, ROOM);
                    quiet!($preset, preset, units, null_mut(), 3, null_mut(), null_mut(), 0);
                }
            }
            let mut code = 0;
            for yarn in YARNS.map(|yarn| yarn.map(|x| x as $t)) {
                let yarn = yarn.as_ptr();
                // SAFETY: numbers, which may be 0.
                let mut law = unsafe { std::mem::zeroed::<HyperelasticLaw<$t>>() };
                // Not prepared at first, and if a property is wrong.
                quiet!($prepare, &mut law, size_of_val(&law), yarn, 3, t, ROOM);
                quiet!($prepare, &mut law, 8, yarn, P, t, ROOM);
                quiet!($prepare, null_mut(), 8, null(), P, null_mut(), 0);
                quiet!($prepare, &mut law, size_of_val(&law), yarn, P, t, ROOM);
                for f in deformations().map(|f| f.map(|x| x as $t)) {
                    let (old, mut new, mut stress) = ([0.0 as $t; S], [0.0 as $t; S], [0.0 as $t; 6]);
                    let (mut modes, mut speed) = ([0.0 as $t; 24], 0.0 as $t);
                    let (s, m, fibre) = (stress.as_mut_ptr(), modes.as_mut_ptr(), [0.0 as $t, 1.0, 0.0]);
                    let (old, n, direction) = (old.as_ptr(), new.as_mut_ptr(), fibre.as_ptr());
                    let mut tangent = [0.0 as $t; 81];
                    let c = tangent.as_mut_ptr();
                    let simple = Point {
                        deformation_gradient: f.as_ptr(),
                        state_old: old,
                        state_new: n,
                        stress: s,
                        ..Point::empty()
                    };
                    let full = Point { fibre: direction, modes: m, wave_speed: &mut speed, density: 1.0, ..simple };
                    let points = [
                        simple,
                        full,
                        Point { density: -1.0, ..full },
                        Point { deformation_gradient: null(), ..full },
                        Point { size: 0, ..full },
                        Point { size: 40, ..full },
                        Point { level: 9, ..full },
                        Point { level: TORON_LEVEL_BASELINE, ..full },
                    ];
                    let tangents = (-1..5).map(|measure| Point { measure, tangent: c, ..full });
                    for point in points.into_iter().chain(tangents) {
                        quiet!($point, &law, &point, t, ROOM);
                        quiet!($point, null(), &point, null_mut(), 0);
                        quiet!($point_with_properties, yarn, P, &point, t, ROOM);
                        quiet!($point_with_properties, yarn, 3, &point, t, ROOM);
                    }
                    quiet!($point, &law, null(), t, ROOM);
                    quiet!($point_with_properties, null(), P, null(), t, ROOM);
                    let mut active = 0.0;
                    let mut block = Block {
                        n: 1,
                        density: 1.0,
                        modes: m,
                        wave_speed: &mut speed,
                        status: &mut code,
                        active: &mut active,
                        ..Block::empty()
                    };
                    block.deformation_gradient[0] = f.as_ptr();
                    block.fibre[0] = direction;
                    block.stress[0] = s;
                    let stride = |stride| Layout { leading_dimension: 1, stride };
                    let mut components = block;
                    components.stress[2] = s;
                    let blocks = [
                        block,
                        components,
                        Block { level: 9, ..block },
                        Block { size: 0, ..block },
                        Block { size: 16, ..block },
                        Block { n: 2, leading_dimension: 1, ..block },
                        Block { deformation_gradient_layout: stride(9), stress_layout: stride(6), ..block },
                        Block { modes_layout: stride(24), ..block },
                    ];
                    let tangents = (-1..5).map(|measure| Block { measure, tangent: c, ..block });
                    for block in blocks.into_iter().chain(tangents) {
                        quiet!($block, &law, &block, t, ROOM);
                        quiet!($block, null(), &block, null_mut(), 0);
                        quiet!($block_with_properties, yarn, P, &block, t, ROOM);
                        quiet!($block_with_properties, yarn, 3, &block, t, ROOM);
                    }
                    quiet!($block, &law, null(), t, ROOM);
                    quiet!($block_with_properties, null(), P, null(), t, ROOM);

                    let stretch = [f[0], f[4], f[8], 0.0, 0.0, 0.0];
                    let (zero, unit) = ([0.0 as $t; S], [1.0 as $t]);
                    let (mut energy, mut inelastic) = (0.0 as $t, 0.0 as $t);
                    let job = Vumat {
                        size: size_of::<Vumat<$t>>(),
                        level: TORON_LEVEL_BEST,
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
                    for job in [
                        job,
                        Vumat { step_time: 0.0, total_time: 0.0, ..job },
                        Vumat { nshr: 1, ..job },
                        Vumat { size: 0, ..job },
                    ] {
                        quiet!(<Hyperelastic<$t> as ExplicitLaw<$t>>::vumat, &job, t, ROOM);
                        let unknown = Circumstances::<$t>::UNKNOWN;
                        quiet!(<Hyperelastic<$t> as ExplicitLaw<$t>>::vumat_at, &job, unknown, t, ROOM);
                    }
                    quiet!(<Hyperelastic<$t> as ExplicitLaw<$t>>::vumat, null(), null_mut(), 0);

                    let mut history = [0.0 as $t; S + 9];
                    history[S..].copy_from_slice(&f);
                    let (h, mut failed, i) = (history.as_mut_ptr(), 0 as c_int, S as i32);
                    quiet!(
                        <Hyperelastic<$t> as UserRoutines<$t>>::umat,
                        &Umat { cm: yarn, sig: s, hsv: h, nhv: i, failel: &mut failed },
                        t,
                        ROOM
                    );
                    quiet!(
                        <Hyperelastic<$t> as UserRoutines<$t>>::umat,
                        &Umat { cm: yarn, sig: s, hsv: h, nhv: 3, failel: null_mut() },
                        null_mut(),
                        0
                    );
                    let sig = [0, 1, 2, 3, 4, 5].map(|c| s.wrapping_add(c));
                    for lft in [1, 0] {
                        let failels = &raw mut failed;
                        let elements = UmatVector { cm: yarn, sig, hsvs: h, nhv: i, lft, llt: 1, nlq: 1, failels };
                        quiet!(<Hyperelastic<$t> as UserRoutines<$t>>::umat_vector, &elements, t, ROOM);
                    }
                    quiet!(
                        <Hyperelastic<$t> as UserRoutines<$t>>::utan,
                        &Utan { cm: yarn, hsv: h, nhv: i, es: c },
                        t,
                        ROOM
                    );
                    quiet!(
                        <Hyperelastic<$t> as UserRoutines<$t>>::utan,
                        &Utan { cm: yarn, hsv: null(), nhv: 3, es: c },
                        null_mut(),
                        0
                    );
                    let elements = UtanVector { cm: yarn, hsvs: h, nhv: i, lft: 1, llt: 1, nlq: 1, dsave: c };
                    quiet!(<Hyperelastic<$t> as UserRoutines<$t>>::utan_vector, &elements, t, ROOM);
                    let elements = UtanVector { lft: 0, dsave: null_mut(), ..elements };
                    quiet!(<Hyperelastic<$t> as UserRoutines<$t>>::utan_vector, &elements, null_mut(), 0);
                }
            }
        }
    };
}

both_precisions!(
    double_precision,
    f64,
    toron_preset_f64,
    toron_hyperelastic_prepare_f64,
    toron_hyperelastic_point_f64,
    toron_hyperelastic_point_with_properties_f64,
    toron_hyperelastic_block_f64,
    toron_hyperelastic_block_with_properties_f64
);
both_precisions!(
    single_precision,
    f32,
    toron_preset_f32,
    toron_hyperelastic_prepare_f32,
    toron_hyperelastic_point_f32,
    toron_hyperelastic_point_with_properties_f32,
    toron_hyperelastic_block_f32,
    toron_hyperelastic_block_with_properties_f32
);

#[test]
fn double_precision_only() {
    let (mut bulk, mut shear, mut text) = (0.0, 0.0, [0 as c_char; ROOM]);
    let t = text.as_mut_ptr();
    for yarn in &YARNS {
        let yarn = yarn.as_ptr();
        quiet!(Hyperelastic::card_moduli, yarn, P, &mut bulk, &mut shear, t, ROOM);
        quiet!(Hyperelastic::card_moduli, yarn, 3, &mut bulk, null_mut(), null_mut(), 0);
        // SAFETY: numbers, which may be 0.
        let mut law = unsafe { std::mem::zeroed::<HyperelasticLaw<f64>>() };
        quiet!(toron_hyperelastic_prepare_f64, &mut law, size_of_val(&law), yarn, P, t, ROOM);
        for f in deformations() {
            let (mut stress, mut state, mut energy, mut step) = ([0.0; 6], [0.0; S], 0.0, 1.0);
            let (s, h) = (stress.as_mut_ptr(), state.as_mut_ptr());
            let mut c = [0.0; 36];
            let call = abaqus::Umat {
                stress: s,
                statev: h,
                ddsdde: null_mut(),
                sse: &mut energy,
                pnewdt: &mut step,
                dfgrd0: null(),
                dfgrd1: f.as_ptr(),
                props: yarn,
                nprops: P as i32,
                nstatv: S as i32,
                ndi: 3,
                nshr: 3,
                nlgeom: 1,
                circumstances: Circumstances::UNKNOWN,
            };
            let tangent = abaqus::Umat { ddsdde: c.as_mut_ptr(), ..call };
            for call in [call, tangent, abaqus::Umat { nshr: 1, ..tangent }] {
                for call in [call, abaqus::Umat { nprops: -1, ..call }, abaqus::Umat { nlgeom: 0, ..call }] {
                    quiet!(<Hyperelastic as StandardLaw>::umat, &call, t, ROOM);
                }
            }
            let call = abaqus::Umat { statev: null_mut(), ..call };
            quiet!(<Hyperelastic as StandardLaw>::umat, &call, null_mut(), 0);
            let (mut least, mut direction) = (0.0, [0.0; 3]);
            let (w, n, nothing) = (&mut least, direction.as_mut_ptr(), null_mut());
            let point = Point { deformation_gradient: f.as_ptr(), ..Point::empty() };
            quiet!(toron_hyperelastic_least_acoustic_eigenvalue_f64, &law, &point, w, n, t, ROOM);
            quiet!(toron_hyperelastic_least_acoustic_eigenvalue_f64, &law, null(), w, n, t, ROOM);
            quiet!(toron_hyperelastic_least_acoustic_eigenvalue_f64, null(), &point, nothing, n, t, ROOM);
        }
    }
}

/// Right decks only: a wrong one ends the process.
#[test]
fn calculix() {
    // A strain that is not the linear one of any F below.
    let (strain, zeros, name) = ([1e3; 6], [0.0; 19], [b' ' as c_char; 80]);
    for f in deformations() {
        let (mut stress, mut stiff, mut state, mut step) = ([0.0; 6], [0.0; 21], [0.0; 19], -1.0);
        let call = Behaviour {
            amat: name.as_ptr(),
            iel: &1,
            iint: &1,
            kode: &(-100 - P as i32),
            elconloc: YARNS[0].as_ptr(),
            emec: strain.as_ptr(),
            beta: zeros.as_ptr(),
            xkl: f.as_ptr(),
            mi: &1,
            nstate_: &19,
            xstateini: zeros.as_ptr(),
            xstate: state.as_mut_ptr(),
            stre: stress.as_mut_ptr(),
            stiff: stiff.as_mut_ptr(),
            iorien: &0,
            pgauss: zeros.as_ptr(),
            orab: zeros.as_ptr(),
            pnewdt: &mut step,
            circumstances: Circumstances::UNKNOWN,
        };
        quiet!(calculix::hyperelastic, &call);
        assert!(stress.iter().chain(&stiff).chain(&state).all(|x| x.is_finite()));
        quiet!(calculix::linear_elastic, &Behaviour { kode: &(-100 - L as i32), elconloc: LINEAR[0].as_ptr(), ..call });
        assert!(stress.iter().chain(&stiff).chain(&state).all(|x| x.is_finite()));
        quiet!(OwnLaw::behaviour, &Behaviour { kode: &-107, elconloc: REINFORCED[0].as_ptr(), ..call });
        assert!(stress.iter().chain(&stiff).chain(&state).all(|x| x.is_finite()));
    }
}

/// The linear elastic law in Abaqus and LS-DYNA.
macro_rules! linear_hosts {
    ($test:ident, $t:ty) => {
        #[test]
        fn $test() {
            let mut text = [0 as c_char; ROOM];
            let (t, unit, zero) = (text.as_mut_ptr(), [1.0 as $t], [0.0 as $t; S]);
            for (yarn, f) in LINEAR.into_iter().flat_map(|yarn| deformations().map(|f| (yarn, f))) {
                let (yarn, f) = (yarn.map(|x| x as $t), f.map(|x| x as $t));
                let (yarn, stretch) = (yarn.as_ptr(), [f[0], f[4], f[8], 0.0, 0.0, 0.0]);
                let (mut stress, mut state, mut tangent) = ([0.0 as $t; 6], [0.0 as $t; S], [0.0 as $t; 36]);
                let (mut energy, mut inelastic) = (0.0 as $t, 0.0 as $t);
                let (s, c) = (stress.as_mut_ptr(), tangent.as_mut_ptr());
                let job = Vumat {
                    nblock: 1,
                    ndir: 3,
                    nshr: 3,
                    nstatev: S as i32,
                    nprops: L as i32,
                    step_time: 1.0,
                    total_time: 1.0,
                    props: yarn,
                    density: unit.as_ptr(),
                    strain_inc: zero.as_ptr(),
                    stretch_old: [1.0 as $t, 1.0, 1.0, 0.0, 0.0, 0.0].as_ptr(),
                    stretch_new: stretch.as_ptr(),
                    stress_old: zero.as_ptr(),
                    state_old: zero.as_ptr(),
                    ener_intern_old: zero.as_ptr(),
                    ener_inelas_old: zero.as_ptr(),
                    stress_new: s,
                    state_new: state.as_mut_ptr(),
                    ener_intern_new: &mut energy,
                    ener_inelas_new: &mut inelastic,
                    ..Vumat::empty()
                };
                let check = Vumat { step_time: 0.0, total_time: 0.0, ..job };
                for job in [job, check, Vumat { nshr: 1, ..job }, Vumat { nprops: 3, ..job }] {
                    quiet!(<LinearElastic<$t> as ExplicitLaw<$t>>::vumat, &job, t, ROOM);
                }
                let mut history = [0.0 as $t; 28];
                history[19..].copy_from_slice(&f);
                let (h, mut failed) = (history.as_mut_ptr(), 0 as c_int);
                for nhv in [19, 11] {
                    quiet!(
                        <LinearElastic<$t> as UserRoutines<$t>>::umat,
                        &Umat { cm: yarn, sig: s, hsv: h, nhv, failel: &mut failed },
                        t,
                        ROOM
                    );
                    quiet!(
                        <LinearElastic<$t> as UserRoutines<$t>>::utan,
                        &Utan { cm: yarn, hsv: h, nhv, es: c },
                        t,
                        ROOM
                    );
                    let (sig, failels) = ([0, 1, 2, 3, 4, 5].map(|c| s.wrapping_add(c)), &raw mut failed);
                    let elements = UmatVector { cm: yarn, sig, hsvs: h, nhv, lft: 1, llt: 1, nlq: 1, failels };
                    quiet!(<LinearElastic<$t> as UserRoutines<$t>>::umat_vector, &elements, t, ROOM);
                    let elements = UtanVector { cm: yarn, hsvs: h, nhv, lft: 1, llt: 1, nlq: 1, dsave: c };
                    quiet!(<LinearElastic<$t> as UserRoutines<$t>>::utan_vector, &elements, t, ROOM);
                }
            }
        }
    };
}

linear_hosts!(linear_hosts_in_double_precision, f64);
linear_hosts!(linear_hosts_in_single_precision, f32);

#[test]
fn linear_hosts_in_double_precision_only() {
    let (mut bulk, mut shear, mut text) = (0.0, 0.0, [0 as c_char; ROOM]);
    let t = text.as_mut_ptr();
    for (yarn, f) in LINEAR.iter().flat_map(|yarn| deformations().map(move |f| (yarn.as_ptr(), f))) {
        quiet!(LinearElastic::card_moduli, yarn, L, &mut bulk, &mut shear, t, ROOM);
        let (mut stress, mut state, mut tangent) = ([0.0; 6], [0.0; S], [0.0; 36]);
        let (mut energy, mut step, n) = (0.0, 1.0, L as i32);
        let (s, h, c) = (stress.as_mut_ptr(), state.as_mut_ptr(), tangent.as_mut_ptr());
        for (ddsdde, nshr) in [(c, 3), (c, 1), (null_mut(), 3), (c, 2)] {
            let call = abaqus::Umat {
                stress: s,
                statev: h,
                ddsdde,
                sse: &mut energy,
                pnewdt: &mut step,
                dfgrd0: REST.as_ptr(),
                dfgrd1: f.as_ptr(),
                props: yarn,
                nprops: n,
                nstatv: n,
                ndi: 3,
                nshr,
                nlgeom: 1,
                circumstances: Circumstances::UNKNOWN,
            };
            quiet!(<LinearElastic as StandardLaw>::umat, &call, t, ROOM);
        }
    }
}

/// Every request, measure and operator, and some that do not exist.
#[test]
fn mgis_behaviours() {
    let (mut text, mut step, mut speed, density) = ([0 as c_char; ROOM], 1.0, 0.0, [1.0, -1.0]);
    let (mut old, mut new, mut stress, mut energy) = ([0.0; S], [0.0; S], [0.0; 9], 0.0);
    for (request, measure, operator) in
        (-4..106).flat_map(|request| (0..4).flat_map(move |m| (0..5).map(move |o| (request, m, o))))
    {
        if (6..96).contains(&request) {
            continue;
        }
        for (law, f) in (0..3).flat_map(|law| deformations().map(|f| (law, f))) {
            let mut k = [0.0; 81];
            k[..3].copy_from_slice(&[f64::from(request), f64::from(measure), f64::from(operator)]);
            let s0 = StateView {
                gradients: REST.as_ptr(),
                thermodynamic_forces: stress.as_mut_ptr(),
                mass_density: &density[law % 2],
                material_properties: YARNS[law].as_ptr(),
                internal_state_variables: old.as_mut_ptr(),
                stored_energy: &mut energy,
                dissipated_energy: null_mut(),
                external_state_variables: null(),
            };
            let s1 = StateView { gradients: f.as_ptr(), internal_state_variables: new.as_mut_ptr(), ..s0 };
            let mut view = BehaviourDataView {
                error_message: text.as_mut_ptr(),
                dt: 1.0,
                k: k.as_mut_ptr(),
                rdt: &mut step,
                speed_of_sound: &mut speed,
                s0,
                s1,
            };
            let mut own = view;
            own.s1.material_properties = REINFORCED[law].as_ptr();
            for function in [OwnLaw::integrate, OwnLaw::integrate_in_plane] {
                k[..3].copy_from_slice(&[f64::from(request), f64::from(measure), f64::from(operator)]);
                quiet!(function, &mut own);
            }
            let mut linear = view;
            linear.s1.material_properties = LINEAR[law].as_ptr();
            for view in [&mut view, &mut linear] {
                k[..3].copy_from_slice(&[f64::from(request), f64::from(measure), f64::from(operator)]);
                if std::ptr::eq(view.s1.material_properties, LINEAR[law].as_ptr()) {
                    quiet!(mgis::linear_elastic, view);
                    quiet!(mgis::linear_elastic_in_plane, view);
                } else {
                    quiet!(mgis::hyperelastic, view);
                    quiet!(mgis::hyperelastic_in_plane, view);
                }
            }
        }
    }
    assert_eq!(quiet!(mgis::hyperelastic, null_mut()), mgis::NOT_INTEGRATED);
}

/// The entries of the linear elastic law.
macro_rules! linear_elastic {
    ($test:ident, $t:ty, $prepare:path, $axes:path, $point:path, $point_with_properties:path, $increment:path,
     $block:path, $block_with_properties:path) => {
        #[test]
        fn $test() {
            let (mut text, mut code) = ([0 as c_char; ROOM], 0);
            let (t, rest) = (text.as_mut_ptr(), REST.map(|x| x as $t));
            for yarn in LINEAR.map(|yarn| yarn.map(|x| x as $t)) {
                let yarn = yarn.as_ptr();
                // SAFETY: numbers, which may be 0.
                let mut law = unsafe { std::mem::zeroed::<LinearElasticLaw<$t>>() };
                quiet!($prepare, &mut law, size_of_val(&law), yarn, 3, t, ROOM);
                quiet!($prepare, null_mut(), 3, null(), L, null_mut(), 0);
                quiet!($prepare, &mut law, size_of_val(&law), yarn, L, t, ROOM);
                let (mut axes, mut state, mut stress) = (rest, [0.0; TORON_LINEAR_ELASTIC_STATE], [0.0; 6]);
                let (a, h, s) = (axes.as_mut_ptr(), state.as_mut_ptr(), stress.as_mut_ptr());
                let (mut tangent, mut speed, mut active) = ([0.0 as $t; 81], 0.0 as $t, 0.0 as $t);
                for direction in [[0.0 as $t, 1.0, 0.0], [0.0; 3]] {
                    let direction = direction.as_ptr();
                    quiet!($axes, &law, direction, null(), a, t, ROOM);
                    quiet!($axes, &law, direction, direction, a, t, ROOM);
                    quiet!($axes, &law, null(), null(), a, t, ROOM);
                    quiet!($axes, &law, null(), null(), null_mut(), null_mut(), 0);
                    for f in deformations().map(|f| f.map(|x| x as $t)) {
                        let point = LinearPoint {
                            density: 1.0,
                            f_old: rest.as_ptr(),
                            f_new: f.as_ptr(),
                            fibre: direction,
                            axes: a,
                            state_new: h,
                            stress: s,
                            wave_speed: &mut speed,
                            ..LinearPoint::empty()
                        };
                        let mut block = LinearBlock {
                            n: 1,
                            density: 1.0,
                            axes: a,
                            state_new: h,
                            wave_speed: &mut speed,
                            active: &mut active,
                            status: &mut code,
                            ..LinearBlock::empty()
                        };
                        (block.f_old[0], block.f_new[0]) = (rest.as_ptr(), f.as_ptr());
                        (block.fibre[0], block.stress[0]) = (direction, s);
                        let tangent = tangent.as_mut_ptr();
                        for (rotation, criterion) in (-1..4).flat_map(|r| (-1..3).map(move |c| (r, c))) {
                            let point = LinearPoint { rotation, criterion, ..point };
                            let block = LinearBlock { rotation, criterion, ..block };
                            quiet!($point, &law, &point, t, ROOM);
                            quiet!($point_with_properties, yarn, L, &point, t, ROOM);
                            quiet!($block, &law, &block, t, ROOM);
                            quiet!($block_with_properties, yarn, L, &block, t, ROOM);
                            let layout = Layout { leading_dimension: 1, stride: 9 };
                            quiet!($block, &law, &LinearBlock { stress_layout: layout, ..block }, t, ROOM);
                            for measure in -1..5 {
                                quiet!($point, &law, &LinearPoint { measure, tangent, ..point }, t, ROOM);
                                quiet!($block, &law, &LinearBlock { measure, tangent, ..block }, t, ROOM);
                            }
                        }
                        quiet!($point, &law, &LinearPoint { f_old: null(), ..point }, t, ROOM);
                        quiet!($point, null(), &LinearPoint { size: 0, ..point }, t, ROOM);
                        quiet!($block, &law, &LinearBlock { n: 2, leading_dimension: 1, ..block }, t, ROOM);
                        quiet!($block_with_properties, yarn, 3, null(), null_mut(), 0);
                        quiet!($point_with_properties, yarn, L, null(), null_mut(), 0);
                        for criterion in -1..3 {
                            let increment = LinearIncrement {
                                criterion,
                                strain: f.as_ptr(),
                                state_new: h,
                                stress: s,
                                ..LinearIncrement::empty()
                            };
                            quiet!($increment, &law, &increment, t, ROOM);
                            quiet!($increment, &law, &LinearIncrement { strain: null(), ..increment }, t, ROOM);
                        }
                    }
                }
            }
        }
    };
}

linear_elastic!(
    linear_elastic_in_double_precision,
    f64,
    toron_linear_elastic_prepare_f64,
    toron_linear_elastic_axes_f64,
    toron_linear_elastic_point_f64,
    toron_linear_elastic_point_with_properties_f64,
    toron_linear_elastic_increment_f64,
    toron_linear_elastic_block_f64,
    toron_linear_elastic_block_with_properties_f64
);
linear_elastic!(
    linear_elastic_in_single_precision,
    f32,
    toron_linear_elastic_prepare_f32,
    toron_linear_elastic_axes_f32,
    toron_linear_elastic_point_f32,
    toron_linear_elastic_point_with_properties_f32,
    toron_linear_elastic_increment_f32,
    toron_linear_elastic_block_f32,
    toron_linear_elastic_block_with_properties_f32
);

/// The starter and cycles of both laws, with fibre directions from the card, the nodes and initial values; points that
/// fail and that cannot be evaluated; no deformation gradient.
macro_rules! openradioss {
    ($test:ident, $t:ty, $read_card:path, $write_line:path, $group:path) => {
        #[test]
        fn $test() {
            const ROOM_OF_PARAMETERS: i32 = 14;
            let mut text = [0 as c_char; ROOM];
            let t = text.as_mut_ptr();
            let cards: Vec<(i32, Vec<f64>)> = [(1, YARNS.map(Vec::from)), (2, LINEAR.map(Vec::from))]
                .into_iter()
                .flat_map(|(law, cards)| {
                    cards.into_iter().flat_map(move |card| {
                        (0..4).map(move |fibre_from| (law, [&card[..], &[f64::from(fibre_from)]].concat()))
                    })
                })
                .collect();
            let nodes: [$t; 24] = std::array::from_fn(|k| (k * k % 7) as $t);
            for (law, card) in cards {
                let card: Vec<$t> = card.into_iter().map(|x| x as $t).collect();
                let (values, count) = (card.as_ptr(), card.len());
                let (mut parameters, mut modulus) = ([0.0 as $t; ROOM_OF_PARAMETERS as usize], 0.0 as $t);
                let (u, mut nuparam, mut nuvar) = (parameters.as_mut_ptr(), 0, 0);
                let starter = MaterialCard {
                    number: law,
                    values,
                    count,
                    uparam: u,
                    maxuparam: ROOM_OF_PARAMETERS,
                    nuparam: &raw mut nuparam,
                    nuvar: &raw mut nuvar,
                    parmat: &raw mut modulus,
                };
                quiet!($read_card, &MaterialCard { number: 3, ..starter }, t, ROOM);
                quiet!($read_card, &MaterialCard { count: 4, ..starter }, t, ROOM);
                quiet!($read_card, &MaterialCard { parmat: null_mut(), ..starter }, null_mut(), 0);
                let read = quiet!($read_card, &starter, t, ROOM);
                for line in -1..45 {
                    quiet!($write_line, &ListingLine { uparam: u, nuparam, line, text: t, capacity: ROOM });
                }
                if read != 0 {
                    continue;
                }
                for f in deformations().into_iter().chain([[0.0; 9]]) {
                    let f = f.map(|x| x as $t);
                    let (mut s, mut v, mut uvar) = ([0.0 as $t; 6], [0.0 as $t; 8], [0.0 as $t; 26]);
                    let (mut off, number, density) = (1.0 as $t, 7, 1.0 as $t);
                    let group = Group {
                        elements: 1,
                        parameters: nuparam,
                        variables: nuvar,
                        time: 0.0,
                        time_step: 0.0,
                        uparam: u,
                        numbers: &raw const number,
                        density: &raw const density,
                        deformation_gradient: [0, 4, 8, 3, 7, 2, 1, 5, 6].map(|c| &raw const f[c]),
                        stress: [0, 1, 2, 3, 4, 5].map(|c| &raw mut s[c]),
                        viscous: [0, 1, 2, 3, 4, 5].map(|c| &raw mut v[c]),
                        sound_speed: &raw mut v[7],
                        viscosity: &raw mut v[6],
                        uvar: uvar.as_mut_ptr(),
                        off: &raw mut off,
                        nodes: null(),
                        volume: null(),
                    };
                    for (time, nodes) in [(0.0, nodes.as_ptr()), (1e-6, null()), (2e-6, null()), (0.0, null())] {
                        quiet!($group, &Group { time, nodes, ..group }, t, ROOM);
                    }
                    let wrong =
                        Group { variables: 3, numbers: null(), density: null(), viscosity: null_mut(), ..group };
                    quiet!($group, &wrong, null_mut(), 0);
                }
            }
        }
    };
}

openradioss!(
    openradioss_in_double_precision,
    f64,
    openradioss::read_card_f64,
    openradioss::write_line_f64,
    openradioss::group_f64
);
openradioss!(
    openradioss_in_single_precision,
    f32,
    openradioss::read_card_f32,
    openradioss::write_line_f32,
    openradioss::group_f32
);

/// The entries of the law with friction.
macro_rules! frictional {
    ($test:ident, $t:ty, $prepare:path, $point:path, $point_with_properties:path, $block:path, $block_with_properties:path) => {
        #[test]
        fn $test() {
            const Q: usize = TORON_FRICTIONAL_PROPERTIES;
            const K: usize = TORON_FRICTIONAL_STATE;
            let mut text = [0 as c_char; ROOM];
            let t = text.as_mut_ptr();
            for yarn in FRICTIONAL.map(|yarn| yarn.map(|x| x as $t)) {
                let yarn = yarn.as_ptr();
                // SAFETY: numbers, which may be 0.
                let mut law = unsafe { std::mem::zeroed::<FrictionalLaw<$t>>() };
                quiet!($prepare, &mut law, size_of_val(&law), yarn, Q, t, ROOM);
                quiet!($prepare, &mut law, 0, yarn, Q, null_mut(), 0);
                // Pressed as well, so that the fibres slide.
                for f in deformations().map(|f| [f[0], 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.8].map(|x| x as $t)) {
                    let (mut stress, mut state, mut c) = ([0.0 as $t; 6], [0.0 as $t; K], [0.0 as $t; 81]);
                    let (s, h, c, mut code) = (stress.as_mut_ptr(), state.as_mut_ptr(), c.as_mut_ptr(), 0);
                    let point = Point {
                        deformation_gradient: f.as_ptr(),
                        state_old: h,
                        state_new: h,
                        stress: s,
                        ..Point::empty()
                    };
                    let tangents = (-1..5).map(|measure| Point { measure, tangent: c, ..point });
                    for point in
                        [point, Point { size: 0, ..point }, Point { level: 9, ..point }].into_iter().chain(tangents)
                    {
                        quiet!($point, &law, &point, t, ROOM);
                        quiet!($point_with_properties, yarn, Q, &point, t, ROOM);
                        quiet!($point_with_properties, yarn, 3, &point, t, ROOM);
                    }
                    quiet!($point, null(), null(), null_mut(), 0);
                    let mut block = Block { n: 1, status: &mut code, failure: h.wrapping_add(8), ..Block::empty() };
                    (block.deformation_gradient[0], block.stress[0]) = (f.as_ptr(), s);
                    let tangents = (-1..5).map(|measure| Block { measure, tangent: c, ..block });
                    let in_rows = Layout { leading_dimension: 1, stride: 9 };
                    let blocks =
                        [block, Block { deformation_gradient_layout: in_rows, ..block }, Block { size: 16, ..block }];
                    for block in blocks.into_iter().chain(tangents) {
                        quiet!($block, &law, &block, t, ROOM);
                        quiet!($block, &law, &Block { status: null_mut(), ..block }, t, ROOM);
                        quiet!($block_with_properties, yarn, Q, &block, t, ROOM);
                        quiet!($block_with_properties, null(), Q, null(), t, ROOM);
                    }
                }
            }
        }
    };
}

frictional!(
    frictional_in_double_precision,
    f64,
    toron_frictional_prepare_f64,
    toron_frictional_point_f64,
    toron_frictional_point_with_properties_f64,
    toron_frictional_block_f64,
    toron_frictional_block_with_properties_f64
);
frictional!(
    frictional_in_single_precision,
    f32,
    toron_frictional_prepare_f32,
    toron_frictional_point_f32,
    toron_frictional_point_with_properties_f32,
    toron_frictional_block_f32,
    toron_frictional_block_with_properties_f32
);

/// A law that reads the length of the step, which is there, negative, or not known.
#[test]
fn lsdyna_with_a_time_increment() {
    type Law = toron::user::User<reinforced_solid::viscoelastic::ViscoelasticSolid, f64>;
    const NHV: i32 = 14;
    let mut text = [0 as c_char; ROOM];
    let (t, card) = (text.as_mut_ptr(), [3.0, 7.0, 11.0, 2.5]);
    for step in [0.1, -1.0, f64::NAN] {
        for when in [When { time_increment: &raw const step, ..When::UNKNOWN }, When::UNKNOWN] {
            let (mut history, mut stress, mut moduli, mut failed) = ([0.0; 23], [0.0; 6], [0.0; 36], 0);
            history[NHV as usize..].copy_from_slice(&REST);
            let (cm, hsv, s, es) = (card.as_ptr(), history.as_mut_ptr(), stress.as_mut_ptr(), moduli.as_mut_ptr());
            let (sig, failel) = ([0, 1, 2, 3, 4, 5].map(|c| s.wrapping_add(c)), &raw mut failed);
            let element = Umat { cm, sig: s, hsv, nhv: NHV, failel };
            let elements = UmatVector { cm, sig, hsvs: hsv, nhv: NHV, lft: 1, llt: 1, nlq: 1, failels: failel };
            let tangent = Utan { cm, hsv, nhv: NHV, es };
            let tangents = UtanVector { cm, hsvs: hsv, nhv: NHV, lft: 1, llt: 1, nlq: 1, dsave: es };
            let is_right = !when.time_increment.is_null() && step > 0.0;
            for code in [
                quiet!(<Law as UserRoutines<f64>>::umat_at, &element, &when, t, ROOM),
                quiet!(<Law as UserRoutines<f64>>::umat_vector_at, &elements, &when, t, ROOM),
                quiet!(<Law as UserRoutines<f64>>::utan_at, &tangent, &when, t, ROOM),
                quiet!(<Law as UserRoutines<f64>>::utan_vector_at, &tangents, &when, t, ROOM),
            ] {
                assert_eq!(code == 0, is_right, "{code} with a step of {step}");
            }
        }
    }
}

#[test]
fn a_umat_that_tells_its_losses() {
    let mut text = [0 as c_char; ROOM];
    let t = text.as_mut_ptr();
    for yarn in &FRICTIONAL {
        for f in deformations() {
            let (mut stress, mut state, mut energies, mut step) =
                ([0.0; 6], [0.0; TORON_FRICTIONAL_STATE], [0.0; 2], 1.0);
            let [sse, spd] = &mut energies;
            let call = abaqus::Umat {
                stress: stress.as_mut_ptr(),
                statev: state.as_mut_ptr(),
                ddsdde: null_mut(),
                sse,
                pnewdt: &mut step,
                dfgrd0: null(),
                dfgrd1: f.as_ptr(),
                props: yarn.as_ptr(),
                nprops: yarn.len() as i32,
                nstatv: TORON_FRICTIONAL_STATE as i32,
                ndi: 3,
                nshr: 3,
                nlgeom: 1,
                circumstances: Circumstances::UNKNOWN,
            };
            for call in [call, abaqus::Umat { nlgeom: 0, ..call }] {
                quiet!(<toron::Frictional as StandardLaw>::umat_with_losses, &call, spd, t, ROOM);
                quiet!(<toron::Frictional as StandardLaw>::umat_with_losses, &call, null_mut(), null_mut(), 0);
            }
        }
    }
}
