//! What the monitor says of sets of low priority.

use conik::{Controller, JointPosition, Monitor, Robot, Settings, Stack};

#[test]
fn set_that_was_never_entered_was_worst_where_it_began() {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let mut stack = Stack::new(&robot);
    let held = JointPosition::of(0);
    stack.equality("held", held, &[0.2], 1.0).expect("sound");
    let (far, border, gain) = (1.0, 0.5, 1.0);
    let set = stack
        .set_with_gain("set", JointPosition::of(1), ..=border, gain)
        .expect("sound");
    let settings = Settings::at_rate(100.0);
    let mut controller = Controller::new(&robot, stack, settings).expect("sound");
    let mut monitor = Monitor::new(controller.stack());
    let mut q = vec![0.2, far, 0.3, 0.4, 0.5, 0.6];
    for tick in 0..200 {
        let step = controller.step(&q).expect("finite").clone();
        monitor.observe(controller.stack(), &step, f64::from(tick) / 100.0);
        q = step.q_ref.to_vec();
    }
    let excess = monitor.properties(controller.stack()).low_priority_excess;
    assert_eq!(excess.task, Some(set));
    assert!((excess.worst - (far - border)).abs() < 1e-12, "{excess:?}");
    assert_eq!(excess.at_s, Some(0.0), "on its way in ever since");
}
