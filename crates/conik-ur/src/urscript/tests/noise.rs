//! Texts that nobody would write.

use super::*;
use proptest::prelude::*;

/// Parses a text and, if it is a program, runs it for some pauses.
fn survive(text: &str) {
    if let Ok(program) = Program::parse(text) {
        let mut machine = Machine::new(&program);
        let mut notebook = Notebook::new();
        for _ in 0..20 {
            if !matches!(machine.run(&mut notebook), Ok(pause) if pause != Pause::Ended) {
                break;
            }
        }
    }
}

/// The words of the language and some that are not.
const WORDS: [&str; 74] = [
    "def f(a):\n",
    "def test():\n",
    "end\n",
    "if ",
    "elif ",
    "else:\n",
    "while ",
    "break\n",
    "continue\n",
    "return ",
    "halt\n",
    "pass\n",
    "global ",
    "local ",
    ":\n",
    "\n",
    "(",
    ")",
    "[",
    "]",
    "p[",
    ",",
    " = ",
    "+",
    "-",
    "*",
    "/",
    "%",
    "==",
    "!=",
    "<",
    "<=",
    " and ",
    " or ",
    " xor ",
    "not ",
    "True",
    "False",
    "0",
    "1",
    "5",
    "47",
    "2147483647",
    "0.5",
    "1e300",
    "\"t\"",
    "a",
    "b",
    "q",
    "f(",
    "f(a=",
    "sleep(",
    "sync()\n",
    "servoj(",
    "stopj(",
    "textmsg(",
    "to_str(",
    "str_cat(",
    "sqrt(",
    "pow(",
    "floor(",
    "abs(",
    "norm(",
    "length(",
    "set_payload(",
    "set_tcp(",
    "read_input_float_register(",
    "write_output_integer_register(",
    "rtde_set_watchdog(",
    "a = [0, 0, 0, 0, 0, 0]\n",
    "a[0] = a[5] + 1\n",
    "servoj(a, t=0.008)\n",
    "while a < 5:\n",
    "# \"\n",
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn no_text_brings_the_interpreter_down(text in any::<String>()) {
        survive(&text);
        survive(&format!("def test():\n{text}\nend\n"));
    }

    #[test]
    fn no_row_of_words_brings_the_interpreter_down(
        words in prop::collection::vec(prop::sample::select(&WORDS[..]), 0..60),
    ) {
        survive(&words.concat());
        survive(&format!("def test():\n{}\nend\n", words.concat()));
    }

    /// The servo program, with words put in, left out and exchanged.
    #[test]
    fn no_change_of_a_real_program_brings_the_interpreter_down(
        changes in prop::collection::vec(
            (any::<prop::sample::Index>(), 0..3_u8, prop::sample::select(&WORDS[..])),
            1..6,
        ),
    ) {
        let text = crate::program::tests::PROGRAM.text().unwrap();
        let mut words: Vec<&str> = text.split_inclusive(|c: char| !c.is_alphanumeric()).collect();
        for (place, change, word) in changes {
            let place = place.index(words.len());
            match change {
                0 => { words.remove(place); }
                1 => words.insert(place, word),
                _ => words[place] = word,
            }
        }
        survive(&words.concat());
    }
}
