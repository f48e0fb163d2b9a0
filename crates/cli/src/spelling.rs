//! Did you mean …? The nearest known word to a misspelt one.

/// The candidate nearest to `word` in edit distance, if it is near enough to be a likely slip.
///
/// ```
/// use billiards_cli::spelling::closest;
/// assert_eq!(closest("velocty", ["position", "velocity"]), Some("velocity"));
/// assert_eq!(closest("zebra", ["position", "velocity"]), None);
/// ```
pub fn closest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let normal = |s: &str| -> Vec<char> {
        s.chars().take(64).map(|c| if c == '_' { '-' } else { c.to_ascii_lowercase() }).collect()
    };
    let word = normal(word);
    candidates
        .into_iter()
        .map(|candidate| (distance(&word, &normal(candidate)), candidate))
        .filter(|(distance, candidate)| *distance <= 1.max(word.len().min(candidate.len()) / 3))
        .filter(|(distance, candidate)| *distance < candidate.len())
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// Number of insertions, deletions, substitutions and swaps of neighbours between two words.
fn distance(a: &[char], b: &[char]) -> usize {
    let mut rows = [vec![0; b.len() + 1], (0..=b.len()).collect::<Vec<_>>(), vec![0; b.len() + 1]];
    for i in 1..=a.len() {
        let [before, last, row] = &mut rows;
        row[0] = i;
        for j in 1..=b.len() {
            let substituted = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            row[j] = substituted.min(last[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(before[j - 2] + 1);
            }
        }
        rows.rotate_left(1);
    }
    rows[1][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_counts_edits() {
        let d = |a: &str, b: &str| distance(&a.chars().collect::<Vec<_>>(), &b.chars().collect::<Vec<_>>());
        assert_eq!([d("", ""), d("", "ab"), d("ab", ""), d("kitten", "sitting"), d("ab", "ba")], [0, 2, 2, 3, 1]);
    }

    #[test]
    fn short_words_need_a_close_match() {
        assert_eq!(closest("x", ["pi", "y"]), None);
        assert_eq!(closest("no_slip", ["no-slip", "specular"]), Some("no-slip"));
        assert_eq!(closest("NoSlip", ["no-slip", "specular"]), Some("no-slip"));
    }
}
