//! Functions of one's own beside an arm's kernels (`formulas.rs`): a camera on the tool is found by Gauss and Newton's
//! method from what it sees, and the tool's clearance from a floor is told with one posture for both.
//!
//! ```text
//! cargo run -p stiffarm-program
//! ```

use nalgebra::{Quaternion, SMatrix, SVector, UnitQuaternion, Vector3};

/// The arm of `robots/arms/kuka_kr240.toml`.
#[allow(dead_code, clippy::all)]
mod kr240 {
    include!(concat!(env!("OUT_DIR"), "/kr240.rs"));
}

const FOCAL: [f64; 2] = [820.0, 815.0];
const CENTRE: [f64; 2] = [320.0, 240.0];

/// Where a camera stands in the tool's frame.
#[derive(Clone, Copy)]
struct Mount {
    at: Vector3<f64>,
    turned: UnitQuaternion<f64>,
}

impl Mount {
    fn sees(
        &self,
        q: &[f64; 6],
        marker: &[f64; 3],
        seen: &[f64; 2],
    ) -> kr240::hand_eye::HandEye<f64> {
        let Quaternion { coords } = *self.turned.quaternion();
        let turned = [coords.w, coords.x, coords.y, coords.z];
        kr240::hand_eye(q, &self.at.into(), &turned, &FOCAL, &CENTRE, marker, seen)
    }
}

fn main() {
    let real = Mount {
        at: Vector3::new(0.06, -0.02, 0.11),
        turned: UnitQuaternion::from_euler_angles(0.03, -0.05, 1.58),
    };
    let marker = [1.9, 0.3, 0.2];
    // A dozen postures that look at the marker from around it, and what the camera sees.
    let views: Vec<([f64; 6], [f64; 2])> = (0..12)
        .map(|k| {
            let swing = |rate: f64| (rate * f64::from(k)).sin();
            let q = [
                0.1 + 0.1 * swing(1.0),
                1.0,
                0.2 + 0.1 * swing(1.7),
                0.3 * swing(2.3),
                0.4,
                swing(0.9),
            ];
            (q, real.sees(&q, &marker, &[0.0; 2]).residual)
        })
        .collect();

    let mut guess =
        Mount { at: Vector3::zeros(), turned: UnitQuaternion::from_euler_angles(0.0, 0.0, 1.5) };
    for round in 0..5 {
        let (mut normal, mut right, mut sum) =
            (SMatrix::<f64, 6, 6>::zeros(), SVector::<f64, 6>::zeros(), 0.0);
        for (q, seen) in &views {
            let found = guess.sees(q, &marker, seen);
            let jacobian = SMatrix::<f64, 2, 6>::from_column_slice(found.jacobian.as_flattened());
            let residual = SVector::<f64, 2>::from(found.residual);
            normal += jacobian.transpose() * jacobian;
            right -= jacobian.transpose() * residual;
            sum += residual.norm_squared();
        }
        println!("round {round}: {:.2e} px rms", (sum / views.len() as f64).sqrt());
        let Some(step) = normal.cholesky().map(|cholesky| cholesky.solve(&right)) else {
            println!("these views do not tell the mount");
            return;
        };
        guess.at += guess.turned * step.fixed_rows::<3>(0);
        guess.turned *= UnitQuaternion::from_scaled_axis(step.fixed_rows::<3>(3));
    }
    let off = (guess.at - real.at).norm();
    println!("camera at {:.4?} m, {off:.0e} m from where it is", guess.at.as_slice());

    let (q, _) = views[0];
    let posture = kr240::Posture::new(&q);
    let tool = kr240::pose::given(&posture).position;
    let clear = kr240::clearance::given(&posture, &[0.05, 0.0, 0.12], &[0.0, 0.0, 1.0], -0.5);
    println!("tool at {:.3} m up, its corner {:.3} m above the floor", tool[2], clear.distance);
    println!("the elbow takes it up at {:.3} m/rad", clear.gradient[2]);
}
