//! The text as CUDA C: run on the processor, a thread after the other, and compiled for a GPU.

use std::fmt::Write as _;
use std::process::Command;

use stiffarm::kernels::{Output, Side};
use stiffarm_codegen::emit::{CudaOptions, Precision, cuda};
use stiffarm_codegen::robot::Robot;

use crate::batch::{Batch, Case, level};
use crate::compiler::{CUDA, Folder, compile, run};

/// What of CUDA the text uses, for a GPU's compiler without CUDA's headers and libraries.
const DECLARATIONS: &str = "
#define __global__ __attribute__((global))
#define __device__ __attribute__((device))
struct index { unsigned int x; };
#define threadIdx (index{(unsigned int)__nvvm_read_ptx_sreg_tid_x()})
#define blockIdx (index{(unsigned int)__nvvm_read_ptx_sreg_ctaid_x()})
#define blockDim (index{(unsigned int)__nvvm_read_ptx_sreg_ntid_x()})
extern \"C\" {
__device__ void sincos(double, double *, double *);
__device__ double sin(double);
__device__ double cos(double);
__device__ double sqrt(double);
}
";

/// For every arm the answers to all questions.
pub fn answers(batch: &Batch) -> Vec<Vec<String>> {
    batch.cases.iter().map(|case| of(case, batch.seed)).collect()
}

fn text(robot: &Robot) -> String {
    let options = CudaOptions { name: "arm".to_owned(), precision: Precision::F64 };
    cuda(robot, &options).expect("numbers only")
}

fn of(case: &Case, seed: u64) -> Vec<String> {
    let robot = case.table.numeric();
    let folder = Folder::new(&format!("cuda-{seed}-{}", case.name));
    folder.write("arm.cu", &text(&robot));
    folder.write("main.c", &main(&robot, case.questions.len()));
    compile("cc", &folder, &[level(seed), "main.c", "-o", "arm", "-lm"]);
    run(&folder, "arm", &case.input()).lines().map(str::to_owned).collect()
}

/// A program that computes all questions by one launch of each kernel.
fn main(robot: &Robot, count: usize) -> String {
    let n = robot.dof();
    let sizes = |output: &Output| output.shape(n).0 * output.shape(n).1;
    let (mut arrays, mut calls, mut prints) = (String::new(), String::new(), String::new());
    let single = |output: &Output| output.name().to_owned();
    let fused = |output: &Output| format!("all_{}", output.name());
    let outputs = robot.generated();
    let every = outputs.iter().map(|output| (single(output), output));
    let every = every.chain(Output::ALL.iter().map(|output| (fused(output), output)));
    for (name, output) in every {
        let size = sizes(output);
        let status = match (output.is_fallible(), name.starts_with("all_")) {
            (false, _) => "0",
            (true, true) => "status_all[i]",
            (true, false) => &format!("status_{name}[i]"),
        };
        let _ = writeln!(arrays, "static double out_{name}[{size} * COUNT];");
        let _ = writeln!(arrays, "static unsigned char status_{name}[COUNT];");
        let _ = writeln!(prints, "        (void)status_{name};");
        let _ = writeln!(prints, "        put({status}, out_{name} + i, {size}U);");
    }
    for output in &outputs {
        let beside = output.beside().enumerate().map(|(k, input)| match input.side() {
            Side::Joints => format!(", x + {} * COUNT", (k + 1) * n),
            _ => format!(", x + {} * COUNT", 3 * n),
        });
        let (name, beside) = (output.name(), beside.collect::<String>());
        let status = if output.is_fallible() { format!(", status_{name}") } else { String::new() };
        let _ =
            writeln!(calls, "    LAUNCH(arm_{name}_batch(COUNT, x{beside}, out_{name}{status}));");
    }
    let all: String = Output::ALL.iter().map(|o| format!(", out_all_{}", o.name())).collect();
    format!(
        "{CUDA}#define COUNT {count}U
#include \"arm.cu\"
{arrays}static unsigned char status_all[COUNT];

static void put(int status, const double *x, unsigned int size)
{{
    unsigned int k;

    (void)printf(\"%d\", status);
    for (k = 0U; (status == 0) && (k < size); k++)
    {{
        uint64_t bits;
        (void)memcpy(&bits, &x[k * COUNT], sizeof bits);
        (void)printf(\" %\" PRIx64, bits);
    }}
    (void)printf(\"\\n\");
}}

int main(void)
{{
    static double x[{state} * COUNT];
    unsigned int i;
    unsigned int k;

    blockDim.x = 3U;
    for (i = 0U; i < COUNT; i++)
    {{
        for (k = 0U; k < {state}U; k++)
        {{
            uint64_t bits = 0U;
            if (scanf(\"%\" SCNx64, &bits) != 1)
            {{
                return 1;
            }}
            (void)memcpy(&x[k * COUNT + i], &bits, sizeof bits);
        }}
    }}
{calls}    LAUNCH(arm_all_batch(COUNT, x, x + {wrench} * COUNT{all}, status_all));
    for (i = 0U; i < COUNT; i++)
    {{
{prints}    }}
    return 0;
}}
",
        state = 3 * n + 6,
        wrench = 3 * n,
    )
}

/// Compiles every arm for a GPU.
///
/// # Errors
/// What the compiler says, or that a kernel is not in what it gives.
pub fn assembled(batch: &Batch) -> Result<(), String> {
    for case in &batch.cases {
        let folder = Folder::new(&format!("ptx-{}-{}", batch.seed, case.name));
        let robot = case.table.numeric();
        folder.write("arm.cu", &format!("{DECLARATIONS}{}", text(&robot)));
        let mut clang = Command::new("clang");
        clang.args(["-x", "cuda", "--cuda-device-only", "--cuda-gpu-arch=sm_70", "-nocudainc"]);
        clang.args(["-nocudalib", "-O2", "-Wall", "-Werror", "-Wno-unknown-cuda-version", "-S"]);
        clang.args(["arm.cu", "-o", "arm.ptx"]).current_dir(folder.path());
        let output = clang.output().map_err(|error| error.to_string())?;
        if !output.status.success() {
            return Err(String::from_utf8_lossy(&output.stderr).into_owned());
        }
        let found = std::fs::read_to_string(folder.path().join("arm.ptx"));
        let found = found.map_err(|error| error.to_string())?;
        for output in robot.generated() {
            let entry = format!(".entry arm_{}_batch(", output.name());
            if !found.contains(&entry) {
                return Err(format!("{}: no `{entry}` in the assembly", case.name));
            }
        }
    }
    Ok(())
}
