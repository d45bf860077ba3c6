//! Robot arms, each one file with the source of every number, and one line here.
//!
//! The papers' own robots come first, then common industrial arms. [`ARMS`] lists all that have
//! numbers for every parameter; the symbolic ones take theirs through `Robot::new`. With the feature
//! `kernels` each is a module of compiled kernels too.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "kernels")]
use stiffarm_kernels::Kernels;
#[cfg(feature = "batch")]
use stiffarm_kernels::batch::Batched;
#[cfg(feature = "kernels")]
use stiffarm_macros::robot;

/// A robot of this crate that has numbers for every parameter.
#[derive(Clone, Copy)]
pub struct Arm {
    /// The name of its module and file.
    pub id: &'static str,
    /// Its robot file.
    pub toml: &'static str,
    /// Its generated kernels.
    #[cfg(feature = "kernels")]
    pub kernels: &'static (dyn Kernels<f64> + Sync),
    /// The same in single precision.
    #[cfg(feature = "kernels")]
    pub kernels_f32: &'static (dyn Kernels<f32> + Sync),
    /// Batches of poses.
    #[cfg(feature = "batch")]
    pub batched: &'static dyn Batched<f64>,
}

/// A robot of this crate whose table has symbolic parameters.
#[derive(Clone, Copy)]
pub struct SymbolicArm {
    /// The name of its module and file.
    pub id: &'static str,
    /// Its robot file.
    pub toml: &'static str,
}

/// Declares the module of each robot and lists them.
macro_rules! arms {
    (
        numeric { $($(#[$doc:meta])* $id:ident = $file:literal,)* }
        symbolic { $($(#[$symbolic_doc:meta])* $symbolic:ident = $symbolic_file:literal,)* }
    ) => {
        $(#[cfg(feature = "kernels")]
        robot! {
            $(#[$doc])*
            pub mod $id from $file;
            crate: ::stiffarm_kernels;
        })*
        $(#[cfg(feature = "kernels")]
        robot! {
            $(#[$symbolic_doc])*
            pub mod $symbolic from $symbolic_file;
            crate: ::stiffarm_kernels;
        })*

        /// Every arm with numbers.
        pub const ARMS: &[Arm] = &[$(Arm {
            id: stringify!($id),
            toml: include_str!(concat!("../", $file)),
            #[cfg(feature = "kernels")]
            kernels: &$id::Robot,
            #[cfg(feature = "kernels")]
            kernels_f32: &$id::Robot,
            #[cfg(feature = "batch")]
            batched: &$id::Robot,
        }),*];

        /// Every arm with symbolic parameters.
        pub const SYMBOLIC: &[SymbolicArm] = &[$(SymbolicArm {
            id: stringify!($symbolic),
            toml: include_str!(concat!("../", $symbolic_file)),
        }),*];
    };
}

arms! {
numeric {
    /// Lin, Chiang & Cui (1991): the planar two-link arm of Tables I to III.
    lin_planar = "arms/lin_planar.toml",
    /// Lin, Chiang & Cui (1991), Table IV: the elbow manipulator.
    lin_elbow = "arms/lin_elbow.toml",
    /// KUKA KR 240-2 (Dumas et al. 2011).
    kuka_kr240 = "arms/kuka_kr240.toml",
    /// Fanuc S-420F (Knapczyk & Ryska).
    fanuc_s420f = "arms/fanuc_s420f.toml",
    /// Bicchi & Melchiorri: the planar arm with three joints.
    bicchi_3r = "arms/bicchi_3r.toml",
    /// Bicchi & Melchiorri: the planar arm with five joints.
    bicchi_5r = "arms/bicchi_5r.toml",
    /// Unimation PUMA 560.
    puma560 = "arms/puma560.toml",
    /// Universal Robots UR5.
    ur5 = "arms/ur5.toml",
    /// Universal Robots UR10.
    ur10 = "arms/ur10.toml",
    /// Universal Robots UR3e.
    ur3e = "arms/ur3e.toml",
    /// Universal Robots UR5e.
    ur5e = "arms/ur5e.toml",
    /// Universal Robots UR10e.
    ur10e = "arms/ur10e.toml",
    /// KUKA LBR iiwa 14 R820.
    iiwa14 = "arms/iiwa14.toml",
    /// Franka Emika Panda.
    panda = "arms/panda.toml",
    /// Stäubli TX2-90L.
    tx2_90l = "arms/tx2_90l.toml",
    /// ABB IRB 120.
    irb120 = "arms/irb120.toml",
    /// The Stanford arm: its third joint is prismatic.
    stanford = "arms/stanford.toml",
}
symbolic {
    /// Lin, Chiang & Cui (1991): the planar arm with symbolic lengths, sections and moduli.
    lin_planar_symbolic = "arms/lin_planar_symbolic.toml",
    /// Lin, Chiang & Cui (1991): the elbow manipulator with symbolic parameters.
    lin_elbow_symbolic = "arms/lin_elbow_symbolic.toml",
    /// Jweeg & Al-Khafaji (2012): the two-link arm with symbolic lengths.
    jweeg_two_link = "arms/jweeg_two_link.toml",
}
}

/// The robot file of an arm, symbolic or not.
pub fn toml(id: &str) -> Option<&'static str> {
    let symbolic = || SYMBOLIC.iter().find(|arm| arm.id == id).map(|arm| arm.toml);
    arm(id).map(|arm| arm.toml).or_else(symbolic)
}

/// The arm with a given id.
pub fn arm(id: &str) -> Option<&'static Arm> {
    ARMS.iter().find(|arm| arm.id == id)
}
