//! Numbers in fields of so many columns, of which a mesh has millions.

/// The number with as many digits as `width` columns hold behind a blank.
pub fn number(value: f64, width: usize) -> String {
    let room = width - 1;
    // Sign, one digit, point, and an exponent of up to four characters.
    let scientific = format!("{value:.*e}", room.saturating_sub(7));
    let whole = if value.abs() < 10.0 { 1 } else { value.abs().log10().floor() as usize + 1 };
    let sign = usize::from(value.is_sign_negative());
    let fixed = format!("{value:.*}", room.saturating_sub(sign + whole + 1).max(1));
    let error = |text: &str| text.parse::<f64>().map_or(f64::INFINITY, |read| (read - value).abs());
    let shorter = fixed.len() <= room && error(&fixed) <= error(&scientific);
    format!("{:>width$}", if shorter { without_zeros(&fixed) } else { &scientific })
}

/// Without what stands for nothing at the end, but for one digit behind the point.
fn without_zeros(fixed: &str) -> &str {
    let kept = fixed.trim_end_matches('0');
    if kept.ends_with('.') { &fixed[..kept.len() + 1] } else { kept }
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn a_field_holds_the_number_behind_a_blank() {
        for (value, width, text) in [
            (0.0, 16, "             0.0"),
            (-12.5, 16, "           -12.5"),
            (1.0 / 3.0, 16, " 0.3333333333333"),
            (-1.0 / 3.0, 16, "-0.333333333333"),
            (1e-9 / 3.0, 16, " 3.33333333e-10"),
            (-123456.789, 20, "       -123456.789"),
        ] {
            let field = number(value, width);
            assert_eq!(field.trim(), text.trim());
            assert!(field.len() == width && field.starts_with(' '), "{field:?}");
        }
    }
}
