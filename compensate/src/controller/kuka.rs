//! KUKA's `$machine.dat`: the zeros of the axes.
//!
//! `$MAMES[i]` is the reading in degrees (mm of an axis that slides) that an axis is given where it is mastered, at its
//! mechanical zero (KUKA Roboter GmbH, *KR C2: Machine Data*, 2.1.7). An axis whose zero is off by `δ` stands there at
//! `$MAMES[i] + δ`. The new value acts when the axis is mastered again.

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::ControllerError;
use crate::program::{Change, edited, entries};

/// Degrees to which a zero is written: 0.2 µrad.
const DECIMALS: usize = 5;

/// The file with `$MAMES` of each axis moved by what its zero is off, and a remark above them; every other byte is as it
/// was.
///
/// # Errors
/// [`ControllerError`]: an axis without `$MAMES`, or a value that is no number.
pub fn mastering(
    file: &[u8],
    nominal: &Arm,
    real: &Arm,
    remark: Option<&str>,
) -> Result<Vec<u8>, ControllerError> {
    let found = entries(file, "$mames");
    let mut changes: Vec<Change> = Vec::new();
    let first = found.iter().filter_map(|entry| entry.value.as_ref()).map(|cell| cell.span.start);
    if let (Some(remark), Some(first)) = (remark, first.min()) {
        let start = file[..first].iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
        let end = if file[..start].ends_with(b"\r\n") { "\r\n" } else { "\n" };
        changes.push(Change { span: start..start, text: format!("; {remark}{end}") });
    }
    for (k, (was, is)) in nominal.joints.iter().zip(&real.joints).enumerate() {
        let off = match is.motion {
            Motion::Revolute => (is.theta - was.theta).to_degrees(),
            Motion::Prismatic => 1e3 * (is.d - was.d),
        };
        if off == 0.0 {
            continue;
        }
        let index = (k + 1).to_string();
        let entry = found.iter().find(|entry| entry.index == index).ok_or_else(|| {
            ControllerError::Missing(format!("$MAMES[{index}]"), "the machine data of this robot")
        })?;
        let cell = entry.value.as_ref().ok_or_else(|| ControllerError::Entry {
            line: entry.line,
            found: entry.text.clone(),
            expected: "a number of degrees or mm",
        })?;
        let text = format!("{:.DECIMALS$}", cell.value + off);
        changes.push(Change { span: cell.span.clone(), text });
    }
    Ok(edited(file, changes))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::springy;

    #[test]
    fn mastering_values_are_moved() {
        let nominal = springy();
        let mut real = nominal.clone();
        real.joints[1].theta += 0.25_f64.to_radians();
        let file = b"&PARAM X\n$MAMES[1]=0.0 ;MAMES[2]=7\n  $MAMES[2] = -90.0 ; \xe4\n$TORQ=1\n";
        let made = mastering(file, &nominal, &real, None).unwrap();
        let expected =
            b"&PARAM X\n$MAMES[1]=0.0 ;MAMES[2]=7\n  $MAMES[2] = -89.75000 ; \xe4\n$TORQ=1\n";
        assert_eq!(made, expected);
        let remarked = mastering(b"A\r\n$MAMES[1]=0\r\n$MAMES[2]=1", &nominal, &real, Some("lost"));
        assert_eq!(remarked.unwrap(), b"A\r\n; lost\r\n$MAMES[1]=0\r\n$MAMES[2]=1.25000");
        let error = mastering(b"$MAMES[1]=0\n", &nominal, &real, None).unwrap_err();
        assert_eq!(
            error.to_string(),
            "found no `$MAMES[2]`, expected the machine data of this robot"
        );
        let error = mastering(b"\n$MAMES[2]=X+1\n", &nominal, &real, None).unwrap_err();
        assert_eq!(error.to_string(), "line 2: found `X+1`, expected a number of degrees or mm");
    }
}
