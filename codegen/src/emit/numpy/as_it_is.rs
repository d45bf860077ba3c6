//! The arm as it is in NumPy, unloaded and at rest under a load: steps behind the closed form or the search, for all branches
//! at once.

use stiffarm_kernels::{Axes, Output, Steps};

use super::{Printer, check, docstring, of_state, parameters};
use crate::derive::steps;
use crate::emit::lines::Lines;
use crate::ir::{Function, Module};
use crate::robot::{
    CLOSED_FORM, ClosedForm, DEFLECTION, ELBOW_ANGLE, Family, GIVES, INVERSE_KINEMATICS, Robot,
};

/// What each branch is followed by.
const STEPS: &str = include_str!("steps.py");

/// The search: the equations of the Rust kernels', whose roots NumPy finds as eigenvalues.
const SEARCH: &str = include_str!("search.py");

/// The functions, where the arm has them.
pub(super) fn functions(module: &Module, out: &mut Lines) {
    let Some(form) = module.robot.inverse_kinematics else {
        return;
    };
    let exact = !form.is_search() && find(module, CLOSED_FORM).is_none();
    let loaded = module.robot.has_set_points();
    if exact && !loaded {
        return;
    }
    out.verbatim(STEPS);
    if form.is_search() {
        out.verbatim(SEARCH);
        out.verbatim("\n\n");
        let axes = if module.robot.dof() == 7 { axes::<7> } else { axes::<6> };
        axes(module.robot, out);
    }
    if module.readings.moves {
        for of in at_joints(loaded).filter_map(|name| find(module, name)) {
            Printer { of, module, at_joints: true }.function(out);
        }
    }
    let counts = steps(module.robot, form);
    if !exact {
        function(module, (form, CLOSED_FORM, counts), false, out);
    }
    if loaded {
        let closed = if exact { INVERSE_KINEMATICS } else { CLOSED_FORM };
        function(module, (form, closed, counts), true, out);
    }
}

/// The axes, and the tool with the joint values at zero.
fn axes<const N: usize>(robot: &Robot, out: &mut Lines) {
    let Axes { lines, home } = robot.axes::<N>();
    let columns = home.columns();
    out.code(&format!("_AXES = np.array({lines:?})"));
    out.code(&format!("_HOME = np.vstack([np.array({columns:?}).T, [0.0, 0.0, 0.0, 1.0]])"));
}

fn find<'m>(module: &'m Module, name: &str) -> Option<&'m Function> {
    module.functions().find(|function| function.name() == name)
}

/// What the steps take at joint values.
fn at_joints(loaded: bool) -> impl Iterator<Item = &'static str> {
    let rigid = [Output::Pose.name(), Output::Jacobian.name()];
    let load = loaded.then_some([GIVES, DEFLECTION.name()]);
    rigid.into_iter().chain(load.into_iter().flatten())
}

/// The function of the rigid arm, or of the loaded one.
fn function(
    module: &Module,
    (form, closed, counts): (ClosedForm, &str, Steps),
    loaded: bool,
    out: &mut Lines,
) {
    let Steps { unloaded, loaded: under, readings } = counts;
    let (name, count) = if loaded { ("set_points", under) } else { (INVERSE_KINEMATICS, unloaded) };
    let state = of_state(module);
    let mut given = state.clone();
    given.push(("target".to_owned(), Some(12)));
    given.extend(loaded.then(|| ("wrench".to_owned(), Some(6))));
    let first = if module.is_symbolic() { "constants, " } else { "" };
    out.verbatim("\n\n");
    out.code(&format!("def {name}({first}{}):", parameters(&given)));
    out.indent();
    let load = if loaded {
        "loaded arm's tool stands at a pose, at rest under a wrench and its weights"
    } else {
        "rigid arm's tool stands at a pose"
    };
    let begin = match form.is_search() {
        true => "as many as a search finds, at most sixteen in no order, nan behind them;",
        false => "branch by branch: the closed form and",
    };
    let said = [
        format!("The readings at which the {load}, {begin} {count} steps behind it."),
        "q: a column for each branch, in rad. distance: how far the tool's origin is from the target's, in m. tilt: how far \
         its axes are turned, twice the sine of half the angle. A branch in which the arm does not bear its load misses the \
         target by inf."
            .to_owned(),
        format!(
            "q: readings near which free joints stay; target: pose of the tool: its axes x, y, z, its origin{}.",
            if loaded { "; wrench: force and moment on the tool, in N and N*m" } else { "" }
        ),
    ];
    docstring(out, &said[..]);
    check(out, &given);
    let handed_on = module.readings.handed_on();
    let angle = match form.family {
        Family::ElbowAngle => format!(", {ELBOW_ANGLE}({first}q{handed_on})"),
        _ => String::new(),
    };
    let joints = |at: &str| match module.readings.moves {
        true => format!("joints({at}{handed_on})"),
        false => at.to_owned(),
    };
    let held = form.given.map_or("None".to_owned(), |joint| joint.to_string());
    out.code(&match form.family {
        Family::Search { third } => {
            format!("begin = _search({}, target, {held}, {third})", joints("q"))
        }
        _ => format!("begin = {closed}({first}q{handed_on}, target{angle})[\"q\"]"),
    });
    for (name, size) in &given[1..] {
        match (name.as_str(), size) {
            ("target", _) => {}
            (_, Some(_)) => out.code(&format!("{name} = {name}[..., None, :]")),
            (_, None) => out.code(&format!("{name} = {name}[..., None]")),
        }
    }
    // A function at joint values, and what it takes of the load.
    let at = |name: &str| {
        let called = if module.readings.moves { format!("_{name}_at") } else { name.to_owned() };
        let takes = find(module, name).is_some_and(|f| !f.arguments.is_empty());
        let wrench = if takes { ", wrench" } else { "" };
        format!("{called}({first}at{handed_on}{wrench})")
    };
    let [pose, jacobian] = [Output::Pose, Output::Jacobian].map(|output| at(output.name()));
    let (gives, sag) = (at(GIVES), at(DEFLECTION.name()));
    let (stands, gives) = match loaded {
        true => (
            format!("_displaced({pose}, {gives}[\"tool\"])"),
            format!(
                "np.where(np.isfinite({sag}).all(axis=-1, keepdims=True), {gives}[\"joints\"], np.nan)"
            ),
        ),
        false => (pose, "0.0".to_owned()),
    };
    out.within("return _follow(", ")", |out| {
        out.code(&format!("begin, target, {count}, {readings}, {held},"));
        let of = [stands, jacobian, gives, joints("at")];
        of.iter().for_each(|function| out.code(&format!("lambda at: {function},")));
    });
    out.dedent();
}
