//! Reads expressions: operators by how strongly they bind, values, elements, calls.

use super::error::{Fault, ScriptError};
use super::lexer::Token;
use super::parser::Parser;
use super::syntax::{Binary, Call, Expression, NOT_BINDS, SIGN_BINDS, Unary};

impl Parser {
    pub(super) fn expression(&mut self) -> Result<Expression, ScriptError> {
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
    pub(super) fn operand(&mut self) -> Result<Expression, ScriptError> {
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::urscript::parser::parse;
    use crate::urscript::syntax::Action;

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
}
