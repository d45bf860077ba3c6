//! A scheduler and executors, each a process of its own.

use std::fs;
use std::net::TcpListener;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use stiffarm_fleet::session::Engine;

use crate::campaigns::{Campaign, campaigns, write};
use crate::diagnoses::{answers, query, same, table};
use crate::failures::{fleet, refused};
use crate::grids::{DEFLECTION, numbers};

/// Ends its processes with itself.
struct Cluster {
    port: u16,
    parts: Vec<Child>,
}

fn start(words: &[&str]) -> Child {
    let fleet = env!("CARGO_BIN_EXE_stiffarm-fleet");
    let started =
        Command::new(fleet).args(words).stdin(Stdio::null()).stderr(Stdio::null()).spawn();
    started.unwrap()
}

/// Two ports side by side that nobody has.
fn ports() -> u16 {
    loop {
        let first = TcpListener::bind("127.0.0.1:0").unwrap();
        let port = first.local_addr().unwrap().port();
        if port < u16::MAX && TcpListener::bind(("127.0.0.1", port + 1)).is_ok() {
            return port;
        }
    }
}

impl Cluster {
    /// A scheduler, and an executor that works in each of these folders.
    fn new(work: &[&Path], robots: &[Option<&Path>]) -> Cluster {
        let port = ports();
        let mut cluster = Cluster { port, parts: vec![start_scheduler(port)] };
        for (work, robots) in work.iter().zip(robots) {
            cluster.parts.push(start_executor(port, work, *robots));
        }
        cluster
    }

    fn engine(&self) -> Engine {
        let cluster = Some(format!("df://127.0.0.1:{}", self.port));
        Engine { cluster, partitions: Some(4) }
    }

    fn end(&mut self, part: usize) {
        self.parts[part].kill().unwrap();
        self.parts[part].wait().unwrap();
    }
}

fn start_executor(scheduler: u16, work: &Path, robots: Option<&Path>) -> Child {
    fs::create_dir_all(work).unwrap();
    let (scheduler, own) = (format!("127.0.0.1:{scheduler}"), ports().to_string());
    let work = work.to_str().unwrap();
    let mut words = vec!["executor", "--scheduler", &scheduler, "--port", &own, "--cores", "1"];
    words.extend(["--work-dir", work]);
    if let Some(robots) = robots {
        words.extend(["--robots", robots.to_str().unwrap()]);
    }
    start(&words)
}

fn start_scheduler(port: u16) -> Child {
    let scheduler = start(&["scheduler", "--port", &port.to_string()]);
    let began = Instant::now();
    while std::net::TcpStream::connect(("127.0.0.1", port)).is_err() {
        assert!(began.elapsed() < Duration::from_secs(60), "the scheduler does not answer");
        thread::sleep(Duration::from_millis(50));
    }
    scheduler
}

impl Drop for Cluster {
    fn drop(&mut self) {
        for part in &mut self.parts {
            // One that has ended already is as it should be.
            let _ = part.kill();
            let _ = part.wait();
        }
    }
}

fn data(folder: &Path) -> Vec<Campaign> {
    let all = campaigns(&["kuka_kr240", "ur10"], 3, 12);
    write(&folder.join("runs"), &all);
    all
}

/// Two executors: the bytes of the command; and again after one was ended once it had parts of so many stages of the job.
async fn answers_whatever_ends(parts: usize) {
    let folder = tempfile::tempdir().unwrap();
    let all = data(folder.path());
    let (first, second) = (folder.path().join("first"), folder.path().join("second"));
    let mut cluster = Cluster::new(&[&first, &second], &[None, None]);
    let tables = [table(&folder.path().join("runs"))];
    let sql = query(&all[0].columns());
    same(&all, &answers(&cluster.engine(), &tables, &sql).await);
    let known = stages(&second);
    let engine = cluster.engine();
    let asked = tokio::spawn({
        let (tables, sql) = (tables.clone(), sql.clone());
        async move { answers(&engine, &tables, &sql).await }
    });
    let began = Instant::now();
    while stages(&second) < known + parts {
        assert!(began.elapsed() < Duration::from_secs(120), "the second executor has no work");
        tokio::time::sleep(Duration::from_millis(5)).await;
    }
    assert!(!asked.is_finished());
    cluster.end(2);
    let answered = tokio::time::timeout(Duration::from_secs(300), asked).await;
    same(&all, &answered.expect("an answer without the second executor").unwrap());
}

/// As it reads the tables.
#[tokio::test(flavor = "multi_thread")]
async fn an_executor_may_end_as_it_reads() {
    answers_whatever_ends(1).await;
}

/// When rows that the groups of others need, and groups that are done, are with it alone.
#[tokio::test(flavor = "multi_thread")]
async fn an_executor_may_end_with_what_others_need() {
    answers_whatever_ends(2).await;
}

/// The stages of its jobs that an executor has parts of.
fn stages(work: &Path) -> usize {
    let job = |job: std::io::Result<fs::DirEntry>| fs::read_dir(job.unwrap().path());
    fs::read_dir(work).unwrap().flat_map(job).flatten().count()
}

/// The jobs that an executor has parts of.
fn jobs(work: &Path) -> usize {
    fs::read_dir(work).unwrap().count()
}

