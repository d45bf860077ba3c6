//! What the macro's input can say; what is refused, `tests/text/mistakes.rs` shows.

use num_rational::Ratio;

use super::{Invocation, Rejected, Source, parse_tokens};
use crate::number::Number;
use crate::robot::{Angle, Convention, Motion, Robot, Value};

fn parse(text: &str) -> Result<Invocation, Box<Rejected>> {
    parse_tokens(text.parse().expect("these are tokens"))
}

fn read(text: &str) -> Robot {
    match parse(text) {
        Ok(Invocation { source: Source::Table(robot), .. }) => *robot,
        Ok(_) => panic!("a file"),
        Err(rejected) => panic!("{:?}", rejected.errors),
    }
}

fn table(table: &str) -> Robot {
    read(&format!("mod arm;\nconvention: modified_dh;\n{table}"))
}

fn number(text: &str) -> Value {
    Value::Number(Number::from_decimal(text).unwrap())
}

#[test]
fn the_example_is_read() {
    let text = "
        /// KUKA KR 240-2 (Dumas et al. 2011, Table 3).
        pub mod kr240;
        convention: modified_dh;
        joint | theta | d       | a        | alpha   | stiffness
        a1    | q     | 0       | 0        | 0       | 3.8e6 N*m/rad
        a2    | q     | 0       | 350 mm   | 90 deg  | 6.6e6 N*m/rad
        a3    | q     | 0       | 1250 mm  | 0       | 3.9e6 N*m/rad
        a4    | q     | 1100 mm | 55 mm    | -90 deg | 5.6e5 N*m/rad
        a5    | q     | 0       | 0        | 90 deg  | 6.6e5 N*m/rad
        a6    | q     | 230 mm  | 0        | -pi/2   | 4.7e5 N*m/rad";
    let Ok(invocation) = parse(text) else { panic!() };
    assert_eq!(invocation.module, "kr240");
    assert!(matches!(invocation.vis, syn::Visibility::Public(_)));
    assert_eq!(invocation.attrs.len(), 1);
    assert!(invocation.kernels.is_none() && !invocation.fused);
    let robot = read(text);
    assert_eq!((robot.name.as_str(), robot.convention), ("kr240", Convention::Modified));
    assert_eq!(robot.dof(), 6);
    assert_eq!(robot.joints[3].name, "a4");
    assert_eq!(robot.joints[3].d, number("1.1"));
    assert_eq!(robot.joints[3].alpha, Angle::Pi(Ratio::new(-1, 2)));
    assert_eq!(robot.joints[5].stiffness, Some(number("4.7e5")));
}

