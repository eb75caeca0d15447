//! A child process that ends with this one, however this one ends: a solver would else compute on for hours, unused.

use std::process::Command;

/// On Linux: has the system kill the command's process once the thread that starts it has ended, which it must
/// therefore outlast.
#[cfg(target_os = "linux")]
pub fn bind(command: &mut Command) {
    use std::os::unix::process::CommandExt;

    let parent = std::process::id();
    let before_it_starts = move || {
        // SAFETY: plain numbers to a system call; the request stays over exec.
        if unsafe { libc::prctl(libc::PR_SET_PDEATHSIG, libc::SIGKILL as libc::c_ulong) } != 0 {
            return Err(std::io::Error::last_os_error());
        }
        // SAFETY: it takes nothing and cannot fail. A parent that has ended before the request sends no signal.
        if unsafe { libc::getppid() } as u32 != parent {
            return Err(std::io::ErrorKind::NotFound.into());
        }
        Ok(())
    };
    // SAFETY: between fork and exec only what is safe in a signal handler may be called. Both system calls are, and
    // neither they nor the errors, which are plain codes, allocate or take a lock.
    unsafe { command.pre_exec(before_it_starts) };
}

/// Other systems have no such request: there the process goes on.
#[cfg(not(target_os = "linux"))]
pub fn bind(_: &mut Command) {}
