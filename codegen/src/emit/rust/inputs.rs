//! What a run of steps reads of a function's arguments, taken out of them by name.

use std::collections::HashSet;
use std::ops::Range;

use super::super::plan::{Plan, Target, WRENCH};
use super::posture::field_names;
use crate::emit::lines::Lines;
use crate::expr::{Binding, Expr, Node, Symbol};

/// Everything that a range of steps reads.
pub(super) fn open_inputs(out: &mut Lines, plan: &Plan, steps: Range<usize>) {
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
    open(out, plan, nodes);
}

/// What the linear systems read.
pub(super) fn open_solve_inputs(out: &mut Lines, plan: &Plan) {
    let items = 0..plan.targets.len();
    let solves = items.filter(|i| matches!(plan.targets[*i], Target::Solve(_)));
    open(out, plan, solves.flat_map(|i| item_inputs(plan, i)).collect());
}

fn item_inputs(plan: &Plan, item: usize) -> Vec<usize> {
    match plan.targets[item] {
        Target::Solve(k) => {
            let solve = &plan.program.solves[k];
            solve.matrix.iter().chain(&solve.right).map(|e| e.node()).collect()
        }
        Target::Entry { block, entry } => {
            vec![plan.program.blocks[block].entries[entry].node()]
        }
    }
}

/// `let Posture { s1, c1, .. } = *posture;` and the wrench, whatever of them is read.
fn open(out: &mut Lines, plan: &Plan, mut nodes: Vec<usize>) {
    nodes.retain(|node| !plan.schedule.bound[*node]);
    let inputs: HashSet<usize> = plan.inputs_of(nodes);
    let g = &plan.program.graph;
    let mut fields: Vec<(usize, String)> = Vec::new();
    let mut wrench = [false; 6];
    for node in &inputs {
        let name = plan.name(*node).unwrap_or_default().to_string();
        match g.nodes()[*node] {
            _ if name.starts_with("constants.") => {}
            Node::Sin(_) | Node::Cos(_) => fields.push((*node, name)),
            Node::Symbol(s) => match g.symbol_of(s) {
                Symbol::Joint(_) => fields.push((*node, name)),
                Symbol::Wrench(k) => wrench[*k] = true,
                _ => {}
            },
            _ => {}
        }
    }
    let order = field_names(plan);
    fields.sort_by_key(|(_, name)| order.iter().position(|f| f == name));
    if !fields.is_empty() {
        let names: Vec<String> = fields.iter().map(|(_, name)| name.clone()).collect();
        let rest = if names.len() < order.len() { ", .." } else { "" };
        out.code(&format!("let Posture {{ {}{rest} }} = *posture;", names.join(", ")));
    }
    if wrench.contains(&true) {
        let names: Vec<&str> =
            WRENCH.iter().zip(wrench).map(|(n, used)| if used { *n } else { "_" }).collect();
        out.code(&format!("let [{}] = *wrench;", names.join(", ")));
    }
}
