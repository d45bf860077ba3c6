//! An arm from a table in the source: where the tool is, how it moves, and how far a load bends it.
//!
//! The table is KUKA's KR 240-2 with the stiffnesses of Dumas et al. (2011), Table 3.
//!
//! ```text
//! cargo run -p stiffarm --example inline_table
//! ```

stiffarm::robot! {
    /// KUKA KR 240-2.
    pub mod kr240;
    name: "KUKA KR 240-2";
    convention: modified_dh;
    joint | theta | d       | a       | alpha  | stiffness
    a1    | q     | 0       | 0       | 0      | 3.8e6 N*m/rad
    a2    | q     | 0       | 350 mm  | 90 deg | 6.6e6 N*m/rad
    a3    | q     | 0       | 1250 mm | 0      | 3.9e6 N*m/rad
    a4    | q     | 1100 mm | 55 mm   | -pi/2  | 5.6e5 N*m/rad
    a5    | q     | 0       | 0       | 90 deg | 6.6e5 N*m/rad
    a6    | q     | 230 mm  | 0       | -pi/2  | 4.7e5 N*m/rad
}

fn main() -> Result<(), stiffarm::kernels::Unstable> {
    let q = [20.0, 70.0, -60.0, 30.0, 50.0, 10.0].map(f64::to_radians);
    println!("{} with {} joints", kr240::NAME, kr240::N);

    let [x, y, z] = kr240::pose(&q).position;
    println!("tool at                 {x:8.4} {y:8.4} {z:8.4} m");

    println!("Jacobian, a column per joint (m/rad, then rad/rad):");
    for (row, column) in kr240::DH.iter().zip(kr240::jacobian(&q)) {
        let column = column.map(|entry| format!("{entry:8.4}"));
        println!("  {}  {}", row.joint, column.join(" "));
    }

    let wrench = [0.0, 0.0, -2000.0, 0.0, 0.0, 0.0];
    let [dx, dy, dz, ..] = kr240::deflection(&q, &wrench)?.map(|metres| 1e3 * metres);
    println!("a load of 2 kN moves it {dx:8.4} {dy:8.4} {dz:8.4} mm");
    Ok(())
}
