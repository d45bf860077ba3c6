
typedef struct
{
    double q[16][6];
    unsigned int count;
} arm_found_t;

/* Adds a solution that is not known yet. */
static void arm_add(arm_found_t *found, double *q)
{
    const double whole = 6755399441055744.0;
    unsigned int known;
    unsigned int k;

    for (k = 0U; k < 6U; k++)
    {
        q[k] = q[k] + (((0.0 - q[k]) / arm_turn + whole) - whole) * arm_turn;
    }
    for (known = 0U; known < found->count; known++)
    {
        int one = 1;

        for (k = 0U; k < 6U; k++)
        {
            const double by = fabs(found->q[known][k] - q[k]);

            if (!(fmin(by, fabs(by - arm_turn)) < 1e-6))
            {
                one = 0;
            }
        }
        if (one == 1)
        {
            return;
        }
    }
    if (found->count < 16U)
    {
        (void)memcpy(found->q[found->count], q, sizeof found->q[0]);
        found->count = found->count + 1U;
    }
}

/* Joint values by each root of the equations with joint `third` from 0 in the middle: solutions are found, or where
 * `least` is given the nearest posture. Returns how many roots are most likely angles. */
static unsigned int arm_begin(const arm_six_t *arm, unsigned int third, arm_found_t *found, arm_least_t *least)
{
    const unsigned int first = (third + 4U) % 6U;
    const arm_moved_t not_moved = arm_not_moved();
    arm_moved_t displacement = arm->target;
    arm_line_t lines[6];
    arm_line_t last;
    arm_rows_t rows;
    arm_rest_t rest;
    arm_twelve_t twelve;
    double around[24][2];
    double values[24];
    double c[9][2];
    double z[16][2];
    double v[3];
    unsigned int on_circle = 0U;
    unsigned int least_axis = 0U;
    unsigned int k;
    unsigned int m;

    for (k = 0U; k < 3U; k++)
    {
        for (m = 0U; m < 3U; m++)
        {
            v[m] = arm_dot(arm->home.axes[m], not_moved.axes[k]);
        }
        arm_vector(&arm->target, v, displacement.axes[k]);
    }
    arm_vector(&displacement, arm->home.origin, v);
    arm_plus(arm->target.origin, -1.0, v, displacement.origin);
    for (k = 0U; k < 6U; k++)
    {
        lines[k] = (first + k < 6U) ? arm->lines[first + k]
                                    : arm_line_back(&displacement, &arm->lines[first + k - 6U]);
    }
    last = arm_moved_line(&displacement, &lines[5]);
    arm_equations(lines, &last, &rows);
    arm_rest(&rows, &rest);
    for (k = 0U; k < 24U; k++)
    {
        arm_circle(arm_turn * (double)k / 24.0, around[k]);
        arm_twelve(&rest, around[k], &twelve);
        values[k] = twelve.determinant;
    }
    for (m = 0U; m < 9U; m++)
    {
        c[m][0] = 0.0;
        c[m][1] = 0.0;
        for (k = 0U; k < 24U; k++)
        {
            const double *const at = around[(m * k) % 24U];

            c[m][0] = c[m][0] + values[k] * at[0];
            c[m][1] = c[m][1] - values[k] * at[1];
        }
    }
    for (k = 0U; k < 3U; k++)
    {
        least_axis = (fabs(lines[5].z[k]) < fabs(lines[5].z[least_axis])) ? k : least_axis;
    }
    arm_roots(&c[0][0], &z[0][0]);
    for (k = 0U; k < 16U; k++)
    {
        const double square = z[k][0] * z[k][0] + z[k][1] * z[k][1];
        const double beside = fmax(square, 1.0 / square);
        arm_moved_t so_far = arm_not_moved();
        double q[6];
        double turned[6];
        double by[2];
        double x[3];
        double to[3];
        double across[3];

        if (!(beside < ((least == NULL) ? 1.4918 : HUGE_VAL)))
        {
            continue;
        }
        on_circle = on_circle + ((beside < 1.02) ? 1U : 0U);
        q[2] = arm_angle_of(z[k][1], z[k][0]);
        arm_circle(q[2], by);
        arm_twelve(&rest, by, &twelve);
        arm_fourth_fifth(&twelve, q);
        arm_first_two(&rows, q);
        for (m = 0U; m < 5U; m++)
        {
            so_far = arm_then(&so_far, &lines[m], q[m]);
        }
        arm_cross(lines[5].z, not_moved.axes[least_axis], x);
        arm_vector(&displacement, x, v);
        arm_vector_back(&so_far, v, to);
        arm_cross(x, to, across);
        q[5] = arm_angle_of(arm_dot(lines[5].z, across), arm_dot(x, to));
        for (m = 0U; m < 6U; m++)
        {
            turned[(first + m) % 6U] = q[m];
        }
        if (least != NULL)
        {
            arm_nearest(arm, turned, least);
        }
        else if (arm_polished(arm, turned) == 1)
        {
            arm_add(found, turned);
        }
    }
    return on_circle;
}

