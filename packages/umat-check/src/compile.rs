//! From a subroutine's sources to a library that is loaded, by whatever compiler there is.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde::{Deserialize, Serialize};

use super::compiler::{Compiler, Form, Language, NO_FORM, Variant, language};
use super::diagnose::{self, Warnings};
use super::{sources, work_dir};
use toron_shared::error::Error;

/// The routines of Abaqus that subroutines call.
pub const UTILITIES: &str = include_str!("utilities.c");

/// What they are called, compiled, where the law is a library.
pub const LIBRARY_OF_UTILITIES: &str = "utilities.so";

/// Writes the counts of lines to their files: the child ends in a way in which that is not done.
const COUNTS: &str = "void __gcov_dump(void);\nvoid toron_counts_(void) { __gcov_dump(); }\n";

/// What Abaqus's own include files say, as far as a subroutine sees it. It is valid in fixed and in free form.
const PARAMETERS: &str = "      implicit real*8(a-h,o-z)\n      parameter (nprecd=2)\n";
const SINGLE: &str = "      implicit real*4(a-h,o-z)\n      parameter (j_sys_Dimension=2, maxblk=512)\n";
const DOUBLE: &str = "      implicit real*8(a-h,o-z)\n      parameter (j_sys_Dimension=2, maxblk=512)\n";
const FOR_C: &str = "#define FOR_NAME(small, capital) small##_\n#define CDECL\n";

/// Lines of a compiler's messages that are shown.
const SHOWN: usize = 20;

/// What is compiled along, and how.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Options {
    /// Further sources, in any order.
    pub with: Vec<PathBuf>,
    /// Where includes are looked for too.
    pub include: Vec<PathBuf>,
    /// Libraries, as `lapack`.
    pub link: Vec<String>,
    /// The compiler of Fortran.
    pub fortran: Option<String>,
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
    objects: Vec<PathBuf>,
    options: Options,
}

/// A source that is compiled, in a folder.
struct Job<'a> {
    file: &'a Path,
    language: Language,
    compiler: &'a Compiler,
    folder: &'a Path,
    options: &'a Options,
}

/// Compiles the file into the folder, or takes it as it is.
///
/// # Errors
/// It cannot be read, its kind is not known, there is no compiler, or it does not compile.
pub fn compile(file: &Path, folder: &Path, options: &Options) -> Result<Built, Error> {
    let language = language(file)?;
    let file = canonical(file)?;
    work_dir::furnish(folder, &file)?;
    let options = &Options {
        with: options.with.iter().map(|path| canonical(path)).collect::<Result<_, _>>()?,
        include: options.include.iter().map(|path| canonical(path)).collect::<Result<_, _>>()?,
        ..options.clone()
    };
    if language == Language::Library {
        library_of_utilities(folder);
        return Ok(Built {
            library: file,
            checked: None,
            counted: None,
            by: "loaded as it is".to_string(),
            warnings: Warnings::default(),
            form: NO_FORM[0],
            objects: Vec::new(),
            options: options.clone(),
        });
    }
    includes(folder).map_err(|error| Error::Input(format!("{}: {error}", folder.display())))?;
    for (name, flags) in [("utilities", &["-c", "-O1", "-fPIC", "-w"][..]), ("counts", &["-c", "-fPIC"])] {
        let mut command = Command::new("gcc");
        command.args(flags).arg(folder.join(format!("{name}.c"))).arg("-o").arg(folder.join(format!("{name}.o")));
        run(&mut command, name)?;
    }
    let compiler = &Compiler::of(language, options.fortran.as_deref())?;
    let job = Job { file: &file, language, compiler, folder, options };
    let others = sources::others(&file, &options.with)?;
    let objects = job.objects(&others)?;
    let (library, form) = job.in_some_form(|form| job.library(Variant::Plain, form, &objects))?;
    // Where the checks do not compile there is no second build, which is said.
    let gfortran = compiler.is_gfortran(language);
    let checked = gfortran.then(|| job.library(Variant::Checked, form, &objects).ok()).flatten();
    let counts = gfortran || ["gcc", "g++"].contains(&compiler.command.as_str());
    let counted = counts.then(|| job.library(Variant::Counted, form, &objects).ok()).flatten();
    let warnings = if gfortran { job.warnings(form) } else { Warnings::default() };
    let with = match others.len() {
        0 => String::new(),
        _ => format!(", with {}", others.iter().map(|path| name_of(path)).collect::<Vec<_>>().join(", ")),
    };
    let by = format!("{}{}{with}", compiler.command, form.said);
    Ok(Built { library, checked, counted, by, warnings, form, objects, options: options.clone() })
}

