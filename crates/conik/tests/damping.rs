//! Damping, task by task: none, fixed, by the smallest singular value, per singular direction.

use conik::{
    Border, Controller, Damping, Frame, JointLimits, JointVec, Kinematics, ModeRule, Position,
    Reason, Recursion, Robot, Settings, Stack, StackErrorReason, Vec3,
};
use nalgebra::{DVector, Matrix3xX};

/// Nearly stretched: there is a direction in which the tool can hardly move.
struct Stretched {
    q: [f64; 6],
    lost: Vec3,
    /// A direction in which it moves freely.
    free: Vec3,
}

fn position_jacobian(kinematics: &Kinematics) -> Matrix3xX<f64> {
    let mut jacobian = Matrix3xX::zeros(6);
    for (i, axis) in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        .into_iter()
        .enumerate()
    {
        let mut row = [0.0; 6];
        let (motion, tool) = (
            kinematics.motion(Frame::Tool),
            kinematics.world_from(Frame::Tool).origin,
        );
        kinematics.point_row(motion, tool, axis.into(), &mut row);
        jacobian.row_mut(i).copy_from_slice(&row);
    }
    jacobian
}

/// The arm with its elbow nearly straight, and the wrist at the most singular of a grid of angles.
fn stretched() -> Stretched {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let mut kinematics = Kinematics::new(&robot);
    let angles = || (0..60).map(|k| f64::from(k) * std::f64::consts::TAU / 60.0);
    let grid = angles().flat_map(|a| angles().map(move |b| [0.3, -0.9, 0.1, a, b, 0.2]));
    let (_, q) = grid
        .map(|q| {
            kinematics.update(&q);
            (
                position_jacobian(&kinematics)
                    .svd(false, false)
                    .singular_values
                    .min(),
                q,
            )
        })
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .expect("a grid");
    kinematics.update(&q);
    let svd = position_jacobian(&kinematics).svd(true, false);
    let directions = svd.u.expect("asked for");
    let column = |k: usize| Vec3::new(directions[(0, k)], directions[(1, k)], directions[(2, k)]);
    let (least, greatest) = (svd.singular_values.imin(), svd.singular_values.imax());
    assert!(svd.singular_values[least] < 0.05 && svd.singular_values[greatest] > 0.5);
    Stretched {
        q,
        lost: column(least),
        free: column(greatest),
    }
}

fn rules() -> impl Iterator<Item = Settings> {
    let rules = [
        (ModeRule::Paper, Border::Freeze),
        (ModeRule::Border, Border::Freeze),
        (ModeRule::Cone, Border::Land),
    ];
    let recursions = [Recursion::Chiaverini, Recursion::SicilianoSlotine];
    rules.into_iter().flat_map(move |(mode_rule, border)| {
        recursions.map(|recursion| Settings {
            mode_rule,
            border,
            recursion,
            ..Settings::at_rate(125.0)
        })
    })
}

/// The first tick of a tool that is to move by `way` from the stretched arm, gain 1/s. The arm has no
/// speed limits, so that nothing but damping slows it down.
fn first_tick(settings: Settings, damping: Damping, way: Vec3) -> (JointVec, Vec<Reason>, Vec3) {
    let ur5 = Robot::builtin("ur5-paper").expect("built in");
    let unlimited = ur5.with_limits(|_, _| JointLimits::default());
    let robot = unlimited.expect("sound");
    let Stretched { q, .. } = stretched();
    let mut kinematics = Kinematics::new(&robot);
    kinematics.update(&q);
    let here = kinematics.world_from(Frame::Tool).origin;
    let mut stack = Stack::new(&robot);
    let task = stack
        .equality(
            "position",
            Position::of_tool(),
            &(here + way).to_array(),
            1.0,
        )
        .expect("sound");
    stack.setpoints().set_damping(task, damping).expect("sound");
    let mut controller = Controller::new(&robot, stack, settings).expect("sound");
    let step = controller.step(&q).expect("finite").clone();
    let velocity = position_jacobian(&kinematics) * DVector::from_column_slice(&step.qd);
    let velocity = Vec3::new(velocity[0], velocity[1], velocity[2]);
    (step.qd, step.reasons().to_vec(), velocity)
}

