//! `--bench`: postures planned for sockets, and a camera's pixels, from the plan or the simulation to the diagnosis.

use serde_json::Value;

use crate::support::{Folder, has, list, number, read, run, stiffarm};

const SOCKETS: &str = "
[[point]]
name = \"left\"
at = [0.35, 0.2, 0.2]
[[point]]
name = \"right\"
at = [\"350 mm\", \"-200 mm\", 0.25]
[[plane]]
name = \"table\"
normal = [0, 0, 1]
offset = \"-10 mm\"
";

const CAMERA: &str = "
[[camera]]
name = \"left\"
matrix = [[1210, 0, 640], [0, 1190, 355], [0, 0, 1]]
distortion = [-0.21, 0.07, 0.001, -0.002, 0.01]
[[board]]
name = \"charuco\"
corners = { c0 = [0, 0, 0], c1 = [\"90 mm\", 0, 0], c2 = [0, \"90 mm\", 0], c3 = [\"90 mm\", \"90 mm\", 0] }
";

#[test]
fn a_plan_at_sockets_is_measured_and_diagnosed() {
    let folder = Folder::new();
    let bench = folder.file("bench.toml", SOCKETS);
    let [plan, data] = ["plan.csv", "run.csv"].map(|name| folder.name(name));
    let postures = "poses irb120 --for diagnose --count 24";
    let screen = run(&format!("{postures} --bench {bench} --csv {plan}")).good();
    assert!(screen.contains("24 postures"), "{screen}");
    let written = read(&plan);
    has(&written, &["point,plane", ",left,", ",,table"]);
    let effect = "joint_offset@joint 3=3e-3";
    stiffarm(&["simulate", "irb120", &plan, "--bench", &bench, "--effect", effect, "--csv", &data])
        .good();
    let found = run(&format!("diagnose irb120 {data} --bench {bench} --json -")).json();
    let named = |finding: &Value| {
        let is = |one: &Value| one["effect"] == "joint_offset" && one["place"] == "joint 3";
        is(finding) || finding["alternatives"].as_array().is_some_and(|all| all.iter().any(is))
    };
    assert!(list(&found["findings"]).iter().any(named), "{found}");
}

#[test]
fn a_camera_finds_a_soft_joint_and_tells_it_in_pixels() {
    let folder = Folder::new();
    let (bench, data) = (folder.file("bench.toml", CAMERA), folder.name("run.csv"));
    let shown = "--measure camera --payload 3kg --noise-rotation 0.2px";
    let effect = "--effect 'joint_compliance@joint 2=8e-5'";
    run(&format!("simulate irb120 {shown} --csv {data} --bench {bench} {effect}")).good();
    let found = run(&format!("diagnose irb120 {data} --bench {bench} --json -")).json();
    let [finding] = list(&found["findings"]) else { panic!("{found}") };
    assert!(finding["effect"] == "joint_compliance" && finding["place"] == "joint 2", "{finding}");
    let [low, high] = [0, 1].map(|k| number(&finding["parameters"][0]["ci95"][k]));
    assert!(low < 8e-5 && 8e-5 < high, "{low} {high}");
    let left = &found["gap"]["after"]["kinds"]["camera"];
    let rms = number(&left["rms"]);
    assert!(left["unit"] == "px" && (0.25..0.32).contains(&rms), "{left}");
    let screen = run(&format!("diagnose irb120 {data} --bench {bench}")).good();
    assert!(screen.contains("px rms") && screen.contains("Error in the picture"), "{screen}");
    let told = run(&format!("diagnose irb120 {data}")).refused();
    assert!(told.contains("the unknown marker `c0`"), "{told}");
    // Without its matrix and distortion the lens is found, too.
    let lens = CAMERA.lines().filter(|line| !line.starts_with("matrix"));
    let lens: Vec<&str> = lens
        .map(|l| if l.starts_with("distortion") { "fit = [\"distortion\"]" } else { l })
        .collect();
    let unknown = folder.file("unknown.toml", lens.join("\n"));
    let found = run(&format!("diagnose irb120 {data} --bench {unknown} --json -")).json();
    assert_eq!(list(&found["findings"]).len(), 1, "{found}");
    let constants = list(&found["bench"][0]["constants"]);
    for (constant, (name, was)) in
        constants.iter().zip([("fx", 1210.0), ("fy", 1190.0), ("cx", 640.0), ("cy", 355.0)])
    {
        let [low, high] = [0, 1].map(|k| number(&constant["ci95"][k]));
        // Twice as wide: of four intervals of 95 % one may be missed by chance.
        let off = number(&constant["value"]) - was;
        assert!(constant["name"] == name && off.abs() < high - low, "{constant}");
    }
    let screen = run(&format!("diagnose irb120 {data} --bench {unknown}")).good();
    assert!(screen.contains("camera left: fx 12") && screen.contains(" px, fy 1"), "{screen}");
}

/// What each kind of instrument reads of an arm comes back as the zero that was put in, and what the same kind reads of it
/// elsewhere is predicted: by the diagnosis, and by the diagnosis as it was written.
#[test]
fn every_kind_is_simulated_diagnosed_and_predicted() {
    let folder = Folder::new();
    let bench = folder.file("bench.toml", CAMERA);
    let [data, other, saved] = ["run.csv", "other.csv", "found.json"].map(|name| folder.name(name));
    let told = [
        ("point", "points"),
        ("plane", "planes"),
        ("wire", "distance"),
        ("along", "directions"),
        ("tilt", "inclinometers"),
        ("camera --noise-rotation 0.2px", "cameras"),
        ("board", "x y z rx ry rz"),
    ];
    for (kind, subject) in told.into_iter().step_by(stiffarm_draws::few_or_many(3, 1)) {
        let how = format!("--measure {kind} --poses 60 --payload 3kg --bench {bench}");
        let effect = "--effect 'joint_offset@joint 3=4e-3'";
        run(&format!("simulate irb120 {how} --csv {data} {effect}")).good();
        run(&format!("simulate irb120 {how} --csv {other} {effect} --seed 1")).good();
        let found =
            run(&format!("diagnose irb120 {data} --bench {bench} --check {other} --json -")).json();
        std::fs::write(&saved, found.to_string()).unwrap();
        assert!(found["mistaken"].is_null(), "{kind}: {}", found["mistaken"]);
        let [before, after] = ["before", "after"].map(|when| &found["check"][when]);
        let size = |of: &Value| number(&of["position_rms"]).hypot(number(&of["rotation_rms"]));
        assert!(size(after) < 0.5 * size(before), "{kind}: {}", found["check"]);
        let again = run(&format!("predict {saved} {other} --bench {bench} --json -")).json();
        assert_eq!(again["inside"], found["check"]["inside"], "{kind}");
        // Where a camera and its board are is fitted anew: 12 numbers to 360 or more.
        let tolerance = if kind.starts_with("camera") || kind == "board" { 0.05 } else { 1e-6 };
        let off = (size(&again["gap"]) / size(after) - 1.0).abs();
        assert!(off < tolerance, "{kind}: {} {after}", again["gap"]);
        let is = |one: &Value| one["effect"] == "joint_offset" && one["place"] == "joint 3";
        let named =
            |f: &Value| is(f) || f["alternatives"].as_array().is_some_and(|all| all.iter().any(is));
        assert!(list(&found["findings"]).iter().any(named), "{kind}: {}", found["findings"]);
        let screen = run(&format!("diagnose irb120 {data} --bench {bench}")).good();
        assert!(screen.contains(&format!(" measurements of {subject} at ")), "{screen}");
        assert_eq!(screen.contains("At the tool"), kind != "board", "{screen}");
    }
}

/// Sockets and a camera's corners of one arm, in two files and in one.
#[test]
fn sockets_and_a_camera_are_one_diagnosis() {
    let folder = Folder::new();
    let (bench, one) = (folder.file("bench.toml", CAMERA), folder.name("one.csv"));
    let [sockets, corners] =
        ["point --poses 24", "camera --poses 12 --noise-rotation 0.2px"].map(|kind| {
            let (name, _) = kind.split_once(' ').expect("a kind");
            let data = folder.name(&format!("{name}.csv"));
            let how = format!("--measure {kind} --payload 3kg --bench {bench} --csv {data}");
            run(&format!("simulate irb120 {how} --effect 'joint_offset@joint 3=4e-3'")).good();
            data
        });
    let table = |path: &str| -> Vec<Vec<String>> {
        let text = read(path);
        let lines = text.lines().filter(|line| !line.starts_with('#'));
        lines.map(|line| line.split(',').map(str::to_owned).collect()).collect()
    };
    let both = [table(&sockets), table(&corners)];
    let mut names = both[0][0].clone();
    names.extend(both[1][0].iter().filter(|name| !both[0][0].contains(name)).cloned());
    // When each was measured says nothing where they stand in one file.
    names.retain(|name| !name.starts_with("time") && !name.starts_with("temperature"));
    let rows = both.iter().flat_map(|table| {
        let (head, names) = (&table[0], &names);
        table[1..].iter().map(move |row| {
            let at = |name: &String| head.iter().position(|own| own == name);
            let cell = |name| at(name).map_or("", |at| row[at].as_str());
            names.iter().map(cell).collect::<Vec<_>>().join(",")
        })
    });
    let rows: Vec<String> = std::iter::once(names.join(",")).chain(rows).collect();
    std::fs::write(&one, rows.join("\n")).expect("a file");
    let all = [format!("{sockets} {corners}"), format!("{corners} {sockets}"), one];
    for files in all.into_iter().step_by(stiffarm_draws::few_or_many(2, 1)) {
        let found = run(&format!("diagnose irb120 {files} --bench {bench} --json -")).json();
        let first = &list(&found["findings"])[0];
        assert_eq!(
            (&first["effect"], &first["place"]),
            (&"joint_offset".into(), &"joint 3".into())
        );
        let offset = &first["parameters"][0];
        let [low, high] = [0, 1].map(|k| number(&offset["ci95"][k]));
        assert!(low < 4e-3 && 4e-3 < high && high - low < 4e-4, "{files}: {offset}");
        // Lengths are judged over the rows that read them: 30 um in each of three coordinates, whose rms of 216 numbers
        // is known to 5 %.
        let gap = &found["gap"];
        for size in ["fitted", "noise"].map(|of| number(&gap[of]["position_rms"])) {
            assert!((size / 52e-6 - 1.0).abs() < 0.15, "{files}: {gap}");
        }
    }
    // Other sockets are placed by what was found, and the camera stands where it stood.
    for (other, expected) in [("point", " mm rms"), ("camera --noise-rotation 0.2px", " px rms")] {
        let data = folder.name("other.csv");
        let how = format!("--measure {other} --payload 3kg --bench {bench} --csv {data} --seed 1");
        run(&format!("simulate irb120 {how} --effect 'joint_offset@joint 3=4e-3'")).good();
        let files = format!("{sockets} {corners} --check {data}");
        let screen = run(&format!("diagnose irb120 {files} --bench {bench}")).good();
        let check = screen.lines().find(|line| line.starts_with("Check"));
        assert!(check.is_some_and(|line| line.contains(expected)), "{screen}");
    }
}

/// A camera on the tool over a board on the table: planned in view, simulated there, diagnosed.
#[test]
fn postures_in_view_are_planned_and_measured() {
    let folder = Folder::new();
    let there = CAMERA
        .replace("matrix", "on = \"tool\"\nat = [0, \"60 mm\", 0]\nmatrix")
        .replace("corners", "at = [0.35, 0, 0]\nrotation = [\"180 deg\", 0, 0]\ncorners");
    let bench = folder.file("bench.toml", &there);
    let [plan, data] = ["plan.csv", "run.csv"].map(|name| folder.name(name));
    let how = format!("--bench {bench} --noise-rotation 0.2px");
    let load = "--load 0,0,-30,0,0,0";
    run(&format!("poses irb120 --for diagnose --count 16 {load} {how} --csv {plan}")).good();
    let written = read(&plan);
    has(&written, &["camera,board,marker,u[px],v[px]", ",left,charuco,c3,,"]);
    assert_eq!(written.lines().filter(|line| !line.starts_with('#')).count(), 1 + 16 * 2 * 4);
    let effect = "--effect 'joint_compliance@joint 2=8e-5'";
    run(&format!("simulate irb120 {plan} {how} {effect} --csv {data}")).good();
    let table = read(&data);
    let head: Vec<&str> =
        table.lines().find(|l| l.contains("u[px]")).unwrap_or_default().split(',').collect();
    let at = |name: &str| head.iter().position(|head| *head == name).unwrap_or_default();
    for line in table.lines().filter(|line| line.contains("charuco")) {
        let cells: Vec<f64> = ["u[px]", "v[px]"]
            .map(|name| line.split(',').nth(at(name)).and_then(|c| c.parse().ok()).unwrap_or(-1e9))
            .to_vec();
        // Twice the principal point, and a few pixels for noise and what the load moves.
        assert!((-5.0..1285.0).contains(&cells[0]) && (-5.0..715.0).contains(&cells[1]), "{line}");
    }
    let found = run(&format!("diagnose irb120 {data} --bench {bench} --json -")).json();
    let is = |one: &Value| one["effect"] == "joint_compliance" && one["place"] == "joint 2";
    assert!(list(&found["findings"]).iter().any(is), "{found}");
    let nowhere = folder.file("nowhere.toml", CAMERA);
    let told = run(&format!("simulate irb120 {plan} --bench {nowhere}")).refused();
    assert!(told.contains("a bench that says roughly where both are"), "{told}");
}

/// Two cameras beside the arm before one board on the tool: each has the arm where it stands itself.
#[test]
fn two_cameras_beside_the_arm_are_simulated_together() {
    let folder = Folder::new();
    let camera = |name: &str, [x, y, z]: [f64; 3]| {
        let lens = "matrix = [[1210, 0, 640], [0, 1190, 355], [0, 0, 1]]";
        format!(
            "[[camera]]\nname = \"{name}\"\n{lens}\nat = [{x}, {y}, {z}]\ntowards = [0.3, 0, 0.5]\n"
        )
    };
    let at = [("left", [1.5, 0.9, 0.9]), ("right", [1.3, -1.1, 0.7])];
    let board = CAMERA.split_once("[[board]]").expect("a board").1;
    let cameras = at.map(|(name, at)| camera(name, at)).concat();
    let bench = folder.file("bench.toml", format!("{cameras}[[board]]\non = \"tool\"{board}"));
    let [plan, data] = ["plan.csv", "run.csv"].map(|name| folder.name(name));
    let load = "--load 0,0,-30,0,0,0";
    run(&format!("poses irb120 --for diagnose --count 30 {load} --bench {bench} --csv {plan}"))
        .good();
    let how = "--noise-rotation 0.1px --effect 'joint_compliance@joint 2=8e-5'";
    run(&format!("simulate irb120 {plan} --bench {bench} {how} --csv {data}")).good();
    let found = run(&format!("diagnose irb120 {data} --bench {bench} --json -")).json();
    let [finding] = list(&found["findings"]) else { panic!("{found}") };
    assert!(finding["effect"] == "joint_compliance" && finding["place"] == "joint 2", "{finding}");
    for (name, at) in at {
        let is = |frame: &&Value| frame["name"] == "base_frame" && frame["session"] == name;
        let base = list(&found["nuisances"]).iter().find(is).expect("a frame");
        let far = [0, 1, 2].map(|k| number(&base["translation"][k]));
        let [far, was] = [far, at].map(|p| p.iter().map(|x| x * x).sum::<f64>().sqrt());
        // A tenth of a pixel at 1.8 m is 0.15 mm in a corner of one picture.
        assert!((far - was).abs() < 1e-3, "{name}: {far} {was}");
    }
}

/// Joint values that a controller recorded in sockets, as tables of postures and as a log of an arm that is held there.
#[test]
fn recordings_in_sockets_become_measurements() {
    let folder = Folder::new();
    let data = folder.name("run.csv");
    run(&format!("simulate irb120 --measure point --poses 24 --payload 0kg --effect 'joint_offset@joint 3=4e-3' --csv {data}")).good();
    let text = read(&data);
    let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
    let column = |name: &str| lines[0].split(',').position(|head| head == name).expect("a column");
    let (point, joints) = (column("point"), column("q1[rad]"));
    let rows = |socket: &str| -> Vec<Vec<f64>> {
        let cells = lines[1..].iter().map(|line| line.split(',').collect::<Vec<_>>());
        let own = cells.filter(|cells| cells[point].ends_with(socket));
        let numbers = |cells: &[&str]| cells.iter().map(|c| c.parse().expect("a number")).collect();
        own.map(|cells| numbers(&cells[joints..joints + 6])).collect()
    };
    let mut names = Vec::new();
    for k in 0..6 {
        let line = |row: Vec<f64>| row.iter().map(f64::to_string).collect::<Vec<_>>().join(";");
        let table: Vec<String> = rows(&format!(".{}", k + 1)).into_iter().map(line).collect();
        let table = format!("J1;J2;J3;J4;J5;J6\n{}\n", table.join("\n"));
        names.push(folder.file(&format!("hole_{k}.csv"), &table));
    }
    let made = folder.name("sockets.csv");
    let all = names.join(" ");
    let set = "--quiet --set 'point=rack:{file}' --robot irb120";
    run(&format!("measurements {all} {set} --csv {made}")).good();
    has(&read(&made), &["q6[rad],point", ",rack:hole_0\n", ",rack:hole_5\n"]);
    let found = run(&format!("diagnose irb120 {made} --json -")).json();
    assert!(list(&found["findings"]).iter().any(|f| f["effect"] == "joint_offset"), "{found}");

    // Held for a second each, moved in between.
    let mut log = "t[s],q1[rad],q2[rad],q3[rad],q4[rad],q5[rad],q6[rad]\n".to_owned();
    // Each posture has three rows.
    let postures: Vec<_> = rows(".1").into_iter().step_by(3).collect();
    for (pair, at) in postures.windows(2).zip((0..).step_by(256)) {
        for step in 0..256 {
            let part = (f64::from(step) / 128.0 - 1.0).max(0.0);
            let q = pair[0].iter().zip(&pair[1]).map(|(a, b)| (a + part * (b - a)).to_string());
            let t = f64::from(at + step) / 128.0;
            log += &format!("{t},{}\n", q.collect::<Vec<_>>().join(","));
        }
    }
    let held = folder.file("held.csv", &log);
    run(&format!(
        "measurements {held} --quiet --still 0.8s --set point=one --robot irb120 --csv {made}"
    ))
    .good();
    let text = read(&made);
    assert_eq!(text.lines().count(), postures.len(), "{text}");
    crate::bag::gives_the_same(&folder, &log, &text);
    let told =
        run(&format!("measurements {held} --still 5s --set point=one --robot irb120")).refused();
    assert!(told.contains("no rest of 5 s"), "{told}");
    let told = run(&format!("measurements {all} --set pint=one")).refused();
    assert!(told.contains("`pint` that is set"), "{told}");
}

/// Three of 270 rows agree in all joints to 0.1 mrad with another: they are chosen by what they would measure, and say nothing
/// of the noise, which is 0.1 mm along each axis.
#[test]
fn joints_that_agree_by_chance_are_no_repeats() {
    let folder = Folder::new();
    let data = folder.name("run.csv");
    run(&format!("simulate panda --measure point --poses 90 --payload 0kg --noise-position 0.1mm --effect 'joint_offset@joint 4=3mrad' --effect 'joint_compliance@joint 2=2e-4' --seed 3 --csv {data}")).good();
    let found = run(&format!("diagnose panda {data} --json -")).json();
    let noise = &found["gap"]["noise"];
    assert_eq!(noise["position_from"], "residual", "{noise}");
    let true_noise = 1e-4 * f64::sqrt(3.0);
    assert!((number(&noise["position_rms"]) / true_noise - 1.0).abs() < 0.1, "{noise}");
}
