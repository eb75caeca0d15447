//! The structures of the C interface are the same in Rust, in C and in C++: every member is where the compiler of the
//! library has it, and there is nothing between them.

use core::mem::offset_of;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

use toron::host::abaqus::Vumat;
use toron_c::{
    Block, FrictionalLaw, HyperelasticLaw, Layout, LinearBlock, LinearElasticLaw, LinearIncrement, LinearPoint, Point,
    TableRow,
};

use toron_test_support::library::{ROOT, folder, run};

/// What C has to agree to, and the names of the structures.
struct Assertions {
    text: String,
    names: BTreeSet<String>,
}

impl Assertions {
    fn add(&mut self, condition: &str, value: usize) {
        writeln!(self.text, "static_assert({condition} == {value}, \"\");").expect("a string");
    }
}

/// The size of a member.
fn size_of_member<S, M>(_: impl Fn(&S) -> &M) -> usize {
    size_of::<M>()
}

/// Asserts the place and the size of every member of a structure, and that these are all.
macro_rules! structure {
    ($assertions:expr, $c:expr, $structure:ty: $($member:ident)*) => {{
        let (assertions, c): (&mut Assertions, String) = ($assertions, $c.into());
        let mut end = 0;
        $(
            let (offset, size) = (offset_of!($structure, $member), size_of_member(|s: &$structure| &s.$member));
            let member = stringify!($member);
            assert_eq!(offset, end, "{c}.{member}: a member or padding before it");
            assertions.add(&format!("offsetof({c}, {member})"), offset);
            assertions.add(&format!("sizeof((({c} *)0)->{member})"), size);
            end += size;
        )*
        assert_eq!(end, size_of::<$structure>(), "{c}: a member or padding at its end");
        assertions.add(&format!("sizeof({c})"), end);
        assertions.names.insert(c);
    }};
}

/// The structures of one precision.
macro_rules! precision {
    ($assertions:expr, $t:ty) => {
        let (assertions, t): (&mut Assertions, &str) = ($assertions, stringify!($t));
        structure!(assertions, format!("toron_hyperelastic_{t}"), HyperelasticLaw<$t>: tag size values);
        structure!(assertions, format!("toron_frictional_{t}"), FrictionalLaw<$t>: tag size values);
        structure!(assertions, format!("toron_linear_elastic_{t}"), LinearElasticLaw<$t>: tag size values);
        structure!(assertions, format!("toron_point_{t}"), Point<$t>: size measure level density deformation_gradient fibre
            state_old state_new stress modes wave_speed tangent limit);
        structure!(assertions, format!("toron_block_{t}"), Block<$t>: size n leading_dimension measure level density
            deformation_gradient fibre energies_old invariants_old failure_old stress energies invariants failure modes tangent
            wave_speed active status deformation_gradient_layout fibre_layout state_layout stress_layout modes_layout
            tangent_layout limit limit_layout);
        structure!(assertions, format!("toron_linear_point_{t}"), LinearPoint<$t>: size rotation criterion measure level density
            f_old f_new fibre second_axis axes state_old state_new stress wave_speed tangent limit);
        structure!(assertions, format!("toron_linear_increment_{t}"), LinearIncrement<$t>: size criterion reserved jacobian strain
            state_old state_new stress);
        structure!(assertions, format!("toron_linear_block_{t}"), LinearBlock<$t>: size n leading_dimension rotation criterion
            measure level density f_old f_new fibre second_axis axes state_old state_new stress tangent wave_speed active status
            deformation_gradient_layout fibre_layout axes_layout state_layout stress_layout tangent_layout limit
            limit_layout);
        structure!(assertions, format!("toron_vumat_{t}"), Vumat<$t>: size nblock ndir nshr nstatev nprops level step_time
            total_time props density strain_inc stretch_old stretch_new stress_old state_old ener_intern_old ener_inelas_old
            stress_new state_new ener_intern_new ener_inelas_new);
    };
}

fn assertions() -> Assertions {
    let mut assertions = Assertions { text: String::new(), names: BTreeSet::new() };
    structure!(&mut assertions, "toron_table_row", TableRow: size name symbol unit mass length time has_default default_value
        minimum maximum minimum_excluded allowed meaning);
    structure!(&mut assertions, "toron_layout", Layout: leading_dimension stride);
    precision!(&mut assertions, f64);
    precision!(&mut assertions, f32);
    assertions
}

#[test]
fn structures_are_the_same_in_c_and_in_cpp() {
    let header = std::fs::read_to_string(Path::new(ROOT).join("include/toron.h")).expect("include/toron.h");
    let Assertions { text, names } = assertions();
    let in_header = header.lines().filter_map(|line| Some(line.strip_prefix("} ")?.strip_suffix(';')?.to_string()));
    assert_eq!(names, in_header.collect(), "structures that are not checked, or not in the header");

    let source = folder("structures").join("assertions.c");
    std::fs::write(&source, format!("#include <assert.h>\n#include <stddef.h>\n#include \"toron.h\"\n\n{text}"))
        .expect("a source");
    for (compiler, language) in [("gcc", &["-xc", "-std=c11"]), ("g++", &["-xc++", "-std=c++17"])] {
        let mut command = Command::new(compiler);
        command.args(language).args(["-fsyntax-only", "-Wall", "-Wextra", "-Werror"]).arg(format!("-I{ROOT}/include"));
        run(command.arg(&source), compiler);
    }
}
