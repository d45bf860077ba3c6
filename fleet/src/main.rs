//! `stiffarm-fleet`: what it does says `--help`.

use std::io::Write as _;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

use clap::{Parser, Subcommand};
use stiffarm_cli::Whole;
use stiffarm_fleet::arms::Arms;
use stiffarm_fleet::cluster::{self, Executor};
use stiffarm_fleet::output::{self, Format};
use stiffarm_fleet::report::{self, Columns, Fleet};
use stiffarm_fleet::sentence::of_engine;
use stiffarm_fleet::session::{Engine, Table};

const EXAMPLES: &str = "\
Examples:
  stiffarm-fleet sql --table poses=poses.csv \"SELECT pose('ur10', q1, q2, q3, q4, q5, q6) FROM poses\"
  stiffarm-fleet sql --table runs=runs --format json \"SELECT arm, campaign, diagnose(robot, \\\"row\\\",
    q1, q2, q3, q4, q5, q6, fz, x, y, z) AS d FROM runs GROUP BY arm, campaign\"
  stiffarm-fleet report --table runs=runs --options='--noise-position 30um' --out fleet.html
  stiffarm-fleet scheduler & stiffarm-fleet executor & stiffarm-fleet executor --port 50061 &
  stiffarm-fleet sql --cluster df://127.0.0.1:50050 --table runs=/data/runs \"SELECT …\"

Exit status: 0 well; 2 a query, a table or a file could not be used, and nothing was written.";

/// Campaigns of many arms, diagnosed by SQL, in this process or on a cluster
#[derive(Parser)]
#[command(name = "stiffarm-fleet", version, after_help = EXAMPLES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Answer a query
    Sql(Sql),
    /// Diagnose every campaign of a table, and write what the fleet knows as one page
    Report(Report),
    /// Start a cluster's scheduler
    Scheduler(Listen),
    /// Start one of a cluster's executors
    Executor(Work),
}

