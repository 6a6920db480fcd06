//! `cargo xtask`: everything that checks the project, from one command.

mod programs;
mod step;
mod test;

use std::process::ExitCode;

const USAGE: &str = "usage: cargo xtask test [--rust]

  test          formatting, lints, all Rust tests, the Python package, the documentation site and its
                snippets, real clients against the emulator, exports read by others, the page in a
                browser; installs what is missing
  test --rust   formatting, lints and Rust tests only: the quick loop";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let steps = match words.as_slice() {
        ["test"] => test::all(),
        ["test", "--rust"] => test::rust(),
        ["help" | "--help" | "-h"] => {
            println!("{USAGE}");
            return ExitCode::SUCCESS;
        }
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    step::run(&steps)
}
