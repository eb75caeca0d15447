//! A page of panels over one abscissa: what a run has been through.

use std::path::Path;

use super::page;
use super::panel::{Abscissa, Panel, Series};
use super::style::{GREY, INK, TEXT, TITLE, fine, text};
use toron_shared::error::Error;

/// Width of the page, height of its titles and of a row of panels, and the panels of a row.
const WIDTH: u32 = 1280;
const HEAD: u32 = 84;
const ROW: u32 = 378;
const PER_ROW: usize = 2;
/// A line that moves by less than this part of itself stands still to the eye.
const STILL: f64 = 0.01;

/// What a run has measured, to be drawn.
pub struct Samples<'a, S>(pub &'a [S]);

impl<S> Samples<'_, S> {
    /// A figure of each sample, as a line in the colour of this number.
    pub fn line(&self, colour: usize, name: &str, of: impl Fn(&S) -> f64) -> Series {
        Series::new(colour, name, self.0.iter().map(of).collect())
    }

    /// Time in this unit, and when something failed.
    pub fn over_time(&self, unit: &str, time: impl Fn(&S) -> f64, failure: Option<f64>) -> Abscissa {
        let label = format!("time ({unit})");
        Abscissa { label, values: self.0.iter().map(time).collect(), failure }
    }
}

/// Writes the panels in which anything happens.
///
/// # Errors
/// A file cannot be written.
pub fn write(
    svg: &Path,
    png: &Path,
    [title, subtitle]: [&str; 2],
    panels: impl IntoIterator<Item = Panel>,
    abscissa: &Abscissa,
) -> Result<(), Error> {
    let panels: Vec<Panel> = panels.into_iter().filter(moves).collect();
    let rows = panels.len().div_ceil(PER_ROW).max(1);
    page::write(svg, png, [WIDTH, HEAD + ROW * rows as u32], |root| {
        root.draw_text(title, &text(TITLE, &INK), (fine(24), fine(16)))?;
        root.draw_text(subtitle, &text(TEXT, &GREY), (fine(24), fine(50)))?;
        let (_, body) = root.split_vertically(fine(HEAD as i32));
        for (panel, area) in panels.iter().zip(body.split_evenly((rows, PER_ROW))) {
            panel.draw(&area, abscissa)?;
        }
        Ok(())
    })
}

/// Whether anything happens in a panel.
fn moves(panel: &Panel) -> bool {
    panel.series.iter().any(|series| {
        let bounds = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = series.values.iter().fold(bounds, |(low, high), &value| (low.min(value), high.max(value)));
        high - low > STILL * high.abs().max(low.abs())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panel_where_nothing_happens_is_empty() {
        let panel = |lines: &[[f64; 3]]| {
            let line = |values: &[f64; 3]| Series { name: String::new(), colour: INK, values: values.to_vec() };
            Panel { title: "", unit: String::new(), series: lines.iter().map(line).collect(), limit: None }
        };
        assert!(!moves(&panel(&[])));
        assert!(!moves(&panel(&[[0.0; 3]])));
        assert!(!moves(&panel(&[[200.0; 3], [0.534, 0.534, 0.536]])));
        assert!(moves(&panel(&[[200.0; 3], [0.534, 0.534, 0.55]])));
        assert!(moves(&panel(&[[0.0, 1e-6, 0.0]])));
        assert!(moves(&panel(&[[-120.0, 3.0, -120.0]])));
    }
}
