//! Columns of results and references by name.

use std::collections::HashMap;

use results::ResFile;

/// Named columns over rows in time.
pub(crate) struct Table {
    columns: HashMap<String, usize>,
    /// Time of each row.
    pub(crate) times: Vec<f64>,
    /// The rows.
    pub(crate) rows: Vec<Vec<f64>>,
}

impl Table {
    /// A comma-separated table; lines that start with `#` are comments, then comes the header.
    pub(crate) fn from_csv(text: &str) -> Self {
        let mut lines = text.lines().filter(|line| !line.starts_with('#'));
        let header = lines.next().expect("a table has a header");
        let columns = header.split(',').map(str::trim).map(str::to_owned);
        let rows: Vec<Vec<f64>> = lines
            .map(|line| {
                line.split(',')
                    .map(|cell| cell.trim().parse().unwrap())
                    .collect()
            })
            .collect();
        let columns: HashMap<String, usize> =
            columns.enumerate().map(|(k, name)| (name, k)).collect();
        let time = ["time", "t_s", "t", "Time"]
            .into_iter()
            .find_map(|name| columns.get(name));
        let times = time.map_or(Vec::new(), |&time| {
            rows.iter().map(|row| row[time]).collect()
        });
        Self {
            columns,
            times,
            rows,
        }
    }

    /// Steps of the dynamic blocks of a result file; columns are `Kind/id.COMPONENT`, as
    /// `Part/2.X` or `Friction/1.TX`.
    pub(crate) fn from_results(file: &ResFile) -> Self {
        let mut columns = HashMap::new();
        for (place, entity) in file.entities.iter().enumerate() {
            for (k, component) in entity.components.iter().enumerate() {
                if let Some(id) = entity.object_id {
                    let name = format!("{}/{id}.{}", entity.kind, component.name);
                    columns.insert(name, file.column_of(place, k));
                }
            }
        }
        let (mut times, mut rows) = (Vec::new(), Vec::new());
        for block in file
            .data
            .iter()
            .filter(|block| block.name.starts_with("dynamic"))
        {
            times.extend_from_slice(&block.times);
            rows.extend((0..block.times.len()).map(|step| block.row(step).to_vec()));
        }
        Self {
            columns,
            times,
            rows,
        }
    }

    /// Place of a column.
    pub(crate) fn column(&self, name: &str) -> usize {
        *self
            .columns
            .get(name)
            .unwrap_or_else(|| panic!("no column {name}"))
    }

    /// Three columns of a row: `name` with each of the endings.
    pub(crate) fn vector(&self, row: usize, name: &str, endings: [&str; 3]) -> [f64; 3] {
        endings.map(|ending| self.rows[row][self.column(&format!("{name}{ending}"))])
    }
}

/// Length of a vector.
pub(crate) fn norm(a: [f64; 3]) -> f64 {
    a.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Length of a difference.
pub(crate) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    norm([a[0] - b[0], a[1] - b[1], a[2] - b[2]])
}

/// The middle value.
pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
