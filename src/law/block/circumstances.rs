//! When a step is, and how warm, as a host knows it.

use core::ptr::null;

use crate::law::description::Reads;
use crate::law::error::{Error, Value};
use crate::law::status;

/// When a step is, and how warm its points are. Each is read only by a law whose description says so.
#[derive(Clone, Copy, Debug)]
pub struct Circumstances<T> {
    /// The length of the step, and the time at its end; NaN if the host does not know.
    pub time_increment: f64,
    pub time: f64,
    /// The temperature of each point at the end of the step; null if the host does not know.
    pub temperature: *const T,
}

impl<T> Circumstances<T> {
    /// Those of a host that knows none.
    pub const UNKNOWN: Self = Circumstances { time_increment: f64::NAN, time: f64::NAN, temperature: null() };

    /// Those of the points from `first` on.
    pub(crate) fn from(self, first: usize) -> Self {
        let temperature = self.temperature;
        Circumstances {
            temperature: if temperature.is_null() { temperature } else { temperature.wrapping_add(first) },
            ..self
        }
    }

    /// Checks that the host knows what the law reads.
    ///
    /// # Errors
    /// A number that is needed and not finite, a step of negative length, no temperatures.
    #[inline(always)]
    pub(super) fn check(&self, reads: &Reads, n: usize) -> Result<(), Error> {
        let Reads { time_increment, time, temperature, .. } = *reads;
        if time_increment || time || temperature { self.check_those_read(reads, n) } else { Ok(()) }
    }

    /// # Errors
    /// As for [`check`](Self::check).
    #[inline(never)]
    fn check_those_read(&self, reads: &Reads, n: usize) -> Result<(), Error> {
        let wrong = |name, value: f64, wanted| Err(Error::Argument { name, value: Value::of(value), wanted });
        let unknown = |text| Err(Error::Setting { code: status::BAD_ARGUMENT, text });
        if reads.time_increment && self.time_increment.is_nan() {
            return unknown("argument time_increment is not known here, and this law reads it");
        }
        if reads.time && self.time.is_nan() {
            return unknown("argument time is not known here, and this law reads it");
        }
        if reads.time_increment && !(0.0 <= self.time_increment && self.time_increment < f64::INFINITY) {
            return wrong("time_increment", self.time_increment, "a finite number, not negative");
        }
        if reads.time && !self.time.is_finite() {
            return wrong("time", self.time, "a finite number");
        }
        if reads.temperature && n > 0 && self.temperature.is_null() {
            return unknown("argument temperature is not known here, and this law reads it");
        }
        Ok(())
    }
}
