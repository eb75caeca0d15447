use plotters::prelude::*;
use plotters::style::text_anchor::Pos;

use super::*;
use crate::page::draw;
use crate::style::{INK, fine, stroke, text};

/// What is drawn on a white sheet of 60 × 40.
fn drawn(paint: impl FnOnce(&mut Sheet)) -> Sheet {
    let mut sheet = draw([60, 40], |_| Ok(())).expect("a sheet");
    paint(&mut sheet);
    sheet
}

/// Left, top, right and bottom of what is not white, in units of the picture.
fn ink(sheet: &Sheet) -> [f32; 4] {
    let width = sheet.pixels.width() as usize;
    let dark = sheet.pixels.pixels().iter().enumerate().filter(|(_, pixel)| pixel.red() < 128);
    let places: Vec<(usize, usize)> = dark.map(|(i, _)| (i % width, i / width)).collect();
    let ends = |of: fn(&(usize, usize)) -> usize| (places.iter().map(of).min(), places.iter().map(of).max());
    let ((left, right), (top, bottom)) = (ends(|place| place.0), ends(|place| place.1));
    let after = |end: Option<usize>| end.map(|end| end + 1);
    [left, top, after(right), after(bottom)].map(|end| end.expect("ink") as f32 / PNG_SCALE)
}

fn assert_near(found: [f32; 4], expected: [f32; 4]) {
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.8), "{found:?} instead of {expected:?}");
}

fn paths(sheet: &Sheet) -> Vec<String> {
    sheet.svg().lines().filter(|line| line.starts_with("<path")).skip(1).map(String::from).collect()
}

const BLACK: BackendColor = BackendColor { alpha: 1.0, rgb: (0, 0, 0) };

#[test]
fn shapes_are_in_both_pictures() {
    let place = |x, y| (fine(x), fine(y));
    let thick = stroke(RGBColor(0, 0, 0), 2);
    type Paint<'a> = &'a dyn Fn(&mut &mut Sheet) -> Done;
    let shapes: [(Paint, &str, [f32; 4]); 6] = [
        (
            &|sheet| sheet.draw_line(place(10, 20), place(50, 20), &thick),
            "<path fill=\"none\" stroke=\"#000000\" stroke-width=\"2\" d=\"m10 20l40 0\"/>",
            [10.0, 19.0, 50.0, 21.0],
        ),
        (
            &|sheet| sheet.draw_path([place(10, 10), place(20, 10), place(20, 30)], &thick),
            "<path fill=\"none\" stroke=\"#000000\" stroke-width=\"2\" d=\"m10 10l10 0 0 20\"/>",
            [10.0, 9.0, 21.0, 30.0],
        ),
        (
            &|sheet| sheet.draw_rect(place(5, 6), place(15, 26), &BLACK, true),
            "<path fill=\"#000000\" d=\"m5 6l10 0 0 20-10 0z\"/>",
            [5.0, 6.0, 15.0, 26.0],
        ),
        (
            &|sheet| sheet.draw_rect(place(5, 6), place(15, 26), &thick, false),
            "<path fill=\"none\" stroke=\"#000000\" stroke-width=\"2\" d=\"m5 6l10 0 0 20-10 0z\"/>",
            [4.0, 5.0, 16.0, 27.0],
        ),
        (
            &|sheet| sheet.fill_polygon([place(30, 5), place(40, 5), place(30, 15)], &BLACK),
            "<path fill=\"#000000\" d=\"m30 5l10 0-10 10z\"/>",
            [30.0, 5.0, 39.5, 14.5],
        ),
        (
            &|sheet| sheet.draw_circle(place(30, 20), fine(8) as u32, &BLACK, true),
            "<path fill=\"#000000\" d=\"m38 20q",
            [22.0, 12.0, 38.0, 28.0],
        ),
    ];
    for (paint, path, bounds) in shapes {
        let sheet = drawn(|mut sheet| paint(&mut sheet).expect("a shape"));
        assert!(matches!(&paths(&sheet)[..], [only] if only.starts_with(path)), "{:?}", paths(&sheet));
        assert_near(ink(&sheet), bounds);
        assert!(sheet.png().expect("a PNG").starts_with(b"\x89PNG"));
    }
}

