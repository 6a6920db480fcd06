//! A run that is watched: what clients of `/live` are told, what they can do, and what they cannot.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::time::Duration;

use serde_json::{Value, json};
use tungstenite::protocol::Role;
use tungstenite::{Message, WebSocket};

use super::process::{
    Running, conik, done, empty_folder, paper, patient, repository, say, wait_for,
};
use super::run_folder::{Rows, summary};

/// Whoever is silent for longer than this will not speak any more. No verdict hangs on less.
const SILENT: Duration = Duration::from_secs(60);

/// A run whose page is served.
struct Watched {
    process: Running,
    /// `ADDRESS:PORT`, and what follows the path.
    host: String,
    query: String,
}

impl Watched {
    fn start(folder: &Path, line: &str) -> Self {
        let mut process = Running::start(folder, line);
        let out = process.child().stdout.take().unwrap();
        let mut line = String::new();
        BufReader::new(out).read_line(&mut line).unwrap();
        let address = line.trim_end().strip_prefix("http://").unwrap_or_else(|| {
            let mut said = String::new();
            let mut pipe = process.child().stderr.take().unwrap();
            pipe.read_to_string(&mut said).unwrap();
            panic!("no address: {line}{said}")
        });
        let (host, query) = address.split_once('/').unwrap();
        Self {
            host: host.to_owned(),
            query: query.to_owned(),
            process,
        }
    }

    /// A scenario that runs as long as it is watched.
    fn scenario(name: &str, scenario: &Path) -> Self {
        let folder = empty_folder(&format!("live-{name}"));
        Self::start(&folder, &format!("view --quiet {}", scenario.display()))
    }

    fn handshake(&self, headers: &[&str]) -> (TcpStream, String) {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        stream.set_read_timeout(Some(SILENT)).unwrap();
        let head = format!(
            "GET /live{} HTTP/1.1\r\n{}\r\n\r\n",
            self.query,
            headers.join("\r\n")
        );
        stream.write_all(head.as_bytes()).unwrap();
        let mut answer = Vec::new();
        let mut byte = [0];
        while !answer.ends_with(b"\r\n\r\n") && stream.read(&mut byte).unwrap() == 1 {
            answer.push(byte[0]);
        }
        (stream, String::from_utf8(answer).unwrap())
    }

    fn headers(&self) -> Vec<String> {
        [
            &format!("Host: {}", self.host),
            "Connection: keep-alive, Upgrade",
            "Upgrade: websocket",
            "Sec-WebSocket-Version: 13",
            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
        ]
        .map(str::to_owned)
        .to_vec()
    }

    fn client(&self) -> Client {
        let headers = self.headers();
        let headers: Vec<&str> = headers.iter().map(String::as_str).collect();
        let (stream, answer) = self.handshake(&headers);
        assert!(answer.starts_with("HTTP/1.1 101"), "{answer}");
        // The key and its answer are those of RFC 6455, section 1.3.
        assert!(answer.contains("s3pPLMBiTxaQ9kYGzzhZRbK+xOo="), "{answer}");
        Client {
            socket: WebSocket::from_raw_socket(stream, Role::Client, None),
            id: 0,
            scene: Value::Null,
        }
    }
}

/// A program that watches.
struct Client {
    socket: WebSocket<TcpStream>,
    id: u64,
    /// The last one.
    scene: Value,
}

impl Client {
    fn next(&mut self) -> Value {
        loop {
            match self.socket.read().unwrap() {
                Message::Text(text) => {
                    let message: Value = serde_json::from_str(&text).unwrap();
                    if message["kind"] == "scene" {
                        self.scene = message.clone();
                    }
                    return message;
                }
                Message::Close(why) => panic!("closed: {why:?}"),
                _ => {}
            }
        }
    }

    /// The next message that is what is looked for.
    fn wait(&mut self, is_it: impl Fn(&Value) -> bool) -> Value {
        loop {
            let message = self.next();
            if is_it(&message) {
                return message;
            }
        }
    }

    fn of_kind(&mut self, kind: &str) -> Value {
        self.wait(|message| message["kind"] == kind)
    }

    fn send(&mut self, mut message: Value) -> u64 {
        self.id += 1;
        message["id"] = json!(self.id);
        self.socket
            .send(Message::text(message.to_string()))
            .unwrap();
        self.id
    }

