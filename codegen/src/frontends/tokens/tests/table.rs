//! The table and its cells.

use num_rational::Ratio;

use super::*;
use crate::robot::{Angle, Motion};

#[test]
fn the_joint_variable_and_its_offset() {
    let joint = |theta: &str, d: &str| {
        table(&format!("joint | theta | d\n a1 | {theta} | {d}")).joints.remove(0)
    };
    let pi = |n, d| Angle::Pi(Ratio::new(n, d));
    assert_eq!(joint("q", "0").theta, Angle::ZERO);
    assert_eq!(joint("q + pi/2", "-").theta, pi(1, 2));
    assert_eq!(joint("q - 90 deg", "0").theta, pi(-1, 2));
    assert_eq!(joint("pi/2 + q", "0").theta, pi(1, 2));
    assert_eq!(joint("-pi/2 + q", "0").theta, pi(-1, 2));
    assert_eq!(joint("q + t2", "d1").theta, Angle::Symbol("t2".into()));
    let prismatic = joint("pi/2", "q + 0.3 m");
    assert_eq!(prismatic.motion, Motion::Prismatic);
    assert_eq!((prismatic.theta, prismatic.d), (pi(1, 2), number("0.3")));
    assert_eq!(joint("-", "q - 20mm").d, number("-0.02"));
}

#[test]
fn the_joint_variable_stands_once_a_row() {
    let row = |cells: &str| table_errors(&format!("joint | theta | d\na1 | {cells}"));
    assert_eq!(
        row("0 | 1"),
        ["4:6 no `q` in theta or d of this row | \
          write `q` in theta for a revolute joint, in d for a prismatic one"]
    );
    assert_eq!(
        row("q | q"),
        ["4:10 `q` stands in theta and in d of this row: a joint has one variable"]
    );
    assert_eq!(row("q + q | 0"), ["4:10 `q` stands here for the second time"]);
    for (cell, shown) in
        [("-q", "-q"), ("2*q", "2*q"), ("q*2", "q*2"), ("1 - q", "1 - q"), ("q +", "q +")]
    {
        let found = row(&format!("{cell} | 0"));
        assert_eq!(found.len(), 1, "{cell}: {found:?}");
        assert!(
            found[0].starts_with(&format!("4:6 `{shown}` is no offset of the joint variable | ")),
            "{found:?}"
        );
    }
    // The row is revolute all the same: its other cells are read.
    assert_eq!(table_errors("joint | theta | stiffness\na1 | -q | 3 kg").len(), 2);
    assert_eq!(
        table_errors("joint | theta | a\na1 | q | q"),
        ["4:10 `q` is the joint variable: it stands in theta or d, nowhere else | \
          choose another name"]
    );
    assert_eq!(
        row("q + t2 + pi/2 | 0"),
        ["4:13 `t2 + pi/2` is a sum: a cell holds one number or one parameter | \
          work the sum out, or take the constant into the parameter"]
    );
}

#[test]
fn mistakes_of_the_header() {
    assert_eq!(
        table_errors("joint | theta | aplha | a\na1 | q | 1.5708 | 0"),
        ["3:17 unknown column `aplha` | did you mean `alpha`?"]
    );
    assert_eq!(
        table_errors("joint | thta | d\na1 | q | 0"),
        ["3:9 unknown column `thta` | did you mean `theta`?"]
    );
    assert_eq!(table_errors("joint | theta | theta\na1 | q | 0"), ["3:17 a second column `theta`"]);
    assert_eq!(
        table_errors("theta | joint\nq | a1"),
        ["3:1 the first column is `joint` | \
          for example `joint | theta | d | a | alpha | stiffness`"]
    );
    assert_eq!(
        table_errors("joint | a\na1 | 0"),
        ["3:1 neither a column `theta` nor `d`: the joint variable `q` stands in one | \
          for example `joint | theta | d | a | alpha | stiffness`"]
    );
    assert_eq!(
        table_errors("joint | theta\n"),
        ["3:1 a robot has at least one joint | \
          write one row per joint under the header, base to tip"]
    );
    let found = table_errors("joint | theta (rad)\na1 | q");
    assert_eq!(found.len(), 1);
    assert!(found[0].starts_with("3:9 the name of one column is expected here | "), "{found:?}");
}

