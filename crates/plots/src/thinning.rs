//! Long series, of which a picture cannot show every output.

/// Places of the values that a curve over time needs so that it looks like all of them in so many columns:
/// first, lowest, highest and last of each column.
///
/// `time` is to rise but for repetitions; of a short series all are needed.
pub(crate) fn needed(time: &[f64], values: &[f64], columns: usize) -> Vec<usize> {
    let count = time.len();
    let width = match (time.first(), time.last()) {
        (Some(first), Some(last)) if count > 4 * columns && last > first => last - first,
        _ => return (0..count).collect(),
    };
    let column = |place: usize| ((time[place] - time[0]) / width * columns as f64) as usize;
    let mut places = Vec::with_capacity(4 * columns + 4);
    let mut start = 0;
    while start < count {
        let own = column(start);
        let length = (start..count).take_while(|place| column(*place) == own);
        let end = start + length.count();
        let by_value = |a: &usize, b: &usize| values[*a].total_cmp(&values[*b]);
        let low = (start..end).min_by(by_value);
        let high = (start..end).max_by(by_value);
        let mut four = [start, low.unwrap_or(start), high.unwrap_or(start), end - 1];
        four.sort_unstable();
        places.extend(four);
        start = end;
    }
    places.dedup();
    places
}

#[cfg(test)]
mod tests {
    use super::needed;

    #[test]
    fn a_spike_between_columns_stays() {
        let time: Vec<f64> = (0..100_000).map(f64::from).collect();
        let mut values = vec![0.0; time.len()];
        values[54_321] = 1.0;
        let places = needed(&time, &values, 100);
        assert!(
            places.len() <= 404 && places.contains(&54_321),
            "{}",
            places.len()
        );
        assert!(places.is_sorted() && places.first() == Some(&0) && places.last() == Some(&99_999));
        assert_eq!(needed(&time[..5], &values[..5], 100), [0, 1, 2, 3, 4]);
        assert!(needed(&[], &[], 100).is_empty());
    }
}
