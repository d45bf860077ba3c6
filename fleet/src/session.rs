//! A session of the engine that knows the functions: in this process, or on a cluster.

use std::sync::Arc;

use ballista::prelude::SessionContextExt;
use ballista_core::config::BALLISTA_ADAPTIVE_PLANNER_ENABLED;
use ballista_core::extension::SessionConfigExt;
use datafusion::common::{Result, exec_datafusion_err, plan_datafusion_err};
use datafusion::execution::SessionStateBuilder;
use datafusion::prelude::{SessionConfig, SessionContext};

use crate::aggregates::aggregates;
use crate::arms::Arms;
use crate::codec::Logical;
use crate::csv;
use crate::files::{Files, Format};
use crate::functions::functions;
use crate::grid::GridFunction;
use crate::sentence::of_engine;
use crate::stores::environment;

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
    session.register_udtf("grid", Arc::new(GridFunction { arms: Arc::clone(arms) }));
}

impl Engine {
    /// A session with the functions and these tables.
    ///
    /// # Errors
    /// The cluster is not there, or a table cannot be read.
    pub async fn session(&self, arms: &Arc<Arms>, tables: &[Table]) -> Result<SessionContext> {
        let mut config = match &self.cluster {
            // A plan that adapts as it goes cannot redo what a lost executor had made (Ballista 55: "Can't find active
            // stage to update stage outputs"): the query would hang.
            Some(_) => SessionConfig::new_with_ballista()
                .with_ballista_logical_extension_codec(Arc::new(Logical::default()))
                .set_bool(BALLISTA_ADAPTIVE_PLANNER_ENABLED, false),
            None => SessionConfig::new(),
        };
        // A table's files are those of all its folders.
        config.options_mut().execution.listing_table_ignore_subdirectory = false;
        if let Some(partitions) = self.partitions {
            config = config.with_target_partitions(partitions);
        }
        let session = match &self.cluster {
            None => SessionContext::new_with_config_rt(config, environment(None)?),
            Some(address) => {
                let state = SessionStateBuilder::new().with_default_features();
                let state = state.with_config(config).with_runtime_env(environment(None)?).build();
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

    /// Makes it known to a session.
    ///
    /// # Errors
    /// A sentence: it cannot be read, or is nothing that can be a table.
    pub async fn register(&self, session: &SessionContext) -> Result<()> {
        let wrong = |said: String| plan_datafusion_err!("table {}: {said}", self.name);
        let files = Files::at(session, &self.location).await;
        let files = files.map_err(|error| wrong(of_engine(&error)))?;
        let (kind, [columns, by], options) = match files.format {
            Format::Parquet => ("PARQUET", Default::default(), ""),
            Format::Csv => {
                let options = " OPTIONS ('format.has_header' 'true', 'format.comment' '#')";
                ("CSV", csv::columns(&files).await.map_err(wrong)?, options)
            }
        };
        let name = self.name.replace('"', "\"\"");
        let location = files.place.as_str().replace('\'', "''");
        let sql = format!(
            "CREATE EXTERNAL TABLE \"{name}\" {columns} STORED AS {kind} {by} LOCATION '{location}'{options}"
        );
        let made = session.sql(&sql).await;
        made.map(|_| ()).map_err(|error| {
            exec_datafusion_err!("table {}, {}: {}", self.name, self.location, of_engine(&error))
        })
    }
}
