//! A workbook of which everything is known.

use super::*;

/// The check sum of a zip archive.
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| {
            (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg())
        })
    })
}

/// A zip archive of files as they are.
fn zip(files: &[(&str, &str)]) -> Vec<u8> {
    let (mut bytes, mut directory) = (Vec::new(), Vec::new());
    for (name, text) in files {
        let at = (bytes.len() as u32).to_le_bytes();
        let [size, length] = [text.len() as u32, name.len() as u32].map(u32::to_le_bytes);
        // No flags, no method, no time.
        let head =
            [&[0; 8][..], &crc(text.as_bytes()).to_le_bytes(), &size, &size, &length[..2], &[0; 2]];
        bytes.extend(
            [&b"PK\x03\x04\x14\0"[..], &head.concat(), name.as_bytes(), text.as_bytes()].concat(),
        );
        let head = [&b"PK\x01\x02\x14\0\x14\0"[..], &head.concat(), &[0; 10], &at, name.as_bytes()];
        directory.extend(head.concat());
    }
    let [count, size, at] =
        [files.len(), directory.len(), bytes.len()].map(|n| (n as u32).to_le_bytes());
    let count = &count[..2];
    [&bytes[..], &directory, b"PK\x05\x06\0\0\0\0", count, count, &size, &at, &[0; 2]].concat()
}

/// A spreadsheet counts days: 1.5 s later is 1.5 s later, and not 17 µs.
#[test]
fn the_dates_of_a_workbook_are_seconds() {
    let word = |text: &str| format!("<c t=\"inlineStr\"><is><t>{text}</t></is></c>");
    let names: String = ["J1", "Zeit", "X [mm]"].map(word).concat();
    let row = |day: f64| {
        format!("<row><c><v>35.5</v></c><c s=\"1\"><v>{day}</v></c><c><v>1200</v></c></row>")
    };
    let rows = row(45_985.5) + &row(45_985.5 + 1.5 / 86_400.0);
    let main = "xmlns=\"http://schemas.openxmlformats.org/spreadsheetml/2006/main\"";
    let of = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
    let book = zip(&[
        (
            "xl/workbook.xml",
            &format!(
                "<workbook {main} xmlns:r=\"{of}\"><sheets><sheet name=\"Run\" sheetId=\"1\" r:id=\"r1\"/>\
                 </sheets></workbook>"
            ),
        ),
        (
            "xl/_rels/workbook.xml.rels",
            &format!(
                "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\
                 <Relationship Id=\"r1\" Type=\"{of}/worksheet\" Target=\"worksheets/sheet1.xml\"/>\
                 </Relationships>"
            ),
        ),
        (
            "xl/styles.xml",
            &format!(
                "<styleSheet {main}><cellXfs><xf numFmtId=\"0\"/><xf numFmtId=\"22\"/></cellXfs></styleSheet>"
            ),
        ),
        (
            "xl/worksheets/sheet1.xml",
            &format!(
                "<worksheet {main}><sheetData><row>{names}</row>{rows}</sheetData></worksheet>"
            ),
        ),
    ]);
    let imported = import(&Sheet::new("run.xlsx", book), None, &Map::default());
    let imported = imported.unwrap_or_else(|error| panic!("{error}"));
    let rows: Vec<Vec<&str>> = imported.csv.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0], ["q1[deg]", "time[s]", "x[mm]"]);
    let time = |k: usize| rows[k][1].parse::<f64>().unwrap();
    assert!((time(2) - time(1) - 1.5).abs() < 1e-3, "{rows:?}");
    assert!((time(1) - 45_985.5 * 86_400.0).abs() < 1e-3, "{rows:?}");
}
