//! The arms, and the ways to their branches.

use core::f64::consts::FRAC_PI_2;

use rs_opw_kinematics::kinematic_traits::Kinematics as _;
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;
use stiffarm::kernels::{ElbowAngle, Inverse, Pose, has};

use super::screws::{Screws, screws};
use super::{POSES, Way, apart, compete, postures};

macro_rules! arms {
    ($($name:ident $file:literal $built:literal)*) => {
        $(
            stiffarm::robot! {
                pub mod $name from $file;
                outputs: pose, jacobian, inverse_kinematics;
            }
        )*
        /// The same as they are built.
        #[allow(dead_code, clippy::all, reason = "generated text has more than is timed")]
        mod as_built {
            $(pub mod $name { include!(concat!(env!("OUT_DIR"), $built)); })*
        }
    };
}
arms! {
    kr240 "../../../robots/arms/kuka_kr240.toml" "/kuka_kr240_built.rs"
    irb120 "../../../robots/arms/irb120.toml" "/irb120_built.rs"
    puma560 "../../../robots/arms/puma560.toml" "/puma560_built.rs"
    ur10 "../../../robots/arms/ur10.toml" "/ur10_built.rs"
}
stiffarm::robot! {
    pub mod iiwa14 from "../../../robots/arms/iiwa14.toml";
    outputs: pose, jacobian, inverse_kinematics given elbow_angle;
}

/// The joint that peers are given of seven, for want of an elbow angle, and its value, rad.
const GIVEN: (usize, f64) = (2, 0.6);

/// The generated arm.
fn own<'a, const N: usize, A>(arm: &'a A, poses: &'a [Pose<f64>], near: &'a [[f64; N]]) -> Way<'a>
where
    A: Inverse<N, 8> + has::Pose<N>,
{
    Way {
        name: "stiffarm",
        solve: Box::new(|k| {
            arm.inverse_kinematics(&poses[k], &near[k]).iter().map(|s| s.q.to_vec()).collect()
        }),
        run: Box::new(|k| {
            std::hint::black_box(arm.inverse_kinematics(&poses[k], &near[k]));
        }),
        miss: Box::new(|k, q| missed(arm, &poses[k], q)),
        poses: POSES,
    }
}

/// What an arm at joint values misses a pose by.
fn missed<const N: usize>(arm: &impl has::Pose<N>, pose: &Pose<f64>, q: &[f64]) -> f64 {
    let q: [f64; N] = core::array::from_fn(|joint| q[joint]);
    apart(&arm.pose(&arm.posture(&q)), pose)
}

/// ik-geo's solver of a family.
#[cfg(feature = "ik-geo")]
fn geo<'a, const N: usize, A: has::Pose<N>>(
    arm: &'a A,
    screws: &'a Screws<N>,
    poses: &'a [Pose<f64>],
    (name, family, some): (&'static str, fn(H, P) -> ik_geo::robot::Robot, usize),
) -> Way<'a> {
    use ik_geo::inverse_kinematics::auxiliary::Kinematics;
    use ik_geo::nalgebra::{Matrix3, Vector3};
    use ik_geo::robot::IKSolver;
    use std::rc::Rc;
    let column = |v: &[f64; 3]| Vector3::from_column_slice(v);
    let (mut h, mut p, mut tool) = (H::zeros(), P::zeros(), Matrix3::identity());
    if N == 7 {
        let mut all = Kinematics::<7, 8>::new();
        (0..7).for_each(|k| all.h.set_column(k, &column(&screws.directions[k])));
        (0..8).for_each(|k| all.p.set_column(k, &column(&screws.offsets[k])));
        let (six, turned) = all.forward_kinematics_partial(GIVEN.1, GIVEN.0, &tool);
        (h, p, tool) = (six.h, six.p, turned);
    } else {
        (0..6).for_each(|k| h.set_column(k, &column(&screws.directions[k])));
        (0..7).for_each(|k| p.set_column(k, &column(&screws.offsets[k])));
    }
    let robot = Rc::new(family(h, p));
    let targets: Rc<Vec<(Matrix3<f64>, Vector3<f64>)>> = Rc::new(
        poses
            .iter()
            .map(|pose| {
                let columns = screws.turned(pose).map(|v| column(&v));
                (Matrix3::from_columns(&columns) * tool.transpose(), column(&pose.position))
            })
            .collect(),
    );
    let (again, also) = (Rc::clone(&robot), Rc::clone(&targets));
    Way {
        name,
        solve: Box::new(move |k| {
            let found = robot.ik(targets[k].0, targets[k].1).into_iter();
            let each = found.map(|(q, _)| {
                let mut q: Vec<f64> = q.iter().copied().collect();
                if N == 7 {
                    q.insert(GIVEN.0, GIVEN.1);
                }
                q
            });
            each.collect()
        }),
        run: Box::new(move |k| {
            std::hint::black_box(again.ik(also[k].0, also[k].1));
        }),
        miss: Box::new(|k, q| missed(arm, &poses[k], q)),
        poses: some,
    }
}

