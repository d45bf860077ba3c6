use nalgebra::{Unit, Vector3};

use super::{Plane, View};

/// Every derivative against central differences: by the point, and by the constants as shifts of the point.
#[test]
fn derivatives_are_those_of_what_is_read() {
    let point = Vector3::new(0.4, -0.7, 0.3);
    let tilted = Unit::new_normalize(Vector3::new(0.3, 0.2, 0.9));
    let views = [
        View::Point(Vector3::new(0.1, 0.2, 0.3)),
        View::Distance { from: Vector3::new(0.1, 0.2, 0.5), offset: 0.2 },
        View::Plane(Plane::new(tilted, 0.25)),
        View::Direction(*tilted),
    ];
    let step = 1e-6;
    for view in views {
        let (by_point, shifts) = (view.by_point(&point), view.as_shifts(&point));
        for k in 0..3 {
            let by = Vector3::ith(k, step);
            let moved = (view.read(&(point + by)) - view.read(&(point - by))) / (2.0 * step);
            assert!((moved - by_point.column(k)).norm() < 1e-9, "{view:?} {k}");
        }
        for k in 0..shifts.ncols() {
            let one = |by: f64| -> Vec<f64> {
                (0..shifts.ncols()).map(|c| if c == k { by } else { 0.0 }).collect()
            };
            let read = |by| view.moved(&one(by)).read(&point);
            let constants = (read(step) - read(-step)) / (2.0 * step);
            let shifted = by_point * shifts.column(k);
            assert!((constants - shifted).norm() < 1e-9, "{view:?} {k}: {constants}");
        }
    }
}
