//! The head, the settings, and the input as a whole.

use num_rational::Ratio;

use super::*;
use crate::robot::{Angle, Convention};

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
    let Ok(invocation) = parse(text) else { panic!("{:?}", errors(text)) };
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
        marker: smr1 [0, 100 mm, z * 0];
        marker: \"the other\";
        crate: ::stiffarm_kernels;
        products: fused;
        joint | stiffness | theta | mass | com           | limits        | source   | beam
        1     | k1        | q     | 12   | [c1, 0, 1 in] | [-90 deg, 2]  | \"guess\" | {
            youngs_modulus: 69 GPa, shear_modulus: G, density: 2700,
            section: tube(200 mm, 180 mm), shear_coefficient: 0.5,
        }";
    // A marker's place is numbers only; the beam's row has no length.
    assert_eq!(
        errors(text),
        [
            "7:34 `z*0` is an expression: a cell holds one number or one parameter | \
             work it out, or take the sign and the factors into the parameter",
            "12:86 a beam of no length: `a` and `d` of this joint are both zero | \
             put the beam on the joint whose row has the link's length"
        ]
    );
    let text = text
        .replace("z * 0", "0")
        .replace("| beam", "| beam | a")
        .replace("\n        }", "} | 1 m");
    let robot = read(&text);
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
    let Ok(invocation) = parse(&text) else { panic!() };
    assert!(invocation.fused);
    let kernels = invocation.kernels.unwrap();
    assert_eq!(quote::quote!(#kernels).to_string(), ":: stiffarm_kernels");
    let again = Robot::from_toml(&robot.to_toml(), "again").unwrap().0;
    assert_eq!(again.to_toml(), robot.to_toml());
}

#[test]
fn a_load_is_read() {
    let arm = "mod arm; convention: modified_dh; joint | theta\na1 | q";
    let with = |settings: &str| arm.replacen(';', &format!("; {settings}"), 1);
    let robot = read(&with(
        "payload: \"5 kg\" com [0, 0, 60 mm], mass 5 kg; payload: part mass 2; carries: part;",
    ));
    let loads: Vec<_> =
        robot.payloads.iter().map(|load| (load.name.as_str(), &load.mass)).collect();
    assert_eq!(loads, [("5 kg", &number("5")), ("part", &number("2"))]);
    assert_eq!(robot.payloads[0].com[2], number("0.06"));
    assert_eq!(robot.joints[0].mass, Some(number("2")));
    let expected = "`name mass 1.2 kg, com [x, y, z], inertia [xx, xy, xz, yy, yz, zz]` is expected here, \
                    the last two if wanted";
    assert_eq!(errors(&with("payload: part;")), [format!("1:19 {expected}")]);
    assert_eq!(errors(&with("payload: part mas 2;")), [format!("1:24 {expected}")]);
    assert_eq!(
        errors(&with("payload: part mass m;")),
        [
            "1:29 `m` stands where a number is expected | a payload is weighed, not chosen: write numbers"
        ]
    );
    assert_eq!(
        errors(&with("payload: part mass 2; carries: parts;")),
        ["1:41 `parts` is no payload of this robot | did you mean `part`?"]
    );
}

#[test]
fn a_file_is_named() {
    let text = "#[allow(x)] mod elbow from \"elbow.toml\"; crate: crate::kernels; products: fused;";
    let Ok(invocation) = parse(text) else { panic!() };
    assert!(matches!(&invocation.source, Source::File(file) if file.name.value() == "elbow.toml"));
    assert!(invocation.kernels.is_some() && invocation.fused);
    assert_eq!(
        errors("mod elbow from \"elbow.toml\"; name: \"x\"; joint | theta"),
        [
            "1:30 `name` belongs into the robot file | \
             beside a file only `carries`, `crate`, `outputs` and `products` can be set",
            "1:41 a table and a robot file: one of them is enough"
        ]
    );
}

#[test]
fn mistakes_of_the_head() {
    let expected = "expected `mod name;` or `mod name from \"robot.toml\";`";
    assert_eq!(errors(""), [format!("1:1 {expected}")]);
    assert_eq!(errors("pub struct X;"), [format!("1:5 {expected}")]);
    assert_eq!(errors("mod 3;"), ["1:5 expected a name for the module"]);
    assert_eq!(errors("mod x y"), ["1:7 expected `;`, or `from` and the name of a robot file"]);
    assert_eq!(errors("mod x {}"), ["1:7 expected `;`, or `from` and the name of a robot file"]);
    assert_eq!(errors("mod x from y;"), ["1:12 expected the name of a robot file in quotes"]);
    assert_eq!(errors("mod x from \"y\""), ["1:1 expected `;`"]);
    assert_eq!(
        errors("mod x;"),
        [
            "1:5 the table is missing | for example `joint | theta | d | a | alpha | stiffness`",
            "1:5 `convention` is missing | \
             write `convention: standard_dh;` or `convention: modified_dh;`"
        ]
    );
    let Err(rejected) = parse("/// doc\npub mod x; joint") else { panic!() };
    assert_eq!(rejected.module.unwrap(), "x");
    assert!(rejected.vis.is_some());
    assert_eq!(rejected.attrs.len(), 1);
}

#[test]
fn mistakes_of_the_settings() {
    let settings = |text: &str| errors(&format!("mod x;\n{text}\njoint | theta\na1 | q"));
    let with = |text: &str| settings(&format!("convention: standard_dh;\n{text}"));
    assert_eq!(
        settings("convetion: standard_dh;"),
        ["2:1 unknown setting `convetion` | did you mean `convention`?"]
    );
    assert_eq!(
        settings("convention: standart_dh;"),
        ["2:13 `standard_dh` or `modified_dh` is expected here | did you mean `standard_dh`?"]
    );
    assert_eq!(
        settings("convention: 3;"),
        ["2:13 `standard_dh` or `modified_dh` is expected here"]
    );
    assert_eq!(settings("convention: standard_dh"), ["2:13 expected `;` behind this setting"]);
    let setting = "a setting such as `convention: modified_dh;`, or the table's header \
                   `joint | theta | …`, is expected here";
    assert_eq!(with("gravity [0, 0, 1];"), [format!("3:1 {setting}")]);
    assert_eq!(with(";"), [format!("3:1 {setting}")]);
    assert_eq!(with("convention: standard_dh;"), ["3:1 duplicate setting `convention`"]);
    assert!(with("outputs: ;")[0].starts_with("3:1 the name of an output is expected here"));
    assert_eq!(with("outputs: pose, poze;"), ["3:16 `poze` is no output | did you mean `pose`?"]);
    assert_eq!(with("name: arm;"), ["3:7 a text in quotes is expected here"]);
    assert_eq!(with("gravity: 9.81;"), ["3:10 [x, y, z] is expected here"]);
    assert_eq!(with("gravity: [0, 1];"), ["3:10 a list of 2 where [x, y, z] is expected"]);
    assert_eq!(
        with("gravity: [0, 0, 5 mm];"),
        ["3:17 `5 mm` is a length; an acceleration is expected here (e.g. `9.80665 m/s^2`)"]
    );
    let products = "`fused` or `separate` is expected here";
    assert_eq!(with("products: plain;"), [format!("3:11 {products}")]);
    assert_eq!(with("products: fuse;"), [format!("3:11 {products} | did you mean `fused`?")]);
    assert_eq!(with("products: ;"), [format!("3:1 {products}")]);
    assert_eq!(with("fused;"), [format!("3:1 {setting}")]);
    let text = "mod x; convention: standard_dh; products: separate; joint | theta\na1 | q";
    assert!(matches!(parse(text), Ok(invocation) if !invocation.fused));
    assert_eq!(
        with("crate: 3;"),
        ["3:8 the path of the kernels' crate is expected here | \
          for example `crate: ::stiffarm::kernels;`"]
    );
    let tool = "`translation [x, y, z]` or `rotation [rx, ry, rz]` is expected here";
    assert_eq!(with("tool: [0, 0, 1];"), [format!("3:7 {tool}")]);
    assert_eq!(with("tool: ;"), [format!("3:1 {tool}")]);
    assert_eq!(
        with("tool: rotaton [0, 0, 1];"),
        [format!("3:7 {tool} | did you mean `rotation`?")]
    );
    assert_eq!(
        with("tool: rotation [0, 0, 1] rotation [0, 0, 1];"),
        [format!("3:26 {tool} | each part stands once")]
    );
    assert_eq!(
        with("tool: rotation [0, 0, r];"),
        ["3:23 `r` stands where a number is expected | a frame's rotation cannot stay symbolic"]
    );
    assert_eq!(with("marker: [0, 0, 1];"), ["3:9 `name` or `name [x, y, z]` is expected here"]);
    assert_eq!(
        with("marker: m [0, 0, z];"),
        ["3:18 `z` stands where a number is expected | \
          leave the place out where a marker's place is unknown"]
    );
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
fn mistakes_become_compile_errors() {
    let Err(rejected) = parse("mod x;") else { panic!() };
    let text = rejected.to_compile_errors().to_string();
    assert_eq!(text.matches("compile_error").count(), 2);
    assert!(text.contains("the table is missing\\nhelp: for example"), "{text}");
}
