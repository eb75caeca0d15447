//! What CalculiX writes: tables in its `.dat` file, and the last increment's fields at nodes in its `.frd` file.

/// A table of printed values, a row a set or a node.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    pub title: String,
    pub time: f64,
    pub rows: Vec<Vec<f64>>,
}

/// The tables of a `.dat` file. What is not a number ends the table before it.
pub fn tables(text: &str) -> Vec<Table> {
    let mut tables: Vec<Table> = Vec::new();
    for line in text.lines().map(str::trim).filter(|line| !line.is_empty()) {
        if let Some((title, time)) = line.split_once(" and time ") {
            if let Some(time) = number(time.trim()) {
                tables.push(Table { title: title.to_string(), time, rows: Vec::new() });
            }
        } else if let (Some(table), Some(row)) = (tables.last_mut(), line.split_whitespace().map(number).collect()) {
            table.rows.push(row);
        }
    }
    tables
}

/// A number as Fortran prints it: exponents of three digits have no E.
fn number(text: &str) -> Option<f64> {
    let sign = text.rfind(['+', '-']).filter(|&i| i > 0 && text.as_bytes()[i - 1].is_ascii_digit());
    match sign {
        Some(i) => format!("{}E{}", &text[..i], &text[i..]).parse().ok(),
        None => text.parse().ok(),
    }
}

/// The last block of a field in a `.frd` file: for each node its number and `N` components.
pub fn last_field<const N: usize>(text: &str, field: &str) -> Vec<(usize, [f64; N])> {
    let Some(start) = text.rfind(&format!(" -4  {field}")) else { return Vec::new() };
    let rows = text[start..].lines().take_while(|line| !line.starts_with(" -3")).filter(|line| line.starts_with(" -1"));
    rows.filter_map(row).collect()
}

/// ` -1`, a number in ten columns, values in twelve each.
fn row<const N: usize>(line: &str) -> Option<(usize, [f64; N])> {
    let node = line.get(3..13)?.trim().parse().ok()?;
    let mut values = [0.0; N];
    for (i, value) in values.iter_mut().enumerate() {
        *value = number(line.get(13 + 12 * i..25 + 12 * i)?.trim())?;
    }
    Some((node, values))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_read() {
        let text = "\n total internal energy for set FIBRES and time  0.5000000E+00\n\n        1.500000E-03\n\n \
                    displacements (vx,vy,vz) for set SPRUNG and time  0.5000000E+00\n\n  7  1.0E-01 -2.0-101  0.0E+00\n";
        let tables = tables(text);
        assert_eq!(tables[0].rows, [[1.5e-3]]);
        assert_eq!((tables[1].time, &tables[1].rows[0][..3]), (0.5, &[7.0, 0.1, -2e-101][..]));
    }

    #[test]
    fn the_last_field_is_read() {
        let block = |x: &str| {
            format!(
                " -4  DISP        4    1\n -5  D1          1    2    1    0\n -1        12 {x}-3.00000E-01 1.00000E+00\n -3\n"
            )
        };
        let text = format!("{}{}", block("1.00000E+00"), block("2.00000E+00"));
        assert_eq!(last_field::<2>(&text, "DISP"), [(12, [2.0, -0.3])]);
        assert_eq!(last_field::<2>(&text, "STRESS"), []);
    }
}
