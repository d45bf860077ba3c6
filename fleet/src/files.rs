//! The files of a table, wherever they are.

use std::sync::Arc;

use datafusion::common::{Result, plan_datafusion_err, plan_err};
use datafusion::datasource::listing::ListingTableUrl;
use datafusion::prelude::SessionContext;
use futures::TryStreamExt;
use object_store::{ObjectMeta, ObjectStore};

/// What the files of a table are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Apache Parquet.
    Parquet,
    /// Comma-separated values.
    Csv,
}

impl Format {
    fn of(path: &str) -> Option<Format> {
        match path.rsplit_once('.')?.1 {
            "parquet" => Some(Format::Parquet),
            "csv" => Some(Format::Csv),
            _ => None,
        }
    }
}

/// The files of one format at a place, by name.
#[derive(Debug)]
pub struct Files {
    /// Where they are: one file, or all that begins like this.
    pub place: ListingTableUrl,
    /// That it is in.
    pub store: Arc<dyn ObjectStore>,
    /// What all of them are.
    pub format: Format,
    /// Each.
    pub all: Vec<ObjectMeta>,
}

impl Files {
    /// Of a folder or a file, on this machine or in a store.
    ///
    /// # Errors
    /// A sentence: nothing can be read there, or it is nothing that can be a table.
    pub async fn at(session: &SessionContext, location: &str) -> Result<Files> {
        let wanted = "expected .parquet or .csv";
        let cannot =
            |error: &dyn std::fmt::Display| plan_datafusion_err!("cannot read {location}: {error}");
        let far = location.contains("://");
        if !far {
            // The engine takes what is not there as empty.
            std::fs::metadata(location).map_err(|error| cannot(&error))?;
        }
        let is_folder = far && Format::of(location).is_none() && !location.ends_with('/');
        let slash = if is_folder { "/" } else { "" };
        let place = ListingTableUrl::parse(format!("{location}{slash}"))?;
        let store = session.runtime_env().object_store(&place)?;
        let state = session.state();
        let listed = place.list_all_files(&state, store.as_ref(), "").await;
        let listed = listed.map_err(|error| cannot(&crate::sentence::of_engine(&error)))?;
        let mut all: Vec<ObjectMeta> = listed
            .try_collect()
            .await
            .map_err(|error| cannot(&crate::sentence::of_engine(&error)))?;
        // The engine skips what is empty, and takes all else for what the first is.
        all.retain(|file| file.size > 0);
        all.sort_by(|a, b| a.location.cmp(&b.location));
        let Some(first) = all.first() else {
            return plan_err!("found no file in {location}, {wanted}");
        };
        let Some(format) = Format::of(first.location.as_ref()) else {
            return plan_err!("found {}, {wanted}", first.location);
        };
        let is_other = |file: &&ObjectMeta| Format::of(file.location.as_ref()) != Some(format);
        if let Some(other) = all.iter().find(is_other) {
            return plan_err!(
                "found {} beside {}, expected files of one format",
                other.location,
                first.location
            );
        }
        Ok(Files { place, store, format, all })
    }

    /// The names of the folders `name=value` on the way to the last.
    pub fn partitions(&self) -> Vec<String> {
        let way = self.all.last().and_then(|file| self.place.strip_prefix(&file.location));
        let steps = way.into_iter().flatten().filter_map(|step| step.split_once('='));
        steps.map(|(name, _)| name.to_owned()).collect()
    }
}
