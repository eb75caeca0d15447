//! The struck panel, shaded and coloured by its energies: cut through the blow, from below, and the blow itself.

use std::f64::consts::PI;
use std::path::Path;

use plotters::prelude::*;

use super::scene::{Case, Scene, Zones};
use crate::weave::model::Model;
use crate::weave::projection::{self, Eye};
use crate::weave::surface::{self, Visible};
use toron::law::parameters::ENERGY_DENSITY;
use toron_explicit_host::contact::Shape;
use toron_explicit_host::snapshot::Snapshot;
use toron_materials::units::{time, unit};
use toron_pictures::colour_scale::{Colours, Scale};
use toron_pictures::page::{self, Area, Drawn};
use toron_pictures::raster::Raster;
use toron_pictures::ruler;
use toron_pictures::style::{GREY, INK, TEXT, TITLE, fine, text};
use toron_pictures::view::View;
use toron_shared::error::Error;
use toron_shared::numbers::number;

const WIDTH: i32 = 1280;
/// Air beside all that is drawn, and between two views.
const LEFT: i32 = 24;
const BETWEEN: i32 = 20;
const TITLE_TOP: i32 = 16;
const TIME_TOP: i32 = 50;
/// Of a view: the middle of its scale of colours, what is seen, and the view itself; a ruler below it, and air.
const SCALE_MIDDLE: i32 = 10;
const NAME_TOP: i32 = 42;
const VIEW_TOP: i32 = 66;
const RULER_BELOW: i32 = 20;
const ROW_BELOW: i32 = 44;
const FIRST_ROW: i32 = 84;
/// Of a mode: how far its name indents the scale of colours, and its width.
const SCALE_INDENT: i32 = 152;
const SCALE_WIDTH: i32 = 140;
/// The width of the view from below; those of the blow stand one under another beside it.
const BELOW_WIDTH: i32 = 640;
/// How the views are turned about z and raised, in degrees.
const CUT: [f64; 2] = [16.0, 30.0];
const BELOW: [f64; 2] = [20.0, -38.0];
const BLOW: [f64; 2] = [6.0, 14.0];
/// The blow is shown to so many of the sphere's radii along the cut and behind it, and as much of the sphere's height
/// over its lowest point.
const BLOW_RADII: [f64; 2] = [1.4, 0.8];
const SPHERE_SHOWN: f64 = 0.4;
/// Nothing is shown that is farther below the sphere's centre than so many of its radii.
const FLYING: f64 = 1.5;
const SPHERE: RGBColor = RGBColor(214, 219, 227);
const SPHERE_CUT: RGBColor = RGBColor(234, 237, 242);
/// Brightness of what gets no light, and what the light adds.
const AMBIENT: f64 = 0.48;
const DIFFUSE: f64 = 0.64;
/// The scale ends where this part of the elements that carry something lies below.
const SHOWN: f64 = 0.98;
const BEYOND: &str = "2 %";
/// The views show where a density has this part of its largest, with some air; or the whole panel, where that is not
/// much more.
const SMALL: f64 = 0.01;
const AIR: f64 = 1.25;
const NEARLY_WHOLE: f64 = 0.7;
const LEAST_RADII: f64 = 3.0;
const MODES: [&str; 3] = ["Elongation W_el", "Compaction W_tc", "Distortion W_td"];

/// What is shown: the modes or, where there is none, the work of the linear law. Of two laws the first view has both.
fn modes(case: &Case) -> Vec<&'static str> {
    match &case.zones {
        Zones::One(material) if material.law.yarn().is_none() => vec!["Work"],
        Zones::One(_) => MODES.to_vec(),
        Zones::Two(..) => vec!["Elongation W_el*", MODES[1], MODES[2]],
    }
}

/// Draws the panel as it stood at an instant, with the verdict of the run; a quarter is continued by its mirror images.
///
/// # Errors
/// A file cannot be written.
pub fn write(
    svg: &Path,
    png: &Path,
    (scene, case, verdict): (&Scene, &Case, &str),
    panel: &Model,
    snapshot: &Snapshot,
) -> Result<(), Error> {
    let unit = unit(&scene.units, ENERGY_DENSITY);
    let drawing = Drawing { verdict, ..Drawing::new(scene, case, panel, snapshot, &unit) };
    page::write(svg, png, [WIDTH as u32, drawing.height() as u32], |root| drawing.draw(root))
}

/// The linear law has no modes: its work stands beside elongation.
fn density(mode: usize, densities: &[f64; 5]) -> f64 {
    if mode == 0 { densities[0] + densities[4] } else { densities[mode] }
}

