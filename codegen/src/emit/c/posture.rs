//! The posture as a struct of C, and the statements that make it.

use super::super::posture::{Plain, Posture};
use super::super::readings::{Extra, Stage};
use super::style::C;
use super::trigonometry::{Pair, declare, take};
use crate::emit::lines::Lines;
use crate::robot::Robot;

/// The struct.
pub(super) fn declaration(
    posture: &Posture,
    out: &mut Lines,
    robot: &Robot,
    (name, real): (&str, &str),
) {
    out.comment(&[
        "The joint values as the kernels need them: sines, cosines, displacements.".to_string()
    ]);
    out.code("typedef struct");
    out.code("{");
    out.indent();
    for pair in &posture.angles {
        out.code(&format!("{real} s{}; /* sine of {} */", pair.suffix, pair.sum));
        out.code(&format!("{real} c{}; /* cosine of {} */", pair.suffix, pair.sum));
    }
    for plain in &posture.plain {
        let (field, source, meaning) = (plain.field(), plain.source(), plain.meaning(robot));
        out.code(&format!("{real} {field}; /* {source}, {meaning} */"));
    }
    out.dedent();
    out.code(&format!("}} {name}_posture_t;"));
}

/// What stands between readings and posture, and how C spells it.
pub(super) struct Entrance<'a> {
    pub stage: &'a Stage,
    pub language: &'a C,
    /// What every name begins with.
    pub name: &'a str,
}

impl Entrance<'_> {
    /// The parameters before all others: readings, and what is given beside them.
    pub fn parameters(&self) -> String {
        let (real, upper) = (self.language.real(), self.name.to_uppercase());
        let extra = |extra: Extra| match extra {
            Extra::Sides => format!(", const {real} {}[{upper}_JOINTS]", extra.name()),
            Extra::Warming => format!(", {real} {}", extra.name()),
        };
        let extras: String = self.stage.extras().into_iter().map(extra).collect();
        format!("const {real} {}[{upper}_JOINTS]{extras}", self.readings())
    }

    /// What the readings are called: `q` where they are the joint values.
    fn readings(&self) -> &'static str {
        if self.stage.moves { "readings" } else { "q" }
    }

    /// Statements that make every field.
    pub fn statements(&self, out: &mut Lines, posture: &Posture) {
        let of_joints = |plain: &Plain| matches!(plain, Plain::Joint(_));
        let reads_joints = !posture.angles.is_empty() || posture.plain.iter().any(of_joints);
        let mut unread: Vec<Extra> = self.stage.extras();
        if self.stage.moves && reads_joints {
            let extras = unread.drain(..).map(|extra| format!(", {}", extra.name()));
            let extras: String = extras.collect();
            let (real, upper) = (self.language.real(), self.name.to_uppercase());
            out.code(&format!("{real} q[{upper}_JOINTS];"));
            out.blank();
            out.code(&format!("{}_joints({}{extras}, q);", self.name, self.readings()));
        } else if !reads_joints {
            out.code(&format!("(void){};", self.readings()));
        }
        let reads = |extra: &Extra, plain: &Plain| match plain {
            Plain::Joint(_) => false,
            Plain::Side(_) => *extra == Extra::Sides,
            Plain::Growth => *extra == Extra::Warming,
        };
        for extra in unread.iter().filter(|e| !posture.plain.iter().any(|plain| reads(e, plain))) {
            out.code(&format!("(void){};", extra.name()));
        }
        let pairs = posture.angles.iter().map(|pair| Pair {
            angle: pair.sum.clone(),
            sine: Some(format!("posture->s{}", pair.suffix)),
            cosine: Some(format!("posture->c{}", pair.suffix)),
        });
        take(out, self.language, &pairs.collect::<Vec<_>>());
        for plain in &posture.plain {
            let source = match plain {
                Plain::Growth => self.stage.growth(self.language),
                plain => plain.source(),
            };
            out.code(&format!("posture->{} = {source};", plain.field()));
        }
    }

    /// The head of the function from readings to joint values.
    pub fn joints_head(&self) -> String {
        let (real, upper) = (self.language.real(), self.name.to_uppercase());
        let parameters = self.parameters().replacen("readings", "q", 1);
        format!("void {}_joints({parameters}, {real} out[{upper}_JOINTS])", self.name)
    }

    /// The function itself.
    pub fn joints(&self, out: &mut Lines) {
        let stage = self.stage;
        out.blank();
        out.code(&self.joints_head());
        out.braces(|out| {
            for extra in stage.extras().into_iter().filter(|extra| !stage.reads(*extra)) {
                out.code(&format!("(void){};", extra.name()));
            }
            let values = stage.readings.joints.iter();
            let values: Vec<String> =
                values.map(|value| stage.print(*value, self.language)).collect();
            let wanted = |name: String| {
                let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
                let mut words = values.iter().flat_map(|text| text.split(|c| !is_word(c)));
                words.any(|word| word == name).then_some(name)
            };
            let pairs = stage.angles().into_iter().map(|angle| Pair {
                angle: stage.print(angle, self.language),
                sine: wanted(format!("s{}", stage.suffix(angle))),
                cosine: wanted(format!("c{}", stage.suffix(angle))),
            });
            declare(out, self.language, &pairs.collect::<Vec<_>>());
            for (joint, value) in values.iter().enumerate() {
                out.code(&format!("out[{joint}] = {value};"));
            }
        });
    }
}
