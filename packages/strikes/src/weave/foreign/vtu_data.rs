//! The arrays of a VTU file that are no text: in base64 or raw, beside their names or appended, compressed by zlib or
//! not.

use std::borrow::Cow;
use std::io::Read;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use roxmltree::Node;

/// How a file writes its numbers.
pub struct Encoding {
    little: bool,
    /// Bytes of a number in front of an array that says how long it is.
    header: usize,
    compressor: String,
}

/// What is appended behind the arrays' names.
pub struct Appended<'a> {
    raw: bool,
    data: &'a [u8],
}

fn find(bytes: &[u8], what: &[u8]) -> Option<usize> {
    bytes.windows(what.len()).position(|window| window == what)
}

impl<'a> Appended<'a> {
    /// The file's XML without what is appended, and this.
    pub fn split(bytes: &'a [u8]) -> (Cow<'a, [u8]>, Option<Appended<'a>>) {
        let found = find(bytes, b"<AppendedData").and_then(|tag| {
            let end = tag + find(&bytes[tag..], b">")? + 1;
            let start = end + find(&bytes[end..], b"_")? + 1;
            Some((tag, end, start))
        });
        let Some((tag, end, start)) = found else { return (Cow::Borrowed(bytes), None) };
        let raw = find(&bytes[tag..end], b"raw").is_some();
        let data = &bytes[start..];
        // Raw data may have anything in it: each array says how long it is.
        let data = if raw { data } else { &data[..find(data, b"<").unwrap_or(data.len())] };
        (Cow::Owned([&bytes[..tag], b"</VTKFile>"].concat()), Some(Appended { raw, data }))
    }
}

