//! An arm from a robot file beside Cargo.toml: how far its own weight and a load bend it.
//!
//! The compiler watches the file: a change to the table rebuilds the arm, a mistake in it is an error
//! with the file's line.
//!
//! ```text
//! cargo run -p stiffarm --example robot_file
//! ```

stiffarm::robot! {
    /// Two links in a vertical plane.
    pub mod elbow from "examples/elbow.toml";
}

fn main() -> Result<(), stiffarm::kernels::Unstable> {
    let load = [0.0, -100.0, 0.0, 0.0, 0.0, 0.0];
    println!("{}: how far its tool sinks under 100 N, and under its own weight too", elbow::NAME);
    println!("  shoulder  elbow        tool at x, y         load    with weight");
    for degrees in [[0.0, 0.0], [0.0, 90.0], [45.0, -45.0], [90.0, 0.0]] {
        let q = degrees.map(f64::to_radians);
        let [x, y, _] = elbow::pose(&q).position;
        let loaded = elbow::deflection(&q, &load)?[1];
        let heavy = elbow::deflection_with_gravity(&q, &load)?[1];
        let ([shoulder, elbow], [loaded, heavy]) = (degrees, [loaded, heavy].map(|m| 1e3 * m));
        println!(
            "{shoulder:7} deg {elbow:4} deg  {x:7.3} {y:7.3} m  {loaded:7.3} mm  {heavy:7.3} mm"
        );
    }
    Ok(())
}
