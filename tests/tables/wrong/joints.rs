//! More joints than an arm has.

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    joint | theta
    j1  | q
    j2  | q
    j3  | q
    j4  | q
    j5  | q
    j6  | q
    j7  | q
    j8  | q
    j9  | q
    j10 | q
    j11 | q
    j12 | q
    j13 | q
    j14 | q
    j15 | q
    j16 | q
    j17 | q
    j18 | q
    j19 | q
    j20 | q
    j21 | q
    j22 | q
    j23 | q
    j24 | q
    j25 | q
    j26 | q
    j27 | q
    j28 | q
    j29 | q
    j30 | q
    j31 | q
    j32 | q
    j33 | q
    j34 | q
    j35 | q
    j36 | q
    j37 | q
    j38 | q
    j39 | q
    j40 | q
    j41 | q
    j42 | q
    j43 | q
    j44 | q
    j45 | q
    j46 | q
    j47 | q
    j48 | q
    j49 | q
    j50 | q
    j51 | q
    j52 | q
    j53 | q
    j54 | q
    j55 | q
    j56 | q
    j57 | q
    j58 | q
    j59 | q
    j60 | q
    j61 | q
    j62 | q
    j63 | q
    j64 | q
    j65 | q
}

fn main() {
    let (q, w) = ([0.1; arm::N], [0.0; 6]);
    let lift = arm::jacobian(&q)[0][2];
    println!("{lift} {:?} {:?}", arm::pose(&q).position, arm::deflection(&q, &w));
    println!("{:?} {:?}", arm::all(&q, &w).map(|all| all.jacobian), arm::jacobian::OPS);
    let _: &dyn stiffarm::kernels::Kernels<f64> = &arm::Robot;
}
