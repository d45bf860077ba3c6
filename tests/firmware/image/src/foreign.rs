//! The kernels in C.
#![allow(unsafe_code, reason = "C has no other way in")]

use core::ops::Range;

use stiffarm::kernels::Unstable;
use stiffarm_firmware_arms::draw::draw;
use stiffarm_firmware_arms::figures::Counter;
use stiffarm_firmware_arms::outputs::{ARMS, MOVING, OF_MOTION, OUTPUTS};

use crate::Number;

/// The most numbers that an output has, and more.
const LARGEST: usize = 512;

unsafe extern "C" {
    // Writes result number `result` of a draw; how many numbers, or -1: there are none.
    fn stiffarm_c_result(
        result: i32,
        q: *const Number,
        wrench: *const Number,
        out: *mut Number,
    ) -> i32;
    fn stiffarm_c_pose_and_jacobian(q: *const Number, pose: *mut Number, jacobian: *mut Number);
    fn ur5_springs_deflection(q: *const Number, wrench: *const Number, out: *mut Number) -> i32;
    fn ur10_inverse_dynamics(
        q: *const Number,
        qd: *const Number,
        qdd: *const Number,
        out: *mut Number,
    );
    fn ur10_mass_matrix(q: *const Number, out: *mut Number);
}

/// What [`stiffarm_firmware_arms::outputs::visit`] does, in C.
pub fn visit(k: u32, mut see: impl FnMut(Result<&[Number], Unstable>)) {
    let mut first = 0;
    for arm in ARMS {
        match arm {
            "iiwa14" => results::<7>(k, first..first + OUTPUTS, &mut see),
            "various" => results::<5>(k, first..first + OUTPUTS, &mut see),
            _ => results::<6>(k, first..first + OUTPUTS, &mut see),
        }
        first += OUTPUTS;
    }
    for arm in MOVING {
        match arm {
            "panda" => results::<21>(k, first..first + OF_MOTION.len(), &mut see),
            _ => results::<18>(k, first..first + OF_MOTION.len(), &mut see),
        }
        first += OF_MOTION.len();
    }
}

/// Results of an arm whose outputs take `M` numbers of its joints.
fn results<const M: usize>(
    k: u32,
    numbers: Range<usize>,
    see: &mut impl FnMut(Result<&[Number], Unstable>),
) {
    let (q, wrench) = draw::<Number, M>(k);
    for result in numbers {
        let mut out = [0.0; LARGEST];
        // SAFETY: q has what is taken of the arm's joints, the wrench six entries, and no output is larger than
        // `out`: whoever writes the C checks that.
        let count = unsafe {
            stiffarm_c_result(result as i32, q.as_ptr(), wrench.as_ptr(), out.as_mut_ptr())
        };
        let numbers = usize::try_from(count).ok().and_then(|count| out.get(..count));
        see(numbers.ok_or(Unstable));
    }
}

/// A pose as C writes it, and a Jacobian.
type PoseAndJacobian = ([[Number; 3]; 4], [[Number; 6]; 6]);

/// Pose and Jacobian of the UR5-like arm, by one posture.
#[inline(never)]
pub fn c_pose_and_jacobian(q: &[Number; 6], _: &[Number; 6], out: &mut PoseAndJacobian) {
    let (pose, jacobian) = out;
    let (pose, jacobian) = (pose.as_flattened_mut(), jacobian.as_flattened_mut());
    // SAFETY: both have the length that C writes.
    unsafe {
        stiffarm_c_pose_and_jacobian(q.as_ptr(), pose.as_mut_ptr(), jacobian.as_mut_ptr());
    }
}

/// Deflection of the UR5-like arm with K_C, and its 6x6 solve; infinite where there is none.
#[inline(never)]
pub fn c_deflection(q: &[Number; 6], wrench: &[Number; 6], out: &mut [Number; 6]) {
    // SAFETY: all three have the length that C reads and writes.
    let status = unsafe { ur5_springs_deflection(q.as_ptr(), wrench.as_ptr(), out.as_mut_ptr()) };
    if status != 0 {
        *out = [Number::INFINITY; 6];
    }
}

/// Torques of the UR10's motors for a motion: values, rates and accelerations in a row.
#[inline(never)]
pub fn c_inverse_dynamics(state: &[Number; 18], _: &[Number; 6], out: &mut [Number; 6]) {
    let ([q, qd, qdd], _) = state.as_chunks::<6>() else { return };
    // SAFETY: all four have the length that C reads and writes.
    unsafe { ur10_inverse_dynamics(q.as_ptr(), qd.as_ptr(), qdd.as_ptr(), out.as_mut_ptr()) }
}

/// Mass matrix of the UR10.
#[inline(never)]
pub fn c_mass_matrix(q: &[Number; 6], _: &[Number; 6], out: &mut [[Number; 6]; 6]) {
    // SAFETY: both have the length that C reads and writes.
    unsafe { ur10_mass_matrix(q.as_ptr(), out.as_flattened_mut().as_mut_ptr()) }
}

/// Has them counted.
pub fn each(counter: &mut impl Counter<Number>) {
    counter.count("c_pose_and_jacobian", c_pose_and_jacobian, ([[0.0; 3]; 4], [[0.0; 6]; 6]));
    counter.count("c_deflection", c_deflection, [0.0; 6]);
    counter.count("c_inverse_dynamics", c_inverse_dynamics, [0.0; 6]);
    counter.count("c_mass_matrix", c_mass_matrix, [[0.0; 6]; 6]);
}
