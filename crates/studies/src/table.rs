//! The table of a study: a row for each case, in their order.

use columnar::{Column, Values, WholeTable};

use crate::parameter::Value;
use crate::study::{OWN_COLUMNS, Row, Study};

/// The table of some cases of a study.
///
/// Columns are `case`, the parameters, the outputs, `success`, `message`, `steps`, `seed` and `hash`.
/// A parameter that is a number in every case has a column of numbers, else one of texts.
pub(crate) fn table(study: &Study, rows: &[&Row]) -> WholeTable {
    let [case, success, message, steps, seed, hash] = OWN_COLUMNS;
    let mut columns = Vec::new();
    let mut push = |name: &str, values| {
        columns.push(Column {
            name: name.to_owned(),
            values,
        });
    };
    let number = |row: &&Row| i64::try_from(row.case).unwrap_or(i64::MAX);
    push(case, Values::Long(rows.iter().map(number).collect()));
    for (place, parameter) in study.parameters().iter().enumerate() {
        push(&parameter.name, parameter_values(study, place, rows));
    }
    for (place, (name, _)) in study.outputs().enumerate() {
        let values = rows
            .iter()
            .map(|row| row.outputs.get(place).copied().flatten());
        push(name, Values::Optional(values.collect()));
    }
    push(
        success,
        Values::Boolean(rows.iter().map(|row| row.success).collect()),
    );
    let messages = rows.iter().map(|row| row.message.as_str().into());
    push(message, Values::Text(messages.collect()));
    push(
        steps,
        Values::Long(rows.iter().map(|row| row.steps).collect()),
    );
    push(
        seed,
        Values::Long(rows.iter().map(|row| study.seed(row.case)).collect()),
    );
    let hashes = rows.iter().map(|row| study.hash(row.case).as_str().into());
    push(hash, Values::Text(hashes.collect()));
    let manifest = study.manifest();
    let said = |name: &str| manifest[name].as_str().unwrap_or_default().to_owned();
    let units = serde_json::Value::Object(study.units());
    let facts = vec![
        ("title".to_owned(), said("title")),
        ("units".to_owned(), units.to_string()),
        ("model".to_owned(), said("model")),
        ("version".to_owned(), said("version")),
        ("study".to_owned(), manifest.to_string()),
    ];
    WholeTable { columns, facts }
}

fn parameter_values(study: &Study, place: usize, rows: &[&Row]) -> Values {
    let number = |value: &Value| match value {
        Value::Number(number) => Some(*number),
        Value::Text(_) => None,
    };
    // All cases decide on the type, so that parts of the table have the same.
    let numbers = (0..study.cases()).all(|case| number(&study.values(case)[place]).is_some());
    let values = rows.iter().map(|row| &study.values(row.case)[place]);
    if numbers {
        return Values::Double(values.filter_map(number).collect());
    }
    Values::Text(
        values
            .map(|value| value.to_string().as_str().into())
            .collect(),
    )
}

/// The rows of a table that is one of this study; why not, otherwise.
pub(crate) fn rows(study: &Study, table: &WholeTable) -> Result<Vec<Row>, &'static str> {
    const OTHER: &str = "it is no table of this study";
    let column = |name: &str| {
        let found = table.columns.iter().find(|column| column.name == name);
        found.map(|column| &column.values).ok_or(OTHER)
    };
    let [case, success, message, steps, _, hash] = OWN_COLUMNS;
    let found = (
        column(case)?,
        column(success)?,
        column(message)?,
        column(steps)?,
        column(hash)?,
    );
    let (
        Values::Long(cases),
        Values::Boolean(successes),
        Values::Text(messages),
        Values::Long(steps),
        Values::Text(hashes),
    ) = found
    else {
        return Err(OTHER);
    };
    let mut outputs = Vec::new();
    for (name, _) in study.outputs() {
        let Values::Optional(values) = column(name)? else {
            return Err(OTHER);
        };
        outputs.push(values);
    }
    let mut rows = Vec::new();
    for (place, case) in cases.iter().enumerate() {
        let case = usize::try_from(*case)
            .ok()
            .filter(|case| *case < study.cases());
        let case = case.ok_or(OTHER)?;
        if hashes[place].data() != study.hash(case).as_bytes() {
            return Err(OTHER);
        }
        rows.push(Row {
            case,
            outputs: outputs.iter().map(|values| values[place]).collect(),
            success: successes[place],
            message: String::from_utf8_lossy(messages[place].data()).into_owned(),
            steps: steps[place],
        });
    }
    Ok(rows)
}
