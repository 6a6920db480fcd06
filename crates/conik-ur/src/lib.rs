//! Universal Robots arms for Conik: wire formats, driver, and an emulated controller.
//!
//! ```text
//!   run loop (conik-sim)
//!        │ Arm: start, next_cycle, send, stop
//!   ┌────▼─────┐   references: input registers (RTDE)    ┌──────────────────────┐
//!   │  driver  ├────────────────────────────────────────►│ controller: real, or │
//!   │  UrArm   │◄────────────────────────────────────────┤ emulator (in-process)│
//!   └────┬─────┘   its package is the clock              │  runs servo.script   │
//!        │                                               └──────────────────────┘
//!   session     who says what when, over any byte stream
//!   wire        packages, recipes, values: bytes and back
//!   registers   which register carries what      program    the servo program's text
//!   status      what the controller's bits mean
//! ```
//!
//! **Transport.** The controller sends its state in every cycle. The driver answers each package
//! with one: `q_ref`, `qd_ref`, `servoj`'s parameters and a counter in input registers. A program of some ninety lines on
//! the controller ([`program`]) gives each new `q_ref` to `servoj`, bridges a few missing ones with
//! `qd_ref`, then stops the arm and ends. No port is opened on this computer.
//!
//! **Safety.** What must not be sent is refused with joint, value and limit, never clamped. Each
//! fault has a name ([`driver::fault`]) and is latched: nothing moves the arm until it is started
//! anew at the pose where it stands. Numbers that are not finite cannot be encoded.
//!
//! A run against the emulator, in lockstep, so that it takes milliseconds:
//!
//! ```
//! use conik::JointVec;
//! use conik_sim::arm::{Arm, Reference};
//! use conik_ur::driver::UrArm;
//! use conik_ur::emulator::{Emulator, EmulatorConfig, Pace, Series};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let q0 = JointVec::from([0.0, -1.5, 1.2, -0.4, 0.7, 0.0]);
//! let emulator = Emulator::start(EmulatorConfig {
//!     pace: Pace::Lockstep,
//!     ..EmulatorConfig::new(Series::Cb3, q0)
//! })?;
//!
//! let mut arm = UrArm::new(emulator.driver_config());
//! let mut q = arm.start(125.0)?;
//! let mut qd = JointVec::zeros(6);
//! qd[0] = 0.1; // [rad/s]
//! for _ in 0..250 {
//!     arm.next_cycle()?;
//!     q[0] += qd[0] / 125.0;
//!     arm.send(&Reference { q, qd, qdd: JointVec::zeros(6) })?;
//! }
//! arm.stop()?;
//! assert!(emulator.target_q()[0] > 0.18);
//! # Ok(())
//! # }
//! ```

pub mod driver;
pub mod emulator;
pub mod model;
pub mod program;
pub mod realtime;
pub mod registers;
pub mod servoj;
pub mod session;
pub mod status;
pub mod timing;
pub mod urscript;
pub mod wire;
