//! Other programs' tables, made into measurement files.

#[cfg(feature = "xlsx")]
mod workbook;

use nalgebra::{Rotation3, Vector3};
use stiffarm_io::{Map, ReadError};
use stiffarm_kernels::Motion;
use stiffarm_observe::measurement::{Kind, Layout, Measurements};
use stiffarm_observe::readings::*;

fn import_with(text: &str, map: &str) -> Result<Imported, ReadError> {
    let map = Map::read("map.toml", map)?;
    import(&Sheet::new("raw.csv", text.as_bytes().to_vec()), None, &map)
}

/// The rows that the measurement reader finds in what is written.
fn rows(text: &str, map: &str, joints: usize) -> Measurements {
    let imported = import_with(text, map).unwrap_or_else(|e| panic!("{e}"));
    let layout = Layout::new(vec![Motion::Revolute; joints]);
    let read = Measurements::from_bytes("out.csv", imported.csv.as_bytes(), &layout);
    read.unwrap_or_else(|e| panic!("{e}\n{}", imported.csv))
}

#[test]
fn a_controllers_table_needs_no_map() {
    let text = "Tracker export 7\n\nA1;A2;X (mm);Y_mm;Z/mm;A;B;C;Last [kg];Bediener\n\
                10,5;-20;1200,25;0;850;90;0;0;25;Anna\n\
                11;-21;1201;1;851;90;0;0;0;Anna\n";
    let data = rows(text, "", 2);
    let row = &data.rows[0];
    assert!((row.q[0] - 10.5_f64.to_radians()).abs() < 1e-15 && row.q[1] < 0.0);
    assert!((row.measured.fixed_rows::<3>(0) - Vector3::new(1.20025, 0.0, 0.85)).amax() < 1e-15);
    let quarter = Vector3::new(0.0, 0.0, core::f64::consts::FRAC_PI_2);
    assert!((row.measured.fixed_rows::<3>(3) - quarter).amax() < 1e-15);
    assert!((row.wrench[2] + 25.0 * 9.80665).abs() < 1e-12);
    assert_eq!(data.extra[0].name, "Bediener");
}

#[test]
fn every_convention_is_the_product_of_its_turns() {
    let about = |axis: Vector3<f64>, degrees: f64| Rotation3::new(axis * degrees.to_radians());
    let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
    let cases = [
        ("A,B,C", "", about(z, 30.0) * about(y, -40.0) * about(x, 50.0)),
        ("roll,pitch,yaw", "", about(z, 50.0) * about(y, -40.0) * about(x, 30.0)),
        ("W,P,R", "", about(z, 50.0) * about(y, -40.0) * about(x, 30.0)),
        ("A,B,C", "orientation = \"zyz\"", about(z, 30.0) * about(y, -40.0) * about(z, 50.0)),
        ("Rx,Ry,Rz", "orientation = \"rpy\"", about(z, 50.0) * about(y, -40.0) * about(x, 30.0)),
        ("Rx,Ry,Rz", "orientation = \"xyz\"", about(x, 30.0) * about(y, -40.0) * about(z, 50.0)),
        ("Rx,Ry,Rz", "orientation = \"zxy\"", about(z, 50.0) * about(x, 30.0) * about(y, -40.0)),
        ("Rx,Ry,Rz", "orientation = \"zxz\"", about(z, 30.0) * about(x, -40.0) * about(z, 50.0)),
        ("A,B,C", "orientation = \"xyz\"", about(x, 30.0) * about(y, -40.0) * about(z, 50.0)),
        ("A,B,C", "orientation = \"fixed_zyx\"", about(x, 50.0) * about(y, -40.0) * about(z, 30.0)),
    ];
    for (names, map, expected) in cases {
        let data = rows(&format!("J1,X,Y,Z,{names}\n0.1,1,2,3,30,-40,50\n"), map, 1);
        let found = data.rows[0].measured.fixed_rows::<3>(3).into_owned();
        assert!((found - expected.scaled_axis()).amax() < 1e-14, "{names} {map}");
    }
    // A comment of the file says the same, and the map comes before it.
    let text = "# orientation = xyz\nJ1,X,Y,Z,Rx,Ry,Rz\n0.1,1,2,3,30,-40,50\n";
    for (map, expected) in [
        ("", about(x, 30.0) * about(y, -40.0) * about(z, 50.0)),
        ("orientation = \"zyx\"", about(z, 50.0) * about(y, -40.0) * about(x, 30.0)),
    ] {
        let found = rows(text, map, 1).rows[0].measured.fixed_rows::<3>(3).into_owned();
        assert!((found - expected.scaled_axis()).amax() < 1e-14, "{map}");
    }
    let said = import_with("J1,X,Y,Z,Rx [deg],Ry [deg],Rz [deg]\n0.1,1,2,3,3,4,5\n", "").unwrap();
    assert!(said.said.iter().any(|s| s.contains("which is seldom in degrees")), "{:?}", said.said);
    let half = Rotation3::new(Vector3::new(0.3, -0.2, 0.5));
    let entries = half.matrix().transpose();
    let entries: Vec<String> = entries.iter().map(|x| format!("{x:.17}")).collect();
    let names = "r11,r12,r13,r21,r22,r23,r31,r32,r33";
    let text = format!("J1,X,Y,Z,{names}\n0.1,1,2,3,{}\n", entries.join(","));
    let found = rows(&text, "", 1).rows[0].measured.fixed_rows::<3>(3).into_owned();
    assert!((found - half.scaled_axis()).amax() < 1e-14);
    let text = format!("J1,X,Y,Z,{names}\n0.1,1,2,3,1,1,1,1,1,1,1,1,1\n");
    let error = import_with(&text, "").unwrap_err().to_string();
    assert!(error.contains("line 2, column 5 `r11`: found numbers of no rotation"), "{error}");
    let q = nalgebra::UnitQuaternion::from_rotation_matrix(&half);
    let numbers = [q.w, q.i, q.j, q.k].map(|n| (2.0 * n).to_string()).join(",");
    let data = rows(&format!("J1,X,Y,Z,qw,qx,qy,qz\n0.1,1,2,3,{numbers}\n"), "", 1);
    let found = data.rows[0].measured.fixed_rows::<3>(3).into_owned();
    assert!((found - half.scaled_axis()).amax() < 1e-14);
}

