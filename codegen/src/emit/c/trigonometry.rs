//! Sines and cosines in C, of many angles at a time: the Rust kernels' polynomial (`kernels/src/sin_cos`), operation by
//! operation, or `math.h`'s.
//!
//! The polynomial is written once, for as many angles as a register holds: GCC's and Clang's vectors where there are
//! any, a plain number in other C99. A lane is worked out like a number, so that the bits are the same.

use super::style::C;
use super::{Precision, Sines};
use crate::emit::lines::Lines;
use crate::ir::Angle;

/// What stands before the functions: the static function `sin_cos` of an array of angles, and `PADDED`, the length that
/// its arrays have.
pub(super) fn sin_cos(sines: Sines, precision: Precision) -> String {
    match (sines, precision) {
        (Sines::Math, precision) => {
            let language = C { precision, device: false, math: true };
            MATH.replace("REAL", language.real()).replace("OF", language.suffix())
        }
        // Where the caller gives the posture, functions of one's own still take sines of their inputs.
        (Sines::Polynomial | Sines::Given, Precision::F64) => lanes("double", 64) + DOUBLE,
        (Sines::Polynomial | Sines::Given, Precision::F32) => lanes("float", 32) + SINGLE,
    }
}

/// The statements of the polynomial for one double, `angle`: its sine and cosine as `s` and `c`, but for the quadrant, which
/// the `multiple` of a quarter turn tells.
pub(super) fn of_one_double() -> String {
    let wanted = ["const double shift", "const lanes_t", "s.number =", "c.number ="];
    let lines = DOUBLE.lines().map(str::trim_start);
    let lines = lines.filter(|line| wanted.iter().any(|start| line.starts_with(start)));
    let text: String =
        lines.filter(|line| !line.contains("LOADED")).map(|line| format!("    {line}\n")).collect();
    let names = [("lanes_t", "double"), ("r.number", "head")];
    let names =
        names.into_iter().chain([("s.number", "const double s"), ("c.number", "const double c")]);
    names.fold(text, |text, (from, to)| text.replace(from, to))
}

/// An angle, and where its sine and cosine go, as far as they are wanted.
pub(super) struct Pair {
    pub angle: String,
    pub sine: Option<String>,
    pub cosine: Option<String>,
}

impl Pair {
    /// Into the locals that the angle names.
    pub fn of(angle: &Angle, language: &C) -> Pair {
        let [sine, cosine] = angle.names().map(|name| name.map(|name| name.to_string()));
        Pair { angle: angle.sum.print(language), sine, cosine }
    }
}

/// [`take`] into locals, declared before.
pub(super) fn declare(out: &mut Lines, language: &C, pairs: &[Pair]) {
    for name in pairs.iter().flat_map(|pair| [&pair.sine, &pair.cosine]).flatten() {
        out.code(&format!("{} {name};", language.real()));
    }
    take(out, language, pairs);
}

/// Statements that take the sines and cosines of all `pairs` at once.
pub(super) fn take(out: &mut Lines, language: &C, pairs: &[Pair]) {
    if pairs.is_empty() {
        return;
    }
    let (real, count) = (language.real(), pairs.len());
    if language.device {
        for Pair { angle, sine, cosine } in pairs {
            let suffix = language.suffix();
            match (sine, cosine) {
                (Some(sine), Some(cosine)) => {
                    out.code(&format!("sincos{suffix}({angle}, &{sine}, &{cosine});"));
                }
                _ => {
                    for (to, function) in [(sine, "sin"), (cosine, "cos")] {
                        if let Some(to) = to {
                            out.code(&format!("{to} = {function}{suffix}({angle});"));
                        }
                    }
                }
            }
        }
        return;
    }
    out.braces(|out| {
        let angles: Vec<&str> = pairs.iter().map(|pair| pair.angle.as_str()).collect();
        out.code(&format!("const {real} angles[PADDED({count})] = {{{}}};", angles.join(", ")));
        out.code(&format!("{real} sines[PADDED({count})];"));
        out.code(&format!("{real} cosines[PADDED({count})];"));
        out.blank();
        out.code(&format!("sin_cos({count}, angles, sines, cosines);"));
        for (k, pair) in pairs.iter().enumerate() {
            for (target, from) in [(&pair.sine, "sines"), (&pair.cosine, "cosines")] {
                if let Some(target) = target {
                    out.code(&format!("{target} = {from}[{k}];"));
                }
            }
        }
    });
}

