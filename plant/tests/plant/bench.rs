//! Instruments that are no trackers: sockets and plates, alone and together, against the plant's own formulas.

use nalgebra::{Isometry3, Point3, Unit, Vector3, Vector6};
use stiffarm_gap::gap::rms;
use stiffarm_gap::instrument::{Aim, Bench, Lens, Pair, Plane, Seen, View};
use stiffarm_gap::measurement::{Kind, Row};
use stiffarm_gap::predicted::predicted;
use stiffarm_gap::simulate::simulate;
use stiffarm_gap::whole::Whole;
use stiffarm_gap::{DiagnoseError, Diagnosis, Measurements, Options, diagnose, diagnose_with};
use stiffarm_kernels::generic::{Arm, Convention};
use stiffarm_plant::design::{Design, Shape};
use stiffarm_plant::{Frames, Noise, PlantError, csv};

use crate::arms::{
    EXACT, SOFT, arm, layout, loaded, plant, reading, row, rows, soft_joint_is_found, spatial,
    sprung,
};

const NOISE: Noise = Noise { position: 2e-5, rotation: 0.0 };
const SOCKETS: Kind = Kind::Bench { lengths: 3, angles: false };
const PLATES: Kind = Kind::Bench { lengths: 1, angles: false };

fn measured(arm: &Arm, kind: Kind, seed: u64) -> Measurements {
    let (shape, poses) = (Shape::Payload, 48);
    let design = Design { shape, poses, repeats: 1, payload: 20.0, kind, seed }.rows(arm);
    plant(arm, &[SOFT]).measure(&design, NOISE, seed).expect("rows")
}

/// The plant and the simulator have formulas of their own for what is read.
#[test]
fn plant_and_model_read_the_same() {
    let mut arm = sprung(Convention::Modified);
    // Before a camera that stands at the origin.
    arm.base = Isometry3::translation(0.1, -0.2, 6.0);
    let normal = Unit::new_normalize(Vector3::new(0.3, -0.2, 0.9));
    let lens = Lens::new([1210.0, 1190.0, 640.0, 355.0], &[-0.05, 0.02, 1e-3, -2e-3]);
    let q = [0.4, -0.7, 0.2, 0.9, -0.3];
    let target = (arm.pose(&q) * Point3::new(0.1, -0.2, 0.9)).coords;
    let views = [
        (Seen::Point, View::Point(Vector3::new(0.3, -0.2, 0.5))),
        (Seen::Plane, View::Plane(Plane::new(normal, 0.2))),
        (Seen::Distance, View::Distance { from: Vector3::new(0.3, -0.2, 0.5), offset: 0.1 }),
        (Seen::Direction, View::Direction { along: *normal, offset: 0.1 }),
        (Seen::Level, View::Level([0.01, -0.02])),
        (Seen::Camera, View::Camera { lens, target: None }),
        (Seen::Camera, View::Camera { lens, target: Some(target) }),
    ];
    for (seen, view) in views {
        let mut row = reading(&q, [30.0, -20.0, -90.0, 1.0, 2.0, 3.0]);
        row.offset = Some([0.0, 0.1, 0.02]);
        row.aim = Some(Box::new(Aim::known(seen, "", view)));
        let kind = Kind::Bench { lengths: 3, angles: true };
        let model = simulate(&arm, &row, kind).expect("at rest").reading().vector();
        let told = plant(&arm, &[]).measure(&rows(kind, vec![row]), EXACT, 0).expect("rows");
        let apart = (told.rows[0].measured - model).amax();
        assert!(apart < 1e-11 && model.amax() > 1e-3, "{seen:?}: {apart:e}");
    }
}