/// The routines of Abaqus for a law that is a library already; without a compiler of C they are not there, which is
/// said when one is called.
fn library_of_utilities(folder: &Path) {
    let (source, library) = (folder.join("utilities.c"), folder.join(LIBRARY_OF_UTILITIES));
    if std::fs::write(&source, UTILITIES).is_ok() {
        let mut command = Command::new("gcc");
        command.args(["-shared", "-O1", "-fPIC", "-w"]).arg(&source).arg("-o").arg(&library).args(["-lm", "-lpthread"]);
        // Without gcc there is nothing to do about it.
        run(&mut command, "utilities").unwrap_or_default();
    }
}

fn canonical(path: &Path) -> Result<PathBuf, Error> {
    path.canonicalize().map_err(|error| Error::Input(format!("{}: {error}", path.display())))
}

fn name_of(path: &Path) -> String {
    path.file_name().map_or(String::new(), |name| name.to_string_lossy().to_string())
}

impl Job<'_> {
    /// The objects of other sources, which are compiled in this order: modules before those that use them.
    fn objects(&self, others: &[PathBuf]) -> Result<Vec<PathBuf>, Error> {
        let mut objects = Vec::new();
        for (number, file) in others.iter().enumerate() {
            let language = language(file)?;
            let compiler = &Compiler::of(language, self.options.fortran.as_deref())?;
            let job = Job { file, language, compiler, ..*self };
            let object = self.folder.join(format!("other-{number}.o"));
            job.in_some_form(|form| {
                let mut command = Command::new(&compiler.command);
                command.args(["-c", "-fPIC", "-g"]);
                job.including(&mut command);
                compiler.translating(&mut command, language, Variant::Plain, form);
                compiler.source(&mut command, language, file);
                run(command.arg("-o").arg(&object), &file.display().to_string())
            })?;
            objects.push(object);
        }
        Ok(objects)
    }

    /// In the first form that compiles. Where none does, what is said is of the form with the fewest errors.
    fn in_some_form<T>(&self, build: impl Fn(Form) -> Result<T, Error>) -> Result<(T, Form), Error> {
        let mut fewest: Option<(usize, Error)> = None;
        for &form in self.compiler.forms(self.language) {
            match build(form) {
                Ok(built) => return Ok((built, form)),
                Err(error) => {
                    let count = error.to_string().matches("Error").count();
                    if fewest.as_ref().is_none_or(|(least, _)| count < *least) {
                        fewest = Some((count, error));
                    }
                }
            }
        }
        Err(fewest.map_or_else(|| Error::Input("no form is known".to_string()), |(_, error)| error))
    }

    fn library(&self, variant: Variant, form: Form, objects: &[PathBuf]) -> Result<PathBuf, Error> {
        let library = self.folder.join(variant.library());
        let mut command = Command::new(&self.compiler.command);
        command.args(["-shared", "-fPIC", "-g"]);
        self.including(&mut command);
        self.compiler.translating(&mut command, self.language, variant, form);
        self.compiler.source(&mut command, self.language, self.file);
        command.args(objects);
        if variant == Variant::Counted {
            command.arg(self.folder.join("counts.o"));
        }
        command.arg(self.folder.join("utilities.o")).args(["-Wl,-z,lazy", "-o"]).arg(&library);
        command.args(self.options.link.iter().map(|library| format!("-l{library}"))).args(["-lm", "-lpthread"]);
        run(&mut command, &self.file.display().to_string())?;
        Ok(library)
    }

    /// What gfortran warns of, in the form in which it reads the source.
    fn warnings(&self, form: Form) -> Warnings {
        let mut command = Command::new(&self.compiler.command);
        self.including(&mut command);
        command.args(["-fsyntax-only", "-cpp", "-std=legacy", "-fallow-argument-mismatch"]).args(diagnose::FLAGS);
        command.args(form.flags).args(["-x", "f95"]).arg(self.file);
        let messages = command.output().map(|output| String::from_utf8_lossy(&output.stderr).to_string());
        let columns = form.flags.iter().find_map(|flag| flag.strip_prefix("-ffixed-line-length-")?.parse().ok());
        Warnings::read(self.file, &messages.unwrap_or_default(), columns)
    }

    fn including(&self, command: &mut Command) {
        including(command, self.file, self.folder, self.options);
    }
}

fn including(command: &mut Command, file: &Path, folder: &Path, options: &Options) {
    command.current_dir(folder).arg("-I").arg(folder);
    for path in &options.include {
        command.arg("-I").arg(path);
    }
    if let Some(beside) = file.parent() {
        for path in sources::folders(beside) {
            command.arg("-I").arg(path);
        }
    }
    command.arg("-I").arg(work_dir::in_either_case(folder));
}

impl Built {
    /// Whether the source is read in free form.
    pub fn is_free(&self) -> bool {
        self.form.flags.contains(&"-ffree-form")
    }

