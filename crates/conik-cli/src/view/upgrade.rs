//! From a request to a WebSocket (RFC 6455, section 4.2).

use std::sync::Arc;

use http_body_util::Full;
use hyper::body::{Bytes, Incoming};
use hyper::header::{self, HeaderName, HeaderValue};
use hyper::{Method, Request, Response, StatusCode};
use tokio::sync::OwnedSemaphorePermit;
use tokio_tungstenite::tungstenite::handshake::derive_accept_key;

use super::live::{Live, attend};
use super::server::plain;

/// Makes a WebSocket of the connection, if that is what is asked for; `place` is kept as long as it lives.
pub(super) fn upgrade(
    request: &mut Request<Incoming>,
    live: &Arc<Live>,
    place: &Arc<OwnedSemaphorePermit>,
) -> Response<Full<Bytes>> {
    let headers = request.headers();
    let has = |name: HeaderName, wanted: &str| {
        let values = headers.get_all(name).iter();
        let mut words = values.filter_map(|value| {
            value
                .to_str()
                .ok()?
                .split(',')
                .map(str::trim)
                .map(|word| word.eq_ignore_ascii_case(wanted))
                .reduce(|a, b| a || b)
        });
        words.any(|is_it| is_it)
    };
    let key = headers.get(header::SEC_WEBSOCKET_KEY);
    let is_asked = request.method() == Method::GET
        && has(header::CONNECTION, "upgrade")
        && has(header::UPGRADE, "websocket")
        && has(header::SEC_WEBSOCKET_VERSION, "13");
    let Some(key) = key.filter(|_| is_asked) else {
        let mut refused = plain(
            StatusCode::UPGRADE_REQUIRED,
            "this is a WebSocket, version 13\n",
        );
        for (name, value) in [
            (header::CONNECTION, "Upgrade"),
            (header::UPGRADE, "websocket"),
            (header::SEC_WEBSOCKET_VERSION, "13"),
        ] {
            refused
                .headers_mut()
                .insert(name, HeaderValue::from_static(value));
        }
        return refused;
    };
    let accept = derive_accept_key(key.as_bytes());
    let Ok(accept) = HeaderValue::from_str(&accept) else {
        return plain(StatusCode::BAD_REQUEST, "that key is none\n");
    };
    let upgraded = hyper::upgrade::on(request);
    let (live, place) = (Arc::clone(live), Arc::clone(place));
    tokio::spawn(async move {
        if let Ok(connection) = upgraded.await {
            attend(live, connection).await;
        }
        drop(place);
    });
    let mut switching = plain(StatusCode::SWITCHING_PROTOCOLS, "");
    let headers = switching.headers_mut();
    headers.remove(header::CONTENT_TYPE);
    headers.insert(header::CONNECTION, HeaderValue::from_static("Upgrade"));
    headers.insert(header::UPGRADE, HeaderValue::from_static("websocket"));
    headers.insert(header::SEC_WEBSOCKET_ACCEPT, accept);
    switching
}
