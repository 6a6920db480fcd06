//! `conik view`: what it serves to a browser, and what it refuses to everybody else.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use serde_json::Value;

use super::process::{Running, conik, done, empty_folder, ended, paper};

/// A folder of a short run, made once for all tests.
static RUN: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = empty_folder("view");
    let scenario = paper("example2");
    let line = format!(
        "run {} --robot ideal --duration-s 2 --quiet --out short",
        scenario.display()
    );
    done(&folder, &line);
    folder.join("short")
});

/// A page that is served.
struct Page {
    process: Running,
    /// `127.0.0.1:` and its port.
    host: String,
}

impl Page {
    fn of(dirs: &[&Path]) -> Self {
        let mut command = conik(["view"]);
        let mut process = Running::of(command.args(dirs));
        let out = process.child().stdout.take().unwrap();
        let mut line = String::new();
        BufReader::new(out).read_line(&mut line).unwrap();
        let host = line.strip_prefix("http://").unwrap();
        let host = host.strip_suffix("/\n").unwrap().to_owned();
        Self { process, host }
    }

    fn short() -> Self {
        Self::of(&[&RUN])
    }

    fn connect(&self) -> TcpStream {
        TcpStream::connect(&self.host).unwrap()
    }

    /// What is answered to these lines, until the server or the request closes the connection.
    fn ask(&self, lines: &[&str]) -> Answer {
        let mut stream = self.connect();
        let text = format!("{}\r\nConnection: close\r\n\r\n", lines.join("\r\n"));
        // Of what is refused at once not all may be taken.
        let _ = stream.write_all(text.as_bytes());
        Answer::read(stream)
    }

    fn get(&self, path: &str) -> Answer {
        self.ask(&[
            &format!("GET {path} HTTP/1.1"),
            &format!("Host: {}", self.host),
        ])
    }
}

struct Answer {
    head: String,
    body: Vec<u8>,
}

impl Answer {
    fn read(mut stream: TcpStream) -> Self {
        let mut bytes = Vec::new();
        // A connection that is reset has said what it had to say.
        let _ = stream.read_to_end(&mut bytes);
        let end = bytes.windows(4).position(|four| four == b"\r\n\r\n");
        let (head, body) = bytes.split_at(end.map_or(bytes.len(), |end| end + 4));
        Self {
            head: String::from_utf8(head.to_vec()).unwrap(),
            body: body.to_vec(),
        }
    }

    /// 0 where nothing was answered.
    fn status(&self) -> u16 {
        let status = self.head.split(' ').nth(1);
        status.map_or(0, |status| status.parse().unwrap())
    }

    fn text(&self) -> String {
        String::from_utf8(self.body.clone()).unwrap()
    }
}

#[test]
fn page_and_its_run_are_served() {
    let page = Page::short();
    let answer = page.get("/");
    assert_eq!(answer.status(), 200, "{}", answer.head);
    assert!(
        answer
            .head
            .contains("content-type: text/html; charset=utf-8")
    );
    assert!(answer.head.contains("x-content-type-options: nosniff"));
    assert!(answer.text().starts_with("<!doctype html>"));
    let answer = page.get("/recording.json");
    assert_eq!(answer.status(), 200);
    let recording: Value = serde_json::from_slice(&answer.body).unwrap();
    assert_eq!(recording["protocol"], 1);
    assert_eq!(recording["runs"][0]["name"], "short");
    assert_eq!(recording["runs"][0]["scene"]["robot"]["name"], "ur5-paper");
    let ticks = &recording["runs"][0]["ticks"];
    assert_eq!(ticks["t_s"].as_array().unwrap().len(), 251);
    assert_eq!(ticks["columns"]["q6_rad"].as_array().unwrap().len(), 251);
}

#[test]
fn two_runs_are_served_together() {
    let page = Page::of(&[&RUN, &RUN]);
    let recording: Value = serde_json::from_slice(&page.get("/recording.json").body).unwrap();
    assert_eq!(recording["runs"].as_array().unwrap().len(), 2);
}

#[test]
fn interrupt_ends_it_well() {
    let page = Page::short();
    page.process.signal("INT");
    assert_eq!(page.process.wait().status, Some(0));
}

#[test]
fn other_names_of_this_computer_are_refused() {
    let page = Page::short();
    let port = page.host.rsplit(':').next().unwrap();
    let status = |host: &str| page.ask(&["GET /recording.json HTTP/1.1", host]).status();
    for good in ["127.0.0.1", "localhost", "LOCALHOST", "[::1]"] {
        assert_eq!(status(&format!("Host: {good}:{port}")), 200, "{good}");
    }
    for bad in [
        format!("Host: evil.example:{port}"),
        format!("Host: evil.example\r\nHost: 127.0.0.1:{port}"),
        format!("Host: 127.0.0.1:{port}.evil.example"),
        "Host: 127.0.0.1:1".to_owned(),
        "Host: 127.0.0.1".to_owned(),
        "Host:".to_owned(),
        "X-Host: 127.0.0.1".to_owned(),
    ] {
        let status = status(&bad);
        assert!(status == 403 || status == 400, "{bad}: {status}");
    }
    let target = format!(
        "GET http://evil.example/recording.json HTTP/1.1\r\nHost: {}",
        page.host
    );
    assert_eq!(page.ask(&[&target]).status(), 403);
}

