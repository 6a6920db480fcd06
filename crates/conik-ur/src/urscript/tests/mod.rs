//! The language by examples, what it refuses, and programs that nobody would write.

mod language;
mod noise;
mod refusals;

use super::*;

/// A controller that only remembers.
#[derive(Debug)]
struct Notebook {
    floats: [f64; 48],
    integers: [f64; 48],
    booleans: [f64; 128],
    watchdogs: Vec<(String, f64, WatchdogAction)>,
    mounted: Vec<Vec<f64>>,
    said: Vec<String>,
}

impl Notebook {
    fn new() -> Self {
        Self {
            floats: [0.0; 48],
            integers: [0.0; 48],
            booleans: [0.0; 128],
            watchdogs: Vec::new(),
            mounted: Vec::new(),
            said: Vec::new(),
        }
    }
}

/// Inputs and outputs are the same registers.
impl Surroundings for Notebook {
    fn input(&self, kind: Register, address: usize) -> f64 {
        match kind {
            Register::Float => self.floats[address],
            Register::Integer => self.integers[address],
            Register::Boolean => self.booleans[address],
        }
    }

    fn output(&self, kind: Register, address: usize) -> f64 {
        self.input(kind, address)
    }

    fn write_output(&mut self, kind: Register, address: usize, value: f64) {
        assert!(value.is_finite());
        match kind {
            Register::Float => self.floats[address] = value,
            Register::Integer => self.integers[address] = value,
            Register::Boolean => self.booleans[address] = value,
        }
    }

    fn joints(&self, which: Joints) -> [f64; 6] {
        match which {
            Joints::ActualPositions => [1.0; 6],
            Joints::TargetPositions => [2.0; 6],
            Joints::ActualSpeeds => [3.0; 6],
            Joints::TargetSpeeds => [0.0; 6],
        }
    }

    fn cycle_s(&self) -> f64 {
        0.002
    }

    fn set_payload(&mut self, mass_kg: f64) {
        self.mounted.push(vec![mass_kg]);
    }

    fn set_tcp(&mut self, pose: [f64; 6]) {
        self.mounted.push(pose.to_vec());
    }

    fn set_watchdog(&mut self, input: &str, least_hz: f64, action: WatchdogAction) -> bool {
        self.watchdogs.push((input.to_owned(), least_hz, action));
        input.starts_with("input_")
    }

    fn say(&mut self, line: &str) {
        self.said.push(line.to_owned());
    }
}

/// Runs the statements of a program to the end, at most some hundred pauses.
fn run(statements: &str) -> Result<(Vec<Pause>, Notebook), ScriptError> {
    let text = format!("def test():\n{statements}\nend\n");
    let mut machine = Machine::new(&Program::parse(&text)?);
    let (mut pauses, mut notebook) = (Vec::new(), Notebook::new());
    while pauses.len() < 300 {
        match machine.run(&mut notebook)? {
            Pause::Ended => break,
            pause => pauses.push(pause),
        }
    }
    Ok((pauses, notebook))
}

/// What a program says by `textmsg`.
fn said(statements: &str) -> Vec<String> {
    run(statements).unwrap().1.said
}

fn fault(statements: &str) -> String {
    run(statements).unwrap_err().to_string()
}
