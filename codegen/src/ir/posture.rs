//! The posture: sines and cosines of all angles that any function of a module needs, and the displacements
//! of prismatic joints. One struct for all functions, so that a control loop makes it once.

use super::angle::Angle;
use super::term::{Name, Term};
use crate::robot::{Motion, Robot};

/// Fields of the posture: all of them, or what one function needs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Posture {
    pub angles: Vec<Angle>,
    pub plain: Vec<Plain>,
}

/// What is a field as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Plain {
    /// The value of a joint: of a prismatic one its displacement.
    Joint(usize),
    /// From which side a joint came.
    Side(usize),
    /// What all lengths are of those of the table.
    Growth,
}

impl Plain {
    /// The field.
    pub fn field(self) -> Name {
        match self {
            Plain::Joint(joint) => format!("q{}", joint + 1).into(),
            Plain::Side(joint) => format!("side{}", joint + 1).into(),
            Plain::Growth => "growth".into(),
        }
    }

    /// Where it comes from; what all lengths have grown by is worked out.
    pub fn source(self) -> Term {
        match self {
            Plain::Joint(joint) => Term::Entry("q", vec![joint]),
            Plain::Side(joint) => Term::Entry("sides", vec![joint]),
            Plain::Growth => Term::Local(self.field()),
        }
    }

    /// What it is, behind where it comes from.
    pub fn meaning(self, robot: &Robot) -> &'static str {
        match self {
            Plain::Joint(joint) => match robot.joints[joint].motion {
                Motion::Revolute => "rad",
                Motion::Prismatic => "m",
            },
            Plain::Side(_) => "-1, 0 or 1",
            Plain::Growth => "what all lengths are of those of the table",
        }
    }
}

impl Posture {
    /// Takes in what a function needs, and tells what it calls each field that it reads.
    pub fn admit(&mut self, angles: &[Angle], plain: &[Plain]) -> (Posture, Vec<(Name, Name)>) {
        let (mut needed, mut reads) = (Posture::default(), Vec::new());
        for angle in angles {
            let field = Angle { suffix: self.admit_angle(angle), ..angle.clone() };
            reads.extend(angle.needed().zip(field.needed()));
            needed.angles.push(field);
        }
        for &plain in plain {
            self.admit_plain(plain);
            needed.plain.push(plain);
            reads.push((plain.field(), plain.field()));
        }
        (needed, reads)
    }

    fn admit_angle(&mut self, angle: &Angle) -> String {
        if let Some(known) = self.angles.iter_mut().find(|known| known.sum == angle.sum) {
            (known.sine, known.cosine) = (known.sine || angle.sine, known.cosine || angle.cosine);
            return known.suffix.clone();
        }
        let mut suffix = angle.suffix.clone();
        while self.angles.iter().any(|known| known.suffix == suffix) {
            suffix.push('o');
        }
        self.angles.push(Angle { suffix: suffix.clone(), ..angle.clone() });
        suffix
    }

    /// Takes in what is a field as it is.
    pub fn admit_plain(&mut self, plain: Plain) {
        if !self.plain.contains(&plain) {
            self.plain.push(plain);
            self.plain.sort_unstable();
        }
    }

    /// The names of the fields, angle by angle, then what is one as it is.
    pub fn fields(&self) -> Vec<Name> {
        let angles = self.angles.iter().flat_map(Angle::needed);
        angles.chain(self.plain.iter().map(|plain| plain.field())).collect()
    }

    /// Whether joint values enter.
    pub fn reads_joints(&self) -> bool {
        let of_joints = |plain: &Plain| matches!(plain, Plain::Joint(_));
        !self.angles.is_empty() || self.plain.iter().any(of_joints)
    }

    /// Whether an angle has a symbolic offset.
    pub fn reads_constants(&self) -> bool {
        self.angles.iter().any(|angle| angle.sum.any(|leaf| matches!(leaf, Term::Constant(_))))
    }
}
