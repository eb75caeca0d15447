//! A case as a line of text, and back: `law=frictional single=0 … properties=82.341,… point=…`.

use std::fmt::{self, Display};

use super::case::{Case, FORMS, HOSTS, Input, LAWS, OLDS, Placing};

fn list(values: &[f64]) -> String {
    values.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(",")
}

impl Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "law={} single={} host={} old={} with={} level={} measure={} rotation={} criterion={} gap={} seed={}",
            self.law as u8,
            u8::from(self.single),
            self.host as u8,
            self.old as u8,
            self.with,
            self.level,
            self.measure,
            self.rotation,
            self.criterion,
            self.gap,
            self.seed
        )?;
        write!(f, " density={:?} properties={} placings=", self.density, list(&self.properties))?;
        for Placing { form, gap, offset } in self.placings {
            write!(f, "{}{gap}{offset}", form as u8)?;
        }
        for p in &self.points {
            let groups = [&p.f[..], &p.f_old, &p.fibre, &p.second_axis, &[p.limit], &p.axes, &p.state];
            write!(f, " point={}", groups.map(list).join(";"))?;
        }
        Ok(())
    }
}

impl Case {
    /// The case of a line.
    ///
    /// # Errors
    /// What of the line cannot be read.
    pub fn of_line(line: &str) -> Result<Case, String> {
        let mut case = Case::random(0);
        case.points.clear();
        for word in line.split_whitespace() {
            let (key, text) = word.split_once('=').ok_or_else(|| format!("`{word}` is no key=value"))?;
            case.set(key, text).ok_or_else(|| format!("{key}: cannot read `{text}`"))?;
        }
        let fits = case.properties.len() == case.law.properties()
            && case.points.iter().all(|point| point.state.len() == case.law.state());
        if fits {
            Ok(case)
        } else {
            Err("the numbers of properties or state variables are not those of the law".into())
        }
    }

    fn set(&mut self, key: &str, text: &str) -> Option<()> {
        let whole = || text.parse::<usize>().ok();
        let choice = || text.parse::<i32>().ok();
        match key {
            "law" => self.law = *LAWS.get(whole()?)?,
            "single" => self.single = whole()? == 1,
            "host" => self.host = *HOSTS.get(whole()?)?,
            "old" => self.old = *OLDS.get(whole()?)?,
            "with" => self.with = text.parse().ok()?,
            "level" => self.level = choice()?,
            "measure" => self.measure = choice()?,
            "rotation" => self.rotation = choice()?,
            "criterion" => self.criterion = choice()?,
            "gap" => self.gap = whole()?,
            "seed" => self.seed = text.parse().ok()?,
            "density" => self.density = text.parse().ok()?,
            "properties" => self.properties = numbers(text)?,
            "placings" => {
                let digits: Option<Vec<usize>> = text.chars().map(|c| c.to_digit(10).map(|d| d as usize)).collect();
                for (placing, digits) in self.placings.iter_mut().zip(digits?.chunks_exact(3)) {
                    *placing = Placing { form: *FORMS.get(digits[0])?, gap: digits[1], offset: digits[2] };
                }
            }
            "point" => {
                let groups: Vec<Vec<f64>> = text.split(';').map(numbers).collect::<Option<_>>()?;
                let [f, f_old, fibre, second_axis, limit, axes, state] = <[Vec<f64>; 7]>::try_from(groups).ok()?;
                self.points.push(Input {
                    f: f.try_into().ok()?,
                    f_old: f_old.try_into().ok()?,
                    fibre: fibre.try_into().ok()?,
                    second_axis: second_axis.try_into().ok()?,
                    limit: *limit.first()?,
                    axes: axes.try_into().ok()?,
                    state,
                });
            }
            _ => return None,
        }
        Some(())
    }
}

fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split(',').map(|x| x.parse().ok()).collect()
}
