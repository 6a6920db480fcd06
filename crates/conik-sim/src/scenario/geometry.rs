//! What a shape is: the types that a `[[shape]]` or an `[[obstacle]]` may have.

use conik::{Capsule, Cuboid, Cylinder, HalfSpace, Pose, Shape, Sphere, Vec3};
use serde::{Deserialize, Serialize};

use super::key::Key;
use super::keys;
use super::mistake::Mistakes;
use super::shape_keys::{
    AXIS_KEYS, BOX_KEYS, CENTER_M, FROM_M, HALF_SPACE_KEYS, RADIUS_M, ROTATION_RAD, SIZE_M,
    SPHERE_KEYS, TO_M,
};
use super::table::{Table, unknown_name};
use super::write::{number, vector};

/// A shape in the frame that it is fixed to; `type` in the file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum Geometry {
    /// A ball.
    Sphere {
        /// Its middle [m].
        center_m: [f64; 3],
        /// Its radius [m].
        radius_m: f64,
    },
    /// A line segment with a radius.
    Capsule {
        /// Where its axis begins [m].
        from_m: [f64; 3],
        /// Where its axis ends [m].
        to_m: [f64; 3],
        /// Its radius [m].
        radius_m: f64,
    },
    /// A cylinder with flat ends.
    Cylinder {
        /// Where its axis begins [m].
        from_m: [f64; 3],
        /// Where its axis ends [m].
        to_m: [f64; 3],
        /// Its radius [m].
        radius_m: f64,
    },
    /// A box.
    Box {
        /// Its middle [m].
        center_m: [f64; 3],
        /// Lengths of its edges [m].
        size_m: [f64; 3],
        /// How it is turned [rad]: about this axis, by its length.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        rotation_rad: Option<[f64; 3]>,
    },
    /// Everything behind a plane.
    HalfSpace {
        /// A point of the plane [m].
        point_m: [f64; 3],
        /// Out of it, of length 1.
        normal: [f64; 3],
    },
}

/// A type of shape.
#[derive(Debug)]
pub(super) struct GeometryType {
    /// Its name in the file.
    pub(super) name: &'static str,
    /// The keys that it needs.
    pub(super) keys: &'static [&'static Key],
    /// The keys that it may have besides.
    pub(super) optional: &'static [&'static Key],
}

/// Every type of shape.
pub(super) const ALL: &[GeometryType] = &[
    GeometryType::new("sphere", SPHERE_KEYS, &[]),
    GeometryType::new("capsule", AXIS_KEYS, &[]),
    GeometryType::new("box", BOX_KEYS, &[&ROTATION_RAD]),
    GeometryType::new("cylinder", AXIS_KEYS, &[]),
    GeometryType::new("half_space", HALF_SPACE_KEYS, &[]),
];

impl GeometryType {
    const fn new(
        name: &'static str,
        keys: &'static [&'static Key],
        optional: &'static [&'static Key],
    ) -> Self {
        Self {
            name,
            keys,
            optional,
        }
    }

    pub(super) fn all_keys(&self) -> impl Iterator<Item = &'static Key> + Clone {
        self.keys.iter().chain(self.optional).copied()
    }
}

impl From<Shape> for Geometry {
    fn from(shape: Shape) -> Self {
        match shape {
            Shape::Sphere(sphere) => Self::Sphere {
                center_m: sphere.center().to_array(),
                radius_m: sphere.radius(),
            },
            Shape::Capsule(capsule) => {
                let [from_m, to_m] = capsule.ends().map(Vec3::to_array);
                let radius_m = capsule.radius();
                Self::Capsule {
                    from_m,
                    to_m,
                    radius_m,
                }
            }
            Shape::Cylinder(cylinder) => {
                let [from_m, to_m] = cylinder.ends().map(Vec3::to_array);
                let radius_m = cylinder.radius();
                Self::Cylinder {
                    from_m,
                    to_m,
                    radius_m,
                }
            }
            Shape::Cuboid(cuboid) => {
                let pose = cuboid.pose();
                let rotation = pose.rotation_vector();
                Self::Box {
                    center_m: pose.origin.to_array(),
                    size_m: cuboid.size().to_array(),
                    rotation_rad: (rotation != Vec3::ZERO).then(|| rotation.to_array()),
                }
            }
            Shape::HalfSpace(half_space) => Self::HalfSpace {
                point_m: half_space.point().to_array(),
                normal: half_space.normal().to_array(),
            },
        }
    }
}

