//! Lanes of poses give what the scalar kernels give, to the bit: nothing is fused, and sines and
//! cosines are one polynomial.

use stiffarm::kernels::lanes::{f32x8, f64x4, f64x8};
use stiffarm::kernels::{Kernels, Scalar};

use crate::compare::{Draws, block};
use crate::fixtures;

/// An output by one call for all lanes, and by one call for each.
fn check<S, L, const N: usize>(
    robot: &(impl Kernels<S> + Kernels<L>),
    lanes: impl Fn([S; N]) -> L,
    each: impl Fn(L) -> [S; N],
    same: impl Fn(S, S) -> bool,
) where
    S: Scalar + core::fmt::Debug,
    L: Scalar,
{
    let n = Kernels::<S>::dof(robot);
    let mut draws = Draws::new(6);
    for _ in 0..stiffarm_draws::few_or_many(40, 200) {
        let q: Vec<[S; N]> = (0..3 * n)
            .map(|_| core::array::from_fn(|_| S::lit(0.6 + 2.5 * draws.unit())))
            .collect();
        let wrench: [[S; N]; 6] =
            core::array::from_fn(|_| core::array::from_fn(|_| S::lit(10.0 * draws.unit())));
        let q_lanes: Vec<L> = q.iter().map(|q| lanes(*q)).collect();
        let wrench_lanes = wrench.map(&lanes);
        for &output in Kernels::<S>::outputs(robot) {
            let numbers = output.state(n);
            let together = block::<L>(robot, output, &q_lanes[..numbers], &wrench_lanes);
            for lane in 0..N {
                let q: Vec<S> = q[..numbers].iter().map(|q| q[lane]).collect();
                let single = block::<S>(robot, output, &q, &wrench.map(|w| w[lane]));
                for (a, b) in together.iter().zip(single) {
                    let a = each(*a)[lane];
                    assert!(same(a, b), "{} lane {lane}: {a:?} {b:?}", output.name());
                }
            }
        }
    }
}

fn check_all<R>(robot: &R)
where
    R: Kernels<f64> + Kernels<f32> + Kernels<f64x4> + Kernels<f64x8> + Kernels<f32x8>,
{
    let same = |a: f64, b: f64| a.to_bits() == b.to_bits();
    check(robot, f64x4::from, f64x4::to_array, same);
    check(robot, f64x8::from, f64x8::to_array, same);
    check(robot, f32x8::from, f32x8::to_array, |a: f32, b: f32| a.to_bits() == b.to_bits());
}

#[test]
fn lanes_are_scalars_side_by_side() {
    use stiffarm_robots::{iiwa14, kuka_kr240, lin_planar, stanford, ur10};
    check_all(&lin_planar::Robot);
    check_all(&kuka_kr240::Robot);
    check_all(&ur10::Robot);
    check_all(&iiwa14::Robot);
    check_all(&crate::by_joints::various::Robot);
    check_all(&crate::by_joints::ur10::Robot);
    check_all(&stanford::Robot);
    check_all(&fixtures::oblique::Robot);
}