#[test]
fn other_sites_are_refused() {
    let page = Page::short();
    let host = format!("Host: {}", page.host);
    let status = |path: &str, header: &str| {
        let line = format!("GET {path} HTTP/1.1");
        page.ask(&[&line, &host, header]).status()
    };
    let own = format!("Origin: http://{}", page.host);
    assert_eq!(status("/recording.json", &own), 200);
    assert_eq!(
        status("/recording.json", "Sec-Fetch-Site: same-origin"),
        200
    );
    assert_eq!(
        status("/", "Sec-Fetch-Site: cross-site"),
        200,
        "a link to it"
    );
    for bad in [
        "Origin: http://evil.example",
        "Origin: null",
        "Origin: http://127.0.0.1:1",
        "Sec-Fetch-Site: cross-site",
        "Sec-Fetch-Site: same-site",
    ] {
        assert_eq!(status("/recording.json", bad), 403, "{bad}");
    }
    assert_eq!(status("/", "Origin: http://evil.example"), 403);
}

#[test]
fn no_path_leads_to_a_file() {
    let page = Page::short();
    for path in [
        "/../summary.json",
        "/../../../../etc/passwd",
        "/%2e%2e/%2e%2e/etc/passwd",
        "/..%5c..%5cetc",
        "//etc/passwd",
        "/summary.json",
        "/log.csv",
        "/recording.json/",
        "/recording.json/..",
        "/index.html\0",
    ] {
        let status = page.get(path).status();
        assert!(status == 404 || status == 400, "{path}: {status}");
    }
    let line = "POST / HTTP/1.1";
    let answer = page.ask(&[line, &format!("Host: {}", page.host), "Content-Length: 0"]);
    assert_eq!(answer.status(), 405);
    assert!(answer.head.contains("allow: GET, HEAD"));
    let head = page.ask(&["HEAD / HTTP/1.1", &format!("Host: {}", page.host)]);
    assert_eq!((head.status(), head.body.len()), (200, 0));
}

#[test]
fn endless_head_is_cut_off() {
    let page = Page::short();
    let long = format!("X-Long: {}", "a".repeat(1 << 20));
    let status = page.ask(&["GET / HTTP/1.1", &long]).status();
    assert!(status == 431 || status == 0, "{status}");
    let many = vec!["X: y"; 10_000].join("\r\n");
    let status = page.ask(&["GET / HTTP/1.1", &many]).status();
    assert!(status == 431 || status == 0, "{status}");
    assert_eq!(page.get("/").status(), 200, "and others are served on");
}

#[test]
fn noise_is_no_request() {
    let page = Page::short();
    for noise in [
        &b"\0\0\0\0\r\n\r\n"[..],
        b"\x16\x03\x01\x02\x00\x01",
        b"GET\r\n\r\n",
    ] {
        let mut stream = page.connect();
        stream.write_all(noise).unwrap();
        stream.shutdown(Shutdown::Write).unwrap();
        let status = Answer::read(stream).status();
        assert!(status == 400 || status == 0, "{status}");
    }
    assert_eq!(page.get("/").status(), 200);
}

#[test]
fn clients_that_stall_keep_nobody_waiting() {
    let page = Page::short();
    let mut stalled: Vec<TcpStream> = (0..40).map(|_| page.connect()).collect();
    for (nth, stream) in stalled.iter_mut().enumerate() {
        let whole = format!(
            "GET /recording.json HTTP/1.1\r\nHost: {}\r\n\r\n",
            page.host
        );
        // Half of them never end their request, the others never read the answer.
        let text = if nth % 2 == 0 { &whole[..20] } else { &whole };
        stream.write_all(text.as_bytes()).unwrap();
    }
    assert_eq!(page.get("/recording.json").status(), 200);
    drop(stalled);
}

#[test]
fn what_is_no_run_is_refused() {
    let folder = empty_folder("view-refusals");
    fs::write(folder.join("scenario.toml"), "").unwrap();
    fs::create_dir(folder.join("empty")).unwrap();
    for (line, says) in [
        ("view nowhere", "nowhere: cannot be read"),
        ("view empty nowhere", "is this the folder of a run?"),
        ("view empty", "is this the folder of a run?"),
        (
            "view scenario.toml empty",
            "scenario.toml is a file; only folders",
        ),
        ("view empty --border land", "cannot be changed"),
        ("view", "required"),
    ] {
        let said = ended(conik(line.split_whitespace()).current_dir(&folder));
        assert_eq!(said.status, Some(2), "{line}: {said:#?}");
        assert!(said.stderr.contains(says), "{line}: {}", said.stderr);
    }
}

#[test]
fn port_that_is_taken_is_named() {
    let page = Page::short();
    let port = page.host.rsplit(':').next().unwrap();
    let mut command = conik(["view", "--port", port]);
    let said = ended(command.arg(&*RUN));
    assert_eq!(said.status, Some(1));
    assert!(
        said.stderr.contains(&format!("port {port}")),
        "{}",
        said.stderr
    );
}
