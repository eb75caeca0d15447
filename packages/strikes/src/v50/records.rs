//! The table of shots, which grows by a line with each one that ends, and from which a run goes on.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use csv::{Position, ReaderBuilder, StringRecord, WriterBuilder};

use super::difference;
use super::scene::{Scene, Shot};
use super::shot::{Ended, Ending};
use crate::residual::SpeedIs;
use toron_explicit_host::struck::history::title;
use toron_materials::units::{LENGTH, SPEED, TIME};
use toron_shared::build;
use toron_shared::error::Error;
use toron_shared::run_directory::file_error;
use toron_shared::text_table::{NONE, or_dash};
use toron_shared::toml_error::shortened;

/// The ending of the name of the file in which the scene stands that shots are of.
const SCENE: &str = "scene.toml";
/// The words of endings.
const ENDINGS: [&str; 4] = ["stopped", "through", "undecided", "error"];
/// Where the scene stands in a line; the build and the error are behind it.
const SCENE_COLUMN: usize = 16;

/// Shots that have ended, by their numbers, and their file.
pub struct Records {
    place: PathBuf,
    titles: Vec<String>,
    /// Of which scene and which build of the program they are.
    of: [String; 2],
    /// The text of the scene.
    scene: String,
    pub shots: BTreeMap<usize, Ended>,
    file: Option<File>,
}

impl Records {
    /// The table at a place, with nothing in it yet.
    pub fn new(scene: &Scene, place: &Path) -> Records {
        let units = &scene.units;
        let quantity = |name: &str, dimension| title(name, dimension, units);
        let titles = vec![
            "shot".to_string(),
            quantity("nominal_speed", SPEED),
            quantity("speed", SPEED),
            quantity("aim_x", LENGTH),
            quantity("aim_y", LENGTH),
            "strength_seed".to_string(),
            "ending".to_string(),
            quantity("residual_speed", SPEED),
            quantity("speed_at_end", SPEED),
            quantity("end", TIME),
            "verdict".to_string(),
            "seconds".to_string(),
            "wall_seconds".to_string(),
            "residual_speed_is".to_string(),
            quantity("speed_at_decision", SPEED),
            "seconds_to_decision".to_string(),
            "scene".to_string(),
            "build".to_string(),
            "error".to_string(),
        ];
        let of = [scene.identity(), build::number()].map(|number| format!("{number:08x}"));
        let scene = scene.text.clone();
        Records { place: place.to_path_buf(), titles, of, scene, shots: BTreeMap::new(), file: None }
    }

    /// Adds the shots of a file of this scene and this build. One that stands here already has to be the same, or one
    /// of the two has no fate.
    ///
    /// # Errors
    /// The file cannot be read, is another table, or of another scene or build.
    pub fn read(&mut self, place: &Path) -> Result<usize, Error> {
        let text = whole_lines(place)?;
        // A line of too few cells has a message of its own.
        let mut reader = ReaderBuilder::new().flexible(true).from_reader(text.as_bytes());
        let titles = reader.headers().map_err(|error| file_error(place, &error))?;
        if titles != self.titles {
            let allowed = format!("allowed: {}", self.titles.join(", "));
            return Err(file_error(place, &format!("its columns are not those of shots in these units; {allowed}")));
        }
        let mut count = 0;
        for record in reader.records() {
            let record = record.map_err(|error| file_error(place, &error))?;
            let line = record.position().map_or(0, Position::line);
            let wrong = |what: &str| Error::Input(format!("{}:{line}: {what}", place.display()));
            let ended = parsed(&record, &self.titles).map_err(|what| wrong(&what))?;
            self.check_origin(&record, place).map_err(|what| wrong(&what))?;
            let number = ended.shot.number;
            let kept = match self.shots.get(&number) {
                None => ended,
                Some(other) => joined(other, &ended).cloned().ok_or_else(|| {
                    wrong(&format!("another shot {number} than the one before; allowed: one of each number"))
                })?,
            };
            self.shots.insert(number, kept);
            count += 1;
        }
        Ok(count)
    }

    /// That a line of a file is of this scene and this build.
    ///
    /// # Errors
    /// What else it is of, and what is allowed.
    fn check_origin(&self, record: &StringRecord, place: &Path) -> Result<(), String> {
        for (column, own, what) in
            [(SCENE_COLUMN, &self.of[0], "scene"), (SCENE_COLUMN + 1, &self.of[1], "build of the program")]
        {
            let found = record.get(column).unwrap_or_default();
            if found == own {
                continue;
            }
            let scene = std::fs::read_to_string(place.with_extension(SCENE)).ok();
            let difference =
                scene.filter(|_| column == SCENE_COLUMN).and_then(|scene| difference::first(&self.scene, &scene));
            let difference = difference.map_or(String::new(), |difference| format!(": {difference}"));
            return Err(format!(
                "a shot of another {what} ({found}, not {own}){difference}; allowed: shots of this scene, but for {}, and of this build",
                difference::MAY_DIFFER.join(", ")
            ));
        }
        Ok(())
    }