    /// The variables that gfortran sees used before they are set, with their lines.
    pub fn used_unset(&self, file: &Path, folder: &Path) -> Vec<String> {
        let Ok(file) = file.canonicalize() else { return Vec::new() };
        let mut command = Command::new("gfortran");
        including(&mut command, &file, folder, &self.options);
        command.args(["-c", "-O2", "-cpp", "-std=legacy", "-fallow-argument-mismatch", "-frecursive"]);
        command.args(["-Wuninitialized", "-Wmaybe-uninitialized", "-fdiagnostics-plain-output"]).args(self.form.flags);
        command.arg("-x").arg("f95").arg(&file).arg("-o").arg(folder.join("unset.o"));
        let messages = command.output().map(|output| String::from_utf8_lossy(&output.stderr).to_string());
        unset_in(&messages.unwrap_or_default())
    }

    /// The build with checks, with zeros in the place of NaN in what is not set; none where the compiler has no such
    /// flags.
    pub fn zeroed(&self, file: &Path, folder: &Path) -> Option<PathBuf> {
        self.checked.as_ref()?;
        let (file, language) = (file.canonicalize().ok()?, language(file).ok()?);
        let compiler = &Compiler::of(language, self.options.fortran.as_deref()).ok()?;
        let job = Job { file: &file, language, compiler, folder, options: &self.options };
        job.library(Variant::Zeroed, self.form, &self.objects).ok()
    }

    /// The same for single precision, where the source leaves it to `vaba_param.inc`; inside, why it does not compile
    /// so.
    ///
    /// # Errors
    /// Files cannot be read or written.
    pub fn single(&self, file: &Path, folder: &Path) -> Result<Option<Result<PathBuf, String>>, Error> {
        let language = language(file)?;
        if !language.is_fortran() {
            return Ok(None);
        }
        let error = |error: std::io::Error| Error::Input(format!("{}: {error}", file.display()));
        let text = String::from_utf8_lossy(&std::fs::read(file).map_err(error)?).to_lowercase();
        let included = |line: &str| {
            line.trim_start().trim_start_matches('#').starts_with("include") && line.contains("vaba_param.inc")
        };
        if !text.lines().any(included) {
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
        std::fs::copy(folder.join("utilities.o"), inner.join("utilities.o")).map_err(error)?;
        let file = file.canonicalize().map_err(error)?;
        let compiler = &Compiler::of(language, self.options.fortran.as_deref())?;
        let job = Job { file: &file, language, compiler, folder: &inner, options: &self.options };
        let library = job.library(Variant::Plain, self.form, &self.objects);
        Ok(Some(library.map_err(|error| error.to_string())))
    }
}

/// `/a/file.f:12:5: Warning: 'x' is used uninitialized` as `x (file.f:12)`, each variable once.
fn unset_in(messages: &str) -> Vec<String> {
    let mut found: Vec<(String, String)> = Vec::new();
    for message in messages.lines() {
        let Some((place, warning)) = message.split_once(": Warning: ") else { continue };
        let line = place.rsplit_once(':').and_then(|(line, _)| line.rsplit('/').next());
        let name = warning.split(['\'', '‘', '’']).nth(1).filter(|_| warning.contains("uninitialized"));
        if let (Some(line), Some(name)) = (line, name)
            && !found.iter().any(|(known, _)| known == name)
        {
            found.push((name.to_string(), format!("{name} ({line})")));
        }
    }
    found.into_iter().map(|(_, said)| said).collect()
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

fn run(command: &mut Command, what: &str) -> Result<(), Error> {
    let program = command.get_program().to_string_lossy().to_string();
    let output = command.output().map_err(|error| Error::Input(format!("{program}: {error}")))?;
    if output.status.success() {
        return Ok(());
    }
    let messages = String::from_utf8_lossy(&output.stderr);
    let shown: Vec<&str> = messages.lines().filter(|line| !line.trim().is_empty()).take(SHOWN).collect();
    // What Intel's compilers take and gfortran does not: SIGN, MAX and others of two kinds.
    let kinds = messages.contains("must be the same type and kind") || messages.contains("must have the same kind");
    let hint = if kinds { "\nIntel's compilers take reals of two kinds here, and flang too: --fc COMMAND" } else { "" };
    Err(Error::Input(format!("{what} does not compile with {program}:\n{}{hint}", shown.join("\n"))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variables_that_are_not_set_are_named_once() {
        let messages = "/x/a.f:12:72: Warning: 'd0' is used uninitialized [-Wuninitialized]\n\
                        /x/a.f:20:9: Warning: ‘d0’ may be used uninitialized [-Wmaybe-uninitialized]\n\
                        /x/a.f:21:9: Warning: unused variable 'k' [-Wunused]\n\
                        /x/a.f:7:1: note: 'e' was declared here\n";
        assert_eq!(unset_in(messages), ["d0 (a.f:12)"]);
    }
}
