//! Hands the page and its data to browsers on this computer, and nothing else to anybody.
//!
//! One thread serves all connections. What it hands out is in memory before it listens: no request
//! names a file. A request must name this server as its host, so that a name that was bent to
//! 127.0.0.1 (DNS rebinding) reaches nothing, and other sites' pages are refused.

use std::convert::Infallible;
use std::io;
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use http_body_util::Full;
use hyper::body::{Bytes, Incoming};
use hyper::header::{self, HeaderName, HeaderValue};
use hyper::http::uri::Authority;
use hyper::service::service_fn;
use hyper::{HeaderMap, Method, Request, Response, StatusCode};
use hyper_util::rt::{TokioIo, TokioTimer};
use tokio::sync::Semaphore;

use super::{PAGE, Recording};

/// Bytes of the largest request head. A browser's is a few hundred.
const LARGEST_HEAD: usize = 16 * 1024;
/// For how long a head may be on its way, and a connection idle.
const HEAD_WITHIN: Duration = Duration::from_secs(10);
/// For how long a connection lives: a client that reads no further has its place taken back.
const LONGEST_CONNECTION: Duration = Duration::from_secs(120);
/// Connections at a time; a browser keeps about six.
const MOST_CONNECTIONS: usize = 64;
/// Between two looks at whether to stop.
const LOOK_EVERY: Duration = Duration::from_millis(100);

/// Sent with everything. The page's own file says what it may load.
const HEADERS: [(HeaderName, &str); 6] = [
    (header::CACHE_CONTROL, "no-store"),
    (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
    (header::X_FRAME_OPTIONS, "DENY"),
    (header::REFERRER_POLICY, "no-referrer"),
    (
        HeaderName::from_static("cross-origin-resource-policy"),
        "same-origin",
    ),
    (
        HeaderName::from_static("cross-origin-opener-policy"),
        "same-origin",
    ),
];

/// A server that listens and does not answer yet.
#[derive(Debug)]
pub struct Server {
    listener: TcpListener,
    address: SocketAddr,
    site: Arc<Site>,
}

/// All that is handed out, and the names under which.
#[derive(Debug)]
struct Site {
    hosts: Vec<String>,
    recording: Bytes,
}

impl Server {
    /// Listens on this port of 127.0.0.1, on any free one if it is 0, with the runs of a recording.
    pub fn bind(port: u16, recording: &Recording) -> io::Result<Self> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))?;
        let address = listener.local_addr()?;
        let site = Site {
            hosts: hosts(address.port()),
            recording: recording.to_json().into(),
        };
        Ok(Self {
            listener,
            address,
            site: Arc::new(site),
        })
    }

    /// Where the page is.
    pub fn url(&self) -> String {
        format!("http://{}/", self.address)
    }

    /// Answers until `stop` is set.
    pub fn serve(self, stop: &AtomicBool) -> io::Result<()> {
        self.listener.set_nonblocking(true)?;
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_io()
            .enable_time()
            .build()?;
        runtime.block_on(async {
            let listener = tokio::net::TcpListener::from_std(self.listener)?;
            let places = Arc::new(Semaphore::new(MOST_CONNECTIONS));
            while !stop.load(Ordering::Relaxed) {
                match tokio::time::timeout(LOOK_EVERY, listener.accept()).await {
                    Ok(Ok((stream, _))) => {
                        // Whoever finds no place is let go at once.
                        if let Ok(place) = Arc::clone(&places).try_acquire_owned() {
                            let answered = answer(stream, Arc::clone(&self.site));
                            tokio::spawn(async move {
                                answered.await;
                                drop(place);
                            });
                        }
                    }
                    // A client that was gone before it was greeted, or no files left: not for long.
                    Ok(Err(_)) => tokio::time::sleep(LOOK_EVERY).await,
                    Err(_) => {}
                }
            }
            Ok(())
        })
    }
}

