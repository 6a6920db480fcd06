//! Runs that a person changes while they go on: paused, stepped, slowed down, with other bounds, gains,
//! rules, places and priorities.
//!
//! A change makes a whole new scenario of the present one ([`Change`]), which is checked as a file is. What
//! runs it, the next [`Stretch`] of the run, is made ready beside the loop and handed over at the [`Helm`]; the
//! loop takes it up between two ticks, with everything that has come about so far. Points, directions and
//! bounds of sets do not jump then, they glide ([`Away`]). Nothing here knows who asks.

mod change;
mod edit;
mod glide;
mod helm;
mod pace;
mod stretch;

pub use change::{Change, ChangeError};
pub use glide::{Away, GlideSpeed};
pub use helm::Helm;
pub(crate) use pace::{Pace, Turn};
pub use stretch::{Gliding, Stretch, StretchError};
