//! Times a piece of work over many inputs, and prints a line.

use std::time::Instant;

const BATCH: usize = 100;
const ROUNDS: usize = 5;

/// Prints what the columns are.
pub fn heading() {
    println!("reading the clock twice: {} ns", clock_ns());
    println!(
        "{:<46} {:>8} {:>8} {:>8} {:>8}",
        "[µs]", "median", "p99", "max", "batch"
    );
}

/// Fastest of many pairs of clock readings.
fn clock_ns() -> u128 {
    (0..100_000)
        .map(|_| Instant::now().elapsed().as_nanos())
        .min()
        .unwrap_or(0)
}

/// Whether the words after `--` on the command line are all in the name. Without words, always.
pub fn is_wanted(name: &str) -> bool {
    std::env::args()
        .skip(1)
        .filter(|word| !word.starts_with('-'))
        .all(|word| name.contains(&word))
}

/// Does `work` on every input, one by one and in batches, a few times over, and prints a line.
pub fn report<T>(name: &str, inputs: &[T], mut work: impl FnMut(&T)) {
    let mut single = Vec::with_capacity(ROUNDS * inputs.len());
    let mut batches = Vec::with_capacity(ROUNDS * inputs.len() / BATCH);
    for _ in 0..ROUNDS {
        for input in inputs {
            let before = Instant::now();
            work(input);
            single.push(before.elapsed().as_nanos());
        }
        for batch in inputs.chunks_exact(BATCH) {
            let before = Instant::now();
            batch.iter().for_each(&mut work);
            batches.push(before.elapsed().as_nanos());
        }
    }
    single.sort_unstable();
    batches.sort_unstable();
    let us = |ns: u128| ns as f64 / 1e3;
    println!(
        "{name:<46} {:>8.3} {:>8.3} {:>8.3} {:>8.3}",
        us(single[single.len() / 2]),
        us(single[single.len() * 99 / 100]),
        us(single[single.len() - 1]),
        us(batches[batches.len() / 2]) / BATCH as f64,
    );
}
