//! `toron check`: arguments, the questions in their order, and what follows from the answers.

use std::collections::BTreeMap;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;

use super::again::{self, Repeated};
use super::call::Call;
use super::child::{self, ChildReply, Ending, Task};
use super::ci;
use super::compile::{self, Built, Options};
use super::compiler::language;
use super::coverage;
use super::finding::{Finding, NOT_FINITE, Question, Verdict};
use super::guarded::Guard;
use super::input::{self, Input, Overrides};
use super::kept_properties;
use super::material::{DEFAULT_NAME, Material, Plane, Reads};
use super::noise;
use super::relate;
use super::report::{MaterialReport, Report};
use super::shared_memory;
use super::tangent;
use super::unset;
use super::work_dir::WorkDir;
use super::wrapper;
use toron_shared::console::{print, print_note};
use toron_shared::error::Error;
use toron_shared::run_directory::RunDirectory;
use toron_shared::toml_file;

#[derive(Args)]
pub struct Arguments {
    /// The subroutine: Fortran, C or C++, or a shared library with it.
    #[arg(required_unless_present_any = ["again", "schema"])]
    file: Option<PathBuf>,
    /// Further sources, in any order; files near FILE that have the modules it uses are found.
    #[arg(long, value_delimiter = ',')]
    with: Vec<PathBuf>,
    /// A folder of includes, beside those below FILE's.
    #[arg(short = 'I', long)]
    include: Vec<PathBuf>,
    /// A library that is linked, as lapack.
    #[arg(long, value_delimiter = ',')]
    link: Vec<String>,
    /// The compiler of Fortran, as ifx or flang.
    #[arg(long, value_name = "COMMAND")]
    fc: Option<String>,
    /// Ask the file's VUMAT, not its UMAT; where there is no UMAT this is not needed.
    #[arg(long)]
    vumat: bool,
    /// What a UMAT is called in a library, as that of CalculiX's *MATERIAL, NAME=@ABAQUSNL_LIBRARY_NAME.
    #[arg(long, conflicts_with = "vumat")]
    symbol: Option<String>,
    /// The library of the same VUMAT for single precision, where FILE is a library.
    #[arg(long, requires = "file")]
    single: Option<PathBuf>,
    /// Properties, states and traits, a TOML file; without it, FILE's name with .toml if that is there.
    #[arg(long)]
    scene: Option<PathBuf>,
    /// Print the JSON schema of that TOML file, by which editors complete, explain and check keys.
    #[arg(long, exclusive = true)]
    schema: bool,
    /// An input of Abaqus: PROPS, DEPVAR, DELETE, density, orientation, elements, initial stress of its user materials.
    #[arg(long)]
    inp: Option<PathBuf>,
    /// PROPS.
    #[arg(long, value_delimiter = ',', allow_hyphen_values = true)]
    props: Option<Vec<f64>>,
    /// NSTATV.
    #[arg(long)]
    statev: Option<usize>,
    /// NTENS: 6, 4 (plane strain, axisymmetric), 3 (plane stress), 2 (shells of revolution) or 1 (trusses).
    #[arg(long)]
    ntens: Option<usize>,
    /// Of cohesive elements with traction and separation, NTENS 3 or 2: the largest separation, as STRAN has it.
    #[arg(long)]
    separation: Option<f64>,
    /// What the law is: hyperelastic, dissipative, isotropic.
    #[arg(long, value_delimiter = ',')]
    traits: Option<Vec<String>>,
    /// CMNAME.
    #[arg(long)]
    name: Option<String>,
    /// Axes that turn with the material, as with *ORIENTATION.
    #[arg(long)]
    orientation: bool,
    /// Seed of the random states.
    #[arg(long)]
    seed: Option<u64>,
    /// Figures that are warnings and no failures, as in tangent=0.05.
    #[arg(long, value_delimiter = ',', value_parser = allowance)]
    allow: Vec<(String, f64)>,
    /// These lines alone, as in tangent,energy.
    #[arg(long, value_delimiter = ',', value_parser = question)]
    only: Vec<Question>,
    /// Only the lines that take next to no time: build, memory, rest, stress, expect, tangent, objectivity, repeat,
    /// outputs.
    #[arg(long, conflicts_with = "only")]
    quick: bool,
    /// Warnings fail too, and lines of the law that are never executed.
    #[arg(long)]
    strict: bool,
    /// An earlier report in JSON: what it has does not fail.
    #[arg(long)]
    baseline: Option<PathBuf>,
    /// Write the report as JUnit's XML.
    #[arg(long)]
    junit: Option<PathBuf>,
    /// Write the report as SARIF.
    #[arg(long)]
    sarif: Option<PathBuf>,
    /// Keep the worst call of a wrong tangent too, and each call as a program in Fortran.
    #[arg(long)]
    reproduce: bool,
    /// Write a UMAT that calls this one and returns DDSDDE by differences: NAME-wrapper, beside the calls.
    #[arg(long, conflicts_with_all = ["vumat", "symbol"])]
    wrapper: bool,
    /// Print the report as JSON.
    #[arg(long)]
    json: bool,
    /// Where calls that end the process are kept.
    #[arg(short, long, default_value = "toron-out/check")]
    output: PathBuf,
    /// Repeat the call of this file, which a check has written.
    #[arg(long, conflicts_with = "file")]
    again: Option<PathBuf>,
}

