//! Messages that name a law, composed at compile time: errors hold texts of the program.

use crate::host::ByStep;
use crate::law::block::Precision;
use crate::law::interface::Law;
use crate::law::linear_elastic::LinearElastic;

/// What messages say of a law's history.
pub trait History<T: Precision>: Law<T> {
    /// What the number of history variables is called.
    const NUMBER: &'static str =
        (const { &Text::new().add("number of history variables, NHV, of the ").add(Self::DESCRIPTION.title) }).get();
    /// What to say if there is no F behind them.
    const NO_GRADIENT: &'static str = (const {
        &Text::new()
            .add("there is no deformation gradient behind the history: set IHYPER = 1 or -1, and NHV = ")
            .add_number(Self::DESCRIPTION.history())
            .add(" (")
            .add(Self::DESCRIPTION.title)
            .add(")")
    })
    .get();
}

impl<T: Precision> History<T> for LinearElastic<T> {}
impl<L: ByStep + Law<T>, T: Precision> History<T> for L {}

/// A text that grows; one that is too long does not compile.
struct Text {
    bytes: [u8; 256],
    length: usize,
}

impl Text {
    const fn new() -> Self {
        Text { bytes: [0; 256], length: 0 }
    }

    const fn add(mut self, text: &str) -> Self {
        let text = text.as_bytes();
        assert!(self.length + text.len() <= self.bytes.len(), "the title of a law is too long for messages");
        let mut i = 0;
        while i < text.len() {
            self.bytes[self.length] = text[i];
            self.length += 1;
            i += 1;
        }
        self
    }

    const fn add_number(self, number: usize) -> Self {
        let start = if number < 10 { self } else { self.add_number(number / 10) };
        let digit = [b'0' + (number % 10) as u8];
        match core::str::from_utf8(&digit) {
            Ok(digit) => start.add(digit),
            Err(_) => start,
        }
    }

    const fn get(&self) -> &str {
        match core::str::from_utf8(self.bytes.split_at(self.length).0) {
            Ok(text) => text,
            Err(_) => "",
        }
    }
}
