//! Reads a program's tokens as functions, statements and expressions.

use super::error::{Fault, ScriptError};
use super::lexer::{Token, tokens};
use super::syntax::{
    Action, Binary, Block, Call, Expression, Function, NOT_BINDS, SIGN_BINDS, Scope, Statement,
    Unary,
};

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

struct Parser {
    /// The last is [`Token::End`], and `at` never passes it.
    tokens: Vec<(Token, u32)>,
    at: usize,
    depth: usize,
    /// Parts of the present statement so far.
    nodes: usize,
}

impl Parser {
    fn peek(&self) -> &Token {
        self.tokens
            .get(self.at)
            .map_or(&Token::End, |(token, _)| token)
    }

    fn line(&self) -> u32 {
        let last = self.tokens.len().saturating_sub(1);
        self.tokens
            .get(self.at.min(last))
            .map_or(1, |(_, line)| *line)
    }

    fn is_word(&self, word: &str) -> bool {
        matches!(self.peek(), Token::Word(found) if found == word)
    }

    fn is_symbol(&self, symbol: &str) -> bool {
        matches!(self.peek(), Token::Symbol(found) if *found == symbol)
    }

    /// Passes over a symbol if it stands here.
    fn takes_symbol(&mut self, symbol: &str) -> bool {
        let stands = self.is_symbol(symbol);
        self.at += usize::from(stands);
        stands
    }

    fn takes_word(&mut self, word: &str) -> bool {
        let stands = self.is_word(word);
        self.at += usize::from(stands);
        stands
    }

    fn symbol(&mut self, symbol: &str) -> Result<(), ScriptError> {
        let stands = self.takes_symbol(symbol);
        stands
            .then_some(())
            .ok_or_else(|| self.expected(&format!("'{symbol}'")))
    }