#[test]
fn what_the_map_says_is_not_guessed() {
    let map = "[columns]\nq1 = { column = \"Winkel\", unit = \"deg\", factor = -1, offset = 90 }\n\
               x = \"A1\"\ny = \"A2\"\nz = \"A3\"\n";
    let text = "Winkel\tA1\tA2\tA3\tq1\n30\t1\t2\t3\t7\n";
    let data = rows(text, map, 1);
    assert!((data.rows[0].q[0] - 60.0_f64.to_radians()).abs() < 1e-15);
    assert_eq!(data.kind, Kind::Pose { orientation: false });
    // Their q1 is not ours, and not lost.
    assert_eq!(
        (data.extra[0].name.as_str(), data.extra[0].values.clone()),
        ("raw_q1", Ok(vec![7.0]))
    );
}

#[test]
fn joints_counted_from_zero_and_units_below_the_names() {
    let text = "timestamp,actual_q_0,actual_q_1,X,Y,Z\ns,rad,rad,mm,mm,mm\n0,0.5,0.25,1,2,3\n";
    let data = rows(text, "", 2);
    let row = &data.rows[0];
    assert_eq!((row.q.as_slice(), row.measured[2], row.time), (&[0.5, 0.25][..], 0.003, Some(0.0)));
    let said = import_with("J1,X,Y,Z\n175,1200,3,4\n", "").unwrap();
    assert!(said.csv.starts_with("q1[deg],x[mm],y[mm],z[mm]\n175,1200"), "{}", said.csv);
    assert!(said.said.iter().any(|s| s.contains("taken for degrees")), "{:?}", said.said);
}

#[test]
fn what_is_wrong_is_said_with_its_place() {
    stiffarm_draws::golden::says(
        concat!(env!("CARGO_MANIFEST_DIR"), "/../../observe/src/readings/wrong.txt"),
        |text, map| import_with(text, map).map(|i| i.csv).expect_err(text).to_string(),
    );
    let told = match cfg!(feature = "xlsx") {
        true => "found a workbook that cannot be read",
        false => "found a workbook, expected text",
    };
    let error = import(&Sheet::new("a.xlsx", b"PK\x03\x04junk".to_vec()), None, &Map::default());
    assert!(error.unwrap_err().to_string().contains(told));
}

