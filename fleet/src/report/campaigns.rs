//! Every campaign of a table, diagnosed.

use arrow::array::{Array, AsArray};
use arrow::compute::cast;
use arrow::datatypes::DataType;
use datafusion::common::{Result, exec_datafusion_err, plan_err};
use datafusion::prelude::SessionContext;

use stiffarm_gap::report::Diagnosis;

/// A campaign of an arm, and what its diagnosis says, or why there is none.
#[derive(Clone, Debug)]
pub struct Campaign {
    /// The arm.
    pub arm: String,
    /// The campaign; an arm's are in the order of their names.
    pub name: String,
    /// The arm's model.
    pub robot: String,
    /// The diagnosis, or the sentence.
    pub found: std::result::Result<Diagnosis, String>,
}

/// Which columns of the table say what; all others are measurements.
#[derive(Clone, Debug)]
pub struct Columns {
    /// The arm.
    pub arm: String,
    /// Its campaign.
    pub campaign: String,
    /// The robot of a row, where `robot` is not given.
    pub robot: String,
    /// The robot of all rows.
    pub one_robot: Option<String>,
    /// Options of the diagnosis.
    pub options: String,
}

/// Diagnoses every campaign of `table`, in the order of arms and campaigns.
///
/// # Errors
/// The table lacks a column, or the engine's.
pub async fn campaigns(
    session: &SessionContext,
    table: &str,
    columns: &Columns,
) -> Result<Vec<Campaign>> {
    let query = session.sql(&query(session, table, columns).await?).await?;
    let mut campaigns = Vec::new();
    for batch in query.collect().await? {
        let text = |k: usize| cast(batch.column(k), &DataType::Utf8);
        let [arm, name, robot, error, json] = [text(0)?, text(1)?, text(2)?, text(3)?, text(4)?];
        let each = [&arm, &name, &robot, &error, &json].map(|column| column.as_string::<i32>());
        for row in 0..batch.num_rows() {
            let [arm, name, robot, error, json] =
                each.map(|column| column.is_valid(row).then(|| column.value(row).to_owned()));
            let found = match (json, error) {
                (Some(json), _) => Ok(serde_json::from_str(&json)
                    .map_err(|error| exec_datafusion_err!("reading a diagnosis again: {error}"))?),
                (None, error) => Err(error.unwrap_or_default()),
            };
            let [arm, name, robot] = [arm, name, robot].map(Option::unwrap_or_default);
            campaigns.push(Campaign { arm, name, robot, found });
        }
    }
    Ok(campaigns)
}

async fn query(session: &SessionContext, table: &str, columns: &Columns) -> Result<String> {
    let quoted = |name: &str| format!("\"{}\"", name.replace('"', "\"\""));
    let text = |text: &str| format!("'{}'", text.replace('\'', "''"));
    let provider = session.table_provider(quoted(table)).await?;
    let schema = provider.schema();
    let names: Vec<&str> = schema.fields().iter().map(|field| field.name().as_str()).collect();
    let mut needed = vec![&columns.arm, &columns.campaign];
    if columns.one_robot.is_none() {
        needed.push(&columns.robot);
    }
    for name in &needed {
        if !names.contains(&name.as_str()) {
            return plan_err!("table {table}: found no column {name} among {}", names.join(", "));
        }
    }
    let measured = names.iter().filter(|name| {
        ![&columns.arm, &columns.campaign, &columns.robot].iter().any(|known| known == *name)
    });
    let measured: Vec<String> = measured.map(|name| quoted(name)).collect();
    if measured.is_empty() {
        return plan_err!(
            "table {table}: found no columns of measurements beside {}",
            names.join(", ")
        );
    }
    let robot = match &columns.one_robot {
        Some(robot) => text(robot),
        None => format!("CAST({} AS VARCHAR)", quoted(&columns.robot)),
    };
    let asked = match columns.options.trim() {
        "" => robot.clone(),
        options => format!("{robot} || ' ' || {}", text(options)),
    };
    let by =
        [&columns.arm, &columns.campaign].map(|name| format!("CAST({} AS VARCHAR)", quoted(name)));
    let [arm, campaign] = by;
    Ok(format!(
        "SELECT arm, campaign, robot, found['error'], found['json'] FROM (SELECT {arm} AS arm, {campaign} AS campaign, \
         min({robot}) AS robot, diagnose({asked}, {}) AS found FROM {} GROUP BY {arm}, {campaign}) \
         ORDER BY arm, campaign",
        measured.join(", "),
        quoted(table)
    ))
}
