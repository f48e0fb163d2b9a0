//! Two bodies in contact, and the collision map `C_q`. A wall is a body like any other, so this is the only code path.

use crate::{
    Body, CollisionLaw, Contact, Delassus, Error, Roughness, TangentSpace, TangentVector, contact_map::ContactMap,
    reflect,
};
use nalgebra::{DMatrix, DVector, SVector};

/// The sum of the absolute values of all entries: unlike the length it takes no squares, which would vanish or overflow in some units.
fn size_of<const N: usize>(p: &SVector<f64, N>) -> f64 {
    p.iter().map(|x| x.abs()).sum()
}

/// Two bodies at a contact: a point `q` of the boundary of their configuration space.
///
/// ```
/// use approx::assert_abs_diff_eq;
/// use collision_laws::{Contact, Fixed, Pair, Twist, bodies::Ball, laws::{NoSlip, Specular}};
/// use nalgebra::Vector2;
///
/// // A spinning disk drops straight onto a floor.
/// let contact = Contact::new(Vector2::zeros(), Vector2::new(0.0, 1.0), 0)?;
/// let disk = Ball::<2>::uniform(1.0, 1.0)?;
/// let pair = Pair::new(contact, (disk, Vector2::new(0.0, -1.0)), (Fixed, Vector2::zeros()));
/// let falling = (Twist::planar(Vector2::new(0.0, -1.0), 3.0), ());
///
/// let (specular, ()) = pair.collide(&Specular, &falling).velocities;
/// assert_eq!(specular, Twist::planar(Vector2::new(0.0, 1.0), 3.0));
///
/// // Without slip the spin reverses in part, and sends the disk sideways.
/// let (no_slip, ()) = pair.collide(&NoSlip, &falling).velocities;
/// assert_abs_diff_eq!(no_slip, Twist::planar(Vector2::new(-2.0, 1.0), -1.0), epsilon = 1e-15);
/// # Ok::<(), collision_laws::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair<A, B, const N: usize> {
    /// Where the bodies touch; the normal points into `first`.
    pub contact: Contact<N>,
    /// Body 1.
    pub first: A,
    /// Body 2, the wall.
    pub second: B,
    /// The contact point as seen from each centre of mass, `Q − centre` \[L\].
    pub arms: [SVector<f64, N>; 2],
}

/// The velocities of both bodies: an element of `T_qM`.
pub type Velocities<A, B, const N: usize> = (<A as Body<N>>::Velocity, <B as Body<N>>::Velocity);

/// The outcome of a collision; `V` is the type of the pair's velocities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collision<V, const N: usize> {
    /// The velocities after the collision.
    pub velocities: V,
    /// The impulse on body 1; body 2 received its opposite.
    pub impulse: SVector<f64, N>,
    /// The contact velocity `u⁻` before the collision.
    pub u_minus: SVector<f64, N>,
}

impl<A: Body<N>, B: Body<N>, const N: usize> Pair<A, B, N> {
    /// Two bodies, each with its arm `Q − centre of mass`, in contact. The arm of a fixed body does not matter.
    #[inline]
    pub fn new(contact: Contact<N>, first: (A, SVector<f64, N>), second: (B, SVector<f64, N>)) -> Self {
        Self { contact, first: first.0, second: second.0, arms: [first.1, second.1] }
    }

    /// Two bodies, each with its centre of mass, in contact.
    #[inline]
    pub fn from_centres(contact: Contact<N>, first: (A, SVector<f64, N>), second: (B, SVector<f64, N>)) -> Self {
        let (r1, r2) = (contact.point - first.1, contact.point - second.1);
        Self::new(contact, (first.0, r1), (second.0, r2))
    }

    /// The contact velocity `u = J v`: that of the first touching point minus that of the second.
    #[inline]
    pub fn contact_velocity(&self, v: &Velocities<A, B, N>) -> SVector<f64, N> {
        self.first.contact_velocity(&self.arms[0], &v.0) - self.second.contact_velocity(&self.arms[1], &v.1)
    }

