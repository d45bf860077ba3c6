//! What only a page has room for: the arm, the worst poses, residuals, correlations.

use super::known::known;
use super::{Campaign, Fitted};
use crate::figure::{arm, residuals};
use crate::{Block, Cell, Table};

/// What is said below the fitted curves.
const CURVES: &str = "The line is the fitted motion of the joint; a point is the same plus the row's residual as a \
                      motion of that joint. Points along the line show that the shape is right. The torque is that of \
                      the robot file's model.";

impl Campaign<'_> {
    /// The sections of a page behind what a screen has, too.
    pub(super) fn details(&self, fitted: &Fitted<'_>) -> Vec<Block> {
        let mut sections = vec![
            Block::section("The arm and its error", vec![arm(), Block::Csv("where")]),
            self.poses(fitted),
            Block::Section {
                heading: "Residuals, before and after".to_owned(),
                remark: "of the models fitted to all rows; the sizes above are held out".to_owned(),
                blocks: vec![residuals(self.data.rows.len(), self.normality(), CURVES)],
            },
        ];
        sections.extend(known(self));
        sections.push(Block::section("Range of the data", self.covers()));
        sections
    }

    /// The poses with the largest residuals, and the figures of ISO 9283.
    fn poses(&self, fitted: &Fitted<'_>) -> Block {
        let unit = self.main();
        let mut worst = Table::new(["pose", "rows", "before", "with the findings"]);
        worst.rows = (self.worst(fitted).into_iter())
            .map(|pose| {
                vec![
                    pose.name.into(),
                    Cell::number(pose.rows.to_string()),
                    Cell::number(unit.with_unit(pose.before)),
                    Cell::number(unit.with_unit(pose.after)),
                ]
            })
            .collect();
        let mut blocks = vec![Block::Table(worst)];
        blocks.extend(self.performance(fitted));
        Block::section("Worst poses, accuracy and repeatability", blocks)
    }

    /// Where the data have been.
    fn covers(&self) -> Vec<Block> {
        let covers = &self.found.covers;
        let joints = covers.joints.iter().zip(&self.arm.joints).enumerate();
        let mut lines: Vec<String> = joints
            .map(|(j, ([low, high], joint))| {
                let (unit, si) = match joint.motion {
                    stiffarm_kernels::Motion::Revolute => ("°", 1_f64.to_radians()),
                    stiffarm_kernels::Motion::Prismatic => (" mm", 1e-3),
                };
                let [low, high] =
                    [low, high].map(|q| format!("{:.0}", q / si).replacen('-', "−", 1));
                format!("joint {}: {low}{unit} to {high}{unit}", j + 1)
            })
            .collect();
        lines.push(format!("force: up to {:.0} N", covers.force));
        lines.push(format!("moment: up to {:.0} N·m", covers.moment));
        let outside = "Predictions outside of this range are extrapolation.".to_owned();
        vec![Block::Paragraph(outside), Block::List(lines)]
    }
}
