//! The committed Fortran module is what the C header says today. `cargo xtask update headers` writes it
//! anew.

use std::fmt::Write;
use std::path::Path;
use std::process::Command;

use toron::law::status;

use toron_test_support::library::{LIBRARY, ROOT, SYSTEM, folder, run};
use toron_test_support::update::is_asked;

const PREFACE: &str = "\
! toron: the interface of toron.h for Fortran 2018. Generated from that header: do not edit.
!
! The header says what every function does and returns, and what the members of the structures are. In Fortran
! - a variable of a structure's type has its size set, and everything else is left out: set what is wanted, arrays by
!   c_loc, which needs their attribute target. Procedures of your own with such a structure among their arguments must
!   declare it a target too: a compiler may else not see that the arrays change;
! - names without _f64 and _f32 stand for both precisions: toron_hyperelastic_point(law, point);
! - texts are character strings. The last argument of every function that can fail may be left out; it is
!       character(toron_message_capacity) :: message
!   blank if there is no error, and cut off if the text is longer;
! - the number of values in an array, and the size of a structure, are not passed;
! - indices and points count from 0, as in C;
! - status codes are toron_status_..., and TORON_ABI_VERSION is toron_module_abi_version: in C, some names of constants
!   differ from those of functions by case alone.
!
! Every function returns a status code, 0 or negative; those that look up a count or an index return that, or a negative
! code.
module toron
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_f_pointer, c_float, c_int, c_int32_t, c_int64_t, &
    c_null_char, c_null_ptr, c_ptr, c_size_t, c_sizeof
  implicit none
  private :: room, end_message
";

/// The end of the module: the two functions that return a text, and what the others have in common.
const HELPERS: &str = "
  ! The version of the library.
  function toron_version() result(text)
    character(:), allocatable :: text
    character(kind=c_char), pointer :: characters(:)
    type(c_ptr) :: start
    interface
      function c_version() bind(c, name='toron_version') result(start)
        import
        type(c_ptr) :: start
      end function
      function c_length(start) bind(c, name='strlen') result(length)
        import
        type(c_ptr), value :: start
        integer(c_size_t) :: length
      end function
    end interface
    start = c_version()
    call c_f_pointer(start, characters, [c_length(start)])
    text = toron_text(characters)
  end function

  ! The meaning of a status code.
  function toron_status_message(status) result(text)
    integer(c_int32_t), intent(in) :: status
    character(:), allocatable :: text
    character(kind=c_char) :: message(toron_message_capacity)
    integer(c_int32_t) :: unknown
    interface
      function c_status_message(status, message, capacity) bind(c, name='toron_status_message') result(unknown)
        import
        integer(c_int32_t), value :: status
        character(kind=c_char), intent(inout) :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: unknown
      end function
    end interface
    ! An unknown code has a message too, which says so.
    unknown = c_status_message(status, message, size(message, kind=c_size_t))
    text = toron_text(message)
  end function

  ! The text in an array of characters that ends with a null, such as the name in a table's row.
  pure function toron_text(characters) result(text)
    character(kind=c_char), intent(in) :: characters(:)
    character(:), allocatable :: text
    integer :: length, i
    length = 0
    do while (length < size(characters))
      if (characters(length + 1) == c_null_char) exit
      length = length + 1
    end do
    allocate (character(length) :: text)
    do i = 1, length
      text(i:i) = characters(i)
    end do
  end function

  ! How many characters the library may write to a message.
  pure function room(message)
    character(*), intent(in), optional :: message
    integer(c_size_t) :: room
    room = 0
    if (present(message)) room = len(message, kind=c_size_t)
  end function

  ! Blanks a message from the null that the library ends it with, or all of it if there is no error.
  pure subroutine end_message(status, message)
    integer(c_int32_t), intent(in) :: status
    character(*), intent(inout), optional :: message
    if (.not. present(message)) return
    if (status < 0) then
      message(max(1, index(message, c_null_char)):) = ''
    else
      message = ''
    end if
  end subroutine
