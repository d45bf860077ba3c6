//! Where files are: folders of the machine and, with the feature `s3`, the buckets of a store that speaks S3.
//!
//! Who may read a bucket, and at which address its store is, each process has of its own environment
//! (`AWS_ACCESS_KEY_ID`, `AWS_SECRET_ACCESS_KEY`, `AWS_REGION`, `AWS_ENDPOINT`, …): nothing of it is part of a query.

use std::path::Path;
use std::sync::Arc;

#[cfg(feature = "s3")]
use datafusion::common::plan_datafusion_err;
use datafusion::common::{Result, plan_err};
use datafusion::execution::object_store::{DefaultObjectStoreRegistry, ObjectStoreRegistry};
use datafusion::execution::runtime_env::{RuntimeEnv, RuntimeEnvBuilder};
use object_store::ObjectStore;
use url::Url;

/// The stores that a process has been asked for.
#[derive(Debug, Default)]
struct Stores(DefaultObjectStoreRegistry);

impl ObjectStoreRegistry for Stores {
    fn register_store(
        &self,
        url: &Url,
        store: Arc<dyn ObjectStore>,
    ) -> Option<Arc<dyn ObjectStore>> {
        self.0.register_store(url, store)
    }

    fn get_store(&self, url: &Url) -> Result<Arc<dyn ObjectStore>> {
        if let Ok(store) = self.0.get_store(url) {
            return Ok(store);
        }
        let store = bucket(url)?;
        self.register_store(url, Arc::clone(&store));
        Ok(store)
    }
}

#[cfg(feature = "s3")]
fn bucket(url: &Url) -> Result<Arc<dyn ObjectStore>> {
    if url.scheme() != "s3" {
        return plan_err!("found {url}, expected a folder or s3://bucket/folder");
    }
    let store = object_store::aws::AmazonS3Builder::from_env().with_url(url.as_str()).build();
    Ok(Arc::new(store.map_err(|error| plan_datafusion_err!("{url}: {error}"))?))
}

#[cfg(not(feature = "s3"))]
fn bucket(url: &Url) -> Result<Arc<dyn ObjectStore>> {
    plan_err!(
        "found {url}, expected a folder; s3://bucket/folder is read by a program that is built with --features s3"
    )
}

/// What a session of the engine runs in; parts that memory does not hold are in `parts`, or where the system has such.
///
/// # Errors
/// The engine's: `parts` cannot be used.
pub fn environment(parts: Option<&Path>) -> Result<Arc<RuntimeEnv>> {
    let builder = RuntimeEnvBuilder::new().with_object_store_registry(Arc::new(Stores::default()));
    let builder = match parts {
        Some(parts) => builder.with_temp_file_path(parts),
        None => builder,
    };
    builder.build_arc()
}
