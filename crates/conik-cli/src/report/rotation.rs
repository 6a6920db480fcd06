//! Turning the path by hand: the scene as data beside the static picture, and a small script.
//!
//! Without the script the page lacks nothing but this.

use std::fmt::Write;

use crate::figure::Run;
use crate::figure::camera::Vector;
use crate::figure::scene::Scene;

/// The script as an element of the page.
pub fn script() -> String {
    format!("<script>\n{}</script>\n", include_str!("rotate.js"))
}

/// The scene as data that the script reads, for a picture of that size [px].
pub fn scene(run: &Run, width: f64, height: f64) -> String {
    let scene = Scene::of(run);
    let (azimuth_deg, elevation_deg) = scene.best_view_deg();
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
    let spheres: Vec<String> = scene
        .obstacles()
        .map(|sphere| format!("[{},{:.5}]", vector(&sphere.centre), sphere.radius))
        .collect();
    let moving: Vec<String> = scene
        .moving
        .iter()
        .map(|sphere| {
            let (from, to) = (vector(&sphere.from), vector(&sphere.to));
            format!("[{from},{to},{:.5}]", sphere.radius)
        })
        .collect();
    let targets: Vec<String> = scene
        .targets
        .iter()
        .map(|target| format!("[{},{:.5}]", vector(&target.point), target.acceptance))
        .collect();
    let mut data = String::new();
    // Writing to a string cannot fail. Numbers and colours only: nothing here needs escaping.
    let _ = write!(
        data,
        "<script type=\"application/json\" id=\"scene\">{{\"size\":[{width},{height}],\
         \"view\":[{azimuth_deg},{elevation_deg}],\"low\":{},\"high\":{},\"step\":{},\
         \"base\":{},\"path\":[{}],\"spheres\":[{}],\"moving\":[{}],\"targets\":[{}]}}</script>",
        vector(&scene.low),
        vector(&scene.high),
        scene.step,
        scene.shows_base,
        path.join(","),
        spheres.join(","),
        moving.join(","),
        targets.join(","),
    );
    data
}

fn vector(v: &Vector) -> String {
    format!("[{:.5},{:.5},{:.5}]", v[0], v[1], v[2])
}
