//! The wire format: every package survives the way there and back, and no bytes bring it down.

use conik_ur::wire::value::{decode, encode};
use conik_ur::wire::{
    ControllerVersion, FieldReply, FieldType, Frame, FrameReader, Reply, Request, TextLevel,
    TextMessage, Value, WireError,
};
use proptest::prelude::*;

/// The published layout, byte by byte, so that the round trips cannot agree on a common mistake.
#[test]
fn packages_have_the_published_bytes() {
    let bytes = |request: Request| request.to_frame().unwrap().to_bytes().unwrap();
    assert_eq!(bytes(Request::ProtocolVersion(2)), [0, 5, 86, 0, 2]);
    assert_eq!(bytes(Request::ControllerVersion), [0, 3, 118]);
    assert_eq!(bytes(Request::Start), [0, 3, 83]);
    assert_eq!(bytes(Request::Pause), [0, 3, 80]);
    let outputs = Request::Outputs {
        frequency_hz: 125.0,
        names: vec!["timestamp".into(), "target_q".into()],
    };
    let mut expected = vec![0, 29, 79, 0x40, 0x5f, 0x40, 0, 0, 0, 0, 0];
    expected.extend_from_slice(b"timestamp,target_q");
    assert_eq!(bytes(outputs), expected);
    let data = Request::Data {
        recipe: 1,
        values: encode(
            &[FieldType::Int32, FieldType::Double],
            &[Value::Int32(-2), Value::Double(1.0)],
        )
        .unwrap(),
    };
    assert_eq!(
        bytes(data),
        [
            0, 16, 85, 1, 255, 255, 255, 254, 0x3f, 0xf0, 0, 0, 0, 0, 0, 0
        ]
    );
    let text = Reply::Text(TextMessage::new(TextLevel::Error, "RTDE", "no"));
    assert_eq!(
        text.to_frame().unwrap().to_bytes().unwrap(),
        [0, 12, 77, 2, b'n', b'o', 4, b'R', b'T', b'D', b'E', 1]
    );
}

#[test]
fn a_trailing_comma_in_a_list_of_names_is_no_name() {
    let frame = Frame {
        kind: b'I',
        payload: b"input_int_register_24,input_double_register_24,".to_vec(),
    };
    let Request::Inputs(names) = Request::from_frame(&frame).unwrap() else {
        panic!("not inputs")
    };
    assert_eq!(names, ["input_int_register_24", "input_double_register_24"]);
}

#[test]
fn no_number_that_is_not_finite_is_encoded() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let types = [FieldType::Int32, FieldType::Vector6d];
        let values = [
            Value::Int32(1),
            Value::Vector6d([0.0, 0.0, 0.0, 0.0, bad, 0.0]),
        ];
        assert_eq!(
            encode(&types, &values),
            Err(WireError::NotFinite { field: 1 })
        );
        let frequency = Request::Outputs {
            frequency_hz: bad,
            names: vec![],
        };
        assert!(frequency.to_frame().is_err());
    }
}

#[test]
fn values_must_fit_their_recipe() {
    let types = [FieldType::Double];
    assert_eq!(
        encode(&types, &[Value::Int32(1)]),
        Err(WireError::WrongType {
            field: 0,
            need: FieldType::Double,
            have: FieldType::Int32
        })
    );
    assert!(matches!(
        encode(&types, &[]),
        Err(WireError::WrongCount { need: 1, have: 0 })
    ));
    assert!(matches!(
        decode(&types, &[0; 7]),
        Err(WireError::TooShort {
            need: 8,
            have: 7,
            ..
        })
    ));
    assert!(matches!(
        decode(&types, &[0; 9]),
        Err(WireError::TooLong { surplus: 1, .. })
    ));
}

fn value() -> impl Strategy<Value = Value> {
    let number = || -1e300..1e300_f64;
    prop_oneof![
        any::<bool>().prop_map(Value::Bool),
        any::<u8>().prop_map(Value::Uint8),
        any::<u32>().prop_map(Value::Uint32),
        any::<u64>().prop_map(Value::Uint64),
        any::<i32>().prop_map(Value::Int32),
        number().prop_map(Value::Double),
        prop::array::uniform3(number()).prop_map(Value::Vector3d),
        prop::array::uniform6(number()).prop_map(Value::Vector6d),
        any::<[i32; 6]>().prop_map(Value::Vector6Int32),
        any::<[u32; 6]>().prop_map(Value::Vector6Uint32),
    ]
}

fn text() -> impl Strategy<Value = TextMessage> {
    let level = prop_oneof![
        Just(TextLevel::Exception),
        Just(TextLevel::Error),
        Just(TextLevel::Warning),
        Just(TextLevel::Info)
    ];
    (level, any::<String>(), any::<String>())
        .prop_map(|(level, text, source)| TextMessage::new(level, &source, &text))
}

