//! Tables in a store that is no file system.

use std::fs;
use std::sync::Arc;

use object_store::memory::InMemory;
use object_store::path::Path;
use object_store::{ObjectStore, ObjectStoreExt};
use stiffarm_fleet::arms::Arms;
use stiffarm_fleet::session::{Engine, Table};
use url::Url;

use crate::campaigns::{campaigns, write};
use crate::diagnoses::{asked, query, same};

/// CSV files, and the Parquet files that the engine makes of them there: the bytes of the command.
#[tokio::test(flavor = "multi_thread")]
async fn a_bucket_is_a_folder() {
    let folder = tempfile::tempdir().unwrap();
    let all = campaigns(&["kuka_kr240", "ur10"], 1, 12);
    write(folder.path(), &all);
    let store = Arc::new(InMemory::new());
    for campaign in &all {
        let within = format!("arm={}/{}.csv", campaign.arm, campaign.name);
        let text = fs::read(folder.path().join(&within)).unwrap();
        store.put(&Path::from(format!("csv/{within}")), text.into()).await.unwrap();
    }
    let engine = Engine { cluster: None, partitions: Some(2) };
    let session = engine.session(&Arc::new(Arms::default()), &[]).await.unwrap();
    let bucket = Url::parse("s3://plant").unwrap();
    session.register_object_store(&bucket, Arc::clone(&store) as Arc<dyn ObjectStore>);
    let table =
        |name: &str, location: &str| Table { name: name.to_owned(), location: location.to_owned() };
    table("runs", "s3://plant/csv").register(&session).await.unwrap();
    let sql = query(&all[0].columns());
    same(&all, &asked(&session, &sql).await);
    let copy =
        "COPY (SELECT * FROM runs) TO 's3://plant/parquet/' STORED AS PARQUET PARTITIONED BY (arm)";
    session.sql(copy).await.unwrap().collect().await.unwrap();
    session.deregister_table("runs").unwrap();
    table("runs", "s3://plant/parquet/").register(&session).await.unwrap();
    same(&all, &asked(&session, &sql).await);
    let said = table("none", "s3://plant/none").register(&session).await.unwrap_err();
    let said = stiffarm_fleet::sentence::of_engine(&said);
    assert!(said.contains("table none: found no file in s3://plant/none"), "{said}");
    let said = table("far", "gs://plant/runs").register(&session).await.unwrap_err();
    let said = stiffarm_fleet::sentence::of_engine(&said);
    assert!(said.contains("found gs://plant/runs/, expected a folder"), "{said}");
}
