//! The moon.
use super::registry::{Build, Entry, Parameter};
use super::vertices::{positive, within};
use crate::{Error, Outline, Table, shapes::Arc};
use nalgebra::Vector2;

/// The moon: the disk of radius `R` about the origin without the disk of radius `b` about `(d, 0)` \[L\]; pieces:
/// 0 outer arc, 1 inner arc.
///
/// The circles cross where `x₁ = (R² − b² + d²)/(2 d)`. With specular reflections it is ergodic for some
/// parameters ([Correia–Zhang 2015]).
///
/// # Errors
/// [`Error::Parameter`] unless all are positive and finite, and the circles cross: `|R − b| < d < R + b`.
pub fn moon(radius: f64, bite_radius: f64, bite_distance: f64) -> Result<Table, Error> {
    let r = positive("radius", radius)?;
    let b = positive("bite_radius", bite_radius)?;
    let d = positive("bite_distance", bite_distance)?;
    let crosses = (r - b).abs() < d && d < r + b;
    within(
        "bite_distance",
        d,
        crosses,
        "between |radius - bite_radius| and radius + bite_radius (so that the circles cross)",
    )?;
    let x = 0.5 * (d + (r - b) * ((r + b) / d));
    let y = ((r - x) * (r + x)).sqrt();
    let (upper, lower) = (Vector2::new(x, y), Vector2::new(x, -y));
    let outline = Outline::from(upper)
        .piece(Box::new(Arc::with_radius(Vector2::zeros(), r, upper, lower, true)?))?
        .piece(Box::new(Arc::with_radius(Vector2::new(d, 0.0), b, lower, upper, false)?))?;
    Table::new(outline.close()?)
}

pub(super) const ENTRY: Entry = Entry {
    name: "moon",
    summary: "a disk about the origin with a circular bite on the +x1 axis",
    parameters: &[
        Parameter::length("radius", 1.0),
        Parameter::length("bite_radius", 0.75),
        Parameter::length("bite_distance", 1.0),
    ],
    build: Build::Planar(|v| moon(v.number("radius")?, v.number("bite_radius")?, v.number("bite_distance")?)),
};
