//! `conik schema`: the JSON Schema of the scenario file.

use std::process::ExitCode;

use crate::failure::Failure;

/// Prints the schema, as `scenarios/schema.json` has it.
pub fn schema() -> Result<ExitCode, Failure> {
    let text =
        serde_json::to_string_pretty(&conik_sim::scenario::schema()).map_err(Failure::run)?;
    super::print(&format!("{text}\n"))
}
