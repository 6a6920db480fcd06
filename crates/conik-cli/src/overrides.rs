//! Applies the options that override the scenario.

use conik_sim::scenario::{Choice, Scenario};

use crate::arguments::Overrides;
use crate::failure::Failure;

impl Overrides {
    /// Whether any of them is there.
    pub fn is_any(&self) -> bool {
        let choices = [&self.mode_rule, &self.border, &self.recursion];
        let numbers = [self.duration_s, self.rate_hz];
        choices.into_iter().any(Option::is_some) || numbers.iter().any(Option::is_some)
    }

    /// Puts the options in the place of what the file says, and checks the whole again.
    pub fn apply(&self, scenario: &mut Scenario) -> Result<(), Failure> {
        let control = &mut scenario.control;
        choose(
            "mode-rule",
            self.mode_rule.as_deref(),
            &mut control.mode_rule,
        )?;
        choose("border", self.border.as_deref(), &mut control.border)?;
        choose(
            "recursion",
            self.recursion.as_deref(),
            &mut control.recursion,
        )?;
        control.rate_hz = self.rate_hz.unwrap_or(control.rate_hz);
        control.duration_s = self.duration_s.unwrap_or(control.duration_s);
        for (option, value) in [
            ("rate-hz", control.rate_hz),
            ("duration-s", control.duration_s),
        ] {
            if !value.is_finite() {
                return Err(Failure::input(format!(
                    "--{option}: {value} is no finite number"
                )));
            }
        }
        scenario
            .check()
            .map_err(|errors| Failure::overrides(&errors))
    }
}

fn choose<T: Choice + 'static>(
    option: &str,
    name: Option<&str>,
    value: &mut T,
) -> Result<(), Failure> {
    let Some(name) = name else { return Ok(()) };
    *value = T::from_name(name).ok_or_else(|| {
        let known: Vec<&str> = T::ALL.iter().map(|(choice, _)| choice.name()).collect();
        let known = known.join("`, `");
        Failure::input(format!(
            "--{option}: there is no `{name}`; give one of `{known}`"
        ))
    })?;
    Ok(())
}
