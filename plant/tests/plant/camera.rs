//! Cameras, inclinometers and gauges of unknown zero against the plant's own formulas.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Isometry3, Matrix4, Point3, Vector3};
use stiffarm_gap::instrument::{Aim, Bench, Lens, Seen, View};
use stiffarm_gap::measurement::{Kind, Row, Sight};
use stiffarm_gap::{Diagnosis, Measurements, Options, diagnose};
use stiffarm_kernels::generic::{Arm, Convention};
use stiffarm_plant::design::{Design, Shape};
use stiffarm_plant::{Frames, Noise, csv};

use crate::arms::{EXACT, SOFT, layout, loaded, plant, soft_joint_is_found, spatial};

/// A fifth of a pixel.
const NOISE: Noise = Noise { position: 0.0, rotation: 0.2 / 1200.0 };
const MATRIX: [f64; 4] = [1210.0, 1190.0, 640.0, 355.0];
const DISTORTION: [f64; 5] = [-0.05, 0.02, 1e-3, -2e-3, 0.0];

/// Corners of a board, m: they stand in two planes, as those of a box do, or in one.
fn corners(flat: bool) -> Vec<(String, Vector3<f64>)> {
    let at = |k: usize| {
        let (x, y) = ((k % 4) as f64, (k / 4) as f64);
        let z = if flat || k.is_multiple_of(2) { 0.0 } else { 0.05 };
        Vector3::new(0.06 * x, 0.06 * y, z)
    };
    (0..12).map(|k| (format!("c{k}"), at(k))).collect()
}

fn bench(on: &str, lens: &str, corners: &[(String, Vector3<f64>)]) -> String {
    let each =
        corners.iter().map(|(name, at)| format!("{name} = [{:?}, {:?}, {:?}]", at.x, at.y, at.z));
    let each: Vec<String> = each.collect();
    format!(
        "[[camera]]\nname = \"left\"\non = \"{on}\"\n{lens}\n[[board]]\nname = \"plate\"\ncorners = {{ {} }}\n",
        each.join(", ")
    )
}

fn lens(matrix: [f64; 4], distortion: &[f64], more: &str) -> String {
    let [fx, fy, cx, cy] = matrix;
    format!(
        "matrix = [[{fx}, 0, {cx}], [0, {fy}, {cy}], [0, 0, 1]]\ndistortion = {distortion:?}\n{more}"
    )
}

/// Every corner that the camera shows well at every posture of a design.
fn shown(
    arm: &Arm,
    shape: Shape,
    frames: &Frames,
    on_tool: bool,
    corners: &[(String, Vector3<f64>)],
) -> Measurements {
    let kind = Kind::Pose { orientation: true };
    let design = Design { shape, poses: 30, repeats: 1, payload: 20.0, kind, seed: 2 }.rows(arm);
    let lens = Lens::new(MATRIX, &DISTORTION);
    let mut rows = Vec::new();
    for row in &design.rows {
        let tool = frames.base * arm.pose(&row.q) * frames.tool;
        for (name, corner) in corners {
            let (before, target) = match on_tool {
                false => (tool * Point3::from(*corner), None),
                true => (tool.inverse() * Point3::from(*corner), Some(*corner)),
            };
            if before.z < 0.2 || before.xy().coords.norm() > 0.8 * before.z {
                continue;
            }
            let offset = if on_tool { [0.0; 3] } else { (*corner).into() };
            let view = View::Camera { lens, target };
            rows.push(Row {
                marker: Some(name.clone()),
                offset: Some(offset),
                camera: Some(Box::new(Sight {
                    camera: "left".to_owned(),
                    board: "plate".to_owned(),
                    ..Sight::default()
                })),
                aim: Some(Box::new(Aim::known(Seen::Camera, "left", view))),
                ..row.clone()
            });
        }
    }
    assert!(rows.len() > 300, "{}", rows.len());
    let kind = Kind::Bench { lengths: 0, angles: true };
    Measurements { by_camera: true, by_board: true, ..Measurements::new("shown", kind, rows) }
}

