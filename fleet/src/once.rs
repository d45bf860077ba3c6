//! What a job's stages made, once each.
//!
//! When an executor is lost, Ballista 55 does a stage again that had its input from there, and keeps what the tasks of
//! the first attempt had made beside what those of the second make: rows would be answered twice.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use async_trait::async_trait;
use ballista_core::error::Result;
use ballista_core::serde::protobuf::job_status::Status;
use ballista_core::serde::protobuf::{JobStatus, PartitionLocation};
use ballista_core::{JobId, JobStatusSubscriber};
use ballista_scheduler::cluster::{JobState, JobStateEventStream};
use ballista_scheduler::state::execution_graph::ExecutionGraphBox;
use ballista_scheduler::state::execution_stage::ExecutionStage;
use datafusion::prelude::{SessionConfig, SessionContext};
use tokio::sync::mpsc;

/// A job's status on its way to who asked: at most as many wait as the scheduler itself would keep.
const WAITING: usize = 16;

/// The jobs of a scheduler, of which every answer has each part of the last stage once: as the last attempt made it. One
/// whose stages before the last were repeated fails.
pub struct Once(pub Arc<dyn JobState>);

#[async_trait]
impl JobState for Once {
    async fn submit_job(
        &self,
        job: JobId,
        graph: &ExecutionGraphBox,
        subscriber: Option<JobStatusSubscriber>,
    ) -> Result<()> {
        self.0.submit_job(job, graph, subscriber.map(told_once)).await
    }

    async fn get_job_status(&self, job: &JobId) -> Result<Option<JobStatus>> {
        Ok(self.0.get_job_status(job).await?.map(once))
    }

    async fn save_job(&self, job: &JobId, graph: &ExecutionGraphBox) -> Result<()> {
        if !(graph.is_successful() && graph.stages().values().any(repeated)) {
            return self.0.save_job(job, graph).await;
        }
        let mut failed = graph.cloned();
        failed.fail_job(
            "an executor was lost, and what others had made of its part would be counted twice: ask again".to_owned(),
        );
        self.0.save_job(job, &failed).await
    }

    fn accept_job(&self, job: &JobId, name: &str, queued_at: u64) -> Result<()> {
        self.0.accept_job(job, name, queued_at)
    }

    fn pending_job_number(&self) -> usize {
        self.0.pending_job_number()
    }

    async fn get_jobs(&self) -> Result<HashSet<JobId>> {
        self.0.get_jobs().await
    }

    async fn get_all_jobs(&self) -> Result<HashSet<JobId>> {
        self.0.get_all_jobs().await
    }

    async fn get_execution_graph(&self, job: &JobId) -> Result<Option<ExecutionGraphBox>> {
        self.0.get_execution_graph(job).await
    }

    async fn fail_unscheduled_job(&self, job: &JobId, reason: String) -> Result<()> {
        self.0.fail_unscheduled_job(job, reason).await
    }

    async fn remove_job(&self, job: &JobId) -> Result<()> {
        self.0.remove_job(job).await
    }

    async fn try_acquire_job(&self, job: &JobId) -> Result<Option<ExecutionGraphBox>> {
        self.0.try_acquire_job(job).await
    }

    async fn job_state_events(&self) -> Result<JobStateEventStream> {
        self.0.job_state_events().await
    }

    async fn create_or_update_session(
        &self,
        session: &str,
        config: &SessionConfig,
    ) -> Result<Arc<SessionContext>> {
        self.0.create_or_update_session(session, config).await
    }

    async fn remove_session(&self, session: &str) -> Result<()> {
        self.0.remove_session(session).await
    }

    fn produce_config(&self) -> SessionConfig {
        self.0.produce_config()
    }
}

/// Whether a stage between others was done again, so that the next has read what both attempts made.
fn repeated(stage: &ExecutionStage) -> bool {
    match stage {
        ExecutionStage::Successful(stage) => {
            stage.stage_attempt_num > 0
                && !stage.inputs.is_empty()
                && !stage.output_links.is_empty()
        }
        _ => false,
    }
}

/// Tells every status as it comes, of a success each part once.
fn told_once(subscriber: JobStatusSubscriber) -> JobStatusSubscriber {
    let (sender, mut statuses) = mpsc::channel(WAITING);
    tokio::spawn(async move {
        while let Some(status) = statuses.recv().await {
            // Who asked may have gone.
            if subscriber.send(once(status)).await.is_err() {
                break;
            }
        }
    });
    sender
}

fn once(mut status: JobStatus) -> JobStatus {
    if let Some(Status::Successful(job)) = &mut status.status {
        job.partition_location = last_of_each(core::mem::take(&mut job.partition_location));
    }
    status
}

/// Of each part the place that was told last, in the order in which parts were told first.
fn last_of_each(places: Vec<PartitionLocation>) -> Vec<PartitionLocation> {
    let mut at = HashMap::new();
    let mut kept: Vec<PartitionLocation> = Vec::with_capacity(places.len());
    for place in places {
        let part = place.partition_id.as_ref().map(|part| (part.stage_id, part.partition_id));
        let index = *at.entry(part).or_insert(kept.len());
        match kept.get_mut(index) {
            Some(earlier) => *earlier = place,
            None => kept.push(place),
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use ballista_core::serde::protobuf::{PartitionId, SuccessfulJob};

    use super::*;

    fn place(partition: u32, file: u64) -> PartitionLocation {
        let part = PartitionId { stage_id: 2, partition_id: partition, ..PartitionId::default() };
        PartitionLocation {
            partition_id: Some(part),
            file_id: Some(file),
            ..PartitionLocation::default()
        }
    }

    #[test]
    fn a_part_that_was_made_again_is_told_once() {
        let places = vec![place(0, 1), place(3, 2), place(0, 3), place(1, 4)];
        let job = SuccessfulJob { partition_location: places, ..SuccessfulJob::default() };
        let status = JobStatus { status: Some(Status::Successful(job)), ..JobStatus::default() };
        let Some(Status::Successful(job)) = once(status).status else { panic!("a success") };
        assert_eq!(job.partition_location, [place(0, 3), place(3, 2), place(1, 4)]);
    }
}
