//! A panel seen from some direction, without perspective: what is nearer hides what is farther, and light from the
//! eye's upper left shows slopes.

use nalgebra::Vector3;
use plotters::prelude::*;

use super::surface::Visible;
use toron_pictures::page::{Area, Drawn};
use toron_pictures::raster::Raster;
use toron_pictures::view::View;

/// Where the light comes from: to the right, upwards and towards the eye.
const LIGHT: [f64; 3] = [-0.5, 0.35, 0.79];
/// The light on a side that faces the eye.
pub const FACING: f64 = LIGHT[2];

/// Where a panel is looked at from: the picture's directions to the right, upwards, and towards the eye.
#[derive(Clone, Copy, Debug)]
pub struct Eye([Vector3<f64>; 3]);

impl Eye {
    /// From above: x goes to the right, y upwards.
    pub fn above() -> Eye {
        Eye([Vector3::x(), Vector3::y(), Vector3::z()])
    }

    /// From the side of negative y, turned about z to the right and raised by these angles in degrees.
    pub fn new(turned: f64, raised: f64) -> Eye {
        let ((s, c), (up, level)) = (turned.to_radians().sin_cos(), raised.to_radians().sin_cos());
        let right = Vector3::new(c, s, 0.0);
        let towards = Vector3::new(s * level, -c * level, up);
        Eye([right, towards.cross(&right), towards])
    }

    /// A point or a direction as the eye has it: to the right, upwards, and nearer.
    pub fn see(&self, x: [f64; 3]) -> [f64; 3] {
        self.0.map(|axis| axis.dot(&Vector3::from(x)))
    }
}

/// How much light a side gets, and its height over the panel's middle.
#[derive(Clone, Copy, Debug)]
pub struct Lit {
    pub light: f64,
    pub height: f64,
}

/// The light on a side with this normal, of length 1.
pub fn light(eye: &Eye, normal: [f64; 3]) -> f64 {
    Vector3::from(eye.see(normal)).dot(&Vector3::from(LIGHT))
}

/// Draws the images of these sides that face the eye. An image has the signs of its axes: `[-1, 1]` is the mirror image
/// at x = 0.
pub fn draw(
    raster: &mut Raster,
    eye: &Eye,
    sides: &[Visible],
    images: &[[f64; 2]],
    shade: impl Fn(&Visible, Lit) -> RGBColor,
) {
    for &[x, y] in images {
        let image = |[a, b, c]: [f64; 3]| [x * a, y * b, c];
        for side in sides {
            let normal = image(side.normal.into());
            if eye.see(normal)[2] > 0.0 {
                let height = 0.25 * side.corners.iter().map(|corner| corner[2]).sum::<f64>();
                let RGBColor(red, green, blue) = shade(side, Lit { light: light(eye, normal), height });
                raster.quadrangle(&side.corners.map(|corner| eye.see(image(corner))), [red, green, blue]);
            }
        }
    }
}

/// Draws these sides from above.
pub fn draw_above(area: &Area, view: View, sides: &[Visible], shade: impl Fn(&Visible, Lit) -> RGBColor) -> Drawn<()> {
    let mut raster = Raster::new(view);
    draw(&mut raster, &Eye::above(), sides, &[[1.0; 2]], shade);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_eye_sees_what_is_near_and_what_is_high() {
        let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        for x in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.3, -0.2, 0.9]] {
            assert!(near(Eye::new(0.0, 90.0).see(x), Eye::above().see(x)), "{x:?}");
        }
        // From the front z goes upwards and y away; from the right x comes nearer.
        assert!(near(Eye::new(0.0, 0.0).see([1.0, 2.0, 3.0]), [1.0, 3.0, -2.0]));
        assert!(near(Eye::new(90.0, 0.0).see([1.0, 2.0, 3.0]), [2.0, 3.0, 1.0]));
    }
}
