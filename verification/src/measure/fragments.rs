//! Into how many pieces the occupied cells of a plane grid fall.

/// Number of pieces of the occupied cells, neighbours across a corner being joined.
///
/// `occupied` has one entry per cell, row-major with the last axis contiguous. No cell, no piece.
///
/// ```
/// use verification::measure::fragments::fragments;
/// let corner = [true, false, false, true];
/// assert_eq!(fragments([2, 2], &corner), 1);
/// ```
pub fn fragments([columns, rows]: [usize; 2], occupied: &[bool]) -> usize {
    let mut left = occupied.to_vec();
    let (mut pieces, mut reached) = (0, Vec::new());
    for start in 0..left.len() {
        if !std::mem::take(&mut left[start]) {
            continue;
        }
        pieces += 1;
        reached.push(start);
        while let Some(cell) = reached.pop() {
            let (column, row) = (cell / rows, cell % rows);
            for x in column.saturating_sub(1)..(column + 2).min(columns) {
                for y in row.saturating_sub(1)..(row + 2).min(rows) {
                    let neighbor = x * rows + y;
                    if std::mem::take(&mut left[neighbor]) {
                        reached.push(neighbor);
                    }
                }
            }
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pieces(columns: &str) -> usize {
        let columns: Vec<&str> = columns.split(' ').collect();
        let occupied: Vec<bool> =
            columns.iter().flat_map(|column| column.chars().map(|cell| cell == '#')).collect();
        fragments([columns.len(), columns[0].len()], &occupied)
    }

    #[test]
    fn corners_join_and_gaps_part() {
        assert_eq!(pieces("... ... ..."), 0);
        assert_eq!(pieces("##. ### .##"), 1);
        assert_eq!(pieces("#.. .#. ..#"), 1);
        assert_eq!(pieces("#.# ... #.#"), 4);
        assert_eq!(pieces("##.. ##.. .... ...#"), 2);
        // A ring about a drop.
        assert_eq!(pieces("##### #...# #.#.# #...# #####"), 2);
    }
}
