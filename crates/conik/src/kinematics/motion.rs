//! Which joints are between two frames.

/// How one frame moves as another sees it: through the joints that are between them.
///
/// A joint that moves both moves nothing between them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Motion {
    /// Bodies that carry the frame and not the one it is seen from, a bit each.
    pub(super) forward: u32,
    /// Bodies that carry only the frame that it is seen from: they move it the other way round.
    pub(super) backward: u32,
}

impl Motion {
    /// Whether no joint is between the two frames.
    pub fn is_none(self) -> bool {
        self.forward | self.backward == 0
    }

    /// How many joints are between the two frames; those that follow others count too.
    pub fn joints(self) -> usize {
        (self.forward | self.backward).count_ones() as usize
    }

    /// 1 for a body that moves the frame, −1 for one that moves the other frame, else 0.
    #[inline]
    pub(super) fn sign(self, body: usize) -> f64 {
        match (self.forward >> body & 1, self.backward >> body & 1) {
            (1, _) => 1.0,
            (_, 1) => -1.0,
            _ => 0.0,
        }
    }
}