    /// Asks, and waits for the answer.
    fn ask(&mut self, message: Value) -> Value {
        let id = self.send(message);
        self.wait(|answer| answer["id"] == json!(id as f64))
    }

    #[track_caller]
    fn done(&mut self, message: Value) -> u64 {
        let answer = self.ask(message);
        assert_eq!(answer["error"], Value::Null, "{answer}");
        answer["revision"].as_u64().unwrap()
    }

    #[track_caller]
    fn refused(&mut self, message: Value) -> String {
        let answer = self.ask(message);
        answer["error"]
            .as_str()
            .unwrap_or_else(|| panic!("{answer}"))
            .to_owned()
    }

    /// All rows of a column until the next state in which this holds.
    fn column_until(&mut self, column: &str, is_it: impl Fn(&Value) -> bool) -> Vec<f64> {
        let mut rows = Vec::new();
        loop {
            let message = self.next();
            if message["kind"] == "ticks" {
                if message["reset"] == true {
                    rows.clear();
                }
                let values = if column == "t_s" {
                    &message["t_s"]
                } else {
                    &message["columns"][column]
                };
                rows.extend(values.as_array().unwrap().iter().filter_map(Value::as_f64));
            } else if message["kind"] == "state" && is_it(&message) {
                return rows;
            }
        }
    }
}

#[test]
fn whoever_connects_is_told_everything_and_then_what_is_new() {
    let watched = Watched::scenario("greeting", &paper("example2"));
    let mut client = watched.client();
    let hello = client.next();
    assert_eq!(
        (&hello["kind"], &hello["protocol"]),
        (&json!("hello"), &json!(1))
    );
    let scene = client.next();
    assert_eq!(scene["kind"], "scene");
    assert_eq!(
        (&scene["live"], &scene["editable"]),
        (&json!(true), &json!(true))
    );
    assert_eq!(
        (&scene["name"], &scene["revision"]),
        (&json!("example2"), &json!(0))
    );
    assert_eq!(scene["robot"]["name"], "ur5-paper");
    let first = client.next();
    assert_eq!(
        (&first["kind"], &first["reset"]),
        (&json!("ticks"), &json!(true))
    );
    let state = client.next();
    assert_eq!(state["kind"], "state");
    assert_eq!(state["allowed"].as_array().unwrap().len(), 5);
    let more = client.wait(|it| it["kind"] == "ticks" && it["reset"] == false);
    let rows = more["t_s"].as_array().unwrap().len();
    for column in [
        "q1_rad",
        "qd6_rad_s",
        "tool_z_m",
        "position_error",
        "view",
        "waypoint",
    ] {
        assert_eq!(
            more["columns"][column].as_array().unwrap().len(),
            rows,
            "{column}"
        );
    }
    // One who comes later gets what has been.
    let mut late = watched.client();
    let all = late.of_kind("ticks");
    assert_eq!(all["t_s"][0], json!(0.0));
    let mut late_rows = late.wait(|it| it["kind"] == "ticks")["t_s"][0]
        .as_f64()
        .unwrap();
    late_rows -= all["t_s"]
        .as_array()
        .unwrap()
        .last()
        .unwrap()
        .as_f64()
        .unwrap();
    assert!(
        (late_rows - 0.008).abs() < 1e-9,
        "nothing is missing, nothing twice"
    );
}

