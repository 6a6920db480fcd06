//! The arm of the paper a second time, as plainly as its Table I prints it: a chain of homogeneous
//! transforms. Shares no code with the crate, whose guarantees are judged by it.

/// A row a, α, d of Table I.
const TABLE_I: [[f64; 3]; 6] = [
    [0.0, std::f64::consts::FRAC_PI_2, 0.089],
    [-0.425, 0.0, 0.0],
    [-0.392, 0.0, 0.0],
    [0.0, std::f64::consts::FRAC_PI_2, 0.109],
    [0.0, -std::f64::consts::FRAC_PI_2, 0.095],
    [0.0, 0.0, 0.082],
];

pub type Vector = [f64; 3];

/// What a task measures, of the tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measure {
    /// Coordinate 0, 1 or 2 of the tool [m].
    Coordinate(usize),
    /// Distance of the tool to a point [m].
    Distance(Vector),
    /// |z axis of the tool − direction|, the direction of length 1 [-].
    View(Vector),
    /// A joint [rad].
    Joint(usize),
}

/// The arm in one configuration: origin and z axis of each of the frames 0 to 6.
#[derive(Clone, Debug)]
pub struct Chain {
    q: [f64; 6],
    origins: [Vector; 7],
    axes: [Vector; 7],
}

pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

impl Chain {
    /// The arm at `q` [rad], six joints.
    pub fn at(q: &[f64]) -> Self {
        // The columns of the rotation, and the origin.
        let mut x = [1.0, 0.0, 0.0];
        let mut y = [0.0, 1.0, 0.0];
        let mut z = [0.0, 0.0, 1.0];
        let mut origin = [0.0; 3];
        let mut chain = Self {
            q: q.try_into().expect("six joints"),
            origins: [origin; 7],
            axes: [z; 7],
        };
        for (i, (&[a, alpha, d], &theta)) in TABLE_I.iter().zip(q).enumerate() {
            let (sin, cos) = theta.sin_cos();
            let (sa, ca) = alpha.sin_cos();
            let old = [x, y, z];
            for k in 0..3 {
                let (ox, oy, oz) = (old[0][k], old[1][k], old[2][k]);
                x[k] = cos * ox + sin * oy;
                y[k] = -sin * ca * ox + cos * ca * oy + sa * oz;
                z[k] = sin * sa * ox - cos * sa * oy + ca * oz;
                origin[k] += a * x[k] + d * oz;
            }
            chain.origins[i + 1] = origin;
            chain.axes[i + 1] = z;
        }
        chain
    }

    /// Position of the tool [m].
    pub fn tool(&self) -> Vector {
        self.origins[6]
    }

    /// z axis of the tool.
    pub fn view(&self) -> Vector {
        self.axes[6]
    }

    /// σ.
    pub fn value(&self, measure: Measure) -> f64 {
        match measure {
            Measure::Coordinate(k) => self.tool()[k],
            Measure::Distance(point) => norm(minus(self.tool(), point)),
            Measure::View(direction) => norm(minus(self.view(), direction)),
            Measure::Joint(i) => self.q[i],
        }
    }

    /// ∂σ/∂q.
    pub fn row(&self, measure: Measure) -> [f64; 6] {
        let unit = |v: Vector| v.map(|c| c / norm(v));
        match measure {
            Measure::Coordinate(k) => {
                let mut along = [0.0; 3];
                along[k] = 1.0;
                self.moved_along(along)
            }
            Measure::Distance(point) => self.moved_along(unit(minus(self.tool(), point))),
            Measure::View(direction) => {
                let along = unit(minus(self.view(), direction));
                std::array::from_fn(|i| dot(cross(self.axes[i], self.view()), along))
            }
            Measure::Joint(joint) => std::array::from_fn(|i| f64::from(u8::from(i == joint))),
        }
    }

    /// How the tool moves along a vector as each joint turns: Jᵀ of its position times the vector.
    pub fn moved_along(&self, along: Vector) -> [f64; 6] {
        std::array::from_fn(|i| {
            dot(
                cross(self.axes[i], minus(self.tool(), self.origins[i])),
                along,
            )
        })
    }
}
