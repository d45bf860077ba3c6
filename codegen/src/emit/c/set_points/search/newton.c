
/* Six axes, lengths by the size, m, from a point on one of them. */
typedef struct
{
    arm_line_t lines[6];
    arm_moved_t home;
    arm_moved_t target;
    double size;
} arm_six_t;

/* The tool at joint values, and how each joint moves it. */
static arm_moved_t arm_stands_six(const arm_six_t *arm, const double *q, double jacobian[6][6])
{
    arm_moved_t so_far = arm_not_moved();
    arm_moved_t pose;
    arm_line_t lines[6];
    unsigned int k;

    for (k = 0U; k < 6U; k++)
    {
        lines[k] = arm_moved_line(&so_far, &arm->lines[k]);
        so_far = arm_then(&so_far, &arm->lines[k], q[k]);
    }
    pose = arm_placed(&so_far, &arm->home);
    for (k = 0U; k < 6U; k++)
    {
        double from[3];

        arm_plus(pose.origin, -1.0, lines[k].p, from);
        arm_cross(lines[k].z, from, jacobian[k]);
        (void)memcpy(&jacobian[k][3], lines[k].z, sizeof lines[k].z);
    }
    return pose;
}

static void arm_missed_six(const arm_moved_t *a, const arm_moved_t *b, double *out)
{
    double turned = 0.0;
    double apart = 0.0;
    unsigned int axis;
    unsigned int k;

    for (axis = 0U; axis < 3U; axis++)
    {
        double square = 0.0;

        for (k = 0U; k < 3U; k++)
        {
            const double by = a->axes[axis][k] - b->axes[axis][k];
            square = square + by * by;
        }
        turned = turned + square;
        apart = apart + (a->origin[axis] - b->origin[axis]) * (a->origin[axis] - b->origin[axis]);
    }
    out[0] = sqrt(apart);
    out[1] = sqrt(0.5 * turned);
}

static void arm_error_six(const arm_moved_t *from, const arm_moved_t *to, double *error)
{
    unsigned int axis;
    unsigned int k;

    for (k = 0U; k < 3U; k++)
    {
        error[k] = to->origin[k] - from->origin[k];
        error[3U + k] = 0.0;
    }
    for (axis = 0U; axis < 3U; axis++)
    {
        double by[3];

        arm_cross(from->axes[axis], to->axes[axis], by);
        for (k = 0U; k < 3U; k++)
        {
            error[3U + k] = error[3U + k] + 0.5 * by[k];
        }
    }
}

static double arm_dot_of_six(const double *a, const double *b)
{
    double sum = 0.0;
    unsigned int k;

    for (k = 0U; k < 6U; k++)
    {
        sum = sum + a[k] * b[k];
    }
    return sum;
}

/* (a + damping)^-1 by, of the lower triangle; 0 where it is not positive definite. */
static int arm_solved_six(double a[6][6], double damping, double *by)
{
    double inverse[6];
    int definite = 1;
    unsigned int k;
    unsigned int row;
    unsigned int column;

    for (k = 0U; k < 6U; k++)
    {
        const double pivot = a[k][k] + damping;

        if (!(pivot > 0.0))
        {
            definite = 0;
        }
        inverse[k] = 1.0 / pivot;
        for (row = k + 1U; row < 6U; row++)
        {
            const double factor = a[row][k] * inverse[k];

            for (column = k + 1U; column <= row; column++)
            {
                a[row][column] = a[row][column] - factor * a[column][k];
            }
            by[row] = by[row] - factor * by[k];
        }
    }
    for (k = 6U; k > 0U; k--)
    {
        for (row = k; row < 6U; row++)
        {
            by[k - 1U] = by[k - 1U] - a[row][k - 1U] * by[row];
        }
        by[k - 1U] = by[k - 1U] * inverse[k - 1U];
    }
    return definite;
}

/* The largest of six numbers and another. */
static double arm_most(const double *by, double most)
{
    unsigned int k;

    for (k = 0U; k < 6U; k++)
    {
        most = fmax(most, fabs(by[k]));
    }
    return most;
}

/* Newton's method from joint values; 0 where it does not lead to the target. */
static int arm_polished(const arm_six_t *arm, double *q)
{
    double before = HUGE_VAL;
    unsigned int step;
    unsigned int row;
    unsigned int column;

    for (step = 0U; step < 20U; step++)
    {
        double jacobian[6][6];
        double a[6][6];
        double by[6];
        double error[6];
        double missed[2];
        double trace = 0.0;
        double off;
        double most;
        const arm_moved_t pose = arm_stands_six(arm, q, jacobian);

        arm_missed_six(&pose, &arm->target, missed);
        off = fmax(missed[0], missed[1]);
        if ((off < 1e-9) && ((off < 1e-15) || (off > 0.5 * before)))
        {
            return 1;
        }
        before = off;
        arm_error_six(&pose, &arm->target, error);
        for (row = 0U; row < 6U; row++)
        {
            for (column = 0U; column <= row; column++)
            {
                a[row][column] = arm_dot_of_six(jacobian[row], jacobian[column]);
            }
            trace = trace + a[row][row];
            by[row] = arm_dot_of_six(jacobian[row], error);
        }
        if (arm_solved_six(a, arm_dot_of_six(error, error) + 1.7763568394002505e-15 * trace, by) == 0)
        {
            return 0;
        }
        most = arm_most(by, 1.0);
        for (row = 0U; row < 6U; row++)
        {
            q[row] = q[row] + by[row] / most;
        }
    }
    return (before < 1e-9) ? 1 : 0;
}
