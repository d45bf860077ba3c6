//! The trait of an output: its method, whose arguments and result follow from the table.

/// What a method returns, by the rows and the columns of its output.
macro_rules! value {
    (true $sides:tt $S:ident $N:ident) => { Result<value!(false $sides $S $N), Unstable> };
    (false [Axes Frame] $S:ident $N:ident) => { crate::Pose<$S> };
    (false [Axes Frames] $S:ident $N:ident) => { [crate::Pose<$S>; $N] };
    (false [One One] $S:ident $N:ident) => { [$S; 1] };
    (false [Twist One] $S:ident $N:ident) => { [$S; 6] };
    (false [Joints One] $S:ident $N:ident) => { [$S; $N] };
    (false [Twist Wrench] $S:ident $N:ident) => { [[$S; 6]; 6] };
    (false [Twist Joints] $S:ident $N:ident) => { [[$S; 6]; $N] };
    (false [Twist JointsByJoints] $S:ident $N:ident) => { [[[$S; 6]; $N]; $N] };
    (false [Twist WrenchByJoints] $S:ident $N:ident) => { [[[$S; 6]; 6]; $N] };
    (false [Joints Joints] $S:ident $N:ident) => { [[$S; $N]; $N] };
}

/// `pub trait Jacobian<const N: usize, S>: Arm<N, S> { fn jacobian(…) -> …; }`, its documentation and how the
/// compiler tells that it is missing.
macro_rules! has {
    ($doc:literal $output:ident $name:ident [Joints] [$rows:ident Entries] false) => {
        has! { $doc $output
            /// A column for each entry of the table: more than N alone can say.
            type Columns: Copy + AsRef<[[S; 6]]>;
            #[doc = $doc]
            fn $name(&self, posture: &Self::Posture) -> Self::Columns;
        }
    };
    ($doc:literal $output:ident $name:ident [Joints $($input:ident)*] $sides:tt $fallible:tt) => {
        has! { $doc $output $name [$($input)*] [] value!($fallible $sides S N) }
    };
    ($doc:literal $output:ident $name:ident [Rates $($more:ident)*] [$($to:tt)*] $value:ty) => {
        has! { $doc $output $name [$($more)*] [$($to)* qd: &[S; N],] $value }
    };
    ($doc:literal $output:ident $name:ident [Accelerations $($more:ident)*] [$($to:tt)*] $value:ty) => {
        has! { $doc $output $name [$($more)*] [$($to)* qdd: &[S; N],] $value }
    };
    ($doc:literal $output:ident $name:ident [Torques $($more:ident)*] [$($to:tt)*] $value:ty) => {
        has! { $doc $output $name [$($more)*] [$($to)* tau: &[S; N],] $value }
    };
    ($doc:literal $output:ident $name:ident [Wrench] [$($to:tt)*] $value:ty) => {
        has! { $doc $output $name [] [$($to)* wrench: &[S; 6],] $value }
    };
    ($doc:literal $output:ident $name:ident [] [$($to:tt)*] $value:ty) => {
        has! { $doc $output
            #[doc = $doc]
            fn $name(&self, posture: &Self::Posture, $($to)*) -> $value;
        }
    };
    ($doc:literal $output:ident $($item:item)+) => {
        #[doc = $doc]
        #[diagnostic::on_unimplemented(
            message = "`{Self}` has not been generated with this output, or for these joints and numbers",
            note = "an arm has every output but where `outputs` are named: in its table, its robot file or on the \
                    command line"
        )]
        pub trait $output<const N: usize, S: Scalar = f64>: Arm<N, S> { $($item)+ }
    };
}
pub(super) use {has, value};
