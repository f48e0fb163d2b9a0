//! The fastest motion that walls and a law have.
use crate::{
    billiard::{BallLaw, Billiard, Motion},
    bounce::Bounce,
    rolling::Rolling,
};
use geometry::{Homogeneous, Walls, WithWalls};

/// An action on a motion of any type: the code that it calls is compiled for that type.
///
/// ```
/// use billiards::{Bounce, Motion, OnWalls, WithMotion, geometry::{Table, tables}, laws::Specular};
///
/// /// The length of the first flight at unit speed.
/// struct Flight([f64; 2], [f64; 2]);
/// impl WithMotion<2, 1> for Flight {
///     type Output = f64;
///     fn run<B: Motion<2, 1> + Bounce<2, 1>>(self, motion: &B) -> f64 {
///         motion.first_hit(&self.0, &self.1).time
///     }
/// }
///
/// let flight = |table: Table| table.with_walls(OnWalls { law: &Specular, then: Flight([0.0, 0.5], [0.0, 1.0]) });
/// assert_eq!(flight(tables::circle(1.0)?), 0.5); // rolls
/// assert_eq!(flight(tables::stadium(2.0, 1.0)?), 0.5);
/// # Ok::<(), billiards::Error>(())
/// ```
pub trait WithMotion<const N: usize, const S: usize> {
    /// Its result.
    type Output;
    /// Performs the action.
    fn run<B: Motion<N, S> + Bounce<N, S>>(self, motion: &B) -> Self::Output;
}

/// A law and an action, for [`with_walls`](geometry::Table::with_walls): the action gets a [`Billiard`], or a [`Rolling`] where the walls
/// are homogeneous.
#[derive(Clone, Copy, Debug)]
pub struct OnWalls<'a, L, A> {
    /// What a collision does.
    pub law: &'a L,
    /// The action.
    pub then: A,
}

impl<L: BallLaw<2, 1>, A: WithMotion<2, 1>> WithWalls<2> for OnWalls<'_, L, A> {
    type Output = A::Output;
    fn run<W: Walls<2>>(self, walls: &W) -> A::Output {
        self.then.run(&Billiard { walls, law: self.law })
    }
    fn run_homogeneous<W: Homogeneous>(self, walls: &W) -> A::Output {
        self.then.run(&Rolling::new(walls, self.law))
    }
}

impl<L: BallLaw<3, 3>, A: WithMotion<3, 3>> WithWalls<3> for OnWalls<'_, L, A> {
    type Output = A::Output;
    fn run<W: Walls<3>>(self, walls: &W) -> A::Output {
        self.then.run(&Billiard { walls, law: self.law })
    }
}
