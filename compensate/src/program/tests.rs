//! Each language: which points are found, in which frames and order, and what is left.

use super::*;

fn program(name: &str, text: &str) -> Program {
    all(&[(name, text)])
}

#[track_caller]
fn all(files: &[(&str, &str)]) -> Program {
    let file = |(name, text): &(&str, &str)| File {
        name: (*name).to_owned(),
        text: text.as_bytes().to_vec(),
    };
    let files: Vec<File> = files.iter().map(file).collect();
    let language = Language::of(&files[0].name).expect("a language");
    Program::read(files, language, 6).unwrap_or_else(|fault| panic!("{}", fault.message))
}

/// Name, frame, tool and numbers of each point, in the order of the program.
fn told(program: &Program) -> Vec<String> {
    let place = |place: &Place| match place {
        Place::Named(name) => name.clone(),
        Place::Is(pose) => format!("{:.3}", pose.translation.vector.x + 0.0),
    };
    let point = |point: &Point| {
        let (kind, cells) = match &point.values {
            Values::Pose(cells) => ("pose", cells),
            Values::Joints(cells) => ("joints", cells),
        };
        let (frame, tool) = (place(&point.frame), place(&point.tool));
        format!("{} {kind} {} in {frame} of {tool}", point.name, cells[0].value)
    };
    program.points.iter().map(point).collect()
}

fn left(program: &Program) -> Vec<String> {
    let one = |left: &Left| format!("{}: {}", left.name, left.because);
    program.left.iter().map(one).collect()
}

#[test]
fn krl_has_points_in_both_files() {
    let dat = "&ACCESS RVP\nDEFDAT CELL PUBLIC\nEXT BAS (BAS_COMMAND :IN)\n\
        DECL E6POS XP1={X 1,Y 2.5,Z -3.0E1,A 4,B 5,C 6,S 2,T 10,E1 0.0}\n\
        DECL FDAT FP1={TOOL_NO 3,BASE_NO 2,IPO_FRAME #BASE,POINT2[] \" \"}\n\
        DECL E6POS XP9={X 9,Y 2.5,Z -3,A 4,B 5,C 6}\nDECL FDAT FP9={TOOL_NO 3,BASE_NO 2,IPO_FRAME #TCP}\n\
        DECL E6AXIS XHOME={A1 7,A2 -90,A3 90,A4 0,A5 0,A6 0}\n\
        DECL POS P[2]\nP[1]={X 11,Y 0,Z 0,A 0,B 0,C 0}\n\
        DECL FRAME SHIFT={X 12,Y 0,Z 0,A 0,B 0,C 0}\nFRAME F2={X 13,Y 0,Z 0,A 0,B 0,C 0} ; {X\n\
        DECL PDAT PPDAT1={VEL 100.0,ACC 100.0,APO_DIST 100.0}\nENDDAT\n";
    let src = "DEF CELL()\nBASE_DATA[4]={X 400,Y 0,Z 0,A 0,B 0,C 0}\n;FOLD PTP XP7 {X 1}\n\
        $BASE=BASE_DATA[4]\nBAS(#TOOL,5)\nlin F2 C_DIS\nPTP P[1]\nPTP XHOME\nPTP XP1\n\
        $TOOL={X 70,Y 0,Z 0,A 0,B 0,C 0}\nLIN {X 21,Y 0,Z 0,A 0,B 0,C 0}\n$BASE=$NULLFRAME\n\
        CIRC {POS: X 22,Y 0,Z 0,A 0,B 0,C 0},{X 23,Y 0,Z 0,A 0,B 0,C 0},CA 90\nPTP P[1]:SHIFT\n\
        LIN_REL {X 1,Y 0,Z 0,A 0,B 0,C 0}\nPTP {A1 30}\nLIN SHIFT:{X 24,Y 0,Z 0,A 0,B 0,C 0}\n\
        XP3={X 25,Y 0,Z 0,A 0,B 0,C 0}\nEND\nDEF B()\nSPTP XP3 WITH $BASE={X 9}\nEND\n";
    let program = all(&[("cell.src", src), ("cell.dat", dat)]);
    let expected = [
        "F2 pose 13 in 0.400 of 5",
        "XHOME joints 7 in 0.400 of 5",
        "XP1 pose 1 in 2 of 3",
        "LIN pose 21 in 0.400 of 0.070",
        "CIRC pose 22 in 0.000 of 0.070",
        "CIRC pose 23 in 0.000 of 0.070",
        "XP3 pose 25 in default of default",
    ];
    assert_eq!(told(&program), expected);
    let turn = &program.points[2].configuration;
    assert!(
        matches!(turn, Configuration::Signs { turn, binary: false } if turn.value == 10.0),
        "{turn:?}"
    );
    let expected = [
        "PTP: it does not give each of A1 … A6 as a number",
        "LIN_REL: its motion is relative",
        "P[1]: it stands in an expression",
        "LIN: it stands in an expression",
        "XP9: its tool stands still",
    ];
    let left = left(&program);
    for start in expected {
        assert!(left.iter().any(|left| left.starts_with(start)), "{start}: {left:?}");
    }
}