async fn answer(stream: tokio::net::TcpStream, site: Arc<Site>) {
    let service = service_fn(move |request: Request<Incoming>| {
        let response = site.respond(&request);
        async { Ok::<_, Infallible>(response) }
    });
    let connection = hyper::server::conn::http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(HEAD_WITHIN)
        .max_buf_size(LARGEST_HEAD)
        .serve_connection(TokioIo::new(stream), service);
    // However it ends, nobody is left who could be told.
    let _ = tokio::time::timeout(LONGEST_CONNECTION, connection).await;
}

/// The names of this server in `Host`.
fn hosts(port: u16) -> Vec<String> {
    let names = ["127.0.0.1", "localhost", "[::1]"];
    let with_port = names.iter().map(|name| format!("{name}:{port}"));
    // Browsers leave out the port of the protocol.
    let without = names.iter().map(|&name| name.to_owned());
    let without = without.filter(|_| port == 80);
    with_port.chain(without).collect()
}

impl Site {
    fn respond(&self, request: &Request<Incoming>) -> Response<Full<Bytes>> {
        if let Err((status, text)) = self.admit(request) {
            return plain(status, text);
        }
        if ![Method::GET, Method::HEAD].contains(request.method()) {
            let mut refused = plain(
                StatusCode::METHOD_NOT_ALLOWED,
                "there is nothing to change\n",
            );
            let allowed = HeaderValue::from_static("GET, HEAD");
            refused.headers_mut().insert(header::ALLOW, allowed);
            return refused;
        }
        match request.uri().path() {
            "/" => response(StatusCode::OK, "text/html; charset=utf-8", PAGE.into()),
            "/recording.json" => {
                let recording = self.recording.clone();
                response(StatusCode::OK, "application/json", recording)
            }
            _ => plain(StatusCode::NOT_FOUND, "there is no such page\n"),
        }
    }

    /// Whether the request is meant for this server, and comes from its own page if from any.
    fn admit(&self, request: &Request<Incoming>) -> Result<(), Refusal> {
        let headers = request.headers();
        let is_ours = |host: &str| {
            self.hosts
                .iter()
                .any(|ours| ours.eq_ignore_ascii_case(host))
        };
        let target = request.uri().authority().map(Authority::as_str);
        if !only(headers, &header::HOST)?.is_some_and(is_ours) || !target.is_none_or(is_ours) {
            let text = "this server answers to 127.0.0.1 and localhost, with its port\n";
            return Err((StatusCode::FORBIDDEN, text));
        }
        let is_own_page = |origin: &str| origin.strip_prefix("http://").is_some_and(is_ours);
        let is_own = only(headers, &header::ORIGIN)?.is_none_or(is_own_page);
        // What browsers say of requests that have no origin, pictures and scripts for instance.
        let site = only(headers, &HeaderName::from_static("sec-fetch-site"))?;
        let is_near = site.is_none_or(|site| ["same-origin", "none"].contains(&site));
        // A link from elsewhere may lead to the page, which shows nothing to whoever set it.
        let is_page = request.uri().path() == "/" && request.method() == Method::GET;
        if is_own && (is_near || is_page) {
            Ok(())
        } else {
            Err((StatusCode::FORBIDDEN, "other sites are not answered\n"))
        }
    }
}

/// Why a request is not answered.
type Refusal = (StatusCode, &'static str);

/// The value of a header that may be there once, if it is there.
fn only<'a>(headers: &'a HeaderMap, name: &HeaderName) -> Result<Option<&'a str>, Refusal> {
    let refused = (
        StatusCode::BAD_REQUEST,
        "a header is there twice, or is no text\n",
    );
    let mut values = headers.get_all(name).iter();
    match (values.next(), values.next()) {
        (None, _) => Ok(None),
        (Some(value), None) => value.to_str().map(Some).map_err(|_| refused),
        (Some(_), Some(_)) => Err(refused),
    }
}

fn plain(status: StatusCode, text: &'static str) -> Response<Full<Bytes>> {
    response(status, "text/plain; charset=utf-8", text.into())
}

fn response(status: StatusCode, kind: &'static str, body: Bytes) -> Response<Full<Bytes>> {
    let mut response = Response::new(Full::new(body));
    *response.status_mut() = status;
    let headers = response.headers_mut();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(kind));
    for (name, value) in HEADERS {
        headers.insert(name, HeaderValue::from_static(value));
    }
    response
}
