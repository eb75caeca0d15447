//! A call that ended the process, in a file, and its repetition.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::call::Call;
use super::child::{self, ChildReply, Task};
use super::compile::{self, Options};
use super::driver;
use super::finding::Question;
use super::guarded::Guard;
use super::material::Material;
use toron_shared::console::print;
use toron_shared::error::Error;
use toron_shared::run_directory::{RunDirectory, Writes};
use toron_shared::toml_file;

/// What is needed to repeat a call.
pub struct Repeated {
    pub file: PathBuf,
    pub options: Options,
    pub material: Material,
    pub guard: Guard,
    pub call: Call,
}

/// What the files of a law's calls are called, without their ending.
fn name(file: &Path, question: Question) -> String {
    let stem = file.file_stem().map_or("law".into(), |stem| stem.to_string_lossy());
    format!("{stem}-{}", question.name())
}

/// What the wrapper is called, without its ending.
fn name_of_wrapper(file: &Path) -> String {
    let stem = file.file_stem().map_or("law".into(), |stem| stem.to_string_lossy());
    format!("{stem}-wrapper")
}

/// Writes `NAME-wrapper` with the law's own ending into the folder, under its lock.
///
/// # Errors
/// It cannot be written, or the files there are another law's.
pub fn write_wrapper(output: &Path, file: &Path, text: &str) -> Result<PathBuf, Error> {
    let _directory = RunDirectory::lock(output, writes(file))?.claim()?;
    let ending = file.extension().unwrap_or_default();
    let path = output.join(format!("{}.{}", name_of_wrapper(file), ending.display()));
    std::fs::write(&path, text).map_err(|error| Error::Input(format!("{}: {error}", path.display())))?;
    Ok(path)
}

/// What a check of this law may write.
pub fn writes(file: &Path) -> Writes<'_> {
    let names = Question::all().map(|question| name(file, question)).chain([name_of_wrapper(file)]).collect();
    Writes { command: "check", files: vec![file], names, ..Writes::default() }
}

/// As it is written. Numbers are text: they need not be finite.
#[derive(Serialize, Deserialize)]
struct Written {
    file: PathBuf,
    #[serde(default)]
    options: Options,
    material: Material,
    #[serde(alias = "fence")]
    guard: Guard,
    arguments: Vec<(String, Vec<String>)>,
}

impl Repeated {
    /// Writes `NAME-LINE.json` into the folder, under its lock, and if asked `NAME-LINE.f90`, the call as a program,
    /// with the routines that Abaqus has in `NAME-LINE.c`.
    ///
    /// # Errors
    /// It cannot be written, or the files there are another law's.
    pub fn write(&self, output: &Path, question: Question, as_program: bool) -> Result<PathBuf, Error> {
        let _directory = RunDirectory::lock(output, writes(&self.file))?.claim()?;
        let path = output.join(format!("{}.json", name(&self.file, question)));
        let error = |reason: String| Error::Input(format!("{}: {reason}", path.display()));
        let arguments = self.call.named().map(|(name, numbers)| {
            (name.to_string(), numbers.iter().map(|number| format!("{number:e}")).collect::<Vec<_>>())
        });
        let written = Written {
            file: self.file.canonicalize().map_err(|reason| error(reason.to_string()))?,
            options: self.options.clone(),
            material: self.material.clone(),
            guard: self.guard,
            arguments: arguments.to_vec(),
        };
        let text = serde_json::to_string_pretty(&written).map_err(|reason| error(reason.to_string()))?;
        std::fs::write(&path, text).map_err(|reason| error(reason.to_string()))?;
        let sources = self.options.with.iter().chain([&self.file]);
        let law = sources.map(|path| path.display().to_string()).collect::<Vec<_>>().join(" ");
        if let Some(program) = driver::driver(&self.call, &self.material, &law).filter(|_| as_program) {
            for (ending, text) in [("f90", program.as_str()), ("c", compile::UTILITIES)] {
                std::fs::write(path.with_extension(ending), text).map_err(|reason| error(reason.to_string()))?;
            }
        }
        Ok(path)
    }

    /// # Errors
    /// It cannot be read, or is no such file.
    pub fn read(path: &Path) -> Result<Repeated, Error> {
        let (name, text) = toml_file::read(path)?;
        let error = |reason: String| Error::Input(format!("{name}: {reason}"));
        let written: Written = serde_json::from_str(&text).map_err(|reason| error(reason.to_string()))?;
        let texts = written.arguments.iter().flat_map(|(_, numbers)| numbers);
        let numbers = texts.map(|text| text.parse().map_err(|_| error(format!("\"{text}\"; allowed: a number"))));
        let numbers: Vec<f64> = numbers.collect::<Result<_, _>>()?;
        let call = Call::from_numbers(&numbers).ok_or_else(|| error("arguments are missing".to_string()))?;
        let Written { file, options, material, guard, .. } = written;
        Ok(Repeated { file, options, material, guard, call })
    }

    /// Compiles the law again and repeats the call.
    ///
    /// # Errors
    /// The law does not compile, or the call ends the process again.
    pub fn run(&self, work_dir: &Path) -> Result<(), Error> {
        let built = compile::compile(&self.file, work_dir, &self.options)?;
        let numbers = self.call.numbers().into_iter().map(f64::to_bits).collect();
        match child::run_task(
            work_dir,
            &built.library,
            &self.material,
            Task::Call(numbers),
            self.guard,
            child::LONGEST_CALL,
        )? {
            Ok(ChildReply::Answer(lines)) => {
                for (name, numbers) in lines {
                    print(&format!("{name:<14}{numbers}\n"));
                }
                print(
                    "\nAlone the call ends well: if it did not before, that depends on the calls before it (a variable that is not \
                     set, SAVE, COMMON).\n",
                );
                Ok(())
            }
            Ok(_) => Err(Error::Evaluation("the call has no answer".to_string())),
            Err(ending) => Err(Error::Evaluation(format!("{}: {}", ending.kind, ending.text))),
        }
    }
}
