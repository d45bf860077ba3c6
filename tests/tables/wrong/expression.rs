//! A cell holds one number or one parameter; here are a sum, a product and a sign.

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    joint | theta  | d        | a    | alpha
    a1    | q      | d1 + 0.1 | 2*a1 | 0
    a2    | q + t2 | 0        | -a2  | al2/2
}

fn main() {
    let p = arm::Parameters { d1: 0.1, a1: 0.2, t2: 0.3, a2: 0.4, al2: 0.5 };
    let constants = arm::Constants::new(&p);
    println!("{:?}", arm::jacobian(&constants, &[0.1, 0.2])[1]);
}
