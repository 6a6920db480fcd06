//! What can be wrong with a program: in its text, or while it runs.

/// A fault of a program, and where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {line}: {fault}")]
pub struct ScriptError {
    /// Number of the line, from 1.
    pub line: u32,
    /// What is wrong there.
    pub fault: Fault,
}

/// What is wrong.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Fault {
    /// A byte sequence that begins no word of the language.
    #[error("unexpected character '{0}'")]
    Character(char),
    /// A text without its closing quote.
    #[error("a text is not closed on its line")]
    OpenText,
    /// A number that cannot be represented.
    #[error("'{0}' is no number that fits")]
    Number(String),
    /// Something else was to stand here.
    #[error("expected {wanted}, found {found}")]
    Expected {
        /// What was to stand here.
        wanted: String,
        /// What stands here.
        found: String,
    },
    /// More than is taken.
    #[error("{what} is limited to {most}")]
    TooMuch {
        /// Of what.
        what: &'static str,
        /// The limit.
        most: usize,
    },
    /// A function that is neither defined above nor one of the controller's emulated here.
    #[error("unknown function '{0}': it is neither defined above nor emulated")]
    UnknownFunction(String),
    /// A part of the language that is not emulated.
    #[error("{0} are not emulated")]
    NotEmulated(&'static str),
    /// A function defined where its name is taken.
    #[error("the function '{0}' exists already")]
    DefinedTwice(String),
    /// A variable that nothing assigns.
    #[error("unknown variable '{0}'")]
    UnknownVariable(String),
    /// A variable read before it was assigned.
    #[error("the variable '{0}' has no value yet")]
    Unassigned(String),
    /// A call with a number or names of arguments that the function does not have.
    #[error("{function}: {problem}; its arguments are ({parameters})")]
    Arguments {
        /// Which function.
        function: String,
        /// What is wrong.
        problem: String,
        /// Names of its parameters.
        parameters: String,
    },
    /// `break` or `continue` outside of a loop.
    #[error("'{0}' stands in no loop")]
    NoLoop(&'static str),
    /// A function that takes time, in a program that must not.
    #[error("'{0}' takes time and cannot stand in a secondary program")]
    TakesTime(&'static str),
    /// A value of another type than is needed.
    #[error("{place} must be {wanted}, and is {found}")]
    Type {
        /// Where.
        place: String,
        /// What is needed.
        wanted: &'static str,
        /// What was found.
        found: &'static str,
    },
    /// A number outside of its range.
    #[error("{place} is {value}; it must lie within {from} and {to}")]
    Range {
        /// Which number.
        place: String,
        /// Its value.
        value: f64,
        /// Smallest allowed.
        from: f64,
        /// Largest allowed.
        to: f64,
    },
    /// No element with this index.
    #[error("there is no element {index} among {length}")]
    Index {
        /// The index, from 0.
        index: i32,
        /// How many there are.
        length: usize,
    },
    /// A result that is not finite, or an integer that overflowed.
    #[error("the result of {0} is not a finite number that fits")]
    Result(String),
    /// Something that a function does not know.
    #[error("{place}: unknown '{value}'")]
    Unknown {
        /// Which argument.
        place: &'static str,
        /// Its value.
        value: String,
    },
    /// A loop that never waits.
    #[error("more than {0} instructions in one control cycle: a loop that never waits")]
    NeverWaits(u32),
}

impl Fault {
    /// The fault at a line.
    pub(super) fn at(self, line: u32) -> ScriptError {
        ScriptError { line, fault: self }
    }
}