/// As a file has it: nothing is measured but joints, and the arm's ball sits in its socket.
#[test]
fn sockets_show_a_soft_joint() {
    let arm = loaded(Convention::Standard);
    let data = plant(&arm, &[SOFT]).seated(&measured(&arm, SOCKETS, 3)).expect("seated");
    let text = csv(&arm, &data, &[]);
    let header = text.lines().find(|line| line.contains("q1")).expect("a header");
    assert!(header.contains("point") && !header.contains("x[m]"), "{header}");
    let read = Measurements::from_bytes("s.csv", text.as_bytes(), &layout(&arm, Bench::NONE));
    let read = read.expect("a file");
    assert!(read.rows.iter().all(|row| row.measured == Vector6::zeros()));
    let found = diagnose(&arm, &read, &Options::default()).expect("a diagnosis");
    soft_joint_is_found(&found);
    let left = found.gap.after.position_rms / (NOISE.position * 3.0_f64.sqrt());
    assert!((0.7..1.3).contains(&left), "{left}");
    assert_eq!(found.bench.len(), 6);
    for (thing, aim) in found.bench.iter().zip(data.rows.iter().step_by(3)) {
        let was = aim.aim.as_ref().and_then(|aim| aim.view.place()).expect("a place");
        for (constant, was) in thing.constants.iter().zip(was.iter()) {
            let [low, high] = constant.ci95;
            // Twice as wide: of 18 intervals of 95 % one is missed by chance.
            let half = high - low;
            assert!((constant.value - was).abs() < half, "{thing:?} {was}");
        }
    }
}

/// Two links that are all but stretched out: by an inward play the elbow bends, an outward one no joint follows, and a
/// socket beyond reach holds no ball.
#[test]
fn a_stretched_arm_is_seated_as_far_as_it_reaches() {
    let arm = arm(Convention::Standard, vec![row(0.0, 0.0, 0.5, 0.0), row(0.0, 0.0, 0.4, 0.0)]);
    let seated = |far: f64, play: f64| {
        let place = Vector3::new(far, 0.0, 0.0);
        let mut row = reading(&[0.0, 1e-3], [0.0; 6]);
        row.aim = Some(Box::new(Aim::known(Seen::Point, "", View::Point(place))));
        let mut data =
            plant(&arm, &[]).measure(&rows(SOCKETS, vec![row]), EXACT, 0).expect("a row");
        data.rows[0].measured += Vector6::new(play, 0.0, 1e-5, 0.0, 0.0, 0.0);
        plant(&arm, &[]).seated(&data).map(|data| {
            let pose = arm.pose(&data.rows[0].q);
            (data.rows[0].q[1].abs(), pose.translation.vector)
        })
    };
    let (elbow, ball) = seated(0.9 - 2e-4, 0.0).expect("within reach");
    assert!((ball - Vector3::new(0.9 - 2e-4, 0.0, 0.0)).norm() < 1e-8, "{ball}");
    // c² = a² + b² + 2ab cos q: 2e-4 of reach are a turn of 42 mrad.
    assert!((elbow - 0.042_43).abs() < 1e-4, "{elbow}");
    let (elbow, ball) = seated(0.9, -1e-4).expect("within the play");
    assert!(elbow < 1e-3 && (ball.x - 0.9).abs() < 1e-6, "{elbow} {ball}");
    let refused = seated(0.901, 0.0).expect_err("beyond reach");
    assert!(matches!(refused, PlantError::Unseated { line: 2, .. }), "{refused}");
}

#[test]
fn plates_show_a_soft_joint() {
    let arm = loaded(Convention::Standard);
    let data = measured(&arm, PLATES, 4);
    let mut unknown = data.clone();
    for aim in unknown.rows.iter_mut().filter_map(|row| row.aim.as_deref_mut()) {
        *aim = Aim::at(Seen::Plane, aim.name.clone());
    }
    let found = diagnose(&arm, &unknown, &Options::default()).expect("a diagnosis");
    soft_joint_is_found(&found);
    let left = found.gap.after.position_rms / NOISE.position;
    assert!((0.7..1.3).contains(&left), "{left}");
    let known = Bench::read("b.toml", &planes(&data)).expect("a bench");
    let text = csv(&arm, &data, &[]);
    let read = Measurements::from_bytes("p.csv", text.as_bytes(), &layout(&arm, known));
    let found = diagnose(&arm, &read.expect("a file"), &Options::default()).expect("a diagnosis");
    soft_joint_is_found(&found);
    assert!(found.bench.is_empty(), "{:?}", found.bench);
}

