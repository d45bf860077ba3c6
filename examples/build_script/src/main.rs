//! An arm from a robot file, through a build script: no procedural macro, the same text.
//!
//! ```text
//! cargo run -p stiffarm-build-script
//! ```

/// The arm of `examples/elbow.toml`.
#[allow(dead_code)]
mod elbow {
    include!(concat!(env!("OUT_DIR"), "/elbow.rs"));
}

fn main() {
    let q = [30.0, -60.0].map(f64::to_radians);
    let [x, y, _] = elbow::pose(&q).position;
    println!("{}: tool at {x:.4}, {y:.4} m", elbow::NAME);

    let [shoulder, elbow] = elbow::weight_torque(&q);
    println!("torques of its weight: {shoulder:.2} N*m and {elbow:.2} N*m");

    let compliance = elbow::compliance(&q);
    println!("compliance along y at the tool: {:.3} um/N", 1e6 * compliance[1][1]);
}
