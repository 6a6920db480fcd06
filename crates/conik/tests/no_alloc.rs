//! `step` never touches the heap, whatever the rule finds.

mod paper;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use conik::{
    Axis, Border, Capsule, Controller, Coordinate, Cuboid, Cylinder, DhRow, Distance, Elbow,
    FieldOfView, Frame, FramePose, HalfSpace, JacobianPart, JointLimits, JointPosition, JointSpeed,
    JointVec, LookAt, Manipulability, ModeRule, Orientation, OrientationAngle, Plane,
    PointingAngle, Pose, Position, Posture, Recursion, Robot, Settings, Shape, ShapeDistance,
    SmallestSingularValue, Stack, StackError, Vec3,
};
use paper::Example;

struct Counting;

thread_local! {
    /// Of this thread alone: the harness has threads of its own.
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

/// Counts nothing while a thread ends and its counter is gone.
fn count() {
    let _ = ALLOCATIONS.try_with(|allocations| allocations.set(allocations.get() + 1));
}

#[allow(
    unsafe_code,
    reason = "counting needs an allocator of its own; it only passes calls on"
)]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count();
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Every rule, border and recursion.
fn all_settings() -> Vec<Settings> {
    let mut all = Vec::new();
    for mode_rule in [ModeRule::Paper, ModeRule::Border, ModeRule::Cone] {
        for border in [Border::Freeze, Border::Land] {
            for recursion in [Recursion::Chiaverini, Recursion::SicilianoSlotine] {
                all.push(Settings {
                    mode_rule,
                    border,
                    recursion,
                    ..Settings::at_rate(125.0)
                });
            }
        }
    }
    all
}

/// Nine joints, two sets on each of them, walls and an obstacle, and four levels below, one of them a
/// set.
fn large(settings: Settings, limits: JointLimits) -> Controller {
    let rows: Vec<DhRow> = (0..9_u8)
        .map(|i| DhRow::new(0.15, f64::from(i % 3) - 1.0, 0.05))
        .collect();
    let robot = Robot::from_dh("nine", &rows).expect("sound");
    let robot = robot.with_limits(|_, _| limits).expect("sound");
    let mut stack = Stack::new(&robot);
    let mut fill = || -> Result<(), StackError> {
        for i in 0..9 {
            let joint = JointPosition::of(i);
            stack.set(&format!("range {i}"), joint, -0.2..=0.6)?;
        }
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            let wall = Coordinate::of_tool(axis);
            stack.set(&format!("wall {axis:?}"), wall, -0.7..=0.9)?;
        }
        stack.set("ball", Distance::of_tool_to([0.6, 0.1, 0.2]), 0.1..)?;
        let forearm = Capsule::new([0.0; 3], [0.15, 0.0, 0.0], 0.04);
        let crate_ = Cuboid::new(Pose::at(Vec3::new(0.5, -0.4, 0.5)), [0.2, 0.3, 0.1]);
        let can = Cylinder::new([0.3, 0.3, 0.0], [0.3, 0.3, 0.4], 0.1);
        let hand = Cuboid::new(Pose::IDENTITY, [0.05; 3]);
        let floor = HalfSpace::new([0.0, 0.0, -0.6], [0.0, 0.0, 1.0]);
        let forearm_to = |other: Shape| ShapeDistance::between(Frame::Link(7), forearm, other);
        stack.set("forearm/crate", forearm_to(crate_.into()), 0.01..)?;
        stack.set("forearm/can", forearm_to(can.into()), 0.01..)?;
        stack.set("forearm/floor", forearm_to(floor.into()), 0.01..)?;
        let hand_to_crate = ShapeDistance::between(Frame::Tool, hand, crate_);
        stack.set("hand/crate", hand_to_crate, 0.01..)?;
        let wrist = Cylinder::new([0.0; 3], [0.0, 0.0, 0.08], 0.04);
        for (name, other) in [
            ("wrist/crate", Shape::from(crate_)),
            ("wrist/can", can.into()),
        ] {
            let distance = ShapeDistance::between(Frame::Link(8), wrist, other);
            stack.set(name, distance, 0.01..)?;
        }
        let to_upper_arm =
            ShapeDistance::between(Frame::Tool, hand, forearm).relative_to(Frame::Link(3));
        stack.set("hand/arm", to_upper_arm, 0.01..)?;
        let view = FieldOfView::of_tool_along([0.2, 0.5, 1.0]);
        stack.equality("position", Position::of_tool(), &[0.5, -0.4, 0.5], 1.0)?;
        stack.set_with_gain("view", view, ..=0.5, 1.0)?;
        stack.equality("turn", view, &[0.1], 1.0)?;
        stack.equality("posture", JointPosition::of(2), &[0.9], 1.0)?;
        Ok(())
    };
    fill().expect("a sound stack");
    Controller::new(&robot, stack, settings).expect("sound settings")
}

