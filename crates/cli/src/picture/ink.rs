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

    /// The colour at the fraction `t` of the way from this colour to another.
    #[must_use]
    pub fn mix(self, other: Self, t: f64) -> Self {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between two bytes")]
        let part = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * t.clamp(0.0, 1.0) + 0.5) as u8;
        Self(part(self.0, other.0), part(self.1, other.1), part(self.2, other.2))
    }
}

/// The colours of orbits, in turn: dark enough for thin lines, and distinguishable for colour-blind eyes too, with lightnesses as
/// different as possible.
pub const ORBITS: [Colour; 8] = [
    Colour(0x14, 0x4a, 0x87),
    Colour(0xc1, 0x4a, 0x24),
    Colour(0x1a, 0x7a, 0x58),
    Colour(0x92, 0x72, 0x98),
    Colour(0xc9, 0x89, 0x06),
    Colour(0x31, 0x9a, 0xd9),
    Colour(0x72, 0x09, 0x16),
    Colour(0x49, 0x47, 0x53),
];

#[cfg(test)]
mod tests {
    use super::*;

    type Matrix = [[f64; 3]; 3];

    /// Linear light as perceived [Machado 2009, severity 1] by normal eyes, and by eyes that lack one kind of cones.
    const EYES: [(&str, Matrix); 4] = [
        ("trichromat", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        (
            "protanope",
            [
                [0.152_286, 1.052_583, -0.204_868],
                [0.114_503, 0.786_281, 0.099_216],
                [-0.003_882, -0.048_116, 1.051_998],
            ],
        ),
        (
            "deuteranope",
            [[0.367_322, 0.860_646, -0.227_968], [0.280_085, 0.672_501, 0.047_413], [-0.011_820, 0.042_940, 0.968_881]],
        ),
        (
            "tritanope",
            [
                [1.255_528, -0.076_749, -0.178_779],
                [-0.078_411, 0.930_809, 0.147_602],
                [0.004_733, 0.691_367, 0.303_900],
            ],
        ),
    ];
    /// From linear sRGB to XYZ.
    const XYZ: Matrix = [
        [0.412_456_4, 0.357_576_1, 0.180_437_5],
        [0.212_672_9, 0.715_152_2, 0.072_175_0],
        [0.019_333_9, 0.119_192_0, 0.950_304_1],
    ];

    fn times(matrix: &Matrix, v: [f64; 3]) -> [f64; 3] {
        matrix.map(|row| row.iter().zip(v).map(|(a, b)| a * b).sum())
    }

    /// CIELAB of a colour, as some eyes see it.
    fn lab(colour: Colour, eyes: &Matrix) -> [f64; 3] {
        let linear = |byte: u8| {
            let x = f64::from(byte) / 255.0;
            if x <= 0.04045 { x / 12.92 } else { libm::pow((x + 0.055) / 1.055, 2.4) }
        };
        let seen = times(eyes, [colour.0, colour.1, colour.2].map(linear)).map(|x| x.clamp(0.0, 1.0));
        let (white, xyz) = (times(&XYZ, [1.0; 3]), times(&XYZ, seen));
        let [x, y, z] = core::array::from_fn(|i| {
            let t = xyz[i] / white[i];
            if t > 216.0 / 24389.0 { libm::cbrt(t) } else { (24389.0 / 27.0 * t + 16.0) / 116.0 }
        });
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    #[test]
    fn colours_of_orbits_are_apart_for_all_eyes_and_dark_on_paper() {
        for (who, eyes) in &EYES {
            let seen = ORBITS.map(|colour| lab(colour, eyes));
            for (i, a) in seen.iter().enumerate() {
                assert!(a[0] < 65.0, "{i} is light for a {who}: {a:?}");
                for (j, b) in seen.iter().enumerate().skip(i + 1) {
                    let apart = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
                    // the least difference visible side by side is about 2
                    assert!(apart > 18.0, "{i} and {j} are {apart} apart for a {who}");
                }
            }
        }
    }
}
