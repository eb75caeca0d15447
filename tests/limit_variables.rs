//! Failure limits of points in variables of the hosts': a host with such a variable gives what it gives with that limit
//! among the properties. MGIS has the property itself by point.

use std::array;
use std::ffi::c_char;
use std::ptr::{null, null_mut};

use nalgebra::Matrix3;
use toron::host::abaqus::{self, ExplicitLaw, StandardLaw, Vumat};
use toron::host::calculix::{Behaviour, CalculixLaw};
use toron::host::openradioss::{Group, MyReal, evaluate_material, listing, read};
use toron::law::block::Circumstances;
use toron::law::interface::Law;
use toron::law::status;
use toron::{Hyperelastic, LinearElastic};

const ROOM: usize = 400;
/// The fibre strain of the path, as a stretch: between the limits below.
const STRETCH: f64 = 1.03;
const EPS_LIM: [f64; 3] = [0.02, 0.045, 0.029];

/// A law with its properties, the place of its limit among them, and that of its flag in the state.
trait Limited: Law<f64> + StandardLaw + ExplicitLaw<f64> + CalculixLaw {
    const VALUES: &'static [f64];
    const LIMIT: usize;
    /// What the card has for the limit of [`EPS_LIM`], and what the variable has for it.
    fn limits(eps_lim: f64) -> [f64; 2];
}

impl Limited for Hyperelastic<f64> {
    const VALUES: &'static [f64] = &[82341.0, 1055.0, 2.2, 649.74, 90.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0];
    const LIMIT: usize = 5;

    fn limits(eps_lim: f64) -> [f64; 2] {
        [eps_lim, eps_lim.ln_1p()]
    }
}

impl Limited for LinearElastic {
    const VALUES: &'static [f64] = &[79414.0, 794.14, 126.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    const LIMIT: usize = 3;

    fn limits(eps_lim: f64) -> [f64; 2] {
        [79414.0 * eps_lim; 2]
    }
}

/// Properties with this limit, and whatever stands behind them.
fn card<L: Limited>(limit: f64, behind: Option<f64>) -> Vec<f64> {
    let mut values = L::VALUES.to_vec();
    values[L::LIMIT] = limit;
    values.extend(behind);
    values
}

fn stretched(part: f64) -> Matrix3<f64> {
    let stretch = 1.0 + (STRETCH - 1.0) * part;
    Matrix3::new(stretch, 0.0, 0.0, 0.0, 0.99, 0.02, 0.0, 0.02, 0.98)
}

const PATH: [f64; 4] = [0.0, 0.4, 1.0, 1.0];

fn near(found: &[f64], wanted: &[f64], what: &str) {
    let apart = found.iter().zip(wanted).map(|(a, b)| (a - b).abs() / b.abs().max(1e-6));
    assert!(found.len() == wanted.len() && apart.fold(0.0, f64::max) < 1e-12, "{what}: {found:?} {wanted:?}");
}

/// Runs a host's point along the path, with the limit among the properties and in a variable, whose value is
/// `state[place]`. The host gets the card, the state and F at both ends.
fn compare<L: Limited>(
    what: &str,
    place: usize,
    mut call: impl FnMut(&[f64], &mut Vec<f64>, [Matrix3<f64>; 2]) -> Vec<f64>,
) {
    let (state, failed) = (L::DESCRIPTION.state.len(), L::DESCRIPTION.failed);
    let mut fails = 0;
    for eps_lim in EPS_LIM {
        let [property, limit] = L::limits(eps_lim);
        let mut by_property = vec![0.0; place + 1];
        let mut by_variable = by_property.clone();
        by_variable[place] = limit;
        // That of the card, where that of the variable is 0.
        let mut by_card = by_property.clone();
        for ends in PATH.windows(2) {
            let f = [stretched(ends[0]), stretched(ends[1])];
            let wanted = call(&card::<L>(property, None), &mut by_property, f);
            let number = Some((place + 1) as f64);
            let found = call(&card::<L>(L::limits(0.5)[0], number), &mut by_variable, f);
            near(&found, &wanted, what);
            near(&by_variable[..failed - 1], &by_property[..failed - 1], what);
            assert_eq!(by_variable[failed], by_property[failed], "{what} {eps_lim}");
            assert_eq!(by_variable[place], limit, "{what}");
            for none in [number, Some(0.0)] {
                let mut state = by_card.clone();
                assert_eq!(call(&card::<L>(property, none), &mut state, f), wanted, "{what}");
            }
            call(&card::<L>(property, Some(0.0)), &mut by_card, f);
            assert_eq!(by_card[..state], by_property[..state], "{what}");
        }
        fails += by_property[failed] as usize;
    }
    assert_eq!(fails, 2, "{what}");
}

struct Umat {
    code: i32,
    message: String,
    results: Vec<f64>,
}

