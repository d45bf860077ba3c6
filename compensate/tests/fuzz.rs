//! Whatever a program is, it is read or refused at one of its bytes, and what is not changed stays.

use proptest::prelude::*;
use stiffarm_compensate::program::{File, Language, Program, edited};

/// Pieces of which texts are made that nearly are programs.
const PIECES: [&str; 40] = [
    "DECL ",
    "E6POS ",
    "FDAT ",
    "XP1",
    "FP1",
    "=",
    "{",
    "}",
    "X 1",
    ",Y -2.5E3",
    "A1 .5",
    "PTP ",
    "LIN_REL ",
    "$BASE",
    "BAS(#TOOL,1)",
    "\n",
    "\r\n",
    ";",
    "!",
    "#",
    "robtarget ",
    "p10",
    ":=",
    "[[1,2,3]",
    "[1,0,0,0]",
    "]",
    "[",
    "MoveL ",
    "tool0\\WObj:=w",
    "/POS\n",
    "P[1]",
    "GP1:",
    "UF : 1",
    "CONFIG : 'N U T, 0, 0, 0'",
    "movej(",
    "p[0,0,0,0,0,0]",
    ")",
    "pose_trans(",
    "q1[deg],q2",
    "\u{e4}\"",
];

fn read(name: &str, text: &[u8]) {
    let language = Language::of(name).expect("a language");
    let file = File { name: name.to_owned(), text: text.to_vec() };
    match Program::read(vec![file], language, 2) {
        Ok(program) => {
            assert_eq!(edited(&program.files[0].text, Vec::new()), text);
            let spans = program.points.iter().map(|point| &point.span);
            for span in spans.chain(program.left.iter().map(|left| &left.span)) {
                assert!(span.start <= span.end && span.end <= text.len(), "{span:?}");
            }
        }
        Err(fault) => assert!(fault.span.end <= text.len(), "{fault:?}"),
    }
}

proptest! {
    #[test]
    fn any_text_is_read_or_refused(
        pieces in prop::collection::vec(0..PIECES.len(), 0..60),
        bytes in prop::collection::vec(any::<u8>(), 0..80),
    ) {
        let text: String = pieces.iter().map(|k| PIECES[*k]).collect();
        for name in ["a.src", "a.dat", "a.mod", "a.ls", "a.script", "a.csv"] {
            read(name, text.as_bytes());
            read(name, &bytes);
            read(name, format!("/POS\n{text}").as_bytes());
        }
    }
}
