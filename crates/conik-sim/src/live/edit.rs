//! Changes keys of a scenario that is written as JSON.

use conik::Vec3;
use serde_json::{Map, Value};

use super::change::ChangeError;
use crate::scenario::Motion;

/// Keys that say what something is, not how much.
pub(super) const FIXED: &[&str] = &[
    "name",
    "type",
    "frame",
    "relative_to",
    "joint",
    "joints",
    "part",
    "shapes",
    "shoulder",
    "elbow",
    "wrist",
];

/// Keys that say where something is, if it moves: at t = 0.
const POINTS: &[&str] = &["point_m", "target_m", "center_m", "from_m", "to_m"];

/// The list of that name; an empty one if there is none.
pub(super) fn list<'a>(scenario: &'a mut Value, name: &str) -> &'a mut Vec<Value> {
    let list = &mut scenario[name];
    if !list.is_array() {
        *list = Value::Array(Vec::new());
    }
    match list {
        Value::Array(items) => items,
        _ => unreachable!("it was made a list"),
    }
}

pub(super) fn named<'a>(
    items: &'a mut [Value],
    what: &'static str,
    name: &str,
) -> Result<&'a mut Map<String, Value>, ChangeError> {
    let names = || items.iter().filter_map(|item| item["name"].as_str());
    let Some(place) = names().position(|it| it == name) else {
        return Err(ChangeError::Unknown {
            what,
            name: name.to_owned(),
            known: names().collect::<Vec<_>>().join(", "),
        });
    };
    match &mut items[place] {
        Value::Object(item) => Ok(item),
        _ => unreachable!("only objects have a name"),
    }
}

/// Sets a key, and moves what moves back to where it has to begin in order to be at `t_s` [s] where it is.
pub(super) fn set(
    item: &mut Map<String, Value>,
    name: &str,
    key: &str,
    value: &Value,
    t_s: f64,
) -> Result<(), ChangeError> {
    if FIXED.contains(&key) {
        return Err(ChangeError::Fixed {
            key: key.to_owned(),
            name: name.to_owned(),
        });
    }
    shift(item, t_s, 1.0);
    if value.is_null() {
        item.remove(key);
    } else {
        item.insert(key.to_owned(), in_floats(value));
    }
    shift(item, t_s, -1.0);
    Ok(())
}

/// Moves all places of something by `times` its way until `t_s` [s].
fn shift(item: &mut Map<String, Value>, t_s: f64, times: f64) {
    let Ok(motion) = serde_json::from_value::<Motion>(Value::Object(item.clone())) else {
        return;
    };
    if motion.is_rest() {
        return;
    }
    let way = motion.point_at([0.0; 3], t_s);
    let turn = Vec3::from(motion.turned_at(t_s)) * times;
    let is_position = item.get("type").is_some_and(|it| it == "position");
    let rise = motion.value_at(0.0, t_s);
    for (key, value) in item.iter_mut() {
        let Some(numbers) = numbers(value) else {
            continue;
        };
        let moved: Vec<f64> = match (key.as_str(), numbers.as_slice()) {
            ("direction", &[x, y, z]) => Vec3::new(x, y, z).turned_by(turn).to_array().to_vec(),
            ("desired", &[start]) => vec![start + times * rise],
            (key, &[x, y, z]) if POINTS.contains(&key) || (is_position && key == "desired") => {
                let moved = [0, 1, 2].map(|axis| [x, y, z][axis] + times * way[axis]);
                moved.to_vec()
            }
            _ => continue,
        };
        *value = Value::from(moved);
    }
}

fn numbers(value: &Value) -> Option<Vec<f64>> {
    value.as_array()?.iter().map(Value::as_f64).collect()
}

/// Whole numbers are numbers too.
fn in_floats(value: &Value) -> Value {
    match value {
        Value::Number(number) => number.as_f64().map_or(value.clone(), Value::from),
        Value::Array(items) => items.iter().map(in_floats).collect(),
        _ => value.clone(),
    }
}

pub(super) fn shortened(value: &Value) -> String {
    let text = value.to_string();
    match text.char_indices().nth(40) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}

pub(super) fn reorder(tasks: &mut Vec<Value>, order: &[String]) -> Result<(), ChangeError> {
    let names: Vec<String> = tasks
        .iter()
        .filter_map(|task| Some(task["name"].as_str()?.to_owned()))
        .collect();
    let place = |name: &String| names.iter().position(|it| it == name);
    let places: Option<Vec<usize>> = order.iter().map(place).collect();
    let mut sorted = places.clone().unwrap_or_default();
    sorted.sort_unstable();
    if places.is_none() || !sorted.into_iter().eq(0..names.len()) {
        return Err(ChangeError::Order(names.join(", ")));
    }
    let ordered = places.into_iter().flatten();
    *tasks = ordered.map(|place| tasks[place].clone()).collect();
    Ok(())
}