fn read(arm: &Arm, data: &Measurements, bench: &str) -> Measurements {
    let bench = Bench::read("b.toml", bench).expect("a bench");
    let text = csv(arm, data, &[]);
    Measurements::from_bytes("shown.csv", text.as_bytes(), &layout(arm, bench)).expect("a file")
}

#[track_caller]
fn is_found(d: &Diagnosis) {
    soft_joint_is_found(d);
    assert_eq!(&*d.gap.after.kinds["camera"].unit, "px");
    let left = d.gap.after.kinds["camera"].rms / (0.2 * 2.0_f64.sqrt());
    assert!((0.9..1.1).contains(&left), "{left}");
}

/// Beside the arm: the arm's frame in the camera's axes, all of its reach before the lens.
fn beside() -> Frames {
    let base = Isometry3::new(Vector3::new(0.1, 0.3, 6.0), Vector3::new(0.4, -1.1, 0.7));
    Frames { base, tool: Isometry3::identity() }
}

/// Corners that are placed on the tool by a board, which nobody knows.
fn mounted(data: &Measurements, board: &Isometry3<f64>) -> Measurements {
    let mut there = data.clone();
    for offset in there.rows.iter_mut().filter_map(|row| row.offset.as_mut()) {
        *offset = (board * Point3::from(*offset)).coords.into();
    }
    there
}

#[test]
fn a_camera_beside_the_arm_shows_a_soft_joint() {
    let (arm, corners) = (loaded(Convention::Standard), corners(true));
    let frames = beside();
    let design = shown(&arm, Shape::Payload, &frames, false, &corners);
    // Loads act at the tool, and not at the board.
    let board = Isometry3::new(Vector3::new(0.15, -0.12, 0.1), Vector3::new(0.2, -0.3, 0.5));
    let plant = plant(&arm, &[SOFT]).with_frames(frames);
    let data = plant.measure(&mounted(&design, &board), NOISE, 1).expect("rows");
    let known = read(&arm, &data, &bench("base", &lens(MATRIX, &DISTORTION, ""), &corners));
    let found = diagnose(&arm, &known, &Options::default()).expect("a diagnosis");
    is_found(&found);
    assert!(found.bench.is_empty());
    let tool = found.nuisances.iter().find(|frame| frame.name == "tool_frame").expect("a frame");
    let off = Vector3::from(tool.translation) - (arm.tool * board).translation.vector;
    assert!(off.norm() < 1e-3, "{off}");
    // A lens that is known roughly, or not at all, is found with everything else.
    let rough = [1150.0, 1150.0, 660.0, 340.0];
    let rough = lens(rough, &[0.0; 4], "fit = [\"matrix\", \"distortion\"]");
    for told in
        [&*rough, "fit = [\"distortion\"]"].into_iter().take(stiffarm_draws::few_or_many(1, 2))
    {
        let data = read(&arm, &data, &bench("base", told, &corners));
        let found = diagnose(&arm, &data, &Options::default()).expect("a diagnosis");
        is_found(&found);
        let [camera] = &found.bench[..] else { panic!("{:?}", found.bench) };
        assert!(camera.constants.len() >= MATRIX.len() + 4, "{camera:?}");
        for (constant, was) in camera.constants.iter().zip(MATRIX.iter().chain(&DISTORTION)) {
            let [low, high] = constant.ci95;
            // Twice as wide: of eight intervals of 95 % one may be missed by chance.
            assert!((constant.value - was).abs() < high - low, "{constant:?} {was}");
        }
    }
}

