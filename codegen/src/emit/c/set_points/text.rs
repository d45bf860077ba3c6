//! The functions themselves, each as the Rust kernels have it.

use super::Text;

/// A step.
pub(super) fn step(text: &Text) -> String {
    let Text { name, local, real, n, .. } = text;
    let (zero, half, one) = (text.lit(0.0), text.lit(0.5), text.lit(1.0));
    let (entries, square) = (6 * n, n * n);
    // Eight units of rounding.
    let rounding = match text.suffix {
        "" => text.lit(8.0 * f64::EPSILON),
        _ => text.lit(8.0 * f64::from(f32::EPSILON)),
    };
    format!(
        "
{local} {real} {name}_dot_6(const {real} a[6], const {real} b[6])
{{
    {real} sum = {zero};
    unsigned int k;

    for (k = 0U; k < 6U; k++)
    {{
        sum = sum + a[k] * b[k];
    }}
    return sum;
}}

/* Adds (J'J + damping)^-1 J'e to joint values, e from where the tool stands to the target; 0 where a number is none. */
{local} int {name}_step(const {real} stands[12], const {real} jacobian[{entries}], const {real} target[12], {real} joints[{n}])
{{
    {real} error[6] = {{{zero}}};
    {real} a[{square}];
    {real} by[{n}];
    {real} inverse[{n}];
    {real} trace = {zero};
    {real} damping;
    int definite = 1;
    unsigned int k;
    unsigned int row;
    unsigned int column;

    for (k = 0U; k < 3U; k++)
    {{
        const {real} *const from = &stands[3U * k];
        const {real} *const to = &target[3U * k];

        error[k] = target[9U + k] - stands[9U + k];
        error[3] = error[3] + {half} * (from[1] * to[2] - from[2] * to[1]);
        error[4] = error[4] + {half} * (from[2] * to[0] - from[0] * to[2]);
        error[5] = error[5] + {half} * (from[0] * to[1] - from[1] * to[0]);
    }}
    for (row = 0U; row < {n}U; row++)
    {{
        for (column = 0U; column <= row; column++)
        {{
            a[(row * {n}U) + column] = {name}_dot_6(&jacobian[6U * row], &jacobian[6U * column]);
        }}
        trace = trace + a[(row * {n}U) + row];
        by[row] = {name}_dot_6(&jacobian[6U * row], error);
    }}
    damping = {name}_dot_6(error, error) + {rounding} * trace;
    for (k = 0U; k < {n}U; k++)
    {{
        const {real} pivot = a[(k * {n}U) + k] + damping;

        if (!(pivot > {zero}))
        {{
            definite = 0;
        }}
        inverse[k] = {one} / pivot;
        for (row = k + 1U; row < {n}U; row++)
        {{
            const {real} factor = a[(row * {n}U) + k] * inverse[k];

            for (column = k + 1U; column <= row; column++)
            {{
                a[(row * {n}U) + column] = a[(row * {n}U) + column] - factor * a[(column * {n}U) + k];
            }}
            by[row] = by[row] - factor * by[k];
        }}
    }}
    for (k = {n}U; k > 0U; k--)
    {{
        const unsigned int last = k - 1U;

        for (row = k; row < {n}U; row++)
        {{
            by[last] = by[last] - a[(row * {n}U) + last] * by[row];
        }}
        by[last] = by[last] * inverse[last];
        joints[last] = joints[last] + by[last];
    }}
    return definite;
}}
"
    )
}

/// What a pose is missed by.
pub(super) fn missed(text: &Text) -> String {
    let Text { name, local, real, .. } = text;
    let (zero, half) = (text.lit(0.0), text.lit(0.5));
    let root = format!("sqrt{}", text.suffix);
    format!(
        "
/* Distance of two poses, and twice the sine of half the angle between their axes. */
{local} void {name}_missed(const {real} a[12], const {real} b[12], {real} *distance, {real} *tilt)
{{
    {real} turned = {zero};
    {real} apart = {zero};
    unsigned int axis;
    unsigned int k;

    for (axis = 0U; axis < 4U; axis++)
    {{
        {real} square = {zero};

        for (k = 3U * axis; k < 3U * axis + 3U; k++)
        {{
            square = square + (a[k] - b[k]) * (a[k] - b[k]);
        }}
        if (axis < 3U)
        {{
            turned = turned + square;
        }}
        else
        {{
            apart = square;
        }}
    }}
    *distance = {root}(apart);
    *tilt = {root}({half} * turned);
}}
"
    )
}

