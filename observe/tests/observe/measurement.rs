//! Measurement files: every column of the format, and what is said of what is wrong.

use std::path::Path;

use nalgebra::{Isometry3, Vector3, Vector6};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Joint};
use stiffarm_observe::instrument::{Bench, Seen, View};
use stiffarm_observe::measurement::*;

fn body(name: &str, mass: f64, com: [f64; 3]) -> Body {
    Body { name: name.to_owned(), mass, com: com.into() }
}

/// Turns about z twice, then slides along it; the base of the file is turned about x.
fn carrier() -> Arm {
    let quarter = core::f64::consts::FRAC_PI_2;
    let joint = |a, motion| Joint { a, motion, ..Joint::default() };
    Arm {
        joints: vec![
            joint(0.3, Motion::Revolute),
            joint(0.0, Motion::Revolute),
            joint(0.0, Motion::Prismatic),
        ],
        base: Isometry3::rotation(Vector3::x() * quarter),
        tool: Isometry3::rotation(Vector3::y() * quarter),
        gravity: Vector3::new(0.0, 0.0, -9.80665),
        ..Arm::default()
    }
}

/// Two revolute joints, a prismatic one, two markers, two payloads.
fn layout() -> Layout {
    let marker = |name: &str, translation| Marker { name: name.to_owned(), translation };
    Layout {
        markers: vec![marker("smr1", Some([0.0, 0.1, 0.02])), marker("smr2", None)],
        payloads: Some(Payloads {
            bodies: vec![body("5kg", 5.0, [0.0, 0.0, 0.06]), body("ball", 0.5, [0.01, 0.0, 0.0])],
            arm: carrier(),
        }),
        ..Layout::new([Motion::Revolute, Motion::Revolute, Motion::Prismatic])
    }
}

fn read(text: &str) -> Result<Measurements, ReadError> {
    Measurements::from_bytes("run.csv", text.as_bytes(), &layout())
}

/// The same beside a file of the bench.
fn known(bench: &str, text: &str) -> Result<Measurements, ReadError> {
    let layout = Layout { bench: Bench::read("bench.toml", bench)?, ..layout() };
    Measurements::from_bytes("run.csv", text.as_bytes(), &layout)
}

