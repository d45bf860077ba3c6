//! What the joints of an arm can do, and readings that are beyond it.

use core::f64::consts::PI;

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Joint};

use crate::io::shown;
use crate::measurement::MOST_RADIANS;

/// Joint values beyond what the joints can do, of a campaign or a log.
pub fn beyond<I: Iterator<Item = f64>>(
    arm: &Arm,
    file: &str,
    readings: impl Fn(usize) -> I,
) -> Option<String> {
    let limits = |joint: &Joint| match (joint.limits, joint.motion) {
        (Some(limits), _) => limits,
        (None, Motion::Revolute) => [-MOST_RADIANS, MOST_RADIANS],
        (None, Motion::Prismatic) => [f64::NEG_INFINITY, f64::INFINITY],
    };
    let limits: Vec<[f64; 2]> = arm.joints.iter().map(limits).collect();
    // Half a degree beyond is how a limit was rounded.
    let inside = |j: usize, q: f64| limits[j][0] - 0.01 <= q && q <= limits[j][1] + 0.01;
    // In more than half of the rows.
    let most = |j: usize, is: &dyn Fn(f64) -> bool| {
        let (those, all) =
            readings(j).fold((0, 0), |(n, all), q| (n + usize::from(is(q)), all + 1));
        2 * those > all
    };
    let beyond: Vec<usize> = (0..arm.dof()).filter(|&j| most(j, &|q| !inside(j, q))).collect();
    let farthest = |j: usize| readings(j).fold(0.0, |far: f64, q| far.max(q.abs()));
    let first = *beyond.first()?;
    let names: Vec<String> = beyond.iter().map(|j| format!("q{}", j + 1)).collect();
    let largest = beyond.iter().map(|&j| farthest(j)).fold(0.0, f64::max);
    let in_other = |j: usize| {
        let factor = match arm.joints[j].motion {
            Motion::Revolute => PI / 180.0,
            Motion::Prismatic => 1e-3,
        };
        most(j, &|q| inside(j, factor * q))
    };
    let (unit, other, written) = match arm.joints[first].motion {
        Motion::Revolute => ("rad", "degrees", "deg"),
        Motion::Prismatic => ("m", "millimetres", "mm"),
    };
    let name = &names[0];
    let help = if beyond.iter().all(|&j| in_other(j)) {
        format!("are they in {other}? write {name}[{written}]")
    } else {
        "is it another robot's file, or are its limits not this arm's?".to_owned()
    };
    Some(format!(
        "{file}: {} {} {} {unit}, beyond the limits of the joint in most rows: {help}",
        names.join(", "),
        if names.len() == 1 { "reaches" } else { "reach" },
        shown(largest)
    ))
}
