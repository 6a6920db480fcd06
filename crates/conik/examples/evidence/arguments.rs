//! The command line.

use crate::combo::Combo;

/// What is to be run.
#[derive(Debug)]
pub struct Arguments {
    pub scenes: u64,
    /// Number of the first scene.
    pub first: u64,
    pub seed: u64,
    pub jobs: usize,
    pub combos: Vec<Combo>,
    /// The paper's examples instead of random scenes.
    pub paper: bool,
    /// The course of this scene instead of all of them.
    pub only: Option<u64>,
    /// From which tick on the course is printed tick by tick, for a while.
    pub from_tick: Option<usize>,
}

impl Arguments {
    pub fn parse(mut words: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut arguments = Self {
            scenes: 100,
            first: 0,
            seed: 1,
            jobs: 1,
            combos: Vec::new(),
            paper: false,
            only: None,
            from_tick: None,
        };
        while let Some(word) = words.next() {
            let mut value = || words.next().ok_or(format!("{word} needs a value"));
            match word.as_str() {
                "--scenes" => arguments.scenes = number(&word, &value()?)?,
                "--first" => arguments.first = number(&word, &value()?)?,
                "--seed" => arguments.seed = number(&word, &value()?)?,
                "--jobs" => arguments.jobs = number::<usize>(&word, &value()?)?.max(1),
                "--only" => arguments.only = Some(number(&word, &value()?)?),
                "--from-tick" => arguments.from_tick = Some(number(&word, &value()?)?),
                "--combo" => arguments.combos.push(value()?.parse()?),
                "--paper" => arguments.paper = true,
                _ => return Err(format!("unknown argument {word}")),
            }
        }
        if arguments.combos.is_empty() {
            arguments.combos = Combo::all();
        }
        Ok(arguments)
    }
}

fn number<T: std::str::FromStr>(name: &str, word: &str) -> Result<T, String> {
    word.parse()
        .map_err(|_| format!("{name} needs a number, not {word}"))
}
