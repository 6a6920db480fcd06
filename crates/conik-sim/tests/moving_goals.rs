//! Targets, directions and desired values that move are followed without lag.
//!
//! With its rate fed forward a desired value is met at the end of every period, but for the second order
//! of that period's motion: T²/2 · q̇ᵀ∇²σ q̇ ≤ T²/2 · B (Σ|q̇|)². Of a disturbance d per tick a gain Λ
//! leaves d / (ΛT), so that following leaves at most T B (Σ|q̇|)² / (2Λ), with B the tool's reach [m] for
//! positions and 1, times a margin for what bends more, for angles.

use conik::Kinematics;
use conik_sim::experiment::Experiment;
use conik_sim::scenario::Scenario;

const GAIN: f64 = 4.0;
const UNTIL_S: f64 = 6.0;

fn experiment(task: &str, rate_hz: f64) -> Experiment {
    let text = format!(
        "[robot]\nmodel = \"ur5-paper\"\nq0_deg = [-48, -118, -98, -60, 75, 10]\n\
         [control]\nrate_hz = {rate_hz}\nduration_s = 12\n\
         [[task]]\nname = \"it\"\ngain_per_s = {GAIN}\nmoves_until_s = {UNTIL_S}\n{task}\n"
    );
    let scenario = Scenario::from_toml(&text).unwrap_or_else(|errors| panic!("{text}\n{errors}"));
    Experiment::new(&scenario).expect("sound")
}

/// What following a goal was like.
struct Followed {
    /// Greatest error while it moved, after 5.5 s, in which an error falls by e^(5.5 Λ) = 4e9.
    lag: f64,
    /// What the second order of the motion can leave of it.
    bound: f64,
    /// The error at the end, 6 s after the goal came to rest.
    last: f64,
}

fn follow(task: &str, rate_hz: f64, bending: f64) -> Followed {
    let mut experiment = experiment(task, rate_hz);
    let id = experiment.controller.stack().find("it").expect("there");
    let mut q = experiment.q0;
    let (mut lag, mut fastest, mut last) = (0.0_f64, 0.0_f64, f64::NAN);
    for tick in 0..=experiment.last_tick {
        let t_s = tick as f64 / rate_hz;
        experiment.move_world(t_s).expect("finite");
        let step = experiment.controller.step(&q).expect("finite");
        last = step.error_norm(id);
        if (5.5..=UNTIL_S).contains(&t_s) {
            lag = lag.max(last);
            fastest = fastest.max(step.qd.iter().map(|speed| speed.abs()).sum());
        }
        q = step.q_ref;
    }
    assert!(fastest > 0.01, "the arm follows: {fastest}");
    let bound = bending * fastest * fastest / (2.0 * GAIN * rate_hz);
    Followed { lag, bound, last }
}

fn reach() -> f64 {
    let experiment = experiment(
        "type = \"position\"\ntarget_m = [0, 0, 0]\nvelocity_m_per_s = [0, 0, 0]",
        125.0,
    );
    let mut kinematics = Kinematics::new(&experiment.robot);
    kinematics.update(&experiment.q0);
    kinematics.reach()
}

const PLACE: &str = "target_m = [0.35, -0.25, 0.2]\nvelocity_m_per_s = [0.02, 0.06, -0.01]";
const TURNING: &str = "desired_rpy_deg = [150, 10, 20]\nangular_velocity_deg_per_s = [3, -4, 10]";
const SWINGING: &str = "direction = [1, 0.2, -0.8]\nangular_velocity_deg_per_s = [0, 2, 12]";

#[test]
fn what_moves_is_followed_without_lag_and_met_where_it_comes_to_rest() {
    let metres = reach();
    // A distance or an angle bends the more the smaller it is; here they are at least a third.
    let bent = 4.0;
    for (task, bending) in [
        (format!("type = \"position\"\n{PLACE}"), metres),
        (format!("type = \"pose\"\n{PLACE}\n{TURNING}"), metres + 1.0),
        (format!("type = \"orientation\"\n{TURNING}"), 1.0),
        (
            format!("type = \"orientation_angle\"\n{TURNING}\ndesired = 0.5\ndesired_per_s = 0.02"),
            bent,
        ),
        (
            format!("type = \"field_of_view\"\n{SWINGING}\ndesired = 0.4\ndesired_per_s = -0.01"),
            bent,
        ),
        (
            format!("type = \"pointing_angle\"\n{SWINGING}\ndesired = 0.4\naxis = [0, 1, 1]"),
            bent,
        ),
        (
            "type = \"distance\"\npoint_m = [0, -0.7, 0.1]\nvelocity_m_per_s = [0.05, 0.02, 0.03]\n\
             desired = 0.4\ndesired_per_s = 0.02"
                .to_owned(),
            metres * bent,
        ),
        (
            "type = \"height\"\ndesired = 0.2\ndesired_per_s = 0.05".to_owned(),
            metres,
        ),
        (
            "type = \"elbow\"\nshoulder = \"link_1\"\nelbow = \"link_2\"\nwrist = \"link_5\"\n\
             direction = [0, 1, 0]\ndesired = 0.5\ndesired_per_s = 0.1"
                .to_owned(),
            bent,
        ),
    ] {
        let at_125_hz = follow(&task, 125.0, bending);
        let Followed { lag, bound, last } = at_125_hz;
        assert!(lag <= bound && bound < 3e-3, "{task}\n{lag:e} {bound:e}");
        assert!(last < 1e-9, "{task}\n{last:e}");
        // The second order and nothing else: what is left falls with the period.
        let faster = follow(&task, 500.0, bending).lag;
        assert!(faster < 0.3 * lag, "{task}\n{faster:e} {lag:e}");
    }
}

#[test]
fn a_joint_follows_exactly() {
    let task = "type = \"joint\"\njoint = 3\ndesired = -1.5\ndesired_per_s = 0.1\n\
                damping = \"none\"";
    let Followed { lag, last, .. } = follow(task, 125.0, 0.0);
    // A level's velocity falls short by 1e-6 of it, which keeps it small where directions are lost.
    let short = 1e-6 * 0.1 / GAIN;
    assert!(lag < 1.01 * short && last < 1e-14, "{lag:e} {last:e}");
}

#[test]
fn in_the_axes_of_a_link_a_target_moves_with_the_link() {
    let task = "type = \"position\"\nrelative_to = \"link_1\"\ntarget_m = [0.4, 0.3, 0.12]\n\
                velocity_m_per_s = [0.02, -0.03, 0]";
    let Followed { lag, bound, last } = follow(task, 125.0, reach());
    assert!(lag <= bound && last < 1e-9, "{lag:e} {bound:e} {last:e}");
}
