//! Parts of a model in the order in which they make something smallest.

use crate::parallel;

/// So many parts one after the other, always the one `with` which, beside those before it, `size` is least; each with
/// what it comes to.
pub fn ordered<T: Send>(
    count: usize,
    with: impl Fn(&[usize]) -> T + Sync,
    size: impl Fn(&T) -> f64,
) -> Vec<(usize, T)> {
    let mut rest: Vec<usize> = (0..count).collect();
    let mut done: Vec<(usize, T)> = Vec::new();
    while !rest.is_empty() {
        let before: Vec<usize> = done.iter().map(|(part, _)| *part).collect();
        let beside = |next: &usize| with(&[&before[..], &[*next]].concat());
        let tried: Vec<T> = parallel::each(&rest, &beside);
        let sizes: Vec<f64> = tried.iter().map(&size).collect();
        let best = (0..rest.len()).min_by(|a, b| sizes[*a].total_cmp(&sizes[*b])).unwrap_or(0);
        let part = rest.remove(best);
        done.extend(tried.into_iter().nth(best).map(|it| (part, it)));
    }
    done
}
