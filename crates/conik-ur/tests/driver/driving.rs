//! How the tests drive an arm.

use crate::stub::{Stub, Written};
use conik::JointVec;
use conik_sim::arm::{Arm, ArmError, Reference};
use conik_ur::driver::{UrArm, UrConfig};
use std::time::Duration;

pub const RATE: f64 = 125.0;

/// A guard against hanging only; no verdict depends on it.
pub const HANG: Duration = Duration::from_secs(20);

/// What the driver lets pass without a reference [s]: more than this computer ever stalls.
pub const BRIDGED: f64 = 4.5;

pub fn arm(stub: &Stub) -> UrArm {
    UrArm::new(config(stub))
}

pub fn config(stub: &Stub) -> UrConfig {
    UrConfig {
        rtde_port: stub.rtde_port,
        script_port: stub.script_port,
        // Nobody listens there.
        dashboard_port: 1,
        link_timeout: HANG,
        program_timeout: HANG,
        stop_timeout: HANG,
        in_use_patience: Duration::ZERO,
        extrapolate_s: BRIDGED,
        ..UrConfig::new("127.0.0.1")
    }
}

pub fn at(q: [f64; 6]) -> Reference {
    Reference {
        q: q.into(),
        qd: JointVec::zeros(6),
        qdd: JointVec::zeros(6),
    }
}

/// References on a curve with irrational values, so that every bit of them counts.
pub fn curve(q0: [f64; 6], count: u32) -> Vec<Reference> {
    let value =
        |tick: f64, joint: usize| q0[joint] + 0.05 * (0.05 * tick * (joint + 1) as f64).sin();
    (0..count)
        .map(|tick| {
            let tick = f64::from(tick);
            Reference {
                q: std::array::from_fn::<_, 6, _>(|joint| value(tick, joint)).into(),
                qd: std::array::from_fn::<_, 6, _>(|joint| {
                    RATE * (value(tick + 0.5, joint) - value(tick - 0.5, joint))
                })
                .into(),
                qdd: JointVec::zeros(6),
            }
        })
        .collect()
}

pub fn run(arm: &mut UrArm, references: &[Reference]) -> Result<u64, ArmError> {
    let mut missed = 0;
    for reference in references {
        missed += arm.next_cycle()?.missed_cycles;
        arm.send(reference)?;
    }
    Ok(missed)
}

/// The references among what was written.
pub fn references(written: &[Written]) -> Vec<&Written> {
    written
        .iter()
        .filter(|package| package.command == 1)
        .collect()
}
