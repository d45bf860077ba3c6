//! The arm as it really is: the robot file's numbers with those of the truths put in.

use nalgebra::{Matrix4, Vector3, Vector6};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Beam, Convention};

use super::law::Gear;
use super::laws::{Order, law};
use super::transform;
use super::truth::Truth;

/// Everything about the real arm that does not change from row to row.
#[derive(Clone, Debug, Default)]
pub(super) struct Reality {
    pub(super) convention: Convention,
    pub(super) gravity: Vector3<f64>,
    /// How far that is turned from where the file has it, rad.
    pub(super) tilt: Vector3<f64>,
    pub(super) joints: Vec<RealJoint>,
    /// Tool frame in the last frame: rotation and translation apart, for only the latter grows.
    pub(super) tool: Matrix4<f64>,
    /// The robot file's base.
    pub(super) base: Matrix4<f64>,
    /// The base's displacement.
    pub(super) base_frame: Vector6<f64>,
    /// The tool frame's displacement.
    pub(super) tool_frame: Vector6<f64>,
    /// Of the foundation, about its axes, rad/(N·m).
    pub(super) rock: Vector3<f64>,
    /// Of the foundation, m/N.
    pub(super) give: f64,
    pub(super) wrench_scale: f64,
    /// Where the force acts, in the tool frame.
    pub(super) payload: Vector3<f64>,
    pub(super) expansion: f64,
    pub(super) instrument_scale: f64,
    /// Of what is measured behind the readings, s.
    pub(super) delay: f64,
    /// Per second, or per row.
    pub(super) drift: Vector6<f64>,
    pub(super) base_slips: Vec<Jump>,
    pub(super) tool_slips: Vec<Jump>,
    /// How much of the loaded geometry the user's sim leaves out.
    pub(super) geometric: f64,
}

/// One row of the table.
#[derive(Clone, Debug, Default)]
pub(super) struct RealJoint {
    pub(super) motion: Motion,
    pub(super) theta: f64,
    pub(super) d: f64,
    pub(super) a: f64,
    pub(super) alpha: f64,
    pub(super) beta: f64,
    pub(super) offset: f64,
    pub(super) ratio: f64,
    pub(super) lag: f64,
    /// Per kelvin.
    pub(super) warming: f64,
    pub(super) width: f64,
    /// Other joints, from 0, and how far they turn this one.
    pub(super) couplings: Vec<(usize, f64)>,
    pub(super) orders: Vec<(Order, f64)>,
    /// Periods per turn, amplitudes of cosine and sine.
    pub(super) ripples: Vec<[f64; 3]>,
    pub(super) gear: Gear,
    /// Cosine and sine of the reading, N·m.
    pub(super) counterbalance: [f64; 2],
    pub(super) tilt: [f64; 2],
    /// About x and y, cosine and sine of twice the reading.
    pub(super) wobble: [[f64; 2]; 2],
    /// At the file's centre of mass, kg.
    pub(super) mass: f64,
    pub(super) com: Vector3<f64>,
    /// At the middle of the chord, kg.
    pub(super) mass_on_chord: f64,
    pub(super) beam: Option<RealBeam>,
}

/// A link that bends, by its flexibilities.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RealBeam {
    /// 1/EA, 1/N.
    pub(super) stretch: f64,
    /// 1/(κGA), 1/N.
    pub(super) shear: f64,
    /// 1/GJ, 1/(N·m²).
    pub(super) torsion: f64,
    /// 1/EI about the beam's y axis, 1/(N·m²).
    pub(super) bend_y: f64,
    /// 1/EI about the beam's z axis, 1/(N·m²).
    pub(super) bend_z: f64,
    /// Mass per length, kg/m.
    pub(super) line_density: f64,
}

/// A frame that jumps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Jump {
    /// The last row before it, counted from 1.
    pub(super) after: usize,
    pub(super) by: Vector6<f64>,
}

impl RealBeam {
    fn of(beam: &Beam) -> RealBeam {
        let shear = |kappa| 1.0 / (kappa * beam.shear_modulus * beam.area);
        RealBeam {
            stretch: 1.0 / (beam.youngs_modulus * beam.area),
            shear: beam.shear_coefficient.map_or(0.0, shear),
            torsion: 1.0 / (beam.shear_modulus * beam.j),
            bend_y: 1.0 / (beam.youngs_modulus * beam.iy),
            bend_z: 1.0 / (beam.youngs_modulus * beam.iz),
            line_density: beam.density * beam.area,
        }
    }
}

impl Reality {
    /// The robot file as it is.
    pub(super) fn nominal(arm: &Arm) -> Reality {
        let joints = arm.joints.iter().map(|joint| RealJoint {
            motion: joint.motion,
            theta: joint.theta,
            d: joint.d,
            a: joint.a,
            alpha: joint.alpha,
            beta: joint.beta,
            gear: Gear { compliance: joint.compliance, ..Gear::default() },
            mass: joint.mass,
            com: joint.com,
            beam: joint.beam.as_ref().map(RealBeam::of),
            ..RealJoint::default()
        });
        Reality {
            convention: arm.convention,
            gravity: arm.gravity,
            joints: joints.collect(),
            tool: transform::of(&arm.tool),
            base: transform::of(&arm.base),
            ..Reality::default()
        }
    }

    /// The robot file with the truths put in; truths about the same thing add up.
    ///
    /// # Errors
    /// In words, a total that cannot be: a spring, beam or mass below zero.
    pub(super) fn new(arm: &Arm, truths: &[Truth]) -> Result<Reality, String> {
        let mut reality = Reality::nominal(arm);
        for truth in truths {
            let put = law(truth.effect).ok_or_else(|| {
                format!(
                    "plant has no law for {}: simulate it by its own",
                    truth.effect.identifier()
                )
            })?;
            put(&mut reality, truth);
        }
        for (j, joint) in reality.joints.iter().enumerate() {
            let beam = joint.beam.unwrap_or_default();
            let totals = [
                ("compliance of joint", joint.gear.compliance),
                ("tilt_x of joint", joint.tilt[0]),
                ("tilt_y of joint", joint.tilt[1]),
                ("1/EI of link", beam.bend_y.min(beam.bend_z)),
                ("1/GJ of link", beam.torsion),
                ("mass of link", joint.mass.min(joint.mass_on_chord)),
            ];
            for (what, total) in totals {
                not_negative(&format!("{what} {}", j + 1), total)?;
            }
        }
        not_negative("rocking compliance of the base", reality.rock.min())?;
        not_negative("giving compliance of the base", reality.give)?;
        Ok(reality)
    }
}

fn not_negative(what: &str, total: f64) -> Result<(), String> {
    if total >= 0.0 {
        return Ok(());
    }
    Err(format!("the {what} comes to {total:e}, expected at least 0: make the effect smaller"))
}
