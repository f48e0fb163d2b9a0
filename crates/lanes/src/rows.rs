//! Tables in which every lane looks up a row of its own.
use crate::{Lane, MOST_LANES, WHOLE};

/// Rows of four numbers, looked up by their place.
///
/// Up to sixteen of them are also kept column by column, as two vectors of the widest instruction set, out of which one instruction
/// picks a number for every lane.
///
/// ```
/// use lanes::{Lane, Rows};
/// let rows = Rows::new(vec![[0.0, 1.0, 2.0, 3.0], [0.5, 1.5, 2.5, 3.5]]);
/// assert_eq!(rows.at(1.0), [0.5, 1.5, 2.5, 3.5]);
/// ```
#[derive(Clone, Debug)]
pub struct Rows {
    rows: Vec<[f64; 4]>,
    columns: Box<Columns>,
}

/// Aligned like vectors of 512 bits, so that none straddles two cache lines.
#[derive(Clone, Debug)]
#[repr(align(64))]
struct Columns([[f64; MOST_LANES]; 4]);

/// The last bits of `x + WHOLE`: the whole number nearest to `x`, for `0 ≤ x < 2³²`.
const LAST_BITS: u64 = (1 << 32) - 1;

impl Rows {
    /// A table of these rows.
    #[must_use]
    pub fn new(rows: Vec<[f64; 4]>) -> Rows {
        let mut columns = [[0.0; MOST_LANES]; 4];
        for (place, row) in rows.iter().enumerate().take(MOST_LANES) {
            for (column, number) in columns.iter_mut().zip(row) {
                column[place] = *number;
            }
        }
        Rows { rows, columns: Box::new(Columns(columns)) }
    }

    /// The row at a place in every lane, as four columns. The places must be whole numbers from 0 to the last; any other finds some row,
    /// or panics.
    #[must_use]
    #[inline(always)]
    pub fn at<F: Lane>(&self, place: F) -> [F; 4] {
        (place + WHOLE).row_of(self)
    }

    /// How many there are.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.rows.len()
    }

    /// The rows at places to which [`WHOLE`] was added, read one lane after another.
    #[inline(always)]
    pub(crate) fn one_by_one<F: Lane>(&self, places: F) -> [F; 4] {
        places.columns(|lane| {
            #[allow(clippy::cast_possible_truncation, reason = "the place of something in memory")]
            let place = (places.lane(lane).to_bits() & LAST_BITS) as usize;
            &self.rows[place]
        })
    }

    /// The columns of up to sixteen rows.
    #[inline(always)]
    pub(crate) fn columns(&self) -> &[[f64; MOST_LANES]; 4] {
        &self.columns.0
    }
}
