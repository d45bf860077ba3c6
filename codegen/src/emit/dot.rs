//! The dot printer: the graph itself, to be drawn by Graphviz.

use std::fmt::Write as _;

use crate::derive::{COMPONENTS, Output, derive};
use crate::expr::{Expr, Graph, Node, Symbol};
use crate::ir::component;
use crate::robot::Robot;

/// The graph of `outputs` worked out together: operations as circles, inputs as boxes, entries as
/// double octagons; a dashed edge subtracts or negates.
pub fn dot(robot: &Robot, outputs: &[Output]) -> String {
    let program = derive(robot, outputs);
    let g = &program.graph;
    let mut text =
        format!("digraph {:?} {{\n  rankdir=BT;\n  node [fontname=\"sans-serif\"];\n", robot.name);
    let reachable = g.reachable(&program.roots());
    for node in (0..g.nodes().len()).filter(|node| reachable[*node]) {
        let (label, shape) = label(g, node);
        let name = g.name_of(node).map_or(String::new(), |name| format!("\\n{name}"));
        let _ = writeln!(text, "  n{node} [label=\"{label}{name}\", shape={shape}];");
        for operand in g.nodes()[node].operands() {
            edge(&mut text, operand, &format!("n{node}"));
        }
    }
    for (k, solve) in program.solves.iter().enumerate() {
        let _ = writeln!(text, "  solve{k} [label=\"solve\", shape=hexagon];");
        let inputs = solve.matrix.iter().chain(&solve.right).filter(|e| !e.is_zero());
        inputs.for_each(|e| edge(&mut text, *e, &format!("solve{k}")));
        for unknown in &solve.unknowns {
            let _ = writeln!(text, "  solve{k} -> n{};", unknown.node());
        }
    }
    for block in &program.blocks {
        let rows = block.held.shape(program.dof).0;
        for (entry, e) in block.entries.iter().enumerate().filter(|(_, e)| !e.is_zero()) {
            let (row, column) = (entry % rows + 1, entry / rows + 1);
            let name = format!("{}_{row}_{column}", block.held.name());
            let label = format!("{} {row},{column}", block.held.name());
            let _ = writeln!(text, "  {name} [label=\"{label}\", shape=doubleoctagon];");
            edge(&mut text, *e, &name);
        }
    }
    text.push_str("}\n");
    text
}

fn edge(text: &mut String, from: Expr, to: &str) {
    let style = if from.is_negative() { " [style=dashed]" } else { "" };
    let _ = writeln!(text, "  n{} -> {to}{style};", from.node());
}

fn label(g: &Graph, node: usize) -> (String, &'static str) {
    match g.nodes()[node] {
        Node::Number(n) => (n.to_string(), "plaintext"),
        Node::Symbol(s) => match g.symbol_of(s) {
            Symbol::Joint(joint) => (format!("q{}", joint + 1), "box"),
            Symbol::Side(joint) => (format!("side{}", joint + 1), "box"),
            Symbol::Warming => ("warming".to_string(), "box"),
            Symbol::Growth => ("growth".to_string(), "box"),
            Symbol::Rate(_) | Symbol::Acceleration(_) | Symbol::Torque(_) | Symbol::Wrench(_) => {
                let named = g.symbol_of(s).input().map(|(input, k)| component(input, k));
                (named.unwrap_or_default(), "box")
            }
            Symbol::Parameter(name) => (name.clone(), "box"),
            Symbol::Displacement { place, component } => {
                (format!("{}{place}", COMPONENTS[*component]), "box")
            }
            Symbol::Response(joint) => (format!("ddq{}", joint + 1), "box"),
            Symbol::Deflection { joint, .. } => (format!("dq{}", joint + 1), "box"),
            Symbol::Own { input, entry } => (format!("input {input}, {entry}"), "box"),
        },
        Node::Add(..) => ("+".to_string(), "circle"),
        Node::Mul(..) => ("×".to_string(), "circle"),
        Node::Recip(_) => ("1/x".to_string(), "circle"),
        Node::Sign(_) => ("sign".to_string(), "circle"),
        Node::Sqrt(_) => ("√".to_string(), "circle"),
        Node::Sin(_) => ("sin".to_string(), "ellipse"),
        Node::Cos(_) => ("cos".to_string(), "ellipse"),
        Node::Atan2(..) => ("atan2".to_string(), "ellipse"),
        Node::Select(..) => ("> 0 ?".to_string(), "diamond"),
    }
}
