//! Where an instance of a part is: a translation, and then a rotation.

use nalgebra::{Rotation3, Unit, Vector3};

use toron_shared::error::Error;
use toron_shared::keyword_file::line::Line;

#[derive(Clone, Default)]
pub struct Motion {
    translation: Option<Vector3<f64>>,
    /// About a point.
    rotation: Option<(Vector3<f64>, Rotation3<f64>)>,
}

impl Motion {
    /// A line of `*INSTANCE`: the translation, or behind it two points of an axis and the angle in degrees.
    ///
    /// # Errors
    /// It is neither.
    pub fn add(&mut self, line: &Line<'_>, fields: &[&str]) -> Result<(), Error> {
        if self.translation.is_none() && fields.len() <= 3 {
            let component = |i: usize| line.real("a translation", fields.get(i).copied().unwrap_or_default());
            self.translation = Some(Vector3::new(component(0)?, component(1)?, component(2)?));
            return Ok(());
        }
        let blank = fields.iter().all(|field| field.is_empty());
        if blank && self.translation.is_some() {
            return Ok(());
        }
        let wrong = |allowed: &str| Err(line.error(&format!("a line of *INSTANCE; allowed: {allowed}")));
        let (&[_, _, _, _, _, _, angle], None, true) = (fields, &self.rotation, self.translation.is_some()) else {
            return wrong("three numbers of a translation, then seven: two points of an axis, and the angle about it");
        };
        let number = |i: usize| line.real("a coordinate of the axis", fields[i]);
        let point = Vector3::new(number(0)?, number(1)?, number(2)?);
        let other = Vector3::new(number(3)?, number(4)?, number(5)?);
        let angle = line.real("an angle", angle)?;
        let Some(axis) = Unit::try_new(other - point, 0.0) else {
            return wrong("an axis through two points that are not the same");
        };
        self.rotation = Some((point, Rotation3::from_axis_angle(&axis, angle.to_radians())));
        Ok(())
    }

    pub fn moved(&self, place: [f64; 3]) -> [f64; 3] {
        let place = Vector3::from(place) + self.translation.unwrap_or_default();
        match &self.rotation {
            Some((point, rotation)) => point + rotation * (place - point),
            None => place,
        }
        .into()
    }

    pub fn turned(&self, direction: [f64; 3]) -> [f64; 3] {
        match &self.rotation {
            Some((_, rotation)) => (rotation * Vector3::from(direction)).into(),
            None => direction,
        }
    }
}
