//! Priority and locked memory for the thread that answers the arm, where the system allows it.
//!
//! Neither makes a computer fit to drive an arm, and an arm is driven without them too: what they
//! spare is the wait behind other programs and for memory that was put aside. Both are asked for
//! through safe crates, and what was refused is said in words.

use std::fmt;

/// What the system granted to a thread.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Realtime {
    /// The thread goes before all others that are not real-time ones; or why not.
    pub priority: Result<(), String>,
    /// The program's memory stays where it is; or why not.
    pub memory: Result<(), String>,
}

/// Asks for the priority alone, for the thread that calls; or says why not.
pub fn first_in_line() -> Result<(), String> {
    system::first_in_line()
}

impl Realtime {
    /// Asks for both, for the thread that calls and the program that it belongs to.
    pub fn enter() -> Self {
        Self {
            priority: system::first_in_line(),
            memory: system::lock_memory(),
        }
    }

    /// Whether both were granted.
    pub fn is_granted(&self) -> bool {
        self.priority.is_ok() && self.memory.is_ok()
    }
}

impl fmt::Display for Realtime {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [
            ("real-time priority", &self.priority),
            ("locked memory", &self.memory),
        ];
        let words = parts.map(|(what, granted)| match granted {
            Ok(()) => what.to_owned(),
            Err(why) => format!("no {what} ({why})"),
        });
        write!(f, "{}", words.join(", "))
    }
}

#[cfg(unix)]
mod system {
    use rustix::mm::{MlockAllFlags, mlockall};
    use rustix::process::{Resource, getrlimit};
    use thread_priority::unix::{
        RealtimeThreadSchedulePolicy, ThreadSchedulePolicy, set_thread_priority_and_policy,
        thread_native_id,
    };
    use thread_priority::{ThreadPriority, ThreadPriorityValue};

    /// In percent of what the policy has: below the kernel's own most urgent work.
    const PRIORITY: u8 = 80;

    pub(super) fn first_in_line() -> Result<(), String> {
        let priority = ThreadPriorityValue::try_from(PRIORITY)?;
        set_thread_priority_and_policy(
            thread_native_id(),
            ThreadPriority::Crossplatform(priority),
            ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo),
        )
        .map_err(|_| {
            "not allowed; a line `@users - rtprio 90` in /etc/security/limits.conf would allow it"
                .to_owned()
        })
    }

    pub(super) fn lock_memory() -> Result<(), String> {
        // Where little may be locked, locking what comes later too would make it fail to come.
        let unlimited = getrlimit(Resource::Memlock).current.is_none();
        let flags = if unlimited {
            MlockAllFlags::CURRENT | MlockAllFlags::FUTURE
        } else {
            MlockAllFlags::CURRENT
        };
        mlockall(flags).map_err(|_| {
            "not allowed; a line `@users - memlock unlimited` in /etc/security/limits.conf would \
             allow it"
                .to_owned()
        })
    }
}

#[cfg(not(unix))]
mod system {
    const NOT_HERE: &str = "not on this system; a Linux kernel with PREEMPT_RT has it";

    pub(super) fn first_in_line() -> Result<(), String> {
        Err(NOT_HERE.to_owned())
    }

    pub(super) fn lock_memory() -> Result<(), String> {
        Err(NOT_HERE.to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_refused_is_said_with_its_reason() {
        let granted = Realtime {
            priority: Ok(()),
            memory: Ok(()),
        };
        assert_eq!(granted.to_string(), "real-time priority, locked memory");
        let half = Realtime {
            priority: Err("why".to_owned()),
            ..granted.clone()
        };
        assert_eq!(
            half.to_string(),
            "no real-time priority (why), locked memory"
        );
        assert!(granted.is_granted() && !half.is_granted());
    }
}
