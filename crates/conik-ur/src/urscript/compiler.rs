//! Turns a program's parts into instructions, and refuses names that nothing stands behind.

use super::code::{Code, CodeOfFunction, Instruction};
use super::error::{Fault, ScriptError};
use super::parser::Whole;
use super::scope;
use super::signature::Signature;
use super::syntax::{Action, Block, Call, Expression, Function, Scope, Statement};
use super::value::Value;
use std::collections::BTreeSet;

/// Functions, or variables of one kind, in one program.
const MOST_NAMES: usize = 1000;

/// The instructions of a program.
pub(super) fn compile(whole: &Whole) -> Result<Code, ScriptError> {
    let program = &whole.function;
    if let Some(parameter) = program.parameters.first() {
        let wanted = "a program without parameters".to_owned();
        let found = parameter.clone();
        return Err(Fault::Expected { wanted, found }.at(program.line));
    }
    let names = scope::globals(&program.body);
    let mut compiler = Compiler {
        code: Code {
            globals: names.iter().cloned().collect(),
            ..Code::default()
        },
        global_names: names,
        is_secondary: whole.is_secondary,
        visible: Vec::new(),
        locals: None,
        loops: Vec::new(),
        line: program.line,
    };
    compiler.check_count(compiler.code.globals.len())?;
    compiler.block(&program.body)?;
    compiler.emit(Instruction::Halt);
    Ok(compiler.code)
}

struct Compiler {
    code: Code,
    global_names: BTreeSet<String>,
    is_secondary: bool,
    /// Numbers of the functions that can be called here, the innermost last.
    visible: Vec<u16>,
    /// Local variables of the function at hand; none at the first level.
    locals: Option<Vec<String>>,
    /// Loops around the statement at hand, the innermost last.
    loops: Vec<Loop>,
    line: u32,
}

/// A loop whose end is not known yet.
struct Loop {
    begin: usize,
    /// Jumps that go to its end.
    breaks: Vec<usize>,
}

/// Where a variable lives.
enum Place {
    Global(u16),
    Local(u16),
}

impl Compiler {
    fn emit(&mut self, instruction: Instruction) -> usize {
        self.code.instructions.push(instruction);
        self.code.lines.push(self.line);
        self.code.instructions.len() - 1
    }

    fn here(&self) -> usize {
        self.code.instructions.len()
    }

    fn fail<T>(&self, fault: Fault) -> Result<T, ScriptError> {
        Err(fault.at(self.line))
    }

    fn check_count(&self, count: usize) -> Result<(), ScriptError> {
        let (what, most) = ("the number of names", MOST_NAMES);
        if count > most {
            return self.fail(Fault::TooMuch { what, most });
        }
        Ok(())
    }

    /// Lets a jump go to the next instruction.
    fn land(&mut self, jump: usize) {
        let here = address(self.here());
        match &mut self.code.instructions[jump] {
            Instruction::Jump(target) | Instruction::JumpUnless(target) => *target = here,
            _ => {}
        }
    }

    fn land_all(&mut self, jumps: Vec<usize>) {
        for jump in jumps {
            self.land(jump);
        }
    }

    fn block(&mut self, block: &Block) -> Result<(), ScriptError> {
        block
            .iter()
            .try_for_each(|statement| self.statement(statement))
    }

    fn statement(&mut self, statement: &Statement) -> Result<(), ScriptError> {
        self.line = statement.line;
        match &statement.action {
            Action::Assign { scope, name, value } => {
                self.expression(value)?;
                let store = match self.place(name, *scope)? {
                    Place::Global(slot) => Instruction::StoreGlobal(slot),
                    Place::Local(slot) => Instruction::StoreLocal(slot),
                };
                self.emit(store);
            }
            Action::AssignElement { name, index, value } => {
                self.expression(value)?;
                self.expression(index)?;
                let store = match self.place(name, Scope::Free)? {
                    Place::Global(slot) => Instruction::StoreGlobalElement(slot),
                    Place::Local(slot) => Instruction::StoreLocalElement(slot),
                };
                self.emit(store);
            }
            Action::Call(Expression::Call(call)) => {
                self.call(call)?;
                self.emit(Instruction::Drop);
            }
            Action::Call(other) => {
                self.expression(other)?;
                self.emit(Instruction::Drop);
            }
            Action::If {
                branches,
                otherwise,
            } => self.choice(branches, otherwise)?,
            Action::While { condition, body } => self.repetition(condition, body)?,
            Action::Break => {
                let jump = self.emit(Instruction::Jump(0));
                match self.loops.last_mut() {
                    Some(innermost) => innermost.breaks.push(jump),
                    None => return self.fail(Fault::NoLoop("break")),
                }
            }
            Action::Continue => match self.loops.last() {
                Some(innermost) => {
                    let begin = address(innermost.begin);
                    self.emit(Instruction::Jump(begin));
                }
                None => return self.fail(Fault::NoLoop("continue")),
            },
            Action::Return(value) => {
                match value {
                    Some(value) => self.expression(value)?,
                    None => self.constant(Value::Nothing),
                }
                // At the first level nobody waits for a value.
                let is_in_function = self.locals.is_some();
                self.emit(if is_in_function {
                    Instruction::Return
                } else {
                    Instruction::Halt
                });
            }
            Action::Define(function) => self.function(function)?,
            Action::Halt => {
                self.emit(Instruction::Halt);
            }
            Action::Pass => {}
        }
        Ok(())
    }

