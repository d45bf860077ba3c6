//! What the build script writes down, and the tests ask again.

use stiffarm_codegen::program::{Formulas, Term, quaternion, roll_pitch_yaw};

/// Where a camera on the tool should have seen a marker, and did: what a hand-eye calibration makes small.
pub fn hand_eye(f: &Formulas<'_>) {
    let mount = f.vector("mount", "m", "the camera's origin in the tool's frame");
    let turned = f.vector(
        "turned",
        "1",
        "quaternion w, x, y, z that turns the tool's axes into the camera's",
    );
    let focal = f.vector::<2>("focal", "px", "focal lengths along the image's columns and rows");
    let centre = f.vector::<2>("centre", "px", "where the optical axis meets the image");
    let marker = f.vector("marker", "m", "the marker, base axes");
    let seen = f.vector::<2>("seen", "px", "where the image shows it");

    let (shift, turn) = (f.variation(), f.variation());
    let camera = f.tool().then(mount, quaternion(turned)).displaced(shift, turn);
    let [x, y, depth] = f.coordinates(f.base().point(marker), camera);
    let image = [x / depth, y / depth];
    let residual = [0, 1].map(|k| focal[k] * image[k] + centre[k] - seen[k]);

    let by: Vec<Term<'_>> = shift.into_iter().chain(turn).collect();
    f.result(
        "residual",
        "px",
        "Where the camera should see the marker, less where it does",
        residual,
    );
    f.result(
        "jacobian",
        "px/m, then px/rad",
        "Change of the residual per displacement of the camera along and rotation about its own axes",
        f.derivatives(&residual, &by),
    );
}

/// How far a corner of the tool is from a plane, and which way the joints change it.
pub fn clearance(f: &Formulas<'_>) {
    let corner = f.vector("corner", "m", "the corner in the tool's frame");
    let normal = f.vector("normal", "1", "the plane's normal, of length 1, base axes");
    let height = f.scalar("height", "m", "the plane's distance from the base along its normal");

    let base = f.base();
    let place = f.lever(base.origin(), f.tool().point(corner));
    let distance = base.vector(normal).dot(place) - height;

    f.result(
        "distance",
        "m",
        "Distance of the corner from the plane, positive on the normal's side",
        distance,
    );
    f.result("gradient", "m/rad", "Its change by each joint", f.gradient(distance, &f.joints()));
}

/// How high the tool is when the arm stands on a vehicle that rolls and pitches.
pub fn height(f: &Formulas<'_>) {
    let attitude = f.vector::<2>("attitude", "rad", "roll and pitch of the base on its vehicle");

    let [roll, pitch] = attitude;
    // The world's up in base axes is the third row of the turn.
    let up = roll_pitch_yaw([roll, pitch, f.number(0.0)]).map(|axis| axis[2]);
    let base = f.base();
    let height = base.vector(up).dot(f.lever(base.origin(), f.tool().origin()));

    f.result("height", "m", "Height of the tool above the base", height);
    f.result("by_attitude", "m/rad", "Its change by roll and pitch", f.gradient(height, &attitude));
    f.result("by_joints", "m/rad", "Its change by each joint", f.gradient(height, &f.joints()));
}
