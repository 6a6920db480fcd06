//! Whether there is still somebody who could press a key.

#[cfg(not(unix))]
use std::io;
#[cfg(not(unix))]
use std::time::Duration;

#[cfg(unix)]
pub(super) use unix::Keyboard;

#[cfg(unix)]
mod unix {
    use std::fs::File;
    use std::io::{self, IsTerminal, Stdin};
    use std::os::fd::{AsFd, BorrowedFd};
    use std::time::Duration;

    use rustix::event::{PollFd, PollFlags, Timespec, poll};
    use rustix::io::Errno;

    /// The terminal that keys are read from. Reading the keys of one that was hung up would spin in
    /// crossterm for ever, so it is asked first.
    #[derive(Debug)]
    pub enum Keyboard {
        Input(Stdin),
        /// Where standard input comes from elsewhere.
        Device(File),
    }

    impl Keyboard {
        /// The terminal that crossterm reads from too.
        pub fn find() -> io::Result<Self> {
            let input = io::stdin();
            if input.is_terminal() {
                Ok(Self::Input(input))
            } else {
                File::open("/dev/tty").map(Self::Device)
            }
        }

        /// Waits for a key, but no longer than `timeout`.
        ///
        /// # Errors
        ///
        /// If the terminal was hung up.
        pub fn wait(&self, timeout: Duration) -> io::Result<()> {
            let mut terminal = [PollFd::from_borrowed_fd(self.as_fd(), PollFlags::IN)];
            let timeout = Timespec::try_from(timeout).map_err(io::Error::other)?;
            match poll(&mut terminal, Some(&timeout)) {
                // A signal, of a new size for instance.
                Ok(_) | Err(Errno::INTR) => {}
                Err(error) => return Err(error.into()),
            }
            let gone = PollFlags::HUP | PollFlags::ERR | PollFlags::NVAL;
            if terminal[0].revents().intersects(gone) {
                return Err(io::ErrorKind::BrokenPipe.into());
            }
            Ok(())
        }

        fn as_fd(&self) -> BorrowedFd<'_> {
            match self {
                Self::Input(input) => input.as_fd(),
                Self::Device(file) => file.as_fd(),
            }
        }
    }
}

/// The window that keys come from.
#[cfg(not(unix))]
#[derive(Debug)]
pub(super) struct Keyboard;

#[cfg(not(unix))]
impl Keyboard {
    pub(super) fn find() -> io::Result<Self> {
        Ok(Self)
    }

    /// Waits for a key, but no longer than `timeout`.
    pub(super) fn wait(&self, timeout: Duration) -> io::Result<()> {
        ratatui_crossterm::crossterm::event::poll(timeout).map(drop)
    }
}
