//! Functions of the file's arm take sides and a temperature; what is asked for is none of them.

stiffarm::robot! {
    pub mod arm from "files/corrected.toml";
    outputs: pose, jacobain;
}

fn main() {
    let (q, sides) = ([0.1; arm::N], [1.0; arm::N]);
    println!("{:?} {:?}", arm::joints(&q, &sides, 8.0), arm::pose(&q, &sides, 8.0));
    println!("{:?}", arm::deflection(&q, &sides, 8.0, &[0.0; 6]));
    let _: &dyn stiffarm::kernels::Kernels<f64> = &arm::Robot { sides, warming: 8.0 };
    let _: &dyn stiffarm::kernels::Kernels<f64> = &arm::Robot::<f64>::default();
}