fn good(text: &str) -> Measurements {
    read(text).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn every_column_of_the_format_is_read_in_si() {
    let data = good(
        "# a comment, with a comma\n\
         time[s],q1[deg],q2[mrad],q3[mm],fx[N],fy[kN],fz[lbf],mx[Nm],my[Nmm],mz,s1,s2,s3,\
         temperature[K],pose,marker,x[m],y[mm],z[um],rx[deg],ry,rz[mrad],sim_x[in],sim_z,note\n\
         1.5,180,250,20,1,2,3,4,5000,6,-1,0,+1,293.15,A 7,smr1,1,2000,3000000,90,0.5,100,10,9,hi\n",
    );
    let row = &data.rows[0];
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
    assert_eq!((row.line, row.group, data.poses), (3, 0, 1));
    near(row.q[0], core::f64::consts::PI);
    near(row.q[1], 0.25);
    near(row.q[2], 0.02);
    assert_eq!(row.wrench, Vector6::new(1.0, 2000.0, 3.0 * 4.4482216152605, 4.0, 5.0, 6.0));
    assert_eq!(row.direction, Some(vec![-1, 0, 1]));
    near(row.temperature.unwrap(), 20.0);
    near(row.time.unwrap(), 1.5);
    assert_eq!((row.pose.as_deref(), row.marker.as_deref()), (Some("A 7"), Some("smr1")));
    assert_eq!(row.offset, Some([0.0, 0.1, 0.02]));
    let want = Vector6::new(1.0, 2.0, 3.0, core::f64::consts::FRAC_PI_2, 0.5, 0.1);
    assert!((row.measured - want).amax() < 1e-12);
    assert_eq!(**row.sim.as_ref().unwrap(), Vector6::new(0.254, 0.0, 9.0, 0.0, 0.0, 0.0));
    assert_eq!(data.sim_given, [true, false, true, false, false, false]);
    assert_eq!(data.kind, Kind::Pose { orientation: true });
    assert_eq!(data.components(), 6);
    assert_eq!(
        (data.extra[0].name.as_str(), &data.extra[0].values),
        ("note", &Err((3, "hi".to_owned())))
    );
}

/// By hand: the tool's z lies along x turned by θ1 + θ2 about z, whatever the base in the world.
#[test]
fn a_payload_pulls_where_it_hangs() {
    let text = "payload,q1[deg],q2[deg],q3,fz,dz\n\
                5kg,30,60,0.2,0,1\nnone,30,60,0.2,-7,1\nball,0,0,0,0,1\n";
    let data = good(text);
    let weight = 5.0 * 9.80665;
    let near = |row: &Row, want: [f64; 6]| {
        assert!((row.wrench - Vector6::from(want)).amax() < 1e-12, "{}", row.wrench);
    };
    // The centre of mass is 6 cm along y of the base: y × −z is −x.
    near(&data.rows[0], [0.0, 0.0, -weight, -0.06 * weight, 0.0, 0.0]);
    near(&data.rows[1], [0.0, 0.0, -7.0, 0.0, 0.0, 0.0]);
    // Its x is −z of the base, the weight's own line.
    near(&data.rows[2], [0.0, 0.0, -0.5 * 9.80665, 0.0, 0.0, 0.0]);
    let names: Vec<_> =
        data.rows.iter().map(|r| r.payload.as_ref().unwrap().name.as_str()).collect();
    assert_eq!(names, ["5kg", "none", "ball"]);
    // Written, it is a name again, and no load beside it.
    let file = csv(&carrier(), &data, &[]);
    let again = good(&file);
    for (row, was) in again.rows.iter().zip(&data.rows) {
        assert!((row.wrench - was.wrench).amax() < 1e-12, "{file}");
    }
}

/// A turn of 90° about z, then one of 90° about the x that it has made: x → y, y → z, z → x.
#[test]
fn an_orientation_may_be_three_turns() {
    let angle = 2.0 * core::f64::consts::FRAC_PI_3 / 3f64.sqrt();
    let third = Vector6::new(1.0, 2.0, 3.0, angle, angle, angle);
    for (name, turns) in [
        ("zyx", "90,0,90"),
        ("abc", "90,0,90"),
        ("fixed_xyz", "90,0,90"),
        ("zxy", "90,0,90"),
        ("zxz", "90,90,0"),
        ("fixed_zxz", "0,90,90"),
    ] {
        let data = good(&format!(
            "# orientation = {name}\nq1,q2,q3,x,y,z,rx[deg],ry[deg],rz[deg]\n0,0,0,1,2,3,{turns}\n"
        ));
        let found = data.rows[0].measured;
        assert!((found - third).amax() < 1e-14, "{name} {found}");
    }
}

#[test]
fn distances_and_single_coordinates_are_measured() {
    let ball = good("q1,q2,q3,distance[mm],from_x,from_y,from_z[mm]\n0,0,0,300,1,2,3000\n");
    assert_eq!((ball.kind, ball.rows[0].measured[0]), (Kind::Distance, 0.3));
    let aim = |data: &Measurements| data.rows[0].aim.as_deref().cloned().expect("an aim");
    let place = Some(Vector3::new(1.0, 2.0, 3.0));
    assert_eq!((aim(&ball).view.place(), aim(&ball).free, ball.components()), (place, &[][..], 1));
    let wire = good("q1,q2,q3,distance,from,sim_distance\n0,0,0,0.3,socket 1,0.2\n");
    assert_eq!((aim(&wire).free.len(), wire.sim_given[0]), (3, true));
    assert_eq!(aim(&wire).name, "socket 1");
    let probe = good("q1,q2,q3,y[mm]\n0,0,0,5\n");
    assert_eq!(probe.kind, Kind::Coordinates { components: [false, true, false] });
    assert_eq!((probe.kind.measured(), probe.rows[0].measured[1]), (vec!["y"], 5e-3));
}

/// Each row of a bench has cells of its own kind.
#[test]
fn a_bench_is_read_row_by_row() {
    let text = "point,plane,distance[mm],from,along[um],nx,ny,nz,q1,q2,q3,sigma[um]\n\
        front:0,,,,,,,,0,0,0,100\n\
        ,table,0.5,,,,,,0,0,0,20\n\
        ,table,,,,,,,0,0,0,\n\
        ,,250,wire,,,,,0,0,0,50\n\
        ,,,,30,0,0.6,0.8,0,0,0,2\n";
    let data = good(text);
    assert_eq!(data.kind, Kind::Bench { lengths: 3, angles: false });
    let aim = |row: usize| data.rows[row].aim.as_deref().expect("an aim");
    let seen: Vec<_> = (0..5).map(|row| aim(row).seen).collect();
    assert_eq!(seen, [Seen::Point, Seen::Plane, Seen::Plane, Seen::Distance, Seen::Direction]);
    let numbers: usize = data
        .rows
        .iter()
        .map(|row| row.components(data.kind).into_iter().filter(|is| *is).count())
        .sum();
    assert_eq!(numbers, 3 + 4);
    let read = [0.0, 0.5e-3, 0.0, 0.25, 30.0 * 1e-6];
    assert!(data.rows.iter().zip(read).all(|(row, read)| row.measured[0] == read));
    assert_eq!(aim(4).view, View::Direction { along: Vector3::new(0.0, 0.6, 0.8), offset: 0.0 });
    assert_eq!((data.rows[2].sigma.as_ref(), aim(3).name.as_str()), (None, "wire"));
}

#[test]
fn a_bench_file_says_what_is_known() {
    let bench = "[[point]]\nname = \"a\"\nat = [1, \"20 mm\", 0]\n\
        [[pair]]\npoints = [\"a\", \"b\"]\ndistance = \"50 mm\"\nsigma = \"0.1 mm\"\n\
        [[plane]]\nname = \"table\"\nnormal = [0, 0, 2]\nsigma = \"20 um\"\n\
        [[centre]]\nname = \"wire\"\n";
    let text = "point,plane,distance,from,q1,q2,q3\na,,,,0,0,0\nb,,,,0,0,0\n,table,,,0,0,0\n,,1,wire,0,0,0\n";
    let data = known(bench, text).expect("a bench");
    let aim = |row: usize| data.rows[row].aim.as_deref().expect("an aim");
    assert_eq!(aim(0).view, View::Point(Vector3::new(1.0, 0.02, 0.0)));
    let free: Vec<usize> = (0..4).map(|row| aim(row).free.len()).collect();
    // A plane of which the normal is known has its height free; a wire has an unknown length beyond its place.
    assert_eq!(free, [0, 3, 1, 4]);
    assert_eq!(data.rows[2].sigma.as_ref().map(|sigma| sigma[0]), Some(20.0 * 1e-6));
    assert_eq!((data.pairs[0].distance, data.pairs[0].sigma), (0.05, 0.1 * 1e-3));
}

/// A board's pose by a quaternion is the one by its vector; of a camera on the tool it is the camera's in the
/// board's axes.
#[test]
fn a_camera_tells_where_a_board_is() {
    let by_vector =
        good("camera,board,q1,q2,q3,cx[mm],cy,cz,crx[deg],cry,crz\nl,b,0,0,0,100,0.2,0.3,90,0,0\n");
    let half = 0.5_f64.sqrt();
    let text = format!(
        "camera,board,q1,q2,q3,cx,cy,cz,cqw,cqx,cqy,cqz\nl,b,0,0,0,0.1,0.2,0.3,{half},{half},0,0\n"
    );
    let by_quaternion = good(&text);
    assert_eq!(by_vector.kind, Kind::Pose { orientation: true });
    assert!(by_vector.by_camera && by_quaternion.by_camera);
    assert!((by_vector.rows[0].measured - by_quaternion.rows[0].measured).amax() < 1e-15);
    let bench = "[[camera]]\nname = \"l\"\non = \"tool\"\n";
    let carried = known(bench, &text).expect("a file");
    // Back by a quarter about x: (x, y, z) is seen at (−x, −z, y).
    let seen = Vector6::new(-0.1, -0.3, 0.2, -core::f64::consts::FRAC_PI_2, 0.0, 0.0);
    assert!((carried.rows[0].measured - seen).amax() < 1e-15, "{}", carried.rows[0].measured);
}

#[test]
fn absent_columns_are_zero_or_none() {
    let data = good("dz,q3,q2,q1\n-1e-3,3,2,1\n");
    let row = &data.rows[0];
    assert_eq!((row.q.as_slice(), row.wrench), (&[1.0, 2.0, 3.0][..], Vector6::zeros()));
    assert_eq!((&row.direction, row.temperature, row.time, &row.pose), (&None, None, None, &None));
    assert_eq!((&row.marker, row.offset, &row.sim), (&None, Some([0.0; 3]), &None));
    assert_eq!(data.kind.components(), [false, false, true, false, false, false]);
}

#[test]
fn a_unitless_number_is_si_and_never_guessed() {
    assert_eq!(good("q1,q2,q3,dz\n90,0,0,1\n").rows[0].q[0], 90.0);
}

#[test]
fn unknown_columns_are_kept_and_reported() {
    let data = good("q1,q2,q3,dz,ycd_dz[in],temprature[furlong],Q1\n0,0,0,1,-0.5,20,7\n");
    let [ycd, misspelt, upper] = &data.extra[..] else { panic!("{:?}", data.extra) };
    assert_eq!((ycd.unit.as_deref(), &ycd.values), (Some("in"), &Ok(vec![-0.5])));
    assert_eq!((ycd.column.number, ycd.suggestion.as_deref()), (5, None));
    assert_eq!(misspelt.suggestion.as_deref(), Some("temperature"));
    assert_eq!(upper.suggestion.as_deref(), Some("q1"));
}

#[test]
fn a_row_with_a_hole_is_left_out_and_told() {
    let mut text = "q1,q2,q3,dz,note\n".to_owned();
    (0..20).for_each(|k| text.push_str(&format!("0,0,0,{k},{k}\n")));
    let holed = text.replace(",3,3\n", ",,3\n").replace(",5,5\n", ",nan,5\n");
    let data = good(&holed);
    assert_eq!((data.rows.len(), data.rows[3].line), (18, 6));
    let notes = data.extra[0].values.as_ref().unwrap();
    assert_eq!((notes.len(), notes[3]), (18, 4.0));
    let told: Vec<_> =
        data.skipped.iter().map(|m| (m.line.unwrap(), m.fault.to_string())).collect();
    assert_eq!((told.len(), told[0].0, told[1].0), (2, 5, 7));
    assert!(told[0].1.starts_with("found an empty cell"), "{told:?}");
    // A third of 20 is more than one in ten; a word is no hole.
    let more = holed.replace(",8,8\n", ",,8\n");
    assert!(read(&more).unwrap_err().to_string().contains("line 10, column 4 `dz`"));
    assert!(read(&text.replace(",3,3\n", ",three,3\n")).is_err());
}

#[test]
fn a_hundred_thousand_columns_take_no_time_to_tell_apart() {
    let names: Vec<String> = (0..100_000).map(|k| format!("c{k}")).collect();
    let text = format!("q1,q2,q3,dz,{}\n", names.join(","));
    let error = read(&format!("{text}0,0,0,1\n")).unwrap_err();
    assert!(error.to_string().contains("expected 100004"), "{error}");
}

#[test]
fn a_simulated_component_that_is_not_measured_is_reported() {
    let data = good("q1,q2,q3,dz,sim_dx,sim_dz\n0,0,0,1,2,3\n");
    assert_eq!(data.unused, [Column { number: 5, header: "sim_dx".to_owned() }]);
}

#[test]
fn bom_crlf_quotes_and_missing_last_line_end() {
    let data = good("\u{feff}q1,q2,q3,dz,\"a, b\"\r\n0,0,0,1,\"x, y\"\r\n#\r\n1,0,0, 2 ,z");
    assert_eq!((data.rows.len(), data.rows[1].line, data.rows[1].measured[2]), (2, 4, 2.0));
    assert_eq!(data.extra[0].values, Err((2, "x, y".to_owned())));
}

#[test]
fn every_mistake_has_its_own_message() {
    stiffarm_draws::golden::says(
        concat!(env!("CARGO_MANIFEST_DIR"), "/../../observe/src/measurement/wrong.txt"),
        |text, bench| known(bench, text).expect_err(text).to_string(),
    );
    let bytes: [(&[u8], &str); 2] = [
        (b"q1,q2,q3,dz\n0,0,\xb0,1\n", "line 2, column 3: found byte 0xb0, expected"),
        (b"\xff\xfeq\x001\x00", "line 1: found a UTF-16 byte order mark, expected"),
    ];
    for (bytes, message) in bytes {
        let error = Measurements::from_bytes("run.csv", bytes, &layout()).unwrap_err();
        let told = format!("run.csv: {message} UTF-8 text: save the file as UTF-8");
        assert_eq!(error.to_string(), told);
    }
}

#[test]
fn standard_deviations_are_of_all_positions_or_of_each_component() {
    let text = "q1,q2,q3,sigma_dz[mm],dy,dz,drx,sigma[um]\n0,0,0,2,1,1,1,5\n";
    let data = read(text).unwrap();
    let sigma = data.rows[0].sigma.as_ref().unwrap();
    assert_eq!((sigma[1], sigma[2], sigma[3]), (5.0 * 1e-6, 2.0 * 1e-3, 0.0));
    assert!(data.unused.is_empty() && data.extra.is_empty());
    let turned = read("q1,q2,q3,drx,sigma,sigma_dry\n0,0,0,1,1,1\n").unwrap();
    assert_eq!(
        turned.unused.iter().map(|c| &c.header[..]).collect::<Vec<_>>(),
        ["sigma", "sigma_dry"]
    );
    let turned = read("q1,q2,q3,drx,sigma,sigma_drx[mrad]\n0,0,0,1,1,2\n").unwrap();
    assert_eq!(turned.rows[0].sigma.as_ref().unwrap()[3], 2.0 * 1e-3);
    assert_eq!(turned.unused[0].header, "sigma");
}

#[test]
fn a_robot_without_markers_says_so() {
    let layout = Layout { markers: Vec::new(), payloads: None, ..layout() };
    let text = b"q1,q2,q3,dz,marker\n0,0,0,1,a\n";
    let error = Measurements::from_bytes("run.csv", text, &layout).unwrap_err().to_string();
    assert!(error.contains("marker `a`, the robot file has no [[marker]]: name"), "{error}");
}

#[test]
fn all_mistakes_are_reported_in_the_order_of_the_file() {
    let error = read("q1[kg],q2,q3,dz,q9\n0,x,0,1,0\n1,2\n0,0,nan,,0\n").unwrap_err();
    let text = error.to_string();
    let places: Vec<_> =
        text.lines().map(|l| l.split(": ").nth(1).unwrap_or_default().to_owned()).collect();
    let want = [
        "line 1, column 1 `q1[kg]`",
        "line 1, column 5 `q9`",
        "line 2, column 2 `q2`",
        "line 3",
        "line 4, column 3 `q3`",
        "line 4, column 4 `dz`",
    ];
    assert_eq!(places, want, "{text}");
}

#[test]
fn a_file_that_is_not_there_is_named() {
    let error = Measurements::read(Path::new("no/such.csv"), &layout()).unwrap_err();
    let text = error.to_string();
    assert!(
        text.starts_with("no/such.csv: found no file") && text.ends_with("measurement file (CSV)"),
        "{text}"
    );
}

#[test]
fn more_than_memory_holds_is_refused() {
    let row = "0,0,0,1\n";
    let text = format!("q1,q2,q3,dz\n{}", row.repeat(MOST_ROWS + 1));
    let error = read(&text).unwrap_err().to_string();
    assert!(error.starts_with("run.csv: line 2000002: found more than 2000000 rows"), "{error}");
}
