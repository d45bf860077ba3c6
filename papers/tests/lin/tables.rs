//! Tables I, II and III.

use crate::method::deflections;

use crate::arms::{Links, WEIGHTS, planar, two_link, weight};

/// theta1, YC and YT.
const TABLE_1: [(f64, f64); 5] =
    [(0.0, 0.00122), (20.0, 0.00107), (40.0, 0.00071), (60.0, 0.00030), (80.0, 0.00004)];

/// theta1, theta2, YC, YT, PTG.
const TABLE_2: [[f64; 5]; 13] = [
    [0.0, 0.0, 0.01523, 0.00959, 37.03],
    [0.0, 22.5, 0.01356, 0.00856, 36.88],
    [0.0, 90.0, 0.00179, 0.00179, 0.0],
    [22.5, -22.5, 0.01466, 0.00921, 37.18],
    [22.5, -45.0, 0.01300, 0.00819, 37.00],
    [22.5, 67.5, 0.00152, 0.00152, 0.00],
    [45.0, 0.0, 0.00762, 0.00480, 37.00],
    [45.0, -45.0, 0.01313, 0.00825, 37.17],
    [45.0, -67.5, 0.01154, 0.00725, 37.18],
    [67.5, -22.5, 0.00604, 0.00381, 36.84],
    [67.5, -45.0, 0.00969, 0.00616, 36.36],
    [90.0, -22.5, 0.00137, 0.00092, 32.85],
    [90.0, -45.0, 0.00466, 0.00314, 32.62],
];

/// theta1, theta2, YC, YT, YD, YTD, YCD.
const TABLE_3: [[f64; 7]; 12] = [
    [0.0, 0.0, 0.0033, 0.0022, 0.0095, 0.0118, 0.0128],
    [0.0, 22.5, 0.0029, 0.0020, 0.0084, 0.0104, 0.0113],
    [22.5, -22.5, 0.0032, 0.0022, 0.0092, 0.0114, 0.0124],
    [22.5, -45.0, 0.0029, 0.0019, 0.0081, 0.0100, 0.0110],
    [45.0, 0.0, 0.0017, 0.0011, 0.0048, 0.0059, 0.0065],
    [45.0, -22.5, 0.0026, 0.0018, 0.0073, 0.0090, 0.0099],
    [45.0, -45.0, 0.0030, 0.0020, 0.0083, 0.0103, 0.0113],
    [45.0, -67.5, 0.0026, 0.0018, 0.0073, 0.0090, 0.0099],
    [67.5, -22.5, 0.0014, 0.0009, 0.0038, 0.0048, 0.0052],
    [67.5, -45.0, 0.0023, 0.0016, 0.0061, 0.0077, 0.0084],
    [90.0, -22.5, 0.0003, 0.0002, 0.0008, 0.0010, 0.0011],
    [90.0, -45.0, 0.0012, 0.0008, 0.0028, 0.0036, 0.0040],
];

/// YC, YT, YD as the tables print them: magnitudes, by the general functions.
fn magnitudes(links: &Links<2>, degrees: [f64; 2]) -> [f64; 3] {
    let q = degrees.map(f64::to_radians);
    let all = deflections(&planar(links), &q, &weight(1, links.load)).unwrap();
    [-all.castigliano.y, -all.timoshenko.y, -all.angular.y]
}

/// Rounded to `digits` decimals, as an integer.
fn rounded(value: f64, digits: i32) -> f64 {
    (value * 10f64.powi(digits)).round()
}

/// All cells, with the weight of the link, which the caption does not mention.
#[test]
fn table_1() {
    let links = two_link(WEIGHTS, 3.05);
    let mut arm = planar(&links);
    arm.joints.truncate(1);
    for (theta1, printed) in TABLE_1 {
        let all = deflections(&arm, &[theta1.to_radians()], &weight(1, links.load)).unwrap();
        assert_eq!(rounded(-all.castigliano.y, 5), rounded(printed, 5), "{theta1}");
        assert_eq!(rounded(-all.timoshenko.y, 5), rounded(printed, 5), "{theta1}");
    }
}

/// All 26 deflections to less than one unit of the last digit, 19 of them rounded alike; no pair of
/// weights gives every cell exactly.
#[test]
fn table_2() {
    let links = two_link(WEIGHTS, 3.05);
    let mut alike = 0;
    for [theta1, theta2, yc, yt, _] in TABLE_2 {
        let [c, t, _] = magnitudes(&links, [theta1, theta2]);
        for (found, printed) in [(c, yc), (t, yt)] {
            let off = (found - printed).abs() * 1e5;
            assert!(off < 0.92, "{theta1}, {theta2}: {found} for {printed}");
            alike += usize::from(off <= 0.5);
        }
    }
    assert_eq!(alike, 19);
}

/// PTG = |YT − YC|/YC: of the printed YC and YT to the last digit in 9 of 13 rows, in the others
/// within what the rounding of YC and YT leaves open.
#[test]
fn table_2_percentages() {
    let mut alike = 0;
    for [_, _, yc, yt, printed] in TABLE_2 {
        let percent = |yt: f64, yc: f64| ((yt - yc) / yc).abs() * 100.0;
        alike += usize::from((percent(yt, yc) - printed).abs() <= 0.00501);
        let half = 0.5e-5;
        let (low, high) = (percent(yt + half, yc - half), percent(yt - half, yc + half));
        assert!(yt == yc || (low..=high).contains(&printed), "{low} {printed} {high}");
    }
    assert_eq!(alike, 9);
}

/// All 36 cells of YC, YT and YD to the printed four decimals (without the weights: the gauge was
/// zeroed under them).
#[test]
fn table_3() {
    let links = two_link([0.0; 2], 1.02);
    for [theta1, theta2, yc, yt, yd, _, _] in TABLE_3 {
        let found = magnitudes(&links, [theta1, theta2]);
        for (found, printed) in found.into_iter().zip([yc, yt, yd]) {
            assert_eq!(rounded(found, 4), rounded(printed, 4), "{theta1}, {theta2}");
        }
    }
}

/// YTD is the rounded sum in 11 of 12 rows (and the sum of the rounded in the twelfth), YCD the sum
/// of the rounded YC and YD in all.
#[test]
fn table_3_totals() {
    let links = two_link([0.0; 2], 1.02);
    let mut unlike = Vec::new();
    for [theta1, theta2, yc, yt, yd, ytd, ycd] in TABLE_3 {
        let [_, t, d] = magnitudes(&links, [theta1, theta2]);
        if rounded(t + d, 4) != rounded(ytd, 4) {
            unlike.push((theta1, theta2));
            assert_eq!(rounded(yt + yd, 4), rounded(ytd, 4));
        }
        assert_eq!(rounded(yc + yd, 4), rounded(ycd, 4), "{theta1}, {theta2}");
    }
    assert_eq!(unlike, [(90.0, -22.5)]);
}
