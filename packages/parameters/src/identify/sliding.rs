//! A section that slides: what of its deviator is friction.
//!
//! The work on the section is 2 (q dI_td − p_t dI_tc). While it slides, q holds up the dilatancy as well, p_t
//! dI_tc/dI_td of it, which is no loss: µ p_t + c = q − p_t dI_tc/dI_td.

/// An instant of a test.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Line {
    pub p_t: f64,
    pub q: f64,
    pub i_tc: f64,
    pub i_td: f64,
}

/// Means over a part of the way, by I_td.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mean {
    /// I_td at its beginning and at its end.
    pub range: [f64; 2],
    pub p_t: f64,
    pub q: f64,
    /// dI_tc/dI_td.
    pub dilatancy: f64,
}

impl Mean {
    /// Over these lines, the first of which is where it begins; none where I_td does not rise, or nothing presses. A
    /// line's stresses are those of the way to it.
    pub fn over(lines: &[Line]) -> Option<Mean> {
        let range = [lines.first()?.i_td, lines.last()?.i_td];
        let rise = range[1] - range[0];
        let sum = |of: &dyn Fn(&Line, &Line) -> f64| lines.windows(2).map(|pair| of(&pair[0], &pair[1])).sum::<f64>();
        let pressed = sum(&|a, b| b.p_t * (b.i_td - a.i_td));
        let spread = sum(&|a, b| b.q * (b.i_td - a.i_td));
        let dilated = sum(&|a, b| b.p_t * (b.i_tc - a.i_tc));
        (rise > 0.0 && pressed > 0.0).then(|| Mean {
            range,
            p_t: pressed / rise,
            q: spread / rise,
            dilatancy: dilated / pressed,
        })
    }

    pub fn ratio(&self) -> f64 {
        self.q / self.p_t
    }

    /// What friction holds, over p_t.
    pub fn mu(&self) -> f64 {
        self.ratio() - self.dilatancy
    }
}

/// The first line at which I_td has come so far.
pub fn first_beyond(lines: &[Line], i_td: f64) -> Option<usize> {
    lines.iter().position(|line| line.i_td >= i_td)
}

/// The means over so many equal parts of I_td's rise along these lines.
pub fn blocks(lines: &[Line], count: usize) -> Vec<Mean> {
    let (Some(first), Some(last)) = (lines.first(), lines.last()) else { return Vec::new() };
    let place = |block: usize| {
        if block == count {
            return Some(lines.len() - 1);
        }
        first_beyond(lines, first.i_td + block as f64 / count as f64 * (last.i_td - first.i_td))
    };
    (0..count).filter_map(|block| Mean::over(lines.get(place(block)?..=place(block + 1)?)?)).collect()
}

/// Mean and its variance by the scatter of independent values.
pub fn scatter(values: &[f64]) -> [f64; 2] {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    [mean, values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (count - 1.0) / count]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// q = (0.2 + ⅓) p_t, the third of which is dilatancy.
    #[test]
    fn friction_is_what_is_left_of_the_deviator_without_dilatancy() {
        let line = |i: usize| {
            let i_td = 0.001 * i as f64;
            let p_t = 10.0 + 3.0 * i_td;
            Line { p_t, q: (0.2 + 1.0 / 3.0) * p_t, i_tc: i_td / 3.0, i_td }
        };
        let lines: Vec<Line> = (0..=300).map(line).collect();
        let mean = Mean::over(&lines).expect("it rises");
        assert!((mean.mu() - 0.2).abs() < 1e-12 && (mean.dilatancy - 1.0 / 3.0).abs() < 1e-12, "{mean:?}");
        let parts = blocks(&lines, 5);
        assert_eq!(parts.len(), 5);
        assert!((parts[4].range[0] - 0.24).abs() < 2e-3 && (parts[4].range[1] - 0.3).abs() < 1e-12, "{:?}", parts[4]);
        assert_eq!(Mean::over(&[Line::default(); 3]), None);
    }

    #[test]
    fn scatter_is_that_of_the_mean() {
        assert_eq!(scatter(&[1.0, 2.0, 3.0]), [2.0, 1.0 / 3.0]);
    }
}
