//! Plans of postures at a bench: in its sockets, on its plate, before its cameras.

use nalgebra::{Point3, Vector6};
use stiffarm_gap::instrument::{Bench, View};
use stiffarm_study::dexterity::design::{Plan, Purpose, Station, design};

use crate::fixture::{kr240, springy};

fn plan(bench: Vec<Station>) -> Plan {
    let pull = |x: f64, y: f64, z: f64| Vector6::new(x, y, z, 0.0, 0.0, 0.0);
    Plan {
        bench,
        plates: Vec::new(),
        count: 8,
        purpose: Purpose::Diagnose,
        along: vec![],
        loads: vec![pull(0.0, 0.0, -1000.0), pull(1000.0, 0.0, 0.0), pull(0.0, -1000.0, 0.0)],
        noise_position: 3e-5,
        noise_rotation: None,
        seed: 1,
    }
}

/// Sockets and a plate: every posture is there and above the plate, and the plan says as much as its own covariance.
#[test]
fn postures_at_a_bench_are_where_it_is() {
    let arm = springy();
    let text = "[[point]]\nname = \"a\"\nat = [0.4, 0.1, 0.3]\n[[point]]\nname = \"b\"\nat = [0.1, 0.4, 0.2]\n\
                [[plane]]\nname = \"floor\"\nnormal = [0, 0, 1]\noffset = \"-0.6 m\"";
    let bench = Bench::read("b.toml", text).unwrap().places();
    let stations = bench.iter().cloned().map(Station::Thing).collect();
    let plates = bench.iter().filter_map(|aim| match aim.view {
        View::Plane(plane) => Some(plane),
        _ => None,
    });
    let plates = plates.collect();
    let plan = Plan { count: 9, plates, ..plan(stations) };
    let found = design(&arm, &plan, &|_| {}).unwrap();
    assert_eq!(found.tests.len(), 9);
    for test in &found.tests {
        let view = &bench[test.thing.unwrap()].view;
        assert!(view.read(&arm.pose(&test.q)).norm() < 1e-5, "{test:?}");
        assert!(arm.frames(&test.q)[1..arm.dof()].iter().all(|at| at.translation.z > -0.6));
    }
    assert!(found.expected.iter().any(|e| e.compliance.is_some()));
    let refused = design(&arm, &Plan { purpose: Purpose::Identify, ..plan }, &|_| {}).unwrap_err();
    assert!(refused.to_string().contains("bench"), "{refused}");
}

/// A board on the floor before a camera on the tool, and a board on the tool before a camera beside the arm: at every
/// posture all corners are in the picture, by a pinhole that stands here.
#[test]
fn postures_before_a_camera_show_the_board() {
    let arm = kr240([0.1, 0.0, 0.15]);
    let corners =
        "corners = { a = [0, 0, 0], b = [0.2, 0, 0], c = [0, 0.2, 0], d = [0.2, 0.2, 0] }";
    let lens = "matrix = [[1000, 0, 640], [0, 1000, 360], [0, 0, 1]]";
    let hand = format!(
        "[[camera]]\nname = \"hand\"\non = \"tool\"\n{lens}\nat = [0, 0.08, 0]\n\
         [[board]]\nname = \"floor\"\nat = [2.0, 0.3, 0.1]\nrotation = [\"180 deg\", 0, 0]\n{corners}"
    );
    let beside = format!(
        "[[camera]]\nname = \"left\"\n{lens}\nat = [2.0, 4.5, 1.5]\ntowards = [2.0, 0, 1.2]\nfit = [\"matrix\"]\n\
         [[board]]\nname = \"held\"\nat = [0, 0, 0.05]\n{corners}"
    );
    for (text, constants) in [(hand, 12), (beside, 16)] {
        let looks = Bench::read("b.toml", &text).unwrap().looks();
        let [look] = &looks[..] else { panic!("{looks:?}") };
        let station = Station::Board(look.clone());
        assert_eq!(station.constants(), constants);
        let plan = Plan { noise_rotation: Some(1e-4), ..plan(vec![station]) };
        let found = design(&arm, &plan, &|_| {}).unwrap();
        assert_eq!(found.tests.len(), 8);
        for test in &found.tests {
            let mut limits = test.q.iter().zip(&arm.joints);
            assert!(
                limits.all(|(q, joint)| joint.limits.is_some_and(|[a, b]| (a..=b).contains(q)))
            );
            let mounted = arm.pose(&test.q) * look.mounted;
            let (camera, board) = match look.is_on_tool {
                true => (mounted, look.beside),
                false => (look.beside, mounted),
            };
            for (_, corner) in &look.corners {
                let at = camera.inverse() * board * Point3::from(*corner);
                let [u, v] = [1000.0 * at.x / at.z + 640.0, 1000.0 * at.y / at.z + 360.0];
                let is_inside = (0.0..=1280.0).contains(&u) && (0.0..=720.0).contains(&v);
                assert!(at.z > 0.0 && is_inside, "{u} {v} {}", at.z);
            }
        }
        assert!(found.expected.iter().any(|e| e.zero.is_some()), "{:?}", found.expected);
    }
}