    /// Writes the table anew, in one go and in the order of the numbers, with the scene beside it, and opens it for
    /// more.
    ///
    /// # Errors
    /// They cannot be written.
    pub fn open(&mut self) -> Result<(), Error> {
        self.file = None;
        let scene = self.place.with_extension(SCENE);
        std::fs::write(&scene, &self.scene).map_err(|error| file_error(&scene, &error))?;
        let error = |error: &dyn std::fmt::Display| file_error(&self.place, error);
        let mut text = line(&self.titles).map_err(|e| error(&e))?;
        for ended in self.shots.values() {
            text.extend(line(&self.cells(ended)).map_err(|e| error(&e))?);
        }
        let new = self.place.with_extension("csv-new");
        std::fs::write(&new, text).and_then(|()| std::fs::rename(&new, &self.place)).map_err(|e| error(&e))?;
        self.file = Some(OpenOptions::new().append(true).open(&self.place).map_err(|e| error(&e))?);
        Ok(())
    }

    /// Adds a shot, or takes it in place of one of its number; at once in the file, which has no buffer.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn add(&mut self, ended: Ended) -> Result<(), Error> {
        let line = line(&self.cells(&ended)).map_err(|error| file_error(&self.place, &error))?;
        let replaces = self.shots.insert(ended.shot.number, ended).is_some();
        let Some(file) = self.file.as_mut().filter(|_| !replaces) else { return self.open() };
        let written = file.write_all(&line);
        if written.is_err() {
            // No line goes behind half of one: the next shot writes the table anew.
            self.file = None;
        }
        written.map_err(|error| file_error(&self.place, &error))
    }

    fn cells(&self, ended: &Ended) -> Vec<String> {
        let Ended { shot, ending, speed_at_end, time, verdict, .. } = ended;
        let (place, error) = match ending {
            Ending::Stopped => (0, NONE),
            Ending::Through => (1, NONE),
            Ending::Undecided => (2, NONE),
            Ending::Error(message) => (3, message.as_str()),
        };
        vec![
            shot.number.to_string(),
            shot.nominal.to_string(),
            shot.speed.to_string(),
            shot.aim[0].to_string(),
            shot.aim[1].to_string(),
            shot.seed.map_or(NONE.to_string(), |seed| seed.to_string()),
            ENDINGS[place].to_string(),
            or_dash(ended.residual(), |speed| speed.to_string()),
            speed_at_end.to_string(),
            time.to_string(),
            verdict.clone(),
            format!("{:.2}", ended.seconds),
            format!("{:.2}", ended.wall_seconds),
            ended.speed_is.map_or(NONE, SpeedIs::name).to_string(),
            or_dash(ended.decision.map(|[speed, _]| speed), |speed| speed.to_string()),
            or_dash(ended.decision.map(|[_, seconds]| seconds), |seconds| format!("{seconds:.2}")),
            self.of[0].clone(),
            self.of[1].clone(),
            // On one line, whatever the message.
            error.replace('\n', " "),
        ]
    }
}

/// A line of the table.
fn line(cells: &[String]) -> Result<Vec<u8>, csv::Error> {
    let mut writer = WriterBuilder::new().from_writer(Vec::new());
    writer.write_record(cells)?;
    writer.into_inner().map_err(|error| error.into_error().into())
}

/// The text of a file, without a last line that has no end: that is of a run that was killed as it wrote it.
fn whole_lines(place: &Path) -> Result<String, Error> {
    let mut bytes = std::fs::read(place).map_err(|error| file_error(place, &error))?;
    bytes.truncate(bytes.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1));
    if bytes.is_empty() {
        return Err(file_error(place, &"empty, or without a whole line; allowed: the table of an earlier run"));
    }
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        Error::Input(format!("{}:{line}: no text in UTF-8; allowed: the lines of toron v50", place.display()))
    })
}