#[derive(clap::Args)]
struct Sql {
    /// The query; the functions are those of `stiffarm eval` and diagnose, identify, measurements
    query: String,
    #[command(flatten)]
    on: On,
    /// How the result is written
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
    /// Write it to a file
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

#[derive(clap::Args)]
struct Report {
    /// The page
    #[arg(long, value_name = "OUT.html")]
    out: PathBuf,
    #[command(flatten)]
    on: On,
    /// The column that names the arm
    #[arg(long, default_value = "arm", value_name = "COLUMN")]
    arm: String,
    /// The column that names its campaign; an arm's campaigns are in the order of their names
    #[arg(long, default_value = "campaign", value_name = "COLUMN")]
    campaign: String,
    /// The column that names the robot
    #[arg(long, default_value = "robot", value_name = "COLUMN")]
    robot_column: String,
    /// The robot of all rows, in place of a column
    #[arg(long, value_name = "ROBOT")]
    robot: Option<String>,
    /// Options of `stiffarm diagnose`: --options='--noise-position 30um'
    #[arg(long, default_value = "", hide_default_value = true, allow_hyphen_values = true)]
    options: String,
}

/// Tables, robots, and where queries run.
#[derive(clap::Args)]
struct On {
    /// A table: a folder of Parquet or CSV files, or one file; folders named column=value are columns
    #[arg(long = "table", value_name = "NAME=DIR", value_parser = Table::parse)]
    tables: Vec<Table>,
    /// A folder of robot files, which a query calls by their names
    #[arg(long, value_name = "DIR")]
    robots: Option<PathBuf>,
    /// Run on the cluster of this scheduler: df://host:port
    #[arg(long, value_name = "URL")]
    cluster: Option<String>,
    /// Into how many parts a query is split
    #[arg(long, value_name = "N")]
    partitions: Option<usize>,
}

#[derive(clap::Args)]
struct Listen {
    /// The address to listen on; nothing asks who calls
    #[arg(long, default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    bind: IpAddr,
    /// The port
    #[arg(long, default_value_t = 50050)]
    port: u16,
    /// A folder of robot files
    #[arg(long, value_name = "DIR")]
    robots: Option<PathBuf>,
}

#[derive(clap::Args)]
struct Work {
    /// The scheduler
    #[arg(long, default_value = "127.0.0.1:50050", value_name = "HOST:PORT")]
    scheduler: String,
    /// The address to listen on; nothing asks who calls
    #[arg(long, default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    bind: IpAddr,
    /// The name by which the others reach it [default: the address]
    #[arg(long)]
    host: Option<String>,
    /// The port; the one after it is used too
    #[arg(long, default_value_t = 50051)]
    port: u16,
    /// How many tasks it takes at once [default: one per core]
    #[arg(long)]
    cores: Option<usize>,
    /// Where parts of results are kept until they are fetched
    #[arg(long, value_name = "DIR")]
    work_dir: Option<PathBuf>,
    /// A folder of robot files
    #[arg(long, value_name = "DIR")]
    robots: Option<PathBuf>,
}

fn main() -> ExitCode {
    let command = Cli::parse().command;
    // Plans are walked by recursion.
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .enable_all()
        .thread_stack_size(16 << 20)
        .build();
    let ended = match runtime {
        Err(error) => Err(format!("cannot start: {error}")),
        Ok(runtime) => runtime.block_on(async {
            let run = tokio::spawn(run(command));
            run.await.unwrap_or_else(|error| Err(error.to_string()))
        }),
    };
    match ended {
        Ok(()) => ExitCode::SUCCESS,
        Err(said) => {
            eprintln!("error: {said}");
            ExitCode::from(2)
        }
    }
}

async fn run(command: Command) -> Result<(), String> {
    match command {
        Command::Sql(args) => args.run().await,
        Command::Report(args) => args.run().await,
        Command::Scheduler(args) => args.run().await,
        Command::Executor(args) => args.run().await,
    }
}

impl On {
    fn parts(&self) -> (Engine, Arc<Arms>) {
        let engine = Engine { cluster: self.cluster.clone(), partitions: self.partitions };
        (engine, Arc::new(Arms::new(self.robots.clone())))
    }
}

impl Sql {
    async fn run(self) -> Result<(), String> {
        let (engine, arms) = self.on.parts();
        let wrong = |error| engine.told(of_engine(&error));
        let session = engine.session(&arms, &self.on.tables).await.map_err(wrong)?;
        let query = session.sql(&self.query).await.map_err(wrong)?;
        let result = query.execute_stream().await.map_err(wrong)?;
        let written = output::write(result, self.format, self.out.as_deref()).await;
        written.map_err(|said| engine.told(said))
    }
}

impl Report {
    async fn run(self) -> Result<(), String> {
        let [table] = &self.on.tables[..] else {
            let found = self.on.tables.len();
            return Err(format!(
                "--table: found {found} tables, expected the one of the campaigns"
            ));
        };
        let columns = Columns {
            arm: self.arm,
            campaign: self.campaign,
            robot: self.robot_column,
            one_robot: self.robot,
            options: self.options,
        };
        // Before the work: where nothing can be written, none is to be done.
        let unwritten = |error| output::wrong(&self.out, &error);
        let mut whole = Whole::new(&self.out).map_err(unwritten)?;
        let (engine, arms) = self.on.parts();
        let wrong = |error| engine.told(of_engine(&error));
        let session = engine.session(&arms, &self.on.tables).await.map_err(wrong)?;
        let campaigns = report::campaigns(&session, &table.name, &columns).await.map_err(wrong)?;
        let page = report::html(&table.name, &Fleet::of(&campaigns));
        let page = page.map_err(|error| format!("cannot make the page: {error}"))?;
        whole.write_all(page.as_bytes()).and_then(|()| whole.finish()).map_err(unwritten)
    }
}

impl Listen {
    async fn run(self) -> Result<(), String> {
        let address = SocketAddr::new(self.bind, self.port);
        listening("scheduler", address);
        let arms = Arc::new(Arms::new(self.robots));
        let ended = cluster::scheduler(address, arms).await;
        ended.map_err(|error| format!("scheduler on {address}: {error}"))
    }
}

impl Work {
    async fn run(self) -> Result<(), String> {
        let scheduler = self.scheduler.rsplit_once(':');
        let scheduler =
            scheduler.and_then(|(host, port)| Some((host.to_owned(), port.parse().ok()?)));
        let scheduler = scheduler.ok_or_else(|| {
            format!("--scheduler: found `{}`, expected host:port", self.scheduler)
        })?;
        if self.bind.is_unspecified() && self.host.is_none() {
            return Err(format!(
                "--bind {}: found no --host, expected the name by which the others reach this executor",
                self.bind
            ));
        }
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let address = SocketAddr::new(self.bind, self.port);
        listening("executor", address);
        let executor = Executor {
            address,
            host: self.host,
            scheduler,
            work: self.work_dir,
            cores: self.cores.unwrap_or(cores),
        };
        let ended = executor.run(Arc::new(Arms::new(self.robots))).await;
        ended.map_err(|error| format!("executor on {address}: {error}"))
    }
}

/// What a part of a cluster tells as it runs: warnings, or what `RUST_LOG` asks for.
fn listening(what: &str, address: SocketAddr) {
    env_logger::Builder::from_env(env_logger::Env::default().default_filter_or("warn")).init();
    eprintln!("{what} on {address}");
    if let Some(warning) = cluster::warning(address.ip()) {
        eprintln!("warning: {warning}");
    }
}