fn umat<L: Limited>(card: &[f64], state: &mut [f64], f: [Matrix3<f64>; 2], tangent: bool) -> Umat {
    let (mut stress, mut ddsdde, mut sse, mut pnewdt) = ([0.0; 6], [0.0; 36], 0.0, 1.0);
    let mut message = [0; ROOM];
    let call = abaqus::Umat {
        stress: stress.as_mut_ptr(),
        statev: state.as_mut_ptr(),
        ddsdde: if tangent { ddsdde.as_mut_ptr() } else { null_mut() },
        sse: &mut sse,
        pnewdt: &mut pnewdt,
        dfgrd0: f[0].as_ptr(),
        dfgrd1: f[1].as_ptr(),
        props: card.as_ptr(),
        nprops: card.len() as i32,
        nstatv: state.len() as i32,
        ndi: 3,
        nshr: 3,
        nlgeom: 1,
        circumstances: Circumstances::UNKNOWN,
    };
    // SAFETY: the arrays have the sizes that the structure tells.
    let code = unsafe { <L as StandardLaw>::umat(&call, message.as_mut_ptr(), ROOM) };
    let results = stress.into_iter().chain(ddsdde).chain([sse]).collect();
    Umat { code, message: text(&message), results }
}

fn text(message: &[c_char; ROOM]) -> String {
    message.iter().take_while(|&&c| c != 0).map(|&c| char::from(c as u8)).collect()
}

fn umats<L: Limited>() {
    for (place, tangent) in [(L::DESCRIPTION.state.len(), true), (L::DESCRIPTION.state.len() + 3, false)] {
        compare::<L>("UMAT", place, |card, state, f| {
            let call = umat::<L>(card, state, f, tangent);
            assert_eq!(call.code, status::OK, "{}", call.message);
            call.results
        });
    }
    let f = [Matrix3::identity(); 2];
    let first = L::DESCRIPTION.state.len() as f64;
    for wrong in [-1.0, 1.0, first, first + 3.0, first + 0.5, f64::NAN] {
        let call = umat::<L>(&card::<L>(0.03, Some(wrong)), &mut vec![0.0; first as usize + 2], f, true);
        assert_eq!(call.code, status::BAD_ARGUMENT, "{wrong}");
        assert!(call.message.contains("limit_variable is") && call.message.contains("*DEPVAR"), "{}", call.message);
    }
    for wrong in [-1e-3, f64::NAN, f64::INFINITY] {
        let mut state = vec![0.0; first as usize + 1];
        *state.last_mut().expect("a variable") = wrong;
        let call = umat::<L>(&card::<L>(0.03, Some(first + 1.0)), &mut state, f, false);
        assert_eq!(call.code, status::BAD_ARGUMENT, "{wrong}");
        assert!(call.message.contains("failure limit of a point"), "{}", call.message);
    }
    // One value more is none of these.
    let mut long = card::<L>(0.03, Some(0.0));
    long.push(0.0);
    assert_eq!(umat::<L>(&long, &mut [0.0; 20], f, true).code, status::PROPERTY_COUNT);
}

#[test]
fn abaqus_standard() {
    umats::<Hyperelastic>();
    umats::<LinearElastic>();
}

/// Three points, of which the one in the middle is the path's; the others are at rest with limits of their own.
fn vumat<L: Limited>(
    card: &[f64],
    state: &mut [f64],
    [old, new]: [Matrix3<f64>; 2],
    time: f64,
) -> (i32, String, Vec<f64>) {
    const N: usize = 3;
    let spread = |values: &[f64], others: &dyn Fn(usize) -> f64| -> Vec<f64> {
        values.iter().enumerate().flat_map(|(c, &x)| [others(c), x, others(c)]).collect()
    };
    let stretch =
        |u: &Matrix3<f64>| spread(&[u.m11, u.m22, u.m33, u.m12, u.m23, u.m31], &|c| f64::from(u8::from(c < 3)));
    let (old, new) = (stretch(&old), stretch(&new));
    let last = state.len() - 1;
    let mut states = spread(state, &|c| if c == last { 0.01 } else { 0.0 });
    let (density, zeros) = ([1.0; N], [0.0; 6 * N]);
    let (mut stress, mut energy, mut inelastic) = ([f64::NAN; 6 * N], [0.0; N], [0.0; N]);
    let mut message = [0; ROOM];
    let job = Vumat {
        nblock: N as i32,
        ndir: 3,
        nshr: 3,
        nstatev: state.len() as i32,
        nprops: card.len() as i32,
        step_time: time,
        total_time: time,
        props: card.as_ptr(),
        density: density.as_ptr(),
        strain_inc: zeros.as_ptr(),
        stretch_old: old.as_ptr(),
        stretch_new: new.as_ptr(),
        stress_old: zeros.as_ptr(),
        state_old: states.as_ptr(),
        ener_intern_old: zeros.as_ptr(),
        ener_inelas_old: zeros.as_ptr(),
        stress_new: stress.as_mut_ptr(),
        state_new: states.as_mut_ptr(),
        ener_intern_new: energy.as_mut_ptr(),
        ener_inelas_new: inelastic.as_mut_ptr(),
        ..Vumat::empty()
    };
    // SAFETY: the arrays have the sizes that the structure tells; the new state is in the old one's place.
    let code = unsafe { <L as ExplicitLaw<f64>>::vumat(&job, message.as_mut_ptr(), ROOM) };
    state.iter_mut().zip(states[1..].iter().step_by(N)).for_each(|(to, &from)| *to = from);
    (code, text(&message), stress[1..].iter().step_by(N).copied().collect())
}

