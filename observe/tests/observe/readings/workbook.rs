//! Dates and times of day in workbooks: an xlsx is a zip of XML, here one that is not compressed.

use super::*;

/// Cell formats of the test's workbooks: general, date and time, a day, a time of day, a duration.
const STYLES: &str = r#"<styleSheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"><cellXfs count="5"><xf numFmtId="0"/><xf numFmtId="22"/><xf numFmtId="14"/><xf numFmtId="21"/><xf numFmtId="46"/></cellXfs></styleSheet>"#;

/// The checksum of zip (ISO 3309).
fn crc(bytes: &[u8]) -> u32 {
    let byte = |crc: u32, byte: &u8| {
        (0..8)
            .fold(crc ^ u32::from(*byte), |c, _| (c >> 1) ^ (0xedb8_8320 & (c & 1).wrapping_neg()))
    };
    !bytes.iter().fold(!0, byte)
}

fn zipped(files: &[(&str, String)]) -> Vec<u8> {
    let (mut zip, mut directory) = (Vec::new(), Vec::new());
    for (name, text) in files {
        let size = (text.len() as u32).to_le_bytes();
        let head = [
            &[20, 0, 0, 0, 0, 0, 0, 0, 0, 0][..],
            &crc(text.as_bytes()).to_le_bytes(),
            &size,
            &size,
            &(name.len() as u16).to_le_bytes(),
            &[0, 0],
        ]
        .concat();
        let at = (zip.len() as u32).to_le_bytes();
        directory
            .extend([&b"PK\x01\x02\x14\0"[..], &head, &[0; 10], &at, name.as_bytes()].concat());
        zip.extend([&b"PK\x03\x04"[..], &head, name.as_bytes(), text.as_bytes()].concat());
    }
    let count = (files.len() as u16).to_le_bytes();
    let [size, at] = [directory.len(), zip.len()].map(|n| (n as u32).to_le_bytes());
    let end = [&b"PK\x05\x06\0\0\0\0"[..], &count, &count, &size, &at, &[0, 0]].concat();
    [zip, directory, end].concat()
}

/// A workbook of one sheet: a header, and rows of numbers with the format of each column.
fn workbook(epoch: &str, names: &[&str], formats: &[usize], rows: &[&[f64]]) -> Sheet {
    let letter = |k: usize| char::from(b'A' + k as u8);
    let name = |(k, name): (usize, &&str)| {
        format!(r#"<c r="{}1" t="inlineStr"><is><t>{name}</t></is></c>"#, letter(k))
    };
    let header: String = names.iter().enumerate().map(name).collect();
    let row = |(r, row): (usize, &&[f64])| {
        let cell = |(k, (x, s)): (usize, (&f64, &usize))| {
            format!(r#"<c r="{}{}" s="{s}"><v>{x}</v></c>"#, letter(k), r + 2)
        };
        let cells: String = row.iter().zip(formats).enumerate().map(cell).collect();
        format!(r#"<row r="{}">{cells}</row>"#, r + 2)
    };
    let body: String = rows.iter().enumerate().map(row).collect();
    let (sheets, kinds) = (
        "http://schemas.openxmlformats.org/spreadsheetml/2006/main",
        "http://schemas.openxmlformats.org/officeDocument/2006/relationships",
    );
    let related = |id: &str, kind: &str, to: &str| {
        format!(r#"<Relationship Id="{id}" Type="{kinds}/{kind}" Target="{to}"/>"#)
    };
    let relations = |all: String| {
        let of = "http://schemas.openxmlformats.org/package/2006/relationships";
        format!(r#"<Relationships xmlns="{of}">{all}</Relationships>"#)
    };
    let book = format!(
        r#"<workbook xmlns="{sheets}" xmlns:r="{kinds}">{epoch}<sheets><sheet name="run" sheetId="1" r:id="rId1"/></sheets></workbook>"#
    );
    let sheet = format!(
        r#"<worksheet xmlns="{sheets}"><sheetData><row r="1">{header}</row>{body}</sheetData></worksheet>"#
    );
    let parts = [
        related("rId1", "worksheet", "worksheets/sheet1.xml"),
        related("rId2", "styles", "styles.xml"),
    ];
    let bytes = zipped(&[
        ("_rels/.rels", relations(related("rId1", "officeDocument", "xl/workbook.xml"))),
        ("xl/workbook.xml", book),
        ("xl/_rels/workbook.xml.rels", relations(parts.concat())),
        ("xl/styles.xml", STYLES.to_owned()),
        ("xl/worksheets/sheet1.xml", sheet),
    ]);
    Sheet::new("run.xlsx", bytes)
}

fn imported(sheet: &Sheet) -> Imported {
    import(sheet, None, &Map::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// Noon on 13 October 2025 and a fraction is one time, since 1900, since 1904 and as a text.
#[test]
fn dates_are_seconds_since_1970_whatever_the_workbook_counts_from() {
    const NOON: f64 = 45_943.541;
    for (epoch, first) in [("", 0.0), (r#"<workbookPr date1904="1"/>"#, 1462.0)] {
        let names = ["J1", "X", "Y", "Z", "Time"];
        let rows: [&[f64]; 2] = [
            &[0.1, 1.0, 2.0, 3.0, NOON - first],
            &[0.2, 1.0, 2.0, 3.0, NOON - first + 1.0 / 86_400.0],
        ];
        let book = workbook(epoch, &names, &[0, 0, 0, 0, 1], &rows);
        let found = imported(&book);
        let lines: Vec<&str> = found.csv.lines().collect();
        assert_eq!(lines[0], "q1[rad],x[m],y[m],z[m],time[s]", "{}", found.csv);
        // Of days a double holds microseconds.
        for (line, expected) in lines[1..].iter().zip([1_760_360_342.4, 1_760_360_343.4]) {
            let time: f64 = line.rsplit(',').next().unwrap().parse().unwrap();
            assert!((time - expected).abs() < 2e-6, "{line}");
        }
        assert!(
            found.said.iter().any(|said| said.contains("seconds since 1970")),
            "{:?}",
            found.said
        );
        // A controller's text of that day has the same clock.
        let text = "Time,Override\n2025-10-13 12:59:02,50\n2025-10-13 12:59:04,70\n";
        let other = Sheet::new("controller.csv", text.as_bytes().to_vec());
        let both = import(&book, Some((&other, &By::from("time".to_owned()))), &Map::default());
        let both = both.unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(both.csv.lines().count(), 3, "{}", both.csv);
    }
}

#[test]
fn days_times_of_day_and_durations_are_told_apart() {
    let names = ["J1", "X", "Y", "Z", "Date", "Time"];
    let row: [&[f64]; 1] = [&[0.1, 1.0, 2.0, 3.0, 45_943.0, 0.25]];
    let found = imported(&workbook("", &names, &[0, 0, 0, 0, 2, 3], &row));
    let time = found.csv.lines().nth(1).and_then(|line| line.rsplit(',').next());
    assert_eq!(time, Some("1760335200"), "{}", found.csv);
    let row: [&[f64]; 2] = [&[0.1, 1.0, 2.0, 3.0, 0.5], &[0.1, 1.0, 2.0, 3.0, 1.5]];
    let found = imported(&workbook("", &["J1", "X", "Y", "Z", "Time"], &[0, 0, 0, 0, 4], &row));
    let times: Vec<_> = found.csv.lines().skip(1).map(|l| l.rsplit(',').next().unwrap()).collect();
    assert_eq!(times, ["43200", "129600"], "{}", found.csv);
}