/// The shot of a line.
///
/// # Errors
/// A cell is of no shot: its column, the cell and what is allowed.
fn parsed(record: &StringRecord, titles: &[String]) -> Result<Ended, String> {
    if record.len() != titles.len() {
        return Err(format!("a line of {} cells; allowed: {}, those of toron v50", record.len(), titles.len()));
    }
    let wrong = |column: usize, allowed: &str| {
        format!("{} is \"{}\"; allowed: {allowed}", titles[column], shortened(&record[column]))
    };
    let number = |column: usize| record[column].parse::<f64>().map_err(|_| wrong(column, "a number"));
    let whole = |column: usize, allowed: &str| record[column].parse::<u64>().map_err(|_| wrong(column, allowed));
    let shot = Shot {
        number: whole(0, "a whole number")? as usize,
        nominal: number(1)?,
        speed: number(2)?,
        aim: [number(3)?, number(4)?],
        seed: if &record[5] == NONE { None } else { Some(whole(5, "a whole number, or -")?) },
    };
    let ending = match ENDINGS.iter().position(|word| record[6] == **word) {
        Some(0) => Ending::Stopped,
        Some(1) => Ending::Through,
        Some(2) => Ending::Undecided,
        Some(_) => Ending::Error(record[SCENE_COLUMN + 2].to_string()),
        None => return Err(wrong(6, &ENDINGS.join(", "))),
    };
    let optional = |column: usize| if &record[column] == NONE { Ok(None) } else { number(column).map(Some) };
    let speed_is = SpeedIs::ALL.into_iter().find(|is| is.name() == &record[13]);
    Ok(Ended {
        shot,
        ending,
        speed_at_end: number(8)?,
        time: number(9)?,
        verdict: record[10].to_string(),
        speed_is,
        decision: optional(14)?.zip(optional(15)?).map(<[f64; 2]>::from),
        seconds: number(11)?,
        wall_seconds: number(12)?,
    })
}

