//! The small linear system of a deflection in C: the Rust kernels' `solve`, operation by operation.

use super::style::C;
use crate::emit::lines::Lines;

/// `solve_6`, or `solve_6_5` where the leading block is of five.
pub(super) fn solve_name(n: usize, leading: usize) -> String {
    if leading < n { format!("solve_{n}_{leading}") } else { format!("solve_{n}") }
}

/// `static … definite_6(…)`: whether the arm bears the load.
pub(super) fn definite(out: &mut Lines, n: usize, name: &str, language: &C) {
    let (real, suffix, upper) = (language.real(), language.suffix(), name.to_uppercase());
    let size = n * n;
    out.verbatim(&format!(
        "
/* Whether the symmetric part of a is positive definite, so that every small displacement takes work:
 * the pivots of L*D*L^T of a + a^T are positive. a is column-major. */
static {name}_status_t definite_{n}(const {real} a[{size}])
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
    let size = n * n;
    out.verbatim(&format!(
        "
/* Solves a * x = b by elimination without pivoting; a is column-major, x takes the place of b. Where
 * the symmetric part of a is positive definite, every pivot is positive.{more} */
static {name}_status_t {function}({real} a[{size}], {real} b[{n}])
{{
    {name}_status_t status = definite_{n}(a);
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

        if (!(pivot > 0.0{suffix}))
        {{
            status = {upper}_UNSTABLE;
        }}
        for (column = 0U; column < {m}U; column++)
        {{
            b[i] = b[i] - a[(column * {n}U) + i] * b[column];
        }}
        b[i] = b[i] * (1.0{suffix} / pivot);
    }}
"
    );
    (more, rows)
}
