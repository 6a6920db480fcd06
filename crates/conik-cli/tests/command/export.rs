//! `conik export`: what is in the files, by the formats' own readers, and what is refused.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use mcap::MessageStream;
use mcap::read::Summary;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use super::process::{conik, done, empty_folder, ended, repository, say};
use super::run_folder::Rows;

/// A folder with a run of the first seconds of Example 2 in `run`, in which a set becomes active.
fn with_run(name: &str) -> PathBuf {
    let folder = empty_folder(name);
    let scenario = repository().join("scenarios/paper/example2.toml");
    let scenario = scenario.to_string_lossy();
    done(
        &folder,
        &format!("run {scenario} --robot ideal --duration-s 8 --quiet --out run"),
    );
    folder
}

/// The doubles of a message, by the numbers of their fields.
fn doubles(mut bytes: &[u8]) -> BTreeMap<u8, f64> {
    let mut found = BTreeMap::new();
    while let [tag, rest @ ..] = bytes {
        bytes = match tag & 7 {
            1 => {
                let (number, rest) = rest.split_at(8);
                let number = f64::from_le_bytes(number.try_into().unwrap());
                found.insert(tag >> 3, number);
                rest
            }
            0 => &rest[1..],
            2 => &rest[1 + usize::from(rest[0])..],
            other => panic!("wire type {other}"),
        };
    }
    found
}

#[test]
fn both_files_are_written_by_default_each_named_after_the_folder() {
    let folder = with_run("export-both");
    assert_eq!(
        done(&folder, "export run"),
        "run/run.mcap\nrun/run.parquet\n"
    );
    done(
        &folder,
        "export run --quiet --format parquet --out table.pq",
    );
    let (one, other) = (folder.join("run/run.parquet"), folder.join("table.pq"));
    assert_eq!(fs::read(one).unwrap(), fs::read(other).unwrap());
    assert_eq!(
        done(&folder, "export run/ --out again.mcap"),
        "again.mcap\n"
    );
    let (one, other) = (folder.join("run/run.mcap"), folder.join("again.mcap"));
    assert_eq!(fs::read(one).unwrap(), fs::read(other).unwrap());
    let left = fs::read_dir(&folder)
        .unwrap()
        .chain(fs::read_dir(folder.join("run")).unwrap());
    assert!(
        left.map(|it| it.unwrap().file_name())
            .all(|it| !it.to_string_lossy().ends_with(".part"))
    );
}

#[test]
fn recording_tells_every_tick_of_the_log() {
    let folder = with_run("export-recording");
    done(&folder, "export run --quiet --format mcap");
    let rows = Rows::of(&folder.join("run"));
    let file = fs::read(folder.join("run/run.mcap")).unwrap();
    let mut topics: BTreeMap<String, Vec<(u64, Vec<u8>)>> = BTreeMap::new();
    for message in MessageStream::new(&file).unwrap() {
        let message = message.unwrap();
        let topic = topics.entry(message.channel.topic.clone()).or_default();
        topic.push((message.log_time, message.data.to_vec()));
    }
    // 125 Hz: eight milliseconds.
    let times: Vec<u64> = (0..=1000).map(|tick| tick * 8_000_000).collect();
    for topic in [
        "/tf",
        "/tool",
        "/joint_states",
        "/task/view",
        "/task/position",
    ] {
        let found: Vec<u64> = topics[topic].iter().map(|it| it.0).collect();
        assert_eq!(found, times, "{topic}");
    }
    for topic in ["/tf_static", "/arm", "/path"] {
        assert_eq!(topics[topic].len(), 1, "{topic}");
    }
    let values = rows.numbers("view").into_iter().zip(&topics["/task/view"]);
    for (value, (time, message)) in values {
        assert_eq!(
            doubles(message),
            BTreeMap::from([(1, value), (4, 0.2622)]),
            "{time}"
        );
    }
    let errors = rows
        .numbers("position_error")
        .into_iter()
        .zip(&topics["/task/position"]);
    for (error, (time, message)) in errors {
        assert_eq!(doubles(message), BTreeMap::from([(5, error)]), "{time}");
    }
    let changes = rows.modes().len();
    assert!(changes > 1, "no set became active");
    assert_eq!(topics["/scene"].len(), changes, "once for every mode");
}