#[cfg(feature = "ik-geo")]
type H = ik_geo::nalgebra::Matrix3x6<f64>;
#[cfg(feature = "ik-geo")]
type P = ik_geo::inverse_kinematics::auxiliary::Matrix3x7<f64>;

/// rs-opw-kinematics, at its own poses of the same postures.
fn opw<'a>(peer: &'a OPWKinematics, near: &'a [[f64; 6]]) -> Way<'a> {
    let poses: Vec<_> = near.iter().map(|q| peer.forward(q)).collect();
    let [first, second, third] = [(); 3].map(|()| poses.clone());
    Way {
        name: "rs-opw-kinematics",
        solve: Box::new(move |k| peer.inverse(&first[k]).iter().map(|q| q.to_vec()).collect()),
        run: Box::new(move |k| {
            std::hint::black_box(peer.inverse(&second[k]));
        }),
        miss: Box::new(move |k, q| {
            let reached = peer.forward(&core::array::from_fn(|joint| q[joint]));
            let left = reached.rotation.inverse() * third[k].rotation;
            let turned = 2.0 * left.x.hypot(left.y).hypot(left.z);
            (reached.translation - third[k].translation).length().max(turned)
        }),
        poses: POSES,
    }
}

fn parameters([a1, a2, b, c1, c2, c3, c4]: [f64; 7]) -> OPWKinematics {
    let offsets = [0.0, 0.0, -FRAC_PI_2, 0.0, 0.0, 0.0];
    OPWKinematics::new(Parameters { a1, a2, b, c1, c2, c3, c4, offsets, ..Parameters::new() })
}

macro_rules! six {
    ($singular:ident $directory:ident $arm:ident $elbow:expr, $groups:expr, $family:ident, $opw:expr) => {{
        let near = postures::<6>($singular, $elbow);
        let poses: Vec<Pose<f64>> = near.iter().map($arm::pose).collect();
        let screws = screws(&$arm::Robot, $groups);
        write($directory, (stringify!($arm), kind($singular)), &screws, &poses);
        let peer: Option<[f64; 7]> = $opw;
        let peer = peer.map(parameters);
        let mut ways = vec![own(&$arm::Robot, &poses, &near)];
        #[cfg(feature = "ik-geo")]
        ways.push(geo(&$arm::Robot, &screws, &poses, ("ik-geo", ik_geo::robot::$family, POSES)));
        ways.extend(peer.as_ref().map(|peer| opw(peer, &near)));
        compete(&title(stringify!($arm), $singular), &ways);
    }};
}

fn kind(singular: bool) -> &'static str {
    if singular { "singular" } else { "random" }
}

fn title(arm: &str, singular: bool) -> String {
    format!("{arm}, {}", if singular { "near singular poses" } else { "random poses" })
}