#[test]
fn mistakes_of_a_row_stand_at_their_cells() {
    assert_eq!(
        table_errors(
            "joint | theta | d | a | alpha | stiffness\n\
             a1 | q | 350 kg | 0 | 1.5708 | 3.8e6 N/m\n\
             a2 | q | 0 | | 90 degs | -5\n\
             a3 | q | 0 | 0\n\
             a1 | q | 0 | 0 | 0 | - | 7\n\
             a1 | q | \"350 mm\" | (3) | 0 | -"
        ),
        [
            "4:10 `350 kg` is a mass; a length is expected here (e.g. `350 mm`)",
            "4:23 1.5708 looks like a rounded pi/2: write pi/2 | \
             if 1.5708 is meant to the last digit, write 1.570800",
            "4:32 `3.8e6 N/m` is a force per length; a torque per angle is expected here \
             (e.g. `3.8e6 N*m/rad`)",
            "5:14 an empty cell | write `0`, or `-` for what is absent",
            "5:19 unknown unit `degs` | did you mean `deg`?",
            "5:26 the stiffness is -5.0: it must be above zero | leave it out for a rigid joint",
            "6:1 row `a3` has 4 cells where the header has 6 columns | \
             no cell for alpha, stiffness: write `-` for none",
            "7:26 row `a1` has 7 cells where the header has 6 columns",
            "8:1 two joints are called `a1`",
            "8:10 unexpected `\"350 mm\"` | write the cell without quotes",
            "8:21 unexpected `(3)`",
        ]
    );
    assert_eq!(
        table_errors("joint | theta\n- | q"),
        ["4:1 the joint's name, one word, is expected here"]
    );
    assert_eq!(
        table_errors(
            "joint | theta | com | limits\na1 | q | [1, 2, 3] | [lo, 1]\na2 | q | 3 | [1]"
        ),
        [
            "4:10 a centre of mass without a mass | \
             give the link's `mass` too, or leave `com` out",
            "4:23 `lo` stands where a number is expected | joint limits are numbers",
            "5:10 [x, y, z] is expected here",
            "5:14 a list of 1 where [lower, upper] is expected",
        ]
    );
}

#[test]
fn beams() {
    let beam = |cell: &str| {
        let text = format!("joint | theta | d | beam\na1 | q | 1 | {cell}");
        match parse(&format!("mod arm;\nconvention: modified_dh;\n{text}")) {
            Ok(_) => Vec::new(),
            Err(rejected) => rejected.errors.into_iter().map(|e| e.message).collect(),
        }
    };
    let section =
        |cell: &str| beam(&format!("{{ youngs_modulus: 1, shear_modulus: 1, section: {cell} }}"));
    for good in [
        "tube(200 mm, 180 mm)",
        "tube(0.2)",
        "box([0.2, 0.1])",
        "box([0.2, 0.1], [0.19, 0.09])",
        "box([0.2, 0.1], [0, 0])",
        "{ area: A, iy: 1 mm^4, iz: I, j: J }",
    ] {
        assert_eq!(section(good), [""; 0], "{good}");
    }
    let shapes = "`tube(outer, inner)`, `box([b, h], [b, h])` or \
                  `{ area: …, iy: …, iz: …, j: … }` is expected here";
    for bad in ["tueb(1)", "3", "tube", "tube(1, 2, 3)", "tube[1]"] {
        assert_eq!(section(bad), [shapes], "{bad}");
    }
    let tube = "a tube of outer diameter 0.1 m and inner diameter 0.2 m: the outer one must be above the \
                inner one, and neither below zero";
    assert_eq!(section("tube(0.1, 0.2)"), [tube]);
    let sides = "a box's sides must be above zero, and each inner side below its outer side";
    assert_eq!(section("box([0.1, 0], [0.2, 1])"), [sides]);
    assert_eq!(section("tube(D, 1 kg)").len(), 2);
    assert_eq!(section("{ area: 1, iy: 1, iz: 1 }"), ["`j` is missing here"]);
    assert_eq!(section("{ aera: 1, iy: 1, iz: 1, j: 1 }"), ["unknown key `aera`"]);
    assert_eq!(beam("3"), ["a beam in braces is expected here"]);
    assert_eq!(
        beam("{ youngs_modulus: 1, shear_modulus 2, section: tube(1), section: tube(1), 3 }"),
        [
            "`key: value` is expected here",
            "duplicate key `section`",
            "`key: value` is expected here"
        ]
    );
}
