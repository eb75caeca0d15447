//! A picture of the entries of DDSDDE that are wrong, by branch.

/// A branch's name and the largest relative error of each entry there.
pub struct Branch<'a> {
    pub name: &'a str,
    pub errors: [[f64; 6]; 6],
}

/// What errors up to these are drawn as; larger ones as the last.
const STEPS: [(f64, char); 3] = [(1e-4, '.'), (1e-2, '+'), (1e-1, 'x')];
const LARGE: char = '#';
/// Between two branches.
const GAP: &str = "   ";

/// Lines: the branches' names, a row of DDSDDE each, and what the letters mean.
pub fn drawn(branches: &[Branch], components: usize) -> Vec<String> {
    let letter = |error: f64| STEPS.iter().find(|(most, _)| error <= *most).map_or(LARGE, |(_, letter)| *letter);
    let width = |branch: &Branch| branch.name.chars().count().max(components);
    let line = |of: &dyn Fn(&Branch) -> String| {
        let parts = branches.iter().map(|branch| format!("{:<1$}", of(branch), width(branch)));
        parts.collect::<Vec<_>>().join(GAP).trim_end().to_string()
    };
    let mut lines = vec![line(&|branch| branch.name.to_string())];
    for row in 0..components {
        lines.push(line(&|branch| branch.errors[row][..components].iter().map(|error| letter(*error)).collect()));
    }
    lines.push(". right   + up to 1 %   x up to 10 %   # more".to_string());
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_drawn_by_how_wrong_they_are() {
        let mut errors = [[0.0; 6]; 6];
        (errors[0][1], errors[1][0], errors[2][2]) = (2e-3, 0.05, 3.0);
        let rest = Branch { name: "at rest", errors: [[0.0; 6]; 6] };
        let lines = drawn(&[rest, Branch { name: "loading", errors }], 3);
        assert_eq!(lines[..4], ["at rest   loading", "...       .+.", "...       x..", "...       ..#"]);
    }
}
