//! What cannot be done is refused with status 2, nothing printed and nothing written: every message in full, in the
//! snapshot. `INSTA_UPDATE=always cargo test -p stiffarm-cli refusals` writes it; read it as a user.

use crate::motion::ELBOW;
use crate::support::{Folder, read, stiffarm, words};

/// Two joints, and mistakes of such a robot file.
const ROBOT: &str = "name = \"arm\"\nconvention = \"standard\"\n[[joint]]\ntype = \"revolute\"\n\
                     a = 1.0\n[[joint]]\ntype = \"revolute\"\na = 0.5\n";

/// Robot files: what stands behind docs/workbench/arm.toml.
const EFFECTS: [(&str, &str); 4] = [
    ("identifier.toml", "id = \"backlsh\"\nplace = \"joint 1\"\n"),
    ("place.toml", "id = \"backlash\"\nplace = \"joint 9\"\n"),
    ("unit.toml", "id = \"backlash\"\nplace = \"joint 1\"\nwidth = \"1 mm\"\n"),
    ("missing.toml", "id = \"slip\"\nplace = \"base\"\nx = 1e-3\n"),
];

/// Files that commands name with `@`.
const FILES: [(&str, &[u8]); 34] = [
    ("broken.toml", b"[[joint\n"),
    ("empty.toml", b""),
    ("binary.toml", b"name = \"a\"\n\xff\xfe"),
    ("nan.csv", b"q1,q2,dx\n0.1,nan,1\n"),
    ("infinite.csv", b"q1,q2,dx\n0.1,0.2,-inf\n"),
    ("word.csv", b"q1,q2,dx\n0.1,abc,1\n"),
    ("ragged.csv", b"q1,q2,dx\n# remark\n0.1,0.2\n"),
    ("twice.csv", b"q1,q2,dx,q1\n0.1,0.2,1,0.1\n"),
    ("unit.csv", b"q1,q2[mm],dx\n0.1,0.2,1\n"),
    ("joints.csv", b"q1,q2,q3,dx\n0.1,0.2,0,1\n"),
    ("unmeasured.csv", b"q1,q2,fx\n0.1,0.2,1\n"),
    ("few.csv", b"q1,dx\n0.1,1\n"),
    ("rowless.csv", b"q1,q2,dx\n"),
    ("semicolons.csv", b"q1;q2;dx\n1;2;3\n"),
    ("empty.csv", b""),
    ("one.csv", b"q1,q2,dx\n0.1,0.2,1\n"),
    ("marker.csv", b"q1,q2,x,y,z,marker\n0.1,0.2,1,0,0,m\n"),
    ("binary.csv", b"q1,q2,dx\n0.1,\xff,1\n"),
    ("unloaded.csv", b"q1,q2,q3,q4,q5,q6,dx\n0,0,0,0,0,0,1e-3\n"),
    ("load.csv", b"q1,q2,q3,q4,q5,q6,fx,dx\n0,0,0,0,0,0,a,1e-3\n"),
    ("targets.csv", b"x,y,z\n1,0,0\n"),
    ("cell.csv", b"x,y,z\n1,a,0\n"),
    ("flat.csv", b"x,y\n1,0\n"),
    ("moved.csv", b"dx,dy,dz\n1,0,0\n"),
    ("started.csv", b"q1,x,y,z\n0,1,0,0\n"),
    ("far.csv", b"x,y,z\n1,0,0\n0,1e308,0\n"),
    (
        "still.csv",
        b"t[s],q1[rad],q2[rad],q3[rad],q_cmd1[rad],q_cmd2[rad],q_cmd3[rad]\n0,0,0,0,0,0,0\n",
    ),
    ("log.csv", b"t[s],q1[rad],q2[rad],q3[rad],tau1[N*m],tau2[N*m],tau3[N*m]\n0,0,0,0,0,0,0\n"),
    ("bench.toml", b"[[socket]]\nname = \"a\"\n"),
    ("nowhere.toml", b"[[point]]\nname = \"somewhere\"\n"),
    ("raw.txt", b"Export 7\n\nA1;A2;H\n10,5;-20;0,8\n11;-21;0,9\n"),
    ("tracker.csv", b"Time [s];X [mm];Y [mm]\n0,5;1;2\n1,5;3;4\n"),
    ("side.csv", b"Time [ms],J1,J2\n0,0.1,0.2\n1000,0.3,0.4\n2000,0.3,0.6\n"),
    ("paper.toml", b"id = 3\n"),
];

