//! Lanes of simba, nalgebra's numbers, through a kernel: four poses in one call.
//!
//! ```text
//! cargo run -p stiffarm --example with_simba --features simba
//! ```

use simba::simd::WideF64x4;
use stiffarm::kernels::simba::Field;

stiffarm::robot! {
    mod ur5 from "robots/arms/ur5.toml";
    outputs: pose;
}

fn main() {
    let postures: [[f64; 6]; 4] = core::array::from_fn(|lane| {
        core::array::from_fn(|joint| 0.3 * (lane + joint) as f64 - 0.8)
    });
    let lanes = core::array::from_fn(|joint| {
        Field(WideF64x4::from(postures.map(|posture| posture[joint])))
    });
    let [x, y, z] = ur5::pose(&lanes).position.map(|Field(lanes)| <[f64; 4]>::from(lanes));
    for (lane, posture) in postures.iter().enumerate() {
        let alone = ur5::pose(posture).position;
        println!("{:8.4} {:8.4} {:8.4} m", x[lane], y[lane], z[lane]);
        // The lanes' own sines, two roundings apart from the kernels', of an arm of a metre.
        for (a, b) in [x[lane], y[lane], z[lane]].into_iter().zip(alone) {
            assert!((a - b).abs() < 4e-15, "{a} {b}");
        }
    }
}
