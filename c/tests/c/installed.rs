//! The installed library in projects outside the repository: C by pkg-config, C++ and Fortran by CMake.

use std::path::{Path, PathBuf};
use std::process::Command;

use toron_test_support::library::{INSTALLED, ROOT, folder, run};

/// A copy of a project, and the installed tree moved to where nothing was installed.
fn project(name: &str) -> (PathBuf, PathBuf) {
    let (source, to) = (Path::new(ROOT).join("ffi-tests/installed").join(name), folder(&format!("project-{name}")));
    std::fs::remove_dir_all(&to).and_then(|()| std::fs::create_dir(&to)).expect("an empty folder");
    for file in std::fs::read_dir(source).expect("a project") {
        let file = file.expect("a file");
        std::fs::copy(file.path(), to.join(file.file_name())).expect("a copy");
    }
    let moved = to.join("moved");
    run(Command::new("cp").arg("-a").arg(&*INSTALLED).arg(&moved), "coreutils");
    (to, moved)
}

fn text(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).expect("UTF-8")
}

#[test]
fn c_by_pkg_config() {
    let (project, tree) = project("c");
    let pkg_config = |arguments: &[&str]| {
        let mut command = Command::new("pkg-config");
        let output = run(command.env("PKG_CONFIG_PATH", tree.join("lib/pkgconfig")).args(arguments), "pkg-config");
        text(output.stdout).split_whitespace().map(str::to_owned).collect::<Vec<_>>()
    };
    let compile = |program: &str, options: &[String]| {
        let mut gcc = Command::new("gcc");
        gcc.args(["-std=c11", "-Wall", "-Wextra", "-Werror"]).arg(project.join("point.c")).args(options);
        run(gcc.arg("-o").arg(project.join(program)), "gcc");
    };
    compile("shared", &pkg_config(&["--cflags", "--libs", "toron"]));
    // The shared library is found by the name that it gives itself.
    let mut program = Command::new(project.join("shared"));
    let output = run(program.env("LD_LIBRARY_PATH", tree.join("lib")), "");
    assert_eq!(text(output.stdout), "1598.596 MPa\n");
    std::fs::remove_file(tree.join("lib/libtoron.so")).expect("the name for linking");
    run(Command::new(project.join("shared")).env("LD_LIBRARY_PATH", tree.join("lib")), "");

    compile("static", &pkg_config(&["--cflags", "--libs", "--static", "toron"]));
    std::fs::remove_dir_all(&tree).expect("the tree");
    assert_eq!(text(run(&mut Command::new(project.join("static")), "").stdout), "1598.596 MPa\n");
}

fn cmake(project: &Path, tree: &Path) -> PathBuf {
    let build = project.join("build");
    let mut cmake = Command::new("cmake");
    cmake.arg("-S").arg(project).arg("-B").arg(&build);
    run(cmake.arg(format!("-DCMAKE_PREFIX_PATH={}", tree.display())), "cmake");
    run(Command::new("cmake").arg("--build").arg(&build), "cmake");
    build
}

#[test]
fn cpp_by_cmake() {
    let (project, tree) = project("cpp");
    let build = cmake(&project, &tree);
    for program in ["shared", "static", "plain"] {
        run(&mut Command::new(build.join(program)), "");
    }
    // A later version than the installed one is not found.
    let list = project.join("CMakeLists.txt");
    let demanding = std::fs::read_to_string(&list).expect("CMakeLists.txt").replace("toron 0.1 ", "toron 99 ");
    std::fs::write(&list, demanding).expect("CMakeLists.txt");
    let mut again = Command::new("cmake");
    again.arg("-S").arg(&project).arg("-B").arg(project.join("again"));
    let output = again.arg(format!("-DCMAKE_PREFIX_PATH={}", tree.display())).output().expect("cmake runs");
    assert!(!output.status.success(), "version 99 has been found");
}

#[test]
fn fortran_by_cmake() {
    let (project, tree) = project("fortran");
    let build = cmake(&project, &tree);
    let output = run(&mut Command::new(build.join("point")), "");
    assert_eq!(text(output.stdout), "1598.596 MPa\n");
}
