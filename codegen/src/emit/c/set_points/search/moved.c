
/* Every solution of six joints that turn, wherever their axes are: a search, not a closed form, in double precision. The
 * Rust kernels' (stiffarm_kernels::Axes) operation by operation, which say how it works. Every loop is bounded. */
typedef struct
{
    double z[3];
    double p[3];
} arm_line_t;

/* A displacement, or a pose: axes x, y, z and the origin. */
typedef struct
{
    double axes[3][3];
    double origin[3];
} arm_moved_t;

static const double arm_turn = 6.283185307179586;

static double arm_dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void arm_cross(const double *a, const double *b, double *out)
{
    const double x = a[1] * b[2] - a[2] * b[1];
    const double y = a[2] * b[0] - a[0] * b[2];
    const double z = a[0] * b[1] - a[1] * b[0];

    out[0] = x;
    out[1] = y;
    out[2] = z;
}

/* a + f * b. */
static void arm_plus(const double *a, double f, const double *b, double *out)
{
    unsigned int k;

    for (k = 0U; k < 3U; k++)
    {
        out[k] = a[k] + f * b[k];
    }
}

/* Cosine and sine. */
static void arm_circle(double angle, double *out)
{
    POLYNOMIAL
    const int beyond = ((angle <= 1e9) && (angle >= -1e9)) ? 0 : 1;
    const double quarter = multiple - 4.0 * floor(0.25 * multiple);
    const int odd = ((quarter == 1.0) || (quarter == 3.0)) ? 1 : 0;

    out[0] = (odd == 1) ? s : c;
    out[1] = (odd == 1) ? c : s;
    out[0] = ((quarter == 1.0) || (quarter == 2.0)) ? -out[0] : out[0];
    out[1] = (quarter > 1.0) ? -out[1] : out[1];
    if (beyond == 1)
    {
        out[0] = (angle - angle) / (angle - angle);
        out[1] = out[0];
    }
}

/* v turned about a unit vector by an angle of this cosine and sine. */
static void arm_turned(const double *v, const double *z, const double *by, double *out)
{
    const double along = arm_dot(z, v) * (1.0 - by[0]);
    double across[3];
    unsigned int k;

    arm_cross(z, v, across);
    for (k = 0U; k < 3U; k++)
    {
        out[k] = by[0] * v[k] + by[1] * across[k] + along * z[k];
    }
}

static void arm_vector(const arm_moved_t *m, const double *v, double *out)
{
    unsigned int k;

    for (k = 0U; k < 3U; k++)
    {
        out[k] = m->axes[0][k] * v[0] + m->axes[1][k] * v[1] + m->axes[2][k] * v[2];
    }
}

static void arm_vector_back(const arm_moved_t *m, const double *v, double *out)
{
    unsigned int k;

    for (k = 0U; k < 3U; k++)
    {
        out[k] = arm_dot(m->axes[k], v);
    }
}

static arm_line_t arm_moved_line(const arm_moved_t *m, const arm_line_t *line)
{
    arm_line_t out;
    double p[3];

    arm_vector(m, line->z, out.z);
    arm_vector(m, line->p, p);
    arm_plus(p, 1.0, m->origin, out.p);
    return out;
}

static arm_line_t arm_line_back(const arm_moved_t *m, const arm_line_t *line)
{
    arm_line_t out;
    double p[3];

    arm_vector_back(m, line->z, out.z);
    arm_plus(line->p, -1.0, m->origin, p);
    arm_vector_back(m, p, out.p);
    return out;
}

static arm_moved_t arm_not_moved(void)
{
    const arm_moved_t out = {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}, {0.0, 0.0, 0.0}};

    return out;
}

/* Behind m a turn about a line. */
static arm_moved_t arm_then(const arm_moved_t *m, const arm_line_t *line, double angle)
{
    const arm_moved_t not_moved = arm_not_moved();
    arm_moved_t out;
    double by[2];
    double v[3];
    double back[3];
    unsigned int k;

    arm_circle(angle, by);
    arm_turned(line->p, line->z, by, v);
    arm_plus(line->p, -1.0, v, back);
    for (k = 0U; k < 3U; k++)
    {
        arm_turned(not_moved.axes[k], line->z, by, v);
        arm_vector(m, v, out.axes[k]);
    }
    arm_vector(m, back, v);
    arm_plus(v, 1.0, m->origin, out.origin);
    return out;
}

static arm_moved_t arm_placed(const arm_moved_t *m, const arm_moved_t *home)
{
    arm_moved_t out;
    double v[3];
    unsigned int k;

    arm_vector(m, home->origin, v);
    arm_plus(v, 1.0, m->origin, out.origin);
    for (k = 0U; k < 3U; k++)
    {
        arm_vector(m, home->axes[k], out.axes[k]);
    }
    return out;
}
