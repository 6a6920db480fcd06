//! The controller's side of RTDE: what each package of one client does, and what it is answered.
//!
//! Where the maker does not say how a controller reacts to a bad package, this one sends a text
//! message of level 1 that names the fault, drops the package and keeps the connection.

use super::controller::Controller;
use super::fields::{InputField, OutputField};
use crate::wire::recipe::MAX_NAMES_SIZE;
use crate::wire::value::{decode, encode};
use crate::wire::{
    ControllerVersion, FieldReply, FieldType, Frame, PROTOCOL_VERSION, Reply, Request, TextLevel,
    TextMessage, Value, WireError,
};
use std::collections::BTreeMap;

/// Who writes which input.
pub(super) type Claims = BTreeMap<InputField, u64>;

/// One client, as far as RTDE is concerned.
#[derive(Debug)]
pub(super) struct RtdeClient {
    id: u64,
    speaks_version_2: bool,
    outputs: Outputs,
    /// Input recipes; the first has number 1.
    inputs: Vec<Vec<InputField>>,
    is_started: bool,
}

#[derive(Debug, Default)]
struct Outputs {
    fields: Vec<OutputField>,
    types: Vec<FieldType>,
    /// A package goes out in every so many control cycles.
    every: u64,
}

/// What a package led to.
#[derive(Debug, Default)]
pub(super) struct Outcome {
    pub(super) reply: Option<Reply>,
    /// Whether inputs were written.
    pub(super) wrote_inputs: bool,
}

impl From<Reply> for Outcome {
    fn from(reply: Reply) -> Self {
        Self {
            reply: Some(reply),
            wrote_inputs: false,
        }
    }
}

/// The number of the one output recipe of a connection.
const OUTPUT_RECIPE: u8 = 1;

/// The type of a package that lists outputs.
const OUTPUTS_KIND: u8 = b'O';

/// How often version 1 sends outputs [Hz].
const VERSION_1_HZ: f64 = 125.0;

/// The number given to a recipe that cannot be used.
const NO_RECIPE: u8 = 0;

impl RtdeClient {
    pub(super) fn new(id: u64) -> Self {
        Self {
            id,
            speaks_version_2: false,
            outputs: Outputs::default(),
            inputs: Vec::new(),
            is_started: false,
        }
    }

    /// Whether this client has asked for outputs to begin.
    pub(super) fn is_started(&self) -> bool {
        self.is_started
    }

    /// Whether this client both receives outputs and writes inputs.
    pub(super) fn is_in_the_loop(&self) -> bool {
        self.is_started && !self.outputs.fields.is_empty() && !self.inputs.is_empty()
    }

    /// Whether a package is due to this client in this control cycle.
    pub(super) fn is_due(&self, cycles: u64) -> bool {
        self.is_started
            && !self.outputs.fields.is_empty()
            && cycles.is_multiple_of(self.outputs.every)
    }

    /// The outputs as a package.
    pub(super) fn package(&self, controller: &Controller) -> Option<Vec<u8>> {
        let values: Vec<Value> = self
            .outputs
            .fields
            .iter()
            .map(|field| controller.output(*field))
            .collect();
        let values = encode(&self.outputs.types, &values).ok()?;
        self.to_bytes(&Reply::Data {
            recipe: OUTPUT_RECIPE,
            values,
        })
    }

    /// A reply as this client's version of the protocol writes it. Replies are built from short
    /// texts and lists, so that they always fit a package.
    pub(super) fn to_bytes(&self, reply: &Reply) -> Option<Vec<u8>> {
        let mut frame = reply.to_frame().ok()?;
        if !self.speaks_version_2 {
            match reply {
                Reply::Data { .. } | Reply::Outputs { .. } => {
                    frame.payload.remove(0);
                }
                // The level first, and no source.
                Reply::Text(message) => {
                    let level = frame.payload.pop().into_iter();
                    frame.payload = level.chain(message.text.bytes()).collect();
                }
                _ => {}
            }
        }
        frame.to_bytes().ok()
    }

    /// Acts on one package of this client.
    pub(super) fn handle(
        &mut self,
        frame: &Frame,
        version: ControllerVersion,
        rate_hz: f64,
        controller: &mut Controller,
        claims: &mut Claims,
    ) -> Outcome {
        let outcome = self
            .request(frame)
            .map_err(|error| error.to_string())
            .and_then(|request| match request {
                Request::ProtocolVersion(asked) => {
                    let is_known = (1..=PROTOCOL_VERSION).contains(&asked);
                    if is_known {
                        self.speaks_version_2 = asked == PROTOCOL_VERSION;
                    }
                    Ok(Reply::ProtocolVersion(is_known).into())
                }
                Request::ControllerVersion => Ok(Reply::ControllerVersion(version).into()),
                Request::Text(message) => {
                    controller.note(&format!("client {} says: {}", self.id, message.text));
                    Ok(Outcome::default())
                }
                Request::Outputs {
                    frequency_hz,
                    names,
                } => self.set_up_outputs(frequency_hz, &names, rate_hz),
                Request::Inputs(names) => self.set_up_inputs(&names, claims),
                Request::Data { recipe, values } => self.write(recipe, &values, controller),
                Request::Start => {
                    self.is_started = true;
                    Ok(Reply::Start(true).into())
                }
                Request::Pause => {
                    self.is_started = false;
                    Ok(Reply::Pause(true).into())
                }
            });
        outcome.unwrap_or_else(|fault| {
            controller.note(&format!("client {}: package dropped: {fault}", self.id));
            Reply::Text(TextMessage::new(TextLevel::Error, "RTDE", &fault)).into()
        })
    }

