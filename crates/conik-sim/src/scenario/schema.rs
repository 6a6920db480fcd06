//! The JSON Schema of the scenario file, for completion and checks in editors.

use serde_json::{Map, Value, json};

use super::config::Control;
use super::geometry;
use super::goal_schema::{self, each_alone};
use super::key::{Holds, Key, Range};
use super::keys;
use super::names;
use super::robots::known_robots;
use super::task_types::{self, TaskType};

/// The JSON Schema (draft-07) of the scenario file as this version reads it.
///
/// What a schema can express it does; what needs the whole file (unique names, gains below the
/// first equality task, ...) only [`Scenario::from_toml`](super::Scenario::from_toml) checks.
pub fn schema() -> Value {
    let mut schema = table(keys::FILE, &["robot", "task"]);
    set(
        &mut schema,
        "$schema",
        json!("http://json-schema.org/draft-07/schema#"),
    );
    set(&mut schema, "title", json!("Scenario of conik"));
    // Of a robot from a file only the file knows how its joints are called.
    let of_model = json!({ "properties": { "robot": { "required": [keys::MODEL.name] } } });
    let known = json!({ "anyOf": [{ "type": "integer" }, { "enum": joint_names() }] });
    set(&mut schema, "if", of_model);
    set(
        &mut schema,
        "then",
        json!({ "properties": { "task": { "items": { "properties": { "joint": known } } } } }),
    );
    schema
}

fn set(object: &mut Value, key: &str, value: Value) {
    object[key] = value;
}

/// A table with these keys, of which these must be there.
fn table(known: &[&'static Key], required: &[&str]) -> Value {
    let properties: Map<_, _> = known
        .iter()
        .map(|key| (key.name.to_owned(), property(key)))
        .collect();
    json!({
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    })
}

fn property(key: &Key) -> Value {
    let mut schema = holds(key);
    let unit = match key.unit {
        "" => String::new(),
        unit => format!(" [{unit}]"),
    };
    let mut about = vec![format!("{}{unit}", key.about)];
    if let Holds::Choice(values) | Holds::ChoiceOrNumber(values, _) = key.holds {
        let meanings = values().into_iter();
        about.extend(meanings.map(|(name, meaning)| format!("- `{name}`: {meaning}")));
    }
    set(&mut schema, "description", json!(about.join("\n")));
    // The one table with defaults is `[control]`; its type knows them.
    if let Ok(defaults) = serde_json::to_value(Control::default())
        && let Some(default) = defaults.get(key.name)
    {
        set(&mut schema, "default", default.clone());
    }
    schema
}

fn holds(key: &Key) -> Value {
    match key.holds {
        Holds::TaskName => json!({ "type": "string", "pattern": names::PATTERN }),
        Holds::Robot => {
            let names: Vec<_> = known_robots()
                .iter()
                .map(|robot| robot.name.as_str())
                .collect();
            json!({ "type": "string", "enum": names })
        }
        Holds::Text | Holds::TaskType | Holds::Link => json!({ "type": "string" }),
        Holds::Number(range) => number(range),
        Holds::JointNumbers(range) => {
            json!({ "type": "array", "items": number(range), "minItems": 1 })
        }
        Holds::NumberOrJointNumbers(range) => json!({ "anyOf": [
            number(range),
            { "type": "array", "items": number(range), "minItems": 1 },
        ] }),
        Holds::JointPairs(range) => {
            let pair =
                json!({ "type": "array", "items": number(range), "minItems": 2, "maxItems": 2 });
            let none = json!({ "type": "array", "maxItems": 0 });
            json!({ "type": "array", "items": { "anyOf": [pair, none] }, "minItems": 1 })
        }
        Holds::Vector(range) => vector(range),
        Holds::Points(range) => json!({ "type": "array", "items": vector(range), "minItems": 1 }),
        Holds::Quaternion(range) => quaternion(range),
        Holds::Quaternions(range) => {
            json!({ "type": "array", "items": quaternion(range), "minItems": 1 })
        }
        Holds::Joint => joint(),
        Holds::Joints => {
            json!({ "type": "array", "items": joint(), "minItems": 1, "uniqueItems": true })
        }
        Holds::Choice(values) => one_of(values()),
        Holds::ChoiceOrNumber(values, range) => {
            json!({ "anyOf": [one_of(values()), number(range)] })
        }
        Holds::NameOrNames => json!({ "anyOf": [
            { "type": "string" },
            { "type": "array", "items": { "type": "string" }, "minItems": 1 },
        ] }),
        Holds::TwoNames => json!({
            "type": "array",
            "items": { "type": "string", "pattern": names::PATTERN },
            "minItems": 2,
            "maxItems": 2,
            "uniqueItems": true,
        }),
        Holds::NameGroups => json!({
            "type": "array",
            "items": {
                "type": "array",
                "items": { "type": "string", "pattern": names::PATTERN },
                "minItems": 2,
                "uniqueItems": true,
            },
        }),
        Holds::Table if key.name == keys::ROBOT.name => robot(),
        Holds::Table if key.name == keys::UR.name => ur(),
        Holds::Table if key.name == keys::SELF_COLLISION.name => {
            table(keys::SELF_COLLISION_KEYS, &[keys::DISTANCE_M.name])
        }
        Holds::Table => table(keys::CONTROL_KEYS, &[]),
        Holds::Tables if key.name == keys::SHAPE.name => {
            let required = [keys::LINK.name];
            json!({ "type": "array", "items": shape(keys::SHAPE_KEYS, &required) })
        }
        Holds::Tables if key.name == keys::OBSTACLE.name => {
            let required = [keys::NAME.name];
            json!({ "type": "array", "items": shape(keys::OBSTACLE_KEYS, &required) })
        }
        Holds::Tables => json!({ "type": "array", "items": task(), "minItems": 1 }),
    }
}

/// One of these names.
fn one_of(values: Vec<(&'static str, &'static str)>) -> Value {
    let names: Vec<_> = values.into_iter().map(|(name, _)| name).collect();
    json!({ "type": "string", "enum": names })
}

fn number(range: Range) -> Value {
    if range == Range::FINITE {
        return json!({ "type": "number" });
    }
    let least = if range.open {
        "exclusiveMinimum"
    } else {
        "minimum"
    };
    json!({ "type": "number", least: range.least, "maximum": range.most })
}

fn vector(range: Range) -> Value {
    json!({ "type": "array", "items": number(range), "minItems": 3, "maxItems": 3 })
}

fn quaternion(range: Range) -> Value {
    json!({ "type": "array", "items": number(range), "minItems": 4, "maxItems": 4 })
}

fn joint() -> Value {
    json!({ "anyOf": [
        { "type": "integer", "minimum": 1 },
        { "type": "string" },
    ] })
}

/// Names of the joints of all robots.
fn joint_names() -> Vec<&'static str> {
    let mut names: Vec<_> = known_robots()
        .iter()
        .flat_map(|robot| &robot.joint_names)
        .map(String::as_str)
        .collect();
    names.sort_unstable();
    names.dedup();
    names
}

