//! A file that the child writes through its memory and the parent reads: how many calls there were, the last one's
//! arguments, and where a fault was. It outlives the child.

use std::fs::OpenOptions;
use std::io;
use std::os::fd::AsRawFd;
use std::path::Path;
use std::sync::atomic::{AtomicPtr, AtomicU64, Ordering};

const CALLS: usize = 0;
const FAULT: usize = 1;
const SIGNAL: usize = 2;
/// First and last address of each guarded array, those of [`OF_UMAT`] and then those of [`OF_VUMAT`].
const ARRAYS_AT: usize = 4;
const LENGTH: usize = ARRAYS_AT + 2 * (OF_UMAT.len() + OF_VUMAT.len());
const RECORD: usize = LENGTH + 1;
const WORDS: usize = 1 << 16;

/// The arrays between pages that must not be touched, in this order.
pub const OF_UMAT: [&str; 4] = ["STATEV", "PROPS", "STRESS", "DDSDDE"];
/// Those of a VUMAT, in the order of its arguments.
pub const OF_VUMAT: [&str; 22] = [
    "coordMp",
    "charLength",
    "props",
    "density",
    "strainInc",
    "relSpinInc",
    "tempOld",
    "stretchOld",
    "defgradOld",
    "fieldOld",
    "stressOld",
    "stateOld",
    "enerInternOld",
    "enerInelasOld",
    "tempNew",
    "stretchNew",
    "defgradNew",
    "fieldNew",
    "stressNew",
    "stateNew",
    "enerInternNew",
    "enerInelasNew",
];

pub fn names() -> impl Iterator<Item = &'static str> {
    OF_UMAT.into_iter().chain(OF_VUMAT)
}

/// The exit code of the child after a signal.
pub const SIGNALLED: i32 = 74;

static AREA: AtomicPtr<AtomicU64> = AtomicPtr::new(std::ptr::null_mut());

/// The child's side.
#[derive(Clone, Copy)]
pub struct Shared {
    words: &'static [AtomicU64],
}

/// Makes the file for a child.
pub fn create(path: &Path) -> io::Result<()> {
    std::fs::write(path, vec![0; WORDS * 8])
}

impl Shared {
    /// Maps the file, and has faults written to it.
    pub fn open(path: &Path) -> io::Result<Shared> {
        let file = OpenOptions::new().read(true).write(true).open(path)?;
        let protection = libc::PROT_READ | libc::PROT_WRITE;
        // SAFETY: a new mapping wherever the system has room, of a file of that length, which is never unmapped.
        let base =
            unsafe { libc::mmap(std::ptr::null_mut(), WORDS * 8, protection, libc::MAP_SHARED, file.as_raw_fd(), 0) };
        if base == libc::MAP_FAILED {
            return Err(io::Error::last_os_error());
        }
        // SAFETY: the mapping is WORDS words long, aligned to a page, and stays.
        let words = unsafe { std::slice::from_raw_parts(base.cast::<AtomicU64>(), WORDS) };
        AREA.store(base.cast(), Ordering::SeqCst);
        Ok(Shared { words })
    }

    /// Writes the address and the number of a signal to the file, and ends.
    pub fn catch_signals() {
        for signal in [libc::SIGSEGV, libc::SIGBUS, libc::SIGFPE, libc::SIGILL] {
            // SAFETY: a handler of the type that SA_SIGINFO wants; all else of the structure is zero, which is valid
            // for it.
            unsafe {
                let mut action: libc::sigaction = std::mem::zeroed();
                action.sa_sigaction = on_signal as *const () as usize;
                action.sa_flags = libc::SA_SIGINFO | libc::SA_ONSTACK;
                libc::sigaction(signal, &action, std::ptr::null_mut());
            }
        }
    }

    /// Counts a call and keeps its arguments.
    pub fn record(&self, arguments: &[f64]) {
        self.words[CALLS].fetch_add(1, Ordering::Relaxed);
        let length = arguments.len().min(WORDS - RECORD);
        self.words[LENGTH].store(length as u64, Ordering::Relaxed);
        for (word, value) in self.words[RECORD..].iter().zip(&arguments[..length]) {
            word.store(value.to_bits(), Ordering::Relaxed);
        }
    }

    /// Counts a call whose arguments are not kept.
    pub fn count(&self) {
        self.words[CALLS].fetch_add(1, Ordering::Relaxed);
    }

    /// Keeps where the arrays are.
    pub fn keep_array(&self, index: usize, first: usize, end: usize) {
        self.words[ARRAYS_AT + 2 * index].store(first as u64, Ordering::Relaxed);
        self.words[ARRAYS_AT + 2 * index + 1].store(end as u64, Ordering::Relaxed);
    }
}

extern "C" fn on_signal(signal: libc::c_int, info: *mut libc::siginfo_t, _: *mut libc::c_void) {
    let area = AREA.load(Ordering::SeqCst);
    if !area.is_null() {
        // SAFETY: the mapping is longer than the two words, and stays; the system hands a valid structure to a handler.
        // Stores and _exit are allowed in one.
        unsafe {
            (*area.add(FAULT)).store((*info).si_addr() as u64, Ordering::SeqCst);
            (*area.add(SIGNAL)).store(signal as u64, Ordering::SeqCst);
        }
    }
    // SAFETY: it takes a number and does not return.
    unsafe { libc::_exit(SIGNALLED) }
}

/// What the parent reads.
pub struct Seen {
    pub calls: u64,
    pub signal: u64,
    /// The last call's arguments.
    pub arguments: Vec<f64>,
    fault: u64,
    arrays: Vec<(u64, u64)>,
}

/// An array beside which a fault is.
pub struct Beside {
    pub array: &'static str,
    /// The entry, from 1 as Fortran counts.
    pub entry: i64,
    pub behind: bool,
}

impl Seen {
    pub fn read(path: &Path) -> io::Result<Seen> {
        let bytes = std::fs::read(path)?;
        let word = |index: usize| {
            let bytes = bytes.get(8 * index..8 * index + 8);
            bytes.map_or(0, |bytes| u64::from_ne_bytes(bytes.try_into().unwrap_or_default()))
        };
        let length = (word(LENGTH) as usize).min(WORDS - RECORD);
        Ok(Seen {
            calls: word(CALLS),
            signal: word(SIGNAL),
            arguments: (0..length).map(|i| f64::from_bits(word(RECORD + i))).collect(),
            fault: word(FAULT),
            arrays: (0..names().count()).map(|i| (word(ARRAYS_AT + 2 * i), word(ARRAYS_AT + 2 * i + 1))).collect(),
        })
    }

    /// How many calls the file has counted.
    pub fn calls(path: &Path) -> u64 {
        use std::os::unix::fs::FileExt;
        let mut bytes = [0; 8];
        let read = std::fs::File::open(path).and_then(|file| file.read_exact_at(&mut bytes, 8 * CALLS as u64));
        read.map_or(0, |()| u64::from_ne_bytes(bytes))
    }

    /// The array next to which the fault is, if one is near.
    pub fn beside(&self) -> Option<Beside> {
        const NEAR: u64 = 4096;
        names().zip(&self.arrays).find_map(|(array, &(first, end))| {
            let entry = (self.fault as i64 - first as i64).div_euclid(8) + 1;
            if self.fault >= end && self.fault < end + NEAR && end != 0 {
                return Some(Beside { array, entry, behind: true });
            }
            (self.fault < first && self.fault + NEAR >= first).then_some(Beside { array, entry, behind: false })
        })
    }
}
