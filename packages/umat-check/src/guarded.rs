//! An array between pages that must not be touched.

use std::io;

/// Where the array lies between its pages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Guard {
    /// It ends at the upper page.
    Behind,
    /// It begins at the lower page.
    Before,
    /// There is room at both ends, for a law that is known to need it.
    #[serde(alias = "room")]
    Padded,
}

/// Numbers of which the first, or the last, is beside a page without access.
pub struct GuardedArray {
    mapping: *mut libc::c_void,
    size: usize,
    first: *mut f64,
    length: usize,
}

// SAFETY: the mapping belongs to this value alone.
unsafe impl Send for GuardedArray {}

/// Entries that may be touched on either side with [`Guard::Padded`].
const ROOM: usize = 512;

impl GuardedArray {
    /// # Errors
    /// The system has no memory.
    pub fn new(length: usize, guard: Guard) -> io::Result<GuardedArray> {
        // SAFETY: it takes a number and gives one.
        let page = unsafe { libc::sysconf(libc::_SC_PAGESIZE) } as usize;
        let bytes = 8 * if guard == Guard::Padded { length + 2 * ROOM } else { length };
        let inner = bytes.div_ceil(page).max(1) * page;
        let size = inner + 2 * page;
        let flags = libc::MAP_PRIVATE | libc::MAP_ANONYMOUS;
        // SAFETY: a new mapping wherever the system has room.
        let mapping = unsafe { libc::mmap(std::ptr::null_mut(), size, libc::PROT_NONE, flags, -1, 0) };
        if mapping == libc::MAP_FAILED {
            return Err(io::Error::last_os_error());
        }
        // SAFETY: the pages between the first and the last are within the mapping.
        let protected = unsafe { libc::mprotect(mapping.add(page), inner, libc::PROT_READ | libc::PROT_WRITE) };
        if protected != 0 {
            return Err(io::Error::last_os_error());
        }
        let offset = match guard {
            Guard::Behind => inner - 8 * length,
            Guard::Before => 0,
            Guard::Padded => 8 * ROOM,
        };
        // SAFETY: within the pages that may be touched, and a multiple of eight bytes, since a page's length is one.
        let first = unsafe { mapping.add(page + offset) }.cast();
        Ok(GuardedArray { mapping, size, first, length })
    }

    pub fn as_mut_ptr(&mut self) -> *mut f64 {
        self.first
    }

    pub fn numbers(&self) -> &[f64] {
        // SAFETY: so many numbers are within the pages that may be touched; any bits are a number.
        unsafe { std::slice::from_raw_parts(self.first, self.length) }
    }

    pub fn numbers_mut(&mut self) -> &mut [f64] {
        // SAFETY: as above, and nobody else has them.
        unsafe { std::slice::from_raw_parts_mut(self.first, self.length) }
    }

    /// As many numbers of half the length, in the first half.
    pub fn single(&self) -> &[f32] {
        // SAFETY: they are within the numbers that `numbers` has, and any bits are a number.
        unsafe { std::slice::from_raw_parts(self.first.cast(), self.length) }
    }

    pub fn single_mut(&mut self) -> &mut [f32] {
        // SAFETY: as above, and nobody else has them.
        unsafe { std::slice::from_raw_parts_mut(self.first.cast(), self.length) }
    }

    /// The addresses of the first entry and of the one behind the last.
    pub fn addresses(&self) -> (usize, usize) {
        (self.first as usize, self.first as usize + 8 * self.length)
    }
}

impl Drop for GuardedArray {
    fn drop(&mut self) {
        // SAFETY: the mapping that was made, once.
        unsafe { libc::munmap(self.mapping, self.size) };
    }
}