#[test]
fn recording_has_the_scenario_and_its_messages_are_of_known_types() {
    let folder = with_run("export-facts");
    done(&folder, "export run --quiet --format mcap");
    let file = fs::read(folder.join("run/run.mcap")).unwrap();
    let summary = Summary::read(&file).unwrap().unwrap();
    let mut types: Vec<String> = summary.schemas.values().map(|it| it.name.clone()).collect();
    types.sort();
    assert_eq!(
        types,
        [
            "conik.Decision",
            "conik.Task",
            "foxglove.FrameTransforms",
            "foxglove.JointStates",
            "foxglove.Log",
            "foxglove.PoseInFrame",
            "foxglove.SceneUpdate",
        ]
    );
    let attached = |name: &str| {
        let mut indexes = summary.attachment_indexes.iter();
        let index = indexes.find(|it| it.name == name).unwrap();
        let attachment = mcap::read::attachment(&file, index).unwrap();
        String::from_utf8(attachment.data.into_owned()).unwrap()
    };
    let written = fs::read_to_string(folder.join("run/summary.json")).unwrap();
    assert_eq!(attached("summary.json"), written);
    // The scenario is one that can be run again.
    fs::write(folder.join("again.toml"), attached("scenario.toml")).unwrap();
    done(&folder, "run again.toml --robot ideal --quiet --out again");
    let log = |run: &str| fs::read_to_string(folder.join(run).join("log.csv")).unwrap();
    assert_eq!(log("again"), log("run"));
    let index = &summary.metadata_indexes[0];
    let facts = mcap::read::metadata(&file, index).unwrap();
    assert_eq!(facts.name, "conik");
    assert_eq!(facts.metadata["mode_rule"], "paper");
    assert_eq!(facts.metadata["outcome"], "completed");
}

#[test]
fn table_is_the_log_cell_by_cell() {
    let folder = with_run("export-table");
    done(&folder, "export run --quiet --format parquet");
    let rows = Rows::of(&folder.join("run"));
    let names: Vec<&str> = rows.header.split(',').collect();
    let file = File::open(folder.join("run/run.parquet")).unwrap();
    let table = SerializedFileReader::new(file).unwrap();
    let mut count = 0;
    for (row, expected) in table.get_row_iter(None).unwrap().zip(&rows.rows) {
        let row = row.unwrap();
        for ((name, field), (column, cell)) in row.get_column_iter().zip(names.iter().zip(expected))
        {
            assert_eq!(name, column);
            let is_same = match field {
                Field::Double(number) => *number == cell.parse::<f64>().unwrap(),
                Field::ULong(number) => *number == cell.parse::<u64>().unwrap(),
                Field::Int(number) => *number == cell.parse::<i32>().unwrap(),
                Field::Str(text) => text == cell,
                _ => false,
            };
            assert!(is_same, "row {count}, {name}: {field} for {cell}");
        }
        assert_eq!(row.len(), names.len());
        count += 1;
    }
    assert_eq!(count, rows.rows.len());
    let metadata = table
        .metadata()
        .file_metadata()
        .key_value_metadata()
        .unwrap();
    let of = |key: &str| {
        metadata
            .iter()
            .find(|it| it.key == key)
            .unwrap()
            .value
            .clone()
            .unwrap()
    };
    let units: BTreeMap<String, String> = serde_json::from_str(&of("conik.units")).unwrap();
    for (column, unit) in [
        ("t_s", "s"),
        ("view", "-"),
        ("position_error", "m"),
        ("tool_z_m", "m"),
        ("q6_rad", "rad"),
        ("qd1_rad_s", "rad/s"),
        ("qdd1_rad_s2", "rad/s²"),
    ] {
        assert_eq!(units[column], unit, "{column}");
    }
    assert!(of("conik.scenario").contains("ur5-paper"));
}

