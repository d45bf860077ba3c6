use nalgebra::Vector6;

use super::*;
use crate::fixture;
use crate::measurement::Layout;
use crate::{Noise, Plant, csv};

const POSE: Kind = Kind::Pose { orientation: true };

fn design(shape: Shape) -> Design {
    Design { shape, poses: 12, repeats: 2, payload: 40.0, kind: POSE, seed: 3 }
}

#[test]
fn a_payload_is_nothing_half_and_full_at_every_pose() {
    let arm = fixture::springy();
    let data = design(Shape::Payload).rows(&arm);
    assert_eq!((data.rows.len(), data.poses), (12 * 3 * 2, 12));
    for pose in 0..12 {
        let of_pose = data.rows.iter().filter(|row| row.group == pose);
        let mut forces: Vec<f64> = of_pose.map(|row| row.wrench[2]).collect();
        forces.sort_by(f64::total_cmp);
        assert_eq!(forces, [-392.266, -392.266, -196.133, -196.133, 0.0, 0.0]);
    }
    assert!(data.rows.iter().any(|row| row.wrench[3].abs() > 1.0));
}

#[test]
fn forces_go_in_many_directions() {
    let data = design(Shape::Force).rows(&fixture::springy());
    assert_eq!(data.rows.len(), 12 * 4 * 2);
    for k in 0..6 {
        let of = |sign: f64| data.rows.iter().filter(move |row| sign * row.wrench[k] > 0.0).count();
        assert!(of(1.0) > 20 && of(-1.0) > 20);
    }
}

#[test]
fn a_narrow_design_keeps_to_a_tenth() {
    let data = design(Shape::Narrow).rows(&fixture::springy());
    for j in 0..3 {
        let values = || data.rows.iter().map(|row| row.q[j]);
        let width = values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min);
        assert!(width <= 0.1 * 300_f64.to_radians() + 2e-6 && width > 0.3, "{width}");
    }
}

#[test]
fn directions_are_those_of_the_last_moves() {
    let arm = fixture::springy();
    let one_sided = design(Shape::OneSided).rows(&arm);
    assert!(one_sided.rows.iter().all(|row| row.direction == Some(vec![1; 3])));
    let data = design(Shape::Payload).rows(&arm);
    let side = |row: &Row| row.direction.clone().unwrap();
    for pair in data.rows.windows(2) {
        for j in 0..3 {
            let moved = pair[1].q[j] - pair[0].q[j];
            let expected = if moved == 0.0 { side(&pair[0])[j] } else { moved.signum() as i8 };
            assert_eq!(side(&pair[1])[j], expected);
        }
    }
}

#[test]
fn the_arm_warms_up() {
    let data = design(Shape::Payload).rows(&fixture::springy());
    let (first, last) = (&data.rows[0], &data.rows[71]);
    assert!(last.temperature.unwrap() - first.temperature.unwrap() > 12.0);
    assert!(data.rows.windows(2).all(|pair| pair[0].time < pair[1].time));
}

/// What is written is what is read, to the last bit.
#[test]
fn the_file_reads_back() {
    let arm = fixture::springy();
    let layout = Layout::new(arm.joints.iter().map(|j| j.motion));
    let only_dz = [false, false, true, false, true, false];
    let kinds =
        [POSE, Kind::Pose { orientation: false }, Kind::Displacement { components: only_dz }];
    for (k, kind) in kinds.into_iter().enumerate() {
        let mut design = Design { kind, ..design(Shape::ALL[k]) };
        design.repeats = 1;
        let plant = Plant::new(&arm, &[]).unwrap().with_first_order_sim();
        let noise = Noise { position: 3e-5, rotation: 1e-4 };
        let mut data = plant.measure(&design.rows(&arm), noise, 7).unwrap();
        let measured = kind.components().map(|is| f64::from(u8::from(is)));
        for (number, row) in data.rows.iter_mut().enumerate() {
            let sigma = Vector6::from(measured) * (1e-5 * (1.0 + number as f64));
            row.sigma = Some(Box::new(sigma));
        }
        let text = csv(&arm, &data, &["two\nlines".to_owned()]);
        assert!(text.starts_with("# two\n# lines\ntime[s],"), "{text}");
        let read = crate::Measurements::from_bytes("a.csv", text.as_bytes(), &layout).unwrap();
        assert_eq!((read.poses, read.kind), (12, kind));
        assert_eq!(read.sim_given, data.sim_given);
        for (read, written) in read.rows.iter().zip(&data.rows) {
            assert_eq!(Row { line: written.line, ..read.clone() }, *written);
        }
    }
}
