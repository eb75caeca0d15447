//! The starter's call: a material's card comes in a scratch file, and what the listing is to say goes to another one.

use std::ffi::c_char;
use std::fmt::Write;
use std::fs;

use toron::host::environment::in_default_environment;
use toron::host::openradioss::{card::MOST_PARAMETERS, listing, read};

use crate::Real;
use crate::solver::stop;

/// A field of the card.
const COLUMNS: usize = 20;
const FIELDS: usize = 5;

/// `LECMUSERnn`: `ilaw` is the number in the names of the scratch files, `rootn` the first `rootlen` characters of the run's name,
/// `number` is nn.
///
/// # Safety
/// The solver's promise: `rootn` has `rootlen` characters, `uparam` `maxuparam` values, `parmat` at least three.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn st_lecm99_(
    ilaw: *const i32,
    rootn: *const c_char,
    rootlen: *const i32,
    number: *const i32,
    uparam: *mut Real,
    maxuparam: *const i32,
    nuparam: *mut i32,
    nuvar: *mut i32,
    _ifunc: *mut i32,
    _maxfunc: *const i32,
    nfunc: *mut i32,
    parmat: *mut Real,
) {
    // SAFETY: the solver's promise, here and below.
    unsafe {
        let root = std::slice::from_raw_parts(rootn.cast::<u8>(), usize::try_from(*rootlen).unwrap_or(0));
        let name = |kind: &str| format!("{kind}{}_{:04}.scr", String::from_utf8_lossy(root), *ilaw);
        let mut values = [0.0; MOST_PARAMETERS];
        let room = usize::try_from(*maxuparam).unwrap_or(0).min(MOST_PARAMETERS);
        let material = fs::read_to_string(name("SI")).map_err(|error| format!("{}: {error}", name("SI")));
        // The solver may trap exceptions, which reading and checking numbers raises.
        let material = in_default_environment(|| {
            let card = fields(&material?)?;
            let material = read(*number, &card, &mut values[..room]).map_err(|error| error.to_string())?;
            let listing = text_of_listing(&values[..material.parameters]);
            Ok::<_, String>((material, listing))
        });
        let (material, listing) = match material {
            Ok(material) => material,
            Err(message) => return stop(&format!("/MAT/USER{:02}: {message}", *number)),
        };
        uparam.copy_from_nonoverlapping(values.as_ptr(), material.parameters);
        (*nuparam, *nuvar, *nfunc) = (material.parameters as i32, material.variables as i32, 0);
        *parmat = material.modulus;
        if let Err(error) = fs::write(name("SO"), listing) {
            stop(&format!("{}: {error}", name("SO")));
        }
    }
}

/// The numbers of a card: five fields of 20 columns in a line, 0 where a field is blank. Lines of comments begin with #.
fn fields(text: &str) -> Result<Vec<Real>, String> {
    let mut values = Vec::new();
    for (line, text) in (1..).zip(text.lines().filter(|line| !line.starts_with('#'))) {
        let text: Vec<char> = text.chars().collect();
        for k in 0..FIELDS {
            let field: String = text.iter().skip(k * COLUMNS).take(COLUMNS).collect();
            let number = field.trim().replace(['d', 'D'], "e");
            values.push(match number.as_str() {
                "" => 0.0,
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
fn text_of_listing(uparam: &[Real]) -> String {
    let mut text = String::new();
    for line in 0.. {
        let mut add = |piece: &str| text.push_str(piece);
        if !listing(uparam, line, &mut add).unwrap_or(false) {
            break;
        }
        let _ = writeln!(text); // to a string, which does not fail
    }
    text
}
