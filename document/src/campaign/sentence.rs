//! The diagnosis in a sentence or two: what removes the error.

use stiffarm_gap::diagnose::Finding;
use stiffarm_gap::effects::Told;

use super::Campaign;
use crate::findings::told;
use crate::text::{counted, fixed};
use crate::words::{capital, named, percent};

/// A smaller error is one of rounding, m and rad.
const ROUNDING: f64 = 1e-11;

/// Findings that the sentence names; of more it names one less, and counts the others.
const NAMED: usize = 3;

/// With fewer poses the sign-flip test has so few outcomes that no p value is small enough.
const LEAST_POSES: usize = 6;

impl Campaign<'_> {
    /// What removes the error, how far, and what is left open.
    pub(super) fn sentence(&self) -> String {
        match &self.found.mistaken {
            None => self.explained(),
            Some(wrong) if wrong.mistakes.is_empty() => self.no_arms(wrong),
            Some(wrong) => {
                format!("{} {}", self.mistaken(wrong), self.explained())
            }
        }
    }

    /// The same of a file without mistakes.
    fn explained(&self) -> String {
        let found = &self.found.findings;
        let stopped = match self.found.stopped {
            true => " The search was stopped before its end: there may be more to find.",
            false => "",
        };
        if found.is_empty() {
            return self.nothing_found() + stopped;
        }
        let what = capital(&told(found, NAMED, ", and ", |f| self.said(f)));
        let it = match found.len() {
            1 => "it",
            2 => "both",
            _ => "all of them",
        };
        let (shown, [before, after]) = (self.main(), self.rms());
        let removed = if before > 0.0 { 1.0 - after / before } else { 0.0 };
        let mut text = format!(
            "{what}; modelling {it} removes {} of the {}, {} rms",
            percent(removed),
            self.error(),
            shown.change(before, after)
        );
        match &*self.found.gap.noise.from {
            "residual" => text.push('.'),
            _ => text.push_str(&format!("; the noise is {}.", shown.with_unit(self.noise()))),
        }
        text + &self.open()
            + &self.rest().map_or_else(String::new, |rest| format!(" {rest}."))
            + stopped
    }

    /// What is not distinguishable.
    fn open(&self) -> String {
        let found = &self.found.findings;
        let same = |f: &Finding| f.indistinguishable().count();
        let which = (1..=found.len()).filter(|k| same(&found[k - 1]) > 0);
        let which: Vec<String> = which.map(|k| k.to_string()).collect();
        let which = match (found.len(), which.len()) {
            (_, 0) => return String::new(),
            (1, _) => "it".to_owned(),
            (_, 1) => format!("finding {}", which.concat()),
            _ => format!("findings {}", which.join(", ")),
        };
        let others = counted(found.iter().map(same).sum(), "other explanation");
        format!(" These data do not distinguish {which} from {others}.")
    }

    /// What remains of the error beside the noise; `None` if nothing is unexplained.
    pub(super) fn rest(&self) -> Option<String> {
        if !self.found.unexplained.present {
            return None;
        }
        let ([_, after], noise, shown) = (self.rms(), self.noise(), self.main());
        let times = fixed(after / noise, 1);
        let is_known = self.found.gap.noise.from != "residual" && noise > 0.0;
        Some(match is_known && after > noise && times != "1.0" {
            true => format!(
                "What remains, {}, is {times} times the noise and not explained",
                shown.with_unit(after)
            ),
            false if is_known => {
                "What remains is no larger than the noise, but it is not random".to_owned()
            }
            false => format!("What remains, {}, is not random", shown.with_unit(after)),
        })
    }

    fn nothing_found(&self) -> String {
        let (shown, [before, _]) = (self.main(), self.rms());
        let (size, error) = (shown.with_unit(before), self.error());
        if before < ROUNDING {
            return format!("There is no {error}: the model predicts the measurements.");
        }
        let left = &self.found.unexplained;
        match (left.present, &*self.found.gap.noise.from) {
            (true, _) => {
                let place = left.places.first();
                let place =
                    place.map_or_else(String::new, |p| format!(" It seems to be at {}.", p.place));
                format!(
                    "The {error}, {size} rms, is more than noise, but no effect that was tried reduces it on \
                     held-out poses.{place}{}",
                    self.too_few()
                )
            }
            (false, "residual") => format!(
                "Nothing {}is found: no effect that was tried reduces the {error}, {size} rms, on held-out \
                 poses.{}",
                if self.found.mistaken.is_some() { "else " } else { "" },
                self.too_few()
            ),
            (false, _) => format!(
                "The {error}, {size} rms, is noise ({}): nothing that these data could show is missing \
                 from the model.",
                shown.with_unit(self.noise())
            ),
        }
    }

    /// Why so few poses show nothing.
    fn too_few(&self) -> String {
        let poses = self.data.poses;
        if poses >= LEAST_POSES {
            return String::new();
        }
        let outcomes = 1 << poses.saturating_sub(1);
        format!(
            " With {} nothing can be found: the sign-flip test has {}, so that no p value is below \
             0.05. Measure at {LEAST_POSES} poses or more.",
            counted(poses, "pose"),
            counted(outcomes, "outcome")
        )
    }

    /// `joint 2 twists 0.150 µrad/(N·m) more than modelled`.
    pub(super) fn said(&self, finding: &Finding) -> String {
        let write =
            |unit: &str, most: f64, value: f64| self.unit(finding, unit, most).with_unit(value);
        let (place, numbers) = (finding.place.as_str(), &finding.parameters[..]);
        match self.options.catalogue.named(&finding.effect) {
            Some(effect) => effect.sentence(&Told { place, numbers, write: &write }),
            None => named(&finding.effect, place),
        }
    }
}
