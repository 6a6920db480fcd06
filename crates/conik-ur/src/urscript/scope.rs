//! Which variables are global and which are local.
//!
//! As the maker's manual has it: what is assigned at the first level of the program is global,
//! whatever stands in front; in a function, `global` and `local` decide, and an assignment without
//! either goes to the global variable of that name if there is one.

use super::syntax::{Action, Block, Scope};
use std::collections::BTreeSet;

/// Names of all global variables of a program.
pub(super) fn globals(program: &Block) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for_each_assignment(program, &mut |_, name| {
        names.insert(name.to_owned());
    });
    declared_global(program, &mut names);
    names
}

/// Names that functions anywhere declare as global.
fn declared_global(block: &Block, names: &mut BTreeSet<String>) {
    for_each_block(block, &mut |action| {
        if let Action::Define(function) = action {
            for_each_assignment(&function.body, &mut |scope, name| {
                if scope == Scope::Global {
                    names.insert(name.to_owned());
                }
            });
            declared_global(&function.body, names);
        }
    });
}

/// Names of a function's local variables, its parameters first.
pub(super) fn locals(
    parameters: &[String],
    body: &Block,
    globals: &BTreeSet<String>,
) -> Vec<String> {
    let mut names = parameters.to_vec();
    let mut known: BTreeSet<String> = parameters.iter().cloned().collect();
    for_each_assignment(body, &mut |scope, name| {
        let is_local = match scope {
            Scope::Local => true,
            Scope::Global => false,
            Scope::Free => !globals.contains(name),
        };
        if is_local && known.insert(name.to_owned()) {
            names.push(name.to_owned());
        }
    });
    names
}

/// Every assignment of a block, those within functions that it defines left out.
fn for_each_assignment(block: &Block, visit: &mut dyn FnMut(Scope, &str)) {
    for_each_block(block, &mut |action| {
        if let Action::Assign { scope, name, .. } = action {
            visit(*scope, name);
        }
    });
}

/// Every statement of a block and of the blocks in it, functions left out.
fn for_each_block(block: &Block, visit: &mut dyn FnMut(&Action)) {
    for statement in block {
        visit(&statement.action);
        match &statement.action {
            Action::If {
                branches,
                otherwise,
            } => {
                for (_, _, block) in branches {
                    for_each_block(block, visit);
                }
                for_each_block(otherwise, visit);
            }
            Action::While { body, .. } => for_each_block(body, visit),
            _ => {}
        }
    }
}
