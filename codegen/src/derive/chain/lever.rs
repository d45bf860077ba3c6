//! Levers: vectors between points of the chain, as sums of its translations from the tip inwards.

use super::layout::Chain;
use super::mass::masses;
use crate::expr::{Expr, Graph, Twist, Vec3, parallel3};

/// One translation: `length · axis` in the working frame.
#[derive(Clone, Copy, Debug)]
struct Segment {
    /// Place along the chain: `2s + 1` for step `s`, `2s` for something fixed before step `s`.
    at: usize,
    length: Expr,
    axis: Vec3,
}

/// Translations in the order in which they are summed.
///
/// A moment about a joint's axis does not feel what is parallel to it, so such translations are left out of
/// a joint's lever. They are sorted behind the translations inside their run of parallel joints: then the
/// levers of all joints of the run are prefixes of one sum, and are shared.
#[derive(Clone, Debug)]
pub struct Levers {
    segments: Vec<Segment>,
    /// What every lever begins with.
    beyond: Vec3,
}

/// A point from which a lever is taken.
#[derive(Clone, Copy, Debug)]
pub enum Point {
    /// The frame before a step.
    Boundary(usize),
    /// The frame in which a step takes place, the step itself included.
    Step(usize),
}

impl Point {
    fn place(self) -> usize {
        match self {
            Point::Boundary(s) => 2 * s,
            Point::Step(s) => 2 * s + 1,
        }
    }
}

impl Levers {
    /// The translations of the chain up to the tool origin.
    pub fn to_tool(chain: &mut Chain) -> Levers {
        let end = chain.steps().len();
        let offsets = tool_offsets(chain);
        Levers::to(chain, end, &offsets, [Expr::ZERO; 3])
    }

    /// The translations before boundary `cut`, continued by `beyond` from there on.
    pub fn inside(chain: &mut Chain, cut: usize, beyond: Vec3) -> Levers {
        Levers::to(chain, cut, &[], beyond)
    }

    /// The translations before boundary `cut`, those of `offsets` there, and what is `beyond`.
    pub fn to(chain: &mut Chain, cut: usize, offsets: &[(Expr, Vec3)], beyond: Vec3) -> Levers {
        let mut segments = translations(chain, |_, _, length| length);
        segments.retain(|segment| segment.at < 2 * cut);
        let fixed = offsets.iter().map(|&(length, axis)| Segment { at: 2 * cut, length, axis });
        segments.extend(fixed);
        Levers { beyond, ..Levers::sorted(chain, segments) }
    }

    /// First moments of mass: each translation weighted by the mass beyond it, and the masses' own offsets.
    pub fn of_mass(chain: &mut Chain) -> Levers {
        let points = masses(chain);
        let mut segments = translations(chain, |g, s, length| {
            let mass = points.iter().fold(Expr::ZERO, |sum, point| {
                let share = point.share_beyond(g, s);
                g.add(sum, share)
            });
            g.mul(mass, length)
        });
        for point in points {
            let axes = chain.axes(point.boundary);
            for (offset, axis) in point.com.into_iter().zip(axes) {
                let length = chain.g.mul(point.mass, offset);
                segments.push(Segment { at: 2 * point.boundary, length, axis });
            }
        }
        Levers::sorted(chain, segments)
    }

    fn sorted(chain: &Chain, mut segments: Vec<Segment>) -> Levers {
        segments.retain(|segment| !segment.length.is_zero());
        let joints: Vec<(usize, Vec3)> =
            (0..chain.dof()).map(|j| (2 * chain.joint_step(j) + 1, chain.joint_axis(j))).collect();
        let reach = |segment: &Segment| {
            let inner = joints.iter().rev().skip_while(|(at, _)| *at > segment.at);
            let run = inner.take_while(|(_, axis)| parallel3(*axis, segment.axis));
            run.last().map_or(segment.at, |(at, _)| *at)
        };
        segments.sort_by_key(|s| core::cmp::Reverse((reach(s), s.at)));
        Levers { segments, beyond: [Expr::ZERO; 3] }
    }

    /// The sum of all translations beyond `from`, without those along `except`.
    pub fn lever(&self, g: &mut Graph, from: Point, except: Option<Vec3>) -> Vec3 {
        self.extended(g, from, &[], except)
    }

    /// What a turn about an axis at `from`, or a slide along it, does at the levers' end.
    pub fn twist(&self, g: &mut Graph, from: Point, axis: Vec3, turns: bool) -> Twist {
        if !turns {
            return (axis, [Expr::ZERO; 3]);
        }
        let lever = self.lever(g, from, Some(axis));
        (g.cross3(axis, lever), axis)
    }

    /// The same as [`lever`](Levers::lever), continued inwards by further translations.
    pub fn extended(
        &self,
        g: &mut Graph,
        from: Point,
        inwards: &[(Expr, Vec3)],
        except: Option<Vec3>,
    ) -> Vec3 {
        let outer = self.segments.iter().filter(|s| s.at >= from.place());
        let translations = outer.map(|s| (s.length, s.axis)).chain(inwards.iter().copied());
        let mut sum = self.beyond;
        let mut pending: Option<(Expr, Vec3)> = None;
        for (length, axis) in translations {
            if length.is_zero() || except.is_some_and(|z| parallel3(z, axis)) {
                continue;
            }
            // Neighbours along one axis are added as lengths before they are turned.
            pending = match pending {
                Some((before, along)) if parallel3(along, axis) => {
                    let sign = if along == axis { length } else { -length };
                    Some((g.add(before, sign), along))
                }
                Some(done) => {
                    sum = accumulate(g, sum, done);
                    Some((length, axis))
                }
                None => Some((length, axis)),
            };
        }
        pending.map_or(sum, |last| accumulate(g, sum, last))
    }
}

/// The tool's translation along the axes of the last frame.
pub fn tool_offsets(chain: &mut Chain) -> [(Expr, Vec3); 3] {
    let axes = chain.axes(chain.steps().len());
    let lengths = chain.tool_lengths();
    core::array::from_fn(|k| (lengths[k], axes[k]))
}

fn accumulate(g: &mut Graph, sum: Vec3, (length, axis): (Expr, Vec3)) -> Vec3 {
    let part = g.scale3(length, axis);
    g.add3(sum, part)
}

/// The translations of the chain, each length as `weigh` makes it of the step and the plain length.
fn translations(
    chain: &mut Chain,
    mut weigh: impl FnMut(&mut Graph, usize, Expr) -> Expr,
) -> Vec<Segment> {
    let mut segments = Vec::new();
    for s in 0..chain.steps().len() {
        let Some((length, axis)) = chain.translation(s) else { continue };
        let length = weigh(&mut chain.g, s, length);
        segments.push(Segment { at: 2 * s + 1, length, axis });
    }
    segments
}
