//! The arm as it is in C and CUDA, unloaded and at rest under a load: the Rust kernels' steps behind the closed form or the
//! search, operation by operation.

mod search;
mod text;

use stiffarm_kernels::Steps;

use super::Module;
use super::Sines;
use crate::derive::steps;
use crate::emit::lines::Lines;
use crate::ir::Extra;
use crate::robot::{CLOSED_FORM, Family, GIVES};
use text::{displaced, follow, missed, stands, step, whole};

/// What the text of an arm depends on.
struct Text {
    name: String,
    upper: String,
    /// What stands before the functions of the file, and before those that others call.
    local: &'static str,
    linkage: &'static str,
    real: &'static str,
    suffix: &'static str,
    /// The parameters behind readings, and what is handed on of them.
    given: [String; 2],
    /// The closed form's function.
    closed: &'static str,
    links: bool,
    /// Whether it is under a load, and not rigid.
    loaded: bool,
    /// Whether the function of what gives takes a wrench.
    loads: bool,
    moves: bool,
    margin: Option<[f64; 2]>,
    /// Steps to joint values, and from those to readings.
    steps: [usize; 2],
    /// Joints.
    n: usize,
    branches: usize,
    /// The joint that is given.
    held: Option<usize>,
    /// Whether the elbow's angle is.
    elbow: bool,
    /// Of a search, the joint in the middle of the equations.
    third: Option<usize>,
}

impl Text {
    /// Of an arm of which they are written: not without sines, nor of the rigid arm where that has no steps.
    fn of(module: &Module, loaded: bool) -> Option<Text> {
        let form = module.ir.robot.inverse_kinematics?;
        let third = match form.family {
            Family::Search { third } => Some(third),
            _ => None,
        };
        let written = module.options.sines != Sines::Given;
        let (name, real) = (module.name().to_owned(), module.language.real());
        let upper = name.to_uppercase();
        let find = |called: &str| module.ir.functions().find(|f| f.name() == called);
        let exact = third.is_none() && find(CLOSED_FORM).is_none();
        if !written || if loaded { !module.ir.robot.has_set_points() } else { exact } {
            return None;
        }
        let gives = find(GIVES);
        let tool = gives.and_then(|gives| gives.blocks().last());
        let deflection = find(crate::robot::DEFLECTION.name());
        let margin = deflection.and_then(|d| d.solves().find_map(|solve| solve.margin));
        let Steps { unloaded, loaded: under, readings } = steps(module.ir.robot, form);
        let extras = &module.ir.readings.extras;
        let parameter = |extra: &Extra| match extra {
            Extra::Sides => format!(", const {real} sides[{upper}_JOINTS]"),
            Extra::Warming => format!(", {real} warming"),
        };
        let given = [extras.iter().map(parameter).collect(), module.ir.readings.handed_on()];
        Some(Text {
            closed: match third {
                Some(_) => "search",
                None if exact => crate::robot::INVERSE_KINEMATICS,
                None => CLOSED_FORM,
            },
            third,
            links: tool.is_some_and(|tool| tool.entries.iter().any(|e| !e.is_zero())),
            loaded,
            loads: gives.is_some_and(|gives| !gives.arguments.is_empty()),
            moves: module.ir.readings.moves,
            margin: margin.map(|margin| margin.map(|most| most.to_f64())),
            steps: [if loaded { under } else { unloaded }, readings],
            n: module.ir.robot.dof(),
            branches: form.branches(),
            held: form.given,
            elbow: form.family == Family::ElbowAngle,
            local: module.language.local(),
            linkage: module.language.linkage(),
            suffix: module.language.suffix(),
            name,
            upper,
            real,
            given,
        })
    }

    /// A number as the Rust text has it.
    fn lit(&self, x: f64) -> String {
        match self.suffix {
            "" => format!("{x:?}"),
            suffix => format!("{:?}{suffix}", x as f32),
        }
    }

