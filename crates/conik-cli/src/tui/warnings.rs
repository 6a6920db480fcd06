//! What an arm warns of while there is a view, which must not be written across it.

use std::sync::{Arc, Mutex, PoisonError};

/// Warnings, kept by whoever has a copy of this.
#[derive(Clone, Debug, Default)]
pub struct Warnings(Arc<Mutex<Vec<String>>>);

impl Warnings {
    /// Notes one.
    pub fn note(&self, text: &str) {
        let mut warnings = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        warnings.push(text.to_owned());
    }

    /// All of them.
    pub fn all(&self) -> Vec<String> {
        let warnings = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        warnings.clone()
    }

    /// The last one.
    pub(super) fn last(&self) -> Option<String> {
        let warnings = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        warnings.last().cloned()
    }
}