/// What sockets and plates say of the tool is what the plant's tool does: without the findings to a tenth, and with them as
/// far as they are uncertain. Of 20 campaigns, or four, whose errors have a number or two each, the mean square over what
/// was told is 1 to three standard deviations: ±0.95 of 20.
#[test]
fn the_error_at_the_tool_is_as_large_as_it_is_told() {
    let arm = loaded(Convention::Standard);
    let size = |one: &Measurements, other: &Measurements| {
        let both = one.rows.iter().zip(&other.rows);
        rms(&both.map(|(a, b)| (a.measured - b.measured).norm()).collect::<Vec<_>>())
    };
    let mut squares = Vec::new();
    for (kind, seen) in [(SOCKETS, Seen::Point), (PLATES, Seen::Plane)] {
        for seed in 20..stiffarm_draws::few_or_many(22, 30) {
            let mut data = measured(&arm, kind, seed);
            let kind = Kind::Pose { orientation: false };
            let mut poses = Measurements { kind, ..data.clone() };
            poses.rows.iter_mut().for_each(|row| row.aim = None);
            for aim in data.rows.iter_mut().filter_map(|row| row.aim.as_deref_mut()) {
                *aim = Aim::at(seen, aim.name.clone());
            }
            let found = diagnose_with(&arm, &data, &Options::default(), &|_| {}).expect("found");
            let told = found.diagnosis.gap.at_tool.expect("of a socket or a plate");
            let truth = plant(&arm, &[SOFT]).exact(&poses).expect("at rest");
            let known = found.explanation.found();
            let corrected = predicted(Whole { arm: &arm, known: &known }, &poses).expect("poses");
            let before = size(&truth, &predicted(&arm, &poses).expect("poses"));
            assert!((told.before / before - 1.0).abs() < 0.1, "{seen:?} {seed}: {told:?} {before}");
            squares.push((size(&truth, &corrected) / told.after).powi(2));
        }
    }
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    assert!((mean - 1.0).abs() < 4.25 / (squares.len() as f64).sqrt(), "{mean} {squares:?}");
}

/// The plates as a bench file says them.
fn planes(data: &Measurements) -> String {
    let mut names: Vec<&str> = Vec::new();
    let mut text = String::new();
    for aim in data.rows.iter().filter_map(|row| row.aim.as_deref()) {
        let View::Plane(plane) = aim.view else { continue };
        if !names.contains(&aim.name.as_str()) {
            names.push(&aim.name);
            let ([x, y, z], offset): ([f64; 3], _) = ((*plane.normal).into(), plane.offset());
            let name = &aim.name;
            text += &format!(
                "[[plane]]\nname = \"{name}\"\nnormal = [{x:?}, {y:?}, {z:?}]\noffset = \"{offset:?} m\"\n"
            );
        }
    }
    text
}

/// Hand-eye: with nothing else unknown, both frames to rounding.
#[test]
fn a_board_seen_by_a_camera_gives_both_frames() {
    let arm = spatial(Convention::Standard);
    let frames = Frames::unknown(3);
    let kind = Kind::Pose { orientation: true };
    let design =
        Design { shape: Shape::Payload, poses: 20, repeats: 1, payload: 0.0, kind, seed: 3 };
    let mut data = design.rows(&arm);
    for row in &mut data.rows {
        let board = frames.base * arm.pose(&row.q) * frames.tool;
        row.measured.fixed_rows_mut::<3>(0).copy_from(&board.translation.vector);
        row.measured.fixed_rows_mut::<3>(3).copy_from(&board.rotation.scaled_axis());
    }
    (data.by_camera, data.by_board) = (true, true);
    let found = diagnose(&arm, &data, &Options::default()).expect("a diagnosis");
    let [base, tool] = &found.nuisances[..] else { panic!("{:?}", found.nuisances) };
    let was = [frames.base * arm.base, arm.tool * frames.tool];
    for (is, was) in [base, tool].into_iter().zip(was) {
        let is = Isometry3::new(is.translation.into(), is.rotation.into());
        let off = (is.inverse() * was).to_homogeneous() - nalgebra::Matrix4::identity();
        assert!(off.amax() < 1e-9, "{off}");
    }
}