#[test]
fn paused_run_steps_and_goes_on() {
    let watched = Watched::scenario("pause", &paper("example2"));
    let mut client = watched.client();
    client.of_kind("ticks");
    client.done(json!({"kind": "pause"}));
    client.wait(|it| it["kind"] == "state" && it["running"] == "paused");
    // Whatever was on its way has come when a later state says the same time twice.
    let at = |state: &Value| state["t_s"].as_f64().unwrap();
    let mut last = at(&client.of_kind("state"));
    let resting = loop {
        let now = at(&client.of_kind("state"));
        if now == last {
            break now;
        }
        last = now;
    };
    client.done(json!({"kind": "step", "ticks": 5}));
    let wanted = resting + 5.0 * 0.008;
    let there = client.wait(|it| it["kind"] == "state" && at(it) > wanted - 1e-9);
    assert!((at(&there) - wanted).abs() < 1e-9);
    assert!(
        (at(&client.of_kind("state")) - wanted).abs() < 1e-9,
        "and no further"
    );
    client.done(json!({"kind": "speed", "factor": 10}));
    client.done(json!({"kind": "resume"}));
    client.wait(|it| it["kind"] == "state" && at(it) > wanted + 0.5 && it["speed"] == 10.0);
    client.done(json!({"kind": "restart"}));
    let anew = client.wait(|it| it["kind"] == "ticks" && it["reset"] == true);
    assert!(
        anew["t_s"]
            .as_array()
            .unwrap()
            .first()
            .is_none_or(|t_s| *t_s == 0.0)
    );
    client.wait(|it| it["kind"] == "state" && it["running"] == "running" && at(it) > 0.1);
}

#[test]
fn changed_bound_is_kept_saved_and_taken_back() {
    let watched = Watched::scenario("change", &paper("example1"));
    let mut client = watched.client();
    client.done(json!({"kind": "speed", "factor": 10}));
    let changes = json!([
        {"control": "mode_rule", "value": "cone"},
        {"control": "border", "value": "land"},
        {"task": "obstacle_a", "key": "min", "value": 0.25, "speed": 0.05},
    ]);
    let revision = client.done(json!({"kind": "change", "changes": changes}));
    let at = |it: &Value| it["revision"].as_u64() >= Some(revision);
    client.column_until("t_s", |state| {
        at(state) && state["t_s"].as_f64() > Some(25.0)
    });
    let distances = client.column_until("obstacle_a", |state| state["t_s"].as_f64() > Some(40.0));
    assert!(distances.len() > 100);
    let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(
        (0.25 - 1e-7..0.252).contains(&least),
        "held where it now is: {least}"
    );
    let saved = client.ask(json!({"kind": "save"}));
    assert_eq!(
        (&saved["kind"], &saved["name"]),
        (&json!("text"), &json!("example1-edited.toml"))
    );
    let folder = empty_folder("live-saved");
    fs::write(folder.join("saved.toml"), saved["toml"].as_str().unwrap()).unwrap();
    let checked = done(&folder, "check saved.toml");
    assert!(checked.contains("0.25"), "{checked}");
    client.done(json!({"kind": "reset"}));
    let scene = &client.scene;
    assert_eq!(scene["robot"], Value::Null, "it is known");
    assert_eq!(scene["settings"]["mode_rule"], "paper");
    let state = client.wait(|it| it["kind"] == "state" && it["revision"].as_u64() > Some(revision));
    assert_eq!(state["edited"], false);
}

#[test]
fn dragged_obstacle_is_told_of_where_it_is_and_where_it_goes() {
    let shelf = repository().join("scenarios/gallery/shelf.toml");
    let watched = Watched::scenario("drag", &shelf);
    let mut client = watched.client();
    let scene = client.of_kind("scene");
    let obstacles = scene["obstacles"].as_array().unwrap();
    let post = obstacles.iter().find(|it| it["name"] == "post").unwrap();
    let key = ["center_m", "from_m"]
        .into_iter()
        .find(|key| post[*key].is_array())
        .unwrap();
    let mut changes = Vec::new();
    for key in ["center_m", "from_m", "to_m"] {
        if let Some(place) = post[key].as_array() {
            let x = place[0].as_f64().unwrap() + 0.01;
            let moved = json!([x, place[1], place[2]]);
            changes.push(json!({"obstacle": "post", "key": key, "value": moved, "speed": 0.05}));
        }
    }
    client.done(json!({"kind": "change", "changes": changes}));
    let moved = client.scene["obstacles"].as_array().unwrap();
    let moved = moved.iter().find(|it| it["name"] == "post").unwrap();
    let x = |it: &Value| it[key][0].as_f64().unwrap();
    assert!((x(moved) - x(post) - 0.01).abs() < 1e-12);
    let gliding = client.wait(|it| it["gliding"].as_array().is_some_and(|it| !it.is_empty()));
    let gliding = gliding["gliding"].as_array().unwrap();
    assert_eq!(gliding.len(), 1, "once for all of its pairs: {gliding:?}");
    assert_eq!(gliding[0]["name"], "post");
    assert!(gliding[0]["away_m"][0].as_f64().unwrap() < 0.0);
    client.wait(|it| it["kind"] == "ticks" && it["gliding"] == json!([]));
}

