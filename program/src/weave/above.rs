//! A panel from above: what is over hides what is under, and light from the left shows the slopes that the yarns have at rest,
//! so that a colour does not depend on where in a bulge it is.

use nalgebra::Vector3;
use plotters::prelude::*;

use super::surface::Visible;
use crate::picture::page::{Area, Drawn};
use crate::picture::raster::Raster;
use crate::picture::view::View;

/// Where the light comes from.
const LIGHT: [f64; 3] = [-0.5, 0.35, 0.79];

/// How a side meets the light: above 0 where it faces it more than a level one does; and its height.
#[derive(Clone, Copy, Debug)]
pub struct Lit {
    pub light: f64,
    pub height: f64,
}

/// Draws the images of these sides that look upwards. An image has the signs of its axes: `[1, -1, -1]` is the panel from below.
pub fn draw(
    area: &Area,
    view: View,
    sides: &[Visible],
    images: &[[f64; 3]],
    shade: impl Fn(&Visible, Lit) -> RGBColor,
) -> Drawn<()> {
    let mut raster = Raster::new(view);
    for signs in images {
        let image = |x: [f64; 3]| [0, 1, 2].map(|i| signs[i] * x[i]);
        for side in sides {
            if signs[2] * side.normal.z > 0.0 {
                let at_rest = Vector3::from(image(side.normal_at_rest.into()));
                let corners = side.corners.map(image);
                let light = at_rest.dot(&Vector3::from(LIGHT)) - LIGHT[2];
                let height = 0.25 * corners.iter().map(|corner| corner[2]).sum::<f64>();
                let RGBColor(red, green, blue) = shade(side, Lit { light, height });
                raster.quadrangle(&corners, [red, green, blue]);
            }
        }
    }
    raster.draw(area)
}

/// A colour made darker below a brightness of 1, and above it whiter.
pub fn brightened(RGBColor(red, green, blue): RGBColor, brightness: f64) -> RGBColor {
    let mix = |channel: u8| {
        let value = if brightness <= 1.0 {
            f64::from(channel) * brightness
        } else {
            255.0 - (255.0 - f64::from(channel)) * (2.0 - brightness)
        };
        value.clamp(0.0, 255.0).round() as u8
    };
    RGBColor(mix(red), mix(green), mix(blue))
}
