//! How often chance is found where candidates are asked for by sign flips, evidence and held-out squares.

use std::sync::{Arc, LazyLock};

use nalgebra::DMatrix;

use stiffarm_infer::constants::SIGNIFICANT;
use stiffarm_infer::rng::{Rng, Stream};
use stiffarm_infer::{Asked, Basis, Columns, Doubt, Products, Scale, Screen, Usual, worst};

const BLOCKS: usize = 40;
const ROWS: usize = 5;

struct Column(Usual);

impl Columns for Column {
    fn usual(&self) -> &Usual {
        &self.0
    }
}

/// Columns of their own, of which anything is usual.
static COLUMNS: LazyLock<Vec<Column>> = LazyLock::new(|| {
    let usual = Usual { least: vec![f64::NEG_INFINITY], held: vec![0.0], multiplicity: 1 };
    (0..12).map(|_| Column(usual.clone())).collect()
});

/// Normal noise whose size differs from block to block, with so much of the first column, beside a mean.
fn asked(seed: u64, first: f64) -> Asked<'static, Column> {
    let mut rng = Rng::new(seed, Stream::Noise);
    let count = COLUMNS.len();
    let mut total = Products::zeros(1, &[1; 12]);
    let prior = total.clone();
    let blocks: Vec<Products> = (0..BLOCKS)
        .map(|block| {
            let x = DMatrix::from_fn(ROWS, count, |_, _| rng.normal());
            let size = 1.0 + (block % 3) as f64;
            let r = DMatrix::from_fn(ROWS, 1, |row, _| first * x[(row, 0)] + size * rng.normal());
            let z = DMatrix::from_element(ROWS, 1, 1.0);
            Products {
                zz: z.tr_mul(&z),
                zr: z.tr_mul(&r).column(0).into_owned(),
                rr: r.norm_squared(),
                zx: z.tr_mul(&x),
                xr: x.tr_mul(&r).column(0).into_owned(),
                xx: Arc::new(
                    x.column_iter()
                        .map(|c| DMatrix::from_element(1, 1, c.norm_squared()))
                        .collect(),
                ),
            }
        })
        .collect();
    blocks.iter().for_each(|block| total.add(block));
    let basis = Basis::new(&total.zz);
    let folds: Vec<usize> = (0..BLOCKS).map(|block| block % 10).collect();
    let screen = Screen::new(&COLUMNS[..], basis, total, prior);
    let screen = screen.by_block(blocks, Vec::new(), &folds, 10);
    let scale = Scale { known: false, numbers: BLOCKS * ROWS, independent: 1.0 };
    Asked::new(screen, scale, seed)
}

/// The sign flips keep what they promise though the blocks are not alike, and evidence and held-out squares make
/// false alarms rarer.
#[test]
fn chance_is_found_no_more_often_than_promised_and_a_cause_always() {
    let draws = 400;
    let below = |seed: u64| {
        let asked = asked(seed, 0.0);
        let least = asked.ranked.iter().map(|one| asked.p_value(&one.score)).fold(1.0, f64::min);
        let found = asked.ranked.iter().any(|one| asked.is_found(one, SIGNIFICANT));
        [least <= SIGNIFICANT, found].map(usize::from)
    };
    let counts = (0..draws).map(below).fold([0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
    // 20 are promised; 31 or more are the chance of one in a hundred.
    assert!((9..=31).contains(&counts[0]) && counts[1] <= counts[0], "{counts:?}");
    for seed in 0..20 {
        let asked = asked(seed, 1.0);
        let first = &asked.ranked[0];
        assert_eq!(first.candidate, 0);
        assert!(asked.is_found(first, SIGNIFICANT), "{:?}", asked.answer(first));
    }
}

#[test]
fn what_none_can_be_goes_first_then_what_is_idle() {
    let doubt = |is_impossible, is_idle, p_value| Doubt { is_impossible, is_idle, p_value };
    let all = [doubt(false, false, 0.9), doubt(false, true, 0.01), doubt(true, false, 0.01)];
    let worst_of = |of: &[usize]| worst(of.iter().map(|k| (*k, all[*k])));
    assert_eq!(
        [worst_of(&[0, 1, 2]), worst_of(&[0, 1]), worst_of(&[0])],
        [Some(2), Some(1), Some(0)]
    );
    assert_eq!(worst_of(&[]), None);
    assert!(
        all[1].is_doubted(SIGNIFICANT)
            && all[0].is_doubted(SIGNIFICANT)
            && !all[2].is_doubted(SIGNIFICANT)
    );
}
