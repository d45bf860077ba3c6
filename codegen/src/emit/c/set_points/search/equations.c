
/* Numbers of a line: l, p, p x l, (p.p) l - 2 (p.l) p, p.l, p.p, 1. */
typedef struct
{
    double v[4][3];
    double s[3];
} arm_numbers_t;

/* Fourteen equations: eight columns of joints 1 and 2, then 27 of 5, 4, 3. */
typedef struct
{
    double at[14][35];
} arm_rows_t;

/* Six of them without joints 1 and 2: powers of tan(q5 / 2), of tan(q4 / 2), and 1, cos q3, sin q3. */
typedef struct
{
    double at[6][3][3][3];
} arm_rest_t;

typedef struct
{
    double at[12][13];
    double determinant;
} arm_twelve_t;

static arm_numbers_t arm_numbers(const arm_line_t *line)
{
    const double pl = arm_dot(line->p, line->z);
    const double pp = arm_dot(line->p, line->p);
    arm_numbers_t out;
    unsigned int k;

    arm_cross(line->p, line->z, out.v[2]);
    for (k = 0U; k < 3U; k++)
    {
        out.v[0][k] = line->z[k];
        out.v[1][k] = line->p[k];
        out.v[3][k] = pp * line->z[k] - 2.0 * pl * line->p[k];
    }
    out.s[0] = pl;
    out.s[1] = pp;
    out.s[2] = 1.0;
    return out;
}

/* The numbers of what is shifted. */
static arm_numbers_t arm_shifted(const arm_numbers_t *of, const double *t)
{
    const double tt = arm_dot(t, t);
    const double tl = arm_dot(t, of->v[0]);
    arm_numbers_t out;
    double turn[3];
    double moment[3];
    unsigned int k;

    arm_cross(t, of->v[2], turn);
    arm_cross(t, of->v[0], moment);
    for (k = 0U; k < 3U; k++)
    {
        out.v[0][k] = of->v[0][k];
        out.v[1][k] = of->v[1][k] + of->s[2] * t[k];
        out.v[2][k] = of->v[2][k] + 1.0 * moment[k];
        out.v[3][k] = of->v[3][k] - 2.0 * (turn[k] + (of->s[0] + tl) * t[k]) + tt * of->v[0][k];
    }
    out.s[0] = of->s[0] + tl;
    out.s[1] = of->s[1] + 2.0 * arm_dot(t, of->v[1]) + tt * of->s[2];
    out.s[2] = of->s[2];
    return out;
}

/* The parts 1, cos, sin of what is turned about a line. */
static void arm_parts(const arm_line_t *line, const arm_numbers_t *of, arm_numbers_t out[3])
{
    const double back[3] = {-line->p[0], -line->p[1], -line->p[2]};
    const arm_numbers_t here = arm_shifted(of, back);
    arm_numbers_t parts[3];
    unsigned int part;
    unsigned int k;

    for (k = 0U; k < 3U; k++)
    {
        parts[0].s[k] = here.s[k];
        parts[1].s[k] = 0.0;
        parts[2].s[k] = 0.0;
    }
    for (part = 0U; part < 4U; part++)
    {
        const double along = arm_dot(line->z, here.v[part]);

        for (k = 0U; k < 3U; k++)
        {
            parts[0].v[part][k] = along * line->z[k];
        }
        arm_plus(here.v[part], -1.0, parts[0].v[part], parts[1].v[part]);
        arm_cross(line->z, here.v[part], parts[2].v[part]);
    }
    for (part = 0U; part < 3U; part++)
    {
        out[part] = arm_shifted(&parts[part], line->p);
    }
}

static void arm_put(arm_rows_t *rows, unsigned int column, double by, const arm_numbers_t *of)
{
    unsigned int k;

    for (k = 0U; k < 12U; k++)
    {
        rows->at[k][column] = rows->at[k][column] + by * of->v[k / 3U][k % 3U];
    }
    rows->at[12][column] = rows->at[12][column] + by * of->s[0];
    rows->at[13][column] = rows->at[13][column] + by * of->s[1];
}

