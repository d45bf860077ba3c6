//! What a run of steps reads of a function's arguments, taken out of them by name.

use std::collections::HashSet;
use std::ops::Range;

use super::super::plan::{Plan, Target};
use super::function::Function;
use crate::emit::lines::Lines;
use crate::expr::{Binding, Expr};

/// Everything that a range of steps reads.
pub(super) fn open_inputs(out: &mut Lines, function: &Function, steps: Range<usize>) {
    let plan = function.plan;
    let mut nodes = Vec::new();
    for step in &plan.schedule.steps[steps] {
        match step {
            Binding::Let(node) => {
                let operands = plan.program.graph.nodes()[*node].operands();
                nodes.extend(operands.map(Expr::node));
            }
            Binding::Item(item) => nodes.extend(item_inputs(plan, *item)),
        }
    }
    open(out, function, nodes);
}

/// What the linear systems read.
pub(super) fn open_solve_inputs(out: &mut Lines, function: &Function) {
    let plan = function.plan;
    let items = 0..plan.targets.len();
    let solves = items.filter(|i| matches!(plan.targets[*i], Target::Solve(_)));
    open(out, function, solves.flat_map(|i| item_inputs(plan, i)).collect());
}

fn item_inputs(plan: &Plan, item: usize) -> Vec<usize> {
    match plan.targets[item] {
        Target::Solve(k) => plan.program.solves[k].inputs().map(|e| e.node()).collect(),
        Target::Angles(k) => plan.own_angles[k].iter().map(|angle| angle.sum.node()).collect(),
        Target::Entry { block, entry } => {
            vec![plan.program.blocks[block].entries[entry].node()]
        }
    }
}

/// `let Posture { s1, c1, .. } = *posture;` and the other inputs, whatever of them is read.
fn open(out: &mut Lines, function: &Function, mut nodes: Vec<usize>) {
    let plan = function.plan;
    nodes.retain(|node| !plan.schedule.bound[*node]);
    let inputs: HashSet<usize> = plan.inputs_of(nodes);
    let names: HashSet<&str> = inputs.iter().filter_map(|node| plan.name(*node)).collect();
    let read = function.needs.reads.iter().filter(|(name, _)| names.contains(name.as_str()));
    let fields: Vec<String> = read
        .map(|(name, field)| if name == field { name.clone() } else { format!("{field}: {name}") })
        .collect();
    if !fields.is_empty() {
        let rest = if fields.len() < function.posture.fields().len() { ", .." } else { "" };
        out.code(&format!("let Posture {{ {}{rest} }} = *posture;", fields.join(", ")));
    }
    for argument in plan.arguments().iter().filter(|argument| argument.size.is_some()) {
        let read = plan.read(argument, &inputs);
        if read.contains(&true) {
            let name = |(k, read)| if read { plan.entry(argument, k) } else { "_".to_string() };
            let names: Vec<String> = read.into_iter().enumerate().map(name).collect();
            out.code(&format!("let [{}] = *{};", names.join(", "), argument.name));
        }
    }
}
