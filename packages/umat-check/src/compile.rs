//! From a subroutine's source to a library that is loaded, by whatever compiler there is.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::diagnose::{self, Warnings};
use super::work_dir;
use toron_shared::error::Error;
use toron_shared::toml_file::is_standard_input;

/// The routines of Abaqus that subroutines call.
const UTILITIES: &str = include_str!("utilities.c");

/// Writes the counts of lines to their files: the child ends in a way in which that is not done.
const COUNTS: &str = "void __gcov_dump(void);\nvoid toron_counts_(void) { __gcov_dump(); }\n";

/// What Abaqus's own include files say, as far as a subroutine sees it. It is valid in fixed and in free form.
const PARAMETERS: &str = "      implicit real*8(a-h,o-z)\n      parameter (nprecd=2)\n";
const SINGLE: &str = "      implicit real*4(a-h,o-z)\n      parameter (j_sys_Dimension=2, maxblk=512)\n";
const DOUBLE: &str = "      implicit real*8(a-h,o-z)\n      parameter (j_sys_Dimension=2, maxblk=512)\n";
const FOR_C: &str = "#define FOR_NAME(small, capital) small##_\n#define CDECL\n";

/// Lines of a compiler's messages that are shown.
const SHOWN: usize = 20;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Language {
    FixedForm,
    FreeForm,
    C,
    Cpp,
    /// A library that is loaded as it is.
    Library,
}

/// The flags with which gfortran reads a source.
#[derive(Clone, Copy, Debug)]
struct Form {
    flags: &'static [&'static str],
    /// Its name in the report.
    said: &'static str,
}

const fn form(flags: &'static [&'static str], said: &'static str) -> Form {
    Form { flags, said }
}

/// In this order, until one compiles: what Abaqus's compiler takes comes first. `-fdec` is the dialect that it has from
/// DEC. A leading tab counts for less there than here, so that lines may be too long.
const FIXED_FORMS: [Form; 5] = [
    form(&["-ffixed-form", "-ffixed-line-length-132"], ""),
    form(&["-ffixed-form", "-ffixed-line-length-132", "-fdec"], ""),
    form(&["-ffixed-form", "-ffixed-line-length-none", "-fdec"], ""),
    form(&["-ffixed-form", "-ffixed-line-length-72", "-fdec"], ", in lines of 72 columns; Abaqus's have 132"),
    form(
        &["-ffree-form", "-ffree-line-length-none", "-fdec"],
        ", as free form, which Abaqus takes with !DIR$ FREEFORM or -free",
    ),
];
const FREE_FORMS: [Form; 2] = [
    form(&["-ffree-form", "-ffree-line-length-none"], ""),
    form(&["-ffree-form", "-ffree-line-length-none", "-fdec"], ""),
];
/// Of other compilers and languages.
const NO_FORM: [Form; 1] = [form(&[], "")];

/// What a library is built for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Variant {
    Plain,
    /// With checks at run time.
    Checked,
    /// With counts of each line.
    Counted,
}

impl Variant {
    fn library(self) -> &'static str {
        match self {
            Variant::Plain => "law.so",
            Variant::Checked => "checked.so",
            Variant::Counted => "counted.so",
        }
    }
}

/// What a file became.
pub struct Built {
    pub library: PathBuf,
    /// The same with checks at run time, where the compiler has them.
    pub checked: Option<PathBuf>,
    /// The same with counts of each line, where the compiler has them.
    pub counted: Option<PathBuf>,
    /// By which compiler.
    pub by: String,
    pub warnings: Warnings,
    form: Form,
}

