//! A law of one's own in C, `examples/own_law`: its header, its functions against the same law in Rust, its machine
//! code and its speed.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use libc::c_char;
use toron::Measure;
use toron::host::Material;
use toron::host::abaqus::Vumat;
use toron::law::block::Precision;
use toron::law::interface::{Law, Points};
use toron::user::User;

use crate::c_programs::PRECISIONS;
use toron_test_support::library::{OWN_LAW, ROOT, SYSTEM, folder, run};
use toron_test_support::update::is_asked;

use reinforced_solid::ReinforcedSolid;

const HEADER: &str = "examples/own_law/reinforced.h";
const LIBRARIES: [&str; 2] = ["own_law_double", "own_law_single"];

#[test]
fn the_committed_header_is_current() {
    let path = Path::new(ROOT).join(HEADER);
    let generated = toron_solvers::c_header::<ReinforcedSolid>("REINFORCED");
    if is_asked("headers") {
        std::fs::write(&path, &generated).expect("the header is writable");
    }
    let committed = std::fs::read_to_string(&path).expect(HEADER);
    assert!(committed == generated, "{HEADER} is not current: cargo xtask update headers");
}

#[test]
fn compilers_take_the_header_without_a_warning() {
    for (compiler, language, standard) in [("gcc", "c", "-std=c99"), ("g++", "c++", "-std=c++11")] {
        let mut command = Command::new(compiler);
        command.args([standard, "-Wall", "-Wextra", "-pedantic", "-Werror", "-fsyntax-only", "-x", language]);
        run(command.arg(Path::new(ROOT).join(HEADER)), compiler);
    }
}

/// A program of `ffi-tests/own_law` with the library of a precision.
fn compile(name: &str, library: &str, options: &[&str]) -> PathBuf {
    let program = folder(&format!("own-law-{name}-{library}")).join("program");
    let mut gcc = Command::new("gcc");
    gcc.args(["-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror", "-O2"]).args(options);
    gcc.arg(format!("-I{ROOT}/include")).arg(format!("-I{ROOT}/examples/own_law"));
    gcc.arg(Path::new(ROOT).join(format!("ffi-tests/own_law/{name}.c")));
    run(gcc.arg(OWN_LAW.join(format!("lib{library}.a"))).args(SYSTEM).arg("-o").arg(&program), "gcc");
    program
}

