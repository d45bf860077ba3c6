//! The mass matrix from composite bodies: all beyond a joint as one (Walker & Orin 1982, method 3).

use super::line::Link;
use super::moments::Moments;
use super::newton_euler::Load;
use crate::expr::{Expr, Graph, Vec3};

/// `M`, n×n column-major, rotors apart. Where joint j alone accelerates, by one unit, all beyond it moves as
/// one body, and every joint before it bears what that takes.
pub(super) fn mass_matrix(g: &mut Graph, links: &[Link]) -> Vec<Expr> {
    let n = links.len();
    let mut mass = vec![Expr::ZERO; n * n];
    let levers = levers(g, links);
    // Of the run beyond in the axes of the link that carries it; of the run's links beyond, in its axes.
    let (mut beyond, mut run) = (Moments::default(), Moments::default());
    for (k, link) in links.iter().enumerate().rev() {
        let own = link.moments.with(g, &beyond);
        beyond = Moments::default();
        let in_run = link.moments_in_run(g, &own);
        // What is spread across the axis does not feel the turn about it.
        let across = [&own, &run].map(|body| g.add(body.second[0][0], body.second[1][1]));
        let across = g.add(across[0], across[1]);
        run = run.with(g, &in_run);
        let load = unit_load(link, &run, across);
        for (i, load) in carried(g, links, &levers, k, load).into_iter().enumerate() {
            mass[k * n + i] = links[i].borne(load);
            mass[i * n + k] = mass[k * n + i];
        }
        run = run.moved(g, levers[k]);
        if link.begins {
            let leaning = link.lean.moments(g, &run);
            beyond = leaning.moved(g, link.offset);
            run = Moments::default();
        }
    }
    mass
}

/// Where each link's origin is from the one before, in the axes of the run; of the first of a run, from where
/// the run begins.
pub(super) fn levers(g: &mut Graph, links: &[Link]) -> Vec<Vec3> {
    let lever = |(k, link): (usize, &Link)| {
        let mut lever = match link.begins {
            true => [Expr::ZERO; 3],
            false => links[k - 1].outwards_to_run(g, link.offset),
        };
        let slid = link.slide.map_or(Expr::ZERO, |slide| link.signed(slide));
        lever[2] = g.add(lever[2], slid);
        lever
    };
    links.iter().enumerate().map(lever).collect()
}

/// Force on, and moment about the origin of, a body that a joint accelerates by one unit; the run's axes. Of its second
/// moments those along two axes across the joint's add up to `across`.
pub(super) fn unit_load(link: &Link, body: &Moments, across: Expr) -> Load {
    let [x, y, _] = body.first;
    let s = body.second;
    let (force, moment) = match link.slide {
        Some(_) => ([Expr::ZERO, Expr::ZERO, body.mass], [y, -x, Expr::ZERO]),
        None => ([-y, x, Expr::ZERO], [-s[0][2], -s[1][2], across]),
    };
    (force.map(|c| link.signed(c)), moment.map(|c| link.signed(c)))
}

/// A load about the origin of link `k` as that and all links before bear it, each about its origin in its run's axes.
pub(super) fn carried(
    g: &mut Graph,
    links: &[Link],
    levers: &[Vec3],
    k: usize,
    load: Load,
) -> Vec<Load> {
    let mut loads = vec![load; k + 1];
    for i in (0..k).rev() {
        loads[i] = inwards(g, links, levers, i + 1, loads[i + 1]);
    }
    loads
}

/// From link `k` to the one before.
fn inwards(
    g: &mut Graph,
    links: &[Link],
    levers: &[Vec3],
    k: usize,
    (force, moment): Load,
) -> Load {
    let link = &links[k];
    let lever = g.cross3(levers[k], force);
    let moment = g.add3(moment, lever);
    if !link.begins {
        return (force, moment);
    }
    let (force, moment) = (link.lean.outwards(g, force), link.lean.outwards(g, moment));
    let lever = g.cross3(link.offset, force);
    let moment = g.add3(moment, lever);
    let before = &links[k - 1];
    (before.outwards_to_run(g, force), before.outwards_to_run(g, moment))
}
