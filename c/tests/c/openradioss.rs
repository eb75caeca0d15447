//! OpenRadioss's two ways in: the library that it loads by itself, in programs that call it as starter and engine do,
//! and the shims for its SDK. The solver itself is not run.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::c_programs::PRECISIONS;
use toron_test_support::library::{LIBRARY, ROOT, SYSTEM, folder, run};

/// The self-loading library of each precision.
const SHARED: [&str; 2] = ["libtoron_openradioss.so", "libtoron_openradioss_sp.so"];

/// Compiles a program of `ffi-tests/openradioss`, whose own routines a library finds as it finds the solver's.
fn compile(name: &str, options: &[&str]) -> PathBuf {
    let program = folder(&format!("openradioss-{name}{}", options.concat())).join("program");
    let mut gcc = Command::new("gcc");
    gcc.args(["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O1", "-rdynamic"]).args(options);
    gcc.arg(format!("-I{ROOT}/include")).arg(Path::new(ROOT).join(format!("ffi-tests/openradioss/{name}.c")));
    run(gcc.arg(LIBRARY.join("libtoron.a")).args(SYSTEM).arg("-o").arg(&program), "gcc");
    program
}

/// Every symbol is bound when the library is loaded, as Linux distributions link by default: nothing of the engine may
/// be wanted in the starter.
#[test]
fn self_loading_library() {
    for (options, library) in PRECISIONS.into_iter().zip(SHARED) {
        for name in ["starter", "engine"] {
            let program = compile(name, options);
            let mut command = Command::new(&program);
            command.current_dir(program.parent().expect("its folder")).env("LD_BIND_NOW", "1");
            run(command.arg(LIBRARY.join(library)), "");
        }
    }
}

/// A model that is wrong ends the run with a message and the solver's code where the solver's own routine is not found.
#[test]
fn without_the_solvers_routines() {
    let program = folder("openradioss-alone").join("program");
    let source = program.with_extension("c");
    let text = "#include <dlfcn.h>\n\
        int main(int argc, char **argv)\n\
        {\n\
            void *library = dlopen(argv[argc - 1], RTLD_NOW);\n\
            void (*call)(void);\n\
            *(void **)&call = library ? dlsym(library, \"eng_ruser_\") : 0;\n\
            if (call)\n\
                call();\n\
            return 0;\n\
        }\n";
    std::fs::write(&source, text).expect("a source");
    run(Command::new("gcc").arg(&source).arg("-ldl").arg("-o").arg(&program), "gcc");
    let output = Command::new(&program).arg(LIBRARY.join(SHARED[0])).output().expect("it runs");
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("toron: the model has a user spring; this library has materials of solids alone"), "{text}");
}
