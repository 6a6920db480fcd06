//! What the report may do in a browser: run its own scripts, named by their digests, and load nothing.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest, Sha256};

/// The policy as an element of the page's head; no scripts but those of these digests run.
pub fn element(digests: &[&str]) -> String {
    let scripts: Vec<String> = digests.iter().map(|digest| format!("'{digest}'")).collect();
    let rules = [
        "default-src 'none'",
        &format!("script-src {}", scripts.join(" ")),
        "style-src 'unsafe-inline'",
        // The replay has the picture of its tab in itself.
        "img-src data: blob:",
        "base-uri 'none'",
        "form-action 'none'",
    ];
    format!(
        "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n",
        rules.join("; ")
    )
}

/// A script as an element, and its digest.
pub fn script(text: &str) -> (String, String) {
    (format!("<script>{text}</script>\n"), digest(text))
}

/// The digest of a script as policies name it.
pub fn digest(script: &str) -> String {
    format!("sha256-{}", STANDARD.encode(Sha256::digest(script)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digests_are_those_of_the_standard() {
        // FIPS 180-4, the example of one block.
        assert_eq!(
            digest("abc"),
            "sha256-ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0="
        );
    }
}