/// Post processors write it in binary.
#[test]
fn krl_has_turns_in_binary() {
    let src = "PTP {X 1,Y 2,Z 3,A 4,B 5,C 6,S'B010',T'B110010'}\n";
    let program = all(&[("cell.src", src)]);
    let turn = &program.points[0].configuration;
    let Configuration::Signs { turn, binary: true } = turn else { panic!("{turn:?}") };
    assert_eq!((turn.value, &src[turn.span.clone()]), (50.0, "'B110010'"));
    let wrong = all(&[("cell.src", &src.replace("110010", "112"))]);
    assert_eq!(left(&wrong), ["PTP: its T is no whole number below 64"]);
}

#[test]
fn rapid_has_points_in_work_objects() {
    let text = "MODULE Cell ! PTP [[\n\
        PERS wobjdata wTable:=[FALSE,TRUE,\"\",[[100,0,0],[1,0,0,0]],[[20,0,0],[1,0,0,0]]];\n\
        PERS tooldata tGun:=[TRUE,[[0,0,150],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n\
        LOCAL CONST robtarget p10:=[[1,2,3],[1,0,0,0],[0,-1,0,1],[9E9,9E9,9E9,9E9,9E9,9E9]];\n\
        CONST robtarget pA{2}:=[[[2,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],\n\
          [[3,2,3],[1,0,0,0],[0,0,0,0],[9E+09,9E9,9E9,9E9,9E9,9E9]]];\n\
        CONST jointtarget jHome:=[[4,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n\
        VAR robtarget pV:=[[x,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n\
        CONST speeddata v9:=[1,2,3,4];\n\
        PROC main()\n  MoveAbsJ jHome\\NoEOffs,v100,fine,tGun;\n  IF x THEN\n MoveL pA{i}, v100, z10, tGun\\WObj:=wTable; ENDIF\n\
        MoveL Offs(p10,0,0,50),v100,z10,tool0;\n  movej p10,v100\\T:=3,z10,tool0;\n\
        MoveL [[5,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1,fine,tOther;\n\
        p:=RelTool([[6,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],0,0,1);\n\
        p20:=[[7,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nENDPROC\nENDMODULE\n";
    let program = program("cell.mod", text);
    let expected = [
        "jHome joints 4 in 0.000 of 0.000",
        "pA pose 2 in 0.120 of 0.000",
        "pA pose 3 in 0.120 of 0.000",
        "p10 pose 1 in 0.000 of 0.000",
        "MoveL pose 5 in 0.000 of tOther",
        "p20 pose 7 in default of default",
    ];
    assert_eq!(told(&program), expected);
    let Place::Is(gun) = &program.points[0].tool else { panic!() };
    assert!((gun.translation.vector.z - 0.15).abs() < 1e-12);
    let data = &program.points[3].configuration;
    assert!(matches!(data, Configuration::Quarters(of) if of[1].value == -1.0), "{data:?}");
    assert_eq!(left(&program).len(), 2, "{:?}", left(&program));
}

#[test]
fn fanuc_has_points_behind_their_section() {
    let text = "/PROG  CELL\n/MN\n   1:  !don't ;\n   2:J P[2:\"home\"] 100% FINE    ;\n\
        3:L P[1] 100mm/sec FINE ;\n   4:L P[3] 100mm/sec FINE INC ;\n/POS\nP[1]{\n   GP1:\n\
        \tUF : 1, UT : 2,\t\tCONFIG : 'N U T, 0, -1, 0',\n\tX =   500.000  mm,\tY =     0.000  mm,\tZ =   400.000  mm,\n\
        \tW =  -180.000 deg,\tP =     0.000 deg,\tR =      .000 deg\n};\nP[2:\"home\"]{\n   GP1:\n\tUF : 0, UT : 1,\t\n\
        \tJ1=     1.000 deg,\tJ2=     0.000 deg,\tJ3=     0.000 deg,\n\tJ4=     0.000 deg,\tJ5=   -90.000 deg,\tJ6=     0.000 deg\n};\n\
        P[3]{\n   GP1:\n\tUF : 1, UT : 2,\n\tX = 1 mm, Y = 0 mm, Z = 0 mm, W = 0 deg, P = 0 deg, R = 0 deg\n};\n\
        P[4]{\n   GP1:\n\tUF : 1, UT : 2,\n\tX = ******** mm\n};\n/END\n";
    let program = program("cell.ls", text);
    assert_eq!(told(&program), ["P[2] joints 1 in 0.000 of 1", "P[1] pose 500 in 1 of 2"]);
    let turns = &program.points[1].configuration;
    let Configuration::Turns(turns) = turns else { panic!("{turns:?}") };
    let shown = |cell: &Cell| text[cell.span.clone()].to_owned();
    assert_eq!(turns.each_ref().map(shown), ["0", "-1", "0"]);
    assert_eq!(left(&program).len(), 2, "{:?}", left(&program));
}

