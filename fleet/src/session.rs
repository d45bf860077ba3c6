//! A session of the engine that knows the functions: in this process, or on a cluster.

use std::path::Path;
use std::sync::Arc;

use ballista::prelude::SessionContextExt;
use ballista_core::extension::SessionConfigExt;
use datafusion::common::{Result, exec_datafusion_err, plan_datafusion_err, plan_err};
use datafusion::execution::SessionStateBuilder;
use datafusion::prelude::{SessionConfig, SessionContext};

use crate::aggregates::aggregates;
use crate::arms::Arms;
use crate::csv;
use crate::functions::functions;

/// A table by its name and the folder or address in which its files are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// As queries call it.
    pub name: String,
    /// A folder, a file, or an address of an object store.
    pub location: String,
}

/// Where queries run.
#[derive(Clone, Debug, Default)]
pub struct Engine {
    /// `df://host:port` of a scheduler; else this process.
    pub cluster: Option<String>,
    /// Into how many parts a query is split; the engine's choice if `None`.
    pub partitions: Option<usize>,
}

impl Engine {
    /// What went wrong: where the way to the cluster broke, that it did.
    pub fn told(&self, said: String) -> String {
        let broken = ["transport error", "h2 protocol error", "tcp connect error", "broken pipe"];
        match &self.cluster {
            Some(address) if broken.iter().any(|sign| said.contains(sign)) => format!(
                "the scheduler at {address} does not answer, and what it was asked is lost: ask again once it is there; \
                 {said}"
            ),
            _ => said,
        }
    }
}

/// The functions, in any session of the engine.
pub fn register(session: &SessionContext, arms: &Arc<Arms>) {
    functions(arms).into_iter().for_each(|function| session.register_udf(function));
    aggregates(arms).into_iter().for_each(|aggregate| session.register_udaf(aggregate));
}

impl Engine {
    /// A session with the functions and these tables.
    ///
    /// # Errors
    /// The cluster is not there, or a table cannot be read.
    pub async fn session(&self, arms: &Arc<Arms>, tables: &[Table]) -> Result<SessionContext> {
        let mut config = match &self.cluster {
            Some(_) => SessionConfig::new_with_ballista(),
            None => SessionConfig::new(),
        };
        if let Some(partitions) = self.partitions {
            config = config.with_target_partitions(partitions);
        }
        let session = match &self.cluster {
            None => SessionContext::new_with_config(config),
            Some(address) => {
                let state = SessionStateBuilder::new().with_default_features();
                let state = state.with_config(config).build();
                SessionContext::remote_with_state(address, state).await?
            }
        };
        register(&session, arms);
        for table in tables {
            table.register(&session).await?;
        }
        Ok(session)
    }
}

impl Table {
    /// Of `name=location`.
    ///
    /// # Errors
    /// What it is not.
    pub fn parse(text: &str) -> core::result::Result<Table, String> {
        match text.split_once('=') {
            Some((name, location)) if !name.trim().is_empty() && !location.trim().is_empty() => {
                Ok(Table { name: name.trim().to_owned(), location: location.trim().to_owned() })
            }
            _ => Err("expected name=DIR".to_owned()),
        }
    }

    async fn register(&self, session: &SessionContext) -> Result<()> {
        let format = self.format()?;
        let name = self.name.replace('"', "\"\"");
        let location = self.location.replace('\'', "''");
        let (kind, columns, by, options) = match format {
            Format::Parquet => ("PARQUET", String::new(), String::new(), ""),
            Format::Csv => {
                let options = " OPTIONS ('format.has_header' 'true', 'format.comment' '#')";
                let [columns, by] = match self.location.contains("://") {
                    true => Default::default(),
                    false => csv::columns(Path::new(&self.location))
                        .map_err(|said| plan_datafusion_err!("table {}: {said}", self.name))?,
                };
                ("CSV", columns, by, options)
            }
        };
        let sql = format!(
            "CREATE EXTERNAL TABLE \"{name}\" {columns} STORED AS {kind} {by} LOCATION '{location}'{options}"
        );
        let made = session.sql(&sql).await;
        made.map(|_| ()).map_err(|error| {
            let said = crate::sentence::of_engine(&error);
            exec_datafusion_err!("table {}, {}: {said}", self.name, self.location)
        })
    }

    /// What its files are: by the ending of an address, else of the first file in the folder.
    fn format(&self) -> Result<Format> {
        if let Some(format) = Format::of(Path::new(&self.location)) {
            return Ok(format);
        }
        let wanted = "expected .parquet or .csv";
        if self.location.contains("://") {
            return plan_err!("table {}: found {}, {wanted} at its end", self.name, self.location);
        }
        let all = csv::files(Path::new(&self.location)).map_err(|error| {
            plan_datafusion_err!("table {}: cannot read {}: {error}", self.name, self.location)
        })?;
        let found = all.first().ok_or_else(|| {
            plan_datafusion_err!(
                "table {}: found no file in {}, {wanted}",
                self.name,
                self.location
            )
        })?;
        Format::of(found).ok_or_else(|| {
            plan_datafusion_err!("table {}: found {}, {wanted}", self.name, found.display())
        })
    }
}

#[derive(Clone, Copy)]
enum Format {
    Parquet,
    Csv,
}

impl Format {
    fn of(path: &Path) -> Option<Format> {
        match path.extension()?.to_str()? {
            "parquet" => Some(Format::Parquet),
            "csv" => Some(Format::Csv),
            _ => None,
        }
    }
}
