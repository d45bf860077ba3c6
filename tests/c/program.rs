//! A C program around generated kernels: a state of three numbers for each joint and a wrench as the bits of
//! numbers from standard input, every output as bits to standard output.

use stiffarm::kernels::{Output, Side};
use stiffarm_codegen::emit::Precision;
use stiffarm_codegen::robot::Robot;

/// From which sides the joints of a corrected arm come, and how warm it is, K.
pub const SIDES: [f64; 5] = [1.0, -1.0, 1.0, 0.0, -1.0];
pub const WARMING: f64 = 8.5;

/// A number in C, its bits, and how these are read and printed.
pub fn types(precision: Precision) -> [&'static str; 4] {
    match precision {
        Precision::F32 => ["float", "uint32_t", "SCNx32", "PRIx32"],
        Precision::F64 => ["double", "uint64_t", "SCNx64", "PRIx64"],
    }
}

/// The program for the kernels of `robot`, called `name`: every output of the tool, then those of its places in their
/// order, then those of the fused function.
///
/// Every function of the joint values is called, and every function of the posture after it: where the
/// two differ in a bit of a number, the program ends with status 2.
pub fn program(name: &str, robot: &Robot, precision: Precision) -> String {
    let n = robot.dof();
    let (sides, warming) = (robot.beyond.takes_sides(), robot.beyond.takes_warming());
    let given = [(sides, ", sides"), (warming, ", warming")];
    let given: String = given.into_iter().filter(|(is, _)| *is).map(|(_, text)| text).collect();
    let [real, word, scan, print] = types(precision);
    let mut calls = String::new();
    let tool = robot.generated().into_iter().map(|output| (output.name().to_owned(), output));
    let places = robot.places().into_iter().flat_map(|(place, outputs)| {
        outputs.into_iter().map(move |output| (format!("at_{place}_{}", output.name()), output))
    });
    for (function, output) in tool.into_iter().chain(places) {
        let (rows, columns) = output.shape(n);
        let size = rows * columns;
        // The wrench, and what stands behind the joint values.
        let beside: String = output
            .beside()
            .enumerate()
            .map(|(k, input)| match input.side() {
                Side::Joints => format!("&q[{}], ", (k + 1) * n),
                _ => "wrench, ".to_owned(),
            })
            .collect();
        let assigned = |to: &str| if output.is_fallible() { to.to_owned() } else { String::new() };
        calls.push_str(&format!(
            "
        {{
            static {real} out[{size}];
            static {real} again[{size}];
            int status = 0;
            int second = 0;
            {first}{name}_{function}(q{given}, {beside}out);
            {repeat}{name}_given_{function}(&posture, {beside}again);
            put(status, out, {size}U);
            if ((status != second) || (same(out, again, {size}U) == 0))
            {{
                return 2;
            }}
        }}
",
            first = assigned("status = (int)"),
            repeat = assigned("second = (int)"),
        ));
    }
    let each = SIDES.map(|side| format!("{side:?}")).join(", ");
    let declared = match given.is_empty() {
        true => String::new(),
        false => format!(
            "        const {real} sides[{n}] = {{{each}}};\n        const {real} warming = {WARMING:?};\n\n"
        ),
    };
    let all: String = Output::ALL
        .iter()
        .map(|o| {
            let size = o.shape(n).0 * o.shape(n).1;
            format!("            put(status, all.{}, {size}U);\n", o.name())
        })
        .collect();
    let state = 3 * n;
    format!(
        "#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include \"{name}.h\"

static void put(int status, const {real} *x, unsigned int size)
{{
    unsigned int k;

    (void)printf(\"%d\", status);
    for (k = 0U; (status == 0) && (k < size); k++)
    {{
        {word} bits;
        (void)memcpy(&bits, &x[k], sizeof bits);
        (void)printf(\" %\" {print}, bits);
    }}
    (void)printf(\"\\n\");
}}

/* Bit for bit; which NaN it is hangs on the order of operands, which is the compiler's. */
static int same(const {real} *a, const {real} *b, unsigned int size)
{{
    unsigned int k;

    for (k = 0U; k < size; k++)
    {{
        const int numbers = ((a[k] == a[k]) || (b[k] == b[k])) ? 1 : 0;

        if ((numbers == 1) && (memcmp(&a[k], &b[k], sizeof a[k]) != 0))
        {{
            return 0;
        }}
    }}
    return 1;
}}

static int get({real} *x, unsigned int size)
{{
    unsigned int k;
    int good = 1;

    for (k = 0U; (good == 1) && (k < size); k++)
    {{
        {word} bits = 0U;
        good = (scanf(\"%\" {scan}, &bits) == 1) ? 1 : 0;
        (void)memcpy(&x[k], &bits, sizeof bits);
    }}
    return good;
}}

int main(void)
{{
    {real} q[{state}];
    {real} wrench[6];
    {name}_posture_t posture;

    while ((get(q, {state}U) == 1) && (get(wrench, 6U) == 1))
    {{
{declared}        {name}_posture(q{given}, &posture);
{calls}
        {{
            static {name}_all_t all;
            const int status = (int){name}_all(q{given}, wrench, &all);
{all}        }}
    }}
    return 0;
}}
"
    )
}
