//! `check`, `plot`, `schema`, `init`, `robots`, `completions`, and no command at all.

use std::fs;

use super::process::{done, empty_folder, paper, repository, say};

#[test]
fn check_prints_robot_hierarchy_modes_and_doubts_and_writes_nothing() {
    let folder = empty_folder("check");
    let said = done(&folder, &format!("check {}", paper("example2").display()));
    for part in [
        "Example 2",
        "robot ur5-paper",
        "shoulder_pan_joint",
        "high-priority set",
        "make 6 modes",
        "125 Hz",
        "doubtful:",
        "`view` starts 0.6320 outside its set",
    ] {
        assert!(said.contains(part), "`{part}` is missing:\n{said}");
    }
    assert!(fs::read_dir(&folder).unwrap().next().is_none());
}

#[test]
fn check_speaks_of_the_rules_in_use() {
    let folder = empty_folder("check rules");
    let text = fs::read_to_string(paper("example2")).unwrap();
    let check = |name: &str, from: [&str; 3], to: [&str; 3]| {
        let changed = from.iter().zip(to).fold(text.clone(), |text, (from, to)| {
            assert!(text.contains(from), "{from}");
            text.replace(from, to)
        });
        fs::write(folder.join(name), changed).unwrap();
        let said = done(&folder, &format!("check {name}"));
        assert!(said.lines().all(|l| l.chars().count() <= 80), "{said}");
        // Where lines are broken does not matter.
        said.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let settings = [
        "mode_rule = \"paper\"",
        "border = \"freeze\"",
        "recursion = \"chiaverini\"",
    ];

    let paper = check("paper.toml", settings, settings);
    assert!(paper.contains("rule paper: all subsets"), "{paper}");
    assert!(paper.contains("wait for ever"), "{paper}");
    assert!(
        paper.contains("border `freeze` decides at samples"),
        "{paper}"
    );
    assert!(!paper.contains("`exclusive`"), "{paper}");

    let default = check("default.toml", settings, ["", "", ""]);
    assert!(default.contains("rule cone: at each level"), "{default}");
    assert!(
        default.contains("border land: the next sample"),
        "{default}"
    );
    assert!(
        default.contains("recursion siciliano-slotine: each"),
        "{default}"
    );
    assert!(default.contains("`exclusive` has no effect with rule `cone`"));
    assert!(!default.contains("wait for ever") && !default.contains("decides at samples"));

    let mixed = check("mixed.toml", settings, ["", "", settings[2]]);
    assert!(mixed.contains("may come to rest where the sets leave a way"));
}

#[test]
fn plot_draws_the_figures_and_the_report_again() {
    let folder = empty_folder("plot");
    let line = format!(
        "run {} --robot ideal --duration-s 2 --out o",
        paper("example2").display()
    );
    done(&folder, &line);
    let report = folder.join("o/report.html");
    let before = fs::read(&report).unwrap();
    fs::remove_file(&report).unwrap();

    let said = done(&folder, "plot o");
    assert!(
        fs::read(&report).unwrap() == before,
        "the report of the same run differs"
    );
    assert!(
        said.contains("o/figure4.svg\n") && said.contains("o/report.html\n"),
        "{said}"
    );
    let help = done(&folder, "plot --help");
    for path in said.lines() {
        let file = path.strip_prefix("o/").unwrap();
        let (figure, _) = file.split_once('.').unwrap();
        assert!(
            help.contains(&format!("  {figure} ")) || help.contains(file),
            "{file} is not in the help"
        );
        assert!(fs::metadata(folder.join(path)).unwrap().len() > 0, "{path}");
    }
    assert_eq!(done(&folder, "plot o --quiet"), "");
}

#[test]
fn plot_makes_the_formats_sizes_and_times_that_are_asked_for() {
    let folder = empty_folder("plot options");
    let example = paper("example2");
    let line = format!("run {} --robot ideal --duration-s 2", example.display());
    done(&folder, &format!("{line} --out o"));
    let said = done(&folder, "plot o --at 1.5,0 --format png --width-px 500");
    let pictures: Vec<&str> = said.lines().filter(|it| *it != "o/report.html").collect();
    assert_eq!(pictures.len(), 8, "{said}");
    for path in pictures {
        let bytes = fs::read(folder.join(path)).unwrap();
        assert_eq!(bytes[..8], *b"\x89PNG\r\n\x1a\n", "{path}");
        assert_eq!(bytes[16..20], 500_u32.to_be_bytes(), "{path}");
    }
    assert!(!folder.join("o/arm.svg").exists());
    done(&folder, "plot o --at 1.503 --format svg -q");
    let arm = fs::read_to_string(folder.join("o/figure5.svg")).unwrap();
    assert!(arm.contains("the arm at 1.504\u{a0}s,"), "{arm}");

    for (options, says) in [
        (
            "--at 3",
            "at 3 s there was no arm: the run went from 0 s to 2 s",
        ),
        ("--at -1", "at -1 s there was no arm"),
        ("--at NaN", "at NaN s there was no arm"),
        ("--at 0,later", "later"),
        ("--at 0,0,0,0,0,0,0,0,0,0,0,0,0", "13 times are too many"),
        ("--scale 0", "from 0.1 to 20"),
        ("--scale big", "not a number"),
        ("--width-px 1", "16..=20000"),
        ("--width-px 500 --scale 3", "cannot be used with"),
        ("--format gif", "possible values: svg, png"),
    ] {
        let said = say(&folder, &format!("plot o {options}"));
        assert_eq!(said.status, Some(2), "{options}: {said:#?}");
        assert!(said.stderr.contains(says), "{options}: {}", said.stderr);
    }
}

#[test]
fn plot_of_a_folder_without_a_log_is_bad_input() {
    let folder = empty_folder("plot of nothing");
    fs::create_dir(folder.join("empty")).unwrap();
    for dir in ["empty", "no/such/folder"] {
        let said = say(&folder, &format!("plot {dir}"));
        assert_eq!(said.status, Some(2));
        assert!(
            said.stderr.starts_with(&format!("error: {dir}/")),
            "{said:#?}"
        );
    }
}

#[test]
fn schema_is_the_one_in_the_repository() {
    let schema = fs::read_to_string(repository().join("scenarios/schema.json")).unwrap();
    assert_eq!(done(&empty_folder("schema"), "schema"), schema);
}

#[test]
fn template_passes_check_runs_and_is_not_overwritten() {
    let folder = empty_folder("init");
    let said = done(&folder, "init mine.toml");
    assert!(said.contains("conik run mine.toml"), "{said}");
    let written = fs::read_to_string(folder.join("mine.toml")).unwrap();
    assert_eq!(done(&folder, "init -"), written);
    done(&folder, "check mine.toml");
    done(&folder, "run mine.toml --robot ideal --quiet");
    assert!(folder.join("out/mine/report.html").exists());

    fs::write(folder.join("mine.toml"), "precious").unwrap();
    let said = say(&folder, "init mine.toml");
    assert_eq!(said.status, Some(2));
    assert!(
        said.stderr.contains("mine.toml is there already"),
        "{said:#?}"
    );
    assert_eq!(fs::read(folder.join("mine.toml")).unwrap(), b"precious");
    done(&folder, "init mine.toml --force");
    assert_eq!(
        fs::read_to_string(folder.join("mine.toml")).unwrap(),
        written
    );
    assert_eq!(say(&folder, "init no/such/folder.toml").status, Some(2));
}

#[test]
fn robots_are_listed_with_joints_and_source() {
    let folder = empty_folder("robots");
    let said = done(&folder, "robots");
    assert!(said.lines().all(|l| l.chars().count() <= 80), "{said}");
    let page = fs::read_to_string(repository().join("docs/robots.md")).unwrap();
    for name in conik::Robot::builtin_names() {
        let robot = conik::Robot::builtin(name).unwrap();
        let mut lines = said.lines().map(|line| line.split_whitespace());
        let line = lines.find(|words| words.clone().next() == Some(name));
        let joints = line.and_then(|mut words| words.nth(1));
        assert_eq!(joints, Some(robot.dof().to_string().as_str()), "{name}");
        assert!(page.contains(&format!("`{name}`")), "{name}");
    }
}

#[test]
fn robots_describes_joints_limits_and_frames_of_one() {
    let folder = empty_folder("one robot");
    let about = |name: &str| {
        let said = done(&folder, &format!("robots {name}"));
        assert!(said.lines().all(|l| l.chars().count() <= 80), "{said}");
        said
    };
    let ur3e = about("ur3e");
    for part in [
        "robot ur3e, 6 joints, tool `tool0`",
        "Universal Robots",
        "shoulder_pan_joint   revolute  -360.0…360.0°  ≤ 180.0°/s  –",
        "wrist_3_joint        revolute  without end    ≤ 360.0°/s  –",
        "base_link",
    ] {
        assert!(ur3e.contains(part), "`{part}` is missing:\n{ur3e}");
    }
    let panda = about("panda");
    assert!(
        panda.contains("panda_joint4  revolute  -176.0…-4.0°"),
        "{panda}"
    );
    assert!(panda.contains("≤ 716.2°/s²") && panda.contains("hand_tcp"));

    let said = say(&folder, "robots ur6");
    assert_eq!(said.status, Some(2));
    assert!(said.stderr.contains("ur5-paper"), "{said:#?}");
}

#[test]
fn robots_run_on_an_emulator_of_theirs_or_are_sent_to_the_ideal_arm() {
    let folder = empty_folder("robots run");
    let text = fs::read_to_string(paper("example2")).unwrap();
    let run = |model: &str, q0: &str, robot: &str| {
        let start = text.lines().find(|line| line.starts_with("q0_")).unwrap();
        let text = text.replace(start, q0);
        fs::write(folder.join("arm.toml"), text.replace("ur5-paper", model)).unwrap();
        say(
            &folder,
            &format!("run arm.toml --robot {robot} --fast --duration-s 0.5 --out {model}"),
        )
    };
    let said = run(
        "ur10e",
        "q0_deg = [-48, -158, -108, -90, -85, 0]",
        "emulator",
    );
    assert!(said.stdout.contains("ur10e on emulated UR10e"), "{said:#?}");

    let panda = "q0_deg = [0, -45, 0, -135, 0, 90, 45]";
    let said = run("panda", panda, "emulator");
    assert_eq!(said.status, Some(2));
    assert!(said.stderr.contains("panda has 7") && said.stderr.contains("--robot ideal"));
    let said = run("panda", panda, "ideal");
    assert_ne!(said.status, Some(2), "{said:#?}");
    assert!(said.stdout.contains("panda on ideal arm"), "{said:#?}");
}

#[test]
fn completions_know_the_commands() {
    let folder = empty_folder("completions");
    for shell in ["bash", "zsh", "fish"] {
        let script = done(&folder, &format!("completions {shell}"));
        assert!(
            ["mode-rule", "emulate", "robots"]
                .iter()
                .all(|word| script.contains(word)),
            "{shell}"
        );
    }
}

#[test]
fn help_is_an_answer_and_its_absence_bad_usage() {
    let folder = empty_folder("help");
    for command in [
        "run",
        "check",
        "plot",
        "emulate",
        "init",
        "robots",
        "schema",
        "completions",
    ] {
        assert!(done(&folder, &format!("{command} --help")).contains("Usage: conik"));
    }
    assert!(done(&folder, "--version").starts_with("conik "));
    for line in [
        "",
        "rnu",
        "run",
        "run a b",
        "run a --rate-hz fast",
        "run a --robot=",
    ] {
        let said = say(&folder, line);
        assert_eq!(said.status, Some(2), "conik {line}");
        assert!(
            said.stderr.contains("--help") && said.stdout.is_empty(),
            "{said:#?}"
        );
    }
}
