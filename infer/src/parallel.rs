//! Work on all cores, with results in their order.
//!
//! rayon is asked at one place, for work whose type is erased: each further place would compile rayon's plumbing anew.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

/// Very many results are made in so many parts, which the cores take one after the other.
const PARTS: usize = 1024;

/// `of` each number below `count`.
pub fn map<T: Send>(count: usize, of: &(dyn Fn(usize) -> T + Sync)) -> Vec<T> {
    let length = count.div_ceil(PARTS).max(1);
    let parts: Vec<Mutex<Vec<T>>> = (0..count.div_ceil(length)).map(|_| Mutex::default()).collect();
    all(parts.len(), &|part| {
        let own: Vec<T> = (length * part..count.min(length * (part + 1))).map(of).collect();
        *parts[part].lock().unwrap_or_else(PoisonError::into_inner) = own;
    });
    let mut all = Vec::with_capacity(count);
    for part in parts {
        all.append(&mut part.into_inner().unwrap_or_else(PoisonError::into_inner));
    }
    all
}

/// `of` each number below `count`, or an error of one; after an error no more are begun.
pub fn tried<T: Send, E: Send>(
    count: usize,
    of: &(dyn Fn(usize) -> Result<T, E> + Sync),
) -> Result<Vec<T>, E> {
    let failed = AtomicBool::new(false);
    let begun = map(count, &|k| {
        (!failed.load(Ordering::Relaxed)).then(|| {
            let one = of(k);
            failed.fetch_or(one.is_err(), Ordering::Relaxed);
            one
        })
    });
    begun.into_iter().flatten().collect()
}

/// `of` each item.
pub fn each<I: Sync, T: Send>(items: &[I], of: &(dyn Fn(&I) -> T + Sync)) -> Vec<T> {
    map(items.len(), &|k| of(&items[k]))
}

/// Changes each item where it stands.
pub fn change<I: Send>(items: &mut [I], of: &(dyn Fn(&mut I) + Sync)) {
    let items: Vec<Mutex<&mut I>> = items.iter_mut().map(Mutex::new).collect();
    all(items.len(), &|k| of(&mut items[k].lock().unwrap_or_else(PoisonError::into_inner)));
}

fn all(count: usize, of: &(dyn Fn(usize) + Sync)) {
    (0..count).into_par_iter().for_each(of);
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicUsize;

    use super::*;

    #[test]
    fn results_are_in_their_order() {
        for count in [0, 1, PARTS, PARTS + 1, 5 * PARTS + 3] {
            let squares: Vec<usize> = (0..count).map(|k| k * k).collect();
            assert_eq!(map(count, &|k| k * k), squares);
            let mut roots: Vec<usize> = (0..count).collect();
            assert_eq!(each(&roots, &|k| k * k), squares);
            change(&mut roots, &|k| *k *= *k);
            assert_eq!(roots, squares);
            assert_eq!(tried(count, &|k| Ok::<_, usize>(k * k)), Ok(squares));
        }
    }

    #[test]
    fn after_an_error_no_more_are_begun() {
        let begun = AtomicUsize::new(0);
        let all = tried(100 * PARTS, &|k| {
            begun.fetch_add(1, Ordering::Relaxed);
            if k % 100 == 7 { Err(k) } else { Ok(k) }
        });
        assert_eq!(all.expect_err("a number fails") % 100, 7);
        // Of each part that a core had begun no more than its first eight.
        assert!(begun.into_inner() <= 8 * rayon::current_num_threads());
    }
}