/// Compiles the file into the folder, or takes it as it is.
///
/// # Errors
/// It cannot be read, its kind is not known, there is no compiler, or it does not compile.
pub fn compile(file: &Path, folder: &Path) -> Result<Built, Error> {
    let language = language(file)?;
    let file = file.canonicalize().map_err(|error| Error::Input(format!("{}: {error}", file.display())))?;
    work_dir::furnish(folder, &file)?;
    if language == Language::Library {
        let by = "loaded as it is".to_string();
        return Ok(Built {
            library: file,
            checked: None,
            counted: None,
            by,
            warnings: Warnings::default(),
            form: NO_FORM[0],
        });
    }
    includes(folder).map_err(|error| Error::Input(format!("{}: {error}", folder.display())))?;
    let compiler = compiler(language)?;
    let utilities = folder.join("utilities.o");
    let mut command = Command::new("gcc");
    command.args(["-c", "-O1", "-fPIC", "-w"]).arg(folder.join("utilities.c")).arg("-o").arg(&utilities);
    run(&mut command, "utilities.c")?;
    let mut command = Command::new("gcc");
    command.args(["-c", "-fPIC"]).arg(folder.join("counts.c")).arg("-o").arg(folder.join("counts.o"));
    run(&mut command, "counts.c")?;
    let build = |variant, form| build(&file, language, compiler, folder, &utilities, variant, form);
    let fortran = compiler == "gfortran";
    let forms: &[Form] = match language {
        Language::FixedForm if fortran => &FIXED_FORMS,
        Language::FreeForm if fortran => &FREE_FORMS,
        _ => &NO_FORM,
    };
    let (first, others) = forms.split_first().ok_or_else(|| Error::Input("no form is known".to_string()))?;
    let (library, form) = match build(Variant::Plain, *first) {
        Ok(library) => (library, *first),
        // What is said is of the form that it should have.
        Err(error) => {
            let other =
                others.iter().find_map(|form| build(Variant::Plain, *form).ok().map(|library| (library, *form)));
            other.ok_or(error)?
        }
    };
    // Where the checks do not compile there is no second build, which is said.
    let checked = fortran.then(|| build(Variant::Checked, form).ok()).flatten();
    let counts = ["gfortran", "gcc", "g++"].contains(&compiler);
    let counted = counts.then(|| build(Variant::Counted, form).ok()).flatten();
    let warnings = if fortran { warnings(&file, folder, form) } else { Warnings::default() };
    Ok(Built { library, checked, counted, by: format!("{compiler}{}", form.said), warnings, form })
}

/// What gfortran warns of, in the form in which it reads the source.
fn warnings(file: &Path, folder: &Path, form: Form) -> Warnings {
    let mut command = Command::new("gfortran");
    including(&mut command, file, folder);
    command.args(["-fsyntax-only", "-cpp", "-std=legacy", "-fallow-argument-mismatch"]).args(diagnose::FLAGS);
    command.args(form.flags).args(["-x", "f95"]).arg(file);
    let messages = command.output().map(|output| String::from_utf8_lossy(&output.stderr).to_string());
    let columns = form.flags.iter().find_map(|flag| flag.strip_prefix("-ffixed-line-length-")?.parse().ok());
    Warnings::read(file, &messages.unwrap_or_default(), columns)
}

impl Built {
    /// The variables that gfortran sees used before they are set, with their lines.
    pub fn used_unset(&self, file: &Path, folder: &Path) -> Vec<String> {
        let Ok(file) = file.canonicalize() else { return Vec::new() };
        let mut command = Command::new("gfortran");
        including(&mut command, &file, folder);
        command.args(["-c", "-O1", "-cpp", "-std=legacy", "-fallow-argument-mismatch", "-frecursive"]);
        command.args(["-Wuninitialized", "-Wmaybe-uninitialized", "-fdiagnostics-plain-output"]).args(self.form.flags);
        command.arg("-x").arg("f95").arg(&file).arg("-o").arg(folder.join("unset.o"));
        let messages = command.output().map(|output| String::from_utf8_lossy(&output.stderr).to_string());
        unset_in(&messages.unwrap_or_default())
    }

    /// The same for single precision, where the source leaves it to `vaba_param.inc`; inside, why it does not compile
    /// so.
    ///
    /// # Errors
    /// Files cannot be read or written.
    pub fn single(&self, file: &Path, folder: &Path) -> Result<Option<Result<PathBuf, String>>, Error> {
        let language = language(file)?;
        if !matches!(language, Language::FixedForm | Language::FreeForm) {
            return Ok(None);
        }
        let error = |error: std::io::Error| Error::Input(format!("{}: {error}", file.display()));
        let text = String::from_utf8_lossy(&std::fs::read(file).map_err(error)?).to_lowercase();
        if !text.contains("vaba_param.inc") {
            return Ok(None);
        }
        let inner = folder.join("single");
        std::fs::create_dir_all(&inner).map_err(error)?;
        includes(&inner).map_err(error)?;
        for name in ["vaba_param.inc", "VABA_PARAM.INC"] {
            std::fs::write(inner.join(name), SINGLE).map_err(error)?;
        }
        std::os::unix::fs::symlink(work_dir::in_either_case(folder), work_dir::in_either_case(&inner))
            .map_err(error)?;
        let file = file.canonicalize().map_err(error)?;
        let compiler = compiler(language)?;
        let utilities = folder.join("utilities.o");
        let library = build(&file, language, compiler, &inner, &utilities, Variant::Plain, self.form);
        Ok(Some(library.map_err(|error| error.to_string())))
    }
}

