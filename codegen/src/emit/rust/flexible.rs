//! The flexible kinematics of a table as Rust: a function for each form.

use std::collections::BTreeMap;

use super::super::hash::provenance;
use super::statements::{BLOCK, Statements, sin_cos};
use super::style::Rust;
use super::{RustOptions, shapes, table};
use crate::derive::{COMPONENTS, Displacements, Form, flexible};
use crate::emit::lines::Lines;
use crate::ir::{Constants, Function, Statement, Term, blocks, lively, read};
use crate::robot::Robot;

/// A module with `exact`, `published` and `first_order`: the tool's pose with a displacement at
/// every place (Jweeg & Al-Khafaji 2012, eq. 20). The same table always gives the same bytes.
pub fn flexible_rust(
    robot: &Robot,
    displacements: &Displacements,
    options: &RustOptions,
) -> String {
    let mut out = Lines::at(0);
    let n = robot.dof();
    let head = format!("{}: its flexible kinematics. {}", robot.name, provenance(robot));
    out.wrapped(&head, "// ");
    out.code(
        "// Not to be edited: `stiffarm generate ROBOT --emit rust --flexible … --check FILE`",
    );
    out.code("// compares it with the table.");
    out.code(&format!("use {}::{{Pose, Scalar}};", options.kernels));
    out.blank();
    out.doc("Displacements of the closed forms; all others count as zero.");
    let kept: Vec<String> = kept(displacements, n).map(|(name, _)| format!("{name:?}")).collect();
    out.within(&format!("pub const DISPLACEMENTS: [&str; {}] = [", kept.len()), "];", |out| {
        kept.chunks(6).for_each(|six| out.code(&format!("{},", six.join(", "))))
    });
    if !robot.symbols().is_empty() {
        table::symbols(&mut out, robot);
    }
    for form in Form::EACH {
        function(&mut out, robot, displacements, form);
    }
    out.finish()
}

fn function(out: &mut Lines, robot: &Robot, displacements: &Displacements, form: Form) {
    let program = flexible(robot, displacements, form);
    let ops = program.ops();
    let function = Function::new(program, &mut Constants::written_in_place(), false);
    out.blank();
    let (first, second) = match form {
        Form::Exact => ("Pose of the displaced tool, base axes: exact.", "eq. 20 with eq. 18"),
        Form::Published => (
            "Pose of the displaced tool, base axes: the published approximation.",
            "eq. 20 with eq. 19, as in eqs. 57 and 58: sines are angles and cosines are 1 in each \
             E; the axes are not quite orthonormal",
        ),
        Form::FirstOrder => (
            "Pose of the displaced tool, base axes: the strict first order.",
            "every product of two displacements is left out; the axes are not quite orthonormal",
        ),
    };
    out.doc(first);
    out.doc("");
    out.doc(&format!(
        "T = E_0 A_1 E_1 … A_n E_n T_tool E_tool (Jweeg & Al-Khafaji 2012; {second}). `e[i]` is \
         δx, δy, δz (m), dψ, dβ, dφ (rad, about x, y, z) at place i: 0 the base, i behind row i, \
         then the tool.",
    ));
    out.doc("");
    out.doc(&format!("{} additions, {} multiplications.", ops.add, ops.mul));
    body(out, robot, displacements, &function, form);
}

fn body(
    out: &mut Lines,
    robot: &Robot,
    displacements: &Displacements,
    function: &Function,
    form: Form,
) {
    let (n, style) = (robot.dof(), &Rust { fused: false, constants: "parameters" });
    let inputs = inputs(function, n, displacements);
    let terms = function.angles.iter().map(|angle| &angle.sum);
    let terms: Vec<&Term> = terms.chain(inputs.values()).collect();
    let reads = |is: &dyn Fn(&Term) -> bool| terms.iter().any(|term| term.any(is));
    let entry = |of: &str| {
        let is = |leaf: &Term| matches!(leaf, Term::Entry(array, _) if *array == of);
        if reads(&is) { "" } else { "_" }
    };
    let mut arguments = Vec::new();
    if !robot.symbols().is_empty() {
        let read = function.constants || reads(&|leaf| matches!(leaf, Term::Constant(_)));
        arguments.push(format!("{}parameters: &Parameters<S>", if read { "" } else { "_" }));
    }
    arguments.push(format!("{}q: &[S; {n}]", entry("q")));
    arguments.push(format!("{}e: &[[S; 6]; {}]", entry("e"), n + 2));
    out.code(&format!("pub fn {}<S: Scalar>(", form.name()));
    out.indent();
    arguments.iter().for_each(|argument| out.code(&format!("{argument},")));
    out.dedent();
    out.within(") -> Pose<S> {", "}", |out| {
        if !function.angles.is_empty() {
            let sums: Vec<String> = function.angles.iter().map(|a| a.sum.print(style)).collect();
            let [pattern, call] = sin_cos(&function.angles, &sums);
            out.code(&pattern);
            out.indent();
            out.code(&call);
            out.dedent();
        }
        for (name, from) in &inputs {
            out.code(&format!("let {name} = {};", from.print(style)));
        }
        out.code("let zero = S::lit(0.0);");
        let held = &function.blocks()[0].held;
        out.code(&format!("let mut out = {};", shapes::zero(held, n)));
        let place = |_, entry| format!("out{}", shapes::place(held, n, entry));
        let body: &[Statement] = &function.body;
        let statements = Statements { body, style, place: &place };
        match blocks(body, BLOCK).as_slice() {
            [_] => statements.steps(out, 0..body.len()),
            blocks => {
                let blocks = lively(body, blocks.iter().cloned());
                blocks.iter().for_each(|block| statements.block(out, block));
            }
        }
        out.code("out");
    });
}

/// Displacements and prismatic joints that are read outside of sines and cosines.
fn inputs(function: &Function, n: usize, displacements: &Displacements) -> BTreeMap<String, Term> {
    let names = read(&function.body);
    let joints = function.plain.iter().map(|plain| (plain.field().to_string(), plain.source()));
    let displaced = kept(displacements, n).map(|(name, at)| (name, Term::Entry("e", at.to_vec())));
    joints.chain(displaced).filter(|(name, _)| names.contains(name.as_str())).collect()
}

/// The displacements of the closed forms: their names, and place and component.
fn kept(displacements: &Displacements, n: usize) -> impl Iterator<Item = (String, [usize; 2])> {
    let places = (0..n + 2).flat_map(|place| (0..6).map(move |component| [place, component]));
    let kept = places.filter(|[place, component]| displacements.has(*place, *component));
    kept.map(|at| (format!("{}{}", COMPONENTS[at[1]], at[0]), at))
}
