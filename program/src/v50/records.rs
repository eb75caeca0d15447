//! The table of shots, which grows by a line with each one that ends, and from which a run goes on.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use csv::{ReaderBuilder, StringRecord, WriterBuilder};

use super::scene::{Scene, Shot};
use super::shot::{Ended, Ending};
use crate::common::error::Error;
use crate::common::run_directory::{file_error, is_file};
use crate::common::text_table::{NONE, or_dash};
use crate::common::units::{LENGTH, SPEED, TIME};
use crate::struck::checkpoint;
use crate::struck::history::title;

/// The words of endings.
const ENDINGS: [&str; 4] = ["stopped", "through", "undecided", "error"];

/// Shots that have ended, by their numbers, and their file.
pub struct Records {
    place: PathBuf,
    titles: Vec<String>,
    /// Of which scene and which build of the program they are.
    of: [String; 2],
    pub shots: BTreeMap<usize, Ended>,
    file: Option<File>,
}

impl Records {
    /// The table at a place, with nothing in it yet.
    ///
    /// # Errors
    /// The program's own file cannot be read.
    pub fn new(scene: &Scene, place: &Path) -> Result<Records, Error> {
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
            "scene".to_string(),
            "build".to_string(),
            "error".to_string(),
        ];
        let of = [scene.identity(), checkpoint::build()?].map(|number| format!("{number:08x}"));
        Ok(Records { place: place.to_path_buf(), titles, of, shots: BTreeMap::new(), file: None })
    }

    /// Adds the shots of a file of this scene and this build. One that stands here already has to be the same, or of two ends of which one
    /// was too early.
    ///
    /// # Errors
    /// The file cannot be read, is another table, or of another scene or build.
    pub fn read(&mut self, place: &Path) -> Result<usize, Error> {
        let mut text = std::fs::read_to_string(place).map_err(|error| file_error(place, &error))?;
        // A line without an end is of a run that was killed as it wrote it.
        text.truncate(text.rfind('\n').map_or(0, |end| end + 1));
        let mut reader = ReaderBuilder::new().from_reader(text.as_bytes());
        let titles = reader.headers().map_err(|error| file_error(place, &error))?;
        if titles != self.titles {
            let allowed = format!("allowed: {}", self.titles.join(", "));
            return Err(file_error(place, &format!("its columns are not those of shots in these units; {allowed}")));
        }
        let mut count = 0;
        for (line, record) in (2..).zip(reader.records()) {
            let record = record.map_err(|error| file_error(place, &error))?;
            let wrong = |what: &str| Error::Input(format!("{}:{line}: {what}", place.display()));
            let ended =
                parsed(&record).ok_or_else(|| wrong("a line that is of no shot; allowed: the lines of toron v50"))?;
            let of = [12, 13].map(|column| record.get(column).unwrap_or_default());
            for (found, (own, what)) in of.iter().zip(self.of.iter().zip(["scene", "build of the program"])) {
                if found != own {
                    let allowed = "allowed: shots of this scene, but for number, extension, tolerance, spread, end, sample, pictures, \
                                   frames and checkpoints, and of this build";
                    return Err(wrong(&format!("a shot of another {what} ({found}, not {own}); {allowed}")));
                }
            }
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

    /// Whether the table stands there.
    ///
    /// # Errors
    /// Something else does.
    pub fn is_there(&self) -> Result<bool, Error> {
        is_file(&self.place)
    }

    /// Writes the table anew, in one go and in the order of the numbers, and opens it for more.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn open(&mut self) -> Result<(), Error> {
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
        if self.shots.insert(ended.shot.number, ended).is_some() {
            return self.open();
        }
        self.file.as_mut().map_or(Ok(()), |file| file.write_all(&line)).map_err(|error| file_error(&self.place, &error))
    }

    fn cells(&self, ended: &Ended) -> Vec<String> {
        let Ended { shot, ending, speed_at_end, time, verdict, seconds } = ended;
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
            format!("{seconds:.2}"),
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

/// The shot of a line.
fn parsed(record: &StringRecord) -> Option<Ended> {
    let number = |column: usize| record.get(column)?.parse::<f64>().ok();
    let seed = match record.get(5)? {
        NONE => None,
        seed => Some(seed.parse().ok()?),
    };
    let shot = Shot {
        number: record.get(0)?.parse().ok()?,
        nominal: number(1)?,
        speed: number(2)?,
        aim: [number(3)?, number(4)?],
        seed,
    };
    let ending = match ENDINGS.iter().position(|word| record.get(6) == Some(word))? {
        0 => Ending::Stopped,
        1 => Ending::Through,
        2 => Ending::Undecided,
        _ => Ending::Error(record.get(14)?.to_string()),
    };
    Some(Ended {
        shot,
        ending,
        speed_at_end: number(8)?,
        time: number(9)?,
        verdict: record.get(10)?.to_string(),
        seconds: number(11)?,
    })
}

/// Which of two lines of one shot tells more: one that was undecided gives way to a later end. None where they are of two shots.
fn joined<'a>(one: &'a Ended, other: &'a Ended) -> Option<&'a Ended> {
    let gives_way = |early: &Ended, late: &Ended| early.ending == Ending::Undecided && early.time < late.time;
    // But for how long it took.
    let same = one.ending == other.ending && one.speed_at_end == other.speed_at_end && one.time == other.time;
    match one.shot == other.shot {
        true if same || gives_way(other, one) => Some(one),
        true if gives_way(one, other) => Some(other),
        _ => None,
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
        Ended { shot, ending, speed_at_end: 1.0 / 3.0, time: 0.1, verdict: "mesh; contact".to_string(), seconds: 1.25 }
    }

    /// What is written is read again to the bit; a line that is not whole is no shot, and one of a number takes the place of another.
    #[test]
    fn shots_are_read_as_they_were_written() {
        let folder = std::env::temp_dir().join(format!("toron-shots-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let place = folder.join("shots.csv");
        let scene = scene(1);
        let mut records = Records::new(&scene, &place).expect("a table");
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

        let mut again = Records::new(&scene, &place).expect("a table");
        assert_eq!(again.read(&place).expect("the shots"), 4);
        let error = ended(4, Ending::Error(message.replace('\n', " ")));
        assert_eq!(again.shots.remove(&4), Some(error.clone()));
        assert_eq!(records.shots.remove(&4).map(|ended| ended.shot), Some(error.shot));
        assert_eq!(again.shots, records.shots);

        // Of an undecided shot the later end stands, whichever is read first; a decided one is no other than it is.
        let mut later = ended(3, Ending::Through);
        later.time = 0.2;
        let early = ended(3, Ending::Undecided);
        assert_eq!((joined(&early, &later), joined(&later, &early)), (Some(&later), Some(&later)));
        assert_eq!(joined(&ended(3, Ending::Stopped), &later), None);

        let refused = |change: &dyn Fn(&str) -> String, scene: &Scene| {
            std::fs::write(&place, change(&text)).expect("it is written");
            let mut records = Records::new(scene, &place).expect("a table");
            records.shots.insert(1, ended(1, Ending::Through));
            records.read(&place).expect_err("a change").to_string()
        };
        let same = |text: &str| text.to_string();
        assert!(refused(&same, &self::scene(2)).contains("shots.csv:2: a shot of another scene"));
        assert!(refused(&|text| text.replace("0.1,-", "0.2,-"), &scene).contains("another shot 1 than the one before"));
        assert!(refused(&|text| text.replace("through", "over"), &scene).contains("a line that is of no shot"));
        assert!(refused(&|text| text.replace("mm/ms", "m/s"), &scene).contains("columns are not those"));
        std::fs::remove_dir_all(&folder).expect("it is removed");
    }
}
