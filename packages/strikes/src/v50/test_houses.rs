//! The mean that test houses print: of as many of the fastest stops as of the slowest perforations.

use super::curve::Fate;

/// The mean of so many stops and as many perforations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mean {
    pub each: usize,
    pub speed: f64,
    /// From the slowest of them to the fastest.
    pub spread: f64,
}

/// The mean of the `each` fastest stops and as many slowest perforations; none where there are not so many.
pub fn mean(fates: &[Fate], each: usize) -> Option<Mean> {
    let sorted = |through: bool| {
        let mut speeds: Vec<f64> = fates.iter().filter(|fate| fate.through == through).map(|fate| fate.speed).collect();
        speeds.sort_by(f64::total_cmp);
        speeds
    };
    let (stops, throughs) = (sorted(false), sorted(true));
    if each == 0 || stops.len() < each || throughs.len() < each {
        return None;
    }
    let taken = stops[stops.len() - each..].iter().chain(&throughs[..each]).copied();
    let (least, most) = taken.clone().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    Some(Mean { each, speed: taken.sum::<f64>() / (2 * each) as f64, spread: most - least })
}

/// The mean of the most shots whose speeds lie within a spread.
pub fn widest(fates: &[Fate], spread: f64) -> Option<Mean> {
    (1..=fates.len() / 2).filter_map(|each| mean(fates, each)).rfind(|mean| mean.spread <= spread)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fastest_stops_and_the_slowest_perforations_are_taken() {
        let fates: Vec<Fate> = [
            (180.0, false),
            (190.0, false),
            (196.0, true),
            (199.0, false),
            (204.0, true),
            (207.0, false),
            (211.0, true),
            (230.0, true),
        ]
        .map(|(speed, through)| Fate { speed, through })
        .to_vec();
        assert_eq!(mean(&fates, 1), Some(Mean { each: 1, speed: 201.5, spread: 11.0 }));
        assert_eq!(mean(&fates, 2), Some(Mean { each: 2, speed: 201.5, spread: 11.0 }));
        assert_eq!(mean(&fates, 3), Some(Mean { each: 3, speed: 1207.0 / 6.0, spread: 21.0 }));
        assert_eq!(mean(&fates, 5), None);
        assert_eq!(widest(&fates, 20.0).map(|mean| mean.each), Some(2));
        assert_eq!(widest(&fates, 21.0).map(|mean| mean.each), Some(3));
        assert_eq!(widest(&fates, 10.0), None);
        assert_eq!(widest(&fates[..2], 100.0), None);
    }
}