impl Geometry {
    /// The shape that the controller measures.
    pub fn shape(&self) -> Shape {
        match *self {
            Self::Sphere { center_m, radius_m } => Sphere::new(center_m, radius_m).into(),
            Self::Capsule {
                from_m,
                to_m,
                radius_m,
            } => Capsule::new(from_m, to_m, radius_m).into(),
            Self::Cylinder {
                from_m,
                to_m,
                radius_m,
            } => Cylinder::new(from_m, to_m, radius_m).into(),
            Self::Box {
                center_m,
                size_m,
                rotation_rad,
            } => {
                let turned = |axis: Vec3| axis.turned_by(rotation_rad.unwrap_or_default().into());
                let pose = Pose {
                    x_axis: turned(Pose::IDENTITY.x_axis),
                    y_axis: turned(Pose::IDENTITY.y_axis),
                    z_axis: turned(Pose::IDENTITY.z_axis),
                    origin: center_m.into(),
                };
                Cuboid::new(pose, size_m).into()
            }
            Self::HalfSpace { point_m, normal } => HalfSpace::new(point_m, normal).into(),
        }
    }

    /// A point of it, by which its motion is told [m].
    pub fn point(&self) -> [f64; 3] {
        match *self {
            Self::Sphere { center_m, .. } | Self::Box { center_m, .. } => center_m,
            Self::Capsule { from_m, .. } | Self::Cylinder { from_m, .. } => from_m,
            Self::HalfSpace { point_m, .. } => point_m,
        }
    }

    /// The same shape, with that point somewhere else [m].
    #[must_use]
    pub(crate) fn moved_to(&self, place: [f64; 3]) -> Self {
        let mut moved = self.clone();
        let from = self.point();
        let shift = [0, 1, 2].map(|axis| place[axis] - from[axis]);
        match &mut moved {
            Self::Sphere {
                center_m: point, ..
            }
            | Self::Box {
                center_m: point, ..
            }
            | Self::HalfSpace { point_m: point, .. } => *point = place,
            Self::Capsule { from_m, to_m, .. } | Self::Cylinder { from_m, to_m, .. } => {
                *from_m = place;
                for (end, shift) in to_m.iter_mut().zip(shift) {
                    *end += shift;
                }
            }
        }
        moved
    }