/// A pose displaced by what links, bearings and the base give.
pub(super) fn displaced(text: &Text) -> String {
    let Text { name, local, real, .. } = text;
    let series = |terms: [f64; 4]| {
        let [last, rest @ ..] = terms.map(|term| text.lit(term));
        rest.iter().fold(last, |sum, term| format!("({term} - t * {sum})"))
    };
    let first = series([1.0 / 5040.0, 1.0 / 120.0, 1.0 / 6.0, 1.0]);
    let second = series([1.0 / 40320.0, 1.0 / 720.0, 1.0 / 24.0, 0.5]);
    format!(
        "
/* Moves a pose by a small translation and a rotation vector. */
{local} void {name}_displace({real} pose[12], const {real} by[6])
{{
    const {real} u = by[3];
    const {real} v = by[4];
    const {real} w = by[5];
    const {real} t = u * u + v * v + w * w;
    const {real} first = {first};
    const {real} second = {second};
    unsigned int k;

    for (k = 0U; k < 3U; k++)
    {{
        {real} *const axis = &pose[3U * k];
        const {real} x = v * axis[2] - w * axis[1];
        const {real} y = w * axis[0] - u * axis[2];
        const {real} z = u * axis[1] - v * axis[0];

        axis[0] = axis[0] + first * x + second * (v * z - w * y);
        axis[1] = axis[1] + first * y + second * (w * x - u * z);
        axis[2] = axis[2] + first * z + second * (u * y - v * x);
        pose[9U + k] = pose[9U + k] + by[k];
    }}
}}
"
    )
}

/// Where the loaded tool stands.
pub(super) fn stands(text: &Text) -> String {
    let Text { name, local, real, .. } = text;
    let load = if text.loads { ", wrench" } else { "" };
    let gives = match text.links {
        true => format!(
            "\n    {name}_gives_t gives;\n\n    {name}_given_gives(posture{load}, &gives);\n    \
             {name}_given_pose(posture, pose);\n    {name}_displace(pose, gives.tool);"
        ),
        false => format!("\n    (void)wrench;\n    {name}_given_pose(posture, pose);"),
    };
    format!(
        "
/* Where the loaded tool stands in a posture at rest. */
{local} void {name}_stands_at(const {name}_posture_t *posture, const {real} wrench[6], {real} pose[12])
{{{gives}
}}
"
    )
}

