
/* At an angle of joint 3: twelve rows in triangular form, and their determinant. */
static void arm_twelve(const arm_rest_t *rest, const double *by, arm_twelve_t *out)
{
    unsigned int row;
    unsigned int k;
    unsigned int column;

    for (row = 0U; row < 12U; row++)
    {
        for (k = 0U; k < 12U; k++)
        {
            out->at[row][k] = 0.0;
        }
        out->at[row][12] = 1.0;
    }
    for (row = 0U; row < 6U; row++)
    {
        for (k = 0U; k < 9U; k++)
        {
            const double *const of = rest->at[row][k % 3U][k / 3U];
            const double value = of[0] + of[1] * by[0] + of[2] * by[1];

            out->at[row][k] = value;
            out->at[row + 6U][k + 3U] = value;
        }
    }
    out->determinant = 1.0;
    for (k = 0U; k < 12U; k++)
    {
        unsigned int pivot = k;

        for (row = k; row < 12U; row++)
        {
            if (fabs(out->at[row][k]) > fabs(out->at[pivot][k]))
            {
                pivot = row;
            }
        }
        if (pivot != k)
        {
            for (column = 0U; column < 13U; column++)
            {
                const double kept = out->at[k][column];

                out->at[k][column] = out->at[pivot][column];
                out->at[pivot][column] = kept;
            }
            out->determinant = -out->determinant;
        }
        out->determinant = out->determinant * out->at[k][k];
        if (out->at[k][k] == 0.0)
        {
            out->at[k][k] = 2.2250738585072014e-308;
        }
        for (row = k + 1U; row < 12U; row++)
        {
            const double factor = out->at[row][k] / out->at[k][k];

            if (factor != 0.0)
            {
                for (column = k; column < 13U; column++)
                {
                    out->at[row][column] = out->at[row][column] - factor * out->at[k][column];
                }
            }
        }
    }
}

/* The pair x[low], x[high] of most length, as the angle of its tangent. */
static double arm_half_angle(const double *x, unsigned int apart)
{
    double best[2] = {0.0, 0.0};
    unsigned int k;

    for (k = 0U; k < 12U; k++)
    {
        if ((apart == 3U) ? (k < 9U) : (k % 3U < 2U))
        {
            const double low = x[k];
            const double high = x[k + apart];

            if (low * low + high * high > best[0] * best[0] + best[1] * best[1])
            {
                best[0] = low;
                best[1] = high;
            }
        }
    }
    return 2.0 * arm_angle_of(best[1], best[0]);
}

/* The angles of joints 4 and 5 by the vector that the matrix makes nothing of. */
static void arm_fourth_fifth(const arm_twelve_t *of, double *q)
{
    double x[12] = {0.0};
    unsigned int k;
    unsigned int column;

    for (k = 12U; k > 0U; k--)
    {
        const unsigned int row = k - 1U;
        double rest = -0.0;

        for (column = k; column < 12U; column++)
        {
            rest = rest + of->at[row][column] * x[column];
        }
        x[row] = (of->at[row][12] - rest) / of->at[row][row];
        if (fabs(x[row]) > 1e100)
        {
            const double scale = fabs(x[row]);

            for (column = 0U; column < 12U; column++)
            {
                x[column] = x[column] / scale;
            }
        }
    }
    q[3] = arm_half_angle(x, 3U);
    q[4] = arm_half_angle(x, 1U);
}

/* The angles of joints 1 and 2 by the eight rows. */
static void arm_first_two(const arm_rows_t *rows, double *q)
{
    double turns[3][3];
    double x[8] = {0.0};
    unsigned int k;
    unsigned int column;

    for (k = 0U; k < 3U; k++)
    {
        turns[k][0] = 1.0;
        arm_circle(q[2U + k], &turns[k][1]);
    }
    for (k = 8U; k > 0U; k--)
    {
        const unsigned int row = k - 1U;
        const double pivot = rows->at[row][row];
        double sum = 0.0;
        double rest = -0.0;

        for (column = 0U; column < 27U; column++)
        {
            sum = sum
                + rows->at[row][8U + column] * turns[2][column / 9U] * turns[1][column / 3U % 3U]
                    * turns[0][column % 3U];
        }
        for (column = k; column < 8U; column++)
        {
            rest = rest + rows->at[row][column] * x[column];
        }
        x[row] = (fabs(pivot) > 1e-12) ? ((sum - rest) / pivot) : 0.0;
    }
    q[0] = arm_angle_of(x[5], x[2]);
    q[1] = arm_angle_of(x[1], x[0]);
}

