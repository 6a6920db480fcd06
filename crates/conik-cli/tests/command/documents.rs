//! What the documents say is there: every link, every file, every name in the code, every command.

use std::fs;
use std::path::{Path, PathBuf};

use super::process::{conik, empty_folder, ended, repository};

/// README.md, docs/*.md and docs/gallery/*.md, with their text.
fn documents() -> Vec<(PathBuf, String)> {
    let folders = ["docs", "docs/gallery"].map(|folder| repository().join(folder));
    let entries = folders
        .iter()
        .flat_map(|folder| fs::read_dir(folder).unwrap());
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.push(repository().join("README.md"));
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "md"));
    paths
        .into_iter()
        .map(|path| (path.clone(), fs::read_to_string(path).unwrap()))
        .collect()
}

/// What stands between `open` and `close`, on one line each.
fn between<'a>(text: &'a str, open: &'a str, close: char) -> impl Iterator<Item = &'a str> {
    text.lines()
        .flat_map(move |line| line.split(open).skip(1))
        .filter_map(move |rest| rest.split_once(close).map(|(inside, _)| inside))
}

/// What stands in backticks.
fn code(text: &str) -> impl Iterator<Item = &str> {
    text.lines()
        .flat_map(|line| line.split('`').skip(1).step_by(2))
}

/// Every Rust source below `folder`, and the paths of all files.
fn walk(folder: &Path, sources: &mut String) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            walk(&path, sources);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            *sources += &fs::read_to_string(&path).unwrap();
        }
    }
}

#[test]
fn links_lead_to_files() {
    let mut links = 0;
    for (path, text) in documents() {
        for link in between(&text, "](", ')') {
            let file = link.split('#').next().unwrap();
            if link.contains("://") || file.is_empty() {
                continue;
            }
            let target = path.parent().unwrap().join(file);
            assert!(target.exists(), "{}: {link}", path.display());
            links += 1;
        }
    }
    assert!(links > 3, "found {links} links only");
}

/// `Interval::nearest_bound`, `in_T_C`: the last part of a path in Rust.
fn rust_name(code: &str) -> Option<&str> {
    let is_name = |name: &str| {
        !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
    };
    let looks_like_code =
        code.contains("::") || code.contains('_') || code.starts_with(char::is_uppercase);
    (looks_like_code && code.split("::").all(is_name)).then(|| code.rsplit("::").next().unwrap())
}

#[test]
fn paper_map_names_what_is_in_the_code() {
    // A listing of the paper, by its name there.
    const OF_THE_PAPER: &[&str] = &["in_T_C"];
    let root = repository();
    let mut sources = String::new();
    walk(&root.join("crates"), &mut sources);
    let words: std::collections::HashSet<&str> = sources
        .split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
        .collect();
    let map = fs::read_to_string(root.join("docs/paper-map.md")).unwrap();
    let (mut files, mut names) = (0, 0);
    for code in code(&map) {
        if code.contains('/') {
            let path = code.split('*').next().unwrap();
            let found = [root.join("crates").join(path), root.join(path)];
            assert!(found.iter().any(|path| path.exists()), "no file {code}");
            files += 1;
        } else if let Some(name) = rust_name(code).filter(|name| !OF_THE_PAPER.contains(name)) {
            assert!(words.contains(name), "no {code} in the sources");
            names += 1;
        }
    }
    assert!(
        files > 20 && names > 10,
        "found {files} files, {names} names"
    );
}

/// The words after `conik`, as far as a shell would hand them on: `cargo run --release -- x` too.
fn commands(text: &str) -> Vec<Vec<String>> {
    let lines = text.lines().map(|line| line.trim_start_matches("$ "));
    code(text)
        .chain(lines)
        .filter_map(|line| {
            let rest = line
                .strip_prefix("conik ")
                .or_else(|| line.strip_prefix("cargo run --release -- "))?;
            let words = rest
                .split_whitespace()
                .take_while(|word| !["#", "|", ">", "&&", "&"].contains(word));
            // `[--option]` and `...` of a synopsis.
            let words = words.map(|word| word.trim_matches(['[', ']', ',']).to_owned());
            Some(words.filter(|word| !word.contains("...")).collect())
        })
        .collect()
}

#[test]
fn commands_are_accepted() {
    let folder = empty_folder("documents");
    let mut checked = 0;
    for (path, text) in documents() {
        for words in commands(&text) {
            // With --help nothing is run, but unknown options and commands are refused before.
            let said = ended(
                conik(words.iter().map(String::as_str).chain(["--help"])).current_dir(&folder),
            );
            assert_eq!(
                said.status,
                Some(0),
                "{}: conik {words:?}: {said:#?}",
                path.display()
            );
            assert!(said.stdout.contains("Usage: conik"), "{said:#?}");
            checked += 1;
        }
    }
    assert!(checked > 8, "found {checked} commands only");
}
