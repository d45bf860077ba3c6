//! The kernels that the benches time, generated plain and fused, and with the inverse of their kinematics.
//!
//! It is a package of its own since clippy takes a minute for its text, and so that its instructions are
//! counted without compiling what the other benches need.

pub mod lanes;

macro_rules! arm {
    ($($name:ident)+) => {
        $(pub mod $name {
            /// Products and sums rounded one by one.
            pub mod plain {
                include!(concat!(env!("OUT_DIR"), "/", stringify!($name), "_plain.rs"));
            }
            /// Products fused into sums.
            pub mod fused {
                include!(concat!(env!("OUT_DIR"), "/", stringify!($name), "_fused.rs"));
            }
        })+
    };
}

arm!(planar_2r ur10 kuka_kr240 iiwa14 panda);

macro_rules! inverse {
    ($($name:ident)+) => {
        /// Arms with the inverse of their kinematics, and set-points under a load.
        pub mod inverse {
            $(pub mod $name {
                include!(concat!(env!("OUT_DIR"), "/", stringify!($name), "_inverse.rs"));
            })+
        }
    };
}

inverse!(ur10 kuka_kr240 irb120 panda iiwa14 calibrated_ur10 calibrated_kuka);

/// From which sides the joints of the calibrated arms come.
pub const SIDES: [f64; 6] = [1.0, -1.0, 1.0, 1.0, -1.0, 1.0];

/// The compiler that the kernels were compiled by.
pub const RUSTC: &str = env!("STIFFARM_RUSTC");
