//! Hands the page and its data to browsers on this computer, and nothing else to anybody.
//!
//! One thread serves all connections. What it hands out is in memory before it listens: no request
//! names a file. A request must name this server as its host, so that a name that was bent to
//! 127.0.0.1 (DNS rebinding) reaches nothing, and other sites' pages are refused.

use std::convert::Infallible;
use std::io;
use std::net::{IpAddr, Ipv4Addr, SocketAddr, TcpListener};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use http_body_util::Full;
use hyper::body::{Bytes, Incoming};
use hyper::header::{self, HeaderName, HeaderValue};
use hyper::service::service_fn;
use hyper::{Method, Request, Response, StatusCode};
use hyper_util::rt::{TokioIo, TokioTimer};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};

use super::guard::Guard;
use super::live::Live;
use super::upgrade::upgrade;
use super::{PAGE, Recording};

/// Bytes of the largest request head. A browser's is a few hundred.
const LARGEST_HEAD: usize = 16 * 1024;
/// For how long a head may be on its way, and a connection idle.
const HEAD_WITHIN: Duration = Duration::from_secs(10);
/// For how long a connection lives: a client that reads no further has its place taken back.
const LONGEST_CONNECTION: Duration = Duration::from_secs(120);
/// Connections at a time; a browser keeps about six, one of them for as long as it watches.
const MOST_CONNECTIONS: usize = 256;
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

/// Between two bundles of what is new in a run that goes on: 30 a second.
const BUNDLE_EVERY: Duration = Duration::from_millis(33);

/// A server that listens and does not answer yet.
#[derive(Debug)]
pub struct Server {
    listener: TcpListener,
    address: SocketAddr,
    site: Arc<Site>,
}

/// Where to listen, and who may come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The address; only this computer can reach a loopback address.
    pub address: IpAddr,
    /// The port; 0: any free one.
    pub port: u16,
}

impl Place {
    /// A port of 127.0.0.1.
    pub const fn here(port: u16) -> Self {
        Self {
            address: IpAddr::V4(Ipv4Addr::LOCALHOST),
            port,
        }
    }
}

/// All that is handed out, and to whom.
#[derive(Debug)]
struct Site {
    guard: Guard,
    shown: Shown,
}

/// What is shown.
#[derive(Debug)]
enum Shown {
    /// Runs that are over.
    Recording(Bytes),
    /// One that goes on.
    Live(Arc<Live>),
}

impl Server {
    /// Listens there, with the runs of a recording.
    pub fn with_recording(place: Place, recording: &Recording) -> io::Result<Self> {
        Self::bind(place, Shown::Recording(recording.to_json().into()))
    }

    /// Listens there, with a run that goes on.
    pub fn with_live(place: Place, live: Arc<Live>) -> io::Result<Self> {
        Self::bind(place, Shown::Live(live))
    }

    fn bind(place: Place, shown: Shown) -> io::Result<Self> {
        let listener = TcpListener::bind((place.address, place.port))?;
        let address = listener.local_addr()?;
        let guard = if address.ip().is_loopback() {
            Guard::of_loopback(address)
        } else {
            Guard::with_new_token()?
        };
        Ok(Self {
            listener,
            address,
            site: Arc::new(Site { guard, shown }),
        })
    }

    /// Where the page is. Beyond this computer, whoever has it may look, and do what those may who look.
    pub fn url(&self) -> String {
        format!("http://{}/{}", self.address, self.site.guard.query())
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
            if let Shown::Live(live) = &self.site.shown {
                tokio::spawn(send_bundles(Arc::clone(live)));
            }
            while !stop.load(Ordering::Relaxed) {
                match tokio::time::timeout(LOOK_EVERY, listener.accept()).await {
                    Ok(Ok((stream, _))) => {
                        // Whoever finds no place is let go at once.
                        if let Ok(place) = Arc::clone(&places).try_acquire_owned() {
                            let place = Arc::new(place);
                            tokio::spawn(answer(stream, Arc::clone(&self.site), place));
                        }
                    }
                    // A client that was gone before it was greeted, or no files left: not for long.
                    Ok(Err(_)) => tokio::time::sleep(LOOK_EVERY).await,
                    Err(_) => {}
                }
            }
            if let Shown::Live(live) = &self.site.shown {
                // What happened last is to be seen too.
                live.send_bundle();
                tokio::time::sleep(LOOK_EVERY).await;
            }
            Ok(())
        })
    }
}

async fn send_bundles(live: Arc<Live>) {
    let mut every = tokio::time::interval(BUNDLE_EVERY);
    every.set_missed_tick_behavior(tokio::time::MissedTickBehavior::Delay);
    loop {
        every.tick().await;
        live.send_bundle();
    }
}

/// `place` is kept until the connection is closed.
async fn answer(stream: tokio::net::TcpStream, site: Arc<Site>, place: Arc<OwnedSemaphorePermit>) {
    // Small messages are to be on their way at once; if that cannot be had, they come later.
    let _ = stream.set_nodelay(true);
    let held = Arc::clone(&place);
    let service = service_fn(move |mut request: Request<Incoming>| {
        let response = site.respond(&mut request, &held);
        async { Ok::<_, Infallible>(response) }
    });
    let connection = hyper::server::conn::http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(HEAD_WITHIN)
        .max_buf_size(LARGEST_HEAD)
        .serve_connection(TokioIo::new(stream), service)
        .with_upgrades();
    // However it ends, nobody is left who could be told.
    let _ = tokio::time::timeout(LONGEST_CONNECTION, connection).await;
    drop(place);
}

impl Site {
    fn respond(
        &self,
        request: &mut Request<Incoming>,
        place: &Arc<OwnedSemaphorePermit>,
    ) -> Response<Full<Bytes>> {
        if let Err((status, text)) = self.guard.admit(request) {
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
        match (request.uri().path(), &self.shown) {
            ("/", _) => response(StatusCode::OK, "text/html; charset=utf-8", PAGE.into()),
            ("/recording.json", shown) => {
                let recording = match shown {
                    Shown::Recording(recording) => recording.clone(),
                    Shown::Live(live) => live.recording().into(),
                };
                response(StatusCode::OK, "application/json", recording)
            }
            ("/live", Shown::Live(live)) => upgrade(request, live, place),
            _ => plain(StatusCode::NOT_FOUND, "there is no such page\n"),
        }
    }
}

/// A sentence.
pub(super) fn plain(status: StatusCode, text: &'static str) -> Response<Full<Bytes>> {
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
