//! `conik campaign`: what it writes, that it goes on after Ctrl-C, and what is refused.

use std::fs::{self, File};
use std::path::Path;

use conik_sim::scenario::Scenario;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use super::process::{Running, done, empty_folder, paper, say, wait_for};

fn line(rest: &str) -> String {
    format!("campaign {} {rest}", paper("example2").display())
}

fn texts(file: &Path, column: &str) -> Vec<String> {
    let reader = SerializedFileReader::new(File::open(file).unwrap()).unwrap();
    let rows = reader.get_row_iter(None).unwrap();
    rows.map(|row| {
        let row = row.unwrap();
        let found = row.get_column_iter().find(|(name, _)| *name == column);
        match found {
            Some((_, Field::Str(text))) => text.clone(),
            other => panic!("{column}: {other:?}"),
        }
    })
    .collect()
}

#[test]
fn table_report_and_worst_cases_are_written_and_said() {
    let folder = empty_folder("campaign");
    let said = done(&folder, &line("--runs 300 --duration-s 5 --out c"));
    assert!(said.starts_with("300 runs\n"), "{said}");
    assert!(said.contains("4: once entered, they stay: "), "{said}");
    assert!(said.ends_with("report: c/report.html\n"), "{said}");
    let classes = texts(&folder.join("c/runs.parquet"), "class");
    assert_eq!(classes.len(), 300);
    let report = fs::read_to_string(folder.join("c/report.html")).unwrap();
    let mut worst = 0;
    for file in fs::read_dir(folder.join("c/worst")).unwrap() {
        let path = file.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        assert!(report.contains(&format!("worst/{name}")), "{name}");
        Scenario::load(&path).unwrap();
        let (class, run) = name.trim_end_matches(".toml").rsplit_once('-').unwrap();
        assert_eq!(classes[run.parse::<usize>().unwrap()], class);
        worst += 1;
    }
    assert!(worst > 0);
    assert!(!folder.join("c/shards").exists());
    let again = done(&folder, &line("--runs 300 --duration-s 5 --out c"));
    assert_eq!(again, "it is done already: c/report.html\n");
}

#[test]
fn jobs_make_no_difference_and_options_do() {
    let folder = empty_folder("campaign-jobs");
    let bytes = |options: &str, out: &str| {
        let options = format!("--runs 260 --duration-s 0.5 --quiet {options} --out {out}");
        assert_eq!(done(&folder, &line(&options)), "");
        fs::read(folder.join(out).join("runs.parquet")).unwrap()
    };
    let first = bytes("--jobs 1", "one");
    assert_eq!(first, bytes("--jobs 4", "four"));
    for (out, options) in [
        ("seed", "--seed 2"),
        ("near", "--starts 5"),
        ("rule", "--mode-rule cone"),
        ("moved", "--obstacles-m 0.01 --targets-m 0.02"),
        ("rates", "--rates-hz 100,200 --servo-lag-s 0.03,0.1"),
    ] {
        assert_ne!(first, bytes(options, out), "{options}");
    }
}

#[test]
fn stopped_campaign_goes_on() {
    let folder = empty_folder("campaign-stopped");
    let options = "--runs 3000 --duration-s 5 --jobs 1 --mode-rule cone --border land --out c";
    let running = Running::start(&folder, &line(options));
    let shards = || fs::read_dir(folder.join("c/shards")).ok()?.next().map(drop);
    wait_for("a shard", shards);
    running.signal("INT");
    let said = running.wait();
    assert_eq!(said.status, Some(130), "{said:?}");
    assert!(
        said.stdout
            .contains("the same command goes on with the others"),
        "{said:?}"
    );
    assert!(!folder.join("c/runs.parquet").exists());
    let other = say(&folder, &line(&options.replace("-s 5", "-s 6")));
    assert_eq!(other.status, Some(2));
    assert!(other.stderr.contains("its scenario differs"), "{other:?}");
    let done = say(&folder, &line(options));
    assert!(matches!(done.status, Some(0 | 1)), "{done:?}");
    assert_eq!(texts(&folder.join("c/runs.parquet"), "outcome").len(), 3000);
}

#[test]
fn what_makes_no_sense_is_refused_before_anything_is_written() {
    let folder = empty_folder("campaign-refused");
    for (options, reason) in [
        ("--runs 0", "no runs are asked for"),
        ("--starts same", "nothing varies"),
        ("--starts here", "`here` is no place"),
        ("--starts nan", "the spread of the starts"),
        ("--targets-m -1", "the shift of targets"),
        ("--rates-hz 0", "a rate [Hz] is 0"),
        ("--servo-lag-s 1,2,3", "--servo-lag-s: give the least"),
        ("--servo-lag-s 0.2,0.1", "the lesser first"),
        ("--border lands", "there is no `lands`"),
        ("--jobs 0", "--jobs"),
        ("--ray auto --jobs 2", "cannot be used with"),
    ] {
        let said = say(&folder, &line(&format!("{options} --out c")));
        assert_eq!(said.status, Some(2), "{options}: {said:?}");
        assert!(said.stderr.contains(reason), "{options}: {said:?}");
        assert!(!folder.join("c").exists(), "{options}");
    }
}

#[test]
fn cluster_without_python_is_told_what_is_missing() {
    let folder = empty_folder("campaign-ray");
    let mut command =
        super::process::conik(line("--runs 10 --ray auto --out c").split_whitespace());
    command
        .current_dir(&folder)
        .env("PYTHON", "/nowhere/python3");
    let said = super::process::ended(&mut command);
    assert_eq!(said.status, Some(2));
    assert!(said.stderr.contains("--ray needs Python"), "{said:?}");
    assert!(said.stderr.contains("pip install ray"), "{said:?}");
}
