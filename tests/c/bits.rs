//! Bit for bit: what C computes against what the Rust kernels compute.

use core::fmt::{Debug, LowerHex};

use stiffarm::kernels::{Motion, Scalar};
use stiffarm_codegen::emit::{Precision, Sines};
use stiffarm_draws::{Draws, few_or_many};

use crate::arms::{Arm, build, doubles, robot, singles};
use crate::compiler::{Folder, compile, optimised, run, with_each_compiler};

with_each_compiler! {
    doubles_are_the_rust_kernels_bits
    singles_are_the_rust_kernels_bits
    as_many_lanes_as_there_are_have_the_same_bits
    the_widest_registers_are_taken_on_amds_cores_alone
    a_reference_that_was_tampered_with_is_found
}

/// A number that has bits.
pub trait Bits: Scalar + Into<f64> + Debug + PartialEq + 'static {
    type Word: LowerHex + Copy;
    const PRECISION: Precision;
    fn word(self) -> Self::Word;
    fn read(hex: &str) -> Self;
    fn same(self, other: Self) -> bool;
}

macro_rules! bits {
    ($float:ty, $word:ty, $precision:expr) => {
        impl Bits for $float {
            type Word = $word;
            const PRECISION: Precision = $precision;
            fn word(self) -> $word {
                self.to_bits()
            }
            fn read(hex: &str) -> Self {
                <$float>::from_bits(<$word>::from_str_radix(hex, 16).expect("bits in hex"))
            }
            /// Which NaN it is is nobody's business.
            fn same(self, other: Self) -> bool {
                self.to_bits() == other.to_bits() || self.is_nan() && other.is_nan()
            }
        }
    };
}

bits!(f64, u64, Precision::F64);
bits!(f32, u32, Precision::F32);

/// A draw: joint values, what stands behind them, and a wrench.
type Draw<S> = (Vec<S>, [S; 6]);

/// Postures within ±3 rad, a few up to ±100 rad; loads up to 100 N, a few that no arm bears, some of which have
/// squares that single precision has not; an angle beyond all reason, and one that is none.
fn draws<S: Scalar>(n: usize) -> Vec<Draw<S>> {
    let mut draws = Draws::new(1);
    let mut unit = move || draws.unit();
    let mut each = |k: usize| {
        let turn = if k % 10 == 7 { 100.0 } else { 3.0 };
        let load = match k % 25 {
            3 => 1e9,
            13 => 1e30,
            _ => 100.0,
        };
        let mut q: Vec<f64> = (0..n).map(|_| turn * unit()).collect();
        match k {
            0 => q.fill(0.0),
            1 => q[0] = 1e12,
            2 => q[0] = f64::INFINITY,
            3 => q[n - 1] = f64::NAN,
            _ => {}
        }
        q.extend((0..2 * n).map(|_| 5.0 * unit()));
        (q.into_iter().map(S::lit).collect(), core::array::from_fn(|_| S::lit(load * unit())))
    };
    (0..few_or_many(75, 250)).map(&mut each).collect()
}

/// What C says to each draw: the outputs in the order of [`Arm::outputs`].
fn by_c<S: Bits>(
    folder: &Folder,
    id: &str,
    draws: &[Draw<S>],
    outputs: usize,
) -> Vec<Vec<Option<Vec<S>>>> {
    let line = |(q, wrench): &Draw<S>| {
        let words = q.iter().chain(wrench).map(|x| format!("{:x}", x.word()));
        words.collect::<Vec<_>>().join(" ") + "\n"
    };
    let text = run(folder, id, &draws.iter().map(line).collect::<String>());
    let read = |line: &str| {
        let (status, bits) = line.split_once(' ').unwrap_or((line, ""));
        (status == "0").then(|| bits.split_whitespace().map(S::read).collect())
    };
    let lines: Vec<Option<Vec<S>>> = text.lines().map(read).collect();
    assert_eq!(lines.len(), draws.len() * outputs, "{id}: a line for every output of every draw");
    lines.chunks(outputs).map(<[_]>::to_vec).collect()
}

/// The first output that is not the same.
fn difference<S: Bits>(
    expected: &[Vec<Option<Vec<S>>>],
    found: &[Vec<Option<Vec<S>>>],
) -> Option<String> {
    for (draw, (expected, found)) in expected.iter().zip(found).enumerate() {
        for (output, (expected, found)) in expected.iter().zip(found).enumerate() {
            let same = match (expected, found) {
                (None, None) => true,
                (Some(a), Some(b)) => {
                    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.same(*b))
                }
                _ => false,
            };
            if !same {
                return Some(format!("draw {draw}, output {output}: {expected:?} {found:?}"));
            }
        }
    }
    None
}

