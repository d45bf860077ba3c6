//! Logs in MCAP files, read message by message: a file with pictures in it may be larger than memory.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::io::Read;

use mcap::parse_record;
use mcap::records::Record;
use mcap::sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions};
use stiffarm_kernels::Motion;

use super::cdr::Encoding;
use super::ros::{Heard, Kind};
use super::{Log, Names, unreadable};
use crate::io::ReadError;

/// So many bytes are read at once.
const MOST: usize = 1 << 20;

/// A record or an unpacked chunk of more is none: a broken length would ask for all memory there is.
const LONGEST: usize = 1 << 28;

pub(super) fn read(
    file: &str,
    mut source: impl Read,
    motions: &[Motion],
    names: &Names,
) -> Result<Log, ReadError> {
    let broken = |error: &dyn Display| unreadable(file, "an MCAP file", error);
    let options = LinearReaderOptions::default().with_record_length_limit(LONGEST);
    let mut reader = LinearReader::new_with_options(options);
    let mut schemas: BTreeMap<u16, Kind> = BTreeMap::new();
    let mut channels: BTreeMap<u16, (String, Kind, Encoding)> = BTreeMap::new();
    let mut heard = Heard::default();
    while let Some(event) = reader.next_event() {
        match event.map_err(|e| broken(&e))? {
            LinearReadEvent::ReadRequest(count) => {
                // A broken file asks for more than there is.
                let part = reader.insert(count.min(MOST));
                let read = source.read(part).map_err(|e| broken(&e))?;
                reader.notify_read(read);
            }
            LinearReadEvent::Record { data, opcode } => {
                match parse_record(opcode, data).map_err(|e| broken(&e))? {
                    Record::Schema { header, .. } => {
                        schemas.extend(Kind::of(&header.name).map(|kind| (header.id, kind)));
                    }
                    Record::Channel(channel) => {
                        let kind = schemas.get(&channel.schema_id).copied();
                        let encoding = Encoding::named(&channel.message_encoding);
                        if let (Some(kind), Some(encoding)) = (kind, encoding) {
                            channels.insert(channel.id, (channel.topic, kind, encoding));
                        }
                    }
                    Record::Message { header, data } => {
                        if let Some((topic, kind, encoding)) = channels.get(&header.channel_id) {
                            heard.push(topic, *kind, *encoding, &data);
                        }
                    }
                    _ => {}
                }
            }
        }
    }
    heard.log(file, motions, names)
}
