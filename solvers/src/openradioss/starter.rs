//! The starter's call: a material's card comes in a scratch file, and what the listing is to say goes to another one.

use std::fmt::Write;
use std::fs;
use std::str::FromStr;

use toron::host::environment::in_default_environment;
use toron::host::openradioss::{Laws, MyReal, listing, read};

use super::solver::{current_option, stop};

/// A field of the card.
const COLUMNS: usize = 20;
const FIELDS: usize = 5;

/// What the starter needs to know of a material.
pub struct Material<T> {
    pub uparam: Vec<T>,
    /// NUVAR.
    pub variables: usize,
    /// PARMAT(1).
    pub modulus: T,
}

/// Reads the card of `/MAT/USERnn`, nn = `number`, and writes its part of the listing; `ilaw` and `root` are in the
/// names of the scratch files. Where the card is wrong, the run ends.
pub fn material<T: MyReal + FromStr>(
    laws: &Laws<T>,
    ilaw: i32,
    root: &[u8],
    number: i32,
    maxuparam: i32,
) -> Option<Material<T>> {
    let name = |kind: &str| format!("{kind}{}_{ilaw:04}.scr", String::from_utf8_lossy(root));
    let mut uparam = vec![T::splat(0.0); usize::try_from(maxuparam).unwrap_or(0).min(laws.most_parameters)];
    let card = fs::read_to_string(name("SI")).map_err(|error| format!("{}: {error}", name("SI")));
    // The solver may trap exceptions, which reading and checking numbers raises.
    let material = in_default_environment(|| {
        let card = fields(&card?)?;
        let material = read(laws, number, &card, &mut uparam).map_err(|error| error.to_string())?;
        uparam.truncate(material.parameters);
        let listing = text_of_listing(laws, &uparam);
        Ok::<_, String>((material, listing))
    });
    let (material, listing) = match material {
        Ok(material) => material,
        Err(message) => {
            // The starter reads the card of this material.
            let (id, title) =
                current_option().map_or_else(Default::default, |(id, title)| (format!("/{id}"), format!(" ({title})")));
            stop(&format!("/MAT/USER{number:02}{id}{title}: {message}"));
            return None;
        }
    };
    if let Err(error) = fs::write(name("SO"), listing) {
        stop(&format!("{}: {error}", name("SO")));
    }
    Some(Material { uparam, variables: material.variables, modulus: material.modulus })
}

/// The numbers of a card: five fields of 20 columns in a line, 0 where a field is blank. Lines of comments begin with
/// #.
fn fields<T: MyReal + FromStr>(text: &str) -> Result<Vec<T>, String> {
    let mut values = Vec::new();
    for (line, text) in (1..).zip(text.lines().filter(|line| !line.starts_with('#'))) {
        let text: Vec<char> = text.chars().collect();
        for k in 0..FIELDS {
            let field: String = text.iter().skip(k * COLUMNS).take(COLUMNS).collect();
            let number = field.trim().replace(['d', 'D'], "e");
            values.push(match number.as_str() {
                "" => T::splat(0.0),
                number => number.parse().map_err(|_| {
                    let (field, first) = (field.trim(), k * COLUMNS + 1);
                    format!(
                        "line {line} of the card behind the density has \"{field}\" in columns {first} to {}; allowed: one number",
                        first + COLUMNS - 1
                    )
                })?,
            });
        }
    }
    Ok(values)
}

/// What the listing is to say of a material.
fn text_of_listing<T: MyReal>(laws: &Laws<T>, uparam: &[T]) -> String {
    let mut text = String::new();
    for line in 0.. {
        let mut add = |piece: &str| text.push_str(piece);
        if !listing(laws, uparam, line, &mut add).unwrap_or(false) {
            break;
        }
        let _ = writeln!(text); // to a string, which does not fail
    }
    text
}
