//! The KUKA KR 240-2 by the `k` crate: compared with the textbook's results, then timed.

use std::f64::consts::FRAC_PI_2;
use std::time::Instant;

use k::nalgebra::{Translation3, UnitQuaternion, Vector3};

const TABLE: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [0.35, FRAC_PI_2, 0.0],
    [1.25, 0.0, 0.0],
    [0.055, -FRAC_PI_2, 1.1],
    [0.0, FRAC_PI_2, 0.0],
    [0.0, -FRAC_PI_2, 0.23],
];

fn read(path: &str) -> Vec<f64> {
    let bytes = std::fs::read(path).unwrap_or_else(|e| panic!("{path}: {e}"));
    bytes.as_chunks().0.iter().map(|eight| f64::from_le_bytes(*eight)).collect()
}

fn drive(directory: &str, output: &str, size: usize, mut call: impl FnMut(&[f64], &mut [f64])) {
    for path in ["random", "smooth"] {
        let q = read(&format!("{directory}/{path}.q"));
        let expected = read(&format!("{directory}/{path}.{output}"));
        let mut out = vec![0.0; expected.len()];
        q.chunks(6).zip(out.chunks_mut(size)).for_each(|(q, out)| call(q, out));
        for (k, (a, b)) in out.iter().zip(&expected).enumerate() {
            assert!((a - b).abs() < 1e-10, "k {output}: entry {k} is {a}, not {b}");
        }
        let mut times: Vec<f64> = (0..41)
            .map(|_| {
                let start = Instant::now();
                // The results of 64 poses are written over and over, as for the kernels.
                for q in q.chunks(6 * 64) {
                    q.chunks(6).zip(out.chunks_mut(size)).for_each(|(q, out)| call(q, out));
                    std::hint::black_box(&mut out);
                }
                1e9 * start.elapsed().as_secs_f64() / (q.len() / 6) as f64
            })
            .collect();
        times.sort_by(f64::total_cmp);
        println!("k {output} {path} {:.1}", times[20]);
    }
}

fn main() {
    let directory = std::env::args().nth(1).expect("usage: k-peer DIRECTORY");
    let joints: Vec<k::Node<f64>> = TABLE
        .iter()
        .enumerate()
        .map(|(i, [a, alpha, d])| {
            let twist = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), *alpha);
            let offset = Vector3::new(*a, 0.0, 0.0) + twist * Vector3::new(0.0, 0.0, *d);
            k::NodeBuilder::new()
                .name(&format!("j{}", i + 1))
                .translation(Translation3::from(offset))
                .rotation(twist)
                .joint_type(k::JointType::Rotational { axis: Vector3::z_axis() })
                .into_node()
        })
        .collect();
    joints.windows(2).for_each(|pair| pair[1].set_parent(&pair[0]));
    let chain = k::SerialChain::from_end(&joints[5]);
    drive(&directory, "pose", 12, |q, out| {
        chain.set_joint_positions_unchecked(q);
        let pose = chain.end_transform();
        let rotation = pose.rotation.to_rotation_matrix();
        out[..9].copy_from_slice(rotation.matrix().as_slice());
        out[9..].copy_from_slice(pose.translation.vector.as_slice());
    });
    drive(&directory, "jacobian", 36, |q, out| {
        chain.set_joint_positions_unchecked(q);
        out.copy_from_slice(k::jacobian(&chain).as_slice());
    });
}