struct Drawing<'a> {
    scene: &'a Scene,
    case: &'a Case,
    snapshot: &'a Snapshot,
    /// Of the run.
    verdict: &'a str,
    /// The first over the whole width, the second below it, the others beside that one.
    views: Vec<Seen<'a>>,
}

/// A part of the sphere's surface, cut as the panel is: corners and normal.
type Face = ([[f64; 3]; 4], [f64; 3]);

/// A part of the panel from some direction.
struct Seen<'a> {
    mode: usize,
    scale: Scale<'a>,
    name: String,
    eye: Eye,
    sides: Vec<Visible>,
    images: &'static [[f64; 2]],
    sphere: Vec<Face>,
    /// By what the eye has rightwards and upwards.
    low: [f64; 2],
    high: [f64; 2],
}

impl<'a> Drawing<'a> {
    fn new(scene: &'a Scene, case: &'a Case, panel: &Model, snapshot: &'a Snapshot, unit: &'a str) -> Self {
        let modes = modes(case);
        // From where the panel is struck.
        let aim = case.striker.aim;
        let from_aim = |[x, y]: [f64; 2]| [x - aim[0], y - aim[1]];
        let middles: Vec<[f64; 2]> = (0..panel.elements.len()).map(|i| from_aim(middle(panel, i))).collect();
        let quarter = !panel.on_x.is_empty();
        let size = middles.iter().map(farthest).fold(0.0, f64::max);
        let reach = reach(&middles, size, case, snapshot, modes.len());
        let blow = BLOW_RADII.map(|radii| radii * case.striker.radius);
        // What flies ahead of the sphere is out of the views.
        let lowest = snapshot.striker.map_or(f64::NEG_INFINITY, |(height, radius)| height - FLYING * radius);
        let seen = |mode: usize, name: &str, [turned, raised]: [f64; 2], reach: [f64; 2], cut: bool| {
            let near = |at: [f64; 2]| within(at, reach) && (!cut || quarter || at[1] >= 0.0);
            let shown: Vec<bool> = middles.iter().zip(&snapshot.intact).map(|(&at, &is)| is && near(at)).collect();
            let mut sides = surface::visible(panel, &snapshot.positions, |element| shown[element]);
            sides.retain(|side| side.corners.iter().all(|corner| corner[2] > lowest));
            let images: &[[f64; 2]] = match (quarter, cut) {
                (false, _) => &[[1.0, 1.0]],
                (true, true) => &[[1.0, 1.0], [-1.0, 1.0]],
                (true, false) => &[[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]],
            };
            // The whole sphere is shown where it is small beside the panel.
            let top = if reach == blow || size < LEAST_RADII * case.striker.radius { SPHERE_SHOWN } else { 2.0 };
            let sphere = snapshot.striker.filter(|_| cut);
            let mut sphere =
                sphere.map_or(Vec::new(), |(height, radius)| half_of(case.striker.shape, height, radius, top));
            for corner in sphere.iter_mut().flat_map(|face| &mut face.0) {
                (corner[0], corner[1]) = (corner[0] + aim[0], corner[1] + aim[1]);
            }
            // By all that is as near, so that views of one mode have one scale.
            let standing: Vec<bool> =
                middles.iter().zip(&snapshot.intact).map(|(&at, &is)| is && within(at, reach)).collect();
            let (scale, most) = scale(mode, modes[mode], snapshot, &standing, unit);
            let name = if most > scale.largest {
                format!("{name}; {BEYOND} exceed the scale, up to {}", number(most))
            } else {
                name.to_string()
            };
            Seen::new(mode, scale, name, Eye::new(turned, raised), sides, images, sphere)
        };
        let part = if reach.is_finite() { "the middle of the panel, " } else { "" };
        let mut views = vec![
            seen(0, &format!("{part}cut along the warp"), CUT, [reach; 2], true),
            seen(0, &format!("{part}from below"), BELOW, [reach; 2], false),
        ];
        // The linear law has no more to show at the blow than its work.
        let close = if modes.len() == 1 { 0..1 } else { 1..modes.len() };
        views.extend(close.map(|mode| seen(mode, "at the blow, cut along the warp", BLOW, blow, true)));
        Drawing { scene, case, snapshot, verdict: "", views }
    }

