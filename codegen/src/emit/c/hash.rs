//! What a text is recognised by: FNV-1a, 64 bits.
//!
//! Against accidents, not against forgery: for that, keep the reviewed text and compare it.

use crate::robot::Robot;

/// FNV-1a of the bytes (Fowler, Noll & Vo): a number that any engineer can recompute in six lines.
pub(super) fn fnv1a(bytes: &[u8]) -> u64 {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, step)
}

/// A table as text, and its hash.
pub(super) struct Table {
    pub text: String,
    pub hash: u64,
}

/// The table as a robot file, without what no kernel depends on: sources, limits, frames and markers at which nothing is asked for.
pub(super) fn table(robot: &Robot) -> Table {
    let mut robot = robot.clone();
    let asked: Vec<String> = robot.places().iter().map(|(name, _)| (*name).to_owned()).collect();
    robot.markers.retain(|marker| asked.contains(&marker.name));
    robot.frames.retain(|frame| asked.contains(&frame.name));
    for joint in &mut robot.joints {
        joint.source = None;
        joint.limits = None;
    }
    let text = robot.to_toml();
    let hash = fnv1a(text.as_bytes());
    Table { text, hash }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_vectors() {
        assert_eq!(fnv1a(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv1a(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv1a(b"foobar"), 0x8594_4171_f739_67e8);
    }
}
