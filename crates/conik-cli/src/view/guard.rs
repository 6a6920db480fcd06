//! Who is answered: on loopback whoever names this server and comes from no other site, elsewhere whoever has
//! the token.

use std::fmt::Write;
use std::io;
use std::net::SocketAddr;

use hyper::body::Incoming;
use hyper::header::{self, HeaderName};
use hyper::http::uri::Authority;
use hyper::{HeaderMap, Method, Request, StatusCode};

/// Bytes of a token.
const TOKEN_BYTES: usize = 16;

/// Decides who is answered.
#[derive(Debug)]
pub(super) enum Guard {
    /// Whoever names one of these hosts.
    Loopback(Vec<String>),
    /// Whoever has the token, by whatever name the server is reached.
    Token(String),
}

/// Why a request is not answered.
pub(super) type Refusal = (StatusCode, &'static str);

impl Guard {
    /// Of a server that only this computer can reach.
    pub(super) fn of_loopback(address: SocketAddr) -> Self {
        let port = address.port();
        let own = address.ip().to_string();
        let names = ["127.0.0.1", "localhost", "[::1]", own.as_str()];
        let with_port = names.iter().map(|name| format!("{name}:{port}"));
        // Browsers leave out the port of the protocol.
        let without = names.iter().map(|&name| name.to_owned());
        let without = without.filter(|_| port == 80);
        Self::Loopback(with_port.chain(without).collect())
    }

    /// Of any other, with a token that nobody knows yet.
    pub(super) fn with_new_token() -> io::Result<Self> {
        let mut bytes = [0; TOKEN_BYTES];
        getrandom::fill(&mut bytes).map_err(|error| io::Error::other(error.to_string()))?;
        let token = bytes.iter().fold(String::new(), |mut token, byte| {
            // Text takes everything.
            let _ = write!(token, "{byte:02x}");
            token
        });
        Ok(Self::Token(token))
    }

    /// What follows the path in the address.
    pub(super) fn query(&self) -> String {
        match self {
            Self::Loopback(_) => String::new(),
            Self::Token(token) => format!("?token={token}"),
        }
    }

    /// Whether the request is meant for this server, and comes from its own page if from any.
    pub(super) fn admit(&self, request: &Request<Incoming>) -> Result<(), Refusal> {
        let headers = request.headers();
        let host = only(headers, &header::HOST)?;
        self.admit_host(request, host)?;
        let is_own_page = |origin: &str| {
            let origin = origin.strip_prefix("http://");
            origin.is_some_and(|origin| {
                host.is_some_and(|host| origin.eq_ignore_ascii_case(host)) || self.is_ours(origin)
            })
        };
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

    fn admit_host(&self, request: &Request<Incoming>, host: Option<&str>) -> Result<(), Refusal> {
        match self {
            Self::Loopback(_) => {
                let target = request.uri().authority().map(Authority::as_str);
                let is_ours = host.is_some_and(|host| self.is_ours(host))
                    && target.is_none_or(|target| self.is_ours(target));
                let text = "this server answers to 127.0.0.1 and localhost, with its port\n";
                is_ours.then_some(()).ok_or((StatusCode::FORBIDDEN, text))
            }
            Self::Token(token) => {
                let query = request.uri().query().unwrap_or_default();
                let given = query.split('&').filter_map(|it| it.strip_prefix("token="));
                let has_token = given.fold(false, |has, given| has | is_same(given, token));
                let text = "this address needs its token: use the whole of what conik printed\n";
                has_token.then_some(()).ok_or((StatusCode::FORBIDDEN, text))
            }
        }
    }

    fn is_ours(&self, host: &str) -> bool {
        match self {
            Self::Loopback(hosts) => hosts.iter().any(|ours| ours.eq_ignore_ascii_case(host)),
            Self::Token(_) => false,
        }
    }
}

/// Whether two texts are the same, found out in a time that does not tell where they differ.
fn is_same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let differ = a.iter().zip(b).fold(0, |all, (a, b)| all | (a ^ b));
    a.len() == b.len() && differ == 0
}

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