    /// The velocities `v + G⁻¹Jᵀ p` after an impulse `p` on body 1 and `−p` on body 2.
    #[inline]
    pub fn apply_impulse(&self, p: &SVector<f64, N>, v: &Velocities<A, B, N>) -> Velocities<A, B, N> {
        (self.first.apply_impulse(&self.arms[0], p, &v.0), self.second.apply_impulse(&self.arms[1], &-p, &v.1))
    }

    /// The Delassus operator `K = J G⁻¹ Jᵀ`.
    #[inline]
    pub fn delassus(&self) -> Delassus<N> {
        let [first, second] = self.operators();
        first.plus(&second, &self.contact.normal)
    }

    /// The Delassus operators of the two bodies.
    #[inline]
    fn operators(&self) -> [Delassus<N>; 2] {
        let normal = &self.contact.normal;
        [self.first.delassus(&self.arms[0], normal), self.second.delassus(&self.arms[1], normal)]
    }

    /// The kinetic-energy metric `⟨v, w⟩` of the pair.
    #[inline]
    pub fn inner_product(&self, v: &Velocities<A, B, N>, w: &Velocities<A, B, N>) -> f64 {
        self.first.inner_product(&v.0, &w.0) + self.second.inner_product(&v.1, &w.1)
    }

    /// The kinetic energy `½⟨v, v⟩` of the pair.
    #[inline]
    pub fn kinetic_energy(&self, v: &Velocities<A, B, N>) -> f64 {
        self.first.kinetic_energy(&v.0) + self.second.kinetic_energy(&v.1)
    }

    /// The collision: the law applied to the contact velocity, whatever its direction.
    ///
    /// The result is accurate to a few roundings of the contact, bodies and velocities, however long the arms are and however little the
    /// bodies resist turning, for every law that is a sum of [reflections](CollisionLaw::reflections); the impulse of another law is off by
    /// the condition number of `K` times 10⁻¹⁶. A few roundings may be less than all digits: if a law does not push in the whole contact
    /// plane, turning the normal by ε turns the impulse by as much, and changes the spin of a body with moment `I` by `ε m r²/I` where the
    /// contact is nearly below its centre. A [`Ball`](crate::bodies::Ball) may lose as much with every law that turns it.
    #[inline]
    pub fn collide<L: CollisionLaw<N> + ?Sized>(
        &self,
        law: &L,
        v: &Velocities<A, B, N>,
    ) -> Collision<Velocities<A, B, N>, N> {
        let u_minus = self.contact_velocity(v);
        let operators = self.operators();
        let delassus = operators[0].plus(&operators[1], &self.contact.normal);
        if !delassus.is_well_conditioned(&operators) {
            let reflections = law.reflections(&self.contact);
            if !reflections.is_empty() {
                let (velocities, impulse) = self.reflect_in_turn(&reflections, &delassus, v);
                return Collision { velocities, impulse, u_minus };
            }
        }
        let impulse = law.impulse(&self.contact, &delassus, &u_minus);
        Collision { velocities: self.apply_impulse(&impulse, v), impulse, u_minus }
    }

    /// The velocities after a sum of reflections of `v`, and the impulse, whatever the condition of `K`.
    ///
    /// One with weight `w` leads from `a` to the `b` for which `J (b − a + 2 w v)` vanishes along the normal and the rough directions.
    /// What is left of it is computed from the velocities, without `K`; `K` finds the impulse that is still missing.
    fn reflect_in_turn(
        &self,
        reflections: &[(f64, Roughness<N>)],
        delassus: &Delassus<N>,
        v: &Velocities<A, B, N>,
    ) -> (Velocities<A, B, N>, SVector<f64, N>) {
        let (contact_map, before) = (ContactMap::of(self), self.coordinates(v));
        let (mut velocities, mut impulse) = (*v, SVector::zeros());
        for (weight, roughness) in reflections {
            let aim = &before * (2.0 * weight) - self.coordinates(&velocities);
            let missing = |velocities: &Velocities<A, B, N>| {
                let left = contact_map.times(&(self.coordinates(velocities) + &aim));
                reflect(roughness, &self.contact, delassus, &left) * 0.5
            };
            let mut push = missing(&velocities);
            let mut last = f64::INFINITY;
            loop {
                velocities = self.apply_impulse(&push, &velocities);
                impulse += push;
                push = missing(&velocities);
                let size = size_of(&push);
                // Each step leaves at most half of it, until the rounding of the velocities is reached. The rounding of the impulse is no
                // measure: a body that hardly resists turning responds to far smaller impulses. NaN is never added.
                if size == 0.0 || !(size < 0.5 * last) {
                    break;
                }
                last = size;
            }
        }
        (velocities, impulse)
    }

