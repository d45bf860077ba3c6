//! What is left after all that was found: whether it is more than noise, where it lies and on what
//! it depends.

use std::collections::BTreeMap;

use crate::diagnose::normal_equations::{About, Candidate, Kept, Probe, Source};
use crate::diagnose::options::DiagnoseError;
use crate::diagnose::report::{Share, Unexplained};
use crate::diagnose::search::{Explained, First, Search};
use crate::effects::Place;
use crate::infer::constants::BEYOND_NOISE;
use crate::infer::{Asked, Observations};

/// Displacements of free form that are tried beside each other.
const MOST_FORMS: usize = 6;

/// Dependences that are named.
const MOST_NAMED: usize = 6;

impl Search<'_, '_> {
    /// Looks for structure in what is left; `held_out_rms` is its size on poses that no fit has
    /// seen, m (rad without positions).
    pub(crate) fn remainder(
        &self,
        start: &Explained,
        now: &Explained,
        held_out_rms: f64,
    ) -> Result<Unexplained, DiagnoseError> {
        let probes = Candidate::probes(self.problem);
        let gathered = self.gather(now, &[], &probes);
        let screen = self.screen_of(now, &gathered, Kept::default(), &probes);
        let asked = Asked::new(screen, self.scale(now), self.options.seed);
        let mut places: BTreeMap<Place, f64> = BTreeMap::new();
        let mut about: BTreeMap<About, f64> = BTreeMap::new();
        let found = asked.ranked.iter().filter(|one| asked.is_found(one, BEYOND_NOISE));
        for one in found {
            let Source::Probe(probe) = &probes[one.candidate].source else { continue };
            let share = 1.0 - asked.held_out(one.candidate).white / asked.before.white;
            let largest = |map: &mut f64| *map = map.max(share);
            largest(places.entry(probe.place).or_insert(0.0));
            largest(about.entry(probe.about).or_insert(0.0));
        }
        let gaps = self.problem.standard(&now.fit.predicted.gaps);
        let gaps = gaps.zip(&self.problem.fits).filter(|(_, fits)| **fits).map(|(gap, _)| gap);
        let parameters = now.fit.model.parameters(self.problem);
        let present = now.noise.exceeded(gaps, parameters) || !places.is_empty();
        if !present {
            return Ok(Unexplained::default());
        }
        // Effects that stand in for an unknown one scatter what is left of it. Where it lay is seen
        // best when displacements of any form may stand in for it from the start.
        let mut lies: Vec<(Place, f64)> = Vec::new();
        let mut on: Vec<(About, f64)> = Vec::new();
        for (probe, share) in self.free_forms(start)? {
            add(&mut lies, probe.place, share);
            add(&mut on, probe.about, share);
        }
        largest_first(places).into_iter().for_each(|(place, share)| add(&mut lies, place, share));
        largest_first(about).into_iter().for_each(|(about, share)| add(&mut on, about, share));
        on.retain(|(about, _)| *about != About::Constant);
        let noise = now.noise.report();
        let floor =
            if self.problem.measures_position() { noise.position_rms } else { noise.rotation_rms };
        let beyond = held_out_rms.powi(2) - if now.noise.is_known() { floor.powi(2) } else { 0.0 };
        let place = |(place, share): (Place, f64)| Share { place: place.to_string(), share };
        Ok(Unexplained {
            present,
            position_rms: beyond.max(0.0).sqrt(),
            places: lies.into_iter().map(place).collect(),
            depends_on: on.into_iter().take(MOST_NAMED).map(|(a, _)| a.name()).collect(),
        })
    }

    /// The probes that explain the whole gap best beside the effects of the catalogue, and their
    /// shares of it: added one by one, to first order, from the robot file on.
    fn free_forms(&self, start: &Explained) -> Result<Vec<(Probe, f64)>, DiagnoseError> {
        let start = &start.with_states(self.problem)?;
        let mut all = self.candidates.to_vec();
        all.extend(Candidate::probes(self.problem));
        let mut along: Vec<Candidate> = Vec::new();
        let mut probes = Vec::new();
        let mut whole = None;
        for _ in 0..MOST_FORMS {
            let columns = along.iter().map(|c| c.size).sum();
            let kept = Kept { along: columns, whole: true, ..Kept::default() };
            let screen = self.screen_of(start, &self.gather(start, &along, &all), kept, &all);
            let left = screen.left();
            let whole = *whole.get_or_insert(left);
            let ranked = self.ranked(&screen, start);
            let Some(best) = ranked.first().filter(|best| best.gain > 0.0) else { break };
            if let Source::Probe(probe) = &all[best.candidate].source {
                probes.push((*probe, best.score.drop / whole));
            }
            along.push(all[best.candidate].clone());
        }
        Ok(probes)
    }

    /// The held-out part of the gap that a displacement at each place alone explains: free-form, or
    /// by the best effect there.
    pub(crate) fn shares(&self, now: &Explained, first: &First) -> Vec<Share> {
        let screen = self.screen_of(now, &first.gathered, Kept::default(), &first.candidates);
        let trained = screen.trained();
        let before = screen.held_out(&trained, None).white;
        let mut places: BTreeMap<Place, f64> = BTreeMap::new();
        for one in self.ranked(&screen, now) {
            let after = screen.held_out(&trained, Some(one.candidate)).white;
            let share = 1.0 - after / before.max(f64::MIN_POSITIVE);
            let best = places.entry(screen.candidates[one.candidate].place()).or_insert(0.0);
            *best = best.max(share);
        }
        let mut shares: Vec<Share> = places
            .into_iter()
            .filter(|(_, share)| *share > 0.0)
            .map(|(place, share)| Share { place: place.to_string(), share })
            .collect();
        shares.sort_by(|a, b| b.share.total_cmp(&a.share));
        shares
    }
}

/// Adds to a list that has each name once, in the order in which they come.
fn add<T: PartialEq>(list: &mut Vec<(T, f64)>, name: T, share: f64) {
    if !list.iter().any(|(known, _)| *known == name) {
        list.push((name, share));
    }
}

fn largest_first<T>(map: BTreeMap<T, f64>) -> Vec<(T, f64)> {
    let mut list: Vec<(T, f64)> = map.into_iter().collect();
    list.sort_by(|a, b| b.1.total_cmp(&a.1));
    list
}