/// Rows of both kinds are one campaign, and each row has as many numbers as it reads.
#[test]
fn kinds_of_instruments_are_fitted_together() {
    let arm = loaded(Convention::Standard);
    let (sockets, plates) = (measured(&arm, SOCKETS, 5), measured(&arm, PLATES, 6));
    let mut all: Vec<Row> = sockets.rows.clone();
    all.extend(plates.rows.iter().map(|row| Row { group: row.group + 100, ..row.clone() }));
    let data = Measurements::new("both", SOCKETS, all);
    let text = csv(&arm, &plant(&arm, &[SOFT]).seated(&data).expect("seated"), &[]);
    let read = Measurements::from_bytes("both.csv", text.as_bytes(), &layout(&arm, Bench::NONE));
    let found = diagnose(&arm, &read.expect("a file"), &Options::default()).expect("a diagnosis");
    soft_joint_is_found(&found);
    // Half of the rows have three numbers, half of them one.
    let left = found.gap.after.position_rms / (NOISE.position * 2.0_f64.sqrt());
    assert!((0.7..1.3).contains(&left), "{left}");
}

/// Sockets alone do not see how large the arm is; two whose distance is known do.
#[test]
fn a_known_distance_between_sockets_tells_the_scale() {
    let arm = loaded(Convention::Standard);
    let mut plain = measured(&arm, SOCKETS, 7);
    for aim in plain.rows.iter_mut().filter_map(|row| row.aim.as_deref_mut()) {
        aim.view = Aim::at(Seen::Point, "").view;
    }
    let of = |data: &Measurements| {
        let options = Options { geometry: true, ..Options::default() };
        diagnose_with(&arm, data, &options, &|_| {}).expect("a diagnosis").diagnosis
    };
    let free = of(&plain);
    let apart = |d: &Diagnosis| {
        let at = |k: usize| Vector3::from_fn(|c, _| d.bench[k].constants[c].value);
        (at(0) - at(1)).norm()
    };
    let told = apart(&free) + 2e-3;
    let points = ["socket 7.1".to_owned(), "socket 7.2".to_owned()];
    let mut tied = plain.clone();
    tied.pairs.push(Pair { points, distance: told, sigma: 1e-5 });
    let tied = of(&tied);
    let left = (apart(&tied) - told).abs();
    assert!(left < 2e-4 && tied.pairs[0].fitted == apart(&tied), "{left:e} {:?}", tied.pairs);
}

/// Nothing but readings says where a thing is of which nobody knows it.
#[test]
fn a_plan_at_what_nobody_knows_is_refused() {
    let arm = loaded(Convention::Standard);
    let (shape, kind) = (Shape::Force, Kind::Distance);
    let mut plan = Design { shape, poses: 2, repeats: 1, payload: 10.0, kind, seed: 2 }.rows(&arm);
    plan.rows[3].aim = Some(Box::new(Aim::at(Seen::Distance, "")));
    let error = predicted(&arm, &plan).unwrap_err();
    assert!(matches!(error, DiagnoseError::NewPoint { .. }), "{error}");
    plan.rows[1].marker = Some("smr".to_owned());
    plan.rows[1].offset = None;
    let error = predicted(&arm, &plan).unwrap_err();
    assert!(matches!(error, DiagnoseError::NewMarker { .. }), "{error}");
}