/// One command a line; what stands in quotes is one word.
const COMMANDS: &str = "\
eval @bad.toml --q 0,0 --json @out
check @bad.toml
generate @bad.toml --emit rust --out @out
diagnose @bad.toml robots/data/lin1991_table3.csv --json @out
eval @broken.toml --q 0
eval @empty.toml --q 0
eval @binary.toml --q 0
simulate @identifier.toml --csv -
generate @identifier.toml --emit rust
simulate @place.toml --csv -
simulate @unit.toml --csv -
generate @missing.toml --emit rust
generate @evil.toml --emit rust
eval no.toml --q 0
eval robots/ --q 0
eval ur55 --q 0
eval ur5
eval ur5 --q 0,0
eval ur5 --q 0,0,0,0,x,0
eval ur5 --q 0,0,0,0,1mm,0
eval ur5 --q 0,0,0,0,nan,0
eval ur5 --q 0,0,0,0,0,0 --wrench 1,2,3
eval ur5 --q 0,0,0,0,0,0 --wrench 1,2,3,1N,0,0
eval ur5 --q 0,0,0,0,0,0 --set a=1
eval ur5 --q 0,0,0,0,0,0 --set a
eval jweeg_two_link --q 0,0 --set a1=x
eval jweeg_two_link --q 0,0 --set A1=1
eval lin_planar_symbolic --q 0,0 --set L1=1
eval kuka_kr240 --q 0,0,0,0,0,0 --wrench -1e9,0,0,0,0,0
eval kuka_kr240 --pose 1.6,0.2,1.1,0,90deg,0 --wrench 0,0,-1e12,0,0,0
eval panda --pose 0.4,0.2,0.3,0,90deg,0
eval ur5 --pose 0.4,0.2,0.3
check
check ur5 --all
check ur5 --count 0
check jweeg_two_link
check @heavy.toml --count 20 --quiet
generate ur5 --emit fortran
generate ur5 --emit latex --outputs poses
generate ur5 --emit latex --outputs 'pose at elbow'
generate ur5 --emit dot --kernels k
generate ur5 --emit rust --out a --check b
generate ur5 --emit rust --check no.rs
generate ur5 --emit c
generate ur5 --emit c --out -
generate ur5 --emit c --out / --flexible
generate ur5 --emit c --out / --kernels k
generate ur5 --emit c --fused --out nowhere
generate ur5 --emit latex --fused
generate ur5 --emit rust --fused --flexible
generate ur5 --emit rust --precision f32
generate ur5 --emit latex --sines math
generate ur5 --emit c --name Left-Arm --out @out
generate jweeg_two_link --emit c --out /
generate jweeg_two_link --emit latex --flexible dq1
generate jweeg_two_link --emit dot --flexible
generate puma560 --emit base --outputs pose
frobnicate
diagnose @arm.toml @nan.csv --json @out
diagnose @arm.toml @infinite.csv
diagnose @arm.toml @word.csv
diagnose @arm.toml @ragged.csv
diagnose @arm.toml @twice.csv
diagnose @arm.toml @unit.csv
diagnose @arm.toml @joints.csv
diagnose @arm.toml @unmeasured.csv
diagnose @arm.toml @few.csv
diagnose @arm.toml @rowless.csv
diagnose @arm.toml @semicolons.csv
diagnose @arm.toml @empty.csv
diagnose @arm.toml @one.csv
diagnose @arm.toml @marker.csv
diagnose @arm.toml @binary.csv
diagnose @arm.toml @many.csv
diagnose lin_planar no.csv
diagnose lin_planar robots/data/lin1991_table3.csv --nuisance base_fram
diagnose lin_planar robots/data/lin1991_table3.csv --json - --report -
diagnose lin_planar robots/data/lin1991_table3.csv --json - --write-robot -
diagnose lin_planar robots/data/lin1991_table3.csv --report no/such/folder.html
diagnose lin_planar robots/data/lin1991_table3.csv --rival foo
diagnose lin_planar robots/data/lin1991_table3.csv --noise-position 30
diagnose lin_planar robots/data/lin1991_table3.csv --noise-position -3um
diagnose lin_planar robots/data/lin1991_table3.csv --noise-rotation 3um
diagnose lin_planar robots/data/lin1991_table3.csv --tolerance 1mm
diagnose lin_planar robots/data/lin1991_table3.csv --accept 3
diagnose lin_planar robots/data/lin1991_table3.csv --effects joint_complience
diagnose lin_planar robots/data/lin1991_table3.csv --usual 'joint_compliance=1 mm'
diagnose lin_planar robots/data/lin1991_table3.csv --folds 1
diagnose lin_planar robots/data/lin1991_table3.csv --folds x
diagnose lin_planar robots/data/lin1991_table3.csv --check no.csv
diagnose lin_planar robots/data/lin1991_table3.csv --check @marker.csv
diagnose lin_planar robots/data/lin1991_table3.csv --compare robots/arms/ur5.toml
diagnose lin_planar robots/data/lin1991_table3.csv --bench @bench.toml
diagnose lin_planar robots/data/lin1991_table3.csv --band 5Hz
diagnose lin_planar robots/data/lin1991_table3.csv robots/data/lin1991_table3.csv
diagnose docs/workbench/arm.toml docs/workbench/plan.csv
diagnose @elbow.toml @log.csv --nuisance base_frame
diagnose @elbow.toml @log.csv --accept 1mm
diagnose @elbow.toml @log.csv --torque-side gear
diagnose @elbow.toml @log.csv --torque-side external
diagnose @elbow.toml @log.csv --map excel
diagnose @elbow.toml @log.csv --band fast
identify docs/workbench/arm.toml docs/workbench/run.csv --folds 99
identify docs/workbench/arm.toml docs/workbench/run.csv --noise-position 3
identify docs/workbench/arm.toml docs/workbench/run.csv --json - --write-robot -
identify docs/workbench/arm.toml docs/workbench/run.csv --json - --report -
identify docs/workbench/arm.toml docs/workbench/run.csv --write-robot no/such.toml
identify docs/workbench/arm.toml no.csv
identify docs/workbench/arm.toml @unloaded.csv
identify docs/workbench/arm.toml @load.csv
predict docs/workbench/arm.toml docs/workbench/plan.csv
map ur5 --over q2,q3 --of condition
map ur5 --over q2,q3 --of condition --csv - --svg -
map ur5 --over q2,q3 --of condition --csv - --wrench 0,0,1,0,0,0
map ur5 --over q2,q3 --of condition --csv - --length 3
map ur5 --over q2,q3 --of condition --csv - --at q2=1
map ur5 --over q2,q3 --of condition --csv - --at q4=1mm
map ur5 --over q2,q3 --of condition --csv - --at q9=1
map ur5 --over q2,q3 --of condition --csv - --at q1
map ur5 --over q2,q3 --of condition --csv no/such.csv
map ur5 --over q2,q3 --of condition --csv - --data run.csv
map ur5 --over q2,q3 --of shrink --csv -
map ur5 --over q2,q3 --of shrink --csv - --data no/such.csv
map ur5 --over q2,q3 --of stiffness --csv -
map ur5 --over q2,q3 --of stiffness --csv - --wrench 0,0,0,1,0,0
map ur5 --over q2 --of condition --csv -
map ur5 --over q2,q2 --of condition --csv -
map ur5 --over q2,q7 --of condition --csv -
map lin_planar --over q1,q2 --of condition --csv -
poses ur5 --count 3
poses ur5 --count 0 --csv -
poses ur5 --count 3 --csv no/such.csv
poses ur5 --count 3 --csv - backlash
poses ur5 --count 3 --csv - --load 1,2
poses ur5 --count 3 --csv - --load 0,0,0,0,0,0
poses ur5 --count 3 --csv - --for fun
poses ur5 --count 3 --csv - --for separate 'backlash@joint 2'
poses ur5 --count 3 --csv - --for separate 'backlas@joint 2' drift
poses ur5 --count 3 --csv - --for separate 'backlash@joint 2' drift
poses ur5 --count 3 --csv - --for separate base_frame base_frame
poses ur5 --count 3 --csv - --for separate drift drift --nuisance frame
poses irb120 --count 4 --csv - --bench @nowhere.toml
poses irb120 --count 4 --csv - --bench @nowhere.toml --for diagnose
poses @elbow.toml --for motion --count 3 --csv -
poses @elbow.toml --for motion --csv - 'torque_scale@joint 1' 'rotor_inertia@joint 1'
compensate kuka_kr240 --targets @cell.csv --out -
compensate kuka_kr240 --targets @flat.csv --out -
compensate kuka_kr240 --targets @moved.csv --out -
compensate kuka_kr240 --targets @started.csv --out -
compensate kuka_kr240 --targets @far.csv --out -
compensate kuka_kr240 --targets @targets.csv --out - --tolerance 3
compensate kuka_kr240 --targets @targets.csv --out - --wrench 3
compensate ur5 --targets no.csv --out -
simulate ur5 --csv @out --effect 'backlsh@joint 2=1mrad'
simulate ur5 --csv @out --effect 'backlash@joint 9=1mrad'
simulate ur5 --csv @out --effect 'joint_compliance@joint 2=-1'
simulate ur5 --csv @out --effect 'joint_compliance@joint 2=1' --payload 500kg
simulate ur5 --csv @out --poses 0
simulate ur5 --csv @out --poses 400000
simulate ur5 --csv @out --payload heavy
simulate ur5 --csv @out --noise-position 3
simulate ur5 --csv @out --measure displacement --payload 0kg
simulate irb120 --csv @out --measure camera --payload 3kg
simulate @elbow.toml
simulate @elbow.toml --csv - --log x.csv
simulate @elbow.toml --csv - --rate 100Hz
simulate @elbow.toml --log - --poses 3
simulate @elbow.toml --log - --effect 'backlash@joint 9=1'
simulate @elbow.toml --log - --max-rate 1,2
simulate @elbow.toml @still.csv --log -
simulate @light.toml --log -
simulate @soft.toml --log -
withhold ur5 --effects backlsh
withhold ur5 --cases 0
withhold ur5 --sizes 8
withhold ur5 --sizes 20,8
withhold ur5 --noise-rotation 0rad --cases 1
withhold @elbow.toml --motion --effects gremlins
measurements no.csv --csv @out
measurements @raw.txt --robot lin_planar --csv @out
measurements @tracker.csv --join @side.csv
measurements @tracker.csv --by time
effects latncy
papers no.toml
papers @paper.toml
papers --svg x.svg
completions csh
";

