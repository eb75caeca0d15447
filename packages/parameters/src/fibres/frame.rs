//! The beads as LAMMPS wrote them at an instant, in its units.

use std::path::Path;

use super::model::Model;
use toron_shared::error::Error;
use toron_shared::run_directory::file_error;

/// All beads of the fibres, layer by layer.
#[derive(Clone, Debug, Default)]
pub struct Frame {
    pub step: u64,
    pub positions: Vec<[f64; 3]>,
    /// Velocities against the blow; of a pressed section, the energies of the contacts, half of each at either bead.
    pub values: Vec<f64>,
    fibres: usize,
    spacing: f64,
}

impl Frame {
    pub fn layers(&self) -> usize {
        self.positions.len() / self.fibres
    }

    pub fn layer(&self, layer: usize) -> &[[f64; 3]] {
        &self.positions[layer * self.fibres..(layer + 1) * self.fibres]
    }

    /// The strains of the trusses between a layer and the next one, one a fibre.
    pub fn strains(&self, layer: usize) -> impl Iterator<Item = f64> {
        self.layer(layer).iter().zip(self.layer(layer + 1)).map(|(a, b)| {
            let square: f64 = a.iter().zip(b).map(|(a, b)| (b - a).powi(2)).sum();
            square.sqrt() / self.spacing - 1.0
        })
    }

    /// Mean and largest strain of the trusses between a layer and the next one that are whole.
    pub fn strain(&self, layer: usize, limit: Option<f64>) -> Option<[f64; 2]> {
        let whole = self.strains(layer).filter(|&strain| limit.is_none_or(|limit| strain <= limit));
        let (sum, most, count) = whole.fold((0.0, f64::NEG_INFINITY, 0), |(sum, most, count), strain| {
            (sum + strain, f64::max(most, strain), count + 1)
        });
        (count > 0).then(|| [sum / f64::from(count), most])
    }
}

/// Reads the frames of a file, each step once.
///
/// # Errors
/// The file cannot be read.
pub fn read(file: &Path, model: &Model) -> Result<Vec<Frame>, Error> {
    let text = std::fs::read_to_string(file).map_err(|error| file_error(file, &error))?;
    let mut frames: Vec<Frame> = Vec::new();
    for part in text.split("ITEM: TIMESTEP\n").skip(1) {
        // The end of a file that was being written is left out.
        if let Some(frame) = frame(part, model) {
            let kept = frames.iter().take_while(|known| known.step < frame.step).count();
            frames.truncate(kept);
            frames.push(frame);
        }
    }
    Ok(frames)
}

fn frame(text: &str, model: &Model) -> Option<Frame> {
    let (head, body) = text.split_once("ITEM: ATOMS")?;
    let step = head.lines().next()?.trim().parse().ok()?;
    let mut frame = Frame { step, fibres: model.centres.len(), spacing: model.spacing, ..Frame::default() };
    for line in body.lines().skip(1) {
        let mut numbers = line.split_whitespace().skip(1).map(|number| number.parse::<f64>().ok());
        let mut next = || numbers.next().flatten();
        frame.positions.push([next()?, next()?, next()?]);
        frame.values.push(next()?);
    }
    (frame.positions.len() == model.all_beads()).then_some(frame)
}
