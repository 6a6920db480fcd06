//! What a program finds around it: registers, joints, watchdogs, and someone who listens.

/// A kind of general-purpose register.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Register {
    /// 64-bit floats, 0 to 47.
    Float,
    /// 32-bit integers, 0 to 47.
    Integer,
    /// Bits, 0 to 127.
    Boolean,
}

/// A quantity of all joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joints {
    /// Measured [rad].
    ActualPositions,
    /// Commanded [rad].
    TargetPositions,
    /// Measured [rad/s].
    ActualSpeeds,
    /// Commanded [rad/s].
    TargetSpeeds,
}

/// What a watchdog does when an input stays away.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WatchdogAction {
    /// Nothing: the watchdog is off.
    Ignore,
    /// It pauses the program.
    Pause,
    /// It stops the program.
    Stop,
}

/// A controller, as a program sees it. Registers' contents travel as numbers: integers are exact,
/// and a bit is 0 or 1. Addresses are within the kind's range, and all numbers are finite.
pub trait Surroundings {
    /// An input register.
    fn input(&self, kind: Register, address: usize) -> f64;
    /// An output register.
    fn output(&self, kind: Register, address: usize) -> f64;
    /// Writes an output register.
    fn write_output(&mut self, kind: Register, address: usize, value: f64);
    /// A quantity of the six joints.
    fn joints(&self, which: Joints) -> [f64; 6];
    /// How long a control cycle is [s].
    fn cycle_s(&self) -> f64;
    /// Takes over the mass on the flange [kg].
    fn set_payload(&mut self, mass_kg: f64);
    /// Takes over the tool in the flange's frame: a point [m] and a rotation vector [rad].
    fn set_tcp(&mut self, pose: [f64; 6]);
    /// Sets the watchdog of an input; `false` if there is no such input.
    fn set_watchdog(&mut self, input: &str, least_hz: f64, action: WatchdogAction) -> bool;
    /// Hears what the program says.
    fn say(&mut self, line: &str);
}
