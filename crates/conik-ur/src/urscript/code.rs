//! A program as the machine runs it: instructions for a stack of values.

use super::signature::Signature;
use super::syntax::{Binary, Unary};
use super::value::Value;

/// One instruction. What it needs it takes from the stack, what it gives it puts there.
#[derive(Clone, Copy, Debug)]
pub(super) enum Instruction {
    Constant(u32),
    LoadGlobal(u16),
    LoadLocal(u16),
    StoreGlobal(u16),
    StoreLocal(u16),
    /// Takes an index, then a value below it.
    StoreGlobalElement(u16),
    StoreLocalElement(u16),
    /// Takes an index, then what has elements.
    Element,
    Unary(Unary),
    Binary(Binary),
    List(u16),
    Pose,
    Jump(u32),
    JumpUnless(u32),
    /// A function of the program, by its number.
    Call(u16),
    /// A function of the controller.
    Builtin(&'static Signature),
    /// Fails if a call has given nothing.
    NeedValue,
    Drop,
    Return,
    Halt,
}

/// A function of the program.
#[derive(Clone, Debug, Default)]
pub(super) struct CodeOfFunction {
    pub(super) name: String,
    /// Its first instruction.
    pub(super) entry: u32,
    pub(super) parameters: Vec<String>,
    /// Names of its local variables, the parameters first.
    pub(super) locals: Vec<String>,
}

/// A program that can be run.
#[derive(Clone, Debug, Default)]
pub(super) struct Code {
    pub(super) instructions: Vec<Instruction>,
    /// The line of each instruction.
    pub(super) lines: Vec<u32>,
    pub(super) constants: Vec<Value>,
    pub(super) globals: Vec<String>,
    pub(super) functions: Vec<CodeOfFunction>,
}

impl Code {
    /// The line of an instruction.
    pub(super) fn line(&self, at: usize) -> u32 {
        self.lines.get(at).copied().unwrap_or(0)
    }
}