fn norm(qd: &[f64]) -> f64 {
    qd.iter().map(|v| v * v).sum::<f64>().sqrt()
}

#[test]
fn without_damping_the_task_is_carried_out_whatever_it_costs() {
    let Stretched { lost, .. } = stretched();
    for settings in rules() {
        let (qd, _, velocity) = first_tick(settings, Damping::None, lost * 0.1);
        assert!(
            (velocity - lost * 0.1).norm() < 0.01,
            "{settings:?}: {velocity:?}"
        );
        let (damped, _, _) = first_tick(settings, Damping::PerDirection, lost * 0.1);
        assert!(norm(&damped) < 0.9 * norm(&qd), "{settings:?}");
    }
}

#[test]
fn fixed_damping_bounds_the_velocity_by_half_of_what_is_asked_over_lambda() {
    let Stretched { lost, free, .. } = stretched();
    for settings in rules() {
        for lambda in [0.05, 0.5] {
            for way in [lost, free] {
                let (qd, _, _) = first_tick(settings, Damping::Fixed(lambda), way * 0.1);
                assert!(norm(&qd) <= 0.1 / (2.0 * lambda) + 1e-12);
            }
        }
        // And it slows down what needs none.
        let (_, _, velocity) = first_tick(settings, Damping::Fixed(0.5), free * 0.1);
        assert!(velocity.dot(free) < 0.09, "{settings:?}");
    }
}

#[test]
fn a_direction_that_is_lost_does_not_slow_down_the_others() {
    let Stretched { free, .. } = stretched();
    for settings in rules() {
        let tick = |damping| first_tick(settings, damping, free * 0.4).2.dot(free);
        let (per_direction, smallest) = (tick(Damping::PerDirection), tick(Damping::Smallest));
        assert!(
            (per_direction - 0.4).abs() < 1e-3,
            "{settings:?}: {per_direction}"
        );
        assert!(smallest < per_direction - 1e-4, "{settings:?}: {smallest}");
    }
}

#[test]
fn a_level_that_loses_a_direction_says_so() {
    let Stretched { lost, .. } = stretched();
    for settings in rules() {
        let (_, reasons, _) = first_tick(settings, Damping::PerDirection, lost * 0.1);
        let lost = reasons.iter().find_map(|reason| match *reason {
            Reason::LosesRank { directions, .. } => Some(directions),
            _ => None,
        });
        assert!(
            lost.is_some_and(|directions| (1..=3).contains(&directions)),
            "{settings:?}"
        );
    }
}

#[test]
fn a_level_far_from_singularities_has_lost_nothing() {
    let bent = [-0.84, -2.76, -1.88, -1.57, -1.48, 0.0];
    for settings in rules() {
        let robot = Robot::builtin("ur5-paper").expect("built in");
        let mut stack = Stack::new(&robot);
        stack
            .equality("position", Position::of_tool(), &[0.5, 0.0, 0.0], 0.1)
            .expect("sound");
        stack
            .equality("joint", conik::JointPosition::of(3), &[0.0], 0.1)
            .expect("sound");
        let mut controller = Controller::new(&robot, stack, settings).expect("sound");
        // What was lost at the stretched arm is no longer lost at the bent one.
        for (q, is_lost) in [(stretched().q, true), (bent, false)] {
            let step = controller.step(&q).expect("finite");
            let says_so = step
                .reasons()
                .iter()
                .any(|reason| matches!(reason, Reason::LosesRank { .. }));
            let is_paper =
                settings.recursion == Recursion::Chiaverini && settings.mode_rule != ModeRule::Cone;
            assert!(says_so == is_lost || (is_paper && !says_so), "{settings:?}");
        }
    }
}

#[test]
fn a_damping_that_is_no_number_is_refused() {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let mut stack = Stack::new(&robot);
    let task = stack
        .equality("position", Position::of_tool(), &[0.3, 0.3, 0.3], 1.0)
        .expect("sound");
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        let error = stack.setpoints().set_damping(task, Damping::Fixed(bad));
        let reason = error.expect_err("no damping").reason;
        assert!(matches!(reason, StackErrorReason::BadDamping(_)));
    }
}
