//! Which poses are held out together.

use super::options::{DiagnoseError, Options};
use super::rng::{Stream, generator, shuffled};
use crate::measurement::Measurements;

/// Up to this many poses each is held out alone.
const MOST_SINGLE: usize = 30;

/// Folds of poses beyond that.
const USUAL: usize = 10;

/// A division of the poses into folds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Folds {
    pub(crate) count: usize,
    /// The fold of each pose.
    pub(crate) of_pose: Vec<usize>,
}

impl Folds {
    /// Deals the poses out: as evenly as can be, at random by the seed.
    pub(crate) fn deal(data: &Measurements, options: &Options) -> Result<Folds, DiagnoseError> {
        let poses = data.poses;
        if poses < 2 {
            return Err(DiagnoseError::TooFewPoses { file: data.file.clone(), found: poses });
        }
        let usual = if poses <= MOST_SINGLE { poses } else { USUAL };
        let count = options.folds.unwrap_or(usual);
        if !(2..=poses).contains(&count) {
            let file = data.file.clone();
            return Err(DiagnoseError::Folds { file, found: count, poses });
        }
        let mut of_pose = vec![0; poses];
        let order = shuffled(&mut generator(options.seed, Stream::Folds), poses);
        for (place, pose) in order.into_iter().enumerate() {
            of_pose[pose] = place % count;
        }
        Ok(Folds { count, of_pose })
    }
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

    fn sizes(folds: &Folds) -> Vec<usize> {
        (0..folds.count).map(|f| folds.of_pose.iter().filter(|p| **p == f).count()).collect()
    }

    #[test]
    fn few_poses_stand_alone_and_many_in_tens() {
        let deal = |poses| Folds::deal(&data(poses), &Options::default()).unwrap();
        assert_eq!(sizes(&deal(12)), vec![1; 12]);
        assert_eq!(sizes(&deal(35)), [4, 4, 4, 4, 4, 3, 3, 3, 3, 3]);
        assert_eq!(deal(35), deal(35));
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
