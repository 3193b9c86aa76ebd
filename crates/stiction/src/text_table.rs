//! Tables for people, in one style: columns two blanks apart, no lines, nothing behind the last cell.

use comfy_table::{CellAlignment, Table, presets};

/// A table with a line of heads, unless all are empty; the first `names` columns are aligned left, the numbers after them
/// right.
pub(crate) fn text_table<const N: usize>(
    heads: [&str; N],
    names: usize,
    rows: impl IntoIterator<Item = [String; N]>,
) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING);
    if heads.iter().any(|head| !head.is_empty()) {
        table.set_header(heads);
    }
    for row in rows {
        table.add_row(row);
    }
    for (k, column) in table.column_iter_mut().enumerate() {
        column.set_padding((0, if k + 1 < N { 2 } else { 0 }));
        column.set_cell_alignment(if k < names {
            CellAlignment::Left
        } else {
            CellAlignment::Right
        });
    }
    format!("{}\n", table.trim_fmt())
}

#[cfg(test)]
mod tests {
    use super::text_table;

    #[test]
    fn names_are_left_and_numbers_right() {
        let rows = [["ä", "1.5"], ["long name", "-20"]].map(|row| row.map(str::to_owned));
        let table = text_table(["", "force"], 1, rows);
        assert_eq!(
            table,
            "           force\nä            1.5\nlong name    -20\n"
        );
        let facts = text_table(["", ""], 2, [["a", "b"]].map(|row| row.map(str::to_owned)));
        assert_eq!(facts, "a  b\n");
    }
}
