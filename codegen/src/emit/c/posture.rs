//! The posture as a struct of C, and the statements that make it.

use super::Module;
use super::trigonometry::{Pair, declare, take};
use crate::emit::lines::Lines;
use crate::ir::{Extra, Plain, Posture};

/// The struct.
pub(super) fn declaration(module: &Module, out: &mut Lines) {
    let (name, real) = (module.name(), module.language.real());
    let print = |term: &crate::ir::Term| term.print(&module.language);
    out.comment(&[
        "The joint values as the kernels need them: sines, cosines, displacements.".to_string()
    ]);
    out.code("typedef struct");
    out.within("{", &format!("}} {name}_posture_t;"), |out| {
        for angle in &module.ir.posture.angles {
            let (suffix, sum) = (&angle.suffix, print(&angle.sum));
            out.code(&format!("{real} s{suffix}; /* sine of {sum} */"));
            out.code(&format!("{real} c{suffix}; /* cosine of {sum} */"));
        }
        for plain in &module.ir.posture.plain {
            let meaning = plain.meaning(module.ir.robot);
            let (field, source) = (plain.field(), print(&plain.source()));
            out.code(&format!("{real} {field}; /* {source}, {meaning} */"));
        }
    });
}

impl Module<'_> {
    /// The parameters before all others: readings, and what is given beside them.
    pub fn parameters(&self) -> String {
        let (real, upper) = (self.language.real(), self.name().to_uppercase());
        let extra = |extra: &Extra| match extra {
            Extra::Sides => format!(", const {real} {}[{upper}_JOINTS]", extra.name()),
            Extra::Warming => format!(", {real} {}", extra.name()),
        };
        let extras: String = self.ir.readings.extras.iter().map(extra).collect();
        format!("const {real} {}[{upper}_JOINTS]{extras}", self.readings())
    }

    /// What the readings are called: `q` where they are the joint values.
    fn readings(&self) -> &'static str {
        if self.ir.readings.moves { "readings" } else { "q" }
    }

    /// Statements that make every field of a posture, of readings.
    pub fn make_posture(&self, out: &mut Lines, posture: &Posture) {
        self.fields(out, posture, true);
    }

    /// The same of readings, or of the joint values that these mean.
    pub fn fields(&self, out: &mut Lines, posture: &Posture, of_readings: bool) {
        let readings = &self.ir.readings;
        let mut unread: Vec<Extra> = readings.extras.clone();
        if of_readings && readings.moves && posture.reads_joints() {
            unread.clear();
            let extras = readings.handed_on();
            let (real, upper) = (self.language.real(), self.name().to_uppercase());
            out.code(&format!("{real} q[{upper}_JOINTS];"));
            out.blank();
            out.code(&format!("{}_joints({}{extras}, q);", self.name(), self.readings()));
        } else if !posture.reads_joints() {
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
        let pairs = posture.angles.iter().map(|angle| Pair {
            angle: angle.sum.print(&self.language),
            sine: Some(format!("posture->s{}", angle.suffix)),
            cosine: Some(format!("posture->c{}", angle.suffix)),
        });
        take(out, &self.language, &pairs.collect::<Vec<_>>());
        for plain in &posture.plain {
            let source = if *plain == Plain::Growth { &readings.growth } else { &plain.source() };
            out.code(&format!("posture->{} = {};", plain.field(), source.print(&self.language)));
        }
    }

    /// The head of the function that makes the posture.
    pub fn posture_head(&self) -> String {
        let (name, parameters) = (self.name(), self.parameters());
        format!(
            "{}void {name}_posture({parameters}, {name}_posture_t *posture)",
            self.language.linkage()
        )
    }

    /// The head of the function from readings to joint values.
    pub fn joints_head(&self) -> String {
        let (real, upper) = (self.language.real(), self.name().to_uppercase());
        let parameters = self.parameters().replacen("readings", "q", 1);
        let (linkage, name) = (self.language.linkage(), self.name());
        format!("{linkage}void {name}_joints({parameters}, {real} out[{upper}_JOINTS])")
    }

    /// The function itself.
    pub fn joints(&self, out: &mut Lines) {
        let readings = &self.ir.readings;
        out.blank();
        out.code(&self.joints_head());
        out.braces(|out| {
            for extra in readings.extras.iter().filter(|extra| !readings.reads(**extra)) {
                out.code(&format!("(void){};", extra.name()));
            }
            let pairs: Vec<Pair> =
                readings.angles.iter().map(|angle| Pair::of(angle, &self.language)).collect();
            declare(out, &self.language, &pairs);
            for (joint, value) in readings.joints.iter().enumerate() {
                out.code(&format!("out[{joint}] = {};", value.print(&self.language)));
            }
        });
    }
}