static void arm_product(const double *a, const double *b, double *out)
{
    const double real = a[0] * b[0] - a[1] * b[1];
    const double imaginary = a[0] * b[1] + a[1] * b[0];

    out[0] = real;
    out[1] = imaginary;
}

static void arm_quotient(const double *a, const double *b, double *out)
{
    const double inverse = 1.0 / (b[0] * b[0] + b[1] * b[1]);
    const double by[2] = {b[0] * inverse, -b[1] * inverse};

    arm_product(a, by, out);
}

/* All roots of the sum of c[m] z^m, m from -8 to 8, with c[-m] conjugate to c[m], at once (Aberth). */
static void arm_roots(const double *c, double *z)
{
    const double one[2] = {1.0, 0.0};
    unsigned int k;
    unsigned int step;

    for (k = 0U; k < 16U; k++)
    {
        const double radius = (k % 2U == 0U) ? 0.9 : (1.0 / 0.9);

        arm_circle(0.3 + arm_turn * (double)k / 16.0, &z[2U * k]);
        z[2U * k] = radius * z[2U * k];
        z[2U * k + 1U] = radius * z[2U * k + 1U];
    }
    for (step = 0U; step < 60U; step++)
    {
        double moved = 0.0;

        for (k = 0U; k < 16U; k++)
        {
            double *const at = &z[2U * k];
            const int inside = (at[0] * at[0] + at[1] * at[1] <= 1.0) ? 1 : 0;
            double x[2] = {at[0], at[1]};
            double value[2] = {0.0, 0.0};
            double slope[2] = {0.0, 0.0};
            double ratio[2];
            double by[2];
            unsigned int power;
            unsigned int other;

            if (inside == 0)
            {
                arm_quotient(one, at, x);
            }
            for (power = 17U; power > 0U; power--)
            {
                const unsigned int index = (inside == 1) ? (power - 1U) : (17U - power);
                const double *const next = &c[2U * ((index < 8U) ? (8U - index) : (index - 8U))];

                arm_product(slope, x, slope);
                slope[0] = slope[0] + value[0];
                slope[1] = slope[1] + value[1];
                arm_product(value, x, value);
                value[0] = value[0] + next[0];
                value[1] = value[1] + ((index < 8U) ? -next[1] : next[1]);
            }
            if ((value[0] == 0.0) && (value[1] == 0.0))
            {
                continue;
            }
            arm_quotient(slope, value, ratio);
            if (inside == 0)
            {
                arm_product(x, x, by);
                arm_product(ratio, by, ratio);
                ratio[0] = 16.0 * x[0] - ratio[0];
                ratio[1] = 16.0 * x[1] - ratio[1];
            }
            for (other = 0U; other < 16U; other++)
            {
                by[0] = at[0] - z[2U * other];
                by[1] = at[1] - z[2U * other + 1U];
                if ((other != k) && !((by[0] == 0.0) && (by[1] == 0.0)))
                {
                    arm_quotient(one, by, by);
                    ratio[0] = ratio[0] - by[0];
                    ratio[1] = ratio[1] - by[1];
                }
            }
            arm_quotient(one, ratio, by);
            if (isfinite(by[0]) && isfinite(by[1]))
            {
                const double size = fabs(at[0]) + fabs(at[1]) + 1e-300;

                at[0] = at[0] - by[0];
                at[1] = at[1] - by[1];
                moved = fmax(moved, (fabs(by[0]) + fabs(by[1])) / size);
            }
        }
        if (moved < 1e-12)
        {
            break;
        }
    }
}