fn expected<S: Bits>(arm: &Arm<S>, draws: &[Draw<S>]) -> Vec<Vec<Option<Vec<S>>>> {
    draws.iter().map(|(q, wrench)| arm.outputs(q, wrench)).collect()
}

fn check<S: Bits>(compiler: &str, arms: &[Arm<S>], flags: &[&str]) {
    for arm in arms {
        let name = format!("{compiler}-{}-{:?}{}", arm.id, S::PRECISION, flags.concat());
        let folder = Folder::new(&name);
        build(compiler, &folder, arm, S::PRECISION, flags);
        let draws = draws::<S>(arm.kernels.dof());
        let expected = expected(arm, &draws);
        // Of the first draws the angles are none.
        let refused = expected.iter().skip(4).flatten().filter(|out| out.is_none()).count();
        assert_eq!(refused == 0, arm.is_rigid(), "{name}");
        assert!(refused < draws.len(), "{name}: {refused} loads are not borne");
        let found = by_c(&folder, arm.id, &draws, expected[0].len());
        assert_eq!(difference(&expected, &found), None, "{name}");
    }
}

fn doubles_are_the_rust_kernels_bits(compiler: &str) {
    check(compiler, &doubles(), &[optimised()]);
}

fn singles_are_the_rust_kernels_bits(compiler: &str) {
    check(compiler, &singles(), &[optimised()]);
}

/// One number at a time, and the registers beyond those that the target has anyway.
fn as_many_lanes_as_there_are_have_the_same_bits(compiler: &str) {
    let own = if cfg!(target_arch = "aarch64") { "-U__aarch64__" } else { "-U__SSE2__" };
    let mut widths = vec![vec![own]];
    #[cfg(target_arch = "x86_64")]
    {
        widths.extend(std::is_x86_feature_detected!("avx2").then(|| vec!["-mavx2"]));
        widths.extend(std::is_x86_feature_detected!("avx512f").then(|| WIDEST[1..].to_vec()));
    }
    // Sums of angles, seven of them, and angles that only readings and inputs have.
    let is_one = |id: &str| ["ur10", "iiwa14", "corrected"].contains(&id);
    let (mut doubles, mut singles) = (doubles(), singles());
    doubles.retain(|arm| is_one(arm.id));
    singles.retain(|arm| is_one(arm.id));
    for mut width in widths {
        width.push(optimised());
        check(compiler, &doubles, &width);
        check(compiler, &singles, &width);
    }
}

/// A core with 512 bits that is not Intel's.
const WIDEST: [&str; 3] = ["-O2", "-mavx512f", "-msse4a"];

/// Intel's cores close a port to the algebra around the sines while an instruction on 512 bits waits.
fn the_widest_registers_are_taken_on_amds_cores_alone(compiler: &str) {
    if cfg!(not(target_arch = "x86_64")) {
        return;
    }
    let folder = Folder::new(&format!("{compiler}-registers"));
    folder.write_c(&robot("ur10"), "ur10", (Precision::F64, Sines::Polynomial));
    for (flags, wide) in [(&WIDEST[..], true), (&["-O2", "-march=skylake-avx512"], false)] {
        compile(compiler, &folder, &[flags, &["-S", "ur10.c"]].concat());
        let text = std::fs::read_to_string(folder.path().join("ur10.s")).expect("assembler");
        assert_eq!(text.contains("%zmm"), wide, "{flags:?}");
    }
}

fn a_reference_that_was_tampered_with_is_found(compiler: &str) {
    let arms = doubles();
    let arm = arms.first().expect("an arm");
    let folder = Folder::new(&format!("tampered-{compiler}"));
    build(compiler, &folder, arm, Precision::F64, &["-O0"]);
    let draws = draws::<f64>(arm.kernels.dof());
    let mut expected = expected(arm, &draws);
    let found = by_c(&folder, arm.id, &draws, expected[0].len());
    assert_eq!(difference(&expected, &found), None);
    // The last bit of one number of one output of one draw.
    let number = &mut expected[draws.len() - 1][2].as_mut().expect("a Jacobian")[1];
    *number = f64::from_bits(number.to_bits() ^ 1);
    let told = difference(&expected, &found).expect("a difference");
    assert!(told.starts_with(&format!("draw {}, output 2:", draws.len() - 1)), "{told}");
}

/// Arms in a plane and in space, one that slides, some that give.
#[test]
fn the_arms_are_of_every_kind() {
    let arms = doubles();
    let slides = |arm: &&Arm<f64>| arm.rows.iter().any(|row| row.motion == Motion::Prismatic);
    assert!(arms.iter().filter(slides).count() >= 4);
    assert!(arms.iter().filter(|arm| !arm.is_rigid()).count() >= 4);
    assert!(arms.iter().map(|arm| arm.id).eq(singles().iter().map(|arm| arm.id)));
}