fn question(name: &str) -> Result<Question, String> {
    Question::parse(name).ok_or_else(|| format!("allowed: {}", Question::names()))
}

fn allowance(text: &str) -> Result<(String, f64), String> {
    let (name, figure) = text.split_once('=').ok_or("allowed: LINE=FIGURE, as in tangent=0.05")?;
    question(name)?;
    match figure.parse::<f64>() {
        Ok(figure) if figure > 0.0 && figure.is_finite() => Ok((name.to_string(), figure)),
        _ => Err(format!("{name} is {figure}; allowed: a finite number > 0")),
    }
}

/// Checks a law, and prints the report; `program` is the command that was called, for what can be called next.
///
/// # Errors
/// The input is invalid, or a line is wrong.
pub fn run(program: &str, arguments: &Arguments) -> Result<(), Error> {
    if arguments.schema {
        print(include_str!("../input.schema.json"));
        return Ok(());
    }
    let work_dir = WorkDir::new()?;
    if let Some(again) = &arguments.again {
        return Repeated::read(again)?.run(&work_dir.path);
    }
    let Some(file) = &arguments.file else { return Err(Error::Input("no file is named".to_string())) };
    let overrides = Overrides {
        properties: arguments.props.clone(),
        states: arguments.statev,
        components: arguments.ntens,
        separation: arguments.separation,
        plane: None,
        traits: arguments.traits.clone(),
        name: arguments.name.clone(),
        orientation: arguments.orientation,
        seed: arguments.seed,
        deck: arguments.inp.clone(),
    };
    let Input { mut materials, mut allowed } = input::input(file, arguments.scene.as_deref(), &overrides)?;
    allowed.extend(arguments.allow.iter().cloned());
    let options = Options {
        with: arguments.with.iter().map(|path| canonical(path)).collect::<Result<_, _>>()?,
        include: arguments.include.iter().map(|path| canonical(path)).collect::<Result<_, _>>()?,
        link: arguments.link.clone(),
        fortran: arguments.fc.clone(),
    };
    let built = match compile::compile(file, &work_dir.path, &options) {
        Ok(built) => built,
        Err(error) => {
            write_report(arguments, &not_built(file, &materials, &error))?;
            return Err(error);
        }
    };
    RunDirectory::check(&arguments.output, &again::writes(file))?;
    for material in &mut materials {
        material.symbol.clone_from(&arguments.symbol);
    }
    if arguments.vumat || arguments.symbol.is_none() && only_vumat(&built, &work_dir.path, materials.first())? {
        let single = match &arguments.single {
            Some(library) => Some(Ok(canonical(library)?)),
            None => built.single(file, &work_dir.path)?,
        };
        declare_vumat(single.as_ref(), &mut materials)?;
    } else if arguments.single.is_some() {
        return Err(Error::Input("single is for a VUMAT; allowed: with one, or with --vumat".to_string()));
    }
    if arguments.wrapper {
        write_wrapper(file, &built, &arguments.output)?;
    }
    let check =
        Check { file, built: &built, options: &options, work_dir: &work_dir.path, allowed: &allowed, arguments };
    let materials: Result<Vec<MaterialReport>, Error> =
        materials.iter().map(|material| check.check_material(material)).collect();
    let mut report = Report::new(&file.display().to_string(), materials?);
    report_to(program, arguments, &mut report)
}