    fn choice(
        &mut self,
        branches: &[(u32, Expression, Block)],
        otherwise: &Block,
    ) -> Result<(), ScriptError> {
        let mut to_the_end = Vec::new();
        for (line, condition, block) in branches {
            self.line = *line;
            self.expression(condition)?;
            let past = self.emit(Instruction::JumpUnless(0));
            self.block(block)?;
            to_the_end.push(self.emit(Instruction::Jump(0)));
            self.land(past);
        }
        self.block(otherwise)?;
        self.land_all(to_the_end);
        Ok(())
    }

    fn repetition(&mut self, condition: &Expression, body: &Block) -> Result<(), ScriptError> {
        let begin = self.here();
        self.expression(condition)?;
        let past = self.emit(Instruction::JumpUnless(0));
        self.loops.push(Loop {
            begin,
            breaks: Vec::new(),
        });
        self.block(body)?;
        self.emit(Instruction::Jump(address(begin)));
        self.land(past);
        let breaks = self
            .loops
            .pop()
            .map(|ended| ended.breaks)
            .unwrap_or_default();
        self.land_all(breaks);
        Ok(())
    }

    /// A function's instructions stand where it is defined and are jumped over there.
    fn function(&mut self, function: &Function) -> Result<(), ScriptError> {
        let name = &function.name;
        let is_taken = self
            .visible
            .iter()
            .any(|known| self.name_of(*known) == name);
        if is_taken || Signature::find(name).is_some() {
            return self.fail(Fault::DefinedTwice(name.clone()));
        }
        let mut sorted = function.parameters.clone();
        sorted.sort_unstable();
        sorted.dedup();
        if sorted.len() < function.parameters.len() {
            let wanted = "parameters of different names".to_owned();
            let found = function.parameters.join(", ");
            return self.fail(Fault::Expected { wanted, found });
        }
        let over = self.emit(Instruction::Jump(0));
        let locals = scope::locals(&function.parameters, &function.body, &self.global_names);
        self.check_count(locals.len().max(self.code.functions.len() + 1))?;
        let number = small(self.code.functions.len());
        self.code.functions.push(CodeOfFunction {
            name: name.clone(),
            entry: address(self.here()),
            parameters: function.parameters.clone(),
            locals: locals.clone(),
        });
        self.visible.push(number);
        let seen = self.visible.len();
        let around = (self.locals.replace(locals), std::mem::take(&mut self.loops));
        self.block(&function.body)?;
        self.constant(Value::Nothing);
        self.emit(Instruction::Return);
        (self.locals, self.loops) = around;
        self.visible.truncate(seen);
        self.land(over);
        Ok(())
    }

    fn name_of(&self, function: u16) -> &str {
        &self.code.functions[usize::from(function)].name
    }

    fn constant(&mut self, value: Value) {
        let number = address(self.code.constants.len());
        self.code.constants.push(value);
        self.emit(Instruction::Constant(number));
    }

    /// Where the variable of this name lives.
    fn place(&self, name: &str, scope: Scope) -> Result<Place, ScriptError> {
        let position = |names: &[String]| names.iter().position(|known| known == name).map(small);
        let local = self.locals.as_deref().and_then(position);
        let global = || position(&self.code.globals);
        match (scope, local) {
            (Scope::Free | Scope::Local, Some(slot)) => Ok(Place::Local(slot)),
            _ => match global() {
                Some(slot) => Ok(Place::Global(slot)),
                None => self.fail(Fault::UnknownVariable(name.to_owned())),
            },
        }
    }