#[test]
fn what_makes_no_sense_is_answered_with_a_sentence() {
    let watched = Watched::scenario("sense", &paper("example2"));
    let mut client = watched.client();
    for (message, says) in [
        (json!({"kind": "fly"}), "unknown variant `fly`"),
        (json!({"kind": "step", "ticks": 0}), "1 to 1000"),
        (json!({"kind": "step", "ticks": 100_000}), "1 to 1000"),
        (json!({"kind": "speed", "factor": 100}), "0.05 to 10"),
        (json!({"kind": "speed"}), "missing field `factor`"),
        (
            json!({"kind": "change", "changes": [{"tusk": 1}]}),
            "not a message",
        ),
        (
            json!({"kind": "change", "changes": [{"task": "view", "key": "max", "value": -1}]}),
            "max",
        ),
        (
            json!({"kind": "change", "changes": [
                {"task": "view", "key": "max", "value": 0.1},
                {"task": "nobody", "key": "max", "value": 0.1},
            ]}),
            "no task `nobody`",
        ),
    ] {
        let said = client.refused(message.clone());
        assert!(said.contains(says), "{message}: {said}");
    }
    client.socket.send(Message::text("[1, 2")).unwrap();
    let answer = client.of_kind("answer");
    assert!(answer["error"].as_str().unwrap().contains("not a message"));
    let state = client.of_kind("state");
    assert_eq!(
        (&state["revision"], &state["edited"]),
        (&json!(0), &json!(false))
    );
}

/// What comes until the connection is closed, and how it is.
fn ends(mut client: Client) -> String {
    loop {
        match client.socket.read() {
            Ok(Message::Close(why)) => return format!("{why:?}"),
            Ok(_) => {}
            Err(error) => return error.to_string(),
        }
    }
}

#[test]
fn clients_that_misbehave_are_cut_off_and_others_are_not() {
    let watched = Watched::scenario("misbehave", &paper("example2"));
    let mut polite = watched.client();
    let mut binary = watched.client();
    binary.socket.send(Message::binary(vec![1, 2, 3])).unwrap();
    assert!(ends(binary).contains("messages are text"));
    let mut long = watched.client();
    let text = format!("{{\"kind\": \"{}\"}}", "a".repeat(70_000));
    // The rest of it may find nobody.
    let _ = long.socket.send(Message::text(text));
    ends(long);
    let mut flood = watched.client();
    for _ in 0..400 {
        flood.send(json!({"kind": "save"}));
    }
    polite.done(json!({"kind": "pause"}));
    // Its messages wait, for longer than it takes to be cut off for not reading.
    drop(flood);
    polite.done(json!({"kind": "resume"}));
}

#[test]
fn handshakes_of_other_sites_and_of_no_websocket_are_refused() {
    let watched = Watched::scenario("handshake", &paper("example2"));
    let good = watched.headers();
    let with = |extra: &str| {
        let mut headers: Vec<&str> = good.iter().map(String::as_str).collect();
        headers.push(extra);
        watched.handshake(&headers).1
    };
    let own = format!("Origin: http://{}", watched.host);
    assert!(with(&own).starts_with("HTTP/1.1 101"), "its own page");
    assert!(with("Origin: http://evil.example").starts_with("HTTP/1.1 403"));
    assert!(with("Origin: null").starts_with("HTTP/1.1 403"));
    assert!(with("Sec-Fetch-Site: cross-site").starts_with("HTTP/1.1 403"));
    let without = |missing: &str| {
        let headers = good.iter().map(String::as_str);
        let headers: Vec<&str> = headers.filter(|it| !it.starts_with(missing)).collect();
        watched.handshake(&headers).1
    };
    for missing in [
        "Upgrade",
        "Connection",
        "Sec-WebSocket-Key",
        "Sec-WebSocket-Version",
    ] {
        assert!(without(missing).starts_with("HTTP/1.1 426"), "{missing}");
    }
    assert!(without("Host").starts_with("HTTP/1.1 40"));
}

