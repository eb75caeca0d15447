//! Languages, compilers and their flags.

use std::ffi::OsStr;
use std::path::Path;
use std::process::Command;

use toron_shared::error::Error;
use toron_shared::toml_file::is_standard_input;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    FixedForm,
    FreeForm,
    C,
    Cpp,
    /// A library that is loaded as it is.
    Library,
}

impl Language {
    pub fn is_fortran(self) -> bool {
        matches!(self, Language::FixedForm | Language::FreeForm)
    }
}

/// The flags with which gfortran reads a source.
#[derive(Clone, Copy, Debug)]
pub struct Form {
    pub flags: &'static [&'static str],
    /// Its name in the report.
    pub said: &'static str,
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
pub const NO_FORM: [Form; 1] = [form(&[], "")];

/// What a library is built for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variant {
    Plain,
    /// With checks at run time.
    Checked,
    /// The same, with zeros in the place of what the first is filled with.
    Zeroed,
    /// With counts of each line.
    Counted,
}

impl Variant {
    pub fn library(self) -> &'static str {
        match self {
            Variant::Plain => "law.so",
            Variant::Checked => "checked.so",
            Variant::Zeroed => "zeroed.so",
            Variant::Counted => "counted.so",
        }
    }
}

/// Whose flags a compiler has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    Gnu,
    Intel,
    Flang,
}

/// A compiler's command.
#[derive(Clone, Debug)]
pub struct Compiler {
    pub command: String,
    pub family: Family,
}

impl Compiler {
    /// The first one that there is, or of Fortran the one that is named.
    ///
    /// # Errors
    /// There is none.
    pub fn of(language: Language, named: Option<&str>) -> Result<Compiler, Error> {
        let known: &[&str] = match language {
            Language::C => &["gcc", "cc", "clang"],
            Language::Cpp => &["g++", "c++", "clang++"],
            _ => &["gfortran", "ifx", "ifort", "flang", "flang-new"],
        };
        let there = |name: &&str| Command::new(name).arg("--version").output().is_ok();
        let found = match named.filter(|_| language.is_fortran()) {
            Some(named) => there(&named).then_some(named).ok_or_else(|| format!("--fc {named} is no command in PATH")),
            None => known
                .iter()
                .copied()
                .find(there)
                .ok_or_else(|| format!("no compiler is found; wanted: one of {} in PATH", known.join(", "))),
        };
        let command = found.map_err(Error::Input)?;
        let name = Path::new(command).file_name().map_or(command.into(), OsStr::to_string_lossy);
        let family = match name {
            name if name.contains("flang") => Family::Flang,
            name if name.contains("ifx") || name.contains("ifort") => Family::Intel,
            _ => Family::Gnu,
        };
        Ok(Compiler { command: command.to_string(), family })
    }

    pub fn is_gfortran(&self, language: Language) -> bool {
        language.is_fortran() && self.family == Family::Gnu
    }

    /// The forms in which it may read a source, the one that it should have first.
    pub fn forms(&self, language: Language) -> &'static [Form] {
        match language {
            Language::FixedForm if self.family == Family::Gnu => &FIXED_FORMS,
            Language::FreeForm if self.family == Family::Gnu => &FREE_FORMS,
            _ => &NO_FORM,
        }
    }

    /// The flags of a language and of what is built.
    pub fn translating(&self, command: &mut Command, language: Language, variant: Variant, form: Form) {
        let level = if variant == Variant::Plain { "-O2" } else { "-O0" };
        if variant == Variant::Counted {
            command.arg("--coverage");
        }
        let free = language == Language::FreeForm;
        match (language, self.family) {
            (Language::C, _) => {
                command.args([level, "-w"]);
            }
            (Language::Cpp, _) => {
                command.args([level, "-w", "-std=c++17", "-I/usr/include/eigen3"]);
            }
            (_, Family::Gnu) => {
                // Without -frecursive large local arrays are static, and threads would fail for no fault of the law.
                command.args(["-std=legacy", "-fallow-argument-mismatch", "-frecursive", "-w", "-cpp", level]);
                let filled: &[&str] = match variant {
                    Variant::Checked => &["-finit-real=snan", "-finit-integer=-77777777", "-finit-logical=true"],
                    Variant::Zeroed => &["-finit-real=zero", "-finit-integer=0", "-finit-logical=false"],
                    Variant::Plain | Variant::Counted => &[],
                };
                if !filled.is_empty() {
                    command.args(["-fcheck=all,no-array-temps", "-fno-backtrace"]).args(filled);
                }
                command.args(form.flags);
            }
            (_, Family::Intel) => {
                command.args(["-O2", "-auto", "-fpp", "-extend-source", "132", "-w"]);
                command.arg(if free { "-free" } else { "-fixed" });
            }
            (_, Family::Flang) => {
                command.args(["-O2", "-cpp", "-w"]);
                command.args(if free { &["-ffree-form"][..] } else { &["-ffixed-form", "-ffixed-line-length=132"] });
            }
        }
    }

    /// The source: compilers know fewer endings than there are, and one in capitals as another.
    pub fn source(&self, command: &mut Command, language: Language, file: &Path) {
        match (language, self.family) {
            (Language::C, _) => command.args(["-x", "c"]),
            (Language::Cpp, _) => command.args(["-x", "c++"]),
            (_, Family::Gnu) => command.args(["-x", "f95"]),
            (_, Family::Flang) => command.args(["-x", "f95-cpp-input"]),
            (_, Family::Intel) => command.arg("-Tf"),
        };
        command.arg(file);
        if self.family != Family::Intel {
            command.args(["-x", "none"]);
        }
    }
}

/// # Errors
/// The file's ending is not known, or it cannot be read.
pub fn language(file: &Path) -> Result<Language, Error> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_form_of_the_source_is_known() {
        assert!(free_form("!DIR$ FREEFORM\n"));
        assert!(free_form("      subroutine a\n!dir$ freeform\n"));
        assert!(!free_form("C     a comment about !DIR$ FREEFORM\n"));
    }
}
