//! The small linear system of a deflection in C: the Rust kernels' `solve`, operation by operation.

use super::lines::Lines;
use super::style::C;

/// `static … solve_6(…)`: bounds are constants, one exit.
pub(super) fn solve(out: &mut Lines, n: usize, name: &str, language: &C) {
    let (real, suffix, upper) = (language.real(), language.suffix(), name.to_uppercase());
    let size = n * n;
    out.verbatim(&format!(
        "
/* Solves a * x = b by elimination without pivoting; a is column-major, x takes the place of b. In
 * a stable equilibrium the symmetric part of a is positive definite, and then every pivot is
 * positive. */
static {name}_status_t solve_{n}({real} a[{size}], {real} b[{n}])
{{
    {name}_status_t status = {upper}_OK;
    unsigned int k;
    unsigned int i;
    unsigned int column;

    for (k = 0U; k < {n}U; k++)
    {{
        const {real} inverse = 1.0{suffix} / a[(k * {n}U) + k];

        if (!(a[(k * {n}U) + k] > 0.0{suffix}))
        {{
            status = {upper}_UNSTABLE;
        }}
        for (i = k + 1U; i < {n}U; i++)
        {{
            const {real} factor = a[(k * {n}U) + i] * inverse;

            for (column = k + 1U; column < {n}U; column++)
            {{
                a[(column * {n}U) + i] = a[(column * {n}U) + i] - factor * a[(column * {n}U) + k];
            }}
            b[i] = b[i] - factor * b[k];
        }}
    }}
    for (k = {n}U; k > 0U; k--)
    {{
        const unsigned int last = k - 1U;

        b[last] = b[last] * (1.0{suffix} / a[(last * {n}U) + last]);
        for (i = 0U; i < last; i++)
        {{
            b[i] = b[i] - a[(last * {n}U) + i] * b[last];
        }}
    }}
    return status;
}}
"
    ));
}
