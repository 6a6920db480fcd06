//! `cargo xtask test`: what has to hold before a change lands.

use crate::programs::{CHROMIUM, CLIPPY, NODE, PYTHON, RUSTFMT};
use crate::step::Step;

/// The compiler that lints too. What it compiles is what is tested, so that nothing is compiled twice.
const LINTING: [(&str, &str); 2] = [
    ("RUSTC_WORKSPACE_WRAPPER", "clippy-driver"),
    (
        "CLIPPY_ARGS",
        "--deny__CLIPPY_HACKERY__warnings__CLIPPY_HACKERY__",
    ),
];

/// Formatting, lints and Rust tests: the quick loop.
pub fn rust() -> Vec<Step> {
    vec![
        Step {
            needs: vec![RUSTFMT],
            ..Step::cargo("formatting", &["fmt", "--all", "--check"])
        },
        Step {
            needs: vec![CLIPPY],
            environment: LINTING.into(),
            ..Step::cargo("lints and Rust tests", &["test", "--workspace"])
        },
        Step {
            environment: LINTING.into(),
            ..Step::cargo(
                "lints of benchmarks",
                &["test", "--workspace", "--benches", "--no-run"],
            )
        },
    ]
}

/// Everything.
pub fn all() -> Vec<Step> {
    let mut steps = rust();
    steps.extend([
        Step::cargo(
            "the core without the standard library",
            &[
                "check",
                "--package",
                "conik",
                "--no-default-features",
                "--features",
                "libm",
            ],
        ),
        Step {
            environment: vec![("RUSTDOCFLAGS", "--deny warnings")],
            ..Step::cargo(
                "documentation of the libraries",
                &[
                    "doc",
                    "--no-deps",
                    "--quiet",
                    "--package",
                    "conik",
                    "--package",
                    "conik-urdf",
                    "--package",
                    "conik-sim",
                    "--package",
                    "conik-ur",
                    "--package",
                    "conik-campaign",
                ],
            )
        },
        Step {
            folder: "crates/conik-py",
            needs: vec![PYTHON],
            environment: LINTING.into(),
            ..command("Python package", &["python3", "tests/in_environment.py"])
        },
        Step {
            needs: vec![PYTHON],
            environment: LINTING.into(),
            ..command("documentation site", &["python3", "tests/docs/run.py"])
        },
        Step {
            needs: vec![PYTHON],
            ..command(
                "real clients against the emulator",
                &["python3", "tests/clients/run.py"],
            )
        },
        Step {
            needs: vec![PYTHON],
            ..command(
                "exports, read by others",
                &["python3", "tests/exports/run.py"],
            )
        },
        Step {
            needs: vec![PYTHON],
            environment: LINTING.into(),
            ..command("examples", &["python3", "tests/examples/run.py"])
        },
        Step {
            folder: "viewer/src",
            needs: vec![NODE, CHROMIUM],
            ..command("page", &["npm", "--prefix", "..", "run", "test:all"])
        },
    ]);
    steps
}

fn command(name: &'static str, words: &[&'static str]) -> Step {
    Step {
        command: words.to_vec(),
        ..Step::cargo(name, &[])
    }
}