/// Nine joints and every other type of task, as sets and as levels, some of them moving.
fn of_all_types(settings: Settings) -> Controller {
    let rows: Vec<DhRow> = (0..9_u8)
        .map(|i| DhRow::new(0.15, f64::from(i % 3) - 1.0, 0.05))
        .collect();
    let robot = Robot::from_dh("nine", &rows).expect("sound");
    let mut stack = Stack::new(&robot);
    let desired = Pose::turned(Vec3::new(0.9, -0.4, 0.3));
    let arm = [Frame::Link(2), Frame::Link(5), Frame::Tool];
    let mut fill = || -> Result<(), StackError> {
        let seen = Plane::of_tool_to([0.1, 0.3, 1.0], 0.2).relative_to(Frame::Link(2));
        stack.set("plane", seen, ..=0.1)?;
        let pointing = PointingAngle::of_tool_along([0.2, 0.5, 1.0]);
        stack.set("pointing", pointing, ..=1.0)?;
        let mut look = LookAt::of_tool_at([0.6, 0.1, 0.2]);
        look.set_point_moving([0.6, 0.1, 0.2], [0.01, 0.0, 0.0]);
        stack.set("look", look, ..=1.0)?;
        stack.set("angle", OrientationAngle::of_tool_to(desired), ..=1.5)?;
        let manipulability = Manipulability::of_tool(JacobianPart::Pose);
        stack.set("manipulability", manipulability, 1e-4..)?;
        let smallest = SmallestSingularValue::of_tool(JacobianPart::Position);
        stack.set("smallest", smallest, 0.1..)?;
        stack.equality("orientation", Orientation::of_tool(desired), &[0.0; 3], 1.0)?;
        let elbow = Elbow::of(arm, [0.0, 0.0, 1.0]);
        stack.equality("elbow", elbow, &[0.5], 1.0)?;
        stack.equality("pose", FramePose::of_tool(desired), &[0.0; 6], 1.0)?;
        stack.equality("speed", JointSpeed::of(0, 0.1), &[0.0], 1.0)?;
        let posture = Posture::of_all(&robot);
        stack.equality("posture", posture, &[0.9; 9], 1.0)?;
        Ok(())
    };
    fill().expect("a sound stack");
    Controller::new(&robot, stack, settings).expect("sound settings")
}

fn allocations() -> u64 {
    ALLOCATIONS.get()
}

/// Ticks of an example, bad input included. The most sets that were active at once.
fn run_example(number: u8, settings: Settings) -> usize {
    let mut example = Example::new(number, paper::thesis(), settings);
    let before = allocations();
    let mut most_active = 0;
    for _ in 0..2000 {
        most_active = most_active.max(example.tick().active.len());
    }
    // Bad input takes its own way out.
    assert!(example.controller.step(&[f64::NAN; 6]).is_err());
    assert!(example.controller.step(&[0.0; 5]).is_err());
    assert_eq!(allocations(), before, "example {number}, {settings:?}");
    most_active
}

/// The same for a stack of nine joints.
fn run_large(mut controller: Controller, settings: Settings) -> usize {
    let mut q = JointVec::zeros(9);
    let before = allocations();
    let mut most_active = 0;
    for _ in 0..100 {
        controller.step(&q).expect("finite");
        let step = controller.measure();
        most_active = most_active.max(step.active.len());
        q = step.q_ref;
    }
    assert_eq!(allocations(), before, "nine joints, {settings:?}");
    most_active
}

/// Ticks of the examples under these settings.
fn run_examples(settings: Settings) {
    for number in 1..=3 {
        assert!(run_example(number, settings) >= 1, "sets were active");
    }
    let before = allocations();
    drop(std::hint::black_box(Box::new(1)));
    assert!(allocations() > before, "the counter counts");
}

/// Large stacks, and how many sets are active in them at least.
fn large_stacks(settings: Settings) -> Vec<(Controller, usize)> {
    let unlimited = JointLimits::default();
    let limited = JointLimits {
        speed: Some(2.0),
        acceleration: Some(20.0),
        position: None,
    };
    let mut on_demand = large(settings, unlimited);
    on_demand.measure_on_demand();
    let mut controllers = vec![
        (large(settings, unlimited), 2),
        (on_demand, 2),
        (of_all_types(settings), 1),
    ];
    if settings.mode_rule == ModeRule::Cone {
        controllers.push((large(settings, limited), 1));
    }
    controllers
}

/// Each thread counts its own.
#[test]
fn no_tick_allocates() {
    std::thread::scope(|scope| {
        for settings in all_settings() {
            scope.spawn(move || run_examples(settings));
            for (controller, least) in large_stacks(settings) {
                scope.spawn(move || {
                    let active = run_large(controller, settings);
                    assert!(active >= least, "{active} sets were active, {settings:?}");
                });
            }
        }
    });
}
