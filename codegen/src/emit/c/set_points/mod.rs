//! Set-points under a load in C: the Rust kernels' steps behind the closed form, operation by operation.

mod text;

use stiffarm_kernels::Steps;

use super::Module;
use super::Sines;
use crate::derive::steps;
use crate::emit::lines::Lines;
use crate::ir::Extra;
use crate::robot::{CLOSED_FORM, Family, GIVES};
use text::{at_rest, displaced, missed, step, whole};

/// What the text of an arm depends on.
struct Text {
    name: String,
    upper: String,
    real: &'static str,
    suffix: &'static str,
    /// The parameters behind readings, and what is handed on of them.
    given: [String; 2],
    /// The closed form's function.
    closed: &'static str,
    links: bool,
    /// Whether the function of what gives takes a wrench.
    loads: bool,
    moves: bool,
    margin: Option<[f64; 2]>,
    steps: Steps,
    /// Joints.
    n: usize,
    branches: usize,
    /// The joint that is given.
    held: Option<usize>,
    /// Whether the elbow's angle is.
    elbow: bool,
}

impl Text {
    /// Of an arm of which they are written: not of a GPU's, nor without sines.
    fn of(module: &Module) -> Option<Text> {
        let form = module.ir.robot.inverse_kinematics?;
        if form.is_search() {
            return None;
        }
        let written = module.options.sines != Sines::Given && !module.language.device;
        if !written || !module.ir.robot.has_set_points() {
            return None;
        }
        let (name, real) = (module.name().to_owned(), module.language.real());
        let upper = name.to_uppercase();
        let find = |called: &str| module.ir.functions().find(|f| f.name() == called);
        let gives = find(GIVES)?;
        let tool = gives.blocks().last()?;
        let deflection = find(crate::robot::DEFLECTION.name())?;
        let margin = deflection.solves().find_map(|solve| solve.margin);
        let extras = &module.ir.readings.extras;
        let parameter = |extra: &Extra| match extra {
            Extra::Sides => format!(", const {real} sides[{upper}_JOINTS]"),
            Extra::Warming => format!(", {real} warming"),
        };
        let given = [extras.iter().map(parameter).collect(), module.ir.readings.handed_on()];
        let exact = find(CLOSED_FORM).is_none();
        Some(Text {
            closed: if exact { crate::robot::INVERSE_KINEMATICS } else { CLOSED_FORM },
            links: tool.entries.iter().any(|e| !e.is_zero()),
            loads: !gives.arguments.is_empty(),
            moves: module.ir.readings.moves,
            margin: margin.map(|margin| margin.map(|most| most.to_f64())),
            steps: steps(module.ir.robot, form),
            n: module.ir.robot.dof(),
            branches: form.branches(),
            held: form.given,
            elbow: form.family == Family::ElbowAngle,
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

    fn head(&self) -> String {
        let Text { name, upper, real, given: [parameters, _], .. } = self;
        format!(
            "void {name}_set_points(const {real} q[{upper}_JOINTS]{parameters}, const {real} target[12],\n    \
             const {real} wrench[6], {name}_set_points_t *out)"
        )
    }
}

/// The declarations of the header.
pub(super) fn declared(module: &Module, out: &mut Lines) {
    let Some(text) = Text::of(module) else { return };
    let Text { name, real, steps: Steps { loaded, .. }, branches, .. } = &text;
    let head = text.head();
    out.verbatim(&format!(
        "
/* Everything that {name}_set_points computes. */
typedef struct
{{
    {real} q[{size}];
    {real} distance[{branches}];
    {real} tilt[{branches}];
}} {name}_set_points_t;

/* The readings at which the loaded arm's tool stands at a pose, at rest under a wrench and its weights, branch by
 * branch: the closed form, {loaded} steps behind it, and what the springs give there.
 * q: a column for each branch, in rad. distance: how far the tool's origin is from the target's, in m; infinite where
 * the arm does not bear the load. tilt: how far its axes are turned, twice the sine of half the angle.
 * `q`: readings near which free joints stay; `target`: pose of the tool: its axes x, y, z, its origin; `wrench`: force
 * and moment on the tool, in N and N*m. */
{head};
",
        size = text.n * branches,
    ));
}

/// The functions of the source.
pub(super) fn written(module: &Module, out: &mut Lines) {
    let Some(text) = Text::of(module) else { return };
    let Text { name, real, given: [parameters, _], n, .. } = &text;
    out.blank();
    out.comment(&["The posture at joint values, not at readings.".to_owned()]);
    out.code(&format!(
        "static void posture_at(const {real} q[{n}]{parameters}, {name}_posture_t *posture)"
    ));
    out.braces(|out| module.fields(out, &module.ir.posture, false));
    if text.steps.loaded > 0 {
        out.verbatim(&step(&text));
    }
    out.verbatim(&missed(&text));
    if text.links {
        out.verbatim(&displaced(&text));
    }
    out.verbatim(&at_rest(&text));
    out.verbatim(&whole(&text));
}
