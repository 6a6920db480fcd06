//! The course of one scene: what was asked, and every change of mode.

use conik::{ActiveSet, StackError};

use crate::chain::{minus, norm};
use crate::combo::Combo;
use crate::run;
use crate::scene::Scene;
use crate::table;

/// Lines between changes of mode, about so many in a run.
const LINES: usize = 64;

/// Prints every tick of a stretch of this length, where one is asked for.
const STRETCH: usize = 40;

pub fn print(
    seed: u64,
    index: u64,
    combo: Combo,
    from_tick: Option<usize>,
) -> Result<(), StackError> {
    let scene = Scene::random(seed, index);
    println!("{combo}, scene {index} of seed {seed}: {scene:?}");
    let names = |active: &ActiveSet| -> String {
        let numbers: Vec<String> = active.iter().map(|task| task.index().to_string()).collect();
        format!("[{}]", numbers.join(" "))
    };
    let every = (scene.ticks() / LINES).max(1);
    let mut before = ActiveSet::EMPTY;
    let outcome = run::run(
        &scene,
        combo.settings(scene.rate_hz),
        |tick, chain, step| {
            let is_asked = match from_tick {
                Some(from) => (from..from + STRETCH).contains(&tick),
                None => tick % every == 0 || step.active != before,
            };
            if is_asked {
                let insides: Vec<String> = scene
                    .high
                    .iter()
                    .map(|set| format!("{:9.2e}", -set.outside(chain.value(set.measure))))
                    .collect();
                let angles: Vec<String> = step.q_ref.iter().map(|v| format!("{v:7.4}")).collect();
                let qd: Vec<String> = step.qd.iter().map(|v| format!("{v:9.5}")).collect();
                let target = scene
                    .waypoints
                    .iter()
                    .map(|w| format!("{:.4}", norm(minus(*w, chain.tool()))))
                    .collect::<Vec<_>>()
                    .join(" ");
                println!(
                    "{:8.3} s {:12} inside [{}] to waypoints {target} q [{}] qd [{}] {}+{}+{}",
                    tick as f64 / scene.rate_hz,
                    names(&step.active),
                    insides.join(" "),
                    angles.join(" "),
                    qd.join(" "),
                    step.landed.kinematics,
                    step.landed.corrections,
                    step.landed.halvings,
                );
            }
            before = step.active;
        },
    )?;
    println!("violations {:?}", outcome.violations);
    println!(
        "mode changes {}, late {}, at rest {}; reversals {}, late swings {}; final speed {:.2e}, error {:.5}, could fall {:.3e} m/rad",
        outcome.mode_changes,
        outcome.late_changes,
        outcome.changes_at_rest,
        outcome.reversals,
        outcome.late_swings,
        outcome.final_speed,
        outcome.final_error,
        outcome.could_fall,
    );
    println!(
        "{}",
        table::complaint(&scene, &outcome).unwrap_or("as it should be".into())
    );
    Ok(())
}
