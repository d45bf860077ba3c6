//! Which poses are held out together, and which rows are resampled or flipped together.

use crate::diagnose::options::{DiagnoseError, Options};
use crate::infer::constants::FOLDS;
use crate::infer::limits::BLOCKS;
use crate::measurement::Measurements;
use crate::rng::{Rng, Stream};

/// Up to this many poses each is held out alone.
const MOST_SINGLE: usize = 30;

/// Stretches of time that are held out by themselves.
const FIFTHS: usize = 5;

/// A division of the rows into blocks, and of the blocks into folds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Folds {
    pub(crate) count: usize,
    /// The block of each row; of one pose all rows are in one.
    pub(crate) block_of_row: Vec<usize>,
    /// The fold of each block.
    pub(crate) of_block: Vec<usize>,
}

impl Folds {
    /// Deals the blocks out: as evenly as can be, at random by the seed.
    pub(crate) fn deal(data: &Measurements, options: &Options) -> Result<Folds, DiagnoseError> {
        let poses = data.poses;
        if poses < 2 {
            return Err(DiagnoseError::TooFewPoses { file: data.file.clone(), found: poses });
        }
        let usual = if poses <= MOST_SINGLE { poses } else { FOLDS };
        let count = options.folds.unwrap_or(usual);
        if !(2..=poses).contains(&count) {
            let file = data.file.clone();
            return Err(DiagnoseError::Folds { file, found: count, poses });
        }
        let block_of_pose = blocks_of(data, BLOCKS.max(count));
        let blocks = block_of_pose.last().map_or(0, |last| last + 1);
        let mut of_block = vec![0; blocks];
        let order = Rng::new(options.seed, Stream::Folds).order(blocks);
        for (place, block) in order.into_iter().enumerate() {
            of_block[block] = place % count;
        }
        let block_of_row = data.rows.iter().map(|row| block_of_pose[row.group]).collect();
        Ok(Folds { count, block_of_row, of_block })
    }

    /// A fold of each fifth of the poses, in the order in which they were first measured; `None` of several
    /// sessions, whose frames are each its own, and of fewer poses than folds.
    pub(crate) fn fifths(data: &Measurements) -> Option<Folds> {
        if data.poses < FIFTHS || data.sessions().count() > 1 {
            return None;
        }
        let block_of_row = data.rows.iter().map(|row| row.group * FIFTHS / data.poses).collect();
        Some(Folds { count: FIFTHS, block_of_row, of_block: (0..FIFTHS).collect() })
    }

    pub(crate) fn blocks(&self) -> usize {
        self.of_block.len()
    }

    /// The rows of each block, in order.
    pub(crate) fn rows_of_blocks(&self) -> Vec<Vec<usize>> {
        let mut rows = vec![Vec::new(); self.blocks()];
        self.block_of_row.iter().enumerate().for_each(|(row, block)| rows[*block].push(row));
        rows
    }

    /// The fold of a row.
    pub(crate) fn of_row(&self, row: usize) -> usize {
        self.of_block[self.block_of_row[row]]
    }
}

/// The block of each pose, of as many blocks as are asked for, or a few more: none is of two sessions.
fn blocks_of(data: &Measurements, blocks: usize) -> Vec<usize> {
    let poses = data.poses;
    let blocks = poses.min(blocks);
    let mut starts = vec![false; poses];
    for session in data.sessions() {
        starts[session[0].group] = true;
    }
    let mut block = 0;
    let mut block_of_pose = Vec::with_capacity(poses);
    for (pose, starts) in starts.into_iter().enumerate() {
        let even = |pose: usize| pose * blocks / poses;
        let is_new = pose > 0 && (starts || even(pose) != even(pose - 1));
        block += usize::from(is_new);
        block_of_pose.push(block);
    }
    block_of_pose
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{row, table};
    use crate::measurement::{Kind, Row};
    use nalgebra::Vector6;

    fn data(poses: usize) -> Measurements {
        let rows = (0..poses).map(|group| Row { group, ..row(&[0.0], Vector6::zeros()) }).collect();
        table(rows, Kind::Pose { orientation: false })
    }

    fn sizes(folds: &Folds, poses: usize) -> Vec<usize> {
        let in_fold = |f| (0..poses).filter(|p| folds.of_row(*p) == f).count();
        (0..folds.count).map(in_fold).collect()
    }

    #[test]
    fn few_poses_stand_alone_and_many_in_tens() {
        let deal = |poses| Folds::deal(&data(poses), &Options::default()).unwrap();
        assert_eq!(sizes(&deal(12), 12), vec![1; 12]);
        assert_eq!(sizes(&deal(35), 35), [4, 4, 4, 4, 4, 3, 3, 3, 3, 3]);
        assert_eq!(deal(35), deal(35));
    }

    #[test]
    fn very_many_poses_share_blocks() {
        let folds = Folds::deal(&data(1000), &Options::default()).unwrap();
        assert_eq!(folds.blocks(), BLOCKS);
        assert_eq!((folds.block_of_row[0], folds.block_of_row[999]), (0, BLOCKS - 1));
        assert!(sizes(&folds, 1000).iter().all(|n| (90..=115).contains(n)));
    }

    #[test]
    fn no_block_is_of_two_sessions() {
        let mut data = data(1000);
        for row in &mut data.rows[..333] {
            row.session = Some("a".to_owned());
        }
        let folds = Folds::deal(&data, &Options::default()).unwrap();
        assert_eq!(folds.blocks(), BLOCKS + 1);
        assert_eq!(folds.block_of_row[333], folds.block_of_row[332] + 1);
    }

    #[test]
    fn impossible_numbers_are_refused() {
        assert!(matches!(
            Folds::deal(&data(1), &Options::default()),
            Err(DiagnoseError::TooFewPoses { found: 1, .. })
        ));
        for wrong in [0, 1, 5] {
            let options = Options { folds: Some(wrong), ..Options::default() };
            let refused = Folds::deal(&data(4), &options);
            assert!(matches!(refused, Err(DiagnoseError::Folds { poses: 4, .. })));
        }
    }
}
