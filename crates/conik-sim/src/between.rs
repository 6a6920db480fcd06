//! Which two shapes a task keeps apart, or measures the distance of.

use crate::scenario::{Scenario, TaskConfig, TaskKind};

impl Scenario {
    /// The names of the shape and the obstacle, or of the two shapes, between which a task of
    /// [`all_tasks`](Self::all_tasks) measures; `None` of any other task.
    pub fn between(&self, task: &TaskConfig) -> Option<[String; 2]> {
        // Tasks of the file name their shapes; those that shapes and obstacles become are named after them.
        let mut tasks = self.tasks.iter();
        match tasks.find(|listed| listed.name == task.name) {
            Some(listed) => match &listed.kind {
                TaskKind::ShapeDistance { shapes } => Some(shapes.clone()),
                _ => None,
            },
            None => self.kept_apart(&task.name),
        }
    }

    /// The names of which `task` is made. Names may have a `/` in them, so that no other way is sure.
    fn kept_apart(&self, task: &str) -> Option<[String; 2]> {
        let shapes = self.collision.shapes.iter().map(|shape| &shape.name);
        let obstacles = self.collision.obstacles.iter().map(|it| &it.name);
        let others: Vec<_> = obstacles.chain(shapes.clone()).collect();
        shapes
            .filter_map(|shape| {
                Some((shape, task.strip_prefix(shape.as_str())?.strip_prefix('/')?))
            })
            .find_map(|(shape, rest)| {
                let other = others.iter().find(|other| **other == rest)?;
                Some([shape.clone(), (*other).clone()])
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHELF: &str = include_str!("../../../scenarios/gallery/shelf.toml");

    #[test]
    fn slashes_in_names_are_no_riddle() {
        let text = SHELF
            .replace("name = \"forearm\"", "name = \"a/b\"")
            .replace("name = \"post\"", "name = \"c/d\"");
        let scenario = Scenario::from_toml(&text).unwrap();
        let parts = scenario.kept_apart("a/b/c/d").unwrap();
        assert_eq!(parts, ["a/b", "c/d"]);
        assert_eq!(scenario.kept_apart("a/b/c"), None);
    }
}
