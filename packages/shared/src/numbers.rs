//! Numbers as text for people.

/// A number for people: four significant digits, with an exponent where the number is very large or small.
pub fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        return "0".to_string(); // without the sign of -0
    }
    if !(1e-3..1e6).contains(&size) {
        return format!("{value:.3e}");
    }
    let digits = (3 - size.log10().floor() as i32).max(0) as usize;
    format!("{value:.digits$}")
}

/// The size of a number for people: one digit and an exponent.
pub fn one_digit(value: f64) -> String {
    if value == 0.0 { "0".to_string() } else { format!("{value:.0e}") }
}

/// All digits of a number, with an exponent where it is very large or small.
pub fn plain(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || (1e-3..1e6).contains(&size) { value.to_string() } else { format!("{value:e}") }
}
