//! The search for every solution of six axes in any position: the Rust kernels' in double precision, operation by operation.

use stiffarm_kernels::Axes;

use super::{Module, Text};
use crate::emit::c::Precision;
use crate::emit::c::arctangent::direction;
use crate::emit::c::trigonometry::of_one_double;
use crate::robot::Robot;

/// What does not depend on the arm, which is called `arm`.
const SEARCH: &str = concat!(
    include_str!("search/moved.c"),
    include_str!("search/equations.c"),
    include_str!("search/angles.c"),
    include_str!("search/newton.c"),
    include_str!("search/nearest.c"),
    include_str!("search/whole.c"),
);

/// The search, the arm's axes, and the function that searches by them, in the closed form's place.
pub(super) fn search(text: &Text, third: usize, module: &Module) -> String {
    let Text { name, real, local, given: [parameters, given], n, held, moves, .. } = text;
    let [lines, home] = match n {
        7 => axes::<7>(module.ir.robot),
        _ => axes::<6>(module.ir.robot),
    };
    let angle = direction(Precision::F64).replace("direction(", "arm_angle_of(");
    let (held, values) = (held.unwrap_or(*n), n * text.branches);
    let unread = module.ir.readings.extras.iter().map(|e| format!("    (void){};\n", e.name()));
    let joints = match moves {
        true => format!("    arm_joints(q{given}, joints);\n"),
        false => {
            unread.chain(["    (void)memcpy(joints, q, sizeof joints);\n".to_owned()]).collect()
        }
    };
    let own = format!(
        "
static const arm_line_t arm_axes[{n}] = {lines};
static const arm_moved_t arm_home = {home};

typedef struct
{{
    {real} q[{values}];
    {real} distance[16];
    {real} tilt[16];
}} arm_search_t;

static void arm_search(const {real} q[{n}]{parameters}, const {real} target[12], arm_search_t *out)
{{
    {real} joints[{n}];
    double near[{n}];
    double to[12];
    double found[{values}];
    double distance[16];
    double tilt[16];
    unsigned int k;

{joints}    for (k = 0U; k < {n}U; k++)
    {{
        near[k] = (double)joints[k];
    }}
    for (k = 0U; k < 12U; k++)
    {{
        to[k] = (double)target[k];
    }}
    arm_search_all(arm_axes, &arm_home, {n}U, near, to, {held}U, {third}U, found, distance, tilt);
    for (k = 0U; k < {values}U; k++)
    {{
        out->q[k] = ({real})found[k];
    }}
    for (k = 0U; k < 16U; k++)
    {{
        out->distance[k] = ({real})distance[k];
        out->tilt[k] = ({real})tilt[k];
    }}
}}
"
    );
    let search = SEARCH.replace("    POLYNOMIAL\n", &of_one_double());
    let whole = format!("{angle}{search}{own}").replace("static ", &format!("{local} "));
    whole.replace("arm_", &format!("{name}_"))
}

/// The axes, and the tool with the joint values at zero.
fn axes<const N: usize>(robot: &Robot) -> [String; 2] {
    let Axes { lines, home } = robot.axes::<N>();
    let braces = |text: String| text.replace('[', "{").replace(']', "}");
    let home = format!("{{{:?}, {:?}}}", home.rotation, home.position);
    [braces(format!("{lines:?}")), braces(home)]
}