/// Everything that a measurement file holds has its synonyms, and what is nearly one is asked about.
#[test]
fn sessions_distances_precisions_and_loads_have_names() {
    let text = "J1;Abstand [mm];Anchor X [mm];AnchorY [mm];from_z [mm];Std [um];Sitzung;Payload\n\
                0,1;800,5;1;2;3;20;mon;5kg\n0,2;801;1;2;3;20;tue;none\n";
    let imported = import_with(text, "").unwrap();
    let header = imported.csv.lines().next().unwrap();
    let expected =
        "q1[rad],distance[mm],from_x[mm],from_y[mm],from_z[mm],sigma[um],session,payload";
    assert_eq!(header, expected);
    assert!(imported.csv.ends_with("0.2,801,1,2,3,20,tue,none\n"), "{}", imported.csv);
    let said = imported.said.join("\n");
    assert!(said.contains("`Payload` is payload: the names of [[payload]]"), "{said}");
    // A sigma without a unit is told as the lengths are; what nobody knows keeps its unit.
    let text = "J1,X [mm],sigma,sigma_y,std z [um],sim_x [mm],sesion,ycd_dy [in]\n\
                0.1,1,0.02,1e-5,20,2,a,3\n";
    let imported = import_with(text, "").unwrap();
    let header = imported.csv.lines().next().unwrap();
    let expected = "q1[rad],x[mm],sigma[mm],sigma_y[m],sigma_z[um],sim_x[mm],sesion,ycd_dy[in]";
    assert_eq!(header, expected);
    let said = imported.said.join("\n");
    assert!(said.contains("nothing is known of it; did you mean `session`?"), "{said}");
    // A map says the same.
    let map = "[columns]\nsession = \"Tag\"\npayload = \"Was\"\nfrom = \"Wo\"\ndistance = \"L\"\n";
    let imported = import_with("J1,J2,L,Wo,Tag,Was\n0.1,0.2,0.8,left,mon,plate\n", map).unwrap();
    let mut header: Vec<&str> = imported.csv.lines().next().unwrap().split(',').collect();
    header.sort_unstable();
    assert_eq!(header, ["distance[m]", "from", "payload", "q1[rad]", "q2[rad]", "session"]);
}

/// As measuring machines and spreadsheets write them: aligned columns, a German Windows, clock times.
#[test]
fn other_programs_encodings_and_columns_are_read() {
    let text = b"Pr\xfcfling 7\n\nAchse 1   Pos X   Pos Y  Pos Z  Nr  Zeit\ndeg  mm  mm  mm  -  s\n30,5  1200  0  1  7  0:01:02,5\n";
    let imported = import(&Sheet::new("a.txt", text.to_vec()), None, &Map::default()).unwrap();
    let mut lines = imported.csv.lines();
    assert_eq!(lines.next(), Some("q1[deg],x[mm],y[mm],z[mm],time[s],Nr"));
    assert_eq!(lines.next(), Some("30.5,1200,0,1,62.5,7"));
    let said = imported.said.join("\n");
    for sentence in ["read as Windows-1252", "`Prüfling 7`", "separated by spaces"] {
        assert!(said.contains(sentence), "no `{sentence}` in {said}");
    }
}

#[test]
fn thousands_are_grouped_where_a_comma_begins_the_decimals() {
    let text = "J1;X [mm];Y [mm];Z [mm]\n0,5;1.200,25;-1.000.100,5;3\n0,5;2;3;4\n";
    let csv = import_with(text, "").unwrap().csv;
    assert!(csv.contains("\n0.5,1200.25,-1000100.5,3\n"), "{csv}");
    // A point alone is a thousand where somebody says so, and else may be a decimal.
    let text = "J1;X [mm];Y [mm];Z [mm]\n0,5;1.200;2;3\n";
    let csv = import_with(text, "decimal = \",\"").unwrap().csv;
    assert!(csv.contains("\n0.5,1200,2,3\n"), "{csv}");
    assert!(import_with(text, "").unwrap_err().to_string().contains("say `decimal = \",\"`"));
    let text = "J1;X [mm];Y [mm];Z [mm]\n0,5;1.2;2;3\n";
    let error = import_with(text, "decimal = \",\"").unwrap_err().to_string();
    assert!(error.contains("found `1.2` where a comma begins the decimals"), "{error}");
}