    fn expression(&mut self, expression: &Expression) -> Result<(), ScriptError> {
        match expression {
            Expression::Integer(value) => self.constant(Value::Integer(*value)),
            Expression::Float(value) => self.constant(Value::Float(*value)),
            Expression::Boolean(value) => self.constant(Value::Boolean(*value)),
            Expression::Text(text) => self.constant(Value::Text(text.as_str().into())),
            Expression::List(elements) => {
                elements
                    .iter()
                    .try_for_each(|element| self.expression(element))?;
                // A statement has at most some thousand parts.
                self.emit(Instruction::List(small(elements.len())));
            }
            Expression::Pose(numbers) => {
                numbers
                    .iter()
                    .try_for_each(|number| self.expression(number))?;
                self.emit(Instruction::Pose);
            }
            Expression::Variable(name) => {
                let load = match self.place(name, Scope::Free)? {
                    Place::Global(slot) => Instruction::LoadGlobal(slot),
                    Place::Local(slot) => Instruction::LoadLocal(slot),
                };
                self.emit(load);
            }
            Expression::Element(list, index) => {
                self.expression(list)?;
                self.expression(index)?;
                self.emit(Instruction::Element);
            }
            Expression::Unary(operator, operand) => {
                self.expression(operand)?;
                self.emit(Instruction::Unary(*operator));
            }
            Expression::Binary(operator, left, right) => {
                self.expression(left)?;
                self.expression(right)?;
                self.emit(Instruction::Binary(*operator));
            }
            Expression::Call(call) => {
                self.call(call)?;
                self.emit(Instruction::NeedValue);
            }
        }
        Ok(())
    }

    fn call(&mut self, call: &Call) -> Result<(), ScriptError> {
        let mut visible = self.visible.iter().rev().copied();
        if let Some(number) = visible.find(|number| self.name_of(*number) == call.name) {
            let parameters = self.code.functions[usize::from(number)].parameters.clone();
            let names: Vec<&str> = parameters.iter().map(String::as_str).collect();
            self.arguments(call, &names, names.len())?;
            self.emit(Instruction::Call(number));
            return Ok(());
        }
        let Some(signature) = Signature::find(&call.name) else {
            return self.fail(Fault::UnknownFunction(call.name.clone()));
        };
        if signature.takes_time && self.is_secondary {
            return self.fail(Fault::TakesTime(signature.name));
        }
        let names: Vec<&str> = signature.parameters().collect();
        self.arguments(call, &names, signature.required.len())?;
        self.emit(Instruction::Builtin(signature));
        Ok(())
    }

    /// A value for each parameter in turn; [`Value::Nothing`] for one that may be and is left out.
    fn arguments(
        &mut self,
        call: &Call,
        parameters: &[&str],
        required: usize,
    ) -> Result<(), ScriptError> {
        let wrong = |problem: String| Fault::Arguments {
            function: call.name.clone(),
            problem,
            parameters: parameters.join(", "),
        };
        let mut given: Vec<Option<&Expression>> = vec![None; parameters.len()];
        for (index, (keyword, value)) in call.arguments.iter().enumerate() {
            let place = match keyword {
                None => (index < parameters.len()).then_some(index),
                Some(keyword) => parameters.iter().position(|name| name == keyword),
            };
            match (place, keyword) {
                (Some(place), _) if given[place].is_none() => given[place] = Some(value),
                (Some(place), _) => {
                    return self.fail(wrong(format!("'{}' is given twice", parameters[place])));
                }
                (None, Some(keyword)) => {
                    return self.fail(wrong(format!("there is no argument '{keyword}'")));
                }
                (None, None) => {
                    let count = call.arguments.len();
                    return self.fail(wrong(format!("{count} arguments are too many")));
                }
            }
        }
        for (index, value) in given.into_iter().enumerate() {
            match value {
                Some(value) => self.expression(value)?,
                None if index >= required => self.constant(Value::Nothing),
                None => return self.fail(wrong(format!("'{}' is missing", parameters[index]))),
            }
        }
        Ok(())
    }
}

/// Instructions and constants are fewer than the bytes of a program.
fn address(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}

/// Numbers of names and elements, whose counts are limited.
fn small(index: usize) -> u16 {
    u16::try_from(index).unwrap_or(u16::MAX)
}
