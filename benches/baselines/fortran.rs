//! The Fortran baselines, compiled when the benchmark starts, each with the flags that its row names.

use std::ffi::c_int;
use std::path::{Path, PathBuf};
use std::process::Command;

use libloading::Library;
use toron_materials::bench::scene::Scene;
use toron_materials::entries::hosts::OnePoint;

const SOURCES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/baselines");
const BUILD: &str = env!("CARGO_TARGET_TMPDIR");

/// One Fortran routine: the name of its row, file, symbol and flags, and the vectors that the compiler must report.
struct Routine {
    name: &'static str,
    file: &'static str,
    symbol: &'static str,
    flags: &'static [&'static str],
    vectors: Option<&'static str>,
}

const V3: &[&str] = &["-Ofast", "-fopenmp-simd", "-march=x86-64-v3"];
const V4: &[&str] = &["-Ofast", "-fopenmp-simd", "-march=x86-64-v4", "-mprefer-vector-width=512"];
const WIDTHS: [Option<&str>; 2] = [Some("32 byte vectors"), Some("64 byte vectors")];

const ROUTINES: [Routine; 5] = [
    Routine {
        name: "Fortran Eq. 4.14, scalar",
        file: "literal",
        symbol: "literal_point",
        flags: &["-O3"],
        vectors: None,
    },
    Routine {
        name: "Fortran Eq. 4.14, loop v3",
        file: "literal_loop",
        symbol: "literal_block",
        flags: V3,
        vectors: WIDTHS[0],
    },
    Routine {
        name: "Fortran Eq. 4.14, loop v4",
        file: "literal_loop",
        symbol: "literal_block",
        flags: V4,
        vectors: WIDTHS[1],
    },
    Routine {
        name: "Fortran spatial, loop v3",
        file: "spatial_loop",
        symbol: "spatial_block",
        flags: V3,
        vectors: WIDTHS[0],
    },
    Routine {
        name: "Fortran spatial, loop v4",
        file: "spatial_loop",
        symbol: "spatial_block",
        flags: V4,
        vectors: WIDTHS[1],
    },
];

type PointRoutine = unsafe extern "C" fn(*const f64, *const f64, *mut f64, *mut f64, *mut c_int);
type BlockRoutine =
    unsafe extern "C" fn(c_int, c_int, *const f64, *const f64, *mut f64, *mut f64, *mut f64, *mut f64, *mut c_int);

/// A routine, loaded.
#[derive(Clone, Copy)]
enum Loaded {
    Point(PointRoutine),
    Block(BlockRoutine),
}

/// A Fortran row.
#[derive(Clone)]
pub struct Fortran {
    pub name: String,
    pub flags: String,
    routine: Loaded,
}

/// The compiler's name and version; `None` where there is none.
pub fn compiler() -> Option<String> {
    let output = Command::new("gfortran").arg("--version").output().ok()?;
    Some(String::from_utf8_lossy(&output.stdout).lines().next()?.to_string())
}

/// The rows that this processor can run, each compiled when it is asked for, or what the compiler or the loader says;
/// the first one evaluates a point.
pub fn rows() -> impl Iterator<Item = Result<Fortran, String>> {
    ROUTINES.iter().filter(|routine| runs(routine.flags)).map(load)
}

#[cfg(target_arch = "x86_64")]
fn runs(flags: &[&str]) -> bool {
    let has_v3 = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
    let has_v4 = is_x86_feature_detected!("avx512vl")
        && is_x86_feature_detected!("avx512bw")
        && is_x86_feature_detected!("avx512cd")
        && is_x86_feature_detected!("avx512dq");
    (!flags.contains(&"-march=x86-64-v3") || has_v3) && (!flags.contains(&"-march=x86-64-v4") || has_v4)
}

#[cfg(not(target_arch = "x86_64"))]
fn runs(flags: &[&str]) -> bool {
    flags.iter().all(|flag| !flag.starts_with("-march"))
}

fn load(routine: &Routine) -> Result<Fortran, String> {
    let (library, messages) = compile(routine)?;
    let vectorised = routine.vectors.is_none_or(|width| messages.contains(width));
    let name = format!("{}{}", routine.name, if vectorised { "" } else { " (NOT vectorised)" });
    let fault = |error: libloading::Error| error.to_string();
    // SAFETY: our own code, without initialisers; the routine has the signature that its type says.
    let loaded = unsafe {
        let library = Library::new(library).map_err(fault)?;
        let loaded = match routine.vectors {
            None => Loaded::Point(*library.get(routine.symbol).map_err(fault)?),
            Some(_) => Loaded::Block(*library.get(routine.symbol).map_err(fault)?),
        };
        // It stays loaded for good.
        std::mem::forget(library);
        loaded
    };
    Ok(Fortran { name, flags: routine.flags.join(" "), routine: loaded })
}

/// Compiles a routine; returns the shared library and what the vectoriser reported.
fn compile(routine: &Routine) -> Result<(PathBuf, String), String> {
    let build = Path::new(BUILD).join(routine.name.replace(|c: char| !c.is_ascii_alphanumeric(), "_"));
    let (object, library) = (build.with_extension("o"), build.with_extension("so"));
    let source = Path::new(SOURCES).join(routine.file).with_extension("f90");
    let mut compile = Command::new("gfortran");
    compile.args(["-c", "-fPIC", "-fopt-info-vec"]).args(routine.flags).arg(source).arg("-o").arg(&object);
    let messages = run(&mut compile)?;
    // Linked without the flags: -Ofast would switch off subnormal numbers in the whole process.
    run(Command::new("gfortran").args(["-shared", "-o"]).arg(&library).arg(&object).args(["-lmvec", "-lm"]))?;
    Ok((library, messages))
}

fn run(command: &mut Command) -> Result<String, String> {
    let output = command.output().map_err(|error| format!("gfortran: {error}"))?;
    let messages = String::from_utf8_lossy(&output.stderr).into_owned();
    if output.status.success() { Ok(messages) } else { Err(format!("gfortran: {messages}")) }
}

impl Fortran {
    /// Whether it evaluates the scene's points one by one, not its arrays.
    pub fn by_point(&self) -> bool {
        matches!(self.routine, Loaded::Point(_))
    }

    /// Evaluates a scene.
    pub fn run(&self, properties: &[f64], scene: &mut Scene<f64>) {
        match self.routine {
            Loaded::Point(routine) => {
                for OnePoint { deformation_gradient, stress, state, status } in &mut scene.points {
                    let (properties, f) = (properties.as_ptr(), deformation_gradient.as_ptr());
                    // SAFETY: eleven properties, nine numbers of F by columns, six of the stress, eleven state
                    // variables.
                    unsafe { routine(properties, f, stress.as_mut_ptr(), state.as_mut_ptr(), status) };
                }
            }
            Loaded::Block(routine) => {
                let size = |n: usize| c_int::try_from(n).expect("a number of points");
                // SAFETY: the scene's arrays have the columns that the routine declares.
                unsafe {
                    routine(
                        size(scene.n),
                        size(scene.leading_dimension),
                        properties.as_ptr(),
                        scene.deformation_gradient.as_ptr(),
                        scene.stress.as_mut_ptr(),
                        scene.energies.as_mut_ptr(),
                        scene.invariants.as_mut_ptr(),
                        scene.failure.as_mut_ptr(),
                        scene.status.as_mut_ptr(),
                    );
                }
            }
        }
    }
}