#[test]
fn times_are_clocks_days_and_dates() {
    let times = |text: &str| {
        let imported = import_with(text, "").unwrap_or_else(|error| panic!("{error}"));
        let header = imported.csv.lines().next().unwrap().to_owned();
        let cells = imported.csv.lines().skip(1).map(|l| l.split(',').nth(1).unwrap().to_owned());
        (header, cells.collect::<Vec<_>>())
    };
    let (header, cells) = times("J1,Time\n1,11:59:58 PM\n2,0:00:01\n3,12:00:02 AM\n");
    assert_eq!(
        (header.as_str(), cells),
        ("q1[rad],time[s]", vec!["86398".into(), "86401".into(), "86402".into()])
    );
    let (_, cells) = times("J1,Date,Uhrzeit\n1,2001-09-09,01:46:40\n2,10.09.2001,01:46:40\n");
    assert_eq!(cells, ["1000000000", "1000086400"]);
    // A day that is alone has its time.
    let (_, cells) = times("J1,Datum\n1,2001-09-09 01:46:40\n2,2001-09-09 01:46:41\n");
    assert_eq!(cells, ["1000000000", "1000000001"]);
    // A spreadsheet's days: two rows a minute apart, and not 0.7 ms.
    let (header, cells) = times("J1,Time\n1,45985.5\n2,45985.500694\n3,45985.501389\n");
    assert_eq!((header.as_str(), cells[0].as_str()), ("q1[rad],time[d]", "45985.5"));
    assert_eq!(times("J1,Time\n1,45985\n2,46000\n").0, "q1[rad],time[s]");
    assert_eq!(times("J1,Time [min]\n1,2\n2,3\n").0, "q1[rad],time[min]");
}

#[test]
fn a_row_may_have_several_points() {
    let text = "J1,SMR1 X [mm],SMR1 Y [mm],SMR1 Z [mm],SMR2 X [mm],SMR2 Y [mm],SMR2 Z [mm],Nr\n\
                0.1,1,2,3,4,5,6,a\n0.2,7,8,9,,,,b\n";
    let imported = import_with(text, "").unwrap();
    assert_eq!(
        imported.csv,
        "q1[rad],x[mm],y[mm],z[mm],marker,Nr\n0.1,1,2,3,SMR1,a\n0.1,4,5,6,SMR2,a\n\
         0.2,7,8,9,SMR1,b\n"
    );
    let text = "J1;X1;Y1;Z1;X2;Y2;Z2\n0,1;1200;2;3;4;5;6\n";
    let imported = import_with(text, "").unwrap();
    assert!(
        imported.csv.starts_with("q1[rad],x[mm],y[mm],z[mm],marker\n0.1,1200,2,3,1\n"),
        "{}",
        imported.csv
    );
    // One point is none of several, and accelerations are no points.
    for text in ["J1,X,Y,Z,X1,Y1,Z1\n0.1,1,2,3,4,5,6\n", "J1,Ax,Ay,Az,Gx,Gy,Gz\n0.1,1,2,3,4,5,6\n"]
    {
        assert!(!import_with(text, "").unwrap().csv.contains("marker"), "{text}");
    }
}

#[test]
fn groups_stand_above_names_and_columns_are_ignored_or_said_apart() {
    let text = "Robot;;Soll;;;Ist;;;\nJ1;J2;X;Y;Z;X;Y;Z;Kommentar\ndeg;deg;mm;mm;mm;mm;mm;mm;-\n\
                1;2;3;4;5;6;7;8,5;gut\n";
    let imported = import_with(text, "ignore = [\"Kommentar\"]").unwrap();
    let mut lines = imported.csv.lines();
    assert_eq!(
        lines.next(),
        Some("q1[deg],q2[deg],x[mm],y[mm],z[mm],Soll X[mm],Soll Y[mm],Soll Z[mm]")
    );
    assert_eq!(lines.next(), Some("1,2,6,7,8.5,3,4,5"));
    assert!(imported.said.contains(&"Kommentar not kept".to_owned()), "{:?}", imported.said);
    let said = import_with("J1,X,Y,Z,Zange [kg],Nutzlast [kg]\n1,1,2,3,4,5\n", "").unwrap().said;
    let told = |text: &str| said.iter().any(|s| s.contains(text));
    assert!(
        told("`Zange [kg]` is kept as `Zange[kg]`: nothing uses it, and it is a mass"),
        "{said:?}"
    );
    assert!(told("`Nutzlast [kg]` is a mass at the tool origin"), "{said:?}");
    // A unit that nobody knows, of a column that nobody knows, is no mistake.
    let text = "J1,X,Y,Z,Speed\ndeg,mm,mm,mm,counts\n1,1,2,3,7\n";
    assert!(import_with(text, "").unwrap().csv.ends_with("Speed\n1,1,2,3,7\n"));
}