end module
";

/// These return a text, and are among the helpers.
const WRITTEN_BY_HAND: [&str; 2] = ["toron_version", "toron_status_message"];

/// The header without comments.
fn header() -> String {
    let parts = include_str!("../../../include/toron.h").split("/*").enumerate();
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
        let kind = kind.strip_prefix("struct ").unwrap_or(kind);
        Variable { kind, constant: plain.is_some(), pointer: declaration.contains('*'), name, length }
    }

    fn fortran_type(&self) -> String {
        match self.kind {
            "double" | "float" => format!("real(c_{})", self.kind),
            "int32_t" | "size_t" | "int" => format!("integer(c_{})", self.kind),
            "uint64_t" => "integer(c_int64_t)".into(),
            "char" => "character(kind=c_char)".into(),
            name => format!("type({name})"),
        }
    }

    /// Size and alignment of a structure's member where pointers have 64 bits; all structures are aligned to 8 bytes.
    fn layout(&self, sizes: &[(&str, usize)]) -> (usize, usize) {
        let one = match self.kind {
            _ if self.pointer => 8,
            "char" => 1,
            "float" | "int32_t" => 4,
            "double" | "size_t" | "uint64_t" => 8,
            name => sizes.iter().find(|row| row.0 == name).expect("a structure from above").1,
        };
        (one * self.length.map_or(1, |n| n.parse().expect("a number")), one.min(8))
    }

    /// A member of a structure of this size: by default, what it is where a caller leaves it out.
    fn member(&self, size: usize) -> String {
        let length = self.length.map(|n| format!("({n})")).unwrap_or_default();
        let default = match self.kind {
            _ if self.pointer => " = c_null_ptr".into(),
            "size_t" if self.name == "size" => format!(" = {size}"),
            "char" => " = c_null_char".into(),
            kind if kind.starts_with("toron_") => String::new(),
            _ => " = 0".into(),
        };
        let kind = if self.pointer { "type(c_ptr)".into() } else { self.fortran_type() };
        format!("    {kind} :: {}{length}{default}\n", self.name)
    }

    /// Whether a pointer may be null.
    fn optional(&self) -> &'static str {
        let may_be_null = ["ddsdde", "density", "direction", "fibre", "message", "ngl", "nodes", "second_axis", "spd"];
        if may_be_null.contains(&self.name) { ", optional" } else { "" }
    }

    /// `, target` for a structure with pointers: without it gfortran takes it that a call with an argument of
    /// `intent(in)` leaves what the structure's members point to as it is, and uses old values of the results.
    fn target(&self) -> &'static str {
        let has_pointers = ["_point_", "_block_", "_increment_", "_vumat_"].iter().any(|part| self.kind.contains(part));
        if has_pointers { ", target" } else { "" }
    }

    /// The shape of what a pointer points to.
    fn shape(&self) -> &'static str {
        match self.name {
            "density" | "sse" | "spd" | "pnewdt" | "failel" | "bulk" | "shear" | "least" => "",
            "nuparam" | "nuvar" if self.pointer => "",
            "direction" | "fibre" | "second_axis" => "(3)",
            "axes" => "(9)",
            _ if self.kind.starts_with("toron_") => "",
            _ => "(*)",
        }
    }

    /// The argument of the Fortran function, as attributes and name; `counted` if it is an array whose length C wants
    /// to know.
    fn dummy(&self, counted: bool, host: bool) -> (String, String) {
        let intent = match (self.pointer, self.constant) {
            (false, _) | (true, true) => "in",
            // The entries of hosts update their arrays; other functions update what structures point to.
            (true, false) if host && self.kind != "char" => "inout",
            (true, false) => "out",
        };
        let (kind, name, optional) = (self.fortran_type() + self.target(), self.name, self.optional());
        match self.kind {
            "char" => (format!("character(*), intent({intent}){optional}"), name.into()),
            _ if counted => (format!("{kind}, intent({intent}), contiguous"), format!("{name}(:)")),
            _ if self.pointer => (format!("{kind}, intent({intent}){optional}"), format!("{name}{}", self.shape())),
            _ => (format!("{kind}, intent(in)"), name.into()),
        }
    }

    /// The argument of the C function, as attributes and name.
    fn binding(&self) -> (String, String) {
        let (kind, name, optional) = (self.fortran_type() + self.target(), self.name, self.optional());
        match (self.pointer, self.constant) {
            (false, _) => (format!("{kind}, value"), name.into()),
            (true, true) => (format!("{kind}, intent(in){optional}"), format!("{name}{}", self.shape())),
            (true, false) => (format!("{kind}, intent(inout){optional}"), format!("{name}{}", self.shape())),
        }
    }
}