#[test]
fn a_ring_has_a_hole_where_its_edges_run_against_one_another() {
    let outer = [(10, 5), (40, 5), (40, 35), (10, 35), (10, 5)];
    let inner = [(20, 15), (30, 15), (30, 25), (20, 25), (20, 15)];
    let centre = |against: bool| {
        let mut ring = outer.to_vec();
        if against {
            ring.extend(inner.iter().rev())
        } else {
            ring.extend(inner)
        }
        let ring = ring.into_iter().map(|(x, y)| (fine(x), fine(y)));
        let sheet = drawn(|mut sheet| sheet.fill_polygon(ring, &BLACK).expect("a ring"));
        sheet.pixels.pixel(37, 30).expect("a pixel").red()
    };
    assert_eq!([centre(true), centre(false)], [255, 0]);
}

#[test]
fn what_is_transparent_or_has_no_extent_is_left_out() {
    let sheet = drawn(|mut sheet| {
        let clear = BackendColor { alpha: 0.0, rgb: (0, 0, 0) };
        sheet.draw_rect((0, 0), (99, 99), &clear, true).expect("nothing");
        sheet.draw_path([(5, 5)], &BLACK).expect("nothing");
        sheet.draw_text("  ", &text(12.0, &INK), (0, 0)).expect("nothing");
    });
    assert_eq!(paths(&sheet), Vec::<String>::new());
    let sheet = drawn(|mut sheet| {
        let veil = BackendColor { alpha: 0.5, rgb: (0, 0, 0) };
        sheet.draw_rect((0, 0), (99, 99), &veil, true).expect("a veil");
    });
    assert!(paths(&sheet)[0].contains(" opacity=\".5\" "));
    assert!((126..130).contains(&sheet.pixels.pixel(3, 3).expect("a pixel").red()));
}

#[test]
fn text_lies_where_its_anchor_says() {
    let at = |h, v, turn| {
        let style = TextStyle { color: BLACK, ..text(10.0, &INK).transform(turn).pos(Pos::new(h, v)) };
        let sheet = drawn(|mut sheet| sheet.draw_text("HH", &style, (fine(30), fine(20))).expect("text"));
        assert_eq!(paths(&sheet).len(), 1);
        ink(&sheet)
    };
    let font = Font::new().expect("the font");
    let width = font.width("HH", 10.0);
    let bounds = font.outline("HH", 10.0).expect("outlines").bounds();
    let [left, right, height] = [bounds.left(), bounds.right(), bounds.height()];
    let none = || FontTransform::None;
    let base = 20.0 + 10.0 * ASCENT;
    assert_near(at(HPos::Left, VPos::Top, none()), [30.0 + left, base - height, 30.0 + right, base]);
    let base = 20.0 + 0.5 * height;
    let [start, end] = [left, right].map(|x| 30.0 - width + x);
    assert_near(at(HPos::Right, VPos::Center, none()), [start, base - height, end, base]);
    let base = 20.0 - 10.0 * DESCENT;
    let [start, end] = [left, right].map(|x| 30.0 - 0.5 * width + x);
    assert_near(at(HPos::Center, VPos::Bottom, none()), [start, base - height, end, base]);
    // Upwards, from the anchor on.
    let turned = at(HPos::Left, VPos::Center, FontTransform::Rotate270);
    assert_near(turned, [30.0 - 0.5 * height, 20.0 - right, 30.0 + 0.5 * height, 20.0 - left]);
}

#[test]
fn plotters_is_told_the_width_that_is_drawn() {
    let sheet = &mut draw([60, 40], |_| Ok(())).expect("a sheet");
    let (width, height) = sheet.estimate_text_size("1.25 mm", &text(10.0, &INK)).expect("a size");
    let drawn = sheet.font.width("1.25 mm", 10.0);
    assert!((width as f32 / FINE as f32 - drawn).abs() <= 0.1 && height == 10 * FINE, "{width} {height} {drawn}");
}

#[test]
fn a_sheet_without_extent_is_an_error() {
    assert_eq!(Sheet::new([0, 40]).err().as_deref(), Some("no memory for the picture"));
}
