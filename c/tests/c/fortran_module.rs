//! The committed Fortran module is what the C header says today. `TORON_WRITE_HEADER=1 cargo test` writes it anew.

use std::fmt::Write;
use std::path::Path;

use toron::law::status;

/// Pointers to one value; all others are to arrays.
const SCALARS: [&str; 11] =
    ["row", "block", "density", "wave_speed", "status", "sse", "pnewdt", "failel", "bulk", "shear", "least"];

const PREFACE: &str = "\
! toron: the interface of toron.h for Fortran 2018. Generated from that header: do not edit.
!
! The header says what every function does and returns; numbers, orders and units are the same. What may be null there
! may be left out here, by the name of the argument. Names and messages are C strings: end them with c_null_char. Status
! codes are toron_status_... and the interface's number toron_module_abi_version: in C, some differ from a function by
! case alone.
module toron
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_float, c_int, c_int32_t, c_null_ptr, c_ptr, c_size_t
  implicit none
";

/// The header without comments.
fn without_comments(header: &str) -> String {
    let parts = header.split("/*").enumerate();
    parts.map(|(i, part)| if i == 0 { part } else { part.split_once("*/").map_or("", |(_, code)| code) }).collect()
}

/// One C declaration of a variable: its type, whether it is a pointer, its name, the length of an array.
struct Variable<'a> {
    kind: &'a str,
    constant: bool,
    pointer: bool,
    name: &'a str,
    length: Option<&'a str>,
}

impl<'a> Variable<'a> {
    fn parse(declaration: &'a str) -> Self {
        let declaration = declaration.trim();
        let plain = declaration.strip_prefix("const ");
        let (kind, name) = plain.unwrap_or(declaration).rsplit_once(' ').expect("type name");
        let (name, length) = match name.trim_start_matches('*').strip_suffix(']').and_then(|n| n.split_once('[')) {
            Some((name, length)) => (name, Some(length)),
            None => (name.trim_start_matches('*'), None),
        };
        Variable { kind, constant: plain.is_some(), pointer: declaration.contains('*'), name, length }
    }

    fn fortran_type(&self) -> String {
        match self.kind {
            "double" | "float" => format!("real(c_{})", self.kind),
            "int32_t" | "size_t" | "int" => format!("integer(c_{})", self.kind),
            "char" => "character(kind=c_char)".into(),
            name => format!("type({name})"),
        }
    }

    fn component(&self) -> String {
        let length = self.length.map(|n| format!("({n})")).unwrap_or_default();
        let name = self.name;
        if self.pointer {
            format!("    type(c_ptr) :: {name} = c_null_ptr\n")
        } else {
            // What a caller may leave out has a value that means so.
            let default = if name == "level" { " = toron_level_best" } else { "" };
            format!("    {} :: {name}{length}{default}\n", self.fortran_type())
        }
    }

    fn argument(&self) -> String {
        let scalar = SCALARS.contains(&self.name);
        let (kind, name) = (self.fortran_type(), self.name);
        match (self.pointer, self.constant) {
            (false, _) => format!("      {kind}, value :: {name}\n"),
            (true, constant) => format!(
                "      {kind}, intent({}), optional :: {name}{}\n",
                if constant { "in" } else { "inout" },
                if scalar { "" } else { "(*)" }
            ),
        }
    }
}

/// `parameter`s for the lines `#define NAME value`.
fn constants(header: &str) -> String {
    let mut text = String::new();
    for line in header.lines().filter_map(|line| line.strip_prefix("#define TORON_")) {
        if let Some((name, value)) = line.split_once(' ') {
            let name = name.to_lowercase();
            let code = status::TABLE.iter().any(|row| row.1 == name && row.0.to_string() == value);
            let group = match (code, name.as_str()) {
                (true, _) => "status_",
                (_, "abi_version") => "module_",
                _ => "",
            };
            writeln!(text, "  integer(c_int32_t), parameter :: toron_{group}{name} = {value}").expect("a string");
        }
    }
    text
}

/// Derived types for `typedef struct { … } name;`.
fn types(header: &str) -> String {
    let mut text = String::new();
    for part in header.split("typedef struct {").skip(1) {
        let (fields, rest) = part.split_once('}').expect("}");
        let name = rest.split(';').next().expect(";").trim();
        let fields: String = fields
            .split(';')
            .filter(|field| !field.trim().is_empty())
            .fold(String::new(), |text, f| text + &Variable::parse(f).component());
        write!(text, "\n  type, bind(c) :: {name}\n{fields}  end type\n").expect("a string");
    }
    text
}

/// An interface for `type name(arguments);`.
fn function(declaration: &str) -> String {
    let (head, arguments) = declaration.trim_end_matches(')').split_once('(').expect("(");
    let result = Variable::parse(head);
    let kind = if result.pointer { "type(c_ptr)".into() } else { result.fortran_type() };
    let arguments: Vec<_> = arguments.split(',').filter(|a| *a != "void").map(Variable::parse).collect();
    let names: Vec<_> = arguments.iter().map(|argument| argument.name).collect();
    let lines: Vec<_> = names.chunks(6).map(|line| line.join(", ")).collect();
    let name = result.name;
    format!(
        "\n    function {name}({}) bind(c)\n      import\n{}      {kind} :: {name}\n    end function\n",
        lines.join(", &\n        "),
        arguments.iter().map(Variable::argument).collect::<String>(),
    )
}

fn generated() -> String {
    let header = include_str!("../../../include/toron.h");
    let header = without_comments(header);
    let functions =
        header.split("extern \"C\" {").nth(1).and_then(|text| text.split_once("#endif")).expect("functions").1;
    let functions: String =
        functions.split_inclusive(';').filter_map(|part| part.strip_suffix(';')).map(function).collect();
    format!(
        "{PREFACE}\n{}{}\n  interface\n{}\n  end interface\nend module\n",
        constants(&header),
        types(&header),
        functions.trim_end().trim_start_matches('\n')
    )
}

#[test]
fn the_committed_module_is_current() {
    let path = Path::new(crate::library::ROOT).join("include/toron.f90");
    let generated = generated();
    if std::env::var_os("TORON_WRITE_HEADER").is_some() {
        std::fs::write(&path, &generated).expect("include/toron.f90 is writable");
    }
    assert!(
        std::fs::read_to_string(&path).expect("include/toron.f90") == generated,
        "include/toron.f90 is not current: run TORON_WRITE_HEADER=1 cargo test -p toron-c fortran_module"
    );
}

#[test]
fn every_exported_function_is_in_the_module() {
    let module = generated();
    let sources = [
        include_str!("../../src/about.rs"),
        include_str!("../../src/tables.rs"),
        include_str!("../../src/points.rs"),
        include_str!("../../src/tangents.rs"),
        include_str!("../../src/blocks.rs"),
        include_str!("../../src/linear_elastic.rs"),
        include_str!("../../src/abaqus.rs"),
        include_str!("../../src/lsdyna.rs"),
    ];
    let exported = sources.iter().flat_map(|source| source.split("extern \"C\" fn ").skip(1));
    let mut count = 0;
    for name in exported.filter_map(|rest| rest.split('(').next()) {
        assert!(module.contains(&format!("    function {name}(")), "{name}");
        count += 1;
    }
    assert_eq!(count, module.matches("end function").count());
}
