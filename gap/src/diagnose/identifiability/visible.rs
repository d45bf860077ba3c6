//! What this data could show, before anything is fitted: what is left of each effect when the
//! nuisances, and all of the arm's geometry, have taken up what they can.

use crate::constants::{IDLE, SEEN};
use crate::diagnose::normal_equations::{Kept, Screen};
use crate::diagnose::search::{Explained, First, Search};
use crate::effects::{Effect, Place};
use crate::infer::constants::{NUMBERS_EACH, OWN};
use crate::report::{CannotSee, Hidden};

impl Search<'_, '_> {
    /// The effects, at their places, that this data could not have shown.
    pub(crate) fn cannot_see(
        &self,
        effects: &[&'static dyn Effect],
        now: &Explained,
        first: &First,
    ) -> Vec<CannotSee> {
        let screen = |along: usize| {
            let kept = Kept { along, whole: true, free: true, ..Kept::default() };
            self.screen_of(now, &first.gathered, kept, self.candidates)
        };
        let alone = screen(0);
        let beside = screen(first.geometry.iter().map(|c| c.size).sum());
        // Between two readings of one pose lengths and angles cancel, but for what a mistake of
        // many times the usual size would do.
        let geometry_shows = !self.problem.data.kind.is_difference();
        let mut unseen = Vec::new();
        // Of the table as a whole its rows and zeros tell.
        for &effect in effects.iter().filter(|e| !e.is_tolerated()) {
            let places = effect.places(self.problem.arm);
            if let Some(because) = effect.excluded(self.problem.data) {
                unseen.extend(places.iter().map(|p| entry(effect, *p, 0.0, because)));
                continue;
            }
            let looks: Vec<(Place, Look)> =
                places.iter().map(|p| (*p, Look::at(effect, *p, &alone, &beside))).collect();
            let largest = looks.iter().map(|(_, l)| l.size).fold(0.0, f64::max);
            for (place, look) in looks {
                let relative = if largest > 0.0 { look.size / largest } else { 0.0 };
                let room = self.problem.numbers() / NUMBERS_EACH;
                if relative < IDLE {
                    unseen.push(entry(effect, place, relative, effect.idle()));
                } else if look.own < OWN.max(SEEN) {
                    let because = "not distinguishable from the co-estimated frames";
                    unseen.push(entry(effect, place, look.own, because));
                } else if geometry_shows && look.beside < SEEN && !effect.is_geometry() {
                    unseen.push(entry(effect, place, look.beside, effect.hidden()));
                } else if look.parameters > room {
                    let because = "too few measurements for its parameters";
                    unseen.push(entry(effect, place, 0.0, because));
                }
            }
        }
        unseen
    }
}

fn entry(
    effect: &'static dyn Effect,
    place: Place,
    visible: f64,
    because: &'static str,
) -> CannotSee {
    CannotSee {
        effect: effect.identifier().into(),
        place: place.to_string(),
        why: Hidden::AtRest { visible, because: because.into() },
    }
}

/// The best that any form of an effect does at a place.
struct Look {
    /// Size of one unit of it, in units of the noise.
    size: f64,
    /// Part that is left beside the nuisances.
    own: f64,
    /// Part that is left beside nuisances and geometry.
    beside: f64,
    parameters: usize,
}

impl Look {
    fn at(effect: &dyn Effect, place: Place, alone: &Screen<'_>, beside: &Screen<'_>) -> Look {
        let mut look = Look { size: 0.0, own: 0.0, beside: 0.0, parameters: usize::MAX };
        for (index, candidate) in alone.candidates.iter().enumerate() {
            let is_it = candidate
                .effect()
                .is_some_and(|(e, s)| e.identifier() == effect.identifier() && s.place == place);
            if is_it {
                look.size = look.size.max(alone.total.xx[index].trace().sqrt());
                look.own = look.own.max(alone.score(index).own);
                look.beside = look.beside.max(beside.score(index).own);
                look.parameters = look.parameters.min(candidate.size);
            }
        }
        look
    }
}
