//! From a planar parry shape to pieces.
use super::{
    Side,
    contour::{Contour, piece_of, reversed},
    convert::Frame,
    curve::DistancePiece,
    union,
};
use crate::{Error, Piece, plane::finite, shapes::Screen};
use nalgebra::Isometry2;
use parry2d_f64::shape::{Shape, TypedShape};

/// The boundary of a shape in a pose, as pieces with the table on their left.
///
/// Exact for all shapes that consist of segments and arcs: ball, cuboid, capsule, segment, triangle, polyline, convex
/// polygon and their rounded forms, half-space, triangle mesh (its outline only), height field, voxels, and compounds
/// of these (the outline of the union). A segment or an open polyline is a wall on both sides. Loops of a polyline
/// bound its interior, whichever way they turn; nested loops alternate. The inside of a height field is the region below it. It is an
/// open chain: close it with segments from the last end to the first start, or put it on a lattice whose vector is its width, with equal
/// heights at both ends. Any other shape, such as one of your own, becomes a [`DistancePiece`].
///
/// Rotations enter through the pose's sine and cosine: for results with the same bits on every machine compute these with `libm`, not
/// with the constructors of nalgebra.
///
/// ```
/// use geometry::{parry::{pieces, Side, parry2d_f64::shape::Capsule}, Table, Vector2};
/// use nalgebra::Isometry2;
/// let stadium = Capsule::new([-1.0, 0.0].into(), [1.0, 0.0].into(), 1.0);
/// let table = Table::new(pieces(&stadium, &Isometry2::identity(), Side::Inside)?)?;
/// assert!((table.area() - (4.0 + core::f64::consts::PI)).abs() < 1e-14);
/// # Ok::<(), geometry::Error>(())
/// ```
///
/// # Errors
/// [`Error::Shape`] for the inside of a shape that has none and for a compound with members that have no exact
/// outline and overlap others, [`Error::Parameter`] for a translation that is not finite; otherwise as the constructors of the pieces.
pub fn pieces(shape: &dyn Shape, pose: &Isometry2<f64>, side: Side) -> Result<Vec<Box<dyn Piece>>, Error> {
    finite("translation", &pose.translation.vector)?;
    let frame = Frame::from(pose);
    let mut members = vec![];
    flatten(shape, &frame, &mut members);
    let (mut contours, mut others) = (vec![], vec![]);
    for (shape, frame) in &members {
        match Contour::of(&shape.as_typed_shape(), frame)? {
            Some(contour) => contours.push(contour),
            None => others.push(DistancePiece::new(*shape, frame, side)?),
        }
    }
    if !others.is_empty() && members.len() > 1 {
        apart(&contours, &others)?;
    }
    let mut out = assemble(contours, side)?;
    for other in others {
        out.push(Box::new(other));
    }
    Ok(out)
}

/// The pieces of the union of outlines.
pub(crate) fn assemble(mut contours: Vec<Contour>, side: Side) -> Result<Vec<Box<dyn Piece>>, Error> {
    let contour = if contours.len() == 1 { contours.swap_remove(0) } else { union::outline(&contours)? };
    if side == Side::Inside && !contour.screens.is_empty() {
        let why = "it has no inside; a closed loop of edges has one";
        return Err(Error::Shape { shape: contour.name, why });
    }
    let mut out = vec![];
    for figure in &contour.figures {
        out.push(match side {
            Side::Inside => piece_of(figure)?,
            Side::Outside => piece_of(&reversed(figure))?,
        });
    }
    if side == Side::Outside {
        out.reverse();
    }
    for [a, b] in contour.screens {
        out.push(Box::new(Screen::new(a, b)?));
    }
    Ok(out)
}

/// The simple shapes of a compound, each with its frame.
fn flatten<'a>(shape: &'a dyn Shape, frame: &Frame<2>, members: &mut Vec<(&'a dyn Shape, Frame<2>)>) {
    if let TypedShape::Compound(compound) = shape.as_typed_shape() {
        for (pose, member) in compound.shapes() {
            flatten(&**member, &frame.after(&Frame::from(pose)), members);
        }
    } else {
        members.push((shape, *frame));
    }
}

/// Shapes known by their distances only can be members of a compound as long as they stay clear of the others.
fn apart(contours: &[Contour], others: &[DistancePiece]) -> Result<(), Error> {
    let mut extents = vec![];
    for contour in contours {
        for figure in &contour.figures {
            extents.push(piece_of(figure)?.extent());
        }
        for &[a, b] in &contour.screens {
            extents.push(Screen::new(a, b)?.extent());
        }
    }
    let meet = |a: &crate::Extent, b: &crate::Extent| (0..2).all(|i| a.min[i] <= b.max[i] && b.min[i] <= a.max[i]);
    for other in others {
        let own = other.extent();
        if extents.iter().any(|e| meet(e, &own)) {
            let why = "a member without an exact outline (a shape of your own) may not come near other members";
            return Err(Error::Shape { shape: "compound", why });
        }
        extents.push(own);
    }
    Ok(())
}