#[test]
fn watched_run_writes_what_was_changed_and_stays_until_it_is_interrupted() {
    let folder = empty_folder("live-run");
    let line = format!(
        "run {} --robot ideal --view --quiet --duration-s 3 --mode-rule cone --border land --out out",
        paper("example2").display()
    );
    let watched = Watched::start(&folder, &line);
    let mut client = watched.client();
    client.done(json!({"kind": "pause"}));
    let changes = json!([{"task": "position", "key": "gain_per_s", "value": 0.6}]);
    client.done(json!({"kind": "change", "changes": changes}));
    client.done(json!({"kind": "resume"}));
    let ended = client.wait(|it| it["kind"] == "state" && it["running"] == "ended");
    assert_eq!(ended["outcome"]["kind"], "completed");
    assert_eq!(ended["allowed"], json!([]));
    let told = wait_for("the summary", || {
        let told = summary(&folder.join("out"));
        (told["outcome"]["kind"] == "completed").then_some(told)
    });
    assert_eq!(told["changes"][0]["changes"], changes);
    assert!(told["changes"][0]["t_s"].as_f64().unwrap() >= 0.0);
    assert_eq!(told["settings"]["scenario"]["task"][3]["gain_per_s"], 0.3);
    assert_eq!(Rows::of(&folder.join("out")).rows.len(), 376);
    assert!(
        watched.client().of_kind("ticks")["t_s"]
            .as_array()
            .unwrap()
            .len()
            == 376
    );
    watched.process.signal("INT");
    assert_eq!(watched.process.wait().status, Some(0));
}

#[test]
fn run_that_is_begun_anew_leaves_the_log_of_its_last_time() {
    let folder = empty_folder("live-restart");
    let example = patient(&folder);
    let line = format!(
        "run {} --view --quiet --duration-s 2 --out out",
        example.display()
    );
    let watched = Watched::start(&folder, &line);
    let mut client = watched.client();
    client.wait(|it| it["kind"] == "state" && it["t_s"].as_f64() > Some(0.5));
    client.done(json!({"kind": "restart"}));
    client.wait(|it| it["kind"] == "ticks" && it["reset"] == true);
    let ended = client.wait(|it| it["kind"] == "state" && it["running"] == "ended");
    assert_eq!(ended["outcome"]["kind"], "completed", "{ended}");
    wait_for("the summary", || {
        (summary(&folder.join("out"))["outcome"]["kind"] == "completed").then_some(())
    });
    let rows = Rows::of(&folder.join("out")).rows;
    assert_eq!(rows.len(), 251);
    watched.process.signal("INT");
    assert_eq!(watched.process.wait().status, Some(0));
}

#[test]
fn hundred_clients_of_which_half_never_read_change_nothing_in_the_run() {
    let folder = empty_folder("live-hundred");
    let line = format!(
        "run {} --robot ideal --view --quiet --duration-s 4 --out out",
        paper("example2").display()
    );
    let watched = Watched::start(&folder, &line);
    let stalled: Vec<Client> = (0..50).map(|_| watched.client()).collect();
    let mut reading: Vec<Client> = (0..50).map(|_| watched.client()).collect();
    for client in &mut reading {
        client.wait(|it| it["kind"] == "state" && it["running"] == "ended");
    }
    let viewers = reading[0].of_kind("state")["viewers"].as_u64().unwrap();
    assert!(viewers >= 50, "{viewers}");
    wait_for("the summary", || {
        (summary(&folder.join("out"))["outcome"]["kind"] == "completed").then_some(())
    });
    drop(stalled);
    // The references are those of a run that nobody watches.
    done(
        &folder,
        &format!(
            "run {} --robot ideal --quiet --duration-s 4 --out alone",
            paper("example2").display()
        ),
    );
    let log = |name: &str| fs::read_to_string(folder.join(name).join("log.csv")).unwrap();
    assert!(log("out") == log("alone"));
}