/* Every solution at a target, with the joint `given` (none: n) where `near` has it; of a target out of reach the only one
 * is the posture that misses it by least. What is none misses it by an infinite distance. */
static void arm_search_all(const arm_line_t *axes, const arm_moved_t *home, const unsigned int n, const double *near,
    const double *target, const unsigned int given, const unsigned int third, double *q, double *distance, double *tilt)
{
    const unsigned int others[4] = {0U, 3U, 4U, 1U};
    arm_six_t arm;
    arm_moved_t by = arm_not_moved();
    arm_moved_t stands;
    arm_found_t found;
    double origin[3];
    double jacobian[6][6];
    double missed[2];
    unsigned int k;
    unsigned int m;

    found.count = 0U;
    if (given < n)
    {
        by = arm_then(&by, &axes[given], near[given]);
    }
    for (k = 0U; k < 6U; k++)
    {
        arm.lines[k] = (k >= given) ? arm_moved_line(&by, &axes[k + 1U]) : axes[k];
    }
    arm.home = (given < n) ? arm_placed(&by, home) : *home;
    for (k = 0U; k < 3U; k++)
    {
        arm.target.axes[0][k] = target[k] / sqrt(arm_dot(target, target));
    }
    arm_plus(&target[3], -arm_dot(arm.target.axes[0], &target[3]), arm.target.axes[0], origin);
    for (k = 0U; k < 3U; k++)
    {
        arm.target.axes[1][k] = origin[k] / sqrt(arm_dot(origin, origin));
    }
    arm_cross(arm.target.axes[0], arm.target.axes[1], arm.target.axes[2]);
    (void)memcpy(origin, arm.lines[2].p, sizeof origin);
    arm.size = 0.0;
    for (k = 0U; k < 7U; k++)
    {
        double *const p = (k < 6U) ? arm.lines[k].p : arm.home.origin;

        arm_plus(p, -1.0, origin, p);
        arm.size = fmax(arm.size, sqrt(arm_dot(p, p)));
    }
    arm_plus(&target[9], -1.0, origin, arm.target.origin);
    for (m = 0U; m < 3U; m++)
    {
        for (k = 0U; k < 6U; k++)
        {
            arm.lines[k].p[m] = arm.lines[k].p[m] / arm.size;
        }
        arm.home.origin[m] = arm.home.origin[m] / arm.size;
        arm.target.origin[m] = arm.target.origin[m] / arm.size;
    }
    for (m = 0U; m < 4U; m++)
    {
        const unsigned int roots = arm_begin(&arm, (third + others[m]) % 6U, &found, NULL);

        if ((found.count > 0U) && (found.count % 2U == 0U) && (found.count >= roots))
        {
            break;
        }
    }
    if (found.count == 0U)
    {
        arm_least_t least;
        double begin[6];

        for (k = 0U; k < 6U; k++)
        {
            begin[k] = near[(k >= given) ? (k + 1U) : k];
        }
        least.off = HUGE_VAL;
        arm_nearest(&arm, begin, &least);
        for (m = 0U; m < 4U; m++)
        {
            (void)arm_begin(&arm, (third + others[m]) % 6U, &found, &least);
        }
        if (isfinite(least.off))
        {
            arm_add(&found, least.q);
        }
    }
    for (k = 0U; k < 16U; k++)
    {
        (void)memcpy(&q[n * k], near, n * sizeof near[0]);
        distance[k] = HUGE_VAL;
        tilt[k] = HUGE_VAL;
        if (k < found.count)
        {
            stands = arm_stands_six(&arm, found.q[k], jacobian);
            arm_missed_six(&stands, &arm.target, missed);
            distance[k] = arm.size * missed[0];
            tilt[k] = missed[1];
            for (m = 0U; m < 6U; m++)
            {
                q[n * k + ((m >= given) ? (m + 1U) : m)] = found.q[k][m];
            }
        }
    }
}
