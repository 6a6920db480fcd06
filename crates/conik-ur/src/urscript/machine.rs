//! Runs a program step by step, from one call that takes time to the next.

use super::builtin::Outcome;
use super::code::{Code, Instruction};
use super::error::{Fault, ScriptError};
use super::surroundings::Surroundings;
use super::value::{self, Value};
use super::{Pause, Program};
use std::sync::Arc;

/// Instructions between two calls that take time. Ours is the choice; the maker's is not published.
pub const MOST_INSTRUCTIONS: u32 = 10_000;

/// Calls inside of each other.
const DEEPEST_CALLS: usize = 50;

/// Values on the stack when a function is called.
const MOST_VALUES: usize = 10_000;

/// A program while it runs.
#[derive(Clone, Debug)]
pub struct Machine {
    code: Arc<Code>,
    /// The instruction that comes next.
    next: usize,
    /// Local variables and unfinished results, those of the present function on top.
    stack: Vec<Value>,
    globals: Vec<Value>,
    frames: Vec<Frame>,
}

/// A function that is being run.
#[derive(Clone, Copy, Debug)]
struct Frame {
    function: u16,
    /// Where its local variables begin.
    base: usize,
    /// Where its caller goes on.
    back_to: usize,
}

impl Machine {
    /// A program that has not begun.
    pub fn new(program: &Program) -> Self {
        let code = Arc::clone(&program.code);
        Self {
            next: 0,
            stack: Vec::new(),
            globals: vec![Value::Nothing; code.globals.len()],
            frames: Vec::new(),
            code,
        }
    }

    /// Goes on until the next call that takes time, or to the end of the program.
    ///
    /// After an error, and after [`Pause::Ended`], the program is over: each further call gives
    /// [`Pause::Ended`].
    pub fn run(&mut self, around: &mut dyn Surroundings) -> Result<Pause, ScriptError> {
        let code = Arc::clone(&self.code);
        for _ in 0..MOST_INSTRUCTIONS {
            let at = self.next;
            let Some(instruction) = code.instructions.get(at) else {
                return Ok(Pause::Ended);
            };
            self.next = at + 1;
            match self.step(&code, instruction, around) {
                Ok(None) => {}
                Ok(Some(pause)) => return Ok(pause),
                Err(fault) => {
                    self.next = usize::MAX;
                    return Err(fault.at(code.line(at)));
                }
            }
        }
        let line = code.line(self.next);
        self.next = usize::MAX;
        Err(Fault::NeverWaits(MOST_INSTRUCTIONS).at(line))
    }