/// Writes the law with DDSDDE by differences, and says where.
fn write_wrapper(file: &Path, built: &Built, output: &Path) -> Result<(), Error> {
    if !language(file)?.is_fortran() {
        return Err(Error::Input(format!("{}: allowed with --wrapper: Fortran", file.display())));
    }
    let path = again::write_wrapper(output, file, &wrapper::wrapper(file, built.is_free())?)?;
    print_note(&format!("{}: the law with DDSDDE by differences\n", path.display()));
    Ok(())
}

/// The report on a file that does not compile: of each material the line `build` alone.
fn not_built(file: &Path, materials: &[Material], error: &Error) -> Report {
    let line = Finding::new(Question::Build, Verdict::Wrong, None, error.to_string()).with("not built");
    let of = |material: &Material| MaterialReport { name: material.name.clone(), law: None, lines: vec![line.clone()] };
    let mut report = Report::new(&file.display().to_string(), materials.iter().map(of).collect());
    report.judge(false);
    report
}

/// Judges, writes and prints the report.
fn report_to(program: &str, arguments: &Arguments, report: &mut Report) -> Result<(), Error> {
    if let Some(baseline) = &arguments.baseline {
        let (name, text) = toml_file::read(baseline)?;
        let earlier = serde_json::from_str(&text).map_err(|error| Error::Input(format!("{name}: {error}")))?;
        report.mark_known(&earlier);
    }
    report.judge(arguments.strict);
    let failures = report.failures(arguments.strict);
    write_report(arguments, report)?;
    if !arguments.json {
        let colours = std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none();
        print(&report.as_text(program, colours));
    }
    if failures.is_empty() { Ok(()) } else { Err(Error::Evaluation(format!("{}: {failures}", report.file))) }
}

/// Writes the report for other tools, and prints it if that is asked in JSON.
fn write_report(arguments: &Arguments, report: &Report) -> Result<(), Error> {
    if let Some(path) = &arguments.junit {
        write(path, &ci::junit(report, arguments.strict))?;
    }
    if let Some(path) = &arguments.sarif {
        write(path, &json_text(&ci::sarif(report, arguments.strict))?)?;
    }
    if arguments.json {
        print(&json_text(report)?);
    }
    Ok(())
}

fn json_text(value: &impl serde::Serialize) -> Result<String, Error> {
    let text = serde_json::to_string_pretty(value).map_err(|error| Error::Input(error.to_string()))?;
    Ok(format!("{text}\n"))
}

fn write(path: &Path, text: &str) -> Result<(), Error> {
    std::fs::write(path, text).map_err(|error| Error::Input(format!("{}: {error}", path.display())))
}

/// Whether a library has a VUMAT and no UMAT; the child finds out, as it does everything else.
fn only_vumat(built: &Built, work_dir: &Path, material: Option<&Material>) -> Result<bool, Error> {
    let Some(material) = material else { return Ok(false) };
    let reply =
        child::run_task(work_dir, &built.library, material, Task::OnlyVumat, Guard::Padded, child::LONGEST_CALL)?;
    Ok(matches!(reply, Ok(ChildReply::OnlyVumat(true))))
}

