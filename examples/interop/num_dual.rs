//! A kernel of dual numbers gives derivatives: how the sag under a load changes with every joint, in one call.
//!
//! ```text
//! cargo run -p stiffarm --example with_num_dual --features num-dual
//! ```

use num_dual::DualSVec64;
use stiffarm::kernels::{Scalar, Unstable};

stiffarm::robot! {
    mod kr240 from "robots/arms/kuka_kr240.toml";
    outputs: deflection;
}

/// 200 kg.
const LOAD: [f64; 6] = [0.0, 0.0, -1962.0, 0.0, 0.0, 0.0];

fn sag<S: Scalar>(q: &[S; 6]) -> Result<S, Unstable> {
    Ok(kr240::deflection(q, &LOAD.map(S::lit))?[2])
}

fn main() -> Result<(), Unstable> {
    let q: [f64; 6] = [0.2, 0.9, -1.1, 0.4, 0.8, 0.1];
    let seeded: [DualSVec64<6>; 6] =
        core::array::from_fn(|joint| DualSVec64::from_re(q[joint]).derivative(joint));
    let sag_with_slopes = sag(&seeded)?;
    assert!((sag_with_slopes.re - sag(&q)?).abs() < 1e-15);
    for joint in 0..6 {
        let slope = sag_with_slopes.eps.0.map_or(0.0, |gradient| gradient[joint]);
        println!("joint {}: {:9.3} µm/rad", joint + 1, 1e6 * slope);
        let moved = |by: f64| {
            let mut q = q;
            q[joint] += by;
            sag(&q)
        };
        // Central differences of 1e-4 err by 1e-8 of the sag, some millimetres.
        let difference = (moved(1e-4)? - moved(-1e-4)?) / 2e-4;
        assert!((slope - difference).abs() < 1e-9, "{slope:e} {difference:e}");
    }
    Ok(())
}