/// The types of lanes: how many depends on the target.
fn lanes(real: &str, bits: usize) -> String {
    // Eight angles at most: few arms have more. In the widest registers of AMD's cores only, which alone have SSE4A:
    // Intel's close a port to the algebra around them (`kernels/src/lanes/pose.rs`).
    let all: &[(&[&str], usize)] =
        &[(&["AVX512F", "SSE4A"], 512), (&["AVX2"], 256), (&["SSE2"], 128), (&["aarch64"], 128)];
    // Eight floats need no more than 256 bits.
    let registers = all.iter().filter(|(_, width)| *width <= 8 * bits);
    let mut text = String::from(LANES);
    for (at, (target, width)) in registers.enumerate() {
        let lanes = width / bits;
        let loaded: Vec<String> = (0..lanes).map(|k| format!("x[{k}]")).collect();
        let test = if at == 0 { "if" } else { "elif" };
        let target: String = target.iter().map(|one| format!(" && defined(__{one}__)")).collect();
        text += &format!("#{test} defined(__GNUC__){target}\n#define LANES {lanes}\n");
        text += &format!("#define LOADED(x) {{{}}}\n", loaded.join(", ").replace("x[", "(x)["));
    }
    text += &TYPES.replace("REAL", real).replace("BITS", &bits.to_string());
    text.replace("BYTES", &(bits / 8).to_string())
}

const MATH: &str = "
/* The length of arrays of so many angles. */
#define PADDED(count) (count)

static void sin_cos(int count, const REAL *angles, REAL *sines, REAL *cosines)
{
    int at;

    for (at = 0; at < count; at++)
    {
        sines[at] = sinOF(angles[at]);
        cosines[at] = cosOF(angles[at]);
    }
}
";

const LANES: &str = "
/* Sines and cosines are taken of as many angles at a time as a register holds, where the compiler
 * has vectors; eight doubles on AMD's cores only, for the widest registers close a port of Intel's.
 * Each lane is worked out as one number is elsewhere: the bits are the same. */
";

const TYPES: &str = "#else
#define LANES 1
#define LOADED(x) {(x)[0]}
#endif
#if LANES > 1
typedef REAL lanes_t __attribute__((vector_size(BYTES * LANES)));
typedef uintBITS_t mask_t __attribute__((vector_size(BYTES * LANES)));
/* All bits of each lane where the condition holds. */
#define MASK(condition) ((mask_t)(condition))
/* Lanes that stay in registers. */
#define INLINED static inline __attribute__((always_inline))
#else
typedef REAL lanes_t;
typedef uintBITS_t mask_t;
#define MASK(condition) (UINTBITS_C(0) - (mask_t)(condition))
#define INLINED static
#endif

/* The length of arrays of so many angles: whole lanes. */
#define PADDED(count) (((count) + LANES - 1) / LANES * LANES)

/* Numbers, their bits, and each by itself. */
typedef union
{
    lanes_t number;
    mask_t bits;
    REAL each[LANES];
} word_t;
";

const DOUBLE: &str = "
/* Sines and cosines without a branch: at most 1.5 ulp off for |angle| <= 1e4 rad, exact at 0. Beyond
 * 1e9 rad, and where the angle is not finite, both are NaN.
 * The angle less the nearest multiple of pi/2, which is subtracted in three parts; adding
 * 1.5 * 2^52 rounds that multiple, and its last two bits say how the quadrant exchanges the pair
 * and its signs. */