#[test]
fn urscript_has_points_in_motions_and_variables() {
    let text = "def cell():\n  set_tcp(p[0.01,0,0.1,0,0,0])\n  global Waypoint_1_p=p[.1, -0.2, 0.3, 0, 3.14, 0]\n\
        global Waypoint_1_q=[-1.5, -1.6, -1.7, -1.4, 1.5, 0]\n  Plane=p[0.4,0,0,0,0,0]\n # movel(p[9,9,9,9,9,9])\n\
        if a == 3:\n movej(get_inverse_kin(Waypoint_1_p, qnear=Waypoint_1_q), a=1.3, v=1)\n end\n\
        movel(pose_trans(Plane, p[0.5,0,0,0,0,0]), a=1)\n  movej([0.6, -1, 1, 0, 0, 0])\n\
        movec(p[0.7,0,0,0,0,0], p[0.8,0,0,0,0,0])\n  movel(pose_add(x, p[0.9,0,0,0,0,0]))\n\
        movej([d2r(90), 0, 0, 0, 0, 0])\n  other = p[1,0,0,0,0,0]\n  f(p[2,0,0,0,0,0])\nend\n";
    let program = program("cell.script", text);
    let expected = [
        "Waypoint_1_p pose 0.1 in 0.000 of 0.010",
        "movel pose 0.5 in 0.400 of 0.010",
        "movej joints 0.6 in 0.000 of 0.010",
        "movec pose 0.7 in 0.000 of 0.010",
        "movec pose 0.8 in 0.000 of 0.010",
    ];
    assert_eq!(told(&program), expected);
    assert_eq!(program.points[0].near.as_ref().map(|q| q[1]), Some(-1.6));
    let named = all(&[("cell.script", "movej(q=[1, 2, 3, 4, 5, 6], a=1)\nmovej(q)\n")]);
    assert_eq!(told(&named), ["movej joints 1 in 0.000 of default"]);
    let left = left(&program);
    for name in ["Waypoint_1_q", "Plane", "movel", "movej", "other", "p[…]"] {
        assert!(left.iter().any(|left| left.starts_with(name)), "{name}: {left:?}");
    }
    assert_eq!(left.len(), 6, "{left:?}");
}

#[test]
fn deep_brackets_end() {
    let deep = |open: &str| open.repeat(2000);
    assert!(program("a.script", &format!("movel({}", deep("pose_trans(f,"))).points.is_empty());
    let brackets = deep("[") + &deep("]");
    assert!(program("a.mod", &format!("CONST robtarget p:={brackets};")).points.is_empty());
}

#[test]
fn a_table_has_poses_or_joint_values() {
    let text = "# made by hand\nname, x[mm],y[mm],z[mm],rx[deg],ry[deg],rz[deg],v\n\"a,b\", 1,2,3,4,5,6,fast\r\n";
    let found = program("path.csv", text);
    assert_eq!(told(&found), ["row pose 1 in 0.000 of default"]);
    let found = program("path.csv", "q1[deg],q2,q3,q4,q5,q6\n90,0,0,0,0,0\n");
    assert_eq!(told(&found), ["row joints 90 in 0.000 of default"]);
}

#[test]
fn mistakes_have_a_place() {
    for (name, text, span, says) in [
        ("a.dat", "DECL POS P={X 1,Y }\n", 18, "found `}`, expected a value of Y"),
        ("a.dat", "DECL POS P={X 1,", 16, "found the end, expected the name of a component"),
        ("a.mod", "CONST robtarget p:=[[1,2", 24, "found the end, expected `]`"),
        ("a.ls", "/POS\nP[1]{ GP1: X 3 };", 18, "found `3`, expected `:` or `=`"),
        ("a.csv", "x,y\n1,2", 0, "found no columns of points"),
        ("a.csv", "q1,q2,q3,q4,q5,q6\n1,2,x,4,5,6", 22, "found `x`, expected a number"),
        ("a.csv", "q1[kg],q2,q3,q4,q5,q6\n", 0, "found `q1[kg]`, expected one of"),
    ] {
        let file = File { name: name.to_owned(), text: text.as_bytes().to_vec() };
        let language = Language::of(name).expect("a language");
        let fault = Program::read(vec![file], language, 6).expect_err(text);
        assert!(fault.message.starts_with(says), "{text}: {}", fault.message);
        assert_eq!(fault.span.start, span, "{text}");
    }
    assert_eq!(Language::of("a.txt"), None);
    let pose = Language::Krl.pose("{X 1000, Y 0, Z 0, A 90, B 0, C 0}").expect("a pose");
    assert!((pose.translation.vector.x - 1.0).abs() < 1e-12 && pose.rotation.angle() > 1.5);
    assert!(
        Language::Fanuc.pose("1,2,3").is_none()
            && Language::Rapid.pose("[1,2,3],[0,0,0,0]").is_none()
    );
}
