//! Places in which the macro may stand.

/// Another macro that writes the table.
macro_rules! planar {
    ($(#[$doc:meta])* $vis:vis $name:ident: $($joint:ident $reach:literal),+) => {
        stiffarm::robot! {
            $(#[$doc])*
            $vis mod $name;
            convention: standard_dh;
            joint | theta | d | a
            $($joint | q | 0 | $reach)+
        }
    };
}

planar! {
    /// Two links.
    pub two: upper 0.3, lower 0.2
}
planar!(one: only 1);

mod renamed {
    //! The crate may have another name.
    pub use stiffarm as arms;

    arms::robot! {
        #[allow(dead_code)]
        #[doc = "An attribute of any kind."]
        pub(crate) mod arm;
        crate: crate::right::places::renamed::arms::kernels;
        convention: standard_dh;
        joint | theta | a
        a1    | q     | 1
    }
}

stiffarm::robot! {
    mod r#move;
    convention: standard_dh;
    joint | theta | a
    a1    | q     | 1
}

#[test]
fn a_macro_may_write_the_table() {
    assert_eq!(two::DH.map(|row| (row.joint, row.a)), [("upper", "0.3"), ("lower", "0.2")]);
    assert_eq!(one::N, 1);
}

#[test]
fn the_module_may_stand_in_a_function() {
    stiffarm::robot! {
        mod local;
        convention: modified_dh;
        joint | theta | d
        lift  | 0     | q
    }
    assert_eq!(local::pose(&[0.4_f32]).position, [0.0, 0.0, 0.4]);
}

#[test]
fn the_crate_may_be_renamed_and_the_module_be_a_keyword() {
    assert_eq!(renamed::arm::N, 1);
    assert_eq!((r#move::N, r#move::NAME), (1, "move"));
}
