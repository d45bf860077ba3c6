//! A pattern search in a box: no derivatives, no randomness.

/// Steps below this part of the box's width change nothing more.
const SMALLEST: f64 = 1e-9;

/// First step as a part of the box's width.
const FIRST: f64 = 0.1;

/// Polls of all coordinates, so that the search ends on any function.
const MOST_POLLS: usize = 4000;

/// Walks uphill from `start` within `bounds` by trying each coordinate up and down, and along the
/// last successful direction; halves the step where nothing is higher. `value` may be NaN, which is
/// never higher. Gives the highest point found and its value.
pub(super) fn climb(
    start: &[f64],
    bounds: &[[f64; 2]],
    value: impl Fn(&[f64]) -> f64,
) -> (Vec<f64>, f64) {
    let mut point = start.to_vec();
    let mut height = value(&point);
    let mut part = FIRST;
    for _ in 0..MOST_POLLS {
        if part < SMALLEST {
            break;
        }
        let before = point.clone();
        let old = height;
        poll(&mut point, &mut height, bounds, part, &value);
        if height <= old {
            part /= 2.0;
            continue;
        }
        // Hooke and Jeeves: go on in the direction that a whole poll has found.
        let leap: Vec<f64> = (0..point.len())
            .map(|k| (2.0 * point[k] - before[k]).clamp(bounds[k][0], bounds[k][1]))
            .collect();
        let mut leapt = leap;
        let mut leapt_height = value(&leapt);
        poll(&mut leapt, &mut leapt_height, bounds, part, &value);
        if leapt_height > height {
            (point, height) = (leapt, leapt_height);
        }
    }
    (point, height)
}

/// Moves each coordinate in turn by `part` of its width, keeping what goes up.
fn poll(
    point: &mut [f64],
    height: &mut f64,
    bounds: &[[f64; 2]],
    part: f64,
    value: &impl Fn(&[f64]) -> f64,
) {
    for k in 0..point.len() {
        let [low, high] = bounds[k];
        let here = point[k];
        for side in [1.0, -1.0] {
            point[k] = (here + side * part * (high - low)).clamp(low, high);
            let there = value(point);
            if there > *height || (height.is_nan() && !there.is_nan()) {
                *height = there;
                break;
            }
            point[k] = here;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn climbs_a_curved_ridge() {
        // Rosenbrock's valley, upside down.
        let ridge = |x: &[f64]| -((1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2));
        let (at, height) = climb(&[-1.2, 1.0], &[[-2.0, 2.0]; 2], ridge);
        assert!(height > -1e-8, "{at:?} {height}");
    }

    #[test]
    fn stops_at_the_box() {
        let (at, _) = climb(&[0.2], &[[0.0, 1.0]], |x| x[0]);
        assert_eq!(at, [1.0]);
        let (_, nothing) = climb(&[0.2], &[[0.0, 1.0]], |_| f64::NAN);
        assert!(nothing.is_nan());
    }
}