    /// One instruction.
    fn step(
        &mut self,
        code: &Code,
        instruction: &Instruction,
        around: &mut dyn Surroundings,
    ) -> Result<Option<Pause>, Fault> {
        match *instruction {
            Instruction::Constant(number) => {
                let constant = code.constants.get(number as usize);
                self.stack.push(constant.cloned().unwrap_or(Value::Nothing));
            }
            Instruction::LoadGlobal(slot) => {
                let value = self.globals[usize::from(slot)].clone();
                let value = assigned(value, &code.globals, slot)?;
                self.stack.push(value);
            }
            Instruction::LoadLocal(slot) => {
                let value = self.local(slot).clone();
                let value = assigned(value, self.local_names(code), slot)?;
                self.stack.push(value);
            }
            Instruction::StoreGlobal(slot) => self.globals[usize::from(slot)] = self.pop(),
            Instruction::StoreLocal(slot) => *self.local(slot) = self.pop(),
            Instruction::StoreGlobalElement(slot) => {
                let (index, value) = (self.pop(), self.pop());
                self.globals[usize::from(slot)].set_element(&index, value)?;
            }
            Instruction::StoreLocalElement(slot) => {
                let (index, value) = (self.pop(), self.pop());
                self.local(slot).set_element(&index, value)?;
            }
            Instruction::Element => {
                let (index, whole) = (self.pop(), self.pop());
                self.stack.push(whole.element(&index)?);
            }
            Instruction::Unary(operator) => {
                let operand = self.pop();
                self.stack.push(value::unary(operator, operand)?);
            }
            Instruction::Binary(operator) => {
                let (right, left) = (self.pop(), self.pop());
                self.stack.push(value::binary(operator, &left, &right)?);
            }
            Instruction::List(length) => {
                let elements = self.pop_many(usize::from(length));
                self.stack.push(Value::list(elements)?);
            }
            Instruction::Pose => {
                let numbers = self.pop_many(6);
                self.stack.push(pose(&numbers)?);
            }
            Instruction::Jump(target) => self.next = target as usize,
            Instruction::JumpUnless(target) => match self.pop() {
                Value::Boolean(true) => {}
                Value::Boolean(false) => self.next = target as usize,
                other => return Err(other.is_not("a boolean", "a condition")),
            },
            Instruction::Call(function) => self.call(code, function)?,
            Instruction::Builtin(signature) => {
                let count = signature.parameters().count();
                let first = self.stack.len().saturating_sub(count);
                let outcome = signature.call(&self.stack[first..], around)?;
                self.stack.truncate(first);
                match outcome {
                    Outcome::Value(value) => self.stack.push(value),
                    Outcome::Pause(pause) => {
                        self.stack.push(Value::Nothing);
                        return Ok(Some(pause));
                    }
                }
            }
            Instruction::NeedValue => {
                if let Some(nothing @ Value::Nothing) = self.stack.last() {
                    return Err(nothing.is_not("a value", "what a function gives"));
                }
            }
            Instruction::Drop => {
                self.pop();
            }
            Instruction::Return => {
                let value = self.pop();
                if let Some(frame) = self.frames.pop() {
                    self.stack.truncate(frame.base);
                    self.next = frame.back_to;
                }
                self.stack.push(value);
            }
            Instruction::Halt => {
                self.next = usize::MAX;
                return Ok(Some(Pause::Ended));
            }
        }
        Ok(None)
    }

    /// Enters a function whose arguments are on the stack.
    fn call(&mut self, code: &Code, function: u16) -> Result<(), Fault> {
        let too_much = |what, most| Err(Fault::TooMuch { what, most });
        if self.frames.len() == DEEPEST_CALLS {
            return too_much("the depth of calls", DEEPEST_CALLS);
        }
        if self.stack.len() > MOST_VALUES {
            return too_much("the number of values in calls", MOST_VALUES);
        }
        let called = &code.functions[usize::from(function)];
        let base = self.stack.len().saturating_sub(called.parameters.len());
        self.stack
            .resize(base + called.locals.len(), Value::Nothing);
        self.frames.push(Frame {
            function,
            base,
            back_to: self.next,
        });
        self.next = called.entry as usize;
        Ok(())
    }

    fn local(&mut self, slot: u16) -> &mut Value {
        let base = self.frames.last().map_or(0, |frame| frame.base);
        &mut self.stack[base + usize::from(slot)]
    }

    fn local_names<'a>(&self, code: &'a Code) -> &'a [String] {
        let function = self.frames.last().map(|frame| usize::from(frame.function));
        function.map_or(&[], |function| &code.functions[function].locals)
    }

    /// The compiler puts a value there before each instruction that takes one.
    fn pop(&mut self) -> Value {
        self.stack.pop().unwrap_or(Value::Nothing)
    }

    fn pop_many(&mut self, count: usize) -> Vec<Value> {
        let first = self.stack.len().saturating_sub(count);
        self.stack.split_off(first)
    }
}

fn assigned(value: Value, names: &[String], slot: u16) -> Result<Value, Fault> {
    match value {
        Value::Nothing => {
            let name = names.get(usize::from(slot)).cloned().unwrap_or_default();
            Err(Fault::Unassigned(name))
        }
        value => Ok(value),
    }
}

fn pose(numbers: &[Value]) -> Result<Value, Fault> {
    let mut pose = [0.0; 6];
    for (place, value) in pose.iter_mut().zip(numbers) {
        let number = value.number();
        *place = number.ok_or_else(|| value.is_not("a number", "a pose's element"))?;
    }
    Ok(Value::Pose(pose))
}
