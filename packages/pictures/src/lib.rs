//! Pictures: one font, one set of colours, panels of lines, and the way from a drawing to SVG and PNG.
//!
//! No law and no unit is known here: callers hand over the names of units. plotters lays a drawing out; a
//! [`Sheet`](sheet::Sheet) takes it down for both files. Text is drawn as the outlines of an embedded font, so that a
//! picture looks alike wherever it is made and wherever it is seen.

pub mod colour_scale;
mod font;
pub mod history;
pub mod legend;
pub mod page;
pub mod panel;
pub mod raster;
pub mod ruler;
pub mod sheet;
pub mod style;
mod svg;
pub mod view;
