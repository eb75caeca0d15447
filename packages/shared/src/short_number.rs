//! Numbers as decks and tables have them: short, and in so many columns.

/// What counts as the value itself: twelve digits, which is what a conversion of units keeps.
pub const EXACT: f64 = 1e-12;

/// The shortest number that says the value to twelve digits; where `width` characters do not hold it, the nearest one
/// that they do.
pub fn short(value: f64, width: usize) -> String {
    let fixed = (1..17).map(|decimals| format!("{value:.decimals$}"));
    let scientific = (0..17).map(|digits| format!("{value:.digits$e}"));
    // 30.8779e9 says one digit more than 3.0878e10 in as many characters.
    let exponent = if value == 0.0 { 0 } else { (value.abs().log10().floor() as i32).div_euclid(3) * 3 };
    let engineering = (0..17).map(|digits| format!("{:.digits$}e{exponent}", value / 10f64.powi(exponent)));
    // Among those that are near enough fixed and scientific come first, and the shortest of them.
    let plain = fixed.chain(scientific).map(|text| (0, text));
    let rank = |(kind, text): &(i32, String)| (deviation(text, value).max(EXACT), *kind, text.len());
    let fits = plain.chain(engineering.map(|text| (1, text))).filter(|(_, text)| text.len() <= width);
    let best = fits.min_by(|a, b| rank(a).partial_cmp(&rank(b)).unwrap_or(std::cmp::Ordering::Equal));
    best.map_or_else(|| value.to_string(), |(_, text)| text)
}

/// How far the number that is written is from the value, as a part of it.
pub fn deviation(text: &str, value: f64) -> f64 {
    let error = text.parse().map_or(f64::INFINITY, |x: f64| (x - value).abs());
    if error == 0.0 { 0.0 } else { error / value.abs() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_number_that_is_the_value_or_near_it() {
        for (value, width, text) in [
            (82341.0, 9, "82341.0"),
            (0.0, 9, "0.0"),
            (1.3514e-9, 9, "1.3514e-9"),
            (8.2341e10, 9, "8.2341e10"),
            (30877.875, 9, "30877.875"),
            (3.0877875e10, 9, "30.8779e9"),
            (-3.0877875e10, 9, "-30.878e9"),
            (0.000_123_456_789, 9, "1.2346e-4"),
            (1.0 / 3.0, 9, "0.3333333"),
            (1.0 / 3.0, 20, "0.333333333333"),
        ] {
            assert_eq!(short(value, width), text);
        }
    }
}
