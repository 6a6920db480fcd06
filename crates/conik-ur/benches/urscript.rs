//! Time of one interpreted control cycle of the servo program, with a new reference in each and with
//! every reference bridged: `cargo bench -p conik-ur --bench urscript`.

use conik_ur::program::ServoProgram;
use conik_ur::registers::RegisterBase;
use conik_ur::urscript::{Joints, Machine, Pause, Program, Register, Surroundings, WatchdogAction};
use std::time::Instant;

const CYCLES: usize = 100_000;

/// The registers of a controller at 500 Hz, and nothing else.
struct Registers {
    floats: [f64; 48],
    integers: [f64; 48],
    output: f64,
}

impl Surroundings for Registers {
    fn input(&self, kind: Register, address: usize) -> f64 {
        match kind {
            Register::Float => self.floats[address],
            Register::Integer => self.integers[address],
            Register::Boolean => 0.0,
        }
    }

    fn output(&self, _: Register, _: usize) -> f64 {
        self.output
    }

    fn write_output(&mut self, _: Register, _: usize, value: f64) {
        self.output = value;
    }

    fn joints(&self, _: Joints) -> [f64; 6] {
        [0.0; 6]
    }

    fn cycle_s(&self) -> f64 {
        0.002
    }

    fn set_payload(&mut self, _: f64) {}

    fn set_tcp(&mut self, _: [f64; 6]) {}

    fn set_watchdog(&mut self, _: &str, _: f64, _: WatchdogAction) -> bool {
        true
    }

    fn say(&mut self, _: &str) {}
}

fn main() {
    let text = ServoProgram {
        session: 1,
        cycle_s: 0.002,
        extrapolated_cycles: 20,
        stop_deceleration: 4.0,
        watchdog_hz: 10.0,
        patience_s: 60.0,
        registers: RegisterBase::default(),
        payload_kg: None,
        tcp: None,
    }
    .text()
    .unwrap_or_default();
    let before = Instant::now();
    let program = Program::parse(&text);
    println!("reading the servo program: {:.1} us", microseconds(before));
    let Ok(program) = program else {
        println!("the servo program cannot be read");
        return;
    };
    for (name, every) in [("each cycle", 1), ("one cycle in 20", 20)] {
        println!("a reference in {name}: {}", times(&program, every));
    }
}

/// Runs the program with a new counter in every so many cycles.
fn times(program: &Program, every: usize) -> String {
    let mut machine = Machine::new(program);
    let mut registers = Registers {
        // Besides joints: lookahead, gain, and the time of `servoj`.
        floats: std::array::from_fn(|register| match register {
            37 => 300.0,
            38 => 0.002,
            _ => 0.1,
        }),
        integers: [0.0; 48],
        output: 0.0,
    };
    // Up to where it waits for the first reference.
    let _ = machine.run(&mut registers);
    registers.integers[25] = 1.0;
    let mut cycles = Vec::with_capacity(CYCLES);
    for cycle in 0..CYCLES {
        registers.integers[24] = (1 + cycle / every) as f64;
        let before = Instant::now();
        let pause = machine.run(&mut registers);
        cycles.push(microseconds(before));
        if !matches!(pause, Ok(Pause::Servoj { .. })) {
            return format!("cycle {cycle} gives {pause:?}");
        }
    }
    cycles.sort_unstable_by(f64::total_cmp);
    format!(
        "median {:.2} us, p99 {:.2} us, max {:.2} us in {CYCLES} cycles",
        cycles[CYCLES / 2],
        cycles[CYCLES / 100 * 99],
        cycles[CYCLES - 1]
    )
}

fn microseconds(since: Instant) -> f64 {
    since.elapsed().as_secs_f64() * 1e6
}
