//! Modes: which set-based tasks are active.
//!
//! n set-based tasks make 2ⁿ modes. `order` numbers them as the paper does; `search` finds the one
//! to use without going through them all.

mod order;
mod search;

pub use order::ModeOrder;
pub(crate) use search::ModeSearch;
