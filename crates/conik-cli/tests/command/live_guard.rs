//! A run that is watched: what nobody can do to it.

use std::fs;
use std::io::{Read, Write};
use std::net::TcpStream;

use serde_json::json;
use tungstenite::Message;

use super::process::{conik, done, empty_folder, paper, patient, say, wait_for};
use super::run_folder::summary;
use super::watched::{Client, Watched};

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
