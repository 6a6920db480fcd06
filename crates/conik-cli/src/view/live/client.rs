//! One client of a run: what is sent to it and what it asks.
//!
//! A client that reads too slowly is cut off; nobody waits for it.

use std::sync::Arc;
use std::time::{Duration, Instant};

use futures_util::{SinkExt, StreamExt};
use hyper::upgrade::Upgraded;
use hyper_util::rt::TokioIo;
use tokio::sync::broadcast::error::RecvError;
use tokio::sync::mpsc;
use tokio_tungstenite::WebSocketStream;
use tokio_tungstenite::tungstenite::protocol::frame::CloseFrame;
use tokio_tungstenite::tungstenite::protocol::frame::coding::CloseCode;
use tokio_tungstenite::tungstenite::protocol::{Role, WebSocketConfig};
use tokio_tungstenite::tungstenite::{Message, Utf8Bytes};

use super::session::Live;

/// Bytes of the longest message of a client: a list of a thousand waypoints.
const LONGEST_MESSAGE: usize = 64 * 1024;

/// Messages a second that are taken of a client, and how many at once.
const MESSAGES_PER_S: f64 = 100.0;
const MESSAGES_AT_ONCE: f64 = 200.0;

/// How long one message may take to be sent.
const SENT_WITHIN: Duration = Duration::from_secs(2);

/// Answers that may wait to be sent.
const ANSWERS_WAITING: usize = 64;

/// Serves a client until it goes, or is cut off.
pub(in crate::view) async fn attend(live: Arc<Live>, connection: Upgraded) {
    let config = WebSocketConfig::default()
        .read_buffer_size(4096)
        .max_message_size(Some(LONGEST_MESSAGE))
        .max_frame_size(Some(LONGEST_MESSAGE));
    let socket = TokioIo::new(connection);
    let socket = WebSocketStream::from_raw_socket(socket, Role::Server, Some(config)).await;
    let (mut sender, mut receiver) = socket.split();
    let (answers, mut waiting) = mpsc::channel::<Utf8Bytes>(ANSWERS_WAITING);
    let (first, mut bundles) = live.greet();

    let writing = async {
        for message in first {
            send(&mut sender, Message::text(message)).await?;
        }
        loop {
            let message = tokio::select! {
                // What a change leads to is told before the answer to it.
                biased;
                bundle = bundles.recv() => match bundle {
                    Ok(bundle) => bundle,
                    Err(RecvError::Lagged(_)) => return Err(End::Slow),
                    Err(RecvError::Closed) => return Err(End::Gone),
                },
                answer = waiting.recv() => answer.ok_or(End::Gone)?,
            };
            send(&mut sender, Message::Text(message)).await?;
        }
    };
    let reading = async {
        let mut patience = Patience::full();
        while let Some(message) = receiver.next().await {
            let answer = match message.map_err(|_| End::Gone)? {
                Message::Text(text) => live.answer(&text),
                Message::Binary(_) => return Err(End::Wrong("messages are text")),
                Message::Close(_) => return Err(End::Gone),
                Message::Ping(_) | Message::Pong(_) | Message::Frame(_) => continue,
            };
            tokio::time::sleep(patience.wait()).await;
            // Whoever does not read its answers is too slow.
            answers.try_send(answer.into()).map_err(|_| End::Slow)?;
        }
        Err(End::Gone)
    };
    let end: Result<(), End> = tokio::select! {
        end = writing => end,
        end = reading => end,
    };
    live.leave();
    if let Some(frame) = end.err().and_then(End::frame) {
        // Whether it hears that is its own affair.
        let _ = send(&mut sender, Message::Close(Some(frame))).await;
    }
}

/// Why a client is served no longer.
enum End {
    Gone,
    Slow,
    Wrong(&'static str),
}

impl End {
    fn frame(self) -> Option<CloseFrame> {
        match self {
            Self::Gone => None,
            Self::Slow => Some(CloseFrame {
                code: CloseCode::Again,
                reason: "too slow: connect again".into(),
            }),
            Self::Wrong(reason) => Some(CloseFrame {
                code: CloseCode::Policy,
                reason: reason.into(),
            }),
        }
    }
}

type Sender = futures_util::stream::SplitSink<WebSocketStream<TokioIo<Upgraded>>, Message>;

async fn send(sender: &mut Sender, message: Message) -> Result<(), End> {
    match tokio::time::timeout(SENT_WITHIN, sender.send(message)).await {
        Ok(Ok(())) => Ok(()),
        Ok(Err(_)) => Err(End::Gone),
        Err(_) => Err(End::Slow),
    }
}

/// How many messages are taken at once: some, and so many more a second. More have to wait.
struct Patience {
    left: f64,
    since: Instant,
}

impl Patience {
    fn full() -> Self {
        Self {
            left: MESSAGES_AT_ONCE,
            since: Instant::now(),
        }
    }

    /// For how long to look at no further message, now that one was taken.
    fn wait(&mut self) -> Duration {
        let now = Instant::now();
        let regained = (now - self.since).as_secs_f64() * MESSAGES_PER_S;
        self.since = now;
        self.left = (self.left + regained).min(MESSAGES_AT_ONCE) - 1.0;
        Duration::from_secs_f64((-self.left / MESSAGES_PER_S).max(0.0))
    }
}