fn write<const N: usize>(
    directory: Option<&str>,
    (arm, kind): (&str, &str),
    screws: &Screws<N>,
    poses: &[Pose<f64>],
) {
    let Some(directory) = directory else { return };
    let path = format!("{directory}/{arm}.{kind}.screws");
    std::fs::write(path, screws.written(poses)).expect("the directory can be written to");
}

/// The arms as their tables say.
pub fn nominal(singular: bool, directory: Option<&str>) {
    const WRIST: &[&[usize]] = &[&[3, 4, 5]];
    six!(singular directory kr240 -(0.055_f64 / 1.1).atan(), WRIST, spherical_two_parallel,
        Some([0.35, -0.055, 0.0, 0.0, 1.25, 1.1, 0.23]));
    six!(singular directory irb120 0.0, WRIST, spherical_two_parallel,
        Some([0.0, -0.07, 0.0, 0.29, 0.27, 0.302, 0.072]));
    six!(singular directory puma560 0.0, WRIST, spherical_two_parallel,
        Some([0.0, 0.0203, 0.15005, 0.672, 0.4318, 0.4318, 0.0]));
    six!(singular directory ur10 0.0, &[&[4, 5]], three_parallel_two_intersecting, None);
    let mut near = postures::<7>(singular, 0.0);
    near.iter_mut().for_each(|q| q[GIVEN.0] = GIVEN.1);
    let poses: Vec<Pose<f64>> = near.iter().map(iiwa14::pose).collect();
    let angles: Vec<f64> = near.iter().map(iiwa14::elbow_angle).collect();
    let screws = screws(&iiwa14::Robot, &[&[0, 1, 2], &[4, 5, 6]]);
    write(directory, ("iiwa14", kind(singular)), &screws, &poses);
    let mut first = own(&iiwa14::Robot, &poses, &near);
    let arm = iiwa14::Robot;
    first.run = Box::new(|k| {
        std::hint::black_box(arm.inverse_kinematics_at(&poses[k], &near[k], angles[k]));
    });
    #[allow(unused_mut, reason = "ik-geo is a feature")]
    let mut ways = vec![first];
    #[cfg(feature = "ik-geo")]
    ways.push(geo(
        &iiwa14::Robot,
        &screws,
        &poses,
        ("ik-geo at a given joint 3", ik_geo::robot::spherical_two_intersecting, POSES),
    ));
    compete(&title("iiwa14 at a given elbow angle", singular), &ways);
}

macro_rules! built {
    ($directory:ident $arm:ident, $groups:expr, $family:ident) => {{
        let near = postures::<6>(false, 0.0);
        let poses: Vec<Pose<f64>> = near.iter().map(as_built::$arm::pose).collect();
        let (as_designed, as_it_is) =
            (screws(&$arm::Robot, $groups), screws(&as_built::$arm::Robot, &[]));
        #[allow(unused_mut, reason = "ik-geo is a feature")]
        let mut ways = vec![own(&as_built::$arm::Robot, &poses, &near)];
        #[cfg(feature = "ik-geo")]
        ways.extend([
            geo(
                &as_built::$arm::Robot,
                &as_designed,
                &poses,
                ("ik-geo by the designed table", ik_geo::robot::$family, POSES),
            ),
            geo(
                &as_built::$arm::Robot,
                &as_it_is,
                &poses,
                ("ik-geo by six general axes", ik_geo::robot::gen_six_dof, 8),
            ),
        ]);
        let _ = &as_designed;
        write($directory, (stringify!($arm), "built"), &as_it_is, &poses);
        compete(concat!(stringify!($arm), " as built, random poses"), &ways);
    }};
}

/// The same arms with every entry off by up to 0.5 mm or 0.5 mrad.
pub fn built(directory: Option<&str>) {
    const WRIST: &[&[usize]] = &[&[3, 4, 5]];
    built!(directory kr240, WRIST, spherical_two_parallel);
    built!(directory irb120, WRIST, spherical_two_parallel);
    built!(directory puma560, WRIST, spherical_two_parallel);
    built!(directory ur10, &[&[4, 5]], three_parallel_two_intersecting);
}