/// With nothing else unknown, both frames to rounding; a board in a plane and a box. So does a lens that is off by a scale
/// of 2 %, the camera turned about its sight or not.
#[test]
fn a_camera_on_the_tool_gives_both_frames_and_its_lens() {
    let arm = spatial(Convention::Standard);
    let first = Design {
        shape: Shape::Narrow,
        poses: 1,
        repeats: 1,
        payload: 0.0,
        kind: Kind::Pose { orientation: true },
        seed: 2,
    };
    let all = [(true, 0.0), (false, 0.0), (true, FRAC_PI_2), (false, FRAC_PI_2)];
    for (flat, turn) in all.into_iter().step_by(stiffarm_draws::few_or_many(3, 1)) {
        let about_sight = Isometry3::rotation(Vector3::new(0.0, 0.0, turn));
        let tool = Isometry3::new(Vector3::new(0.05, -0.02, 0.1), Vector3::new(0.2, -0.3, 0.5));
        let tool = tool * about_sight;
        let camera = arm.pose(&first.rows(&arm).rows[0].q) * tool;
        let board =
            camera * Isometry3::new(Vector3::new(-0.1, -0.05, 0.9), Vector3::new(0.2, 0.3, 1.0));
        let frames = Frames { base: board.inverse(), tool };
        let corners = corners(flat);
        let design = shown(&arm, Shape::Narrow, &frames, true, &corners);
        let measured = plant(&arm, &[]).with_frames(frames.clone());
        let measured = measured.measure(&design, EXACT, 0).expect("rows");
        let scaled = lens(MATRIX.map(|x| 1.02 * x), &DISTORTION, "fit = [\"matrix\"]");
        for (lens, near) in [(lens(MATRIX, &DISTORTION, ""), 1e-9), (scaled, 1e-7)] {
            let data = read(&arm, &measured, &bench("tool", &lens, &corners));
            let found = diagnose(&arm, &data, &Options::default()).expect("a diagnosis");
            assert!(found.mistaken.is_none(), "{:?}", found.mistaken);
            let [base, tool] = &found.nuisances[..] else { panic!("{:?}", found.nuisances) };
            let was = [frames.base * arm.base, arm.tool * frames.tool];
            for (is, was) in [base, tool].into_iter().zip(was) {
                let is = Isometry3::new(is.translation.into(), is.rotation.into());
                let off = (is.inverse() * was).to_homogeneous() - Matrix4::identity();
                assert!(off.amax() < near, "{flat} {turn} {off}");
            }
            for (constant, was) in found.bench.iter().flat_map(|b| &b.constants).zip(MATRIX) {
                assert!((constant.value - was).abs() < 1e-4, "{flat} {turn} {constant:?} {was}");
            }
        }
    }
}

/// Two boards in one file, whose corners have the same names: rows of both at each posture.
fn both(plate: &Measurements, other: &Measurements) -> Measurements {
    let named = other.rows.iter().cloned().map(|mut row| {
        row.camera.iter_mut().for_each(|sight| sight.board = "other".to_owned());
        row
    });
    let mut rows: Vec<Row> = plate.rows.iter().cloned().chain(named).collect();
    rows.sort_by_key(|row| row.line);
    Measurements { by_camera: true, by_board: true, ..Measurements::new("both", plate.kind, rows) }
}

#[track_caller]
fn are_frames(found: &Diagnosis, was: &[(&str, Option<&str>, Isometry3<f64>)]) {
    assert_eq!(found.nuisances.len(), was.len(), "{:?}", found.nuisances);
    for (is, (name, of, was)) in found.nuisances.iter().zip(was) {
        assert_eq!((&*is.name, is.session.as_deref()), (*name, *of));
        let is = Isometry3::new(is.translation.into(), is.rotation.into());
        let off = (is.inverse() * was).to_homogeneous() - Matrix4::identity();
        assert!(off.amax() < 1e-9, "{name} {of:?} {off}");
    }
}

