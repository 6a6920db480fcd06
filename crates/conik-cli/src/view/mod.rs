//! The page that shows a run: its data, and the server that hands out both.
//!
//! A [`Recording`] is what the page reads: of each run a [`Scene`] (what there is) and [`Ticks`] (what
//! happened), as `docs/page.md` describes them. The page itself is `viewer/`, built into one file that
//! is embedded here. Nothing here draws.

mod guard;
pub mod live;
mod page;
mod recording;
mod robot;
mod scene;
pub mod server;
mod ticks;
mod upgrade;

pub use page::PAGE;
pub use recording::{Recording, ViewError};
pub use robot::RobotTree;
pub use scene::Scene;
pub use ticks::{MOST_ROWS, Ticks};

/// Version of the page's data.
pub const PROTOCOL: u32 = 1;
