//! Programs of one's own: what their words mean, by evaluation of the graph, and how mistakes are told.

use stiffarm_codegen::derive::Output;
use stiffarm_codegen::expr::Symbol;
use stiffarm_codegen::program::{Formulas, Function, Module, Term, quaternion};
use stiffarm_codegen::robot::Robot;

/// An arm of both kinds of joints with a tool and a base that are turned and moved.
const ARM: &str = r#"
    name = "oblique"
    convention = "standard"
    base = { translation = [0.3, -0.1, 0.2], rotation = [0.1, 0.2, -0.4] }
    joint = [
        { type = "revolute", theta = "pi/2", d = 0.3, a = -0.2, alpha = "pi/2", stiffness = 1e5 },
        { type = "prismatic", theta = "pi/2", d = 0.1, a = 0.25, alpha = "-pi/2" },
        { type = "revolute", theta = 0.3, d = 0.1, a = "reach", alpha = 0.4 },
        { type = "revolute", d = 0.05, a = 0.3, alpha = "pi" },
    ]
    tool = { translation = [0.1, -0.2, 0.3], rotation = [0.5, -2.0, 1.0] }
"#;

const Q: [f64; 4] = [0.4, 0.7, -1.1, 2.0];
const REACH: f64 = 0.45;

fn robot() -> Robot {
    Robot::from_toml(ARM, "arm.toml").expect("the file is valid").0
}

/// What formulas give at `Q`, with these inputs.
fn values(inputs: &[&[f64]], formulas: impl Fn(&Formulas<'_>)) -> Vec<Vec<f64>> {
    let function = Function::new(&robot(), "f", "", formulas).expect("no mistakes");
    function.evaluate(&Q, inputs, |symbol| match symbol {
        Symbol::Parameter(name) if name == "reach" => REACH,
        Symbol::Rate(joint) => 0.1 + *joint as f64,
        symbol => panic!("{symbol:?} is no input"),
    })
}

fn assert_near(got: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(got.len(), expected.len());
    for (a, b) in got.iter().zip(expected) {
        assert!((a - b).abs() <= tolerance, "{got:?} {expected:?}");
    }
}

/// Poses are those of the arm's outputs, which the textbook checks.
#[test]
fn frames_stand_where_the_outputs_say() {
    let found = values(&[], |f| {
        let base = f.base();
        let frames = [f.tool(), f.frame(1), f.frame(2), f.frame(3), f.frame(4)];
        let mut places = frames.into_iter().map(|frame| {
            let axes = frame.axes().into_iter().flat_map(|axis| base.components(axis));
            axes.chain(f.coordinates(frame.origin(), base)).collect::<Vec<_>>()
        });
        f.result("tool", "m", "", places.next().expect("the tool"));
        f.result("frames", "m", "", places.flatten().collect::<Vec<_>>());
        f.result("pose", "m", "", f.output(Output::Pose));
        f.result("poses", "m", "", f.output(Output::Frames));
    });
    assert_near(&found[0], &found[2], 1e-15 * 8.0);
    assert_near(&found[1], &found[3], 1e-15 * 8.0);
}

/// A point's twists are the Jacobian's at the tool, and elsewhere the graph's derivative of its place.
#[test]
fn twists_are_derivatives_of_places() {
    let found = values(&[], |f| {
        let base = f.base();
        let columns = |point| {
            let twists = f.twists(point).into_iter();
            twists
                .map(|[v, w]| [base.components(v), base.components(w)].concat())
                .collect::<Vec<_>>()
        };
        f.result("tool", "m", "", columns(f.tool().origin()));
        f.result("jacobian", "m", "", f.output(Output::Jacobian));
        for (name, frame) in [("elbow", f.frame(2)), ("hand", f.tool())] {
            let point = frame.point(f.numbers([0.1, -0.3, 0.2]));
            let linear: Vec<_> =
                columns(point).into_iter().map(|column| column[..3].to_vec()).collect();
            f.result(name, "m", "", linear);
            let place = f.coordinates(point, base);
            f.result(&format!("{name}_slopes"), "m", "", f.derivatives(&place, &f.joints()));
        }
    });
    for pair in found.chunks(2) {
        assert_near(&pair[0], &pair[1], 1e-14);
    }
}

/// The derivative along a variation is that of the frame moved by a little, whichever way it is then used.
#[test]
fn variations_are_zero_and_differentiate() {
    const STEP: f64 = 1e-6;
    let mount = [0.2, -0.1, 0.15];
    let turned: [f64; 4] = [0.7, 0.1, -0.5, 0.3];
    let by = |f: &Formulas<'_>, moved: Option<[f64; 6]>| {
        let frame =
            f.tool().then(f.vector("mount", "m", ""), quaternion(f.vector("turned", "1", "")));
        let (v, turn) = (f.variation(), f.variation());
        let frame = match moved {
            None => frame.displaced(v, turn),
            Some([x, y, z, a, b, c]) => frame.displaced(f.numbers([x, y, z]), f.numbers([a, b, c])),
        };
        let inside = f.coordinates(f.base().origin(), frame);
        let outside = f.coordinates(frame.point(f.numbers([0.3, 0.1, -0.2])), f.base());
        let axis = f.base().components(frame.axes()[1]);
        let all = [inside, outside, axis].concat();
        let variations: Vec<_> = v.into_iter().chain(turn).collect();
        f.result("values", "m", "", all.clone());
        f.result("slopes", "m", "", f.derivatives(&all, &variations));
    };
    let at = |moved| values(&[&mount, &turned], |f| by(f, moved));
    let found = at(None);
    for k in 0..6 {
        let ends = [STEP, -STEP].map(|step| {
            let mut by = [0.0; 6];
            by[k] = step;
            at(Some(by)).remove(0)
        });
        let slopes: Vec<f64> =
            ends[0].iter().zip(&ends[1]).map(|(high, low)| (high - low) / (2.0 * STEP)).collect();
        // Rounding of values of some metres over the step, and no curvature but the step's square.
        assert_near(&found[1][9 * k..9 * k + 9], &slopes, 1e-9);
    }
}