    /// Whether two shapes are the same but for rounding.
    pub(crate) fn is_near(&self, other: &Self) -> bool {
        let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9);
        match (self, other) {
            (
                Self::Capsule {
                    from_m,
                    to_m,
                    radius_m,
                },
                Self::Capsule {
                    from_m: other_from,
                    to_m: other_to,
                    radius_m: other_radius,
                },
            )
            | (
                Self::Cylinder {
                    from_m,
                    to_m,
                    radius_m,
                },
                Self::Cylinder {
                    from_m: other_from,
                    to_m: other_to,
                    radius_m: other_radius,
                },
            ) => near(*from_m, *other_from) && near(*to_m, *other_to) && radius_m == other_radius,
            _ => self == other,
        }
    }

    /// The name of its type in the file.
    pub fn type_name(&self) -> &'static str {
        match self {
            Self::Sphere { .. } => "sphere",
            Self::Capsule { .. } => "capsule",
            Self::Cylinder { .. } => "cylinder",
            Self::Box { .. } => "box",
            Self::HalfSpace { .. } => "half_space",
        }
    }

    /// Its keys and values, but for the type, as they stand in the file.
    pub(super) fn written(&self) -> Vec<(&'static str, String)> {
        match self {
            Self::Sphere { center_m, radius_m } => vec![
                (CENTER_M.name, vector(center_m)),
                (RADIUS_M.name, number(*radius_m)),
            ],
            Self::Capsule {
                from_m,
                to_m,
                radius_m,
            }
            | Self::Cylinder {
                from_m,
                to_m,
                radius_m,
            } => vec![
                (FROM_M.name, vector(from_m)),
                (TO_M.name, vector(to_m)),
                (RADIUS_M.name, number(*radius_m)),
            ],
            Self::Box {
                center_m,
                size_m,
                rotation_rad,
            } => [
                (CENTER_M.name, vector(center_m)),
                (SIZE_M.name, vector(size_m)),
            ]
            .into_iter()
            .chain(
                rotation_rad
                    .iter()
                    .map(|it| (ROTATION_RAD.name, vector(it))),
            )
            .collect(),
            Self::HalfSpace { point_m, normal } => vec![
                (keys::POINT_M.name, vector(point_m)),
                (keys::NORMAL.name, vector(normal)),
            ],
        }
    }
}

/// The type that the table names.
pub(super) fn read_type(table: &Table, found: &mut Mistakes) -> Option<&'static GeometryType> {
    let name = table.text(&keys::TYPE, found);
    if !name.is_present() {
        found.add(
            table.header.clone(),
            table.path_of(&keys::TYPE),
            "missing",
            r#"write for example `type = "capsule"`"#,
        );
    }
    let name = name.given()?;
    let found_type = ALL.iter().find(|geometry| geometry.name == name);
    if found_type.is_none() {
        let (what, help) = unknown_name(name, ALL.iter().map(|geometry| geometry.name));
        let (span, path) = (table.span_of(&keys::TYPE), table.path_of(&keys::TYPE));
        found.add(span, path, what, help);
    }
    found_type
}

/// Reads the shape of that type.
pub(super) fn read(
    table: &Table,
    geometry_type: &GeometryType,
    found: &mut Mistakes,
) -> Option<Geometry> {
    let needed =
        |key: &'static Key, found: &mut Mistakes| table.vector(key, found).required(table, found);
    let radius = |found: &mut Mistakes| table.number(&RADIUS_M, found).required(table, found);
    match geometry_type.name {
        "sphere" => {
            let (center_m, radius_m) = (needed(&CENTER_M, found), radius(found));
            Some(Geometry::Sphere {
                center_m: center_m?,
                radius_m: radius_m?,
            })
        }
        "box" => {
            let (center_m, size_m) = (needed(&CENTER_M, found), needed(&SIZE_M, found));
            let rotation = table.vector(&ROTATION_RAD, found).map(Some).or(None);
            Some(Geometry::Box {
                center_m: center_m?,
                size_m: size_m?,
                rotation_rad: rotation?,
            })
        }
        "half_space" => {
            let point_m = needed(&keys::POINT_M, found);
            let normal = table.direction(&keys::NORMAL, found).required(table, found);
            Some(Geometry::HalfSpace {
                point_m: point_m?,
                normal: normal?,
            })
        }
        name => {
            let (from_m, to_m) = (needed(&FROM_M, found), needed(&TO_M, found));
            let radius_m = radius(found);
            let (from_m, to_m, radius_m) = (from_m?, to_m?, radius_m?);
            if name == "capsule" {
                return Some(Geometry::Capsule {
                    from_m,
                    to_m,
                    radius_m,
                });
            }
            if from_m == to_m {
                found.add(
                    table.span_of(&TO_M),
                    table.path_of(&TO_M),
                    "a cylinder must have a length: its axis begins and ends in one place",
                    "give two points, or take a sphere",
                );
                return None;
            }
            Some(Geometry::Cylinder {
                from_m,
                to_m,
                radius_m,
            })
        }
    }
}
