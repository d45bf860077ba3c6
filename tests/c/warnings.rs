//! Every arm of the collection compiles without a warning, in every form.

use stiffarm_codegen::emit::{COptions, Precision, Sines, c};
use stiffarm_robots::ARMS;

use crate::arms::robot;
use crate::compiler::{Folder, compile, run, tried, with_each_compiler};

with_each_compiler! {
    every_arm_compiles_without_a_warning
    a_warning_is_found
    a_pair_that_does_not_belong_together_is_refused
    the_library_s_sines_give_the_same_pose
}

const PRECISIONS: [Precision; 2] = [Precision::F64, Precision::F32];
const SINES: [Sines; 3] = [Sines::Polynomial, Sines::Math, Sines::Given];

/// Each arm in one form, or every fifth.
fn every_arm_compiles_without_a_warning(compiler: &str) {
    let folder = Folder::new(&format!("warnings-{compiler}"));
    for (k, arm) in ARMS.iter().enumerate().step_by(stiffarm_draws::few_or_many(5, 1)) {
        compiles_without_a_warning(compiler, &folder, arm.id, (PRECISIONS[k % 2], SINES[k % 3]));
    }
}

#[test]
#[ignore = "six forms of every arm by cc and by clang take minutes"]
fn every_form_of_every_arm_compiles_without_a_warning() {
    let folder = Folder::new("forms");
    let forms = PRECISIONS.map(|precision| SINES.map(|sines| (precision, sines)));
    for compiler in ["cc", "clang"] {
        for arm in ARMS {
            for form in forms.as_flattened() {
                compiles_without_a_warning(compiler, &folder, arm.id, *form);
            }
        }
    }
}

fn compiles_without_a_warning(compiler: &str, folder: &Folder, id: &str, form: (Precision, Sines)) {
    folder.write_c(&robot(id), id, form);
    compile(compiler, folder, &["-O1", "-Wmissing-prototypes", "-c", &format!("{id}.c")]);
}

/// A warning is an error: the same call refuses a text that has one.
fn a_warning_is_found(compiler: &str) {
    let folder = Folder::new(&format!("warned-{compiler}"));
    folder.write("bad.c", "float f(double x);\nfloat f(double x) { return x; }\n");
    let said = tried(compiler, &folder, &["-c", "bad.c"]).expect_err("a loss of digits");
    assert!(said.contains("conversion"), "{said}");
}

/// A source of one table with the header of another is refused by the compiler itself.
fn a_pair_that_does_not_belong_together_is_refused(compiler: &str) {
    let folder = Folder::new(&format!("pair-{compiler}"));
    folder.write_c(&robot("ur10"), "arm", (Precision::F64, Sines::Given));
    let options =
        COptions { name: "arm".to_owned(), precision: Precision::F64, sines: Sines::Given };
    folder.write("arm.h", &c(&robot("ur5"), &options).expect("numbers only").header);
    let said = tried(compiler, &folder, &["-c", "arm.c"]).expect_err("two tables");
    assert!(said.contains("different tables"), "{said}");
}

/// `math.h`'s sines and the polynomial's: the pose differs by a few units of rounding.
fn the_library_s_sines_give_the_same_pose(compiler: &str) {
    let folder = Folder::new(&format!("math-{compiler}"));
    let robot = robot("ur5");
    for (name, sines) in [("own", Sines::Polynomial), ("library", Sines::Math)] {
        folder.write_c(&robot, name, (Precision::F64, sines));
    }
    folder.write(
        "main.c",
        "#include <stdio.h>
#include \"library.h\"
#include \"own.h\"

int main(void)
{
    const double q[6] = {0.3, -1.2, 2.1, 0.7, -2.9, 1.1};
    double a[12];
    double b[12];
    int k;

    own_pose(q, a);
    library_pose(q, b);
    for (k = 0; k < 12; k++)
    {
        (void)printf(\"%.17g %.17g\\n\", a[k], b[k]);
    }
    return 0;
}
",
    );
    compile(compiler, &folder, &["-O2", "main.c", "own.c", "library.c", "-lm", "-o", "both"]);
    let text = run(&folder, "both", "");
    assert_eq!(text.lines().count(), 12);
    for line in text.lines() {
        let (a, b) = line.split_once(' ').expect("two numbers");
        let (a, b): (f64, f64) = (a.parse().expect("a number"), b.parse().expect("a number"));
        assert!((a - b).abs() < 4e-15, "{line}");
    }
}