    /// The place and the width of each view, and the height of all.
    fn layout(&self) -> (Vec<([i32; 2], i32)>, i32) {
        let across = WIDTH - 2 * LEFT;
        let row = |view: &Seen, width: i32| VIEW_TOP + view.height(width) + ROW_BELOW;
        let second = FIRST_ROW + row(&self.views[0], across);
        let mut places = vec![([LEFT, FIRST_ROW], across), ([LEFT, second], BELOW_WIDTH)];
        let left = LEFT + BELOW_WIDTH + BETWEEN;
        let (width, mut top) = (WIDTH - LEFT - left, second);
        for view in &self.views[2..] {
            places.push(([left, top], width));
            top += row(view, width);
        }
        (places, top.max(second + row(&self.views[1], BELOW_WIDTH)))
    }

    fn height(&self) -> i32 {
        self.layout().1
    }

    fn draw(&self, root: &Area) -> Drawn<()> {
        let title = format!("{}: {}", self.scene.title, self.case.name);
        root.draw_text(&title, &text(TITLE, &INK), (fine(LEFT), fine(TITLE_TOP)))?;
        let units = &self.scene.units;
        let laws = if matches!(self.case.zones, Zones::Two(..)) { "; * work, where the law is linear" } else { "" };
        let scales = "energies per reference volume, colours by the square root";
        let time = format!("at {}, {scales}{laws}; verdict: {}", time(units, self.snapshot.time), self.verdict);
        root.draw_text(&time, &text(TEXT, &GREY), (fine(LEFT), fine(TIME_TOP)))?;
        let (places, _) = self.layout();
        self.views.iter().zip(places).try_for_each(|(view, (place, width))| self.draw_view(root, view, place, width))
    }

    fn draw_view(&self, root: &Area, seen: &Seen, [left, top]: [i32; 2], width: i32) -> Drawn<()> {
        let scale = &seen.scale;
        scale.draw(root, [left, top + SCALE_MIDDLE])?;
        root.draw_text(&seen.name, &text(TEXT, &GREY), (fine(left), fine(top + NAME_TOP)))?;
        let view = View::strip([left, top + VIEW_TOP], width, seen.low, seen.high);
        let mut raster = Raster::new(view);
        projection::draw(&mut raster, &seen.eye, &seen.sides, seen.images, |side, lit| {
            let density = density(seen.mode, &self.snapshot.densities[side.element]);
            brightened(scale.colour(density), lit.light)
        });
        for (corners, normal) in &seen.sphere {
            // The plane of the cut has no shade of its own.
            let colour =
                if normal[1] < 0.0 { SPHERE_CUT } else { brightened(SPHERE, projection::light(&seen.eye, *normal)) };
            raster.quadrangle(&corners.map(|corner| seen.eye.see(corner)), [colour.0, colour.1, colour.2]);
        }
        raster.draw(root)?;
        let below = top + VIEW_TOP + seen.height(width) + RULER_BELOW;
        ruler::draw(root, [left, below], view.scale, self.scene.units.names()[0])
    }
}

impl<'a> Seen<'a> {
    fn new(
        mode: usize,
        scale: Scale<'a>,
        name: String,
        eye: Eye,
        sides: Vec<Visible>,
        images: &'static [[f64; 2]],
        sphere: Vec<Face>,
    ) -> Self {
        let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        let mut add = |corner: [f64; 3]| {
            let [x, y, _] = eye.see(corner);
            bounds = [[bounds[0][0].min(x), bounds[0][1].min(y)], [bounds[1][0].max(x), bounds[1][1].max(y)]];
        };
        for corner in sides.iter().flat_map(|side| side.corners) {
            images.iter().for_each(|[x, y]| add([x * corner[0], y * corner[1], corner[2]]));
        }
        sphere.iter().flat_map(|face| face.0).for_each(add);
        // Where nothing stands there is still a picture.
        let [low, high] = if bounds[0][0] < bounds[1][0] { bounds } else { [[0.0; 2], [1.0; 2]] };
        Seen { mode, scale, name, eye, sides, images, sphere, low, high }
    }

    /// In a picture of this width.
    fn height(&self, width: i32) -> i32 {
        (f64::from(width) * (self.high[1] - self.low[1]) / (self.high[0] - self.low[0])).ceil() as i32
    }
}

/// The colours of a mode, up to what few of the elements that are shown exceed, and the largest value of these.
fn scale<'a>(mode: usize, name: &'static str, snapshot: &Snapshot, shown: &[bool], unit: &'a str) -> (Scale<'a>, f64) {
    let seen = snapshot.densities.iter().zip(shown).filter(|(_, shown)| **shown);
    let mut carried: Vec<f64> = seen.map(|(densities, _)| density(mode, densities)).collect();
    let most = carried.iter().copied().fold(0.0, f64::max);
    carried.retain(|&density| density > SMALL * most);
    carried.sort_by(f64::total_cmp);
    let end = carried.get((SHOWN * carried.len() as f64) as usize).map_or(most, |&density| two_digits(density));
    let (largest, colours) = (end.min(most), Colours::GreyToRed);
    (Scale { name, indent: SCALE_INDENT, width: SCALE_WIDTH, largest, unit, colours, root: true }, most)
}

