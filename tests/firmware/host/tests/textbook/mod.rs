//! An arm as the textbook has it, which shares no code with the kernels.

use nalgebra::Matrix3;
use stiffarm::kernels::{Arm, Numeric};
use stiffarm_kernels::generic::{Arm as Textbook, Joint};

/// The rows that the kernels were made of, in numbers, and the moments of inertia of the robot file.
pub fn textbook<const N: usize, A: Arm<N> + Numeric<N>>(_: &A, file: &str) -> Textbook {
    let file: toml::Table = file.parse().expect("a robot file");
    let inertia = |k: usize| {
        let moments = file["joint"][k].get("inertia").and_then(|cell| cell.as_array());
        let number = |cell: &toml::Value| cell.as_float().expect("a number with a point");
        match moments.map(|cells| cells.iter().map(number).collect::<Vec<_>>()).as_deref() {
            Some(&[xx, xy, xz, yy, yz, zz]) => Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
            _ => Matrix3::zeros(),
        }
    };
    let joint = |k: usize| {
        let row = &A::ROWS[k];
        Joint {
            motion: A::DH[k].motion,
            theta: row.theta,
            d: row.d,
            a: row.a,
            alpha: row.alpha,
            compliance: row.stiffness.map_or(0.0, f64::recip),
            mass: row.mass,
            com: row.com.into(),
            inertia: inertia(k),
            ..Joint::default()
        }
    };
    Textbook {
        name: A::NAME.to_owned(),
        convention: A::CONVENTION,
        joints: (0..N).map(joint).collect(),
        gravity: A::GRAVITY.into(),
        ..Textbook::default()
    }
}
