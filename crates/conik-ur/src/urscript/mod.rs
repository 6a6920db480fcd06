//! A small interpreter of `URScript`: as much of the language as the programs of this crate need,
//! and a refusal by name for the rest.
//!
//! ```text
//!   text ── lexer ──► tokens ── parser ──► syntax ── compiler ──► code ── machine ──► pauses
//!                             expression              scope              value
//!                                                     signature          builtin ──► surroundings
//! ```
//!
//! | part | what there is |
//! |---|---|
//! | program | one `def` or `sec` without parameters, or a single line |
//! | statements | assignment (`global`, `local` or neither), of elements too; calls; `if`, `elif`, `else`; `while`, `break`, `continue`; `def`, `return`; `halt`; `pass` |
//! | values | integers of 32 bits, floats, `True` and `False`, texts, lists of these and of poses, poses `p[..]` |
//! | operators | `or`, `xor`, `and`, `not`, comparisons, `+ - * / %`, elements `a[i]`; both operands are always evaluated |
//! | arguments | by place or by name |
//! | functions | those of the program that stand above the call, and of the controller those of `signature` |
//!
//! Time passes in `servoj`, `stopj`, `sleep` and `sync` only. A program that runs on without them
//! for [`MOST_INSTRUCTIONS`] is over. A name that nothing stands behind, a wrong number of
//! arguments and the parts of the language that are missing (threads above all) are refused before
//! anything runs; wrong types, indices and ranges and results that are not finite end the program.
//! Each fault has its line. No text makes the interpreter panic, recurse without bound or grow
//! without bound.
//!
//! Where the maker's manual is silent the choice is the narrower one, so that what runs here may be
//! expected to run on a controller.

mod arguments;
mod builtin;
mod code;
mod compiler;
mod error;
mod expression;
mod lexer;
mod machine;
mod parser;
mod scope;
mod signature;
mod surroundings;
mod syntax;
#[cfg(test)]
mod tests;
mod value;

pub use error::{Fault, ScriptError};
pub use machine::{MOST_INSTRUCTIONS, Machine};
pub use surroundings::{Joints, Register, Surroundings, WatchdogAction};

use std::sync::Arc;

/// A program that was read and can be run.
#[derive(Clone, Debug)]
pub struct Program {
    name: String,
    is_secondary: bool,
    code: Arc<code::Code>,
}

impl Program {
    /// Reads a program; the error says why it cannot run here.
    pub fn parse(text: &str) -> Result<Self, ScriptError> {
        let whole = parser::parse(text)?;
        Ok(Self {
            code: Arc::new(compiler::compile(&whole)?),
            name: whole.function.name,
            is_secondary: whole.is_secondary,
        })
    }

    /// What it calls itself.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether it runs beside another program and takes no time.
    pub fn is_secondary(&self) -> bool {
        self.is_secondary
    }
}

/// Why a program gives control away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pause {
    /// The joints follow a target.
    Servoj {
        /// Target of the joints [rad].
        target: [f64; 6],
        /// How long it holds control [s].
        time_s: f64,
        /// Lookahead [s], 0.03 to 0.2.
        lookahead_s: f64,
        /// Gain, 100 to 2000.
        gain: f64,
    },
    /// The joints come to rest.
    Stopj {
        /// Deceleration [rad/s²].
        deceleration: f64,
    },
    /// Nothing happens for some time.
    Sleep {
        /// How long [s].
        time_s: f64,
    },
    /// The rest of this control cycle passes.
    Sync,
    /// The program is over.
    Ended,
}
