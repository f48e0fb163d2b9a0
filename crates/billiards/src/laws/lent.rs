//! A borrowed law: several billiards may share one.
use super::Mirror;
use crate::billiard::BallLaw;
use geometry::WallHit;
use lanes::Lane;

/// In the plane, at the speed and with the bits of the law itself.
///
/// ```
/// use billiards::{Collisions, Orbit, Planar, Stop, geometry::tables, laws::{Disk, PerPiece}};
/// use billiards::collision_laws::laws::{NoSlip, Specular};
///
/// // a rough floor
/// let law = PerPiece::new(Disk::new(&NoSlip, 0.7)?, [Disk::new(&Specular, 0.7)?]);
/// for table in [tables::square(1.0)?, tables::stadium(1.0, 1.0)?] {
///     let billiard = Planar { table, law: &law };
///     let mut orbit = Orbit::<_, 2, 1>::new([0.1, 0.2], [0.6, 0.3], [0.4], ());
///     assert_eq!(billiard.run(&mut orbit, &Collisions(100), &mut ()).stop, Stop::Finished);
/// }
/// # Ok::<(), billiards::Error>(())
/// ```
impl<const S: usize, L: BallLaw<2, S>> BallLaw<2, S> for &L {
    #[inline(always)]
    fn collide<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; S]) {
        (**self).collide(hit, velocity, spin);
    }
    #[inline(always)]
    fn collide_along_axis<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; S]) {
        (**self).collide_along_axis(hit, velocity, spin);
    }
    #[inline(always)]
    fn collide_in_frame<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; S]) {
        (**self).collide_in_frame(hit, velocity, spin);
    }
    #[inline(always)]
    fn is_strict(&self) -> bool {
        (**self).is_strict()
    }
    fn mirror(&self) -> Option<Mirror> {
        (**self).mirror()
    }
}

/// In space, where the frame of the plane is not used.
impl<const S: usize, L: BallLaw<3, S>> BallLaw<3, S> for &L {
    #[inline(always)]
    fn collide<F: Lane>(&self, hit: &WallHit<F, 3>, velocity: &mut [F; 3], spin: &mut [F; S]) {
        (**self).collide(hit, velocity, spin);
    }
    #[inline(always)]
    fn collide_along_axis<F: Lane>(&self, hit: &WallHit<F, 3>, velocity: &mut [F; 3], spin: &mut [F; S]) {
        (**self).collide_along_axis(hit, velocity, spin);
    }
    #[inline(always)]
    fn is_strict(&self) -> bool {
        (**self).is_strict()
    }
    fn mirror(&self) -> Option<Mirror> {
        (**self).mirror()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A law that answers each question in its own way.
    struct Probe;

    impl<const N: usize> BallLaw<N, 1> for Probe {
        fn collide<F: Lane>(&self, _: &WallHit<F, N>, velocity: &mut [F; N], spin: &mut [F; 1]) {
            (velocity[0], spin[0]) = (spin[0].same(1.0), spin[0].same(2.0));
        }
        fn collide_along_axis<F: Lane>(&self, _: &WallHit<F, N>, velocity: &mut [F; N], spin: &mut [F; 1]) {
            (velocity[0], spin[0]) = (spin[0].same(3.0), spin[0].same(4.0));
        }
        fn collide_in_frame<F: Lane>(&self, _: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
            (velocity[0], spin[0]) = (spin[0].same(5.0), spin[0].same(6.0));
        }
        fn is_strict(&self) -> bool {
            true
        }
        fn mirror(&self) -> Option<Mirror> {
            Some(Mirror::no_slip(0.5))
        }
    }

    /// What a law answers in any dimension.
    fn answers<const N: usize>(law: &impl BallLaw<N, 1>) -> ([[f64; 2]; 2], bool, bool) {
        let hit = WallHit::never([0.0; N]);
        let answer = |ask: &dyn Fn(&mut [f64; N], &mut [f64; 1])| {
            let (mut velocity, mut spin) = ([0.0; N], [0.0]);
            ask(&mut velocity, &mut spin);
            [velocity[0], spin[0]]
        };
        let collisions = [answer(&|v, w| law.collide(&hit, v, w)), answer(&|v, w| law.collide_along_axis(&hit, v, w))];
        (collisions, law.is_strict(), law.mirror().is_some())
    }

    #[test]
    fn a_law_that_is_lent_answers_each_question_as_it_does_itself() {
        let expected = ([[1.0, 2.0], [3.0, 4.0]], true, true);
        assert_eq!([answers::<2>(&Probe), answers::<2>(&&Probe)], [expected; 2]);
        assert_eq!([answers::<3>(&Probe), answers::<3>(&&Probe)], [expected; 2]);
        let (hit, mut velocity, mut spin) = (WallHit::never([0.0; 2]), [0.0; 2], [0.0]);
        BallLaw::<2, 1>::collide_in_frame(&&Probe, &hit, &mut velocity, &mut spin);
        assert_eq!([velocity[0], spin[0]], [5.0, 6.0]);
    }
}
