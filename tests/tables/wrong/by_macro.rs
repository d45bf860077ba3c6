//! The table comes out of another macro: each mistake is where its token was written.

macro_rules! arm {
    ($name:ident, $reach:expr, $twist:literal) => {
        stiffarm::robot! {
            pub mod $name;
            convention: modified_dh;
            joint | theta | d | a      | alpha
            a1    | q     | 0 | $reach | 0
            a2    | q     | 0 | 350 kg | $twist
        }
    };
}

arm!(arm, reach, 1.5708);

fn main() {
    let p = arm::Parameters { reach: 0.5 };
    println!("{:?}", arm::pose(&arm::Constants::new(&p), &[0.1, 0.2]));
}
