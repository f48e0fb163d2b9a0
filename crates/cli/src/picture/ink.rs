//! Colours.

/// A colour: red, green, blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Colour(pub u8, pub u8, pub u8);

impl Colour {
    /// Walls, frames and text.
    pub const BLACK: Self = Self(0x1a, 0x1a, 0x1a);
    /// The page.
    pub const WHITE: Self = Self(0xff, 0xff, 0xff);
    /// The inside of obstacles.
    pub const SOLID: Self = Self(0xe6, 0xe6, 0xe6);
    /// Lines beside the point.
    pub const MIDDLE: Self = Self(0x8a, 0x8a, 0x8a);
    /// Guide lines.
    pub const GUIDE: Self = Self(0xd0, 0xd0, 0xd0);

    /// How unlike another colour it is: the square of their distance.
    pub(super) fn distance(self, other: Self) -> u32 {
        [(self.0, other.0), (self.1, other.1), (self.2, other.2)]
            .map(|(a, b)| u32::from(a.abs_diff(b)).pow(2))
            .iter()
            .sum()
    }

    /// Part `t` of the way from this colour to another.
    #[must_use]
    pub fn mix(self, other: Self, t: f64) -> Self {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between two bytes")]
        let part = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * t.clamp(0.0, 1.0) + 0.5) as u8;
        Self(part(self.0, other.0), part(self.1, other.1), part(self.2, other.2))
    }
}

/// The colours of orbits, in turn: dark enough for thin lines, and apart from one another for colour-blind eyes too.
pub const ORBITS: [Colour; 8] = [
    Colour(0x14, 0x4a, 0x87),
    Colour(0xc1, 0x4a, 0x24),
    Colour(0x1a, 0x7a, 0x58),
    Colour(0x7d, 0x45, 0x94),
    Colour(0xa8, 0x78, 0x0a),
    Colour(0x2b, 0x93, 0xbd),
    Colour(0x97, 0x22, 0x47),
    Colour(0x50, 0x50, 0x50),
];
