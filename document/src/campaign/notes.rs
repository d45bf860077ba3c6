//! Where the error lies, what was co-estimated, what remains, what these data cannot show, what was not read.

use stiffarm_gap::diagnose::{AtTool, BenchReport, LeftOut, NuisanceReport, PairReport, Share};
use stiffarm_gap::gap::Statistics;
use stiffarm_gap::measurement::ExtraColumn;

use super::Campaign;
use crate::text::{fixed, listed, short};
use crate::words::{lower, words};
use crate::{Block, Unit};

/// Residuals are reported as odd where noise makes them so less often, and it matters.
const ODD: f64 = 1e-3;
const HEAVY: f64 = 1.0;
const CORRELATED: f64 = 0.2;

/// Reasons for which something is unobservable that a screen has.
const REASONS: usize = 3;

/// Entries of a list before the rest is counted.
const MOST: usize = 4;

/// Places with a smaller share are not shown.
const LEAST: f64 = 0.005;

/// Columns that are named of those that were not used.
const MOST_UNUSED: usize = 12;

impl Campaign<'_> {
    /// The remarks below the findings.
    pub(super) fn notes(&self) -> Vec<Block> {
        let remark = "each place individually; the shares overlap";
        let hidden = self.hidden();
        let hidden = Block::Note { name: "Unobservable", lines: hidden, most: REASONS };
        let notes = [
            Some(shares("Located at", &self.found.places, remark)),
            Block::note("Depends on", self.parts()),
            Block::note("At the tool", self.at_tool()),
            Block::note("Co-estimated", self.nuisances()),
            Block::note("Pairs", self.pairs()),
            Block::note("Loads", self.loads()),
            Block::note("Outliers", self.outliers()),
            Block::note("Check", self.checked()),
            Block::note("Residuals", self.odd()),
            Block::note("Unexplained", self.unexplained()),
            Some(hidden),
            Block::note("Not used", self.not_used()),
        ];
        notes.into_iter().flatten().collect()
    }

    /// What an instrument's reading comes to at the tool.
    fn at_tool(&self) -> String {
        let Some(AtTool { before, after }) = self.found.gap.at_tool else { return String::new() };
        let change = self.units().length([before, after]).change(before, after);
        format!(
            "{change} rms: how far the findings move the tool, and how uncertain they leave it, at the measured postures \
             and loads"
        )
    }

    /// Whose axes loads and gravity are in, where that is not the convention.
    fn loads(&self) -> &'static str {
        match self.found.hangs_as_measured {
            true => {
                "the data show that loads and gravity are in the measuring frame's axes, −z down"
            }
            false => "",
        }
    }

    fn nuisances(&self) -> String {
        let frame = |n: &NuisanceReport| {
            let [x, y, z] = n.translation.map(|x| short(1e3 * x));
            let of = n.session.as_deref().map(|session| session.trim_end_matches(':'));
            let of = of.map_or_else(String::new, |session| format!(" in {session}"));
            format!("{}{of} at ({x}, {y}, {z}) mm", words(&n.name))
        };
        let geometry = "geometry: lengths, twists and zeros of the table";
        let geometry = self.found.geometry_along.then(|| geometry.to_owned());
        // What has a place is among the frames.
        let is_placed =
            |thing: &&BenchReport| ["point", "centre", "plane"].contains(&thing.kind.as_str());
        let thing = |thing: &BenchReport| {
            let each = thing.constants.iter().map(|constant| {
                let (scale, unit) = match constant.unit.as_ref() {
                    "m" => (1e3, " mm"),
                    "rad" => (1e3, " mrad"),
                    "px" => (1.0, " px"),
                    _ => (1.0, ""),
                };
                let [low, high] = constant.ci95.map(|end| scale * end);
                let (half, value) = ((high - low) / 2.0, scale * constant.value);
                if !half.is_finite() {
                    return format!("{} not determined", constant.name);
                }
                // As many digits as the interval has.
                let places = (1.0 - half.abs().log10().floor()).clamp(0.0, 6.0) as usize;
                format!(
                    "{} {} ± {}{unit}",
                    constant.name,
                    fixed(value, places),
                    fixed(half, places)
                )
            });
            let each: Vec<String> = each.collect();
            format!("{}: {}", format!("{} {}", thing.kind, thing.name).trim_end(), each.join(", "))
        };
        let others = self.found.bench.iter().filter(|one| !is_placed(one)).map(thing);
        let frames = self.found.nuisances.iter().map(frame);
        listed(&frames.chain(geometry).chain(others).collect::<Vec<_>>(), MOST)
    }

    /// Points of the bench whose distance is known, and what it came out as.
    fn pairs(&self) -> String {
        let pair = |pair: &PairReport| {
            let [known, fitted, sigma] =
                [pair.known, pair.fitted, pair.sigma].map(|length| fixed(1e3 * length, 2));
            let [one, other] = &pair.points;
            format!("{one} and {other} {fitted} mm apart (known: {known} ± {sigma} mm)")
        };
        listed(&self.found.pairs.iter().map(pair).collect::<Vec<_>>(), MOST)
    }

    /// The rows that do not fit, the worst first.
    fn outliers(&self) -> String {
        let mut rows: Vec<&LeftOut> = self.found.left_out.iter().collect();
        if rows.is_empty() {
            return String::new();
        }
        let units = self.units();
        let size = |row: &LeftOut| if units.positions { row.position } else { row.rotation };
        // A row in which the arm has no equilibrium is the worst.
        let order = |row: &LeftOut| size(row).unwrap_or(f64::INFINITY);
        rows.sort_by(|a, b| order(b).total_cmp(&order(a)));
        let far = |row: &&LeftOut| {
            let text = size(row).map_or("no equilibrium under its load".to_owned(), |size| {
                units.main([size, size]).with_unit(size)
            });
            let of = row.session.as_deref().map(|session| session.trim_end_matches(':'));
            let of = of.map_or_else(String::new, |session| format!(" of {session}"));
            format!("line {}{of} ({text})", row.line)
        };
        let each: Vec<String> = rows.iter().map(far).collect();
        let (out, all) = (each.len(), self.found.measurements);
        let verb = if out == 1 { "does" } else { "do" };
        format!(
            "{out} of {all} rows {verb} not fit: {} (--keep-all fits them)",
            listed(&each, MOST)
        )
    }

    fn checked(&self) -> String {
        let Some(check) = self.check else { return String::new() };
        let mended = if check.mended { ", mended as these readings are," } else { "" };
        let of = format!("{} of the {} rows of {}{mended}", check.inside, check.rows, check.file);
        let within = "within the joint ranges, loads and leverage of these data";
        let all = check.all.as_ref().map(|[before, after]| {
            format!("on all rows, extrapolated, {}", self.shrunk(before, after))
        });
        let (Some(before), Some(after)) = (&check.before, &check.after) else {
            let none = format!("{of} lie {within}: none is judged");
            return [Some(none), all].into_iter().flatten().collect::<Vec<_>>().join("; ");
        };
        let sizes = self.shrunk(before, after);
        if check.fitted {
            let expected = self.main().with_unit(self.rms()[1]);
            return format!(
                "{sizes} on {of}, which are the fitted rows: on new rows expect {expected}"
            );
        }
        let outside = all.unwrap_or_else(|| "no row lies outside".to_owned());
        format!("{sizes} on {of} that lie {within}; {outside}")
    }

    fn shrunk(&self, before: &Statistics, after: &Statistics) -> String {
        let units = self.units();
        // Another file's instrument may read angles alone, in its own unit.
        let reads_angles = units.positions && before.position_max.max(after.position_max) == 0.0;
        if let (true, Some(first), Some(last)) =
            (reads_angles, before.kinds.values().next(), after.kinds.values().next())
        {
            let shown = Unit::of(&first.unit, first.rms.max(last.rms));
            return format!("{} rms", shown.change(first.rms, last.rms));
        }
        if units.positions {
            let shown = units.length([before.position_rms, after.position_rms]);
            format!(
                "{} rms, 95 % {}, max {}",
                shown.change(before.position_rms, after.position_rms),
                shown.change(before.position_p95, after.position_p95),
                shown.change(before.position_max, after.position_max)
            )
        } else {
            let shown = units.angle([before.rotation_rms, after.rotation_rms]);
            format!("{} rms", shown.change(before.rotation_rms, after.rotation_rms))
        }
    }

    /// What of the residuals is not as least squares takes noise to be.
    fn odd(&self) -> String {
        let mut odd: Vec<String> = Vec::new();
        let left = self.found.residual.as_ref();
        let shape = left.and_then(|left| left.normality.as_ref());
        if let Some(shape) = shape.filter(|s| s.p_value < ODD && s.excess_kurtosis > HEAVY) {
            odd.push(format!("heavy tails (excess kurtosis {:.1})", shape.excess_kurtosis));
        }
        let order = left.and_then(|left| left.autocorrelation.as_ref());
        if let Some(order) = order.filter(|o| o.p_value < ODD && o.lag_1.abs() > CORRELATED) {
            let lag = fixed(order.lag_1, 2);
            odd.push(format!("autocorrelated from one visit to the next (correlation {lag})"));
        }
        listed(&odd, MOST)
    }

    fn unexplained(&self) -> String {
        let left = &self.found.unexplained;
        let Some(rest) = self.rest() else {
            return match &*self.found.gap.noise.from {
                "residual" => String::new(),
                _ => "nothing beyond the noise".to_owned(),
            };
        };
        let mut text = lower(&rest);
        let named: Vec<String> = left.places.iter().map(|share| share.place.clone()).collect();
        if !named.is_empty() {
            text.push_str(&format!("; located at {}", listed(&named, MOST)));
        }
        if !left.depends_on.is_empty() {
            text.push_str(&format!("; it depends on {}", listed(&left.depends_on, MOST)));
        }
        text
    }

    fn not_used(&self) -> String {
        let rival = |name: &str| {
            let mut rivals = self.options.rivals.iter();
            rivals.any(|r| name.strip_prefix(r.as_str()).is_some_and(|n| n.starts_with('_')))
        };
        let unknown = self.data.extra.iter().filter(|column| !rival(&column.name));
        // What has the unit of a load or a temperature may act on the arm.
        let acts = |column: &ExtraColumn| {
            let unit = column.unit.as_deref().and_then(stiffarm_gap::io::Unit::named)?;
            unit.dimension.acts().then(|| format!("{}, which may act", unit.dimension))
        };
        let unknown = unknown.map(|column| {
            let meant = column.suggestion.as_ref().map(|meant| format!("did you mean {meant}?"));
            match meant.or_else(|| acts(column)) {
                Some(remark) => format!("{} ({remark})", column.column.header),
                None => column.column.header.clone(),
            }
        });
        let unused = self.data.unused.iter().map(|c| format!("{} (not measured)", c.header));
        let all: Vec<String> = unknown.chain(unused).collect();
        if all.is_empty() {
            return String::new();
        }
        let columns = if all.len() == 1 { "column" } else { "columns" };
        format!("{columns} {}", listed(&all, MOST_UNUSED))
    }
}

fn shares(name: &'static str, places: &[Share], remark: &str) -> Block {
    let shares = places.iter().filter(|s| s.share >= LEAST).map(|s| (s.place.clone(), s.share));
    Block::Shares { name, shares: shares.collect(), remark: remark.to_owned() }
}