/// The robot's file is in the folder of one executor alone: the groups of the other have rows that say so, and no
/// group is lost or answered twice. With the file there are answers, without a start of anything anew.
#[tokio::test(flavor = "multi_thread")]
async fn a_file_that_an_executor_lacks_is_said_in_its_rows() {
    let folder = tempfile::tempdir().unwrap();
    let mut all = data(folder.path());
    let [has, lacks] = ["has", "lacks"].map(|name| folder.path().join(name));
    [&has, &lacks].iter().for_each(|robots| fs::create_dir(robots).unwrap());
    let text = stiffarm_robots::toml("kuka_kr240").unwrap();
    fs::write(has.join("welder.toml"), text).unwrap();
    all.iter_mut().for_each(|campaign| campaign.robot = "welder");
    write(&folder.path().join("runs"), &all);
    let [first, second] = ["first", "second"].map(|name| folder.path().join(name));
    let cluster = Cluster::new(&[&first, &second], &[Some(&has), Some(&lacks)]);
    let tables = [table(&folder.path().join("runs"))];
    let sql = query(&all[0].columns());
    let (began, mut seen) = (Instant::now(), [false; 2]);
    // Which executor takes which group is the scheduler's choice.
    while seen != [true; 2] {
        assert!(began.elapsed() < Duration::from_secs(120), "one executor answers all: {seen:?}");
        let got = answers(&cluster.engine(), &tables, &sql).await;
        assert_eq!(got.len(), all.len());
        for [json, said] in got.values() {
            seen[usize::from(said.is_some())] = true;
            match said {
                None => assert!(json.as_ref().unwrap().contains("from welder.toml")),
                Some(said) => {
                    assert!(json.is_none() && said.contains("welder.toml: No such file"), "{said}");
                    assert!(said.contains("every executor needs the file"), "{said}");
                }
            }
        }
    }
    fs::write(lacks.join("welder.toml"), text).unwrap();
    let got = answers(&cluster.engine(), &tables, &sql).await;
    assert!(got.values().all(|[_, said]| said.is_none()), "{got:?}");
}

/// A grid goes to a cluster as what makes it, and has the numbers that it has here.
#[tokio::test(flavor = "multi_thread")]
async fn a_grid_is_made_where_it_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let cluster = Cluster::new(&[&folder.path().join("work")], &[None]);
    let sql = format!("SELECT count(*), max(mm), min(mm), sum(q2) FROM ({DEFLECTION})");
    let want = numbers(&Engine { cluster: None, partitions: Some(1) }, &sql).await.unwrap();
    assert_eq!(want[0][0], Some(81.0));
    let got = numbers(&cluster.engine(), &sql).await.unwrap();
    assert_eq!(got[0][..3], want[0][..3]);
    // The same terms, in another order; the joint goes up to 146°, 2.55 rad.
    assert!((got[0][3].unwrap() - want[0][3].unwrap()).abs() < 81.0 * 81.0 * 2.55 * f64::EPSILON);
}

/// An executor whose disk is full says so, in one sentence; nothing is written. With room there is an answer.
#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs unshare: a disk of 64 KiB is mounted for the executor alone"]
async fn needs_unshare_a_full_disk_ends_the_query() {
    let folder = tempfile::tempdir().unwrap();
    let all = data(folder.path());
    let work = folder.path().join("work");
    let mut cluster = Cluster::new(&[], &[]);
    fs::create_dir(&work).unwrap();
    let (own, scheduler) = (ports().to_string(), format!("127.0.0.1:{}", cluster.port));
    let mount = "mount -t tmpfs -o size=64k tmpfs \"$0\" && exec \"$@\"";
    let small = Command::new("unshare")
        .args([
            "-Urm",
            "sh",
            "-c",
            mount,
            work.to_str().unwrap(),
            env!("CARGO_BIN_EXE_stiffarm-fleet"),
        ])
        .args(["executor", "--scheduler", &scheduler, "--port", &own, "--cores", "1", "--work-dir"])
        .arg(&work)
        .stdin(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
    cluster.parts.push(small.unwrap());
    let runs = format!("runs={}", folder.path().join("runs").display());
    let url = format!("df://127.0.0.1:{}", cluster.port);
    let sql = query(&all[0].columns());
    let out = folder.path().join("out.json");
    let words = ["sql", &sql, "--table", &runs, "--cluster", &url, "--format", "json", "--out"];
    let said = refused(&fleet(&[&words[..], &[out.to_str().unwrap()]].concat()));
    assert!(said.contains("No space left on device"), "{said}");
    assert!(!out.exists());
    cluster.end(1);
    cluster.parts[1] = start_executor(cluster.port, &folder.path().join("more"), None);
    same(&all, &answers(&cluster.engine(), &[table(&folder.path().join("runs"))], &sql).await);
}

/// A scheduler that ends takes its jobs with it, and says so; one at its place finds the executors again.
#[tokio::test(flavor = "multi_thread")]
async fn a_scheduler_may_be_started_again() {
    let folder = tempfile::tempdir().unwrap();
    let all = data(folder.path());
    let work = folder.path().join("work");
    let mut cluster = Cluster::new(&[&work], &[None]);
    let runs = format!("runs={}", folder.path().join("runs").display());
    let url = format!("df://127.0.0.1:{}", cluster.port);
    let sql = query(&all[0].columns());
    let out = folder.path().join("out.json");
    let words = ["sql", &sql, "--table", &runs, "--cluster", &url, "--format", "json", "--out"];
    let words = [&words[..], &[out.to_str().unwrap()]].concat();
    let (known, words): (_, Vec<String>) =
        (jobs(&work), words.into_iter().map(str::to_owned).collect());
    let asked = thread::spawn(move || {
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        fleet(&words)
    });
    let began = Instant::now();
    while jobs(&work) == known {
        assert!(began.elapsed() < Duration::from_secs(120), "the executor has no work");
        thread::sleep(Duration::from_millis(5));
    }
    cluster.end(0);
    let said = refused(&asked.join().unwrap());
    assert!(said.contains("scheduler"), "{said}");
    assert!(!out.exists());
    cluster.parts[0] = start_scheduler(cluster.port);
    same(&all, &answers(&cluster.engine(), &[table(&folder.path().join("runs"))], &sql).await);
}