/// Rates are an input like those of the arm's outputs; a sine of an input, and one of that sine.
#[test]
fn inputs_of_the_arm_and_own_sines() {
    let found = values(&[&[0.3]], |f| {
        let (angle, rates) = (f.scalar("angle", "rad", ""), f.rates());
        let nested = (angle.sin() * 2.0 + f.joints()[2]).cos() / f.parameter("reach");
        f.result("nested", "1", "", nested);
        f.result(
            "slopes",
            "1",
            "",
            f.gradient(nested * rates[1], &[angle, f.joints()[2], rates[1]]),
        );
    });
    let inner = 2.0 * 0.3_f64.sin() + Q[2];
    let (value, slope) = (inner.cos() / REACH, -inner.sin() / REACH);
    assert_near(&found[0], &[value], 1e-15);
    assert_near(&found[1], &[1.1 * slope * 2.0 * 0.3_f64.cos(), 1.1 * slope, value], 1e-14);
}

/// Each at its line, all at once.
#[test]
fn mistakes_are_told_at_their_lines() {
    let refused = |formulas: &dyn Fn(&Formulas<'_>)| {
        Function::new(&robot(), "f", "", formulas).expect_err("it is refused").to_string()
    };
    let said = refused(&|f| {
        let x = f.scalar("x", "m", "");
        let zero = f.number(0.0);
        f.result("a", "1", "", x / zero);
        f.result("b", "1", "", (x * f64::NAN) + f.number(-2.0).sqrt());
        f.result("c", "1", "", f.gradient(x * x, &[x * x]));
        f.result("d", "1", "", f.parameter("rech"));
        f.result("e", "1", "", Vec::<Term<'_>>::new());
        f.result("g", "1", "", f.output(Output::Deflection));
        f.result("h", "1", "", f.coordinates(f.frame(5).origin(), f.base()));
        let [nothing] = f.variation();
        f.result("i", "1", "", x / nothing);
    });
    for expected in [
        "division by what is always zero",
        "the number NaN",
        "the square root of -2.0",
        "as number 0 (from 0) of what to differentiate by",
        "no parameter `rech` in the table, expected one of: reach",
        "a result `e` without entries",
        "`deflection`, which solves a linear system",
        "frame 5, expected one from 0 to 4",
        "the result `i` has no value where the variations are zero",
    ] {
        assert!(said.contains(expected), "{expected}:\n{said}");
    }
    assert_eq!(said.matches("codegen/tests/program.rs:").count(), 9, "{said}");
    let names = |input: &'static str, result: &'static str| {
        refused(&move |f| f.result(result, "1", "", f.scalar(input, "1", "") + 1.0))
    };
    assert!(names("Gap", "a").contains("`Gap`, expected lower-case letters"));
    assert!(names("s23", "a").contains("gives to something else"));
    assert!(names("gap", "type").contains("a keyword"));
    assert!(refused(&|_| {}).contains("found no result"));
    let robot = robot();
    let twice = Module::new(&robot).function("pose", "", |f| f.result("a", "1", "", f.number(1.0)));
    assert!(twice.err().expect("an output has that name").to_string().contains("another function"));
}
