//! The parts of a cluster: Ballista's scheduler and executor, which know the functions.
//!
//! Neither asks who calls. Both listen on the loopback unless they are told another address.

use std::net::{IpAddr, SocketAddr};
use std::path::PathBuf;
use std::sync::Arc;

use ballista_core::RuntimeProducer;
use ballista_core::config::TaskSchedulingPolicy;
use ballista_core::error::Result;
use ballista_core::registry::BallistaFunctionRegistry;
use ballista_core::utils::{default_config_producer, default_session_builder};
use ballista_executor::executor_process::{ExecutorProcessConfig, start_executor_process};
use ballista_scheduler::cluster::BallistaCluster;
use ballista_scheduler::config::SchedulerConfig;
use ballista_scheduler::scheduler_process::start_server;
use datafusion::execution::SessionStateBuilder;
use datafusion::prelude::{SessionConfig, SessionContext};

use crate::arms::Arms;
use crate::codec::{Logical, Physical};
use crate::once::Once;
use crate::session::register;
use crate::stores::environment;

/// Seconds between looks for executors that are silent, and those of silence after which one counts as dead: a busy one
/// asks for work every five, and on a machine that has no time for it has been seen to stay away for more than eight.
const LOOK: u64 = 2;
const DEAD_AFTER: u64 = 30;

/// Executors ask for work, as many tasks as they have cores free. Were they sent it, the scheduler would count their free
/// cores itself, and lose those of tasks that it takes back when another executor is lost (apache/datafusion-ballista,
/// issue 2418 for tasks of a cancelled job): the survivors would never be sent anything again.
const POLICY: TaskSchedulingPolicy = TaskSchedulingPolicy::PullStaged;

/// What has to be known of an address that others reach.
pub fn warning(bind: IpAddr) -> Option<String> {
    (!bind.is_loopback()).then(|| {
        format!(
            "who reaches {bind} can run queries and read this machine's files: nothing here asks who calls; keep it in \
             a network of its own"
        )
    })
}

/// Runs a scheduler until it is stopped.
///
/// # Errors
/// The port is taken.
pub async fn scheduler(address: SocketAddr, arms: Arc<Arms>) -> Result<()> {
    let config = SchedulerConfig {
        bind_host: address.ip().to_string(),
        external_host: address.ip().to_string(),
        bind_port: address.port(),
        executor_timeout_seconds: DEAD_AFTER,
        expire_dead_executor_interval_seconds: LOOK,
        no_executors_grace_period_seconds: 4 * DEAD_AFTER,
        scheduling_policy: POLICY,
        ..SchedulerConfig::default()
    };
    let config = config.with_override_session_builder(Arc::new(move |config: SessionConfig| {
        let state = SessionStateBuilder::new_from_existing(default_session_builder(config)?);
        let state = state.with_runtime_env(environment(None)?).build();
        let session = SessionContext::new_with_state(state);
        register(&session, &arms);
        Ok(session.state())
    }));
    let config = SchedulerConfig {
        override_logical_codec: Some(Arc::new(Logical::default())),
        override_physical_codec: Some(Arc::new(Physical::default())),
        ..config
    };
    let cluster = BallistaCluster::new_from_config(&config).await?;
    let cluster =
        BallistaCluster::new(cluster.cluster_state(), Arc::new(Once(cluster.job_state())));
    start_server(cluster, address, Arc::new(config)).await
}

/// Where an executor listens and works.
#[derive(Clone, Debug)]
pub struct Executor {
    /// The address; the port after it is its second.
    pub address: SocketAddr,
    /// The name by which others reach it, if it is not the address.
    pub host: Option<String>,
    /// Host and port of its scheduler.
    pub scheduler: (String, u16),
    /// Where parts of results are kept until they are fetched; a folder of the system's if `None`.
    pub work: Option<PathBuf>,
    /// How many tasks it takes at once.
    pub cores: usize,
}

impl Executor {
    /// Runs it until it is stopped.
    ///
    /// # Errors
    /// The port is taken, the scheduler is not there within half a minute, or the folder cannot be used.
    pub async fn run(self, arms: Arc<Arms>) -> Result<()> {
        let session =
            SessionContext::new_with_state(default_session_builder(default_config_producer())?);
        register(&session, &arms);
        let functions = BallistaFunctionRegistry::from(&session.state());
        let parts = self.work.clone();
        let runtime: RuntimeProducer = Arc::new(move |_| environment(parts.as_deref()));
        let (scheduler_host, scheduler_port) = self.scheduler;
        let bind_host = self.address.ip().to_string();
        let config = ExecutorProcessConfig {
            external_host: Some(self.host.unwrap_or_else(|| bind_host.clone())),
            bind_host,
            port: self.address.port(),
            grpc_port: self.address.port() + 1,
            scheduler_host,
            scheduler_port,
            scheduler_connect_timeout_seconds: 30,
            vcores: self.cores,
            work_dir: self.work.map(|work| work.display().to_string()),
            task_scheduling_policy: POLICY,
            override_function_registry: Some(Arc::new(functions)),
            override_runtime_producer: Some(runtime),
            override_logical_codec: Some(Arc::new(Logical::default())),
            override_physical_codec: Some(Arc::new(Physical::default())),
            ..ExecutorProcessConfig::default()
        };
        start_executor_process(Arc::new(config)).await
    }
}