/// Code that ends in a list, as one line or, if it is too long, several.
fn listed(indent: usize, start: &str, items: &[String], end: &str) -> String {
    let (mut text, mut width) = (format!("{:indent$}{start}", ""), indent + start.len());
    let separators = (1..=items.len()).map(|i| if i < items.len() { ", " } else { end });
    for (item, separator) in items.iter().zip(separators) {
        if width + item.len() + separator.len() > 116 {
            text.truncate(text.trim_end().len());
            write!(text, " &\n{:1$}", "", indent + 2).expect("a string");
            width = indent + 2;
        }
        width += item.len() + separator.len();
        text = text + item + separator;
    }
    text + if items.is_empty() { end } else { "" } + "\n"
}

/// Declarations; neighbours with the same attributes share one.
fn declared(indent: usize, declarations: &[(String, String)]) -> String {
    let groups = declarations.chunk_by(|a, b| a.0 == b.0).map(|group| {
        let names: Vec<_> = group.iter().map(|declaration| declaration.1.clone()).collect();
        listed(indent, &format!("{} :: ", group[0].0), &names, "")
    });
    groups.collect()
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

/// Name and members of every `typedef struct name { … } name;`.
fn structures(header: &str) -> Vec<(&str, Vec<Variable<'_>>)> {
    let parts = header.split("typedef struct ").skip(1).map(|part| {
        let (members, rest) = part.split_once('{').and_then(|(_, part)| part.split_once('}')).expect("{ }");
        let members = members.split(';').filter(|member| !member.trim().is_empty()).map(Variable::parse);
        (rest.split(';').next().expect(";").trim(), members.collect())
    });
    parts.collect()
}

/// Derived types for the structures.
fn types(header: &str) -> String {
    let (mut text, mut sizes) = (String::new(), Vec::new());
    for (name, members) in structures(header) {
        let end = members.iter().fold(0_usize, |end, member| {
            let (size, alignment) = member.layout(&sizes);
            end.next_multiple_of(alignment) + size
        });
        let size = end.next_multiple_of(8);
        sizes.push((name, size));
        let members: String = members.iter().map(|member| member.member(size)).collect();
        writeln!(text, "\n  type, bind(c) :: {name}\n{members}  end type").expect("a string");
    }
    text
}

/// Name and arguments of every `type name(arguments);`.
fn functions(header: &str) -> Vec<(&str, Vec<Variable<'_>>)> {
    let text = header.split("extern \"C\" {").nth(1).and_then(|text| text.split_once("// __cplusplus"));
    let declarations =
        text.expect("functions").1.split_inclusive(';').filter_map(|part| part.trim_end().strip_suffix(");"));
    let functions = declarations.map(|declaration| {
        let (head, arguments) = declaration.split_once('(').expect("(");
        let arguments = arguments.split(',').filter(|a| *a != "void").map(Variable::parse);
        (Variable::parse(head).name, arguments.collect())
    });
    functions.collect()
}

/// Names that stand for both precisions of a function.
fn generic_names(names: &[&str]) -> String {
    let mut text = String::new();
    for generic in names.iter().filter_map(|name| name.strip_suffix("_f64")) {
        let both = ["_f64", "_f32"].map(|precision| format!("{generic}{precision}"));
        let both = both.iter().filter(|name| names.contains(&name.as_str())).map(String::as_str).collect::<Vec<_>>();
        let both = both.join(", ");
        writeln!(text, "\n  interface {generic}\n    procedure {both}\n  end interface").expect("a string");
    }
    text
}

/// A function with the arguments that Fortran has, which calls the one in C.
fn function(name: &str, arguments: &[Variable]) -> String {
    let host = ["toron_abaqus", "toron_lsdyna", "toron_openradioss"].iter().any(|start| name.starts_with(start));
    let (mut dummies, mut actuals) = (Vec::new(), Vec::new());
    for (i, argument) in arguments.iter().enumerate() {
        let before = if i > 0 { arguments[i - 1].name } else { "" };
        actuals.push(match (argument.kind, argument.name) {
            ("size_t", "capacity") => format!("room({before})"),
            ("size_t", "count") => format!("size({before}, kind=c_size_t)"),
            ("size_t", "size") => format!("c_sizeof({before})"),
            ("char", name) if !["message", "text"].contains(&name) => format!("trim({name}) // c_null_char"),
            (_, name) => name.into(),
        });
        if argument.kind != "size_t" {
            let counted = arguments.get(i + 1).is_some_and(|next| next.name == "count");
            dummies.push((argument.name, argument.dummy(counted, host)));
        }
    }
    let c = name.replacen("toron", "c", 1);
    let c_names: Vec<_> = arguments.iter().map(|argument| argument.name.to_string()).collect();
    let names: Vec<_> = dummies.iter().map(|dummy| dummy.0.to_string()).collect();
    let has_text = names.iter().any(|name| name == "text");
    let has_message = names.iter().any(|name| name == "message");
    let [result, bound] = [") result(status)".into(), format!(") bind(c, name='{name}') result(status)")];
    let lines = [
        "\n".into(),
        listed(2, &format!("function {name}("), &names, &result),
        declared(4, &dummies.into_iter().map(|dummy| dummy.1).collect::<Vec<_>>()),
        "    integer(c_int32_t) :: status\n    interface\n".into(),
        listed(6, &format!("function {c}("), &c_names, &bound),
        "        import\n".into(),
        declared(8, &arguments.iter().map(Variable::binding).collect::<Vec<_>>()),
        "        integer(c_int32_t) :: status\n      end function\n    end interface\n".into(),
        listed(4, &format!("status = {c}("), &actuals, ")"),
        if has_message { "    call end_message(status, message)\n" } else { "" }.into(),
        // A text is there whatever the status.
        if has_text { "    call end_message(-1_c_int32_t, text)\n" } else { "" }.into(),
        "  end function\n".into(),
    ];
    lines.concat()
}

fn generated() -> String {
    let header = header();
    let mut functions = functions(&header);
    functions.retain(|(name, _)| !WRITTEN_BY_HAND.contains(name));
    let names: Vec<_> = functions.iter().map(|(name, _)| *name).collect();
    let bodies: String = functions.iter().map(|(name, arguments)| function(name, arguments)).collect();
    let (constants, types, generic) = (constants(&header), types(&header), generic_names(&names));
    format!("{PREFACE}\n{constants}{types}{generic}\ncontains\n{bodies}{HELPERS}")
}

#[test]
fn the_committed_module_is_current() {
    let path = Path::new(ROOT).join("include/toron.f90");
    let generated = generated();
    if is_asked("headers") {
        std::fs::write(&path, &generated).expect("include/toron.f90 is writable");
    }
    assert!(
        std::fs::read_to_string(&path).expect("include/toron.f90") == generated,
        "include/toron.f90 is not current: cargo xtask update headers"
    );
    let long = generated.lines().find(|line| line.len() > 120);
    assert_eq!(long, None, "too long a line");
}

#[test]
fn every_exported_function_is_in_the_module() {
    let module = generated();
    let sources = [
        include_str!("../../functions/src/about.rs"),
        include_str!("../../functions/src/tables.rs"),
        include_str!("../../functions/src/hyperelastic.rs"),
        include_str!("../../functions/src/frictional.rs"),
        include_str!("../../functions/src/linear_elastic.rs"),
        include_str!("../../functions/src/abaqus.rs"),
        include_str!("../../functions/src/lsdyna.rs"),
        include_str!("../../functions/src/openradioss.rs"),
    ];
    let exported = sources.iter().flat_map(|source| source.split("extern \"C\" fn ").skip(1));
    let mut count = 0;
    for name in exported.filter_map(|rest| rest.split('(').next()) {
        assert!(module.contains(&format!("\n  function {name}(")), "{name}");
        assert!(module.contains(&format!("bind(c, name='{name}')")), "{name}");
        count += 1;
    }
    // And strlen.
    assert_eq!(count + 1, module.matches("bind(c, name=").count());
}

/// The two compilers agree on the size of every structure and on the offset of every member, and a structure's default
/// size is its size.
#[test]
fn layouts_are_those_of_c() {
    let header = header();
    let (mut c, mut fortran) = (String::new(), String::new());
    for (name, members) in structures(&header) {
        writeln!(c, "    sizeof({name}),").expect("a string");
        writeln!(fortran, "  block\n    type({name}), target :: x\n    call check('{name}', c_sizeof(x))")
            .expect("a string");
        if members[0].name == "size" {
            writeln!(c, "    sizeof({name}),").expect("a string");
            writeln!(fortran, "    call check('{name}, size by default', x%size)").expect("a string");
        }
        for Variable { name: member, .. } in members {
            writeln!(c, "    offsetof({name}, {member}),").expect("a string");
            writeln!(fortran, "    call check('{name}, {member}', offset(c_loc(x), c_loc(x%{member})))")
                .expect("a string");
        }
        fortran += "  end block\n";
    }
    let folder = folder("fortran-layouts");
    let [c_file, object, fortran_file, program] =
        ["layouts.c", "layouts.o", "layouts.f90", "program"].map(|f| folder.join(f));
    std::fs::write(&c_file, LAYOUTS_IN_C.replace("LAYOUTS", &c)).expect("a file");
    std::fs::write(&fortran_file, LAYOUTS_IN_FORTRAN.replace("LAYOUTS", &fortran)).expect("a file");
    run(Command::new("gcc").arg(format!("-I{ROOT}/include")).arg("-c").arg(&c_file).arg("-o").arg(&object), "gcc");
    let mut gfortran = Command::new("gfortran");
    gfortran.arg("-J").arg(&folder).arg(format!("{ROOT}/include/toron.f90")).arg(&fortran_file).arg(&object);
    run(gfortran.arg(LIBRARY.join("libtoron.a")).args(SYSTEM).arg("-o").arg(&program), "gfortran");
    run(&mut Command::new(program), "");
}

const LAYOUTS_IN_C: &str = "\
#include \"toron.h\"

static const size_t layouts[] = {
LAYOUTS};

size_t layout(int index)
{
    return layouts[index];
}
";

const LAYOUTS_IN_FORTRAN: &str = "\
program layouts
  use, intrinsic :: iso_c_binding
  use toron
  implicit none
  interface
    function layout(index) bind(c)
      import
      integer(c_int), value :: index
      integer(c_size_t) :: layout
    end function
  end interface
  integer(c_int) :: index
  logical :: wrong
  index = 0
  wrong = .false.
LAYOUTS  if (wrong) error stop 1
contains
  subroutine check(what, found)
    character(*), intent(in) :: what
    integer(c_size_t), intent(in) :: found
    if (found /= layout(index)) print *, what, ': ', found, ', in C ', layout(index)
    wrong = wrong .or. found /= layout(index)
    index = index + 1
  end subroutine
  function offset(start, member)
    type(c_ptr), intent(in) :: start, member
    integer(c_size_t) :: offset
    offset = transfer(member, offset) - transfer(start, offset)
  end function
end program
";