#[test]
fn arm_outside_is_only_looked_at_unless_it_may_be_changed() {
    let folder = empty_folder("live-outside");
    let example = patient(&folder);
    let (_emulator, offset) = super::network::emulator(&folder);
    let line = |more: &str| {
        format!(
            "run {} --robot 127.0.0.1 --port-offset {offset} --from-here --duration-s 3 --view \
             --quiet --out out {more}",
            example.display()
        )
    };
    let watched = Watched::start(&folder, &line(""));
    let mut client = watched.client();
    assert_eq!(client.of_kind("scene")["editable"], false);
    let state = client.of_kind("state");
    assert_eq!(state["allowed"], json!([]));
    assert!(state["refusal"].as_str().unwrap().contains("--allow-edit"));
    for message in [
        json!({"kind": "pause"}),
        json!({"kind": "restart"}),
        json!({"kind": "reset"}),
        json!({"kind": "change", "changes": []}),
    ] {
        assert!(client.refused(message).contains("--allow-edit"));
    }
    client.wait(|it| it["kind"] == "state" && it["running"] == "ended");
    watched.process.signal("INT");
    assert_eq!(watched.process.wait().status, Some(0));

    let watched = Watched::start(&folder, &line("--allow-edit"));
    let mut client = watched.client();
    client.done(json!({"kind": "pause"}));
    assert!(
        client
            .refused(json!({"kind": "step", "ticks": 1}))
            .contains("simulated")
    );
    assert!(
        client
            .refused(json!({"kind": "restart"}))
            .contains("simulated")
    );
    let changes = json!([{"task": "position", "key": "gain_per_s", "value": 0.1}]);
    client.done(json!({"kind": "change", "changes": changes}));
    client.done(json!({"kind": "resume"}));
    let ended = client.wait(|it| it["kind"] == "state" && it["running"] == "ended");
    assert_eq!(ended["outcome"]["kind"], "completed", "{ended}");
}

#[test]
fn other_addresses_need_the_token() {
    let folder = empty_folder("live-token");
    let line = format!(
        "view --quiet --listen 0.0.0.0 {}",
        paper("example2").display()
    );
    let watched = Watched::start(&folder, &line);
    let (host, port) = watched.host.split_once(':').unwrap();
    assert_eq!(host, "0.0.0.0");
    let token = watched.query.strip_prefix("?token=").unwrap();
    assert_eq!(token.len(), 32);
    let status = |path: &str, more: &str| {
        let mut stream = TcpStream::connect(("127.0.0.1", port.parse().unwrap())).unwrap();
        let head = format!(
            "GET {path} HTTP/1.1\r\nHost: robot.example:{port}\r\n{more}Connection: close\r\n\r\n"
        );
        stream.write_all(head.as_bytes()).unwrap();
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).unwrap();
        String::from_utf8_lossy(&answer[9..12]).into_owned()
    };
    assert_eq!(status("/", ""), "403");
    assert_eq!(status("/recording.json?token=0", ""), "403");
    assert_eq!(
        status(&format!("/?token={}", token.to_uppercase()), ""),
        "403"
    );
    assert_eq!(status(&format!("/recording.json?token={token}"), ""), "200");
    let own = format!("Origin: http://robot.example:{port}\r\n");
    assert_eq!(
        status(&format!("/recording.json?token={token}"), &own),
        "200"
    );
    let other = "Origin: http://evil.example\r\n";
    assert_eq!(
        status(&format!("/recording.json?token={token}"), other),
        "403"
    );
    watched.client().of_kind("hello");
}

#[test]
fn options_that_do_not_go_together_say_so() {
    let folder = empty_folder("live-options");
    let example = paper("example2");
    let example = example.display();
    for (line, says) in [
        (format!("run {example} --view --fast"), "--fast"),
        (format!("run {example} --listen 0.0.0.0"), "--view"),
        (format!("run {example} --allow-edit"), "--view"),
        (
            format!("run {example} --view --allow-edit"),
            "for --robot HOST",
        ),
        (format!("view {example} {example}"), "only folders"),
        ("view nowhere.toml".to_owned(), "cannot be read"),
        (format!("view {example} --border fly"), "there is no `fly`"),
    ] {
        let said = say(&folder, &line);
        assert_eq!(said.status, Some(2), "{line}: {said:#?}");
        assert!(said.stderr.contains(says), "{line}: {}", said.stderr);
    }
    let bad = folder.join("bad.toml");
    fs::write(&bad, "nonsense = 1").unwrap();
    let said = super::process::ended(conik(["view"]).arg(&bad));
    assert_eq!(said.status, Some(2));
}
