//! The kernels in C.
#![allow(unsafe_code, reason = "C has no other way in")]

use stiffarm::kernels::Unstable;
use stiffarm_firmware_arms::draw::draw;
use stiffarm_firmware_arms::figures::Counter;
use stiffarm_firmware_arms::outputs::{ARMS, OUTPUTS};

use crate::Number;

/// The most numbers that an output has, and more.
const LARGEST: usize = 256;

unsafe extern "C" {
    // Writes an output of an arm, both by their numbers; how many numbers, or -1: unstable.
    fn stiffarm_c_output(
        arm: i32,
        output: i32,
        q: *const Number,
        wrench: *const Number,
        out: *mut Number,
    ) -> i32;
    fn stiffarm_c_pose_and_jacobian(q: *const Number, pose: *mut Number, jacobian: *mut Number);
    fn ur5_springs_deflection(q: *const Number, wrench: *const Number, out: *mut Number) -> i32;
}

/// What [`stiffarm_firmware_arms::outputs::visit`] does, in C.
pub fn visit(k: u32, mut see: impl FnMut(Result<&[Number], Unstable>)) {
    for arm in 0..ARMS.len() {
        match ARMS.get(arm) {
            Some(&"iiwa14") => visit_arm::<7>(k, arm, &mut see),
            Some(&"various") => visit_arm::<5>(k, arm, &mut see),
            _ => visit_arm::<6>(k, arm, &mut see),
        }
    }
}

fn visit_arm<const N: usize>(
    k: u32,
    arm: usize,
    see: &mut impl FnMut(Result<&[Number], Unstable>),
) {
    let (q, wrench) = draw::<Number, N>(k);
    for output in 0..OUTPUTS {
        let mut out = [0.0; LARGEST];
        // SAFETY: q has the arm's joints, the wrench six entries, and no output is larger than
        // `out`: whoever writes the C checks that.
        let count = unsafe {
            stiffarm_c_output(
                arm as i32,
                output as i32,
                q.as_ptr(),
                wrench.as_ptr(),
                out.as_mut_ptr(),
            )
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

/// Has both counted.
pub fn each(counter: &mut impl Counter<Number>) {
    counter.count("c_pose_and_jacobian", c_pose_and_jacobian, ([[0.0; 3]; 4], [[0.0; 6]; 6]));
    counter.count("c_deflection", c_deflection, [0.0; 6]);
}