fn vumats<L: Limited>() {
    for place in [L::DESCRIPTION.state.len(), L::DESCRIPTION.state.len() + 3] {
        compare::<L>("VUMAT", place, |card, state, f| {
            let (code, message, results) = vumat::<L>(card, state, f, 1.0);
            assert_eq!(code, status::OK, "{message}");
            results
        });
    }
    let (f, first) = ([Matrix3::identity(); 2], L::DESCRIPTION.state.len());
    let (code, message, _) = vumat::<L>(&card::<L>(0.03, Some(first as f64)), &mut vec![0.0; first + 1], f, 1.0);
    assert!(code == status::BAD_ARGUMENT && message.contains("limit_variable"), "{message}");
    let mut state = vec![0.0; first + 1];
    state[first] = -1.0;
    let card = card::<L>(0.03, Some(first as f64 + 1.0));
    let (code, message, _) = vumat::<L>(&card, &mut state.clone(), f, 0.0);
    assert!(code == status::BAD_ARGUMENT && message.contains("failure limit of a point"), "{message}");
    assert_eq!(vumat::<L>(&card, &mut state, f, 1.0).0, status::LIMIT);
}

#[test]
fn abaqus_explicit() {
    vumats::<Hyperelastic>();
    vumats::<LinearElastic>();
}

fn calculix<L: Limited>() {
    let call = |card: &[f64], state: &mut Vec<f64>, [_, f]: [Matrix3<f64>; 2]| -> Vec<f64> {
        let strain = 0.5 * (f.tr_mul(&f) - Matrix3::identity());
        let strain = [strain.m11, strain.m22, strain.m33, strain.m12, strain.m13, strain.m23];
        let (mut new, mut stress, mut stiffness, mut pnewdt) = (state.clone(), [0.0; 6], [0.0; 21], -1.0);
        let (name, zeros) = ([b' ' as c_char; 80], [0.0; 7]);
        let behaviour = Behaviour {
            amat: name.as_ptr(),
            iel: &1,
            iint: &1,
            kode: &(-100 - card.len() as i32),
            elconloc: card.as_ptr(),
            emec: strain.as_ptr(),
            beta: zeros.as_ptr(),
            xkl: f.as_ptr(),
            mi: &1,
            nstate_: &(state.len() as i32),
            xstateini: state.as_ptr(),
            xstate: new.as_mut_ptr(),
            stre: stress.as_mut_ptr(),
            stiff: stiffness.as_mut_ptr(),
            iorien: &0,
            pgauss: zeros.as_ptr(),
            orab: zeros.as_ptr(),
            pnewdt: &mut pnewdt,
            circumstances: Circumstances::UNKNOWN,
        };
        // SAFETY: the arrays have the sizes that CalculiX promises.
        unsafe { L::behaviour(&behaviour) };
        *state = new;
        stress.into_iter().chain(stiffness).collect()
    };
    // One model may have both laws, so that the hyperelastic one's points have more variables than it keeps.
    let kept = L::DESCRIPTION.history();
    for place in [kept, 19] {
        compare::<L>("CalculiX", place, call);
    }
}

#[test]
fn calculix_s_native_interface() {
    calculix::<Hyperelastic>();
    calculix::<LinearElastic>();
}