/// Two boards on the tool before one camera, and a camera on the tool before two boards: of each a frame of its own.
#[test]
fn every_board_has_a_frame_of_its_own() {
    let (arm, corners) = (spatial(Convention::Standard), corners(true));
    let two = |on: &str| {
        let one = bench(on, &lens(MATRIX, &DISTORTION, ""), &corners);
        let (_, board) = one.split_once("[[board]]").expect("a board");
        format!("{one}[[board]]{}", board.replace("plate", "other"))
    };
    let apart = Isometry3::new(Vector3::new(0.2, -0.1, 0.15), Vector3::new(0.4, -0.5, 0.9));
    let known = |on: &str, design: &Measurements, frames: &Frames| {
        let plant = plant(&arm, &[]).with_frames(frames.clone());
        let data = plant.measure(design, EXACT, 0).expect("rows");
        let data = read(&arm, &data, &two(on));
        diagnose(&arm, &data, &Options::default()).expect("a diagnosis")
    };

    let frames = beside();
    let board = Isometry3::new(Vector3::new(0.15, -0.12, 0.1), Vector3::new(0.2, -0.3, 0.5));
    let seen = shown(&arm, Shape::Payload, &frames, false, &corners);
    let design = both(&mounted(&seen, &board), &mounted(&seen, &apart));
    let found = known("base", &design, &frames);
    let base = ("base_frame", None, frames.base * arm.base);
    let tool = |of, board| ("tool_frame", Some(of), arm.tool * board);
    are_frames(&found, &[base, tool("plate", board), tool("other", apart)]);

    let hand = Isometry3::new(Vector3::new(0.05, -0.02, 0.1), Vector3::new(0.2, -0.3, 0.5));
    let narrow = |poses| Design {
        shape: Shape::Narrow,
        poses,
        repeats: 1,
        payload: 0.0,
        kind: Kind::Pose { orientation: true },
        seed: 2,
    };
    let camera = arm.pose(&narrow(1).rows(&arm).rows[0].q) * hand;
    let board =
        camera * Isometry3::new(Vector3::new(-0.1, -0.05, 0.9), Vector3::new(0.2, 0.3, 1.0));
    let frames = Frames { base: board.inverse(), tool: hand };
    let there: Vec<_> = (corners.iter())
        .map(|(name, at)| (name.clone(), (apart * Point3::from(*at)).coords))
        .collect();
    let [plate, other] = [&corners, &there].map(|c| shown(&arm, Shape::Narrow, &frames, true, c));
    let found = known("tool", &both(&plate, &other), &frames);
    let base = |of, at: Isometry3<f64>| ("base_frame", Some(of), at * frames.base * arm.base);
    let tool = ("tool_frame", None, arm.tool * hand);
    are_frames(
        &found,
        &[base("plate", Isometry3::identity()), base("other", apart.inverse()), tool],
    );
}

/// A level on the flange and a gauge along a direction, with zeros that nobody knows.
#[test]
fn levels_and_gauges_have_zeros_of_their_own() {
    let arm = loaded(Convention::Standard);
    let kind = Kind::Pose { orientation: true };
    let design =
        Design { shape: Shape::Payload, poses: 60, repeats: 1, payload: 20.0, kind, seed: 5 }
            .rows(&arm);
    let zeros = [3e-3, -2e-3];
    let of = |(k, row): (usize, &Row)| {
        let along = Vector3::ith(k % 3, 1.0);
        let aim = match k % 2 {
            0 => Aim { view: View::Level(zeros), ..Aim::at(Seen::Level, "") },
            _ => {
                let view = View::Direction { along, offset: 0.7 };
                Aim { view, ..Aim::at(Seen::Direction, "dial") }
            }
        };
        Row { aim: Some(Box::new(aim)), ..row.clone() }
    };
    // Three rows of a pose follow each other with no, half and full load.
    let rows = design.rows.iter().enumerate().map(|(k, row)| of((k / 3, row))).collect();
    let kind = Kind::Bench { lengths: 1, angles: true };
    let design = Measurements::new("levels", kind, rows);
    let noise = Noise { position: 2e-5, rotation: 2e-5 };
    let data = plant(&arm, &[SOFT]).measure(&design, noise, 3).expect("rows");
    let data = read(&arm, &data, "");
    let found = diagnose(&arm, &data, &Options::default()).expect("a diagnosis");
    let [finding] = &found.findings[..] else { panic!("{:?}", found.findings) };
    assert_eq!((&*finding.effect, finding.place.as_str()), ("joint_compliance", "joint 2"));
    let told: Vec<_> = found.bench.iter().flat_map(|thing| &thing.constants).collect();
    assert_eq!(told.len(), 3, "{told:?}");
    for (constant, was) in told.into_iter().zip([zeros[0], zeros[1], 0.7]) {
        let [low, high] = constant.ci95;
        assert!((constant.value - was).abs() < high - low, "{constant:?} {was}");
    }
    let kinds: Vec<_> =
        found.gap.after.kinds.iter().map(|(name, kind)| (&**name, &*kind.unit)).collect();
    assert_eq!(kinds, [("direction", "m"), ("inclinometer", "rad")]);
}