    fn name(&mut self, wanted: &str) -> Result<String, ScriptError> {
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

    fn expected(&self, wanted: &str) -> ScriptError {
        let fault = Fault::Expected {
            wanted: wanted.to_owned(),
            found: self.peek().to_string(),
        };
        fault.at(self.line())
    }

    /// Goes one level deeper; the caller comes back by lowering `depth`.
    fn descend(&mut self) -> Result<(), ScriptError> {
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

    fn expression(&mut self) -> Result<Expression, ScriptError> {
        self.binary(0)
    }

    /// Operators that bind at least as strongly as `least`, from the left.
    fn binary(&mut self, least: u8) -> Result<Expression, ScriptError> {
        self.descend()?;
        let mut left = self.unary()?;
        loop {
            let word = match self.peek() {
                Token::Symbol(symbol) => symbol,
                Token::Word(word) => word.as_str(),
                _ => break,
            };
            let Some((operator, binds)) = Binary::from_word(word) else {
                break;
            };
            if binds < least {
                break;
            }
            self.at += 1;
            let right = self.binary(binds + 1)?;
            self.count()?;
            left = Expression::Binary(operator, Box::new(left), Box::new(right));
        }
        self.depth -= 1;
        Ok(left)
    }

    fn unary(&mut self) -> Result<Expression, ScriptError> {
        let (operator, binds) = if self.is_word("not") {
            (Unary::Not, NOT_BINDS)
        } else if self.is_symbol("-") {
            (Unary::Minus, SIGN_BINDS)
        } else if self.is_symbol("+") {
            (Unary::Plus, SIGN_BINDS)
        } else {
            return self.operand();
        };
        self.at += 1;
        self.count()?;
        let operand = self.binary(binds)?;
        Ok(Expression::Unary(operator, Box::new(operand)))
    }

    /// A value, a variable, a call or an expression in brackets, and elements of it.
    fn operand(&mut self) -> Result<Expression, ScriptError> {
        self.count()?;
        let mut operand = match self.peek().clone() {
            Token::Integer(value) => self.literal(Expression::Integer(value)),
            Token::Float(value) => self.literal(Expression::Float(value)),
            Token::Text(text) => self.literal(Expression::Text(text)),
            Token::Word(word) if word == "True" => self.literal(Expression::Boolean(true)),
            Token::Word(word) if word == "False" => self.literal(Expression::Boolean(false)),
            Token::Symbol("(") => {
                self.at += 1;
                let inside = self.expression()?;
                self.symbol(")")?;
                inside
            }
            Token::Symbol("[") => {
                self.at += 1;
                Expression::List(self.elements()?)
            }
            Token::Symbol("p[") => {
                self.at += 1;
                let line = self.line();
                let numbers = self.elements()?;
                if numbers.len() != 6 {
                    let found = format!("{}", numbers.len());
                    let wanted = "the six numbers of a pose".to_owned();
                    return Err(Fault::Expected { wanted, found }.at(line));
                }
                Expression::Pose(numbers)
            }
            Token::Word(_) => {
                let name = self.name("a value")?;
                if self.takes_symbol("(") {
                    Expression::Call(self.call(name)?)
                } else {
                    Expression::Variable(name)
                }
            }
            _ => return Err(self.expected("a value")),
        };
        while self.takes_symbol("[") {
            self.count()?;
            let index = self.expression()?;
            self.symbol("]")?;
            operand = Expression::Element(Box::new(operand), Box::new(index));
        }
        Ok(operand)
    }

    fn literal(&mut self, expression: Expression) -> Expression {
        self.at += 1;
        expression
    }

    /// Up to the closing bracket.
    fn elements(&mut self) -> Result<Vec<Expression>, ScriptError> {
        let mut elements = Vec::new();
        while !self.takes_symbol("]") {
            if !elements.is_empty() {
                self.symbol(",")?;
            }
            elements.push(self.expression()?);
        }
        Ok(elements)
    }

    /// The arguments of a call, from behind the opening bracket.
    fn call(&mut self, name: String) -> Result<Call, ScriptError> {
        let mut arguments: Vec<(Option<String>, Expression)> = Vec::new();
        while !self.takes_symbol(")") {
            if !arguments.is_empty() {
                self.symbol(",")?;
            }
            let is_keyword = matches!(self.peek(), Token::Word(_))
                && matches!(self.tokens.get(self.at + 1), Some((Token::Symbol("="), _)));
            let keyword = if is_keyword {
                let keyword = self.name("an argument")?;
                self.symbol("=")?;
                Some(keyword)
            } else if arguments
                .last()
                .is_some_and(|(keyword, _)| keyword.is_some())
            {
                return Err(self.expected("an argument with its name"));
            } else {
                None
            };
            arguments.push((keyword, self.expression()?));
        }
        Ok(Call { name, arguments })
    }

    fn count(&mut self) -> Result<(), ScriptError> {
        self.nodes += 1;
        if self.nodes > MOST_IN_A_STATEMENT {
            let fault = too_much("the parts of a statement", MOST_IN_A_STATEMENT);
            return Err(fault.at(self.line()));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An expression with all its brackets.
    fn bracketed(expression: &Expression) -> String {
        match expression {
            Expression::Integer(value) => value.to_string(),
            Expression::Variable(name) => name.clone(),
            Expression::Unary(operator, operand) => {
                format!("({operator:?} {})", bracketed(operand))
            }
            Expression::Binary(operator, left, right) => {
                format!(
                    "({} {} {})",
                    bracketed(left),
                    operator.word(),
                    bracketed(right)
                )
            }
            Expression::Element(list, index) => {
                format!("{}[{}]", bracketed(list), bracketed(index))
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn operators_bind_as_in_the_makers_examples() {
        for (text, meaning) in [
            (
                "1 > 2 or 3 != 4 xor 5 < -6",
                "(((1 > 2) or (3 != 4)) xor (5 < (Minus 6)))",
            ),
            (
                "not 42 >= 87 and 87 <= 42",
                "((Not (42 >= 87)) and (87 <= 42))",
            ),
            ("1 - 2 - 3 * 4 % 5", "((1 - 2) - ((3 * 4) % 5))"),
            ("(1+2)*-a[1][0]", "((1 + 2) * (Minus a[1][0]))"),
        ] {
            let whole = parse(&format!("x = {text}")).unwrap();
            let Action::Assign { value, .. } = &whole.function.body[0].action else {
                panic!("no assignment");
            };
            assert_eq!(bracketed(value), meaning);
        }
    }

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
