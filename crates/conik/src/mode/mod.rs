//! Modes: which set-based tasks are active.
//!
//! n set-based tasks make 2ⁿ modes. `order` numbers them as the paper does. `search` finds the paper's
//! without going through them all; `nearest` finds the one in which nothing is held that would not
//! leave.

mod asked;
mod claims;
mod frozen;
mod level;
mod nearest;
mod order;
mod search;
mod tremor;
mod within;

pub(crate) use nearest::{Nearest, NearestTick};
pub use order::ModeOrder;
pub(crate) use search::ModeSearch;
