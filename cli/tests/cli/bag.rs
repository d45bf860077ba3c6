//! A bag of ROS 2, as a recorder writes it.

use crate::support::{Folder, REPOSITORY, has, read, run};

/// Rests in a bag are the rows that those of a text are: half a second's, where nothing is said. A build that reads no bag
/// says which one does.
pub fn gives_the_same(folder: &Folder, log: &str, expected: &str) {
    let bag = folder.name("held.mcap");
    std::fs::write(&bag, recorded(log)).expect("a file");
    let made = folder.name("of_bag.csv");
    let parts = read(&format!("{REPOSITORY}/robots/arms/irb120.toml"));
    let mut parts = parts.split("[[joint]]");
    let first = parts.next().unwrap_or_default().to_owned();
    let joints = (1..).zip(parts).map(|(k, row)| format!("[[joint]]\nname = \"joint_{k}\"{row}"));
    let named = folder.file("named.toml", &(first + &joints.collect::<String>()));
    let run =
        run(&format!("measurements {bag} --quiet --set point=one --robot {named} --csv {made}"));
    if !cfg!(feature = "logs") {
        return has(&run.refused(), &["cargo install --path cli --features logs"]);
    }
    run.good();
    assert_eq!(read(&made), expected);
}

/// A log of seconds and joint values as `sensor_msgs/JointState` in an MCAP file without compression or index
/// (mcap.dev/spec): the joints by their names, in another order than the arm's.
fn recorded(log: &str) -> Vec<u8> {
    const MAGIC: &[u8] = b"\x89MCAP0\r\n";
    let record = |operation: u8, content: &[&[u8]]| {
        let content = content.concat();
        [&[operation][..], &(content.len() as u64).to_le_bytes(), &content].concat()
    };
    let string = |text: &str| [&(text.len() as u32).to_le_bytes(), text.as_bytes()].concat();
    let (id, none) = (1_u16.to_le_bytes(), string(""));
    let schema = [string("sensor_msgs/msg/JointState"), string("ros2msg")].concat();
    let channel = [string("/joint_states"), string("cdr")].concat();
    let mut bag = [
        MAGIC,
        &record(0x01, &[&none, &none]),
        &record(0x03, &[&id, &schema, &none]),
        &record(0x04, &[&id, &id, &channel, &none]),
    ]
    .concat();
    for line in log.lines().skip(1) {
        let row: Vec<f64> = line.split(',').map(|cell| cell.parse().expect("a number")).collect();
        // Since 1970: a stamp of 0 is none.
        let nanoseconds = 1_700_000_000_000_000_000 + (1e9 * row[0]).round() as u64;
        let at = nanoseconds.to_le_bytes();
        let of = [&id[..], &[0; 4], &at, &at].concat();
        bag.extend(record(0x05, &[&of, &joint_state(nanoseconds, &row[1..])]));
    }
    [&bag[..], &record(0x0f, &[&[0; 4]]), &record(0x02, &[&[0; 20]]), MAGIC].concat()
}

/// In the Common Data Representation: numbers stand at multiples of their size behind the first four bytes. All texts here
/// have seven letters and a zero.
fn joint_state(nanoseconds: u64, q: &[f64]) -> Vec<u8> {
    let number = |n: usize| u32::try_from(n).expect("few").to_le_bytes();
    let text = |text: &str| [&number(8), text.as_bytes(), &[0]].concat();
    let joints = (0..q.len()).rev();
    let names = joints.clone().map(|joint| text(&format!("joint_{}", joint + 1)));
    let seconds = (nanoseconds / 1_000_000_000) as usize;
    let stamp = [number(seconds), number((nanoseconds % 1_000_000_000) as usize)].concat();
    let count = number(q.len()).to_vec();
    let mut data = [vec![0, 1, 0, 0], stamp, text("base_xy"), count.clone()].concat();
    data.extend(names.flatten().chain(count));
    data.resize(4 + (data.len() - 4).next_multiple_of(8), 0);
    data.extend(joints.flat_map(|joint| q[joint].to_le_bytes()));
    data.extend([0; 8]); // neither velocities nor efforts
    data
}