    /// The collision, if there is one: the same as [`collide`](Self::collide) for bodies that can move and do approach.
    ///
    /// # Errors
    /// [`Error::BothFixed`], [`Error::NotApproaching`] if `u·ν ≥ 0`, [`Error::SingularDelassus`] if `K`, on the normal and the
    /// directions in which the law [pushes](CollisionLaw::pushes), is lost in rounding, so that the impulse would be noise.
    pub fn try_collide<L: CollisionLaw<N> + ?Sized>(
        &self,
        law: &L,
        v: &Velocities<A, B, N>,
    ) -> Result<Collision<Velocities<A, B, N>, N>, Error> {
        if self.first.degrees_of_freedom() + self.second.degrees_of_freedom() == 0 {
            return Err(Error::BothFixed);
        }
        let normal_velocity = self.contact.normal.dot(&self.contact_velocity(v));
        if normal_velocity.is_nan() || normal_velocity >= 0.0 {
            return Err(Error::NotApproaching { normal_velocity });
        }
        if self.delassus().is_singular_on(&law.pushes(&self.contact), &self.contact.normal) {
            return Err(Error::SingularDelassus { body: self.easier_to_move() });
        }
        Ok(self.collide(law, v))
    }

    /// The body, 1 or 2, whose touching point yields more to an impulse.
    fn easier_to_move(&self) -> usize {
        let normal = &self.contact.normal;
        let [first, second] = self.operators();
        if second.to_matrix(normal).amax() > first.to_matrix(normal).amax() { 2 } else { 1 }
    }

    /// The matrix of the collision map `C_q` of a law that is linear in the velocity, in the coordinates of
    /// [`tangent_space`](Self::tangent_space).
    pub fn collision_map<L: CollisionLaw<N> + ?Sized>(&self, law: &L) -> DMatrix<f64> {
        let size = self.degrees_of_freedom();
        let mut map = DMatrix::zeros(size, size);
        for (j, unit) in self.basis().enumerate() {
            map.set_column(j, &self.coordinates(&self.collide(law, &unit).velocities));
        }
        map
    }

    /// The tangent space `T_qM`: coordinates, metric and the subspaces that the axioms speak of.
    pub fn tangent_space(&self) -> TangentSpace<N> {
        TangentSpace::new(self)
    }

    /// The velocities with one coordinate 1 and the others 0, in order.
    pub(crate) fn basis(&self) -> impl Iterator<Item = Velocities<A, B, N>> {
        let size = self.degrees_of_freedom();
        (0..size)
            .map(move |i| self.velocities(DVector::from_fn(size, |j, _| if i == j { 1.0 } else { 0.0 }).as_slice()))
    }

    /// The dimension of `T_qM`.
    pub fn degrees_of_freedom(&self) -> usize {
        self.first.degrees_of_freedom() + self.second.degrees_of_freedom()
    }

    /// The coordinates of velocities: those of body 1, then those of body 2; a body that is held fixed has none.
    ///
    /// For a [`Twist`](crate::Twist) they are the linear velocity, then the spin coordinates.
    pub fn coordinates(&self, v: &Velocities<A, B, N>) -> DVector<f64> {
        let mut first = v.0.coordinates();
        first.truncate(self.first.degrees_of_freedom());
        let mut second = v.1.coordinates();
        second.truncate(self.second.degrees_of_freedom());
        first.extend(second);
        DVector::from_vec(first)
    }

    /// The velocities with the given coordinates; missing ones are zero.
    pub fn velocities(&self, coordinates: &[f64]) -> Velocities<A, B, N> {
        let (first, second) = coordinates.split_at(self.first.degrees_of_freedom().min(coordinates.len()));
        let second = &second[..self.second.degrees_of_freedom().min(second.len())];
        (TangentVector::from_coordinates(first), TangentVector::from_coordinates(second))
    }
}
