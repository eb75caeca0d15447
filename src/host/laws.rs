//! The laws of the library, in one list. What has a row for each of them goes through it: libraries of solvers, tables
//! in C, programs.

use crate::law::description::Description;
use crate::law::interface::Law;
use crate::law::parameters::same;

/// Calls a macro with the laws of the library behind the tokens in braces: for each its type, and in braces its names,
/// in the order of [`LibraryLaw`].
#[macro_export]
macro_rules! library_laws {
    ($($then:ident)::+ { $($before:tt)* }) => {
        $($then)::+! {
            $($before)*
            Hyperelastic {
                "hyperelastic", "hyperelastic yarn law", "HYPERELASTIC", "ToronHyperelastic", user 1, umat 41
            }
            LinearElastic {
                "linear-elastic", "linear elastic law", "LINEARELASTIC", "ToronLinearElastic", user 2, umat 43
            }
            Frictional {
                "frictional", "yarn law with friction", "FRICTIONAL", "ToronFrictional", user 3, umat 44
            }
        }
    };
}

/// A law of the library by its names. Its place in [`LAWS`] is its number in C.
#[derive(Debug)]
pub struct LibraryLaw {
    /// Its properties and state.
    pub description: &'static Description,
    /// In files.
    pub name: &'static str,
    /// CalculiX: behind `@TORON_`.
    pub symbol: &'static str,
    /// MGIS and MTest.
    pub behaviour: &'static str,
    /// OpenRadioss: nn of `/MAT/USERnn`.
    pub user: i32,
    /// LS-DYNA: the material's number that cards are written with.
    pub umat: u32,
}

macro_rules! rows {
    ($($law:ident {
        $name:literal, $title:literal, $symbol:literal, $behaviour:literal, user $user:literal, umat $umat:literal
    })+) => {
        /// The laws of the library, by their numbers in C.
        pub static LAWS: [LibraryLaw; [$($user),+].len()] = [$(LibraryLaw {
            description: const { &<crate::$law<f64> as Law<f64>>::DESCRIPTION },
            name: $name,
            symbol: $symbol,
            behaviour: $behaviour,
            user: $user,
            umat: $umat,
        }),+];

        $(const _: () = assert!(same($title, <crate::$law<f64> as Law<f64>>::DESCRIPTION.title), "the title of a law");)+
    };
}

crate::library_laws! { rows {} }

impl LibraryLaw {
    /// The numbers of properties and of state variables.
    const fn counts(&self) -> [i32; 2] {
        [self.description.properties.len() as i32, self.description.state.len() as i32]
    }
}

/// The number, `/MAT/USERnn`, of the law whose properties and state variables are as many as a material has in Abaqus,
/// or that has so many constants as the first law cannot have, a limit variable included; that of the first law if
/// there is none. So the message of the right law says what a card lacks.
#[inline]
pub fn by_counts(counts: [i32; 2]) -> i32 {
    let [first, others @ ..] = &LAWS;
    let [constants, most] = [counts[0], first.counts()[0] + 1];
    let is_meant = |law: &&LibraryLaw| {
        let own = law.counts();
        own == counts || constants > most && (own[0]..=own[0] + 1).contains(&constants)
    };
    others.iter().find(is_meant).unwrap_or(first).user
}
