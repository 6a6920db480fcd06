//! The controller's own functions, as far as they are emulated: names and parameters.

use super::surroundings::{Joints, Register};

/// A function of the controller.
#[derive(Clone, Copy, Debug)]
pub(super) enum Builtin {
    ReadInput(Register),
    ReadOutput(Register),
    WriteOutput(Register),
    Sleep,
    Sync,
    Servoj,
    Stopj,
    SetPayload,
    SetTcp,
    SetWatchdog,
    Joints(Joints),
    IsSteady,
    CycleTime,
    TextMessage,
    Popup,
    /// A number of numbers, by its name.
    Math(fn(&[f64]) -> f64),
    Round(fn(f64) -> f64),
    Abs,
    Norm,
    Length,
    ToText,
    Join,
}

/// How a function is called.
#[derive(Debug)]
pub(super) struct Signature {
    pub(super) name: &'static str,
    pub(super) builtin: Builtin,
    pub(super) required: &'static [&'static str],
    /// May be left out.
    pub(super) optional: &'static [&'static str],
    /// Control cycles pass in it.
    pub(super) takes_time: bool,
}

const fn quick(
    name: &'static str,
    builtin: Builtin,
    required: &'static [&'static str],
) -> Signature {
    Signature {
        name,
        builtin,
        required,
        optional: &[],
        takes_time: false,
    }
}

/// Every function.
const SIGNATURES: &[Signature] = &[
    quick(
        "read_input_float_register",
        Builtin::ReadInput(Register::Float),
        &["address"],
    ),
    quick(
        "read_input_integer_register",
        Builtin::ReadInput(Register::Integer),
        &["address"],
    ),
    quick(
        "read_input_boolean_register",
        Builtin::ReadInput(Register::Boolean),
        &["address"],
    ),
    quick(
        "read_output_float_register",
        Builtin::ReadOutput(Register::Float),
        &["address"],
    ),
    quick(
        "read_output_integer_register",
        Builtin::ReadOutput(Register::Integer),
        &["address"],
    ),
    quick(
        "read_output_boolean_register",
        Builtin::ReadOutput(Register::Boolean),
        &["address"],
    ),
    quick(
        "write_output_float_register",
        Builtin::WriteOutput(Register::Float),
        ADDRESS_VALUE,
    ),
    quick(
        "write_output_integer_register",
        Builtin::WriteOutput(Register::Integer),
        ADDRESS_VALUE,
    ),
    quick(
        "write_output_boolean_register",
        Builtin::WriteOutput(Register::Boolean),
        ADDRESS_VALUE,
    ),
    Signature {
        takes_time: true,
        ..quick("sleep", Builtin::Sleep, &["t"])
    },
    Signature {
        takes_time: true,
        ..quick("sync", Builtin::Sync, &[])
    },
    Signature {
        takes_time: true,
        optional: &["a", "v", "t", "lookahead_time", "gain"],
        ..quick("servoj", Builtin::Servoj, &["q"])
    },
    Signature {
        takes_time: true,
        ..quick("stopj", Builtin::Stopj, &["a"])
    },
    Signature {
        optional: &["cog"],
        ..quick("set_payload", Builtin::SetPayload, &["m"])
    },
    quick("set_tcp", Builtin::SetTcp, &["pose"]),
    Signature {
        optional: &["action"],
        ..quick(
            "rtde_set_watchdog",
            Builtin::SetWatchdog,
            &["variable_name", "min_frequency"],
        )
    },
    quick(
        "get_actual_joint_positions",
        Builtin::Joints(Joints::ActualPositions),
        &[],
    ),
    quick(
        "get_target_joint_positions",
        Builtin::Joints(Joints::TargetPositions),
        &[],
    ),
    quick(
        "get_actual_joint_speeds",
        Builtin::Joints(Joints::ActualSpeeds),
        &[],
    ),
    quick(
        "get_target_joint_speeds",
        Builtin::Joints(Joints::TargetSpeeds),
        &[],
    ),
    quick("is_steady", Builtin::IsSteady, &[]),
    quick("get_steptime", Builtin::CycleTime, &[]),
    Signature {
        optional: &["s2"],
        ..quick("textmsg", Builtin::TextMessage, &["s1"])
    },
    Signature {
        optional: &["title", "warning", "error", "blocking"],
        ..quick("popup", Builtin::Popup, &["s"])
    },
    quick("sqrt", Builtin::Math(|x| x[0].sqrt()), &["f"]),
    quick("sin", Builtin::Math(|x| x[0].sin()), &["f"]),
    quick("cos", Builtin::Math(|x| x[0].cos()), &["f"]),
    quick("tan", Builtin::Math(|x| x[0].tan()), &["f"]),
    quick("asin", Builtin::Math(|x| x[0].asin()), &["f"]),
    quick("acos", Builtin::Math(|x| x[0].acos()), &["f"]),
    quick("atan", Builtin::Math(|x| x[0].atan()), &["f"]),
    quick("atan2", Builtin::Math(|x| x[0].atan2(x[1])), &["x", "y"]),
    quick(
        "pow",
        Builtin::Math(|x| x[0].powf(x[1])),
        &["base", "exponent"],
    ),
    quick("log", Builtin::Math(|x| x[1].log(x[0])), &["b", "f"]),
    quick("d2r", Builtin::Math(|x| x[0].to_radians()), &["d"]),
    quick("r2d", Builtin::Math(|x| x[0].to_degrees()), &["r"]),
    quick("floor", Builtin::Round(f64::floor), &["f"]),
    quick("ceil", Builtin::Round(f64::ceil), &["f"]),
    quick("abs", Builtin::Abs, &["f"]),
    quick("norm", Builtin::Norm, &["a"]),
    quick("length", Builtin::Length, &["v"]),
    quick("get_list_length", Builtin::Length, &["v"]),
    quick("to_str", Builtin::ToText, &["val"]),
    quick("str_cat", Builtin::Join, &["op1", "op2"]),
];

const ADDRESS_VALUE: &[&str] = &["address", "value"];

impl Signature {
    /// The function of this name.
    pub(super) fn find(name: &str) -> Option<&'static Self> {
        SIGNATURES.iter().find(|signature| signature.name == name)
    }

    /// Names of the parameters, the optional ones last.
    pub(super) fn parameters(&self) -> impl Iterator<Item = &'static str> + Clone {
        self.required.iter().chain(self.optional).copied()
    }
}