fn robot() -> Value {
    let mut schema = table(keys::ROBOT_KEYS, &[]);
    let start = json!([{ "required": ["q0_deg"] }, { "required": ["q0_rad"] }]);
    set(&mut schema, "oneOf", start);
    // As many numbers as the robot has joints. Where one number stands for all, it is no list.
    let per_robot = known_robots().iter().map(|robot| {
        let joints = robot.joint_names.len();
        let lists = keys::IN_TWO_UNITS.iter().flat_map(|(deg, rad)| [deg, rad]);
        let lists: Map<_, _> = lists
            .map(|key| {
                let length = json!({ "minItems": joints, "maxItems": joints });
                (key.name.to_owned(), length)
            })
            .collect();
        json!({
            "if": { "properties": { "model": { "const": robot.name } }, "required": ["model"] },
            "then": { "properties": lists },
        })
    });
    let in_one_unit = keys::IN_TWO_UNITS
        .iter()
        .map(|(deg, rad)| json!({ "not": { "required": [deg.name, rad.name] } }));
    let source = json!({ "oneOf": [{ "required": ["model"] }, { "required": ["urdf"] }] });
    let of_urdf = json!({ "dependencies": { "base": ["urdf"], "tool": ["urdf"] } });
    let rules: Vec<_> = per_robot
        .chain(in_one_unit)
        .chain([source, of_urdf])
        .collect();
    set(&mut schema, "allOf", json!(rules));
    schema
}

fn ur() -> Value {
    let mut schema = table(keys::UR_KEYS, &[]);
    let rotation = json!({ keys::TCP_ROTATION_RAD.name: [keys::TCP_OFFSET_M.name] });
    set(&mut schema, "dependencies", rotation);
    schema
}

/// A table with a shape of any type, besides keys of its own.
fn shape(own: &[&'static Key], required: &[&str]) -> Value {
    let types = geometry::ALL.iter().map(|geometry| {
        let known: Vec<_> = own.iter().copied().chain(geometry.all_keys()).collect();
        let mut needed = vec![keys::TYPE.name];
        needed.extend(required);
        needed.extend(geometry.keys.iter().map(|key| key.name));
        let mut schema = table(&known, &needed);
        schema["properties"]["type"] = json!({ "const": geometry.name });
        if own.iter().any(|key| key.name == keys::MOVES_UNTIL_S.name) {
            set(&mut schema, "dependencies", needs_speed(keys::MOVES));
        }
        schema
    });
    json!({ "type": "object", "oneOf": types.collect::<Vec<_>>() })
}

fn task() -> Value {
    let types: Vec<_> = task_types::ALL.iter().map(task_of_type).collect();
    json!({ "type": "object", "oneOf": types })
}

fn task_of_type(task_type: &TaskType) -> Value {
    let known: Vec<_> = task_type.all_keys().collect();
    let always = keys::TASK_KEYS.iter().chain(task_type.keys);
    let required: Vec<_> = always.map(|key| key.name).collect();
    let mut schema = table(&known, &required);
    let speeds = task_type.speed_keys();
    if !speeds.is_empty() {
        set(&mut schema, "dependencies", needs_speed(&speeds));
    }
    set(&mut schema, "title", json!(task_type.name));
    set(&mut schema, "description", json!(task_type.about));
    schema["properties"]["type"] = json!({
        "const": task_type.name,
        "description": task_type.about,
    });
    set(&mut schema, "oneOf", goal_schema::alternatives(task_type));
    let mut rules = Vec::new();
    if !task_type.one_of.is_empty() {
        rules.push(json!({ "oneOf": each_alone(task_type.one_of) }));
    }
    if task_type
        .moves
        .iter()
        .any(|key| key.name == keys::ANGULAR_VELOCITY_DEG_PER_S.name)
    {
        let both = keys::TURNS.iter().map(|key| key.name);
        rules.push(json!({ "not": { "required": both.collect::<Vec<_>>() } }));
    }
    if !rules.is_empty() {
        set(&mut schema, "allOf", json!(rules));
    }
    goal_schema::restrict(&mut schema["properties"], task_type);
    schema
}

/// What comes to rest must move first.
fn needs_speed(speeds: &[&'static Key]) -> Value {
    json!({ keys::MOVES_UNTIL_S.name: { "anyOf": each_alone(speeds) } })
}
