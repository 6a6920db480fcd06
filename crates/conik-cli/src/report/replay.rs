//! The run replayed inside its report: the page that `conik view` serves and the data of this run, both
//! packed, and a small script that unpacks them when somebody asks for it.
//!
//! Without the script, or on paper, the report lacks nothing but this.

use std::io::{self, Write};
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;

use crate::figure::Run;
use crate::figure::lettering::seconds;
use crate::view::{PAGE, Recording, ViewError};

/// Rows of the log that a report takes along: 80 s at 125 Hz whole, and a file that can be mailed
/// however long the run was.
pub const MOST_ROWS: usize = 10_000;

/// More effort makes the file a tenth smaller, and takes as long as all the rest of the report.
const EFFORT: Compression = Compression::new(4);

/// What switches between the report and its replay.
pub const SCRIPT: &str = include_str!("replay.js");

/// The switch at the top of the page. The script shows it: without one it leads nowhere.
pub const TABS: &str = "<nav id=\"views\" aria-label=\"Views\" hidden>\n<a href=\"#report\">Report</a>\n\
     <a href=\"#t=0\">Replay in 3-D</a>\n</nav>\n";

/// The page and the run, read from the folder `dir`, as elements of the report.
pub fn elements(run: &Run, dir: &Path) -> Result<String, ViewError> {
    let recording = Recording::of(dir, run, MOST_ROWS)?.to_json();
    Ok([("player", PAGE), ("recording", &recording)]
        .map(|(id, text)| {
            let packed = packed(text);
            format!("<script type=\"application/gzip\" id=\"{id}\">{packed}</script>\n")
        })
        .concat())
}

/// A moment of the run in words; the script makes it a link to the replay.
pub fn moment(t_s: f64) -> String {
    format!("<span data-t=\"{t_s:.4}\">{}</span>", seconds(t_s))
}

/// The digest, `sha256-…`, by which the page names its own script as the one that may run.
pub fn digest_of_player() -> &'static str {
    let rules = PAGE.split_once("script-src '").map(|(_, rest)| rest);
    let digest = rules.and_then(|rules| rules.split_once('\''));
    digest.map_or("", |(digest, _)| digest)
}

/// Gzip in base64.
fn packed(text: &str) -> String {
    let mut gzip = GzEncoder::new(Vec::new(), EFFORT);
    let bytes = gzip.write_all(text.as_bytes()).and_then(|()| gzip.finish());
    // Memory takes what is written to it.
    STANDARD.encode(bytes.unwrap_or_else(|_: io::Error| Vec::new()))
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use flate2::read::GzDecoder;

    use super::*;

    #[test]
    fn what_is_packed_comes_out_again() {
        let text = "{\"title\":\"</script>\u{3c3}\"}".repeat(1000);
        let packed = packed(&text);
        assert!(packed.len() < text.len() / 20 && !packed.contains('<'));
        let bytes = STANDARD.decode(packed).unwrap();
        let mut unpacked = String::new();
        GzDecoder::new(&bytes[..])
            .read_to_string(&mut unpacked)
            .unwrap();
        assert_eq!(unpacked, text);
    }

    #[test]
    fn the_page_names_its_script() {
        let digest = digest_of_player();
        assert!(
            digest.starts_with("sha256-") && digest.len() == 51,
            "{digest}"
        );
        let (_, script) = PAGE.rsplit_once("<script type=\"module\">").unwrap();
        let (script, _) = script.split_once("</script>").unwrap();
        assert_eq!(super::super::policy::digest(script), digest);
    }
}
