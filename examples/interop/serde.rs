//! What kernels return, and rows of a table, through serde: as JSON and back, bit for bit (serde_json reads doubles
//! so with its feature `float_roundtrip`).
//!
//! ```text
//! cargo run -p stiffarm --example with_serde --features serde
//! ```

use stiffarm::kernels::{Numeric, Ops, Output, Pose, Row, Unstable};

stiffarm::robot! {
    mod ur5 from "robots/arms/ur5.toml";
    outputs: pose;
}

fn main() -> Result<(), serde_json::Error> {
    let pose = ur5::pose(&[0.1, -0.9, 1.2, 0.3, 0.5, 0.7]);
    let text = serde_json::to_string(&pose)?;
    println!("{text}");
    assert_eq!(serde_json::from_str::<Pose<f64>>(&text)?, pose);

    let text = serde_json::to_string(&ur5::pose::OPS)?;
    println!("{text}");
    assert_eq!(serde_json::from_str::<Ops>(&text)?, ur5::pose::OPS);

    for row in <ur5::Robot as Numeric<6>>::ROWS {
        assert_eq!(serde_json::from_str::<Row>(&serde_json::to_string(&row)?)?, row);
    }
    let refused: Result<[f64; 6], Unstable> = Err(Unstable);
    let text = serde_json::to_string(&refused)?;
    assert_eq!(serde_json::from_str::<Result<[f64; 6], Unstable>>(&text)?, refused);
    // An output is told by its name.
    for output in Output::EACH {
        let text = serde_json::to_string(&output)?;
        assert_eq!(text, format!("{:?}", output.name()));
        assert_eq!(serde_json::from_str::<Output>(&text)?, output);
    }
    Ok(())
}