#[test]
fn standard_output_gets_the_same_bytes() {
    let folder = with_run("export-pipe");
    done(&folder, "export run --quiet");
    for format in ["mcap", "parquet"] {
        let line = ["export", "run", "--format", format, "--out", "-"];
        let output = conik(line).current_dir(&folder).output().unwrap();
        assert!(output.status.success(), "{output:?}");
        let written = fs::read(folder.join(format!("run/run.{format}"))).unwrap();
        assert!(output.stdout == written, "{format}");
    }
}

#[test]
fn log_that_was_cut_off_is_exported_to_its_last_whole_row() {
    let folder = with_run("export-cut");
    let log = folder.join("run/log.csv");
    let text = fs::read_to_string(&log).unwrap();
    fs::write(&log, &text[..text.len() - 20]).unwrap();
    let said = say(&folder, "export run --format parquet");
    assert_eq!(said.status, Some(0));
    assert!(
        said.stderr
            .contains("warning: the last line of log.csv is cut off")
    );
    let file = File::open(folder.join("run/run.parquet")).unwrap();
    let table = SerializedFileReader::new(file).unwrap();
    assert_eq!(table.metadata().file_metadata().num_rows(), 1000);
}

#[track_caller]
fn refused(folder: &Path, line: &str, words: &str) {
    let said = say(folder, line);
    assert_eq!(said.status, Some(2), "conik {line}: {said:#?}");
    assert!(said.stderr.contains(words), "conik {line}: {}", said.stderr);
}

#[test]
fn what_cannot_be_exported_is_refused_in_words() {
    let folder = with_run("export-refused");
    fs::create_dir(folder.join("empty")).unwrap();
    for (line, words) in [
        ("export nowhere", "nowhere/summary.json: cannot be read"),
        ("export empty", "is this the folder of a run?"),
        ("export run/log.csv", "is a file; give the folder"),
        ("export run --format csv", "mcap, parquet"),
        (
            "export run --out run",
            "Give --format, or a name that ends in .mcap or .parquet",
        ),
        (
            "export run --format mcap --out run",
            "--out run: this is a folder",
        ),
        (
            "export run --format mcap --format parquet --out x",
            "--out names one file",
        ),
        (
            "export run --out no/such/x.mcap",
            "cannot write no/such/x.mcap",
        ),
        ("export run --out -", "in which format?"),
    ] {
        refused(&folder, line, words);
    }
    let log = folder.join("run/log.csv");
    let text = fs::read_to_string(&log).unwrap();
    let header = text.lines().next().unwrap();
    fs::write(&log, format!("{header}\n")).unwrap();
    for format in ["mcap", "parquet"] {
        let line = format!("export run --format {format}");
        refused(&folder, &line, "has no rows");
        assert!(!folder.join(format!("run/run.{format}")).exists());
    }
    fs::write(&log, text.replacen(",q3_rad,", ",q7_rad,", 1)).unwrap();
    refused(&folder, "export run", "there is no column `q3_rad`");
    fs::remove_file(&log).unwrap();
    refused(&folder, "export run", "log.csv: cannot be read");
}

#[test]
#[cfg(target_os = "linux")]
fn full_disk_is_named_and_nothing_is_left() {
    let folder = with_run("export-full");
    for format in ["mcap", "parquet"] {
        let line = format!("export run --format {format} --out /dev/full");
        refused(&folder, &line, "cannot write /dev/full: No space left");
    }
    assert!(Path::new("/dev/full").exists());
}

#[test]
#[cfg(unix)]
fn reader_that_went_away_is_no_failure() {
    let folder = with_run("export-gone");
    let line = format!(
        "{} export run --format mcap --out - | head -c 100",
        env!("CARGO_BIN_EXE_conik")
    );
    let said = ended(
        std::process::Command::new("bash")
            .args(["-o", "pipefail", "-c", &format!("{line} | wc -c")])
            .current_dir(&folder),
    );
    assert_eq!(
        (said.status, said.stdout.trim()),
        (Some(0), "100"),
        "{}",
        said.stderr
    );
}
