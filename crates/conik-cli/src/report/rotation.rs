//! Turning the path by hand: the scene as data beside the static picture, and a small script.
//!
//! Without the script the page lacks nothing but this.

use std::fmt::Write;

use conik::{Shape, Vec3};

use crate::figure::camera::Vector;
use crate::figure::obstacles::{Cell, Obstacle, Wall};
use crate::figure::scene::Scene;
use crate::figure::{Run, path, shading, solid, wall};

/// What turns it.
pub const SCRIPT: &str = include_str!("rotate.js");

/// The scene as data that the script reads, for a picture of that size [px].
pub fn scene(run: &Run, width: f64, height: f64) -> String {
    let scene = Scene::of(run);
    let (azimuth_deg, elevation_deg) = path::view_deg(&scene);
    let path: Vec<String> = scene
        .path
        .iter()
        .map(|piece| {
            let mode = &run.modes()[piece.mode];
            let wide = u8::from(!mode.active.is_empty());
            let points = piece
                .points
                .iter()
                .map(vector)
                .collect::<Vec<_>>()
                .join(",");
            format!("[\"{}\",{wide},[{points}]]", mode.colour)
        })
        .collect();
    let around = &scene.around;
    let solids: Vec<String> = around.obstacles.iter().map(solid_of).collect();
    let walls: Vec<String> = around.walls.iter().map(|it| wall_of(it, &scene)).collect();
    let bounds: Vec<String> = around
        .bounds
        .iter()
        .map(|bound| format!("[{},{:.5}]", vector(&bound.centre), bound.radius))
        .collect();
    let cells: Vec<String> = around
        .cells
        .iter()
        .flat_map(Cell::edges)
        .map(|[from, to]| format!("[{},{}]", vector(&from), vector(&to)))
        .collect();
    let sights: Vec<String> = around
        .sights
        .iter()
        .map(|sight| format!("[{},{}]", vector(&sight.from), vector(&sight.to)))
        .collect();
    let targets: Vec<String> = scene
        .targets
        .iter()
        .map(|target| {
            let (to, from) = (vector(&target.point), vector(&target.from));
            format!("[{to},{:.5},{from}]", target.acceptance)
        })
        .collect();
    let mut data = String::new();
    // Writing to a string cannot fail. Numbers and colours only: nothing here needs escaping.
    let _ = write!(
        data,
        "<script type=\"application/json\" id=\"scene\">{{\"size\":[{width},{height}],\
         \"view\":[{azimuth_deg},{elevation_deg}],\"low\":{},\"high\":{},\"step\":{},\
         \"base\":{},\"path\":[{}],\"solids\":[{}],\"walls\":[{}],\"bounds\":[{}],\"cells\":[{}],\"sights\":[{}],\
         \"targets\":[{}]}}</script>",
        vector(&scene.low),
        vector(&scene.high),
        scene.step,
        scene.shows_base,
        path.join(","),
        solids.join(","),
        walls.join(","),
        bounds.join(","),
        cells.join(","),
        sights.join(","),
        targets.join(","),
    );
    data
}

/// Kind, gradient, colours of filling and edge, radius, points, and how it moved.
fn solid_of(obstacle: &Obstacle) -> String {
    let shape = &obstacle.shape;
    let (kind, radius, points) = match shape {
        Shape::Sphere(sphere) => ("ball", sphere.radius(), vec![sphere.center().to_array()]),
        Shape::Capsule(capsule) => {
            let ends = capsule.ends().map(Vec3::to_array);
            ("capsule", capsule.radius(), ends.to_vec())
        }
        Shape::Cuboid(_) => {
            let corners = solid::corners(shape).into_iter();
            ("box", 0.0, corners.map(Vec3::to_array).collect())
        }
        // Two rings, one after the other.
        _ => ("cylinder", 0.0, solid::rim(shape, Vec3::ZERO, Vec3::ZERO)),
    };
    let points: Vec<String> = points.iter().map(vector).collect();
    let moved = obstacle.moved.as_ref().map_or("null".to_owned(), vector);
    let (gradient, plain) = (&obstacle.tint[1..], shading::mix(obstacle.tint, 0.5));
    let edge = shading::mix(obstacle.tint, -0.35);
    format!(
        "[\"{kind}\",\"{gradient}\",\"{plain}\",\"{edge}\",{radius:.5},[{}],{moved}]",
        points.join(",")
    )
}

/// Colours, the direction of the side that is allowed, and the corners within the scene.
fn wall_of(it: &Wall, scene: &Scene) -> String {
    let corners = wall::piece(it, scene).into_iter();
    let corners: Vec<String> = corners.map(|corner| vector(&corner.to_array())).collect();
    format!(
        "[\"{}\",\"{}\",{},[{}]]",
        shading::mix(it.tint, 0.35),
        shading::mix(it.tint, -0.2),
        vector(&it.normal.to_array()),
        corners.join(",")
    )
}

fn vector(v: &Vector) -> String {
    format!("[{:.5},{:.5},{:.5}]", v[0], v[1], v[2])
}