/// A path that the child finds from where it runs.
fn canonical(path: &Path) -> Result<PathBuf, Error> {
    path.canonicalize().map_err(|error| Error::Input(format!("{}: {error}", path.display())))
}

/// Declares that a VUMAT is called, and where its build for single precision is.
fn declare_vumat(single: Option<&Result<PathBuf, String>>, materials: &mut [Material]) -> Result<(), Error> {
    for material in materials {
        if material.components < 4 {
            return Err(Error::Input(format!(
                "ntens is {}; allowed with a VUMAT: 6 (solids), 4 (plane strain, axisymmetric)",
                material.components
            )));
        }
        material.explicit.called = true;
        material.explicit.single = single.cloned();
    }
    Ok(())
}

/// How long a call may take once another has never returned.
const LONGEST_CALL_AFTER_HANG: Duration = Duration::from_secs(1);

/// A file that is checked.
struct Check<'a> {
    file: &'a Path,
    built: &'a Built,
    options: &'a Options,
    work_dir: &'a Path,
    allowed: &'a BTreeMap<String, f64>,
    arguments: &'a Arguments,
}

impl Check<'_> {
    /// Asks all questions about one material, in their order.
    fn check_material(&self, material: &Material) -> Result<MaterialReport, Error> {
        let mut material = material.clone();
        let mut findings = vec![self.built.warnings.line(&self.built.by, &material)];
        findings.extend(of_deck(&material));
        // With padding, since the law may need it; guard pages come with the questions.
        let reads =
            match self.run_task(&material, Task::Reads, Guard::Padded, &self.built.library, child::LONGEST_CALL)? {
                Ok(ChildReply::Reads(reads, across)) => {
                    if !across {
                        // A law that never sees a strain 33 is for plane strain.
                        material.plane = material.plane.or(Some(Plane::Strain));
                    }
                    // What follows from DFGRD1 alone is no law of small strain, whatever the job.
                    material.small_strain &= reads != Reads::Total;
                    Some(reads)
                }
                Ok(_) | Err(_) => None,
            };
        let explicit = material.explicit.called;
        let questions = if explicit { Question::OF_VUMAT } else { Question::ASKED };
        let asked = questions
            .iter()
            .copied()
            .filter(|question| self.arguments.only.is_empty() || self.arguments.only.contains(question))
            .filter(|question| !self.arguments.quick || question.is_quick());
        let mut guard = Guard::Behind;
        let mut ended: Vec<(String, Question)> = Vec::new();
        for question in asked {
            // A law that ends before it is known what it reads is not called with an inverted F.
            let unknown = if question == Question::Invalid { Reads::Rate } else { Reads::Mixed };
            let mut finding = self.ask(&material, question, reads.unwrap_or(unknown), guard, &mut ended)?;
            if question == Question::Memory && finding.verdict != Verdict::Right {
                guard = Guard::Padded;
            }
            if guard == Guard::Padded
                && matches!(question, Question::Repeat | Question::Threads)
                && finding.verdict == Verdict::Wrong
            {
                finding.text.push_str("; it may follow from what memory says");
            }
            let allowed = self.allowed.get(question.name()).copied();
            if let (Verdict::Wrong, Some(allowed), Some(figure)) = (finding.verdict, allowed, finding.figure)
                && figure <= allowed
            {
                finding.verdict = Verdict::Warning;
            }
            findings.push(finding);
        }
        relate::relate(&mut findings);
        Ok(MaterialReport {
            name: material.name.clone(),
            law: reads.map(|reads| reads.name().to_string()),
            lines: findings,
        })
    }

    fn run_task(
        &self,
        material: &Material,
        task: Task,
        guard: Guard,
        library: &Path,
        longest_call: Duration,
    ) -> Result<Result<ChildReply, Ending>, Error> {
        child::run_task(self.work_dir, library, material, task, guard, longest_call).map_err(|error| match error {
            Error::Input(text) => Error::Input(format!("{}: {text}", self.file.display())),
            other => other,
        })
    }

    /// The build that a question is asked of, or why there is none.
    fn library_of(&self, question: Question) -> Result<&Path, &'static str> {
        match question {
            Question::Runtime => self.built.checked.as_deref().ok_or("no second build with checks at run time"),
            Question::Coverage => self.built.counted.as_deref().ok_or("a library says nothing of its lines"),
            _ => Ok(&self.built.library),
        }
    }

    /// Runs a question's task in a child, twice for the memory, and makes a finding of how it ends.
    fn ask(
        &self,
        material: &Material,
        question: Question,
        reads: Reads,
        guard: Guard,
        ended: &mut Vec<(String, Question)>,
    ) -> Result<Finding, Error> {
        let library = match self.library_of(question) {
            Ok(library) => library,
            Err(text) => return Ok(Finding::new(question, Verdict::NotAsked, None, text)),
        };
        let task = Task::Question { question, reads, allowed: self.allowed.get(question.name()).copied() };
        let guards: &[Guard] = match question {
            Question::Memory => &[Guard::Behind, Guard::Before],
            // The compiler's own checks say more than a page that must not be touched.
            Question::Runtime | Question::Coverage => &[Guard::Padded],
            _ => &[guard],
        };
        // A law that has hung once is not waited for as long again.
        let hung = ended.iter().any(|(kind, _)| kind == "hang");
        let longest_call = if hung { LONGEST_CALL_AFTER_HANG } else { child::LONGEST_CALL };
        let mut answer = None;
        for &guard in guards {
            match self.run_task(material, task.clone(), guard, library, longest_call)? {
                Ok(ChildReply::Finding(mut finding)) => {
                    let few = finding.kinds.iter().any(|kind| kind == tangent::FEW_STATES);
                    let kept = finding.call_bits.take().filter(|_| few || self.arguments.reproduce);
                    if let Some(call) = kept.and_then(|bits| Call::from_bits(&bits)) {
                        finding.call = Some(self.keep_call(material, question, guard, call)?);
                    }
                    answer = Some(finding);
                }
                Ok(_) => {}
                Err(ending) if question.may_end() => {
                    let text = format!("the law does not answer: {}", ending.text);
                    return Ok(Finding::new(question, Verdict::NotAsked, None, text));
                }
                Err(ending) => return self.ending_as_finding(material, question, ending, guard, ended),
            }
        }
        let finding = answer.unwrap_or_else(|| Finding::new(question, Verdict::NotSure, None, "no answer"));
        let has = |kind: &str| finding.kinds.iter().any(|known| known == kind);
        Ok(match (question, finding.verdict) {
            (Question::Coverage, Verdict::Right) => coverage::of_counts(self.work_dir),
            (Question::Runtime, _) if has(NOT_FINITE) => self.with_unset(finding),
            (Question::Runtime, Verdict::Right) => self.with_zeros(material, finding, longest_call)?,
            (Question::Repeat, Verdict::Right) => {
                let mut run = |task: Task| self.run_task(material, task, guard, library, longest_call);
                kept_properties::kept_between_materials(&mut run, material)?.unwrap_or(finding)
            }
            (Question::Repeat | Question::Threads, Verdict::Wrong) => self.perhaps_unset(finding),
            (Question::Tangent, _) if has(noise::NOISE) => self.single_precision(finding),
            (Question::Objectivity, Verdict::Right) if !material.explicit.called && reads != Reads::Total => {
                self.at_large_turns(material, finding, guard, longest_call)?
            }
            _ => finding,
        })
    }

    /// What is not finite with unset reals, with the variables that gfortran sees unset.
    fn with_unset(&self, finding: Finding) -> Finding {
        let unset = self.built.used_unset(self.file, self.work_dir);
        let unset = if unset.is_empty() { String::new() } else { format!(": by gfortran {}", unset.join(", ")) };
        Finding { text: format!("{}{unset}", finding.text), ..finding }
    }

    /// The answers of the build that fills unset variables with NaN beside those of the same with zeros.
    fn with_zeros(&self, material: &Material, right: Finding, longest_call: Duration) -> Result<Finding, Error> {
        let (filled, zeroed) = (self.built.checked.as_deref(), self.built.zeroed(self.file, self.work_dir));
        let (Some(filled), Some(zeroed)) = (filled, zeroed) else { return Ok(right) };
        let answers = |library: &Path| {
            let reply = self.run_task(material, Task::Answers, Guard::Padded, library, longest_call)?;
            Ok(reply.ok().and_then(|reply| match reply {
                ChildReply::Bits(bits) => Some(bits),
                _ => None,
            }))
        };
        let (Some(filled), Some(zeroed)) = (answers(filled)?, answers(&zeroed)?) else { return Ok(right) };
        if filled == zeroed {
            return Ok(right);
        }
        let source = std::fs::read(self.file).unwrap_or_default();
        let saved = String::from_utf8_lossy(&source).to_uppercase().contains("SAVE");
        let named = self.built.used_unset(self.file, self.work_dir);
        let states = (!material.explicit.called).then_some(material.initial.len());
        Ok(unset::line(&filled, &zeroed, states, &named, saved).unwrap_or(right))
    }

    /// Answers that depend on order may be those of variables that are never set.
    fn perhaps_unset(&self, mut finding: Finding) -> Finding {
        let unset = self.built.used_unset(self.file, self.work_dir);
        if !unset.is_empty() {
            let shared = "variables are shared (SAVE, COMMON, DATA)";
            let named = format!("by gfortran {} used before it is set", unset.join(", "));
            finding.text = match finding.text.contains(shared) {
                true => finding.text.replace(shared, &format!("{named}, or {shared}")),
                false => format!("{}; {named}", finding.text),
            };
        }
        finding
    }

    /// Steps of the stress, where the source has variables of single precision, are theirs; a right tangent is right
    /// with others.
    fn single_precision(&self, mut finding: Finding) -> Finding {
        let places: Vec<String> =
            self.built.warnings.single.iter().map(|place| format!("{}: {}", place.named(), place.text)).collect();
        if places.is_empty() {
            if finding.verdict == Verdict::Right {
                finding.kinds.clear();
            }
            return finding;
        }
        let text = format!("single precision: {}; {}", places.join(", "), finding.text);
        Finding { verdict: Verdict::Wrong, kinds: vec![noise::SINGLE.to_string()], text, ..finding }
    }

    /// Turns of 90° in one increment: no solver has them, and a law that is right for small ones is only warned of.
    fn at_large_turns(
        &self,
        material: &Material,
        right: Finding,
        guard: Guard,
        longest_call: Duration,
    ) -> Result<Finding, Error> {
        let text = match self.run_task(material, Task::LargeTurns, guard, &self.built.library, longest_call)? {
            Ok(ChildReply::Finding(finding)) if finding.verdict == Verdict::Right => return Ok(finding),
            Ok(ChildReply::Finding(finding)) => finding.text,
            Ok(_) => return Ok(right),
            Err(ending) => ending.text,
        };
        let text = format!("right at turns of 5° an increment, not at larger ones: {text}");
        Ok(Finding::new(Question::Objectivity, Verdict::Warning, right.figure, text))
    }

    /// The finding where the law has ended the process. The same kind of end in a later question is not reported again.
    fn ending_as_finding(
        &self,
        material: &Material,
        question: Question,
        ending: Ending,
        guard: Guard,
        ended: &mut Vec<(String, Question)>,
    ) -> Result<Finding, Error> {
        let Ending { kind, text, call } = ending;
        if kind == "slow" {
            return Ok(Finding::new(question, Verdict::NotSure, None, text));
        }
        if let Some((_, first)) = ended.iter().find(|(known, _)| *known == kind) {
            let text = format!("ends as in {}", first.name());
            return Ok(Finding::new(question, Verdict::NotSure, None, text).with(&kind));
        }
        if question == Question::Invalid && kind == "XIT" {
            return Ok(Finding::new(question, Verdict::Right, None, text));
        }
        // No solver passes NaN or an inverted F for long.
        if question == Question::Invalid {
            return Ok(Finding::new(question, Verdict::Warning, None, text).with(&kind));
        }
        if let Some(array) = old_assumed_size(&text) {
            let text = format!(
                "{text}: if it is an argument, {array}(1) is the old way to write {array}(*), which hides the rest from this check"
            );
            return Ok(Finding::new(question, Verdict::Warning, None, text).with("assumed size"));
        }
        ended.push((kind.clone(), question));
        let of_the_question = kind == "runtime check"
            || matches!(question, Question::Threads | Question::Repeat | Question::Histories)
            || shared_memory::names().any(|array| kind.ends_with(array));
        let verdict = if of_the_question { Verdict::Wrong } else { Verdict::Ended };
        let hint = match kind.as_str() {
            "XIT" | "stop" if material.name == DEFAULT_NAME => {
                format!("; CMNAME is {DEFAULT_NAME} here: --name, if the law asks for it")
            }
            "behind STATEV" if material.deck.is_some() => format!("; *DEPVAR says {}", material.initial.len()),
            "behind PROPS" if material.deck.is_some() => format!("; CONSTANTS is {}", material.properties.len()),
            _ => String::new(),
        };
        let mut finding = Finding::new(question, verdict, None, format!("{text}{hint}")).with(&kind);
        // The build with checks at run time is not the one that repeats a call, and of threads no call is kept.
        if let Some(call) = call.filter(|_| !matches!(question, Question::Runtime | Question::Threads)) {
            finding.call = Some(self.keep_call(material, question, guard, call)?);
        }
        Ok(finding)
    }

    /// The file of a call, for `--again`.
    fn keep_call(&self, material: &Material, question: Question, guard: Guard, call: Call) -> Result<String, Error> {
        let repeated = Repeated {
            file: self.file.to_path_buf(),
            options: self.options.clone(),
            material: material.clone(),
            guard,
            call,
        };
        Ok(repeated.write(&self.arguments.output, question, self.arguments.reproduce)?.display().to_string())
    }
}