fn names() -> impl Strategy<Value = Vec<String>> {
    prop::collection::vec("[a-z_0-9]{1,30}", 0..20)
}

fn data() -> impl Strategy<Value = (u8, Vec<u8>)> {
    any::<(u8, Vec<u8>)>()
}

fn request() -> impl Strategy<Value = Request> {
    prop_oneof![
        any::<u16>().prop_map(Request::ProtocolVersion),
        Just(Request::ControllerVersion),
        text().prop_map(Request::Text),
        data().prop_map(|(recipe, values)| Request::Data { recipe, values }),
        (0.0..1e6, names()).prop_map(|(frequency_hz, names)| Request::Outputs {
            frequency_hz,
            names
        }),
        names().prop_map(Request::Inputs),
        Just(Request::Start),
        Just(Request::Pause),
    ]
}

fn field_replies() -> impl Strategy<Value = Vec<FieldReply>> {
    let reply = prop_oneof![
        prop::sample::select(FieldType::ALL.to_vec()).prop_map(FieldReply::Type),
        Just(FieldReply::NotFound),
        Just(FieldReply::InUse),
    ];
    prop::collection::vec(reply, 0..20)
}

fn reply() -> impl Strategy<Value = Reply> {
    prop_oneof![
        any::<bool>().prop_map(Reply::ProtocolVersion),
        any::<[u32; 4]>().prop_map(|[major, minor, bugfix, build]| {
            Reply::ControllerVersion(ControllerVersion {
                major,
                minor,
                bugfix,
                build,
            })
        }),
        text().prop_map(Reply::Text),
        data().prop_map(|(recipe, values)| Reply::Data { recipe, values }),
        (any::<u8>(), field_replies())
            .prop_map(|(recipe, fields)| Reply::Outputs { recipe, fields }),
        (any::<u8>(), field_replies())
            .prop_map(|(recipe, fields)| Reply::Inputs { recipe, fields }),
        any::<bool>().prop_map(Reply::Start),
        any::<bool>().prop_map(Reply::Pause),
    ]
}

/// Cuts frames out of `bytes`, handed over in portions of `portion` bytes.
fn frames(bytes: &[u8], portion: usize) -> Result<Vec<Frame>, WireError> {
    let mut reader = FrameReader::new();
    let mut frames = Vec::new();
    for chunk in bytes.chunks(portion) {
        reader.push(chunk);
        while let Some(frame) = reader.next_frame()? {
            frames.push(frame);
        }
    }
    Ok(frames)
}

proptest! {
    #[test]
    fn requests_survive_the_way(requests in prop::collection::vec(request(), 1..8), portion in 1..40_usize) {
        let bytes: Vec<u8> = requests
            .iter()
            .flat_map(|request| request.to_frame().unwrap().to_bytes().unwrap())
            .collect();
        let back: Vec<Request> = frames(&bytes, portion)
            .unwrap()
            .iter()
            .map(|frame| Request::from_frame(frame).unwrap())
            .collect();
        prop_assert_eq!(back, requests);
    }

    #[test]
    fn replies_survive_the_way(replies in prop::collection::vec(reply(), 1..8), portion in 1..40_usize) {
        let bytes: Vec<u8> = replies
            .iter()
            .flat_map(|reply| reply.to_frame().unwrap().to_bytes().unwrap())
            .collect();
        let back: Vec<Reply> = frames(&bytes, portion)
            .unwrap()
            .iter()
            .map(|frame| Reply::from_frame(frame).unwrap())
            .collect();
        prop_assert_eq!(back, replies);
    }

    #[test]
    fn values_survive_the_way_bit_by_bit(values in prop::collection::vec(value(), 0..40)) {
        let types: Vec<FieldType> = values.iter().map(Value::field_type).collect();
        let bytes = encode(&types, &values).unwrap();
        prop_assert_eq!(decode(&types, &bytes).unwrap(), values);
    }

    #[test]
    fn no_bytes_bring_the_decoder_down(bytes in any::<Vec<u8>>(), portion in 1..40_usize) {
        if let Ok(frames) = frames(&bytes, portion) {
            for frame in frames {
                let _ = Request::from_frame(&frame);
                let _ = Reply::from_frame(&frame);
            }
        }
    }

    #[test]
    fn no_mutation_of_a_package_brings_the_decoder_down(
        request in request(),
        reply in reply(),
        at in any::<prop::sample::Index>(),
        value in any::<u8>(),
    ) {
        for mut frame in [request.to_frame().unwrap(), reply.to_frame().unwrap()] {
            if !frame.payload.is_empty() {
                let at = at.index(frame.payload.len());
                frame.payload[at] = value;
                let _ = Request::from_frame(&frame);
                let _ = Reply::from_frame(&frame);
                frame.payload.truncate(at);
            }
            let _ = Request::from_frame(&frame);
            let _ = Reply::from_frame(&frame);
        }
    }
}
