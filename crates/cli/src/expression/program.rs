//! Several formulas evaluated together, with common parts computed once.

use super::derivative::Arena;
use super::number::Number;
use super::{Expression, Node, SMALL};

/// `K` formulas in the same variables.
///
/// ```
/// use billiards_cli::expression::{Expression, Program};
///
/// let f = Expression::parse("sin(x)*y", &["x", "y"])?;
/// let gradient = Program::new([&f.derivative(0), &f.derivative(1)]);
/// assert_eq!(gradient.evaluate(&[0.0, 3.0]), [3.0, 0.0]);
/// # Ok::<(), billiards_cli::expression::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Program<const K: usize> {
    nodes: Vec<Node>,
    results: [usize; K],
}

impl<const K: usize> Program<K> {
    /// Joins formulas.
    pub fn new(formulas: [&Expression; K]) -> Self {
        let mut arena = Arena::default();
        let roots = formulas.map(|formula| arena.embed(formula));
        let (nodes, results) = arena.reachable(roots);
        Self { nodes, results }
    }

    /// The values at a point, or enclosures of them in a box.
    #[allow(private_bounds, reason = "numbers and intervals: a closed set")]
    pub fn evaluate<T: Number>(&self, variables: &[T]) -> [T; K] {
        if self.nodes.len() <= SMALL {
            self.fill(&mut [T::constant(0.0); SMALL], variables)
        } else {
            self.fill(&mut vec![T::constant(0.0); self.nodes.len()], variables)
        }
    }

    fn fill<T: Number>(&self, values: &mut [T], variables: &[T]) -> [T; K] {
        super::fill(&self.nodes, values, variables);
        self.results.map(|i| values[i])
    }
}