fn joined(text: &str, other: &str, by: &str) -> Result<Imported, ReadError> {
    let [ours, other] = [("tracker.csv", text), ("controller.csv", other)]
        .map(|(file, text)| Sheet::new(file, text.as_bytes().to_vec()));
    import(&ours, Some((&other, &By::from(by.to_owned()))), &Map::default())
}

#[test]
fn a_trackers_table_and_a_controllers_are_joined() {
    let tracker = "Nr;X;Y;Z\nP1;1,5;2;3\n;;;\nP3;4;5;6\n";
    let controller = "Nr,J1,X\nP3,0.3,9\nP2,0.2,9\nP1,0.1,9\n";
    let by = joined(tracker, controller, "Nr").unwrap();
    assert_eq!(by.csv, "q1[rad],x[m],y[m],z[m],Nr\n0.1,1.5,2,3,P1\n0.3,4,5,6,P3\n");
    assert!(by.said.iter().any(|s| s == "`X` of controller.csv is left out: tracker.csv has it"));
    let rows = joined("X,Y,Z\n1,2,3\n4,5,6\n", "J1;T\n0,1;7\n0,2;8\n", "row").unwrap();
    assert!(rows.csv.starts_with("q1[rad],x[m],y[m],z[m]"), "{}", rows.csv);
    assert!(rows.csv.contains("\n0.1,1,2,3"), "{}", rows.csv);
    // Between two samples the joint is between them; before the first it is nowhere.
    let log = "Time [ms],J1,Mode\n1000,0.1,a\n2000,0.3,b\n3000,0.5,c\n";
    let timed = joined("Time [s],X,Y,Z\n0.5,0,0,0\n1.25,1,2,3\n2,4,5,6\n", log, "time").unwrap();
    assert!(timed.csv.contains("\n0.15,1.25,1,2,3,a\n0.3,2,4,5,6,b\n"), "{}", timed.csv);
    assert!(timed.said.iter().any(|s| s == "left out: 1 row of tracker.csv, which meets none"));
    let assumed = "both clocks are taken to agree: tracker.csv has the times 0.500 to 2.000 s, controller.csv those from \
                   1.000 to 3.000 s";
    assert!(timed.said.iter().any(|s| s.starts_with(assumed)), "{:?}", timed.said);
    // A controller that is half a second behind, and one that is ahead.
    let ours = "Time [s],X,Y,Z\n1.75,1,2,3\n";
    let later = joined(ours, log, "time+0.5").unwrap();
    assert!(later.csv.contains("\n0.15,1.75,1,2,3,a\n"), "{}", later.csv);
    let earlier = joined(ours, log, "time-0.25s").unwrap();
    assert!(earlier.csv.contains("\n0.3,1.75,1,2,3,b\n"), "{}", earlier.csv);
    let error = joined("Time,X\n90,1\n", log, "time").unwrap_err().to_string();
    assert!(
        error.contains("has the times 90.000 to 90.000 s") && error.contains("ahead"),
        "{error}"
    );
    for (ours, other, by, message) in [
        (
            "X,Y\n1,2\n3,4\n",
            "J1,J2\n1,2\n",
            "row",
            "tracker.csv: found 2 rows, expected 1 as in controller.csv",
        ),
        (
            "X,Y\n1,2\n3,4\n",
            "J1,J2\n1,2\n",
            "Nr",
            "tracker.csv: line 1: found no column `Nr`, expected it in both",
        ),
        (
            "Nr,X\n1,2\n",
            "Nr,J1\n1,2\n1,3\n",
            "Nr",
            "controller.csv: line 3, column 1 `Nr`: found `1` again",
        ),
        ("Nr,X\n1,2\n", "Nr,J1\n2,2\n", "Nr", "found no row that belongs to one of controller.csv"),
        (
            "time,X\n1,2\n",
            "time,J1\n2,2\n1,2\n",
            "time",
            "controller.csv: line 3, column 1 `time`: found a time before",
        ),
    ] {
        let error = joined(ours, other, by).unwrap_err().to_string();
        assert!(error.contains(message), "no `{message}` in `{error}`");
    }
}
