
/* The posture that misses the target by least, and half of what it misses it by, squared. */
typedef struct
{
    double off;
    double q[6];
} arm_least_t;

/* Half of distance^2 + tilt^2, m and rad. */
static double arm_off(const arm_six_t *arm, const arm_moved_t *pose)
{
    double missed[2];
    double distance;

    arm_missed_six(pose, &arm->target, missed);
    distance = arm->size * missed[0];
    return 0.5 * (distance * distance + missed[1] * missed[1]);
}

/* Its second derivatives, lower triangle, and what it falls by with each joint. */
static void arm_slopes(
    const arm_six_t *arm, const arm_moved_t *pose, double jacobian[6][6], double second[6][6], double *first)
{
    const double weight = arm->size * arm->size;
    double error[6];
    double aligned = -0.0;
    unsigned int row;
    unsigned int column;
    unsigned int axis;

    arm_error_six(pose, &arm->target, error);
    for (axis = 0U; axis < 3U; axis++)
    {
        aligned = aligned + 0.5 * arm_dot(pose->axes[axis], arm->target.axes[axis]);
    }
    for (row = 0U; row < 6U; row++)
    {
        const double *const last = jacobian[row];

        for (column = 0U; column <= row; column++)
        {
            const double *const other = jacobian[column];
            double along = -0.0;
            double across[3];

            arm_cross(&other[3], last, across);
            for (axis = 0U; axis < 3U; axis++)
            {
                along = along
                    + 0.5 * arm_dot(&other[3], pose->axes[axis]) * arm_dot(&last[3], arm->target.axes[axis]);
            }
            second[row][column] = weight * (arm_dot(other, last) - arm_dot(error, across))
                + (arm_dot(&other[3], &last[3]) * aligned - along);
        }
        first[row] = weight * arm_dot(last, error) + arm_dot(&last[3], &error[3]);
    }
}

/* The nearest posture from joint values, kept where it is nearer than those before. */
static void arm_nearest(const arm_six_t *arm, const double *begin, arm_least_t *least)
{
    double jacobian[6][6];
    double q[6];
    double damping = 1e-2;
    unsigned int step;
    unsigned int k;
    arm_moved_t pose = arm_stands_six(arm, begin, jacobian);
    double off = arm_off(arm, &pose);

    (void)memcpy(q, begin, sizeof q);
    for (step = 0U; step < 40U; step++)
    {
        double moves[6][6];
        double second[6][6];
        double by[6];
        double next[6];
        double scale = -0.0;
        double most;
        double then;
        arm_moved_t there;

        arm_slopes(arm, &pose, jacobian, second, by);
        for (k = 0U; k < 6U; k++)
        {
            scale = scale + fabs(second[k][k]);
        }
        if (arm_solved_six(second, damping * scale, by) == 0)
        {
            damping = damping * 8.0;
            continue;
        }
        most = arm_most(by, 0.0);
        for (k = 0U; k < 6U; k++)
        {
            next[k] = q[k] + by[k] / fmax(most, 1.0);
        }
        there = arm_stands_six(arm, next, moves);
        then = arm_off(arm, &there);
        if (then < off)
        {
            (void)memcpy(q, next, sizeof q);
            (void)memcpy(jacobian, moves, sizeof jacobian);
            pose = there;
            off = then;
            damping = damping * 0.05;
        }
        else
        {
            damping = damping * 8.0;
        }
        if (most < 1e-8)
        {
            break;
        }
    }
    if (off < least->off)
    {
        least->off = off;
        (void)memcpy(least->q, q, sizeof q);
    }
}
