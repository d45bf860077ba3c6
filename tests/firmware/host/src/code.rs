//! Where the machine code of a function goes: calls and branches of Thumb-2.
//!
//! ARMv7-M Architecture Reference Manual (DDI 0403E), A5.2, A5.3 and A7.7.

/// An instruction that may not go on to the next one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// Calls the function at this address.
    Call(u32),
    /// Goes on at this address, whatever the data.
    Jump(u32),
    /// Goes on there or not, as the data say.
    Branch(u32),
    /// Goes on at an address that is worked out: a call by pointer, a table of jumps.
    Indirect,
}

/// What flows elsewhere in the instructions `code`, which stand at `address`. Instructions alone:
/// data between them has to be left out by the caller.
pub fn flows(code: &[u8], address: u32) -> Vec<Flow> {
    let half =
        |at: usize| Some(u32::from(u16::from_le_bytes([*code.get(at)?, *code.get(at + 1)?])));
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(first) = half(at) {
        // What an offset counts from.
        let here = address + at as u32 + 4;
        at += 2;
        if first >> 11 < 0b11101 {
            found.extend(short(first, here));
        } else {
            found.extend(half(at).and_then(|second| long(first, second, here)));
            at += 2;
        }
    }
    found
}

/// `value`'s lowest `bits` bits as a signed number.
fn signed(value: u32, bits: u32) -> u32 {
    ((value << (32 - bits)).cast_signed() >> (32 - bits)).cast_unsigned()
}

/// An instruction of 16 bits.
fn short(code: u32, here: u32) -> Option<Flow> {
    let to = |offset: u32| here.wrapping_add(offset);
    match code {
        // B<cond>; conditions 1110 and 1111 are UDF and SVC.
        _ if code >> 12 == 0b1101 && code >> 9 & 7 != 7 => {
            Some(Flow::Branch(to(signed(code << 1 & 0x1ff, 9))))
        }
        _ if code >> 11 == 0b11100 => Some(Flow::Jump(to(signed(code << 1 & 0xfff, 12)))),
        // CBZ, CBNZ.
        _ if code & 0xf500 == 0xb100 => {
            Some(Flow::Branch(to((code >> 3 & 0x40) | (code >> 2 & 0x3e))))
        }
        // BX lr returns; BX and BLX of another register go wherever it says, and so do MOV pc and
        // ADD pc.
        _ if code & 0xff80 == 0x4700 => (code != 0x4770).then_some(Flow::Indirect),
        _ if code & 0xff80 == 0x4780 => Some(Flow::Indirect),
        _ if code & 0xff87 == 0x4687 || code & 0xff87 == 0x4487 => Some(Flow::Indirect),
        _ => None,
    }
}

/// An instruction of 32 bits.
fn long(first: u32, second: u32, here: u32) -> Option<Flow> {
    // TBB, TBH.
    if first & 0xfff0 == 0xe8d0 && second & 0xffe0 == 0xf000 {
        return Some(Flow::Indirect);
    }
    if first >> 11 != 0b11110 || second >> 15 != 1 {
        return None;
    }
    let (sign, low) = (first >> 10 & 1, second & 0x7ff);
    let (j1, j2) = (second >> 13 & 1, second >> 11 & 1);
    // Of 25 bits: sign, two that are inverted unless it is set, ten, eleven, and a zero.
    let far = || {
        let (i1, i2) = (1 ^ j1 ^ sign, 1 ^ j2 ^ sign);
        let offset = sign << 24 | i1 << 23 | i2 << 22 | (first & 0x3ff) << 12 | low << 1;
        here.wrapping_add(signed(offset, 25))
    };
    match (second >> 14 & 1, second >> 12 & 1) {
        (1, 1) => Some(Flow::Call(far())),
        (0, 1) => Some(Flow::Jump(far())),
        // B<cond>.W; conditions 111x are other instructions.
        (0, 0) if first >> 7 & 7 != 7 => {
            let offset = sign << 20 | j2 << 19 | j1 << 18 | (first & 0x3f) << 12 | low << 1;
            Some(Flow::Branch(here.wrapping_add(signed(offset, 21))))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By `arm-none-eabi-as`, at 0x1000.
    #[test]
    fn the_assembler_s_encodings_are_read() {
        let at = |bytes: &[u8]| flows(bytes, 0x1000);
        assert_eq!(at(&[0x00, 0xf0, 0xfe, 0xf8]), [Flow::Call(0x1200)]); // bl 0x1200
        assert_eq!(at(&[0xff, 0xf7, 0xfe, 0xff]), [Flow::Call(0x1000)]); // bl 0x1000
        assert_eq!(at(&[0x00, 0xf0, 0xfe, 0xb8]), [Flow::Jump(0x1200)]); // b.w 0x1200
        assert_eq!(at(&[0xfe, 0xe7]), [Flow::Jump(0x1000)]); // b 0x1000
        assert_eq!(at(&[0xfe, 0xd0]), [Flow::Branch(0x1000)]); // beq 0x1000
        assert_eq!(at(&[0x00, 0xf0, 0xfe, 0x80]), [Flow::Branch(0x1200)]); // beq.w 0x1200
        assert_eq!(at(&[0x08, 0xb1]), [Flow::Branch(0x1006)]); // cbz r0, 0x1006
        assert_eq!(at(&[0x98, 0x47]), [Flow::Indirect]); // blx r3
        assert_eq!(at(&[0xdf, 0xe8, 0x00, 0xf0]), [Flow::Indirect]); // tbb [pc, r0]
        assert_eq!(at(&[0x70, 0x47]), []); // bx lr
        assert_eq!(at(&[0x20, 0xee, 0x20, 0x0a]), []); // vmul.f32 s0, s0, s1
    }
}