/* Householder's reflections of the first eight columns. */
static void arm_triangular(arm_rows_t *rows)
{
    unsigned int column;

    for (column = 0U; column < 8U; column++)
    {
        const double first = rows->at[column][column];
        double v[14] = {0.0};
        double square = -0.0;
        double norm;
        double scale;
        unsigned int row;
        unsigned int k;

        for (row = column; row < 14U; row++)
        {
            v[row] = rows->at[row][column];
            square = square + v[row] * v[row];
        }
        norm = sqrt(square);
        if (norm <= 0.0)
        {
            continue;
        }
        v[column] = first - ((first > 0.0) ? -norm : norm);
        scale = 1.0 / (norm * (norm + fabs(first)));
        for (k = column; k < 35U; k++)
        {
            double along = -0.0;

            for (row = column; row < 14U; row++)
            {
                along = along + v[row] * rows->at[row][k];
            }
            for (row = column; row < 14U; row++)
            {
                rows->at[row][k] = rows->at[row][k] - scale * along * v[row];
            }
        }
    }
}

/* The equations, with the eight columns in triangular form. */
static void arm_equations(const arm_line_t axes[6], const arm_line_t *target, arm_rows_t *rows)
{
    arm_line_t back[2];
    arm_numbers_t first[3];
    arm_numbers_t second[3];
    arm_numbers_t third[3];
    arm_numbers_t start;
    unsigned int i;
    unsigned int j;
    unsigned int k;

    for (i = 0U; i < 14U; i++)
    {
        for (k = 0U; k < 35U; k++)
        {
            rows->at[i][k] = 0.0;
        }
    }
    for (i = 0U; i < 2U; i++)
    {
        back[i] = axes[i];
        for (k = 0U; k < 3U; k++)
        {
            back[i].z[k] = -axes[i].z[k];
        }
    }
    start = arm_numbers(target);
    arm_parts(&back[0], &start, first);
    for (j = 0U; j < 3U; j++)
    {
        arm_parts(&back[1], &first[j], second);
        for (k = 0U; k < 3U; k++)
        {
            const unsigned int column = 3U * j + k;

            arm_put(rows, (column == 0U) ? 8U : (column - 1U), (column == 0U) ? -1.0 : 1.0, &second[k]);
        }
    }
    start = arm_numbers(&axes[5]);
    arm_parts(&axes[4], &start, first);
    for (i = 0U; i < 3U; i++)
    {
        arm_parts(&axes[3], &first[i], second);
        for (j = 0U; j < 3U; j++)
        {
            arm_parts(&axes[2], &second[j], third);
            for (k = 0U; k < 3U; k++)
            {
                arm_put(rows, 8U + 9U * i + 3U * j + k, 1.0, &third[k]);
            }
        }
    }
    arm_triangular(rows);
}

/* Coefficients of 1, t, t*t of t = tan(q / 2), times 1 + t*t, of the parts 1, cos, sin at steps of the array. */
static void arm_tangents(double *at, unsigned int by)
{
    const double one = at[0];
    const double c = at[by];
    const double s = at[2U * by];

    at[0] = one + 1.0 * c;
    at[by] = s + 1.0 * s;
    at[2U * by] = one + (-1.0) * c;
}

static void arm_rest(const arm_rows_t *rows, arm_rest_t *out)
{
    unsigned int row;
    unsigned int k;

    for (row = 0U; row < 6U; row++)
    {
        double *const at = &out->at[row][0][0][0];

        for (k = 0U; k < 27U; k++)
        {
            at[k] = rows->at[8U + row][8U + k];
        }
        for (k = 0U; k < 9U; k++)
        {
            arm_tangents(&at[9U * (k / 3U) + k % 3U], 3U);
        }
        for (k = 0U; k < 9U; k++)
        {
            arm_tangents(&at[k], 9U);
        }
    }
}
