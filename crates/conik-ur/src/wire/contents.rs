//! Reads the contents of a package from front to end.

use super::WireError;
use super::frame::Frame;

/// What is left to read of a package.
pub(super) struct Contents<'a> {
    rest: &'a [u8],
    size: usize,
}

impl<'a> Contents<'a> {
    /// All contents of a package.
    pub(super) fn of(frame: &'a Frame) -> Self {
        Self {
            rest: &frame.payload,
            size: frame.payload.len(),
        }
    }

    /// The next `N` bytes.
    pub(super) fn take<const N: usize>(
        &mut self,
        package: &'static str,
    ) -> Result<[u8; N], WireError> {
        let (front, rest) = self
            .rest
            .split_first_chunk::<N>()
            .ok_or_else(|| self.too_short(package, N))?;
        self.rest = rest;
        Ok(*front)
    }

    /// The next `size` bytes.
    pub(super) fn take_slice(
        &mut self,
        package: &'static str,
        size: usize,
    ) -> Result<&'a [u8], WireError> {
        let (front, rest) = self
            .rest
            .split_at_checked(size)
            .ok_or_else(|| self.too_short(package, size))?;
        self.rest = rest;
        Ok(front)
    }

    /// All that is left.
    pub(super) fn take_rest(&mut self) -> &'a [u8] {
        std::mem::take(&mut self.rest)
    }

    fn too_short(&self, package: &'static str, more: usize) -> WireError {
        WireError::TooShort {
            package,
            need: self.size - self.rest.len() + more,
            have: self.size,
        }
    }

    /// A byte that is zero or not.
    pub(super) fn flag(&mut self, package: &'static str) -> Result<bool, WireError> {
        Ok(self.take::<1>(package)? != [0])
    }

    /// All that is left, as text.
    pub(super) fn text(&mut self, package: &'static str) -> Result<&'a str, WireError> {
        std::str::from_utf8(self.take_rest()).map_err(|_| WireError::NotText(package))
    }

    /// `value`, if nothing is left.
    pub(super) fn end<T>(self, package: &'static str, value: T) -> Result<T, WireError> {
        if self.rest.is_empty() {
            return Ok(value);
        }
        Err(WireError::TooLong {
            package,
            surplus: self.rest.len(),
        })
    }
}