impl Encoding {
    /// Of a file with this root.
    ///
    /// # Errors
    /// It is none that is read here.
    pub fn of(root: Node<'_, '_>) -> Result<Encoding, String> {
        let one_of = |name: &str, default: &'static str, all: &[&str]| {
            let value = root.attribute(name).unwrap_or(default);
            let found = all.iter().position(|known| *known == value);
            found.ok_or_else(|| format!("{name} is {value}; allowed: {}", all.join(", ")))
        };
        Ok(Encoding {
            little: one_of("byte_order", "LittleEndian", &["LittleEndian", "BigEndian"])? == 0,
            header: [4, 8][one_of("header_type", "UInt32", &["UInt32", "UInt64"])?],
            compressor: root.attribute("compressor").unwrap_or_default().to_string(),
        })
    }

    /// The bytes of an array in base64.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn from_text(&self, text: &str) -> Result<Vec<u8>, String> {
        let characters: Vec<u8> = text.bytes().filter(|byte| !byte.is_ascii_whitespace()).collect();
        let mut bytes = Vec::new();
        // The lengths in front may be encoded on their own: then there is padding within.
        let mut rest = &characters[..];
        while !rest.is_empty() {
            let end = rest.iter().position(|&byte| byte == b'=').map_or(rest.len(), |pad| (pad / 4 + 1) * 4);
            let (part, behind) = rest.split_at(end.min(rest.len()));
            STANDARD.decode_vec(part, &mut bytes).map_err(|error| format!("is no base64: {error}"))?;
            rest = behind;
        }
        self.data(&bytes)
    }

    /// The bytes of an array that begins at this offset; in base64 it ends where the next one begins.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn appended(&self, appended: &Appended<'_>, offset: usize, end: Option<usize>) -> Result<Vec<u8>, String> {
        let length = appended.data.len();
        let beyond = || format!("begins at {offset} of {length} appended bytes; allowed: less");
        let data = appended.data.get(offset..).ok_or_else(beyond)?;
        if appended.raw {
            return self.data(data);
        }
        let own = &data[..end.map_or(data.len(), |end| (end - offset).min(data.len()))];
        self.from_text(&String::from_utf8_lossy(own))
    }

    /// What an array's bytes are without the lengths in front, and expanded.
    fn data(&self, bytes: &[u8]) -> Result<Vec<u8>, String> {
        let short = || "is shorter than it says".to_string();
        let number = |place: usize| -> Result<usize, String> {
            let start = place.checked_mul(self.header).ok_or_else(short)?;
            let own = bytes.get(start..start + self.header).ok_or_else(short)?;
            let digits = own.iter().map(|&byte| u64::from(byte));
            let sum = |sum: u64, byte: u64| sum << 8 | byte;
            let value = if self.little { digits.rev().fold(0, sum) } else { digits.fold(0, sum) };
            usize::try_from(value).map_err(|_| short())
        };
        if bytes.is_empty() {
            return Ok(Vec::new());
        }
        match self.compressor.as_str() {
            "" => {
                let length = number(0)?;
                let own = bytes.get(self.header..).and_then(|data| data.get(..length));
                return Ok(own.ok_or_else(short)?.to_vec());
            }
            "vtkZLibDataCompressor" => {}
            other => return Err(format!("is compressed by {other}; allowed: vtkZLibDataCompressor, or none")),
        }
        let [blocks, block, last] = [number(0)?, number(1)?, number(2)?];
        let mut start = blocks.checked_add(3).and_then(|count| count.checked_mul(self.header)).ok_or_else(short)?;
        let mut data = Vec::new();
        for place in 0..blocks {
            let length = number(3 + place)?;
            let end = start.checked_add(length).ok_or_else(short)?;
            // Without a shorter last block that number is 0.
            let wanted = if place + 1 == blocks && last > 0 { last } else { block };
            let before = data.len();
            let decoder = ZlibDecoder::new(bytes.get(start..end).ok_or_else(short)?);
            decoder
                .take((wanted as u64).saturating_add(1))
                .read_to_end(&mut data)
                .map_err(|error| format!("is no zlib data: {error}"))?;
            if data.len() - before != wanted {
                return Err(format!("has {} bytes in a block; allowed: {wanted}", data.len() - before));
            }
            start = end;
        }
        Ok(data)
    }

    /// Numbers of a type of VTK's.
    ///
    /// # Errors
    /// There is no such type, or there is a part of a number.
    pub fn reals(&self, kind: &str, bytes: &[u8]) -> Result<Vec<f64>, String> {
        match kind {
            "Float32" => self.each(bytes, |bytes| f64::from(f32::from_le_bytes(bytes))),
            "Float64" => self.each(bytes, f64::from_le_bytes),
            _ => Ok(self.integers(kind, bytes)?.into_iter().map(|number| number as f64).collect()),
        }
    }

    /// Whole numbers of a type of VTK's.
    ///
    /// # Errors
    /// There is no such type, there is a part of a number, or one is below 0.
    pub fn integers(&self, kind: &str, bytes: &[u8]) -> Result<Vec<u64>, String> {
        let signed: Vec<i64> = match kind {
            "UInt8" => return self.each(bytes, |bytes| u64::from(u8::from_le_bytes(bytes))),
            "UInt16" => return self.each(bytes, |bytes| u64::from(u16::from_le_bytes(bytes))),
            "UInt32" => return self.each(bytes, |bytes| u64::from(u32::from_le_bytes(bytes))),
            "UInt64" => return self.each(bytes, u64::from_le_bytes),
            "Int8" => self.each(bytes, |bytes| i64::from(i8::from_le_bytes(bytes)))?,
            "Int16" => self.each(bytes, |bytes| i64::from(i16::from_le_bytes(bytes)))?,
            "Int32" => self.each(bytes, |bytes| i64::from(i32::from_le_bytes(bytes)))?,
            "Int64" => self.each(bytes, i64::from_le_bytes)?,
            other => return Err(format!("is of type {other}; allowed: whole numbers, Int8 to UInt64")),
        };
        let below = |number: i64| format!("has the entry {number}; allowed: 0 and more");
        signed.into_iter().map(|number| u64::try_from(number).map_err(|_| below(number))).collect()
    }

    fn each<const N: usize, T>(&self, bytes: &[u8], number: impl Fn([u8; N]) -> T) -> Result<Vec<T>, String> {
        let (all, rest) = bytes.as_chunks::<N>();
        if !rest.is_empty() {
            return Err(format!("has {} bytes; allowed: a multiple of {N}", bytes.len()));
        }
        let ordered = |mut bytes: [u8; N]| {
            if !self.little {
                bytes.reverse();
            }
            bytes
        };
        Ok(all.iter().map(|&bytes| number(ordered(bytes))).collect())
    }
}
