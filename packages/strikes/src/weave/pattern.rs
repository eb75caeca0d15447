//! Which yarn is over which: the pattern of a weave, repeated in both directions.

/// The weave's repeat: a row for each warp yarn, in it whether it is over the weft yarns that it meets along x.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern {
    rows: Vec<Vec<bool>>,
}

/// A repeat may have so many yarns of a family.
pub const MOST_YARNS: usize = 64;

impl Pattern {
    pub fn plain() -> Pattern {
        Pattern { rows: vec![vec![true, false], vec![false, true]] }
    }

    /// Rows of the letters o (over) and u (under).
    ///
    /// # Errors
    /// What is wrong, and what is allowed.
    pub fn parse(rows: &[String]) -> Result<Pattern, String> {
        let wanted = "allowed: plain, or rows of o (over) and u (under), one a warp yarn, all of one length";
        let count = rows.first().map_or(0, |row| row.len());
        if count == 0 || count > MOST_YARNS || rows.len() > MOST_YARNS || rows.iter().any(|row| row.len() != count) {
            let message =
                format!("pattern has no rows, rows of different lengths, or more than {MOST_YARNS}; {wanted}");
            return Err(message);
        }
        let letter = |letter: char| match letter {
            'o' => Ok(true),
            'u' => Ok(false),
            _ => Err(format!("pattern has the letter {letter:?}; {wanted}")),
        };
        let row = |row: &String| row.chars().map(letter).collect();
        let pattern = Pattern { rows: rows.iter().map(row).collect::<Result<_, _>>()? };
        pattern.check_woven()?;
        Ok(pattern)
    }

    /// A yarn that is over all others, or under them, is not held by the weave.
    fn check_woven(&self) -> Result<(), String> {
        let [warps, wefts] = self.repeat();
        let loose = |family: &str, number: usize| {
            format!("pattern: {family} yarn {} is over all others or under all; allowed: both in each", number + 1)
        };
        for (number, row) in self.rows.iter().enumerate() {
            if row.iter().all(|&over| over == row[0]) {
                return Err(loose("warp", number));
            }
        }
        for weft in 0..wefts {
            if (0..warps).all(|warp| self.rows[warp][weft] == self.rows[0][weft]) {
                return Err(loose("weft", weft));
            }
        }
        Ok(())
    }

    /// Warp and weft yarns of the repeat.
    pub fn repeat(&self) -> [usize; 2] {
        [self.rows.len(), self.rows[0].len()]
    }

    /// Whether this warp yarn is over this weft yarn; numbers may be negative.
    pub fn warp_is_over(&self, warp: i64, weft: i64) -> bool {
        let row = &self.rows[warp.rem_euclid(self.rows.len() as i64) as usize];
        row[weft.rem_euclid(row.len() as i64) as usize]
    }

    /// With warp and weft exchanged, seen from the same side: what was over is over.
    pub fn exchanged(&self) -> Pattern {
        let [warps, wefts] = self.repeat();
        Pattern { rows: (0..wefts).map(|weft| (0..warps).map(|warp| !self.rows[warp][weft]).collect()).collect() }
    }

    /// Whether the pattern is its own mirror image by planes normal to x and to y: through the crossing of the yarns
    /// numbered 0, or through the gap before it.
    pub fn mirror_planes(&self, through_gap: bool) -> [bool; 2] {
        let [warps, wefts] = self.repeat().map(|count| count as i64);
        let image = |number: i64| -number - i64::from(through_gap);
        let all = |same: &dyn Fn(i64, i64) -> bool| (0..warps).all(|i| (0..wefts).all(|j| same(i, j)));
        [
            all(&|i, j| self.warp_is_over(i, j) == self.warp_is_over(i, image(j))),
            all(&|i, j| self.warp_is_over(i, j) == self.warp_is_over(image(i), j)),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pattern(rows: &[&str]) -> Result<Pattern, String> {
        Pattern::parse(&rows.iter().map(|row| (*row).to_string()).collect::<Vec<_>>())
    }

    #[test]
    fn a_plain_weave_is_its_mirror_image_through_a_crossing_and_a_basket_through_the_right_gap() {
        let twill = pattern(&["oouu", "uoou", "uuoo", "ouuo"]).expect("a pattern");
        let basket = pattern(&["ouuo", "uoou", "uoou", "ouuo"]).expect("a pattern");
        assert_eq!([false, true].map(|gap| Pattern::plain().mirror_planes(gap)), [[true; 2], [false; 2]]);
        assert_eq!([false, true].map(|gap| twill.mirror_planes(gap)), [[false; 2]; 2]);
        assert_eq!([false, true].map(|gap| basket.mirror_planes(gap)), [[false; 2], [true; 2]]);
        assert!(twill.warp_is_over(-3, 1) && !twill.warp_is_over(0, -1));
        assert_eq!(pattern(&["ou", "uo"]), Ok(Pattern::plain()));
    }

    #[test]
    fn tables_that_are_no_weave_are_refused() {
        for (rows, message) in [
            (&[][..], "pattern has no rows"),
            (&["ou", "u"][..], "rows of different lengths"),
            (&["ox", "uo"][..], "pattern has the letter 'x'; allowed: plain, or rows of o (over) and u (under)"),
            (&["oo", "uo"][..], "warp yarn 1 is over all others or under all"),
            (&["oou", "ouo"][..], "weft yarn 1 is over all others or under all"),
        ] {
            let error = pattern(rows).expect_err("a mistake");
            assert!(error.contains(message), "{error}");
        }
    }
}