/// A colour in this light.
fn brightened(colour: RGBColor, light: f64) -> RGBColor {
    projection::brightened(colour, AMBIENT + DIFFUSE * light.max(0.0))
}

/// Rounded upwards.
fn two_digits(value: f64) -> f64 {
    let step = 10_f64.powi(value.log10().floor() as i32 - 1);
    if step > 0.0 && step.is_finite() { (value / step).ceil() * step } else { value }
}

/// An element's middle at rest.
fn middle(panel: &Model, element: usize) -> [f64; 2] {
    let corners = &panel.elements[element];
    [0, 1].map(|axis| corners.iter().map(|&node| panel.nodes[node as usize][axis]).sum::<f64>() / corners.len() as f64)
}

fn within(at: [f64; 2], reach: [f64; 2]) -> bool {
    at.iter().zip(reach).all(|(at, reach)| at.abs() <= reach)
}

fn farthest([x, y]: &[f64; 2]) -> f64 {
    x.abs().max(y.abs())
}

/// How far from where it is struck the panel has an energy to show, or the sphere is; infinite where that is nearly the
/// whole panel.
fn reach(middles: &[[f64; 2]], size: f64, case: &Case, snapshot: &Snapshot, modes: usize) -> f64 {
    let least = LEAST_RADII * case.striker.radius;
    let most: Vec<f64> = (0..modes).map(|mode| snapshot.largest(|densities| density(mode, densities))).collect();
    let shows = |element: usize| {
        let densities = &snapshot.densities[element];
        most.iter().enumerate().any(|(mode, most)| density(mode, densities) > SMALL * most)
    };
    let standing = (0..middles.len()).filter(|&element| snapshot.intact[element]);
    let reach = standing.filter(|&i| shows(i)).fold(least, |reach, i| reach.max(AIR * farthest(&middles[i])));
    if reach > NEARLY_WHOLE * size { f64::INFINITY } else { reach }
}

/// The half of what strikes at y ≥ 0 and the plane that cuts it, up to so many radii over the lowest point.
fn half_of(shape: Shape, height: f64, radius: f64, top: f64) -> Vec<Face> {
    const STEPS: usize = 90;
    // From the lowest point upwards, and around z from the cut's right to its left: the distance from the axis and the
    // height over the centre, in radii, and the normal.
    let outline = |i: f64| {
        let part = i / STEPS as f64;
        let [below, above] = [2.0 * part, 2.0 * part - 1.0];
        let round = |end: f64, part: f64| {
            let (s, c) = (end * part).sin_cos();
            ([s, -c], [s, -c])
        };
        match shape {
            Shape::Flat if below < 1.0 => ([below, -1.0], [0.0, -1.0]),
            Shape::Flat => ([1.0, -1.0 + top * above], [1.0, 0.0]),
            Shape::Hemisphere if top > 1.0 && below < 1.0 => round(0.5 * PI, below),
            Shape::Hemisphere if top > 1.0 => ([1.0, (top - 1.0) * above], [1.0, 0.0]),
            _ => round((1.0 - top).clamp(-1.0, 1.0).acos(), part),
        }
    };
    let turned = |[across, up]: [f64; 2], j: f64| {
        let (sin, cos) = (PI * j / STEPS as f64).sin_cos();
        [across * cos, across * sin, up]
    };
    let point = |i: usize, j: usize| {
        let [x, y, z] = turned(outline(i as f64).0, j as f64);
        [radius * x, radius * y, height + radius * z]
    };
    let mut faces = Vec::new();
    for i in 0..STEPS {
        for j in 0..STEPS {
            let corners = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
            faces.push((corners, turned(outline(i as f64 + 0.5).1, j as f64 + 0.5)));
        }
        faces.push(([point(i, 0), point(i + 1, 0), point(i + 1, STEPS), point(i, STEPS)], [0.0, -1.0, 0.0]));
    }
    // The lid, in strips along the cut.
    for i in 0..STEPS / 2 {
        let strip = [i, i + 1, STEPS - i - 1, STEPS - i].map(|j| point(STEPS, j));
        faces.push((strip, [0.0, 0.0, 1.0]));
    }
    faces
}