/// Points that are pulled, sheared and turned; one that fails, and one that is inverted.
fn deformations(n: usize) -> Vec<[f64; 9]> {
    let mut points: Vec<[f64; 9]> = (0..n)
        .map(|i| {
            std::array::from_fn(|c| {
                let unit = if c % 4 == 0 { 1.0 } else { 0.0 };
                unit + 0.15 * (((i * 37 + c * 101) % 211) as f64 / 211.0 - 0.5)
            })
        })
        .collect();
    points[3] = [1.5, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    points[5][0] = -1.0;
    points
}

/// The lines that the program prints, from the law in Rust.
fn expected<T: Precision>(points: &[[f64; 9]]) -> Vec<Vec<f64>>
where
    ReinforcedSolid: Material<T, Law = User<ReinforcedSolid, T>>,
{
    let n = points.len();
    let properties = [31.0, 17.0, 230.0, 1.2, 2.0, -1.0, 0.5].map(T::splat);
    let law = User::<ReinforcedSolid, T>::new(&properties).expect("properties that are right");
    let zeros = |components: usize| vec![T::splat(0.0); components * n];
    let f: Vec<Vec<T>> = (0..9).map(|c| points.iter().map(|f| T::splat(f[c])).collect()).collect();
    let (mut stress, mut state, mut tangent, mut last) = (zeros(6), zeros(4), zeros(36), zeros(2));
    let mut status = vec![0; n];
    let stress_at = stress.as_mut_ptr();
    let given = Points {
        f_new: std::array::from_fn(|c| f[c].as_ptr()),
        state_old: User::<ReinforcedSolid, T>::parts(state.as_ptr(), n),
        state_new: User::<ReinforcedSolid, T>::parts_mut(state.as_mut_ptr(), n),
        density: T::splat(1.5e-9),
        stress: std::array::from_fn(|c| stress_at.wrapping_add(c * n)),
        tangent: tangent.as_mut_ptr(),
        measure: Measure::Jaumann,
        wave_speed: last.as_mut_ptr(),
        active: last.as_mut_ptr().wrapping_add(n),
        status: status.as_mut_ptr(),
        ..Points::without_arrays(n, n)
    };
    // SAFETY: the arrays have the components of the fields for n points each.
    unsafe { law.step(&given) }.expect("arrays that are right");
    let line = |i: usize| {
        let arrays = [&stress, &state, &tangent, &last];
        let numbers = arrays.into_iter().flat_map(|array| array.iter().skip(i).step_by(n)).map(|&x| x.into());
        numbers.chain([f64::from(status[i])]).collect()
    };
    (0..n).map(line).collect()
}

/// Prepared, refused, and a block with a tangent: the numbers of the law in Rust, bit by bit.
#[test]
fn c_gets_the_answers_of_rust() {
    let points = deformations(43);
    for ((options, library), expected) in
        PRECISIONS.into_iter().zip(LIBRARIES).zip([expected::<f64>(&points), expected::<f32>(&points)])
    {
        assert!(expected.iter().any(|line| line[8] == 1.0) && expected.iter().any(|line| line[48] == -301.0));
        let mut text = format!("{}\n", points.len());
        for x in points.iter().flatten() {
            writeln!(text, "{x:?}").expect("a string");
        }
        let mut command = Command::new(compile("reinforced", library, options));
        let mut program = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("it runs");
        program.stdin.take().expect("its input").write_all(text.as_bytes()).expect("it reads");
        let output = program.wait_with_output().expect("it ends");
        assert!(output.status.success(), "{library}: {}", output.status);
        let printed = String::from_utf8(output.stdout).expect("UTF-8");
        for (i, (line, expected)) in printed.lines().zip(&expected).enumerate() {
            let numbers: Vec<f64> =
                line.split_whitespace().map(|x| rounded(x.parse().expect("a number"), library)).collect();
            assert_eq!(&numbers, expected, "{library}, point {i}");
        }
    }
}

/// Nine digits are those of one number of single precision.
fn rounded(x: f64, library: &str) -> f64 {
    if library == LIBRARIES[1] { f64::from(x as f32) } else { x }
}

/// `/MAT/USER03` in starter and engine: the answers of the C interface.
#[test]
fn openradioss_loads_the_law() {
    for (options, library) in PRECISIONS.into_iter().zip(LIBRARIES) {
        let program = compile("openradioss", library, &[options, &["-std=gnu11", "-rdynamic"]].concat());
        let mut command = Command::new(&program);
        command.current_dir(program.parent().expect("its folder")).env("LD_BIND_NOW", "1");
        run(command.arg(OWN_LAW.join(format!("lib{library}.so"))), "");
    }
}

/// Nanoseconds a point, AVX2, of a block of 1000 points, and of a plain loop, as gcc makes it with -O2 and with all
/// that it has, which gives up the order of operations and NaN.
#[test]
#[ignore = "needs a machine without other work"]
fn a_block_takes_a_third_of_a_plain_loop() {
    for (options, times_as_long) in [(&[][..], 3.0), (&["-O3", "-march=native", "-ffast-math"], 2.0)] {
        let output = run(&mut Command::new(compile("speed", LIBRARIES[0], options)), "");
        let text = String::from_utf8(output.stdout).expect("UTF-8");
        let times: Vec<f64> = text.split_whitespace().map(|x| x.parse().expect("a number")).collect();
        println!("{times:?} ns, gcc {options:?}");
        assert!(times_as_long * times[0] <= times[1], "a block {} ns a point, a loop {} ns", times[0], times[1]);
    }
}

/// A law that cannot be evaluated, as solvers call it.
mod panicking {
    use toron::user::parameters::{STRESS, positive};
    use toron::user::state::{ALIVE, FAILED};
    use toron::user::{Description, Reads, Real, Response, Step, UserMaterial};

    #[derive(Clone, Copy, Debug, Default)]
    pub struct Panicking;

    impl UserMaterial for Panicking {
        const DESCRIPTION: Description = Description {
            title: "law that panics",
            properties: const { &[positive("mu", "μ", STRESS, None, "shear modulus")] },
            state: const { &[FAILED, ALIVE] },
            directions: &[],
            failed: 0,
            alive: 1,
            energies: 0..0,
            reads: Reads::NOTHING,
            lost: None,
            refusal: None,
        };
        type Properties<R: Real> = [R; 1];
        type State<R: Real> = [R; 0];
        type Constants<R: Real> = R;

        fn constants<R: Real>(&[mu]: &[R; 1]) -> R {
            mu
        }

        fn respond<R: Real>(_: &R, _: &Step<R, [R; 0]>) -> Response<R, [R; 0]> {
            panic!("the law has no formula")
        }
    }

    toron_solvers::export! { f64; Panicking as "PANICKING", user 9; }
}

/// Ends this process: [`a_panic_in_a_law_ends_the_job_with_its_message`] runs it in one of its own.
#[test]
#[ignore = "ends the process that runs it"]
fn a_panic_in_a_law() {
    unsafe extern "C" {
        fn PANICKING_abaqus_vumat_f64(block: *const Vumat<f64>, message: *mut c_char, capacity: usize) -> i32;
    }
    let (mu, one, rest, mut out) = (1.0, 1.0, [1.0, 1.0, 1.0, 0.0, 0.0, 0.0], [0.0; 6]);
    let out = out.as_mut_ptr();
    let block = Vumat {
        nblock: 1,
        ndir: 3,
        nshr: 3,
        nstatev: 2,
        nprops: 1,
        step_time: 1.0,
        total_time: 1.0,
        props: &mu,
        density: &one,
        strain_inc: rest.as_ptr(),
        stretch_old: rest.as_ptr(),
        stretch_new: rest.as_ptr(),
        stress_old: rest.as_ptr(),
        state_old: [0.0; 2].as_ptr(),
        ener_intern_old: &one,
        ener_inelas_old: &one,
        stress_new: out,
        state_new: [0.0; 2].as_mut_ptr(),
        ener_intern_new: [0.0].as_mut_ptr(),
        ener_inelas_new: [0.0].as_mut_ptr(),
        ..Vumat::empty()
    };
    // SAFETY: the arrays have the sizes that the structure tells.
    let status = unsafe { PANICKING_abaqus_vumat_f64(&block, std::ptr::null_mut(), 0) };
    println!("came back with {status}");
}

/// It never crosses into the solver.
#[test]
fn a_panic_in_a_law_ends_the_job_with_its_message() {
    let test = ["own_law::a_panic_in_a_law", "--exact", "--ignored", "--nocapture"];
    let output = Command::new(std::env::current_exe().expect("this program")).args(test).output().expect("it runs");
    let [stdout, stderr] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    assert!(stderr.contains("the law has no formula"), "{stdout}{stderr}");
    assert!(!stdout.contains("came back"), "{stdout}{stderr}");
    #[cfg(unix)]
    assert_eq!(std::os::unix::process::ExitStatusExt::signal(&output.status), Some(libc::SIGABRT));
}
