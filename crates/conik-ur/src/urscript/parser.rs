//! Reads a program's tokens as functions and statements; expressions are read in `expression`.

use super::error::{Fault, ScriptError};
use super::lexer::{Token, tokens};
use super::syntax::{Action, Block, Function, Scope, Statement};

/// Bytes of a program.
pub(super) const MOST_BYTES: usize = 1 << 17;

/// Brackets, signs and blocks inside of each other.
const DEEPEST: usize = 40;

/// Values, names and operators in one statement.
const MOST_IN_A_STATEMENT: usize = 2000;

/// Words that name neither a variable nor a function.
const KEYWORDS: [&str; 28] = [
    "and",
    "or",
    "xor",
    "not",
    "def",
    "sec",
    "end",
    "if",
    "elif",
    "else",
    "while",
    "break",
    "continue",
    "return",
    "global",
    "local",
    "True",
    "False",
    "halt",
    "pass",
    "thread",
    "run",
    "join",
    "kill",
    "for",
    "struct",
    "enter_critical",
    "exit_critical",
];

/// A whole program.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Whole {
    pub(super) function: Function,
    /// Runs beside another program and takes no time: `sec`.
    pub(super) is_secondary: bool,
}

/// Reads a `def` or `sec` with all that is in it, or a single statement.
pub(super) fn parse(text: &str) -> Result<Whole, ScriptError> {
    if text.len() > MOST_BYTES {
        let fault = too_much("a program's size in bytes", MOST_BYTES);
        return Err(fault.at(1));
    }
    let mut parser = Parser {
        tokens: tokens(text)?,
        at: 0,
        depth: 0,
        nodes: 0,
    };
    parser.skip_line_ends();
    let line = parser.line();
    let is_secondary = parser.is_word("sec");
    let function = if is_secondary || parser.is_word("def") {
        parser.at += 1;
        parser.function(line)?
    } else {
        let name = "a single line".to_owned();
        let body = vec![parser.statement()?];
        let parameters = Vec::new();
        Function {
            line,
            name,
            parameters,
            body,
        }
    };
    parser.skip_line_ends();
    if *parser.peek() != Token::End {
        return Err(parser.expected("the end of the program"));
    }
    Ok(Whole {
        function,
        is_secondary,
    })
}

fn too_much(what: &'static str, most: usize) -> Fault {
    Fault::TooMuch { what, most }
}

/// What is read so far, and what is left.
pub(super) struct Parser {
    /// The last is [`Token::End`], and `at` never passes it.
    pub(super) tokens: Vec<(Token, u32)>,
    pub(super) at: usize,
    pub(super) depth: usize,
    /// Parts of the present statement so far.
    nodes: usize,
}

impl Parser {
    pub(super) fn peek(&self) -> &Token {
        self.tokens
            .get(self.at)
            .map_or(&Token::End, |(token, _)| token)
    }

    pub(super) fn line(&self) -> u32 {
        let last = self.tokens.len().saturating_sub(1);
        self.tokens
            .get(self.at.min(last))
            .map_or(1, |(_, line)| *line)
    }

    pub(super) fn is_word(&self, word: &str) -> bool {
        matches!(self.peek(), Token::Word(found) if found == word)
    }

    pub(super) fn is_symbol(&self, symbol: &str) -> bool {
        matches!(self.peek(), Token::Symbol(found) if *found == symbol)
    }

    /// Passes over a symbol if it stands here.
    pub(super) fn takes_symbol(&mut self, symbol: &str) -> bool {
        let stands = self.is_symbol(symbol);
        self.at += usize::from(stands);
        stands
    }

    fn takes_word(&mut self, word: &str) -> bool {
        let stands = self.is_word(word);
        self.at += usize::from(stands);
        stands
    }

    pub(super) fn symbol(&mut self, symbol: &str) -> Result<(), ScriptError> {
        let stands = self.takes_symbol(symbol);
        stands
            .then_some(())
            .ok_or_else(|| self.expected(&format!("'{symbol}'")))
    }

    pub(super) fn name(&mut self, wanted: &str) -> Result<String, ScriptError> {
        match self.peek() {
            Token::Word(word) if !KEYWORDS.contains(&word.as_str()) => {
                let word = word.clone();
                self.at += 1;
                Ok(word)
            }
            _ => Err(self.expected(wanted)),
        }
    }

    fn skip_line_ends(&mut self) {
        while *self.peek() == Token::LineEnd {
            self.at += 1;
        }
    }

    pub(super) fn expected(&self, wanted: &str) -> ScriptError {
        let fault = Fault::Expected {
            wanted: wanted.to_owned(),
            found: self.peek().to_string(),
        };
        fault.at(self.line())
    }

    pub(super) fn count(&mut self) -> Result<(), ScriptError> {
        self.nodes += 1;
        if self.nodes > MOST_IN_A_STATEMENT {
            let fault = too_much("the parts of a statement", MOST_IN_A_STATEMENT);
            return Err(fault.at(self.line()));
        }
        Ok(())
    }