    /// What it is called behind the arm's name.
    fn function(&self) -> &'static str {
        if self.loaded { "set_points" } else { crate::robot::INVERSE_KINEMATICS }
    }

    /// Something where it is under a load.
    fn under<'t>(&self, load: &'t str) -> &'t str {
        if self.loaded { load } else { "" }
    }

    fn head(&self) -> String {
        let Text { name, upper, linkage, real, given: [parameters, _], .. } = self;
        let function = self.function();
        let wrench = format!("const {real} wrench[6], ");
        let wrench = self.under(&wrench);
        format!(
            "{linkage}void {name}_{function}(const {real} q[{upper}_JOINTS]{parameters}, const {real} target[12],\n    \
             {wrench}{name}_{function}_t *out)"
        )
    }
}

/// The arm rigid and under a load, where each is written.
fn texts(module: &Module) -> impl Iterator<Item = Text> {
    [false, true].into_iter().filter_map(|loaded| Text::of(module, loaded))
}

/// Their names, what they take behind readings and what is given beside those, and how many branches they have.
pub(in crate::emit) fn functions(
    module: &Module,
) -> impl Iterator<Item = (&'static str, Vec<(&'static str, usize)>, usize)> {
    texts(module).map(|text| {
        let takes = [("target", 12), ("wrench", 6)];
        (text.function(), takes[..1 + usize::from(text.loaded)].to_vec(), text.branches)
    })
}

/// The declarations of the header.
pub(in crate::emit) fn declared(module: &Module, out: &mut Lines) {
    for text in texts(module) {
        let Text { name, real, steps: [count, _], branches, .. } = &text;
        let (head, function) = (text.head(), text.function());
        let what = match text.loaded {
            _ if text.third.is_some() => format!(
                "The readings at which the {} arm's tool stands at a pose, as many as a search finds and {count} steps
 * behind it: a search, not a closed form, of at most sixteen solutions in no order.",
                if text.loaded { "loaded" } else { "rigid" }
            ),
            true => format!(
                "The readings at which the loaded arm's tool stands at a pose, at rest under a wrench and its weights, branch by
 * branch: the closed form, {count} steps behind it, and what the springs give there."
            ),
            false => format!(
                "The readings at which the rigid arm's tool stands at a pose, branch by branch: the closed form of the nearest
 * table that has one, and {count} steps behind it."
            ),
        };
        out.verbatim(&format!(
            "
/* Everything that {name}_{function} computes. */
typedef struct
{{
    {real} q[{size}];
    {real} distance[{branches}];
    {real} tilt[{branches}];
}} {name}_{function}_t;

/* {what}
 * q: a column for each branch, in rad. distance: how far the tool's origin is from the target's, in m{infinite}
 * tilt: how far its axes are turned, twice the sine of half the angle.
 * `q`: readings near which free joints stay; `target`: pose of the tool: its axes x, y, z, its origin{wrench}. */
{head};
",
            size = text.n * branches,
            infinite = match text.loaded {
                _ if text.third.is_some() => "; infinite where\n * there is no solution.",
                true => "; infinite where\n * the arm does not bear the load.",
                false => ".",
            },
            wrench = text.under("; `wrench`: force\n * and moment on the tool, in N and N*m"),
        ));
    }
}

/// The functions of the source.
pub(in crate::emit) fn written(module: &Module, out: &mut Lines) {
    let texts: Vec<Text> = texts(module).collect();
    let Some(first) = texts.first() else { return };
    let Text { name, local, real, given: [parameters, _], n, .. } = first;
    out.blank();
    out.comment(&["The posture at joint values, not at readings.".to_owned()]);
    out.code(&format!(
        "{local} void {name}_posture_at(const {real} q[{n}]{parameters}, {name}_posture_t *posture)"
    ));
    out.braces(|out| module.fields(out, &module.ir.posture, false));
    if let Some(third) = first.third {
        out.verbatim(&search::search(first, third, module));
    }
    if texts.iter().any(|text| text.steps[0] > 0) {
        out.verbatim(&step(first));
    }
    out.verbatim(&missed(first));
    for text in &texts {
        if text.loaded {
            if text.links {
                out.verbatim(&displaced(text));
            }
            out.verbatim(&stands(text));
        }
        out.verbatim(&follow(text));
        out.verbatim(&whole(text));
    }
}