/// `file.f:12:5: Warning: 'x' is used uninitialized` as `x (line 12)`, each variable once.
fn unset_in(messages: &str) -> Vec<String> {
    let mut found: Vec<(String, String)> = Vec::new();
    for message in messages.lines() {
        let Some((place, warning)) = message.split_once(": Warning: ") else { continue };
        let line = place.rsplit(':').nth(1);
        let name = warning.split(['\'', '‘', '’']).nth(1).filter(|_| warning.contains("uninitialized"));
        if let (Some(line), Some(name)) = (line, name)
            && !found.iter().any(|(known, _)| known == name)
        {
            found.push((name.to_string(), format!("{name} (line {line})")));
        }
    }
    found.into_iter().map(|(_, said)| said).collect()
}

fn including(command: &mut Command, file: &Path, folder: &Path) {
    command.current_dir(folder).arg("-I").arg(folder);
    if let Some(beside) = file.parent() {
        command.arg("-I").arg(beside);
    }
    command.arg("-I").arg(work_dir::in_either_case(folder));
}

fn language(file: &Path) -> Result<Language, Error> {
    let name = file.display();
    let ending = file.extension().and_then(OsStr::to_str).unwrap_or_default().to_lowercase();
    let language = match ending.as_str() {
        "f" | "for" | "ftn" | "f77" => {
            let text = std::fs::read(file).map_err(|error| Error::Input(format!("{name}: {error}")))?;
            if free_form(&String::from_utf8_lossy(&text)) { Language::FreeForm } else { Language::FixedForm }
        }
        "f90" | "f95" | "f03" | "f08" => Language::FreeForm,
        "c" => Language::C,
        "cpp" | "cc" | "cxx" => Language::Cpp,
        "so" | "dylib" => Language::Library,
        _ if is_standard_input(file) => {
            let allowed = "a file; the standard input may be the materials, --scene -";
            return Err(Error::Input(format!("the subroutine is {name}; allowed: {allowed}")));
        }
        _ => {
            let allowed = "Fortran (.f .for .f90 …), C (.c), C++ (.cpp .cc), a shared library (.so)";
            return Err(Error::Input(format!("{name} ends in \"{ending}\"; allowed: {allowed}")));
        }
    };
    match std::fs::metadata(file) {
        Ok(_) => Ok(language),
        Err(error) => Err(Error::Input(format!("{name}: {error}"))),
    }
}

/// By the directive of Intel's compiler, which Abaqus uses.
fn free_form(text: &str) -> bool {
    text.lines().any(|line| {
        let line = line.trim().to_lowercase();
        let directive = line.strip_prefix(['!', 'c', '*']).and_then(|line| line.strip_prefix("dir$"));
        directive.is_some_and(|directive| directive.trim().starts_with("freeform") || directive.trim() == "free")
    })
}

fn includes(folder: &Path) -> std::io::Result<()> {
    for (name, text) in [
        ("aba_param.inc", PARAMETERS),
        ("aba_param_dp.inc", PARAMETERS),
        ("vaba_param.inc", DOUBLE),
        ("vaba_param_dp.inc", DOUBLE),
        ("vaba_param_sp.inc", SINGLE),
        ("smaaspusersubroutines.hdr", ""),
    ] {
        std::fs::write(folder.join(name), text)?;
        std::fs::write(folder.join(name.to_uppercase()), text)?;
    }
    std::fs::write(folder.join("SMAAspUserSubroutines.hdr"), "")?;
    for name in ["aba_for_c.h", "omi_for_c.h"] {
        std::fs::write(folder.join(name), FOR_C)?;
    }
    std::fs::write(folder.join("counts.c"), COUNTS)?;
    std::fs::write(folder.join("utilities.c"), UTILITIES)
}