#[test]
fn refusals_are_said_in_full() {
    let folder = Folder::new();
    FILES.iter().for_each(|(name, content)| drop(folder.file(name, content)));
    let workbench = read("docs/workbench/arm.toml");
    for (name, effect) in EFFECTS {
        folder.file(name, format!("{workbench}\n[[effect]]\n{effect}"));
    }
    let of_motion = |line: &&str| {
        !["mass", "inertia", "rotor", "com "].iter().any(|name| line.starts_with(name))
    };
    let wave =
        "[[effect]]\nid = \"transmission_error\"\nplace = \"joint 2\"\norder = 2\ncos = 1e-4";
    for (name, content) in [
        ("arm.toml", ROBOT.to_owned()),
        ("bad.toml", ROBOT.replace("standard", "standart").replace("a = 0.5", "a = \"350 kg\"")),
        (
            "heavy.toml",
            ROBOT.replace("a = 0.5", "a = 1\nalpha = \"pi/2\"\nmass = 1e308\ncom = [1, 0, 0]"),
        ),
        ("evil.toml", workbench.replacen("name = ", "name = \"a\\nfn evil() {}\" #", 1)),
        ("many.csv", format!("q1,q2,dx\n{}", "0.1,x,1\n".repeat(30))),
        ("elbow.toml", ELBOW.to_owned()),
        ("light.toml", ELBOW.lines().filter(of_motion).collect::<Vec<_>>().join("\n")),
        ("soft.toml", format!("{ELBOW}\n{wave}\n")),
    ] {
        folder.file(name, content);
    }
    let (before, place) = (folder.names(), folder.name(""));
    let mut said = String::new();
    for line in COMMANDS.lines() {
        let words: Vec<String> = words(line)
            .iter()
            .map(|word| word.replacen('@', &place, usize::from(word.starts_with('@'))))
            .collect();
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let err = stiffarm(&words).refused().replace(&place, "@");
        said.push_str(&format!("$ stiffarm {line}\n{err}\n"));
    }
    assert_eq!(folder.names(), before);
    insta::assert_snapshot!(said);
}
