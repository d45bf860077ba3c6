//! What the schema says of one field, and where in the model its value stands.

use crate::robot::{
    Angle, Beam, Convention, Dimension, Effect, Frame, Joint, Marker, Motion, NamedFrame, Payload,
    Robot, Section, Value,
};

/// One field of a `T`.
pub(crate) struct Field<T> {
    /// Its key.
    pub name: &'static str,
    /// What it is for.
    pub says: &'static str,
    /// What its numbers measure.
    pub unit: Unit,
    /// The least that its number may be.
    pub bound: Bound,
    /// What stands in its place where it is absent.
    pub absent: Absent,
    /// Why no parameter may stand in it; `None` if one may.
    pub number: Option<&'static str>,
    /// The word that says that it is absent.
    pub word: Option<&'static str>,
    /// When a value is written that is there without being told.
    pub written: fn(&T) -> bool,
    /// Its place in the model.
    pub slot: for<'m> fn(&'m mut T) -> Slot<'m>,
}

/// What the numbers of a field measure.
#[derive(Clone, Copy)]
pub(crate) enum Unit {
    /// There are none.
    None,
    /// The same whatever the joint.
    Is(Dimension),
    /// By the motion of the joint.
    By(fn(Motion) -> Dimension),
}

/// What a number may be, as the subject of a sentence, and how to mend it.
#[derive(Clone, Copy)]
pub(crate) enum Bound {
    /// Anything.
    None,
    /// Above zero.
    Above(&'static str, &'static str),
    /// Zero or above.
    NotBelow(&'static str),
}

/// What an absent field means.
#[derive(Clone, Copy)]
pub(crate) enum Absent {
    /// A mistake, and how to mend it.
    Mistake(&'static str),
    /// A default, in words.
    Default(&'static str),
}

/// The place of a field in the model, which is also what a file holds for it.
pub(crate) enum Slot<'m> {
    Text(&'m mut String),
    MaybeText(&'m mut Option<String>),
    Convention(&'m mut Convention),
    Motion(&'m mut Motion),
    Side(&'m mut Option<&'static str>),
    Angle(&'m mut Angle),
    Value(&'m mut Value),
    Maybe(&'m mut Option<Value>),
    Vector(&'m mut [Value; 3]),
    MaybeVector(&'m mut Option<[Value; 3]>),
    Tensor(&'m mut Option<[Value; 6]>),
    /// A rotation vector.
    Rotation(&'m mut [Angle; 3]),
    Limits(&'m mut Option<[f64; 2]>, Motion),
    /// A row from 0, told by its number from 1 or its name.
    Row(&'m mut usize),
    Section(&'m mut Section),
    Beam(&'m mut Option<Beam>),
    /// A frame, its fields, and the name of its table.
    Frame(&'m mut Frame, &'static [Field<Frame>], &'static str),
    Joints(&'m mut Vec<Joint>),
    Frames(&'m mut Vec<NamedFrame>),
    Markers(&'m mut Vec<Marker>),
    Effects(&'m mut Vec<Effect>),
    Payloads(&'m mut Vec<Payload>),
    /// What is generated.
    Outputs(&'m mut Robot),
    /// The name of a payload, which the model holds as a part of its last link.
    Carries,
}

impl<T> Field<T> {
    /// A field that may be absent and holds no number, until more is said.
    pub const fn new(
        name: &'static str,
        says: &'static str,
        slot: for<'m> fn(&'m mut T) -> Slot<'m>,
    ) -> Self {
        Field {
            name,
            says,
            unit: Unit::None,
            bound: Bound::None,
            absent: Absent::Default("none"),
            number: None,
            word: None,
            written: |_| false,
            slot,
        }
    }

    /// What its numbers measure.
    pub const fn of(self, dimension: Dimension) -> Self {
        Field { unit: Unit::Is(dimension), ..self }
    }

    /// What its numbers measure, by the motion of the joint.
    pub const fn by(self, dimension: fn(Motion) -> Dimension) -> Self {
        Field { unit: Unit::By(dimension), ..self }
    }

    /// A number above zero.
    pub const fn above_zero(self, subject: &'static str, help: &'static str) -> Self {
        Field { bound: Bound::Above(subject, help), ..self }
    }

    /// A number that is not below zero.
    pub const fn not_negative(self, subject: &'static str) -> Self {
        Field { bound: Bound::NotBelow(subject), ..self }
    }

    /// A field that must be there.
    pub const fn needed(self, help: &'static str) -> Self {
        Field { absent: Absent::Mistake(help), ..self }
    }

    /// What its absence means.
    pub const fn or(self, default: &'static str) -> Self {
        Field { absent: Absent::Default(default), ..self }
    }

    /// A field in which no parameter may stand, and why.
    pub const fn number(self, reason: &'static str) -> Self {
        Field { number: Some(reason), ..self }
    }

    /// A word that says that it is absent.
    pub const fn word(self, word: &'static str) -> Self {
        Field { word: Some(word), ..self }
    }

    /// A field that is written whatever its value.
    pub const fn always(self) -> Self {
        Field { written: |_| true, ..self }
    }

    /// A field that is written whatever its value, in some models.
    pub const fn always_if(self, written: fn(&T) -> bool) -> Self {
        Field { written, ..self }
    }

    /// What its numbers measure; `None` where that depends on a motion that is not known.
    pub fn dimension(&self, motion: Option<Motion>) -> Option<Dimension> {
        match self.unit {
            Unit::None => None,
            Unit::Is(dimension) => Some(dimension),
            Unit::By(by) => motion.map(by),
        }
    }
}

/// The keys of a table.
pub(crate) fn keys<T>(fields: &[Field<T>]) -> Vec<&'static str> {
    fields.iter().map(|field| field.name).collect()
}
