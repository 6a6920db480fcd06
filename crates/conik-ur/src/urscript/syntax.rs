//! The parts of a program: functions, statements, expressions.

/// A function, or the program itself.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Function {
    pub(super) line: u32,
    pub(super) name: String,
    pub(super) parameters: Vec<String>,
    pub(super) body: Block,
}

/// Statements one after another.
pub(super) type Block = Vec<Statement>;

/// A statement and the line on which it begins.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Statement {
    pub(super) line: u32,
    pub(super) action: Action,
}

/// What a statement does.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Action {
    Assign {
        scope: Scope,
        name: String,
        value: Expression,
    },
    AssignElement {
        name: String,
        index: Expression,
        value: Expression,
    },
    /// A call whose value nobody wants.
    Call(Expression),
    If {
        /// Conditions and what follows from the first that holds.
        branches: Vec<(u32, Expression, Block)>,
        otherwise: Block,
    },
    While {
        condition: Expression,
        body: Block,
    },
    Break,
    Continue,
    Return(Option<Expression>),
    Define(Function),
    /// Ends the program.
    Halt,
    Pass,
}

/// What an assignment says of its variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scope {
    Global,
    Local,
    /// Nothing: global where there is such a variable, local otherwise.
    Free,
}

/// What has a value.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Expression {
    Integer(i32),
    Float(f64),
    Boolean(bool),
    Text(String),
    List(Vec<Expression>),
    Pose(Vec<Expression>),
    Variable(String),
    Element(Box<Expression>, Box<Expression>),
    Unary(Unary, Box<Expression>),
    Binary(Binary, Box<Expression>, Box<Expression>),
    Call(Call),
}

/// A call of a function.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Call {
    pub(super) name: String,
    /// Each with its keyword, if it has one.
    pub(super) arguments: Vec<(Option<String>, Expression)>,
}

/// Operators with one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unary {
    Minus,
    Plus,
    Not,
}

/// Operators with two operands. Both are always evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Binary {
    Or,
    Xor,
    And,
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
}

impl Binary {
    /// The operator of this spelling and how strongly it binds.
    pub(super) fn from_word(word: &str) -> Option<(Self, u8)> {
        Some(match word {
            "or" => (Self::Or, 1),
            "xor" => (Self::Xor, 1),
            "and" => (Self::And, 2),
            // `not` stands between these.
            "==" => (Self::Equal, NOT_BINDS + 1),
            "!=" => (Self::NotEqual, NOT_BINDS + 1),
            "<" => (Self::Less, NOT_BINDS + 1),
            "<=" => (Self::LessOrEqual, NOT_BINDS + 1),
            ">" => (Self::Greater, NOT_BINDS + 1),
            ">=" => (Self::GreaterOrEqual, NOT_BINDS + 1),
            "+" => (Self::Add, 5),
            "-" => (Self::Subtract, 5),
            "*" => (Self::Multiply, 6),
            "/" => (Self::Divide, 6),
            "%" => (Self::Remainder, 6),
            _ => return None,
        })
    }

    /// How it is written.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Or => "or",
            Self::Xor => "xor",
            Self::And => "and",
            Self::Equal => "==",
            Self::NotEqual => "!=",
            Self::Less => "<",
            Self::LessOrEqual => "<=",
            Self::Greater => ">",
            Self::GreaterOrEqual => ">=",
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::Remainder => "%",
        }
    }
}

/// How strongly `not` binds: less than a comparison, more than `and`.
pub(super) const NOT_BINDS: u8 = 3;

/// How strongly a sign binds.
pub(super) const SIGN_BINDS: u8 = 7;
