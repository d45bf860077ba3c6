//! Sine and cosine in C: the Rust kernels' polynomial (`kernels/src/sin_cos`), operation by operation,
//! or `math.h`'s.

use super::{Precision, Sines};

/// The static function `sin_cos`.
pub(super) fn sin_cos(sines: Sines, precision: Precision) -> &'static str {
    match (sines, precision) {
        (Sines::Math, Precision::F64) => MATH_DOUBLE,
        (Sines::Math, Precision::F32) => MATH_SINGLE,
        // Where the caller gives the posture, functions of one's own still take sines of their inputs.
        (Sines::Polynomial | Sines::Given, Precision::F64) => DOUBLE,
        (Sines::Polynomial | Sines::Given, Precision::F32) => SINGLE,
    }
}

const MATH_DOUBLE: &str = "
static void sin_cos(double angle, double *sine, double *cosine)
{
    *sine = sin(angle);
    *cosine = cos(angle);
}
";

const MATH_SINGLE: &str = "
static void sin_cos(float angle, float *sine, float *cosine)
{
    *sine = sinf(angle);
    *cosine = cosf(angle);
}
";

const DOUBLE: &str = "
/* A number and its bits. */
typedef union
{
    double number;
    uint64_t bits;
} word_t;

/* Sine and cosine without a branch: at most 1.5 ulp off for |angle| <= 1e4 rad, exact at 0. Beyond
 * 1e9 rad, and where the angle is not finite, both are NaN.
 * The angle less the nearest multiple of pi/2, which is subtracted in three parts; adding
 * 1.5 * 2^52 rounds that multiple, and its last two bits say how the quadrant exchanges the pair
 * and its signs. */
static void sin_cos(double angle, double *sine, double *cosine)
{
    const double shift = 6755399441055744.0;
    const double shifted = angle * 0.6366197723675814 + shift;
    const double multiple = shifted - shift;
    const double first = multiple * (-1.5707963267923333) + angle;
    const double head = multiple * (-2.5633441515839558e-12) + first;
    const double lost = multiple * (-2.5633441515839558e-12) + (first - head);
    const double rest = multiple * (-1.0562999066987428e-23) + lost;
    const uint64_t beyond = (uint64_t)(angle > 1e9) | (uint64_t)(angle < -1e9);
    word_t s, c, quadrant, r;

    r.number = head;
    r.bits |= UINT64_C(0) - beyond;
    {
        const double x = r.number;
        const double z = x * x;
        const double z2 = z * z;
        const double s0 = z * 0.008333333333322484 + (-0.16666666666666632);
        const double s2 = z * 2.7557313704098867e-06 + (-0.0001984126982985116);
        const double s4 = z * 1.5896875188647993e-10 + (-2.5050759714136158e-08);
        const double c0 = z * (-0.001388888888887447) + 0.0416666666666666;
        const double c2 = z * (-2.755731439923815e-07) + 2.4801587289666865e-05;
        const double c4 = z * (-1.1359916899499847e-11) + 2.0875728988224267e-09;
        const double falls = z * (z2 * (z2 * c4 + c2) + c0) + (-0.5);

        s.number = x + ((x * z) * (z2 * (z2 * s4 + s2) + s0) + rest);
        c.number = x * (x * falls - rest) + 1.0;
    }
    quadrant.number = shifted;
    {
        const uint64_t sign = UINT64_C(1) << 63;
        const uint64_t odd = UINT64_C(0) - (quadrant.bits & UINT64_C(1));
        const uint64_t exchanged = (s.bits ^ c.bits) & odd;

        s.bits ^= exchanged ^ ((quadrant.bits << 62) & sign);
        c.bits ^= exchanged ^ (((quadrant.bits ^ (quadrant.bits << 1)) << 62) & sign);
    }
    *sine = s.number;
    *cosine = c.number;
}
";

const SINGLE: &str = "
/* A number and its bits. */
typedef union
{
    float number;
    uint32_t bits;
} word_t;

/* Sine and cosine without a branch and without a double: at most 1e-7 off for |angle| <= 100 rad,
 * exact at 0. Beyond 1e5 rad, and where the angle is not finite, both are NaN.
 * The angle less the nearest multiple of pi/2, which is subtracted in three parts; adding
 * 1.5 * 2^23 rounds that multiple, and its last two bits say how the quadrant exchanges the pair
 * and its signs. */
static void sin_cos(float angle, float *sine, float *cosine)
{
    const float shift = 12582912.0f;
    const float shifted = angle * 0.63661975f + shift;
    const float multiple = shifted - shift;
    const float first = multiple * (-1.570770263671875f) + angle;
    const float second = multiple * (-2.6063062250614166e-05f) + first;
    const float reduced = multiple * (-6.07710062827671e-11f) + second;
    const uint32_t beyond = (uint32_t)(angle > 1e5f) | (uint32_t)(angle < -1e5f);
    word_t s, c, quadrant, r;

    r.number = reduced;
    r.bits |= UINT32_C(0) - beyond;
    {
        const float x = r.number;
        const float z = x * x;
        const float s1 = z * (-0.00019495957531034946f) + 0.008331982418894768f;
        const float c1 = z * 2.4430670237052254e-05f + (-0.00138873013202101f);

        s.number = (x * z) * (z * s1 + (-0.16666650772094727f)) + x;
        c.number = (z * z) * (z * c1 + 0.04166664555668831f) + (1.0f - 0.5f * z);
    }
    quadrant.number = shifted;
    {
        const uint32_t sign = UINT32_C(1) << 31;
        const uint32_t odd = UINT32_C(0) - (quadrant.bits & UINT32_C(1));
        const uint32_t exchanged = (s.bits ^ c.bits) & odd;

        s.bits ^= exchanged ^ ((quadrant.bits << 30) & sign);
        c.bits ^= exchanged ^ (((quadrant.bits ^ (quadrant.bits << 1)) << 30) & sign);
    }
    *sine = s.number;
    *cosine = c.number;
}
";