#[test]
fn every_setting_and_column_is_read() {
    let text = "
        pub(crate) mod arm;
        name: \"An arm\";
        convention: standard;
        gravity: [0, 0, g];
        tool: rotation [0, 0, pi/2], translation [0, 0, 100 mm];
        marker: smr1 [0, 100 mm, 0];
        marker: \"the other\";
        crate: ::stiffarm_kernels;
        products: fused;
        joint | stiffness | theta | mass | com           | limits        | source    | a   | beam
        1     | k1        | q     | 12   | [c1, 0, 1 in] | [-90 deg, 2]  | \"guess\" | 1 m | {
            youngs_modulus: 69 GPa, shear_modulus: G, density: 2700,
            section: tube(200 mm, 180 mm), shear_coefficient: 0.5,
        }";
    let robot = read(text);
    assert_eq!(robot.name, "An arm");
    assert_eq!(robot.convention, Convention::Standard);
    assert_eq!(robot.gravity[2], Value::Symbol("g".into()));
    assert_eq!(robot.tool.translation[2], number("0.1"));
    assert_eq!(robot.tool.rotation[2], Angle::Pi(Ratio::new(1, 2)));
    assert_eq!(robot.markers[0].translation.as_ref().unwrap()[1], number("0.1"));
    assert_eq!(
        (robot.markers[1].name.as_str(), &robot.markers[1].translation),
        ("the other", &None)
    );
    let joint = &robot.joints[0];
    assert_eq!(joint.name, "1");
    assert_eq!(joint.com, [Value::Symbol("c1".into()), Value::ZERO, number("0.0254")]);
    assert_eq!(joint.limits, Some([-core::f64::consts::FRAC_PI_2, 2.0]));
    assert_eq!(joint.source.as_deref(), Some("guess"));
    let beam = joint.beam.as_ref().unwrap();
    assert_eq!(beam.shear_modulus, Value::Symbol("G".into()));
    assert_eq!(beam.density, Some(number("2700")));
    let Ok(invocation) = parse(text) else { panic!() };
    assert!(invocation.fused);
    let kernels = invocation.kernels.unwrap();
    assert_eq!(quote::quote!(#kernels).to_string(), ":: stiffarm_kernels");
    let again = Robot::from_toml(&robot.to_toml(), "again").unwrap().0;
    assert_eq!(again.to_toml(), robot.to_toml());
}

#[test]
fn a_load_is_read() {
    let arm = "mod arm; convention: modified_dh; joint | theta\na1 | q";
    let loads =
        "payload: \"5 kg\" com [0, 0, 60 mm], mass 5 kg; payload: part mass 2; carries: part;";
    let robot = read(&arm.replacen(';', &format!("; {loads}"), 1));
    let loads: Vec<_> =
        robot.payloads.iter().map(|load| (load.name.as_str(), &load.mass)).collect();
    assert_eq!(loads, [("5 kg", &number("5")), ("part", &number("2"))]);
    assert_eq!(robot.payloads[0].com[2], number("0.06"));
    assert_eq!(robot.joints[0].mass, Some(number("2")));
}

#[test]
fn a_file_is_named() {
    let text = "#[allow(x)] mod elbow from \"elbow.toml\"; crate: crate::kernels; products: fused;";
    let Ok(invocation) = parse(text) else { panic!() };
    assert!(matches!(&invocation.source, Source::File(file) if file.name.value() == "elbow.toml"));
    assert!(invocation.kernels.is_some() && invocation.fused);
    let text = "mod x; convention: standard_dh; products: separate; joint | theta\na1 | q";
    assert!(matches!(parse(text), Ok(invocation) if !invocation.fused));
}

/// What was read of the head of a table with mistakes.
#[test]
fn a_rejected_module_has_its_head() {
    let Err(rejected) = parse("/// doc\npub mod x; joint") else { panic!() };
    assert_eq!(rejected.module.unwrap(), "x");
    assert!(rejected.vis.is_some());
    assert_eq!(rejected.attrs.len(), 1);
}

#[test]
fn a_table_without_lines_is_read_by_counting() {
    let text = "joint | theta | d | a\na1 | q + pi/2 | 0 | 350 mm\na2 | q | d2 | -5 mm";
    let expected = table(text);
    let stream: proc_macro2::TokenStream =
        format!("mod arm;\nconvention: modified_dh;\n{text}").parse().unwrap();
    let flat = stream.into_iter().map(|mut token| {
        token.set_span(proc_macro2::Span::call_site());
        token
    });
    let Ok(Invocation { source: Source::Table(robot), .. }) = parse_tokens(flat.collect()) else {
        panic!()
    };
    assert_eq!(*robot, expected);
}

#[test]
fn invisible_groups_are_looked_through() {
    use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
    let hidden: TokenStream = "350 mm".parse().unwrap();
    let mut tokens: Vec<TokenTree> =
        "mod arm; convention: modified_dh; joint | theta | a\na1 | q | "
            .parse::<TokenStream>()
            .unwrap()
            .into_iter()
            .collect();
    tokens.push(TokenTree::Group(Group::new(Delimiter::None, hidden)));
    let Ok(Invocation { source: Source::Table(robot), .. }) =
        parse_tokens(tokens.into_iter().collect())
    else {
        panic!()
    };
    assert_eq!(robot.joints[0].a, number("0.35"));
}

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
fn sections_of_beams() {
    for section in [
        "tube(200 mm, 180 mm)",
        "tube(0.2)",
        "box([0.2, 0.1])",
        "box([0.2, 0.1], [0.19, 0.09])",
        "box([0.2, 0.1], [0, 0])",
        "{ area: A, iy: 1 mm^4, iz: I, j: J }",
    ] {
        let beam = format!("{{ youngs_modulus: 1, shear_modulus: 1, section: {section} }}");
        let robot = table(&format!("joint | theta | d | beam\na1 | q | 1 | {beam}"));
        assert!(robot.joints[0].beam.is_some(), "{section}");
    }
}