/// One branch.
pub(super) fn follow(text: &Text) -> String {
    let Text { name, upper, local, real, given: [parameters, given], moves, steps, n, .. } = text;
    let entries = 6 * n;
    let [count, readings] = steps;
    let (branch, standing) = (
        text.function(),
        match text.loaded {
            true => format!("{name}_stands_at(&posture, wrench, pose);"),
            false => format!("{name}_given_pose(&posture, pose);"),
        },
    );
    let hold = text.held.map_or_else(String::new, |joint| {
        let (first, zero) = (6 * joint, text.lit(0.0));
        format!(
            "
        for (k = 0U; k < 6U; k++)
        {{
            jacobian[{first}U + k] = {zero};
        }}"
        )
    });
    let stepped = match count {
        0 => String::new(),
        _ => format!(
            "
    for (count = 0U; count < {count}U; count++)
    {{
        {real} jacobian[{entries}];

        {name}_posture_at(joints{given}, &posture);
        {standing}
        {name}_given_jacobian(&posture, jacobian);{hold}
        if ({name}_step(pose, jacobian, target, joints) == 0)
        {{
            definite = 0;
        }}
    }}"
        ),
    };
    let joints = |to: &str| match moves {
        true => format!("{name}_joints(q{given}, {to});"),
        false => format!("(void)memcpy({to}, q, sizeof {to});"),
    };
    let again = joints("at");
    let read = match readings {
        0 => String::new(),
        _ => format!(
            "    for (count = 0U; count < {readings}U; count++)
    {{
        {again}
        for (k = 0U; k < {n}U; k++)
        {{
            q[k] = q[k] + (meant[k] - at[k]);
        }}
    }}
"
        ),
    };
    let (gives, less, rests) = match text.loaded {
        true => (
            gives(text),
            " - give.joints[k]",
            format!(
                "    for (k = 0U; k < {n}U; k++)
    {{
        at[k] = at[k] + give.joints[k];
    }}
"
            ),
        ),
        false => (String::new(), "", String::new()),
    };
    let state = format!(
        "    {name}_status_t status = {upper}_OK;\n    {name}_gives_t give;\n    {real} sag[6];\n"
    );
    let wrench = format!(" const {real} wrench[6],");
    let (state, wrench) = (text.under(&state), text.under(&wrench));
    let end = match text.loaded {
        true => "    (void)sag;\n    return ((definite == 1) && (status == UPPER_OK)) ? 1 : 0;\n",
        false => "    return definite;\n",
    };
    let end = end.replace("UPPER", upper);
    format!(
        "
/* The readings of one branch from its joint values, and what they miss the target by; 0 where the arm is not at rest. */
{local} int {name}_{branch}_of(const {real} begin[{n}]{parameters}, const {real} target[12],{wrench}
    {real} q[{n}], {real} *distance, {real} *tilt)
{{
{state}    {name}_posture_t posture = {{0}};
    {real} joints[{n}];
    {real} meant[{n}];
    {real} at[{n}];
    {real} pose[12];
    int definite = 1;
    unsigned int k;
    unsigned int count = 0U;

    (void)count;
    (void)memcpy(joints, begin, sizeof joints);{stepped}
{gives}    for (k = 0U; k < {n}U; k++)
    {{
        meant[k] = joints[k]{less};
        q[k] = meant[k];
    }}
{read}    {again}
{rests}    {name}_posture_at(at{given}, &posture);
    {standing}
    {name}_missed(pose, target, distance, tilt);
{end}}}
"
    )
}

/// What the joints give in a posture, and whether the arm bears its load there.
fn gives(text: &Text) -> String {
    let Text { name, given: [_, given], .. } = text;
    let load = if text.loads { ", wrench" } else { "" };
    let deflection =
        format!("status = {name}_given_deflection_with_gravity(&posture, wrench, sag);\n");
    let bears = match text.margin {
        Some([force, moment]) => {
            let [force, moment, zero] = [force, moment, 0.0].map(|x| text.lit(x));
            format!(
                "    if (!(load_margin(wrench, {force}, {moment}) > {zero}))\n    {{\n        {deflection}    }}\n"
            )
        }
        None => format!("    {deflection}"),
    };
    format!(
        "    {name}_posture_at(joints{given}, &posture);\n{bears}    {name}_given_gives(&posture{load}, &give);\n"
    )
}

/// All branches.
pub(super) fn whole(text: &Text) -> String {
    let Text { name, real, given: [_, given], closed, n, branches, .. } = text;
    let most = match text.suffix {
        "" => text.lit(f64::MAX),
        _ => text.lit(f64::from(f32::MAX)),
    };
    let (head, branch, wrench) = (text.head(), text.function(), text.under(" wrench,"));
    let (declared, told, angle) = match text.elbow {
        true => (
            format!("    {real} elbow[1];\n"),
            format!("    {name}_elbow_angle(q{given}, elbow);\n"),
            ", elbow[0]",
        ),
        false => (String::new(), String::new(), ""),
    };
    let follows = format!(
        "{name}_{branch}_of(joints{given}, target,{wrench} &out->q[{n}U * branch], &out->distance[branch],
            &out->tilt[branch]) == 0"
    );
    let fails = match text.third {
        Some(_) => {
            let most = text.lit(f64::from(f32::MAX));
            format!("(begin.distance[branch] > {most}) || ({follows})")
        }
        None => follows,
    };
    format!(
        "
{head}
{{
    const {real} most = {most};
    {name}_{closed}_t begin;
{declared}    unsigned int branch;

{told}    {name}_{closed}(q{given}, target{angle}, &begin);
    for (branch = 0U; branch < {branches}U; branch++)
    {{
        const {real} *const joints = &begin.q[{n}U * branch];

        if ({fails})
        {{
            (void)memcpy(&out->q[{n}U * branch], joints, {n}U * sizeof joints[0]);
            out->distance[branch] = most + most;
            out->tilt[branch] = most + most;
        }}
    }}
}}
"
    )
}
