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

/// Unknowns up to which the elimination is written out, as the Rust kernels' is: the compiler keeps the system in registers.
const WRITTEN_OUT: usize = 8;

/// `static … definite_6(…)`: whether the arm bears the load.
pub(super) fn definite(out: &mut Lines, n: usize, name: &str, language: &C) {
    let (real, suffix, upper) = (language.real(), language.suffix(), name.to_uppercase());
    let (size, local) = (n * n, language.local());
    out.verbatim(&format!(
        "
/* Whether the symmetric part of a matrix a is positive definite, so that every small displacement
 * takes work: the pivots of L*D*L^T of a + a^T are positive. twice is the lower triangle of that
 * sum, column-major. */
{local} {name}_status_t definite_{n}({real} twice[{size}])
{{
    {name}_status_t status = {upper}_OK;
    unsigned int k;
    unsigned int row;
    unsigned int column;

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
    let (real, suffix, upper) = (language.real(), language.suffix(), name.to_uppercase());
    let (size, local) = (n * n, language.local());
    let more = match m < n {
        true => format!(
            "\n * Nothing depends on the unknowns from x[{m}] on, so that each follows from its row."
        ),
        false => String::new(),
    };
    let filled = |text: &str| {
        // The arm's name comes last: it may hold one of the other words.
        let text = text.replace("REAL", real).replace("ZERO", &language.zero());
        let text = text.replace("ONE", &format!("1.0{suffix}")).replace("ROWS", &format!("{n}U"));
        text.replace("LEADING", &format!("{m}U")).replace("REFUSED", &format!("{upper}_UNSTABLE"))
    };
    let [indices, sum, elimination] = match n <= WRITTEN_OUT {
        true => ["".to_owned(), written_sum(n), written_out((n, m), &upper, language)],
        false => {
            let rows = if m < n { FOLLOW } else { "" };
            [INDICES.to_owned(), filled(LOOPED_SUM), filled(LOOPED) + &filled(rows)]
        }
    };
    out.verbatim(&format!(
        "
/* Solves a * x = b by elimination without pivoting, two unknowns at a time; a is column-major, x takes
 * the place of b. Where the symmetric part of a is positive definite, every pivot is positive; a
 * positive margin says that it is. What is tested is a pivot's inverse, and a difference that is not
 * zero where a number is not finite.{more} */
{local} {name}_status_t {function}({real} a[{size}], {real} b[{n}], {real} margin)
{{
    {name}_status_t status = {upper}_OK;
{indices}
    if (!(margin > 0.0{suffix}))
    {{
        {real} twice[{size}];

{sum}        status = definite_{n}(twice);
    }}
{elimination}    return status;
}}
"
    ));
}

const INDICES: &str = "    unsigned int k;
    unsigned int i;
    unsigned int column;
";

const LOOPED_SUM: &str = "        for (column = 0U; column < ROWS; column++)
        {
            for (i = column; i < ROWS; i++)
            {
                twice[(column * ROWS) + i] = a[(column * ROWS) + i] + a[(i * ROWS) + column];
            }
        }
";

const LOOPED: &str = "    for (k = 0U; k < LEADING; k += 2U)
    {
        const unsigned int l = k + 1U;
        const REAL pivot = a[(k * ROWS) + k];
        const REAL over = ONE / pivot;

        if (!((over + (over - over)) > ZERO))
        {
            status = REFUSED;
        }
        if (l < LEADING)
        {
            const REAL below = a[(k * ROWS) + l];
            const REAL inverse =
                ONE / (pivot * a[(l * ROWS) + l] - below * a[(l * ROWS) + k]);

            if (!((inverse + (inverse - inverse)) > ZERO))
            {
                status = REFUSED;
            }
            for (column = l + 1U; column < LEADING; column++)
            {
                a[(column * ROWS) + l] =
                    (pivot * a[(column * ROWS) + l] - below * a[(column * ROWS) + k]) * inverse;
            }
            b[l] = (pivot * b[l] - below * b[k]) * inverse;
        }
        for (column = l; column < LEADING; column++)
        {
            a[(column * ROWS) + k] = a[(column * ROWS) + k] * over;
        }
        b[k] = b[k] * over;
        for (i = l + 1U; i < LEADING; i++)
        {
            for (column = l; column < LEADING; column++)
            {
                a[(column * ROWS) + i] =
                    a[(column * ROWS) + i] - a[(k * ROWS) + i] * a[(column * ROWS) + k];
            }
            b[i] = b[i] - a[(k * ROWS) + i] * b[k];
            for (column = l + 1U; column < LEADING; column++)
            {
                a[(column * ROWS) + i] =
                    a[(column * ROWS) + i] - a[(l * ROWS) + i] * a[(column * ROWS) + l];
            }
            b[i] = b[i] - a[(l * ROWS) + i] * b[l];
        }
    }
    for (k = LEADING; k > 0U; k--)
    {
        const unsigned int last = k - 1U;

        for (i = 0U; i < last; i++)
        {
            b[i] = b[i] - a[(last * ROWS) + i] * b[last];
        }
    }
";

/// The rows of the unknowns that nothing depends on.
const FOLLOW: &str = "    for (i = LEADING; i < ROWS; i++)
    {
        const REAL over = ONE / a[(i * ROWS) + i];

        for (k = LEADING; k > 0U; k--)
        {
            b[i] = b[i] - a[((k - 1U) * ROWS) + i] * b[k - 1U];
        }
        b[i] = b[i] * over;
        if (!((over + (b[i] - b[i])) > ZERO))
        {
            status = REFUSED;
        }
    }
";

/// The lower triangle of `a + aᵀ`, entry by entry: no pointer to `a` goes further.
fn written_sum(n: usize) -> String {
    let entries =
        (0..n).flat_map(|column| (column..n).map(move |row| (column * n + row, row * n + column)));
    entries.map(|(at, across)| format!("        twice[{at}] = a[{at}] + a[{across}];\n")).collect()
}

/// The elimination, statement by statement: the same operations as those of [`LOOPED`] and [`FOLLOW`].
fn written_out((n, m): (usize, usize), upper: &str, language: &C) -> String {
    let a = |column: usize, row: usize| format!("a[{}]", column * n + row);
    let suffix = language.suffix();
    let mut lines: Vec<String> = Vec::new();
    let refuse = |inverse: &str, x: &str| {
        format!(
            "if (!(({inverse} + ({x} - {x})) > 0.0{suffix}))\n    {{\n        status = {upper}_UNSTABLE;\n    }}"
        )
    };
    // Entries of a row from a column on, and the right-hand side's.
    let entries = |from: usize, row: usize| {
        let right = format!("b[{row}]");
        (from..m).map(|column| a(column, row)).chain([right]).collect::<Vec<String>>()
    };
    for k in (0..m).step_by(2) {
        let (l, pivot) = (k + 1, a(k, k));
        if l < m {
            let (below, inverse, across) = (a(k, l), a(l, l), a(l, k));
            lines.push(format!(
                "{inverse} = 1.0{suffix} / ({pivot} * {inverse} - {below} * {across});"
            ));
            lines.push(refuse(&inverse, &inverse));
            for (x, y) in entries(l + 1, l).iter().zip(entries(l + 1, k)) {
                lines.push(format!("{x} = ({pivot} * {x} - {below} * {y}) * {inverse};"));
            }
        }
        lines.push(format!("{pivot} = 1.0{suffix} / {pivot};"));
        lines.push(refuse(&pivot, &pivot));
        lines.extend(entries(l, k).iter().map(|x| format!("{x} = {x} * {pivot};")));
        for i in l + 1..m {
            for of in [k, l] {
                for (x, y) in entries(of + 1, i).iter().zip(entries(of + 1, of)) {
                    lines.push(format!("{x} = {x} - {} * {y};", a(of, i)));
                }
            }
        }
    }
    for k in (0..m).rev() {
        lines.extend((0..k).map(|i| format!("b[{i}] = b[{i}] - {} * b[{k}];", a(k, i))));
    }
    for i in m..n {
        let known = (0..m).rev();
        lines.extend(known.map(|k| format!("b[{i}] = b[{i}] - {} * b[{k}];", a(k, i))));
        let (inverse, x) = (a(i, i), format!("b[{i}]"));
        lines.push(format!("{inverse} = 1.0{suffix} / {inverse};"));
        lines.push(format!("{x} = {x} * {inverse};"));
        lines.push(refuse(&inverse, &x));
    }
    lines.iter().map(|line| format!("    {line}\n")).collect()
}