    /// Goes one level deeper; the caller comes back by lowering `depth`.
    pub(super) fn descend(&mut self) -> Result<(), ScriptError> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(too_much("nesting", DEEPEST).at(self.line()));
        }
        Ok(())
    }

    /// A function from its name on.
    fn function(&mut self, line: u32) -> Result<Function, ScriptError> {
        let name = self.name("the function's name")?;
        self.symbol("(")?;
        let mut parameters = Vec::new();
        while !self.takes_symbol(")") {
            if !parameters.is_empty() {
                self.symbol(",")?;
            }
            parameters.push(self.name("a parameter")?);
        }
        let body = self.block()?;
        self.end()?;
        Ok(Function {
            line,
            name,
            parameters,
            body,
        })
    }

    /// From the colon up to `end`, `elif` or `else`, or to the end of the text.
    fn block(&mut self) -> Result<Block, ScriptError> {
        self.symbol(":")?;
        self.descend()?;
        let mut block = Block::new();
        loop {
            self.skip_line_ends();
            let mut ends = ["end", "elif", "else"].into_iter();
            if ends.any(|word| self.is_word(word)) || *self.peek() == Token::End {
                self.depth -= 1;
                return Ok(block);
            }
            block.push(self.statement()?);
        }
    }

    fn end(&mut self) -> Result<(), ScriptError> {
        let stands = self.takes_word("end");
        stands.then_some(()).ok_or_else(|| self.expected("'end'"))
    }

    /// A statement with the end of its line.
    fn statement(&mut self) -> Result<Statement, ScriptError> {
        let line = self.line();
        self.nodes = 0;
        let action = self.action(line)?;
        if *self.peek() != Token::LineEnd {
            return Err(self.expected("the end of the line"));
        }
        self.at += 1;
        Ok(Statement { line, action })
    }

    fn action(&mut self, line: u32) -> Result<Action, ScriptError> {
        let Token::Word(word) = self.peek() else {
            return Err(self.expected("a statement"));
        };
        let word = word.clone();
        let keyword = self.at;
        self.at += 1;
        match word.as_str() {
            "def" => Ok(Action::Define(self.function(line)?)),
            "if" => self.choice(line),
            "while" => {
                let condition = self.expression()?;
                let body = self.block()?;
                self.end()?;
                Ok(Action::While { condition, body })
            }
            "break" => Ok(Action::Break),
            "continue" => Ok(Action::Continue),
            "pass" => Ok(Action::Pass),
            "halt" => {
                if self.takes_symbol("(") {
                    self.symbol(")")?;
                }
                Ok(Action::Halt)
            }
            "return" => Ok(Action::Return(match self.peek() {
                Token::LineEnd => None,
                _ => Some(self.expression()?),
            })),
            "global" => self.assignment(Scope::Global),
            "local" => self.assignment(Scope::Local),
            "thread" | "run" | "join" | "kill" | "enter_critical" | "exit_critical" => {
                Err(Fault::NotEmulated("threads").at(line))
            }
            "for" | "struct" | "sec" => Err(Fault::UnknownFunction(word).at(line)),
            _ => {
                self.at = keyword;
                if matches!(self.tokens.get(self.at + 1), Some((Token::Symbol("("), _))) {
                    return Ok(Action::Call(self.operand()?));
                }
                self.assignment(Scope::Free)
            }
        }
    }

    fn choice(&mut self, line: u32) -> Result<Action, ScriptError> {
        let condition = self.expression()?;
        let mut branches = vec![(line, condition, self.block()?)];
        let mut otherwise = Block::new();
        loop {
            let line = self.line();
            self.nodes = 0;
            if self.takes_word("elif") {
                let condition = self.expression()?;
                branches.push((line, condition, self.block()?));
            } else if self.takes_word("else") {
                otherwise = self.block()?;
                self.end()?;
                break;
            } else {
                self.end()?;
                break;
            }
        }
        Ok(Action::If {
            branches,
            otherwise,
        })
    }

    fn assignment(&mut self, scope: Scope) -> Result<Action, ScriptError> {
        let name = self.name("a statement")?;
        if scope == Scope::Free && self.takes_symbol("[") {
            let index = self.expression()?;
            self.symbol("]")?;
            self.symbol("=")?;
            let value = self.expression()?;
            return Ok(Action::AssignElement { name, index, value });
        }
        self.symbol("=")?;
        let value = self.expression()?;
        Ok(Action::Assign { scope, name, value })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mistakes_are_named_with_their_line() {
        for (text, message) in [
            (
                "def a():\n  x = \nend",
                "line 2: expected a value, found the end of the line",
            ),
            ("def a():\n  if True:\n  end", "line 3: expected 'end'"),
            (
                "def a():\nend\nx = 1",
                "line 3: expected the end of the program",
            ),
            (
                "def a():\n  f(a=1, 2)\nend",
                "line 2: expected an argument with its name",
            ),
            (
                "def a():\n  thread b():\n  end\nend",
                "line 2: threads are not emulated",
            ),
            ("x = p[1, 2]", "expected the six numbers of a pose, found 2"),
            ("x = end", "expected a value, found 'end'"),
            ("x = 1 y = 2", "expected the end of the line, found 'y'"),
            ("", "expected a statement"),
        ] {
            let error = parse(text).unwrap_err().to_string();
            assert!(error.contains(message), "{text:?}: {error}");
        }
    }

    #[test]
    fn nothing_grows_or_nests_without_end() {
        for text in [
            format!("x = {}1{}", "(".repeat(1000), ")".repeat(1000)),
            format!("x = {}1", "-".repeat(1000)),
            format!("x = {}True", "not ".repeat(1000)),
            format!("x = 1{}", " + 1".repeat(5000)),
            format!("x = a{}", "[0]".repeat(5000)),
            format!("def a():\n{}", "if True:\n".repeat(1000)),
            format!("x = 1{}", " ".repeat(MOST_BYTES)),
        ] {
            let error = parse(&text).unwrap_err().to_string();
            assert!(error.contains("is limited to"), "{error}");
        }
    }
}