INLINED void sin_cos(int count, const double *angles, double *sines, double *cosines)
{
    int at;
    int lane;

    for (at = 0; at < count; at += LANES)
    {
        const lanes_t angle = LOADED(angles + at);
        const double shift = 6755399441055744.0;
        const lanes_t shifted = angle * 0.6366197723675814 + shift;
        const lanes_t multiple = shifted - shift;
        const lanes_t first = multiple * (-1.5707963267923333) + angle;
        const lanes_t head = multiple * (-2.5633441515839558e-12) + first;
        const lanes_t lost = multiple * (-2.5633441515839558e-12) + (first - head);
        const lanes_t rest = multiple * (-1.0562999066987428e-23) + lost;
        const mask_t beyond = MASK(angle > 1e9) | MASK(angle < -1e9);
        word_t s, c, quadrant, r;

        r.number = head;
        r.bits |= beyond;
        {
            const lanes_t x = r.number;
            const lanes_t z = x * x;
            const lanes_t z2 = z * z;
            const lanes_t s0 = z * 0.008333333333322484 + (-0.16666666666666632);
            const lanes_t s2 = z * 2.7557313704098867e-06 + (-0.0001984126982985116);
            const lanes_t s4 = z * 1.5896875188647993e-10 + (-2.5050759714136158e-08);
            const lanes_t c0 = z * (-0.001388888888887447) + 0.0416666666666666;
            const lanes_t c2 = z * (-2.755731439923815e-07) + 2.4801587289666865e-05;
            const lanes_t c4 = z * (-1.1359916899499847e-11) + 2.0875728988224267e-09;
            const lanes_t falls = z * (z2 * (z2 * c4 + c2) + c0) + (-0.5);

            s.number = x + ((x * z) * (z2 * (z2 * s4 + s2) + s0) + rest);
            c.number = x * (x * falls - rest) + 1.0;
        }
        quadrant.number = shifted;
        {
            const uint64_t sign = UINT64_C(1) << 63;
            const mask_t odd = UINT64_C(0) - (quadrant.bits & UINT64_C(1));
            const mask_t exchanged = (s.bits ^ c.bits) & odd;

            s.bits ^= exchanged ^ ((quadrant.bits << 62) & sign);
            c.bits ^= exchanged ^ (((quadrant.bits ^ (quadrant.bits << 1)) << 62) & sign);
        }
        for (lane = 0; lane < LANES; lane++)
        {
            sines[at + lane] = s.each[lane];
            cosines[at + lane] = c.each[lane];
        }
    }
}
";

const SINGLE: &str = "
/* Sines and cosines without a branch and without a double: at most 1e-7 off for |angle| <= 100 rad,
 * exact at 0. Beyond 1e5 rad, and where the angle is not finite, both are NaN.
 * The angle less the nearest multiple of pi/2, which is subtracted in three parts; adding
 * 1.5 * 2^23 rounds that multiple, and its last two bits say how the quadrant exchanges the pair
 * and its signs. */
INLINED void sin_cos(int count, const float *angles, float *sines, float *cosines)
{
    int at;
    int lane;

    for (at = 0; at < count; at += LANES)
    {
        const lanes_t angle = LOADED(angles + at);
        const float shift = 12582912.0f;
        const lanes_t shifted = angle * 0.63661975f + shift;
        const lanes_t multiple = shifted - shift;
        const lanes_t first = multiple * (-1.570770263671875f) + angle;
        const lanes_t second = multiple * (-2.6063062250614166e-05f) + first;
        const lanes_t reduced = multiple * (-6.07710062827671e-11f) + second;
        const mask_t beyond = MASK(angle > 1e5f) | MASK(angle < -1e5f);
        word_t s, c, quadrant, r;

        r.number = reduced;
        r.bits |= beyond;
        {
            const lanes_t x = r.number;
            const lanes_t z = x * x;
            const lanes_t s1 = z * (-0.00019495957531034946f) + 0.008331982418894768f;
            const lanes_t c1 = z * 2.4430670237052254e-05f + (-0.00138873013202101f);

            s.number = (x * z) * (z * s1 + (-0.16666650772094727f)) + x;
            c.number = (z * z) * (z * c1 + 0.04166664555668831f) + (1.0f - 0.5f * z);
        }
        quadrant.number = shifted;
        {
            const uint32_t sign = UINT32_C(1) << 31;
            const mask_t odd = UINT32_C(0) - (quadrant.bits & UINT32_C(1));
            const mask_t exchanged = (s.bits ^ c.bits) & odd;

            s.bits ^= exchanged ^ ((quadrant.bits << 30) & sign);
            c.bits ^= exchanged ^ (((quadrant.bits ^ (quadrant.bits << 1)) << 30) & sign);
        }
        for (lane = 0; lane < LANES; lane++)
        {
            sines[at + lane] = s.each[lane];
            cosines[at + lane] = c.each[lane];
        }
    }
}
";
