//! What a URDF file is to Conik: `describe FILE [--base LINK] [--tool LINK]... [--poses]`.
//!
//! With `--poses` it reads configurations from standard input, one a line, and prints for each the
//! homogeneous matrix of every link, row by row.

use std::io::{self, BufRead};
use std::process::ExitCode;

use conik::{Frame, Kinematics};
use conik_urdf::{Options, read};

fn main() -> ExitCode {
    match describe() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn describe() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let (mut file, mut options, mut poses) = (None, Options::default(), false);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--base" => options.base = arguments.next(),
            "--tool" => options.tools.extend(arguments.next()),
            "--poses" => poses = true,
            _ => file = Some(argument),
        }
    }
    let file = file.ok_or("usage: describe FILE [--base LINK] [--tool LINK]... [--poses]")?;
    let text = std::fs::read_to_string(&file).map_err(|error| format!("{file}: {error}"))?;
    let described = read(&text, &options).map_err(|error| format!("{file}: {error}"))?;
    let robot = described.robot;
    println!("robot {}, tool {}", robot.name(), robot.tool_name());
    for (joint, effort) in robot.joints().iter().zip(described.efforts) {
        let limits = joint.limits;
        println!(
            "joint {} {:?} position {:?} speed {:?} effort {effort:?}",
            joint.name, joint.kind, limits.position, limits.speed
        );
    }
    for note in described.notes {
        println!("note {note}");
    }
    if poses {
        let mut kinematics = Kinematics::new(&robot);
        for line in io::stdin().lock().lines() {
            let q: Result<Vec<f64>, _> = line?.split_whitespace().map(str::parse).collect();
            let q = q?;
            if q.len() != robot.dof() {
                return Err(format!("expected {} positions", robot.dof()).into());
            }
            kinematics.update(&q);
            for (link, name) in robot.link_names().enumerate() {
                let matrix = kinematics.world_from(Frame::Link(link)).to_matrix();
                let entries: Vec<String> = matrix.iter().flatten().map(f64::to_string).collect();
                println!("link\t{name}\t{}", entries.join(" "));
            }
        }
    }
    Ok(())
}
