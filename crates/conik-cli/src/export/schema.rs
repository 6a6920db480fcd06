//! What a type of message is, and how a file tells its readers.

use super::protobuf::Message;

/// A type of message.
#[derive(Debug)]
pub struct MessageType {
    /// With its package: `foxglove.Log`.
    pub name: &'static str,
    /// A field's number is its place here, from 1.
    pub(super) fields: &'static [Field],
    /// Enumerations within it: name, and names of the values from 0 on.
    pub(super) choices: &'static [(&'static str, &'static [&'static str])],
}

/// A field of a type.
#[derive(Debug)]
pub(super) struct Field {
    name: &'static str,
    kind: Kind,
    count: Count,
}

#[derive(Debug, PartialEq)]
enum Count {
    One,
    /// Absent is not the same as zero.
    AtMostOne,
    Many,
}

/// What a field holds.
#[derive(Debug)]
pub(super) enum Kind {
    Double,
    Int64,
    Uint64,
    Int32,
    Fixed32,
    Bool,
    Text,
    Bytes,
    Uint32,
    /// An enumeration of the type itself.
    Choice(&'static str),
    Message(&'static MessageType),
}

use Kind::{Bool, Bytes, Choice, Double, Fixed32, Int32, Int64, Text, Uint32, Uint64};

pub(super) const fn one(name: &'static str, kind: Kind) -> Field {
    let count = Count::One;
    Field { name, kind, count }
}

pub(super) const fn maybe(name: &'static str, kind: Kind) -> Field {
    let count = Count::AtMostOne;
    Field { name, kind, count }
}

pub(super) const fn many(name: &'static str, kind: Kind) -> Field {
    let count = Count::Many;
    Field { name, kind, count }
}

pub(super) const fn message(name: &'static str, of: &'static MessageType) -> Field {
    one(name, Kind::Message(of))
}

pub(super) const fn messages(name: &'static str, of: &'static MessageType) -> Field {
    many(name, Kind::Message(of))
}

pub(super) const fn plain(name: &'static str, fields: &'static [Field]) -> MessageType {
    MessageType {
        name,
        fields,
        choices: &[],
    }
}

impl MessageType {
    /// A `FileDescriptorSet` of the type and all types in it, each after those that it needs.
    pub fn descriptor(&'static self) -> Vec<u8> {
        let mut types = Vec::new();
        self.collect(&mut types);
        let mut set = Message::default();
        for of in types {
            set.message(1, |file| of.describe_file(file));
        }
        set.bytes().to_vec()
    }

    fn collect(&'static self, found: &mut Vec<&'static MessageType>) {
        if found.iter().any(|other| other.name == self.name) {
            return;
        }
        for part in self.parts() {
            part.collect(found);
        }
        found.push(self);
    }

    fn parts(&self) -> impl Iterator<Item = &'static MessageType> {
        self.fields.iter().filter_map(|field| match field.kind {
            Kind::Message(of) => Some(of),
            _ => None,
        })
    }

    /// Its package and its name there.
    fn split(&self) -> (&'static str, &'static str) {
        self.name.rsplit_once('.').unwrap_or(("", self.name))
    }

    /// The file that it is declared in.
    fn file(&self) -> String {
        let (package, name) = self.split();
        match package {
            "google.protobuf" => format!("google/protobuf/{}.proto", name.to_lowercase()),
            _ => format!("{package}/{name}.proto"),
        }
    }

    fn describe_file(&self, file: &mut Message) {
        let (package, name) = self.split();
        file.text(1, &self.file());
        file.text(2, package);
        let mut needed: Vec<String> = self.parts().map(MessageType::file).collect();
        needed.sort();
        needed.dedup();
        for other in &needed {
            file.text(3, other);
        }
        file.message(4, |declared| {
            declared.text(1, name);
            let mut absent_ones = 0;
            for (field, number) in self.fields.iter().zip(1..) {
                declared.message(2, |of| self.describe(field, number, absent_ones, of));
                absent_ones += u64::from(field.count == Count::AtMostOne);
            }
            for (choice, values) in self.choices {
                declared.message(4, |of| describe_choice(choice, values, of));
            }
            // A field that may be absent is the only one of a choice of its own.
            for field in self.fields.iter().filter(|it| it.count == Count::AtMostOne) {
                declared.message(8, |of| of.text(1, &format!("_{}", field.name)));
            }
        });
        file.text(12, "proto3");
    }

    fn describe(&self, field: &Field, number: u64, absent_ones: u64, of: &mut Message) {
        let (code, type_name) = match field.kind {
            Double => (1, None),
            Int64 => (3, None),
            Uint64 => (4, None),
            Int32 => (5, None),
            Fixed32 => (7, None),
            Bool => (8, None),
            Text => (9, None),
            Kind::Message(part) => (11, Some(format!(".{}", part.name))),
            Bytes => (12, None),
            Uint32 => (13, None),
            Choice(name) => (14, Some(format!(".{}.{name}", self.name))),
        };
        of.text(1, field.name);
        of.whole(3, number);
        of.whole(4, if field.count == Count::Many { 3 } else { 1 });
        of.whole(5, code);
        if let Some(name) = type_name {
            of.text(6, &name);
        }
        if field.count == Count::AtMostOne {
            of.whole(9, absent_ones);
            of.whole(17, 1);
        }
    }
}

fn describe_choice(name: &str, values: &[&str], of: &mut Message) {
    of.text(1, name);
    for (value, number) in values.iter().zip(0..) {
        of.message(2, |one| {
            one.text(1, value);
            one.whole(2, number);
        });
    }
}