/// The line of an input of Abaqus, if there is one.
fn of_deck(material: &Material) -> Option<Finding> {
    let deck = material.deck.as_ref()?;
    if !material.remarks.is_empty() {
        let text = format!("{deck}: {}", material.remarks.join("; "));
        return Some(Finding::new(Question::Deck, Verdict::Wrong, None, text).with("numbers of the deck"));
    }
    let axes = if material.orientation { ", on axes that turn (*ORIENTATION, or no NLGEOM)" } else { "" };
    let text = format!(
        "{} constants, {} state variables, {} components{axes}",
        material.properties.len(),
        material.initial.len(),
        material.components
    );
    Some(Finding::new(Question::Deck, Verdict::Right, None, text))
}

/// The array of a message of gfortran's checks that has one entry by its declaration, and more by its use.
fn old_assumed_size(message: &str) -> Option<&str> {
    let (_, rest) = message.split_once(" of dimension 1 of array '")?;
    let (array, rest) = rest.split_once('\'')?;
    (rest.trim() == "above upper bound of 1").then_some(array)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_array_of_one_entry_is_told_from_a_true_bound() {
        let of =
            |bound: &str| format!("umat.f:17: Index '2' of dimension 1 of array 'props' above upper bound of {bound}");
        assert_eq!(old_assumed_size(&of("1")), Some("props"));
        assert_eq!(old_assumed_size(&of("12")), None);
    }
}