    /// In version 1 a list of outputs has no frequency in front of it.
    fn request(&self, frame: &Frame) -> Result<Request, WireError> {
        if self.speaks_version_2 || frame.kind != OUTPUTS_KIND {
            return Request::from_frame(frame);
        }
        let payload = [&VERSION_1_HZ.to_be_bytes()[..], &frame.payload].concat();
        let kind = frame.kind;
        Request::from_frame(&Frame { kind, payload })
    }

    fn set_up_outputs(
        &mut self,
        frequency_hz: f64,
        names: &[String],
        rate_hz: f64,
    ) -> Result<Outcome, String> {
        check_names(names)?;
        let frequency_hz = if self.speaks_version_2 {
            frequency_hz
        } else {
            frequency_hz.min(rate_hz)
        };
        if !(1.0..=rate_hz).contains(&frequency_hz) {
            return Err(format!(
                "output frequency {frequency_hz} Hz; 1 to {rate_hz} Hz are possible"
            ));
        }
        let found: Vec<Option<OutputField>> = names
            .iter()
            .map(|name| OutputField::from_name(name))
            .collect();
        let fields = found
            .iter()
            .map(|field| match field {
                Some(field) => FieldReply::Type(field.field_type()),
                None => FieldReply::NotFound,
            })
            .collect();
        // One bad name spoils the recipe, and nothing is sent.
        let usable: Option<Vec<OutputField>> = found.into_iter().collect();
        let recipe = if usable.is_some() {
            OUTPUT_RECIPE
        } else {
            NO_RECIPE
        };
        let usable = usable.unwrap_or_default();
        self.outputs = Outputs {
            types: usable.iter().map(|field| field.field_type()).collect(),
            fields: usable,
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // 1 to the rate.
            every: (rate_hz / frequency_hz).floor() as u64,
        };
        Ok(Reply::Outputs { recipe, fields }.into())
    }

    fn set_up_inputs(&mut self, names: &[String], claims: &mut Claims) -> Result<Outcome, String> {
        check_names(names)?;
        let number = u8::try_from(self.inputs.len() + 1)
            .map_err(|_| "no more than 255 input recipes are possible".to_owned())?;
        let mut usable = Vec::with_capacity(names.len());
        let fields: Vec<FieldReply> = names
            .iter()
            .map(|name| {
                let Some(field) = InputField::from_name(name) else {
                    return FieldReply::NotFound;
                };
                if claims.get(&field).is_some_and(|owner| *owner != self.id) {
                    return FieldReply::InUse;
                }
                usable.push(field);
                FieldReply::Type(field.field_type())
            })
            .collect();
        if usable.len() < names.len() {
            let recipe = NO_RECIPE;
            return Ok(Reply::Inputs { recipe, fields }.into());
        }
        claims.extend(usable.iter().map(|field| (*field, self.id)));
        self.inputs.push(usable);
        let recipe = number;
        Ok(Reply::Inputs { recipe, fields }.into())
    }

    fn write(
        &self,
        recipe: u8,
        bytes: &[u8],
        controller: &mut Controller,
    ) -> Result<Outcome, String> {
        let fields = usize::from(recipe)
            .checked_sub(1)
            .and_then(|index| self.inputs.get(index))
            .ok_or_else(|| format!("there is no input recipe {recipe}"))?;
        let types: Vec<FieldType> = fields.iter().map(|field| field.field_type()).collect();
        let values = decode(&types, bytes).map_err(|error| error.to_string())?;
        if let Some(bad) = values.iter().position(|value| !value.is_finite()) {
            return Err(format!(
                "input {bad} of recipe {recipe} is not a finite number"
            ));
        }
        for (field, value) in fields.iter().zip(values) {
            controller.write_input(*field, value);
        }
        Ok(Outcome {
            reply: None,
            wrote_inputs: true,
        })
    }
}

fn check_names(names: &[String]) -> Result<(), String> {
    if names.is_empty() {
        return Err("the list of fields is empty".to_owned());
    }
    let commas = names.len() - 1;
    let size = names.iter().map(String::len).sum::<usize>() + commas;
    if size > MAX_NAMES_SIZE {
        return Err(format!(
            "the list of fields has {size} bytes; {MAX_NAMES_SIZE} are possible"
        ));
    }
    Ok(())
}
