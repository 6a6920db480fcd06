//! What goes over the wire.

use super::driving::{RATE, arm, at, curve, references, run};
use crate::stub::{Behaviour, Stub};
use conik_sim::arm::Arm;
use conik_ur::servoj::Servoj;

#[test]
fn references_arrive_in_order_and_bit_by_bit() {
    for byte_by_byte in [false, true] {
        let behaviour = Behaviour {
            byte_by_byte,
            ..Behaviour::default()
        };
        let q0 = behaviour.q;
        let count = if byte_by_byte { 50 } else { 2000 };
        let curve = curve(q0, count);
        let stub = Stub::start(behaviour);
        let mut arm = arm(&stub);
        assert_eq!(arm.start(RATE).unwrap(), q0.into());
        assert_eq!(run(&mut arm, &curve).unwrap(), 0, "missed cycles");
        arm.stop().unwrap();
        arm.stop().unwrap();
        let cycles = arm.cycle_times().unwrap().summary().unwrap();
        assert_eq!(cycles.answer_us.unwrap().count, u64::from(count));
        assert_eq!(cycles.period_us.count, u64::from(count) - 1);
        assert_eq!((cycles.missed, cycles.repeated), (0, 0));
        let written = stub.written();
        let arrived = references(&written);
        assert_eq!(arrived.len(), curve.len());
        for (number, (arrived, sent)) in (1..).zip(arrived.iter().zip(&curve)) {
            assert_eq!(arrived.counter, number);
            assert_eq!(arrived.q.map(f64::to_bits)[..], bits(&sent.q));
            assert_eq!(arrived.qd.map(f64::to_bits)[..], bits(&sent.qd));
            assert_eq!(arrived.servoj, [0.1, 300.0, 0.008]);
        }
        assert_eq!(written.last().unwrap().command, 2, "the last word is stop");
    }
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

#[test]
fn a_late_reader_takes_the_newest_package_and_counts_the_others() {
    let behaviour = Behaviour {
        packages_at_once: 3,
        ..Behaviour::default()
    };
    let q = behaviour.q;
    let stub = Stub::start(behaviour);
    let mut arm = arm(&stub);
    arm.start(RATE).unwrap();
    let before = arm.status().unwrap().timestamp;
    let mut missed = 0;
    let mut cycles = 0;
    let mut first = before;
    for turn in 0..20 {
        missed += arm.next_cycle().unwrap().missed_cycles;
        if turn == 0 {
            first = arm.status().unwrap().timestamp;
        } else {
            cycles += 1;
        }
        arm.send(&at(q)).unwrap();
    }
    // How many of the three are read at once is up to the network; none may go uncounted.
    let elapsed = arm.status().unwrap().timestamp - first;
    assert_eq!((elapsed * RATE).round(), (missed + cycles) as f64);
    let counted = arm.cycle_times().unwrap().summary().unwrap();
    assert_eq!(counted.missed, missed);
    drop(arm);
    stub.written();
}

#[test]
fn no_number_that_is_not_finite_goes_out() {
    for bad in [f64::NAN, f64::INFINITY] {
        let stub = Stub::start(Behaviour::default());
        let mut q = Behaviour::default().q;
        q[0] = bad;
        let mut arm = arm(&stub);
        arm.start(RATE).unwrap();
        let fault = run(&mut arm, &[at(q)]).unwrap_err();
        assert_eq!(fault.name, "reference-refused");
        drop(arm);
        assert!(stub.written().iter().all(|package| {
            package
                .q
                .iter()
                .chain(&package.qd)
                .all(|value| value.is_finite())
        }));
    }
}

#[test]
fn lookahead_and_gain_change_while_the_program_runs_and_never_leave_their_ranges() {
    let stub = Stub::start(Behaviour::default());
    let q = Behaviour::default().q;
    let mut arm = arm(&stub);
    arm.start(RATE).unwrap();
    run(&mut arm, &[at(q); 2]).unwrap();
    let changed = |lookahead_s, gain| Servoj { lookahead_s, gain };
    arm.set_servoj(changed(0.05, 900.0)).unwrap();
    run(&mut arm, &[at(q)]).unwrap();
    for (lookahead_s, gain, name) in [
        (0.02, 300.0, "lookahead"),
        (f64::NAN, 300.0, "lookahead"),
        (0.1, 2001.0, "gain"),
    ] {
        let refused = arm.set_servoj(changed(lookahead_s, gain)).unwrap_err();
        assert!(refused.to_string().contains(name), "{refused}");
    }
    run(&mut arm, &[at(q)]).unwrap();
    drop(arm);
    let written = stub.written();
    let sent = references(&written);
    let servoj: Vec<_> = sent.iter().map(|package| package.servoj).collect();
    let (before, after) = ([0.1, 300.0, 0.008], [0.05, 900.0, 0.008]);
    assert_eq!(servoj, [before, before, after, after]);
}
