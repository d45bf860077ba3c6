use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion, Vector3};

use super::{Lens, Plane, View};

/// Every derivative against central differences: by the frame, and by the constants as moves of the frame.
#[test]
fn derivatives_are_those_of_what_is_read() {
    let at = Isometry3::new(Vector3::new(0.4, -0.7, 1.3), Vector3::new(0.3, 0.1, -0.2));
    let tilted = Unit::new_normalize(Vector3::new(0.3, 0.2, 0.9));
    let lens = Lens::new([900.0, 880.0, 640.0, 360.0], &[-0.2, 0.05, 1e-3, -2e-3, 0.01]);
    let views = [
        View::Point(Vector3::new(0.1, 0.2, 0.3)),
        View::Distance { from: Vector3::new(0.1, 0.2, 0.5), offset: 0.2 },
        View::Plane(Plane::new(tilted, 0.25)),
        View::Direction { along: *tilted, offset: 0.1 },
        View::Level([0.01, -0.02]),
        View::Camera { lens, target: None },
        View::Camera { lens, target: Some(Vector3::new(0.5, -0.6, 2.1)) },
    ];
    let step = 1e-6;
    let moved = |by: &[f64]| {
        let shift = Translation3::new(by[0], by[1], by[2]);
        let turn = UnitQuaternion::from_scaled_axis(Vector3::new(by[3], by[4], by[5]));
        Isometry3::from_parts(
            Translation3::from(at.translation.vector + shift.vector),
            turn * at.rotation,
        )
    };
    for view in views {
        let (by_frame, twists) = (view.by_frame(&at), view.as_twists(&at));
        for k in 0..6 {
            let read = |by: f64| {
                view.read(&moved(&core::array::from_fn::<_, 6, _>(
                    |c| if c == k { by } else { 0.0 },
                )))
            };
            let slope = (read(step) - read(-step)) / (2.0 * step);
            assert!((slope - by_frame.column(k)).norm() < 1e-9, "{view:?} {k}");
        }
        assert_eq!(twists.ncols(), view.constants());
        for k in 0..twists.ncols() {
            let one = |by: f64| -> Vec<f64> {
                (0..twists.ncols()).map(|c| if c == k { by } else { 0.0 }).collect()
            };
            let read = |by| view.moved(&one(by)).read(&at);
            let constants = (read(step) - read(-step)) / (2.0 * step);
            let shifted = by_frame * twists.column(k);
            assert!((constants - shifted).norm() < 1e-9, "{view:?} {k}: {constants}");
        }
    }
}
