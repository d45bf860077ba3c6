//! The kernels in C, compiled for the Cortex-M4F.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use stiffarm::kernels::{Input, Output};
use stiffarm_codegen::emit::{COptions, Precision, Sines, c};
use stiffarm_codegen::robot::Robot;
use stiffarm_firmware_arms::outputs::{ARMS, EACH, MOVING, OF_MOTION};

use crate::Failure;
use crate::tools::{Tools, succeed};

/// Whether products and sums may be contracted into one operation, which rounds once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contraction {
    /// As the kernels ask for: every operation rounds, as in Rust.
    Off,
    /// As gcc does of its own: the bits are others.
    Fast,
}

/// What the C is compiled with.
const FLAGS: [&str; 13] = [
    "-std=c99",
    "-O2",
    "-ffreestanding",
    "-ffunction-sections",
    "-mthumb",
    "-mcpu=cortex-m4",
    "-mfloat-abi=hard",
    "-mfpu=fpv4-sp-d16",
    "-Wall",
    "-Wextra",
    "-pedantic",
    "-Wconversion",
    "-Werror",
];

/// The robot file of an arm.
fn toml(arm: &str) -> Result<&'static str, Failure> {
    Ok(match arm {
        "ur10" => include_str!("../../../../robots/arms/ur10.toml"),
        "kuka_kr240" => include_str!("../../../../robots/arms/kuka_kr240.toml"),
        "iiwa14" => include_str!("../../../../robots/arms/iiwa14.toml"),
        "ur5_springs" => include_str!("../../arms/ur5_springs.toml"),
        "panda" => include_str!("../../../../robots/arms/panda.toml"),
        "various" => include_str!("../../../c/arm.toml"),
        _ => return Err(format!("no robot file for the arm {arm}")),
    })
}

/// Writes and compiles the kernels of every arm, and what the image calls them through.
pub fn objects(tools: &Tools, contraction: Contraction) -> Result<Vec<PathBuf>, Failure> {
    let (folder, contraction) = match contraction {
        Contraction::Off => ("c", "-ffp-contract=off"),
        Contraction::Fast => ("c-contracted", "-ffp-contract=fast"),
    };
    let folder = tools.target.join(folder);
    fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut names: Vec<String> = Vec::new();
    let mut sizes = BTreeMap::new();
    for arm in ARMS.into_iter().chain(MOVING) {
        if sizes.contains_key(arm) {
            continue;
        }
        let mut robot = Robot::from_toml(toml(arm)?, arm).map_err(|e| format!("{arm}: {e:?}"))?.0;
        if MOVING.contains(&arm) {
            // What is generated on request, too.
            let mut outputs = robot.generated();
            outputs
                .extend(OF_MOTION.into_iter().filter(|output| !robot.generated().contains(output)));
            robot.outputs = outputs;
        }
        let name = arm.to_owned();
        let options = COptions { name, precision: Precision::F32, sines: Sines::Polynomial };
        let files = c(&robot, &options).map_err(|e| e.to_string())?;
        write(&folder.join(format!("{arm}.h")), &files.header)?;
        write(&folder.join(format!("{arm}.c")), &files.source)?;
        names.push(arm.to_owned());
        sizes.insert(arm, robot.dof());
    }
    write(&folder.join("calls.c"), &calls(&sizes))?;
    names.push("calls".to_owned());
    let compiled = |name: String| {
        let mut gcc = tools.command("arm-none-eabi-gcc");
        let object = folder.join(format!("{name}.o"));
        gcc.args(FLAGS)
            .args([contraction, "-c"])
            .arg(folder.join(format!("{name}.c")))
            .arg("-o")
            .arg(&object);
        succeed(gcc).map(|_| object)
    };
    names.into_iter().map(compiled).collect()
}

fn write(path: &Path, text: &str) -> Result<(), Failure> {
    fs::write(path, text).map_err(|e| format!("{}: {e}", path.display()))
}

/// C that calls the results of a draw by their numbers, for arms of so many joints.
fn calls(sizes: &BTreeMap<&str, usize>) -> String {
    let includes: String = sizes.keys().map(|arm| format!("#include \"{arm}.h\"\n")).collect();
    let everything: String =
        ARMS.iter().map(|arm| format!("static {arm}_all_t {arm}_everything;\n")).collect();
    let mut each = Vec::new();
    for arm in ARMS {
        each.extend(Output::EACH.iter().take(EACH).map(|output| one(arm, *output, sizes[arm])));
        each.extend(Output::ALL.map(|output| one_of_all(arm, output, sizes[arm])));
    }
    for arm in MOVING {
        each.extend(OF_MOTION.map(|output| one(arm, output, sizes[arm])));
    }
    let case = |(k, call)| format!("    case {k}:\n{call}        break;\n");
    let cases: String = each.into_iter().enumerate().map(case).collect();
    format!(
        "{includes}
int stiffarm_c_result(int result, const float *q, const float *wrench, float *out);
void stiffarm_c_pose_and_jacobian(const float *q, float *pose, float *jacobian);

{everything}
static int copy(const float *from, int count, float *to)
{{
    int k;

    for (k = 0; k < count; k++)
    {{
        to[k] = from[k];
    }}
    return count;
}}

int stiffarm_c_result(int result, const float *q, const float *wrench, float *out)
{{
    int count = -1;

    switch (result)
    {{
{cases}    default:
        break;
    }}
    return count;
}}

void stiffarm_c_pose_and_jacobian(const float *q, float *pose, float *jacobian)
{{
    ur5_springs_posture_t posture;

    ur5_springs_posture(q, &posture);
    ur5_springs_given_pose(&posture, pose);
    ur5_springs_given_jacobian(&posture, jacobian);
}}
"
    )
}

/// Calls an output of an arm of `n` joints, which finds what it takes of them behind `q`.
fn one(arm: &str, output: Output, n: usize) -> String {
    let (rows, columns) = output.shape(n);
    let beside = output.beside().map(|input| match input {
        Input::Rates => format!("q + {n}, "),
        Input::Accelerations | Input::Torques => format!("q + {}, ", 2 * n),
        _ => format!("{}, ", input.name()),
    });
    let call = format!("{arm}_{}(q, {}out)", output.name(), beside.collect::<String>());
    let count = rows * columns;
    match output.is_fallible() {
        true => format!("        count = ((int){call} == 0) ? {count} : -1;\n"),
        false => format!("        {call};\n        count = {count};\n"),
    }
}

/// Calls the function that computes several, and takes one of them.
fn one_of_all(arm: &str, output: Output, n: usize) -> String {
    let (rows, columns) = output.shape(n);
    format!(
        "        if ((int){arm}_all(q, wrench, &{arm}_everything) == 0)
        {{
            count = copy({arm}_everything.{}, {}, out);
        }}
",
        output.name(),
        rows * columns
    )
}
