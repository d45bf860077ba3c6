//! Order statistics.

/// Numbers in ascending order.
pub fn ascending(values: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    values
}

/// The number in the middle, of an even count the upper one of two: it is one of them, as a clock's step is.
pub fn middle(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let values = ascending(values);
    values.get(values.len() / 2).copied()
}

/// The `p` quantile (0 to 1) of ascending values, linear between ranks; 0 of nothing.
pub fn percentile(ascending: &[f64], p: f64) -> f64 {
    let Some(last) = ascending.len().checked_sub(1) else { return 0.0 };
    let rank = p.clamp(0.0, 1.0) * last as f64;
    let below = rank.floor() as usize;
    let above = (below + 1).min(last);
    ascending[below] + (ascending[above] - ascending[below]) * (rank - below as f64)
}
