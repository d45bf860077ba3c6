//! The kernels in C, compiled for the Cortex-M4F.

use std::fs;
use std::path::{Path, PathBuf};

use stiffarm::kernels::Output;
use stiffarm_codegen::emit::{COptions, Precision, Sines, c};
use stiffarm_codegen::robot::Robot;
use stiffarm_firmware_arms::outputs::{ARMS, EACH};

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
        "various" => include_str!("../../../c/arm.toml"),
        _ => return Err(format!("no robot file for the arm {arm}")),
    })
}

/// Writes and compiles the kernels of every arm, and what the image calls them through.
///
/// # Errors
/// What the compiler says.
pub fn objects(tools: &Tools, contraction: Contraction) -> Result<Vec<PathBuf>, Failure> {
    let (folder, contraction) = match contraction {
        Contraction::Off => ("c", "-ffp-contract=off"),
        Contraction::Fast => ("c-contracted", "-ffp-contract=fast"),
    };
    let folder = tools.target.join(folder);
    fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut names: Vec<String> = Vec::new();
    let mut sizes = Vec::new();
    for arm in ARMS {
        let robot = Robot::from_toml(toml(arm)?, arm).map_err(|e| format!("{arm}: {e:?}"))?.0;
        let name = arm.to_owned();
        let options = COptions { name, precision: Precision::F32, sines: Sines::Polynomial };
        let files = c(&robot, &options).map_err(|e| e.to_string())?;
        write(&folder.join(format!("{arm}.h")), &files.header)?;
        write(&folder.join(format!("{arm}.c")), &files.source)?;
        names.push(arm.to_owned());
        sizes.push((arm, robot.dof()));
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

/// C that calls an output by the numbers of the arm and the output.
fn calls(arms: &[(&str, usize)]) -> String {
    let (mut includes, mut cases) = (String::new(), String::new());
    for (index, (arm, n)) in arms.iter().enumerate() {
        includes.push_str(&format!("#include \"{arm}.h\"\n"));
        for (k, output) in Output::EACH.into_iter().enumerate().take(EACH) {
            let (rows, columns) = output.shape(*n);
            let beside: String = output.beside().map(|i| format!("{}, ", i.name())).collect();
            let call = format!("{arm}_{}(q, {beside}out)", output.name());
            let call = match output.is_fallible() {
                true => format!("count = ((int){call} == 0) ? {} : -1;", rows * columns),
                false => format!("{call};\n        count = {};", rows * columns),
            };
            cases.push_str(&format!(
                "    case {}:\n        {call}\n        break;\n",
                32 * index + k
            ));
        }
        for (k, output) in Output::ALL.into_iter().enumerate() {
            let (rows, columns) = output.shape(*n);
            cases.push_str(&format!(
                "    case {}:
        if ((int){arm}_all(q, wrench, &{arm}_everything) == 0)
        {{
            count = copy({arm}_everything.{}, {}, out);
        }}
        break;
",
                32 * index + EACH + k,
                output.name(),
                rows * columns
            ));
        }
    }
    let everything: String =
        arms.iter().map(|(arm, _)| format!("static {arm}_all_t {arm}_everything;\n")).collect();
    format!(
        "{includes}
int stiffarm_c_output(int arm, int output, const float *q, const float *wrench, float *out);
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

int stiffarm_c_output(int arm, int output, const float *q, const float *wrench, float *out)
{{
    int count = -1;

    switch ((32 * arm) + output)
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
