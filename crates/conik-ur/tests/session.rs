//! The session over a stream that is only bytes: no network, no time.

use conik_ur::session::{Session, SessionError};
use conik_ur::wire::value::encode;
use conik_ur::wire::{
    ControllerVersion, FieldReply, FieldType, Reply, TextLevel, TextMessage, Value,
};
use std::collections::VecDeque;
use std::io::{self, Read, Write};

/// Gives prepared portions of bytes, one per read; then the stream has ended.
struct Prepared {
    portions: VecDeque<Vec<u8>>,
}

impl Read for Prepared {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let bytes = self.portions.pop_front().unwrap_or_default();
        buffer[..bytes.len()].copy_from_slice(&bytes);
        Ok(bytes.len())
    }
}

impl Write for Prepared {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

fn bytes(replies: &[Reply]) -> Vec<u8> {
    replies
        .iter()
        .flat_map(|reply| reply.to_frame().unwrap().to_bytes().unwrap())
        .collect()
}

fn version() -> Reply {
    Reply::ControllerVersion(ControllerVersion {
        major: 5,
        minor: 13,
        bugfix: 0,
        build: 0,
    })
}

fn timestamp(value: f64) -> Reply {
    Reply::Data {
        recipe: 1,
        values: encode(&[FieldType::Double], &[Value::Double(value)]).unwrap(),
    }
}

fn fields(names: &[&str]) -> Vec<(String, FieldType)> {
    names
        .iter()
        .map(|name| ((*name).to_owned(), FieldType::Double))
        .collect()
}

/// A session after the greeting, with these portions still to come.
fn greeted(portions: Vec<Vec<u8>>) -> Session<Prepared> {
    let mut all = VecDeque::from(portions);
    all.push_front(bytes(&[Reply::ProtocolVersion(true), version()]));
    Session::greet(Prepared { portions: all }).unwrap()
}

#[test]
fn the_newest_of_several_waiting_packages_is_used_and_the_others_are_counted() {
    let outputs = Reply::Outputs {
        recipe: 1,
        fields: vec![FieldReply::Type(FieldType::Double)],
    };
    let mut session = greeted(vec![
        bytes(&[outputs, Reply::Start(true)]),
        bytes(&[timestamp(50.0), timestamp(50.008), timestamp(50.016)]),
        bytes(&[timestamp(50.024)]),
    ]);
    session.subscribe(125.0, &fields(&["timestamp"])).unwrap();
    session.start().unwrap();
    let latest = session.latest().unwrap();
    assert_eq!(latest.values, [Value::Double(50.016)]);
    assert_eq!(latest.passed_over, 2);
    let latest = session.latest().unwrap();
    assert_eq!(latest.values, [Value::Double(50.024)]);
    assert_eq!(latest.passed_over, 0);
    assert!(matches!(session.latest(), Err(SessionError::Lost(_))));
}

#[test]
fn every_field_that_cannot_be_had_is_named_and_no_other() {
    let refused = |refusal| Reply::Inputs {
        recipe: 0,
        fields: vec![refusal, FieldReply::Type(FieldType::Double), refusal],
    };
    for (refusal, cure) in [
        (FieldReply::InUse, "another client or a fieldbus"),
        (FieldReply::NotFound, "update"),
    ] {
        let mut session = greeted(vec![bytes(&[refused(refusal)])]);
        let error = session.claim(&fields(&["a", "b", "c"])).unwrap_err();
        let said = error.to_string();
        assert!(said.contains("a, c") && said.contains(cure), "{said}");
    }
}

#[test]
fn a_field_of_another_type_than_expected_is_named() {
    let reply = Reply::Outputs {
        recipe: 1,
        fields: vec![FieldReply::Type(FieldType::Int32)],
    };
    let mut session = greeted(vec![bytes(&[reply])]);
    let error = session
        .subscribe(125.0, &fields(&["timestamp"]))
        .unwrap_err();
    assert_eq!(error.to_string(), "field timestamp is INT32, not DOUBLE");
}

#[test]
fn a_lost_stream_reports_what_the_controller_said_last() {
    let text = TextMessage::new(TextLevel::Error, "RTDE", "no such frequency");
    let mut session = greeted(vec![bytes(&[Reply::Text(text)])]);
    let error = session.subscribe(1e9, &fields(&["timestamp"])).unwrap_err();
    assert!(error.to_string().contains("no such frequency"), "{error}");
}

#[test]
fn a_refused_protocol_is_an_error() {
    let portions = VecDeque::from([bytes(&[Reply::ProtocolVersion(false)])]);
    let refused = Session::greet(Prepared { portions }).err();
    assert!(matches!(refused, Some(SessionError::ProtocolRefused)));
}

#[test]
fn messages_without_end_are_no_answer() {
    let text = Reply::Text(TextMessage::new(TextLevel::Info, "", ""));
    let flood = bytes(&vec![text; 1000]);
    let portions = VecDeque::from(vec![flood; 20]);
    let refused = Session::greet(Prepared { portions }).err();
    assert!(matches!(refused, Some(SessionError::OutOfOrder(_))));
}
