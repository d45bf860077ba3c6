//! The small linear system of a deflection in C: the Rust kernels' `solve`, operation by operation.

use super::style::C;
use crate::emit::lines::Lines;

/// `solve_6`, or `solve_6_5` where the leading block is of five.
pub(super) fn solve_name(n: usize, leading: usize) -> String {
    if leading < n { format!("solve_{n}_{leading}") } else { format!("solve_{n}") }
}

/// `static … load_margin(…)`: by how much the load is surely borne.
pub(super) fn margin(out: &mut Lines, language: &C) {
    let (local, real, suffix) = (language.local(), language.real(), language.suffix());
    out.verbatim(&format!(
        "
/* 1 - (|f| / force)^2 - (|m| / moment)^2: where it is positive, the arm surely bears the wrench. */
{local} {real} load_margin(const {real} wrench[6], {real} force, {real} moment)
{{
    const {real} forces = wrench[0] * wrench[0] + wrench[1] * wrench[1] + wrench[2] * wrench[2];
    const {real} moments = wrench[3] * wrench[3] + wrench[4] * wrench[4] + wrench[5] * wrench[5];

    return 1.0{suffix} - forces * (1.0{suffix} / (force * force)) - moments * (1.0{suffix} / (moment * moment));
}}
"
    ));
}

/// `static … definite_6(…)`: whether the arm bears the load.
pub(super) fn definite(out: &mut Lines, n: usize, name: &str, language: &C) {
    let (real, suffix, upper) = (language.real(), language.suffix(), name.to_uppercase());
    let (size, local) = (n * n, language.local());
    out.verbatim(&format!(
        "
/* Whether the symmetric part of a is positive definite, so that every small displacement takes work:
 * the pivots of L*D*L^T of a + a^T are positive. a is column-major. */
{local} {name}_status_t definite_{n}(const {real} a[{size}])
{{
    {name}_status_t status = {upper}_OK;
    {real} twice[{size}];
    unsigned int k;
    unsigned int row;
    unsigned int column;

    for (column = 0U; column < {n}U; column++)
    {{
        for (row = column; row < {n}U; row++)
        {{
            twice[(column * {n}U) + row] = a[(column * {n}U) + row] + a[(row * {n}U) + column];
        }}
    }}
    for (k = 0U; k < {n}U; k++)
    {{
        const {real} inverse = 1.0{suffix} / twice[(k * {n}U) + k];

        if (!(twice[(k * {n}U) + k] > 0.0{suffix}))
        {{
            status = {upper}_UNSTABLE;
        }}
        for (column = k + 1U; column < {n}U; column++)
        {{
            const {real} factor = twice[(k * {n}U) + column] * inverse;

            for (row = column; row < {n}U; row++)
            {{
                twice[(column * {n}U) + row] =
                    twice[(column * {n}U) + row] - factor * twice[(k * {n}U) + row];
            }}
        }}
    }}
    return status;
}}
"
    ));
}

/// `static … solve_6(…)`: bounds are constants, one exit.
pub(super) fn solve(out: &mut Lines, (n, m): (usize, usize), name: &str, language: &C) {
    let function = solve_name(n, m);
    let (more, follow) = if m < n { follow(n, m, name, language) } else { Default::default() };
    let (real, suffix, upper) = (language.real(), language.suffix(), name.to_uppercase());
    let (size, local) = (n * n, language.local());
    out.verbatim(&format!(
        "
/* Solves a * x = b by elimination without pivoting; a is column-major, x takes the place of b. Where
 * the symmetric part of a is positive definite, every pivot is positive; a positive margin says that
 * it is.{more} */
{local} {name}_status_t {function}({real} a[{size}], {real} b[{n}], {real} margin)
{{
    {name}_status_t status = (margin > 0.0{suffix}) ? {upper}_OK : definite_{n}(a);
    unsigned int k;
    unsigned int i;
    unsigned int column;

    for (k = 0U; k < {m}U; k++)
    {{
        const {real} inverse = 1.0{suffix} / a[(k * {n}U) + k];

        if (!(a[(k * {n}U) + k] > 0.0{suffix}))
        {{
            status = {upper}_UNSTABLE;
        }}
        for (i = k + 1U; i < {m}U; i++)
        {{
            const {real} factor = a[(k * {n}U) + i] * inverse;

            for (column = k + 1U; column < {m}U; column++)
            {{
                a[(column * {n}U) + i] = a[(column * {n}U) + i] - factor * a[(column * {n}U) + k];
            }}
            b[i] = b[i] - factor * b[k];
        }}
    }}
    for (k = {m}U; k > 0U; k--)
    {{
        const unsigned int last = k - 1U;

        b[last] = b[last] * (1.0{suffix} / a[(last * {n}U) + last]);
        for (i = 0U; i < last; i++)
        {{
            b[i] = b[i] - a[(last * {n}U) + i] * b[last];
        }}
    }}
{follow}    return status;
}}
"
    ));
}

/// What the comment says more, and the rows of the unknowns from `m` on.
fn follow(n: usize, m: usize, name: &str, language: &C) -> (String, String) {
    let (real, suffix, upper) = (language.real(), language.suffix(), name.to_uppercase());
    let more = format!(
        "\n * Nothing depends on the unknowns from x[{m}] on, so that each follows from its row."
    );
    let rows = format!(
        "    for (i = {m}U; i < {n}U; i++)
    {{
        const {real} pivot = a[(i * {n}U) + i];

        for (column = 0U; column < {m}U; column++)
        {{
            b[i] = b[i] - a[(column * {n}U) + i] * b[column];
        }}
        /* The difference is zero but where the row is not finite. */
        if (!((pivot + (b[i] - b[i])) > 0.0{suffix}))
        {{
            status = {upper}_UNSTABLE;
        }}
        b[i] = b[i] * (1.0{suffix} / pivot);
    }}
"
    );
    (more, rows)
}
