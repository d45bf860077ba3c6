//! Orientations that are no rotation vectors but three turns.

use nalgebra::UnitQuaternion;
use stiffarm_kernels::generic::Arm;

use super::{simulated, spread};
use crate::constants::{ALL_BY_FRAMES, FEWEST_POSES, LARGE_ANGLE};
use crate::gap::rms;
use crate::infer::limits::ROUNDING;
use crate::io::Convention;
use crate::io::shown;
use crate::measurement::{Kind, Measurements, Row};
use crate::simulate::Reading;

/// A doubt where the tool turns otherwise from pose to pose than the arm does, and whether it does not if
/// the numbers are three turns.
pub(super) fn orientations(arm: &Arm, data: &Measurements) -> Option<String> {
    if data.kind != (Kind::Pose { orientation: true }) || data.poses < FEWEST_POSES {
        return None;
    }
    // Of a plan nothing is measured.
    if data.rows.iter().all(|row| row.measured.fixed_rows::<3>(3).amax() == 0.0) {
        return None;
    }
    let rows = spread(data).filter_map(|(_, row)| Some((simulated(arm, data, 6, row)?, row)));
    let rows: Vec<(Reading, &Row)> = rows.collect();
    let pairs = || rows.windows(2).filter(|pair| pair[0].1.session == pair[1].1.session);
    let off = |convention: Convention| {
        let turned = |row: &Row| {
            let [x, y, z] = [3, 4, 5].map(|k| row.measured[k]);
            let vector = convention.rotation(&convention.ordered([x, y, z]));
            vector.map(UnitQuaternion::from_scaled_axis)
        };
        let of_pair = |pair: &[(Reading, &Row)]| {
            let measured = turned(pair[0].1)?.angle_to(&turned(pair[1].1)?);
            Some(measured - pair[0].0.rotation.angle_to(&pair[1].0.rotation))
        };
        let all: Vec<f64> = pairs().filter_map(of_pair).collect();
        rms(&all)
    };
    let as_it_is = off(Convention::RotationVector);
    if as_it_is <= LARGE_ANGLE {
        return None;
    }
    let tried: Vec<(f64, Convention)> = Convention::turns().map(|c| (off(c), c)).collect();
    let least = tried.iter().map(|(off, _)| *off).fold(f64::INFINITY, f64::min);
    // Turns about the tool's axes are those about the base's in the other order, up to rounding.
    let (_, best) = tried.into_iter().find(|(off, _)| *off <= least + ROUNDING)?;
    let says = if 1.0 - (least / as_it_is).powi(2) > ALL_BY_FRAMES {
        let formula = best.formula(&best.ordered(["rx", "ry", "rz"]));
        format!(
            "read as {formula} by {} rad: are rx, ry, rz three turns? write `# orientation = {best}` \
             above the header",
            shown(least)
        )
    } else {
        "and no order of three turns explains it: do rx, ry, rz, or the readings, mean what the file \
         says?"
            .to_owned()
    };
    Some(format!(
        "{}: from pose to pose the tool turns otherwise than the arm by {} rad; {says}",
        data.file,
        shown(as_it_is)
    ))
}
