//! Changes of a file: bytes, lines, numbers, pieces of another file of its kind.

use fastrand::Rng;

/// What no file expects in the place of a number or a word.
const HOSTILE: [&str; 34] = [
    "0",
    "-1",
    "1e999",
    "-1e999",
    "nan",
    "inf",
    "1e-320",
    "999999999999",
    "-9223372036854775808",
    "1e18",
    "1e9",
    "65536",
    "2147483648",
    "0.0",
    "\"\"",
    "\"é\u{301}\u{1f9f5}\"",
    "[",
    "]",
    "{",
    "}",
    "=",
    "[]",
    "[[]]",
    "#",
    "'",
    "\"\"\"",
    "\0",
    "\t",
    "\r\n",
    ",",
    ";",
    "1,5",
    "true",
    "*",
];

/// A file with one to four changes.
pub fn mutated(rng: &mut Rng, bytes: &[u8], other: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..rng.u8(1..5) {
        change(rng, &mut bytes, other);
    }
    bytes
}

fn change(rng: &mut Rng, bytes: &mut Vec<u8>, other: &[u8]) {
    let n = bytes.len();
    if n == 0 {
        bytes.extend(HOSTILE[rng.usize(..HOSTILE.len())].bytes());
        return;
    }
    let (from, length) = (rng.usize(..n), rng.usize(..64));
    let to = n.min(from + length);
    match rng.u8(0..20) {
        0 => bytes[from] = rng.u8(..),
        1 => bytes[from] ^= 1 << rng.u8(..8),
        2 => drop(bytes.drain(from..to)),
        3 => bytes.truncate(from),
        4 => {
            let piece = bytes[from..to].to_vec();
            bytes.splice(from..from, piece);
        }
        5 => {
            let start = rng.usize(..=other.len());
            let piece = &other[start..other.len().min(start + rng.usize(..400))];
            bytes.splice(from..to, piece.iter().copied());
        }
        6 => drop(bytes.splice(from..from, HOSTILE[rng.usize(..HOSTILE.len())].bytes())),
        7 | 8 => lines(rng, bytes),
        _ => token(rng, bytes),
    }
}

/// Swaps, repeats or removes lines.
fn lines(rng: &mut Rng, bytes: &mut Vec<u8>) {
    let mut lines: Vec<&[u8]> = bytes.split_inclusive(|&byte| byte == b'\n').collect();
    let (a, b) = (rng.usize(..lines.len()), rng.usize(..lines.len()));
    match rng.u8(0..3) {
        0 => lines.swap(a, b),
        1 => lines.insert(a, lines[b]),
        _ => drop(lines.remove(a)),
    }
    *bytes = lines.concat();
}

/// Replaces a number or a word, most often a number by a hostile one.
fn token(rng: &mut Rng, bytes: &mut Vec<u8>) {
    let is_part = |byte: &u8| byte.is_ascii_alphanumeric() || b"+-._".contains(byte);
    let starts: Vec<usize> =
        (0..bytes.len()).filter(|&i| is_part(&bytes[i]) && (i == 0 || !is_part(&bytes[i - 1]))).collect();
    let numbers: Vec<usize> =
        starts.iter().copied().filter(|&i| bytes[i].is_ascii_digit() || bytes[i] == b'-').collect();
    let among = if numbers.is_empty() || rng.u8(0..4) == 0 { &starts } else { &numbers };
    if among.is_empty() {
        return;
    }
    let from = among[rng.usize(..among.len())];
    let to = from + bytes[from..].iter().take_while(|byte| is_part(byte)).count();
    bytes.splice(from..to, HOSTILE[rng.usize(..HOSTILE.len())].bytes());
}
