//! `toron impact`: the yarn under impact, the thesis's single-yarn scenes (sections 3.3, 3.4, 4.6, 4.7) in the explicit
//! host.

pub mod command;
pub mod file;
pub mod judgement;
pub mod outcome;
pub mod plot;
pub mod reader;
pub mod report;
pub mod run;
pub mod scene;
pub mod strength;
pub mod summary;
pub mod weights;
pub mod yarn_picture;