/// As many elements as there are limits, each with its own; `fibre` is UVAR's, where the card's has none.
fn group(number: i32, values: &[f64], limits: Option<[f64; 3]>) -> (Result<(), i32>, Vec<f64>, Vec<f64>) {
    const N: usize = 3;
    let laws = &<f64 as MyReal>::TORON;
    let mut uparam = [0.0; 40];
    let material = read(laws, number, values, &mut uparam).expect("a card that is right");
    let (parameters, variables) = (material.parameters, material.variables);
    let mut uvar = vec![0.0; variables * N];
    if let Some(limits) = limits {
        let limit = variables - 1 - 3; // before the diagonal
        uvar[limit * N..][..N].copy_from_slice(&limits);
    }
    let mut off = [1.0; N];
    for (step, &part) in PATH.iter().enumerate() {
        let f = stretched(part);
        let gradients: Vec<f64> = f.as_slice().iter().flat_map(|&f| [f; N]).collect();
        let column = |i: usize, j: usize| gradients.as_ptr().wrapping_add((3 * j + i) * N);
        let [xx, yy, zz] = [column(0, 0), column(1, 1), column(2, 2)];
        let [xy, yz, zx, yx, zy, xz] =
            [column(0, 1), column(1, 2), column(2, 0), column(1, 0), column(2, 1), column(0, 2)];
        let (mut stress, mut speed, density) = ([f64::NAN; 6 * N], [f64::NAN; N], 2.0);
        let to = stress.as_mut_ptr();
        let group = Group {
            elements: N as i32,
            parameters: parameters as i32,
            variables: variables as i32,
            time: step as f64,
            time_step: 1.0,
            uparam: uparam.as_ptr(),
            numbers: null(),
            density: &density,
            deformation_gradient: [xx, yy, zz, xy, yz, zx, yx, zy, xz],
            stress: array::from_fn(|c| to.wrapping_add(c * N)),
            viscous: [null_mut(); 6],
            sound_speed: speed.as_mut_ptr(),
            viscosity: null_mut(),
            uvar: uvar.as_mut_ptr(),
            off: off.as_mut_ptr(),
            nodes: null(),
            volume: null(),
        };
        // SAFETY: the arrays have the sizes that the structure tells.
        if let Err(error) = unsafe { evaluate_material(laws, &group) } {
            return (Err(error.code()), uvar, off.to_vec());
        }
    }
    (Ok(()), uvar, off.to_vec())
}

/// `variables`: up to the limit; behind them are the three of the element's diagonal, which are 0 where the nodes are
/// not known.
fn openradioss<L: Limited>(number: i32, options: &[f64], variables: usize) {
    let with = |limit: f64, last: f64| -> Vec<f64> {
        let mut values = card::<L>(limit, None);
        values.extend(options.iter().chain(&[last]));
        values
    };
    let own = EPS_LIM.map(|eps_lim| L::limits(eps_lim)[1]);
    let (answer, uvar, off) = group(number, &with(L::limits(0.5)[0], 1.0), Some(own));
    assert_eq!((answer, uvar.len()), (Ok(()), 3 * (variables + 3)));
    assert_eq!((&off[..], &uvar[3 * (variables - 1)..3 * variables]), (&[0.0, 1.0, 0.0][..], &own[..]));
    for (element, eps_lim) in EPS_LIM.into_iter().enumerate() {
        let (answer, wanted, _) = group(number, &with(L::limits(eps_lim)[0], 0.0), None);
        assert_eq!((answer, wanted.len()), (Ok(()), 3 * (variables + 2)));
        let of =
            |uvar: &[f64]| -> Vec<f64> { uvar[element..].iter().step_by(3).take(variables - 1).copied().collect() };
        near(&of(&uvar), &of(&wanted), "OpenRadioss");
    }
    // 0 is that of the card, and what means nothing stops the run.
    let (answer, zero, _) = group(number, &with(L::limits(0.045)[0], 1.0), Some([0.0; 3]));
    let (_, wanted, _) = group(number, &with(L::limits(0.045)[0], 0.0), None);
    let before = 3 * (variables - 1);
    assert_eq!((answer, &zero[..before]), (Ok(()), &wanted[..before]));
    assert_eq!(group(number, &with(0.5, 1.0), Some([0.0, -1.0, 0.0])).0, Err(status::LIMIT));
    // The listing names it.
    let laws = &<f64 as MyReal>::TORON;
    let mut uparam = [0.0; 40];
    let material = read(laws, number, &with(0.03, 1.0), &mut uparam).expect("a card that is right");
    let mut text = String::new();
    let mut line = 0;
    while listing(laws, &uparam[..material.parameters], line, &mut |piece| text.push_str(piece)).expect("a card") {
        text.push('\n');
        line += 1;
    }
    assert!(text.contains("limit_from = 1") && text.contains(&format!("       {variables} limit\n")), "{text}");
    let error = read(laws, number, &with(0.03, 2.0), &mut [0.0; 40]).expect_err("no such option");
    assert_eq!(error.code(), status::BAD_ARGUMENT);
    // And so does the message, by the same number.
    let said = format!("{variables} of USER0{number}");
    assert!(
        error.to_string().contains("initial user variable limit, ") && error.to_string().contains(&said),
        "{error}"
    );
}

#[test]
fn openradioss_s_user_variables() {
    openradioss::<Hyperelastic>(1, &[0.0], 16);
    openradioss::<LinearElastic>(2, &[0.0, 0.0, 0.0], 24);
}
