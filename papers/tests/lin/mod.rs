//! Lin, Chiang & Cui, *An improved method for on-line calculation and compensation of the static
//! deflection at a robot end-effector*, J. Robotic Systems 8(2), 1991, in the paper's inches and pounds:
//! its equations, corrected, against the textbook. Each is judged in the ledger, as are the tables. The
//! ten steps are those of `stiffarm compensate` (`stiffarm_compensate::reach`).

mod arms;
mod equations;
mod printed;
mod table_5;