fn compiler(language: Language) -> Result<&'static str, Error> {
    let known: &[&str] = match language {
        Language::C => &["gcc", "cc", "clang"],
        Language::Cpp => &["g++", "c++", "clang++"],
        _ => &["gfortran", "ifx", "ifort"],
    };
    let there = |name: &&&str| Command::new(name).arg("--version").output().is_ok();
    known
        .iter()
        .find(there)
        .copied()
        .ok_or_else(|| Error::Input(format!("no compiler is found; wanted: one of {} in PATH", known.join(", "))))
}

fn build(
    file: &Path,
    language: Language,
    compiler: &str,
    folder: &Path,
    utilities: &Path,
    variant: Variant,
    form: Form,
) -> Result<PathBuf, Error> {
    let library = folder.join(variant.library());
    let mut command = Command::new(compiler);
    command.args(["-shared", "-fPIC", "-g"]);
    including(&mut command, file, folder);
    translating(&mut command, language, compiler, variant, form);
    // Compilers know fewer endings than there are, and one in capitals as another.
    match (language, compiler) {
        (Language::C, _) => command.args(["-x", "c"]),
        (Language::Cpp, _) => command.args(["-x", "c++"]),
        (_, "gfortran") => command.args(["-x", "f95"]),
        _ => command.arg("-Tf"),
    };
    command.arg(file);
    if compiler != "ifx" && compiler != "ifort" {
        command.args(["-x", "none"]);
    }
    if variant == Variant::Counted {
        command.arg(folder.join("counts.o"));
    }
    command.arg(utilities).args(["-Wl,-z,lazy", "-o"]).arg(&library).args(["-lm", "-lpthread"]);
    run(&mut command, &file.display().to_string())?;
    Ok(library)
}

/// The flags of a language and of what is built.
fn translating(command: &mut Command, language: Language, compiler: &str, variant: Variant, form: Form) {
    let level = if variant == Variant::Plain { "-O2" } else { "-O0" };
    if variant == Variant::Counted {
        command.arg("--coverage");
    }
    match (language, compiler) {
        (Language::C, _) => {
            command.args([level, "-w"]);
        }
        (Language::Cpp, _) => {
            command.args([level, "-w", "-std=c++17"]);
        }
        (_, "gfortran") => {
            // Without -frecursive large local arrays are static, and threads would fail for no fault of the law.
            command.args(["-std=legacy", "-fallow-argument-mismatch", "-frecursive", "-w", "-cpp"]);
            command.arg(level);
            if variant == Variant::Checked {
                command.args(["-fcheck=all,no-array-temps", "-finit-real=snan", "-finit-integer=-77777777"]);
                command.arg("-fno-backtrace");
            }
            command.args(form.flags);
        }
        _ => {
            command.args(["-O2", "-auto", "-fpp", "-extend-source", "132", "-w"]);
            command.arg(if language == Language::FreeForm { "-free" } else { "-fixed" });
        }
    }
}

fn run(command: &mut Command, what: &str) -> Result<(), Error> {
    let program = command.get_program().to_string_lossy().to_string();
    let output = command.output().map_err(|error| Error::Input(format!("{program}: {error}")))?;
    if output.status.success() {
        return Ok(());
    }
    let messages = String::from_utf8_lossy(&output.stderr);
    let shown: Vec<&str> = messages.lines().filter(|line| !line.trim().is_empty()).take(SHOWN).collect();
    Err(Error::Input(format!("{what} does not compile with {program}:\n{}", shown.join("\n"))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_form_of_the_source_is_known() {
        assert!(free_form("!DIR$ FREEFORM\n"));
        assert!(free_form("      subroutine a\n!dir$ freeform\n"));
        assert!(!free_form("C     a comment about !DIR$ FREEFORM\n"));
    }

    #[test]
    fn variables_that_are_not_set_are_named_once() {
        let messages = "/x/a.f:12:72: Warning: 'd0' is used uninitialized [-Wuninitialized]\n\
                        /x/a.f:20:9: Warning: ‘d0’ may be used uninitialized [-Wmaybe-uninitialized]\n\
                        /x/a.f:21:9: Warning: unused variable 'k' [-Wunused]\n\
                        /x/a.f:7:1: note: 'e' was declared here\n";
        assert_eq!(unset_in(messages), ["d0 (line 12)"]);
    }
}
