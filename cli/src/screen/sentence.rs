//! The diagnosis in one sentence or two: what to do about the gap.

use stiffarm_gap::diagnose::Finding;

use super::{Screen, percent, words};
use crate::input::quantity::counted;

/// A gap below this is rounding error, m and rad.
const ROUNDING: f64 = 1e-11;

/// Findings that the sentence tells; of more it tells one less, and counts the others.
const TOLD: usize = 3;

/// Of fewer poses the signs can be set in so few ways that no finding is rarer than its p value must be.
const LEAST_POSES: usize = 6;

impl Screen<'_> {
    /// What closes the gap, how far, and what is left open.
    pub(super) fn sentence(&self) -> String {
        let found = &self.found.findings;
        if found.is_empty() {
            return self.nothing_found();
        }
        let first = if found.len() > TOLD { TOLD - 1 } else { found.len() };
        let mut told: Vec<String> = found.iter().take(first).map(|f| self.said(f)).collect();
        if found.len() > first {
            told.push(format!("{} were found", counted(found.len() - first, "more effect")));
        }
        let last = told.pop().unwrap_or_default();
        let told = match told.is_empty() {
            true => last,
            false => format!("{}, and {last}", told.join(", ")),
        };
        let it = match found.len() {
            1 => "it",
            2 => "both",
            _ => "them",
        };
        let (shown, [before, after]) = (self.main(), self.rms());
        let less = if before > 0.0 { 1.0 - after / before } else { 0.0 };
        let mut text = format!(
            "{}; modelling {it} removes {} of the gap, {} → {}",
            capital(&told),
            percent(less),
            shown.with_unit(before),
            shown.with_unit(after)
        );
        let noise = self.noise();
        match &*self.found.gap.noise.from {
            "residual" => text.push('.'),
            _ => text.push_str(&format!("; the noise is {}.", shown.with_unit(noise))),
        }
        let same = |f: &Finding| f.indistinguishable().count();
        let open: usize = found.iter().map(same).sum();
        if open > 0 {
            let which: Vec<String> = (1..=found.len())
                .filter(|k| same(&found[k - 1]) > 0)
                .map(|k| k.to_string())
                .collect();
            let which = match (found.len(), which.len()) {
                (1, _) => "it".to_owned(),
                (_, 1) => format!("finding {}", which.concat()),
                _ => format!("findings {}", which.join(", ")),
            };
            let others = counted(open, "other explanation");
            text.push_str(&format!(" This data does not tell {which} from {others}."));
        }
        if self.found.unexplained.present {
            text.push_str(&match self.found.unexplained.position_rms > 0.0 {
                true => format!(" {} of it stays unexplained.", self.left()),
                false => {
                    " What is left is no larger than the noise, and still has a pattern.".to_owned()
                }
            });
        }
        text
    }

    fn nothing_found(&self) -> String {
        let (shown, [before, _]) = (self.main(), self.rms());
        let size = shown.with_unit(before);
        if before < ROUNDING {
            return "There is no gap: the measurements are what the model predicts.".to_owned();
        }
        let left = &self.found.unexplained;
        match (left.present, &*self.found.gap.noise.from) {
            (true, _) => {
                let place = left.places.first().map_or_else(String::new, |p| {
                    format!(" It lies at {}, by all that this data shows.", p.place)
                });
                let known = "no effect that was tried explains it on poses that no fit has seen";
                format!(
                    "The gap of {size} is more than noise, and {known}.{place}{}",
                    self.too_few()
                )
            }
            (false, "residual") => format!(
                "Nothing is found: no effect that was tried makes the gap of {size} smaller on \
                 poses that no fit has seen.{}",
                self.too_few()
            ),
            (false, _) => format!(
                "The gap of {size} is noise ({}): of what this data could show, nothing is missing \
                 from the model.",
                shown.with_unit(self.noise())
            ),
        }
    }

    /// Why so few poses show nothing, whatever is wrong with the arm.
    fn too_few(&self) -> String {
        let poses = self.data.poses;
        if poses >= LEAST_POSES {
            return String::new();
        }
        let ways = 1 << poses.saturating_sub(1);
        format!(
            " At {} nothing can be found: chance alone does as well in one of {ways} cases, and a \
             finding must be rarer than one in 20. Measure at {LEAST_POSES} poses or more.",
            counted(poses, "pose")
        )
    }

    /// The gap before and after, m (rad without positions).
    pub(super) fn rms(&self) -> [f64; 2] {
        [&self.found.gap.before, &self.found.gap.after]
            .map(|s| if self.measures(0..3) { s.position_rms } else { s.rotation_rms })
    }

    fn noise(&self) -> f64 {
        let noise = &self.found.gap.noise;
        if self.measures(0..3) { noise.position_rms } else { noise.rotation_rms }
    }

    /// What is left beyond the noise.
    pub(super) fn left(&self) -> String {
        let left = self.found.unexplained.position_rms;
        let shown =
            if self.measures(0..3) { self.length(left, left) } else { self.angle(left, left) };
        shown.with_unit(left)
    }

    /// `joint compliance at joint 2`.
    pub(super) fn named(effect: &str, place: &str) -> String {
        format!("{} at {place}", words(effect))
    }
}

/// With a capital letter at its beginning.
fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}
