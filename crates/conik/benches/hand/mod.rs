//! Example 2's step written by hand for this robot and these four tasks: the floor beside which the
//! controller is timed.
//!
//! Everything that the controller finds out at run time is a constant here: six joints, two
//! obstacles, one view, one position, the paper's six modes in their order, at most two frozen rows.
//! Rule `paper`, border `freeze`, recursion `chiaverini`; no speed limit.

use conik::Vec3;

/// a [m], cos α, sin α and d [m] of Table I.
const LINKS: [[f64; 4]; 6] = [
    [0.0, 0.0, 1.0, 0.089],
    [-0.425, 1.0, 0.0, 0.0],
    [-0.392, 1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.109],
    [0.0, 0.0, -1.0, 0.095],
    [0.0, 1.0, 0.0, 0.082],
];
const OBSTACLES: [Vec3; 2] = [Vec3::new(0.40, -0.25, -0.33), Vec3::new(0.40, 0.15, -0.33)];
const LEAST_DISTANCE: [f64; 2] = [0.18, 0.15];
const VIEW: Vec3 = Vec3::new(1.0, 0.0, 0.0);
const VIEW_MAX: f64 = 0.2622;
const GAIN: f64 = 0.3;
const EPSILON: f64 = 1e-9;
const STILL: f64 = 1e-12;

/// The paper's modes: which of obstacle a, obstacle b and view are frozen.
const MODES: [&[usize]; 6] = [&[], &[0], &[1], &[2], &[0, 2], &[1, 2]];

type Row = [f64; 6];

/// The arm in one configuration.
pub struct Arm {
    joint_axes: [Vec3; 6],
    joint_origins: [Vec3; 6],
    pub tool: Vec3,
    pub tool_axis: Vec3,
}

/// Forward kinematics.
pub fn arm(q: &Row) -> Arm {
    let mut joint_axes = [Vec3::ZERO; 6];
    let mut joint_origins = [Vec3::ZERO; 6];
    let mut origin = Vec3::ZERO;
    let [mut x, mut y, mut z] = [
        Vec3::new(1.0, 0.0, 0.0),
        Vec3::new(0.0, 1.0, 0.0),
        Vec3::new(0.0, 0.0, 1.0),
    ];
    for i in 0..6 {
        joint_axes[i] = z;
        joint_origins[i] = origin;
        let [a, cos_alpha, sin_alpha, d] = LINKS[i];
        let (sin, cos) = q[i].sin_cos();
        let across = y * cos - x * sin;
        x = x * cos + y * sin;
        origin = origin + z * d + x * a;
        y = across * cos_alpha + z * sin_alpha;
        z = z * cos_alpha - across * sin_alpha;
    }
    Arm {
        joint_axes,
        joint_origins,
        tool: origin,
        tool_axis: z,
    }
}

/// Jacobian of the tool's position, row by row.
pub fn position_rows(arm: &Arm) -> [Row; 3] {
    let mut rows = [[0.0; 6]; 3];
    for i in 0..6 {
        let speed = arm.joint_axes[i].cross(arm.tool - arm.joint_origins[i]);
        [rows[0][i], rows[1][i], rows[2][i]] = speed.to_array();
    }
    rows
}

/// Jacobian of the tool's z axis, row by row.
pub fn axis_rows(arm: &Arm) -> [Row; 3] {
    let mut rows = [[0.0; 6]; 3];
    for i in 0..6 {
        let rate = arm.joint_axes[i].cross(arm.tool_axis);
        [rows[0][i], rows[1][i], rows[2][i]] = rate.to_array();
    }
    rows
}

/// The joint velocity at `q` towards `target`, and the number of the paper's mode, from 1; no motion
/// and 0 if there is none.
pub fn step(q: &Row, target: [f64; 3]) -> (Row, usize) {
    let arm = arm(q);
    let position = position_rows(&arm);
    let axis = axis_rows(&arm);
    let away = [
        arm.tool - OBSTACLES[0],
        arm.tool - OBSTACLES[1],
        arm.tool_axis - VIEW,
    ];
    let sigma = away.map(Vec3::norm);
    let along = |i: usize| away[i] * (1.0 / (sigma[i] + EPSILON));
    let rows = [
        combine(&position, along(0)),
        combine(&position, along(1)),
        combine(&axis, along(2)),
    ];
    let free = least_motion(&position, (Vec3::from(target) - arm.tool) * GAIN);
    for (mode, frozen) in MODES.iter().enumerate() {
        let velocity = match *frozen {
            [] => free,
            [i] => freeze_one(&free, &rows[*i]),
            [i, k] => freeze_two(&free, &rows[*i], &rows[*k]),
            _ => unreachable!("no mode freezes more than two"),
        };
        let keeps = |i: usize| {
            let rate = dot(&rows[i], &velocity);
            match i {
                2 => sigma[2] < VIEW_MAX || rate <= STILL,
                _ => sigma[i] > LEAST_DISTANCE[i] || rate >= -STILL,
            }
        };
        if (0..3).all(|i| frozen.contains(&i) || keeps(i)) {
            return (velocity, mode + 1);
        }
    }
    ([0.0; 6], 0)
}

/// directionᵀ J
fn combine(rows: &[Row; 3], direction: Vec3) -> Row {
    std::array::from_fn(|k| {
        rows[0][k] * direction.x + rows[1][k] * direction.y + rows[2][k] * direction.z
    })
}

/// Jᵀ (J Jᵀ)⁻¹ s by Cramer's rule.
fn least_motion(rows: &[Row; 3], s: Vec3) -> Row {
    let [x, y, z] = rows;
    let (xy, xz, yz) = (dot(x, y), dot(x, z), dot(y, z));
    let first = Vec3::new(dot(x, x), xy, xz);
    let second = Vec3::new(xy, dot(y, y), yz);
    let third = Vec3::new(xz, yz, dot(z, z));
    let over = 1.0 / first.dot(second.cross(third));
    let shares = Vec3::new(
        s.dot(second.cross(third)),
        s.dot(third.cross(first)),
        s.dot(first.cross(second)),
    );
    combine(rows, shares * over)
}

fn freeze_one(v: &Row, a: &Row) -> Row {
    let share = dot(a, v) / dot(a, a);
    std::array::from_fn(|k| v[k] - share * a[k])
}

fn freeze_two(v: &Row, a: &Row, b: &Row) -> Row {
    let (aa, ab, bb) = (dot(a, a), dot(a, b), dot(b, b));
    let (av, bv) = (dot(a, v), dot(b, v));
    let over = 1.0 / (aa * bb - ab * ab);
    let (of_a, of_b) = ((bb * av - ab * bv) * over, (aa * bv - ab * av) * over);
    std::array::from_fn(|k| v[k] - of_a * a[k] - of_b * b[k])
}

fn dot(a: &Row, b: &Row) -> f64 {
    let even = a[0] * b[0] + a[2] * b[2] + a[4] * b[4];
    let odd = a[1] * b[1] + a[3] * b[3] + a[5] * b[5];
    even + odd
}