/// Which of two lines of one shot tells more: a fate before none, and without one the later end before an earlier one
/// or an error. None where they are of two shots, or of two fates.
fn joined<'a>(one: &'a Ended, other: &'a Ended) -> Option<&'a Ended> {
    if one.shot != other.shot {
        return None;
    }
    match (one.fate(), other.fate()) {
        (Some(_), None) => Some(one),
        (None, Some(_)) => Some(other),
        // But for how long it took, to the bit.
        (Some(_), Some(_)) => {
            let bits = |ended: &Ended| [ended.speed_at_end, ended.time].map(f64::to_bits);
            (one.ending == other.ending && bits(one) == bits(other)).then_some(one)
        }
        (None, None) => {
            let time = |ended: &Ended| if ended.ending == Ending::Undecided { ended.time } else { f64::NEG_INFINITY };
            Some(if time(other) > time(one) { other } else { one })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::v50::scene::YARN;

    fn scene(seed: u32) -> Scene {
        Scene::parse("yarn.toml", &format!("{YARN}seed = {seed}\n"), None).expect("a scene")
    }

    fn ended(number: usize, ending: Ending) -> Ended {
        let shot = Shot { number, nominal: 100.0, speed: 100.0 / 3.0, aim: [0.1, -1e-7], seed: Some(7) };
        let through = ending == Ending::Through;
        Ended {
            ending,
            speed_at_end: 1.0 / 3.0,
            time: 0.1,
            verdict: "mesh; contact".to_string(),
            speed_is: through.then_some(SpeedIs::AtDecision),
            decision: through.then_some([0.5, 0.75]),
            seconds: 1.25,
            wall_seconds: 1.5,
            ..Ended::of(shot)
        }
    }

    /// What is written is read again to the bit; a line that is not whole is no shot, and one of a number takes the
    /// place of another.
    #[test]
    fn shots_are_read_as_they_were_written() {
        let folder = std::env::temp_dir().join(format!("toron-shots-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let place = folder.join("shots.csv");
        let scene = scene(1);
        let mut records = Records::new(&scene, &place);
        records.open().expect("it is written");
        let message = "case a: \"x\", 2 of 3\nand more";
        let endings = [Ending::Through, Ending::Stopped, Ending::Undecided, Ending::Error(message.to_string())];
        for (number, ending) in (1..).zip(endings) {
            records.add(ended(number, ending)).expect("it is written");
        }
        records.add(ended(3, Ending::Stopped)).expect("it is written");
        let text = std::fs::read_to_string(&place).expect("a table");
        assert_eq!(text.lines().count(), 5, "{text}");
        std::fs::write(&place, format!("{text}5,100")).expect("it is written");

        let mut again = Records::new(&scene, &place);
        assert_eq!(again.read(&place).expect("the shots"), 4);
        let error = ended(4, Ending::Error(message.replace('\n', " ")));
        assert_eq!(again.shots.remove(&4), Some(error.clone()));
        assert_eq!(records.shots.remove(&4).map(|ended| ended.shot), Some(error.shot));
        assert_eq!(again.shots, records.shots);

        let refused = |change: &dyn Fn(&str) -> String, scene: &Scene| {
            std::fs::write(&place, change(&text)).expect("it is written");
            let mut records = Records::new(scene, &place);
            records.shots.insert(1, ended(1, Ending::Through));
            records.read(&place).expect_err("a change").to_string()
        };
        let same = |text: &str| text.to_string();
        assert!(refused(&same, &self::scene(2)).contains("shots.csv:2: a shot of another scene"));
        assert!(refused(&|text| text.replace("0.1,-", "0.2,-"), &scene).contains("another shot 1 than the one before"));
        for (from, to, message) in [
            ("through", "over", "shots.csv:2: ending is \"over\"; allowed: stopped, through, undecided, error"),
            ("2,100,", "2,fast,", "shots.csv:3: nominal_speed (mm/ms) is \"fast\"; allowed: a number"),
            ("2,100,", "2\n100,", "shots.csv:3: a line of 1 cells; allowed: 19, those of toron v50"),
            ("mm/ms", "m/s", "shots.csv: its columns are not those of shots in these units"),
        ] {
            let error = refused(&|text| text.replacen(from, to, 1), &scene);
            assert!(error.contains(message), "{message}: {error}");
        }
        assert!(refused(&|_| String::new(), &scene).contains("shots.csv: empty, or without a whole line"));
        // A character that is cut is no harm in a line without an end, and named in another.
        let cut = [text.as_bytes(), b"5,\xc3"].concat();
        std::fs::write(&place, &cut).expect("it is written");
        assert_eq!(Records::new(&scene, &place).read(&place).expect("the shots"), 4);
        std::fs::write(&place, [&cut, &b"\n"[..]].concat()).expect("it is written");
        let error = Records::new(&scene, &place).read(&place).expect_err("no text");
        assert!(error.to_string().contains("shots.csv:6: no text in UTF-8"), "{error}");
        std::fs::remove_dir_all(&folder).expect("it is removed");
    }

    /// Shots of another scene are refused by the key that differs, where that scene stands beside the table.
    #[test]
    fn another_scene_is_told_by_its_key() {
        let folder = std::env::temp_dir().join(format!("toron-scenes-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let place = folder.join("shots.csv");
        let mut records = Records::new(&scene(1), &place);
        records.open().expect("it is written");
        records.add(ended(1, Ending::Stopped)).expect("it is written");
        let error = Records::new(&scene(2), &place).read(&place).expect_err("another seed");
        assert!(error.to_string().contains("shots.seed is 2, and 1 there; allowed: shots of this scene"), "{error}");
        std::fs::remove_dir_all(&folder).expect("it is removed");
    }

    /// Behind a line that could not be written nothing is appended: the next shot writes the table anew, with the one
    /// that was lost.
    #[test]
    fn no_line_goes_behind_half_of_one() {
        let folder = std::env::temp_dir().join(format!("toron-half-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let place = folder.join("shots.csv");
        let mut records = Records::new(&scene(1), &place);
        records.open().expect("it is written");
        // Opened for reading alone: nothing can be written.
        records.file = Some(File::open(&place).expect("a table"));
        records.add(ended(1, Ending::Stopped)).expect_err("it cannot be written");
        std::fs::write(&place, format!("{}1,10", std::fs::read_to_string(&place).expect("a table")))
            .expect("half a line");
        records.add(ended(2, Ending::Stopped)).expect("it is written");
        let mut again = Records::new(&scene(1), &place);
        assert_eq!((again.read(&place).expect("the shots"), again.shots), (2, records.shots));
        std::fs::remove_dir_all(&folder).expect("it is removed");
    }

    /// Of two lines of a shot the one with a fate stands, else the later end, whichever is read first; two fates are
    /// none.
    #[test]
    fn of_two_lines_the_one_that_tells_more_stands() {
        let at = |ending: Ending, time: f64| Ended { time, ..ended(3, ending) };
        let error = || Ended { speed_at_end: f64::NAN, ..at(Ending::Error("it failed".to_string()), 0.3) };
        for (less, more) in [
            (at(Ending::Undecided, 0.1), at(Ending::Through, 0.2)),
            (at(Ending::Undecided, 0.4), at(Ending::Stopped, 0.2)),
            (at(Ending::Undecided, 0.1), at(Ending::Undecided, 0.2)),
            (error(), at(Ending::Undecided, 0.1)),
            (error(), at(Ending::Through, 0.1)),
        ] {
            for (one, other) in [(&less, &more), (&more, &less)] {
                assert_eq!(joined(one, other), Some(&more));
            }
        }
        assert!(joined(&error(), &error()).is_some());
        let stopped = at(Ending::Stopped, 0.2);
        let slower = Ended { seconds: 9.0, ..stopped.clone() };
        assert_eq!(joined(&stopped, &slower), Some(&stopped));
        for other in [at(Ending::Through, 0.2), at(Ending::Stopped, 0.3), ended(4, Ending::Stopped)] {
            assert_eq!(joined(&stopped, &other), None);
        }
    }
}
