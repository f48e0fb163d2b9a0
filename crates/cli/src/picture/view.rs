//! From the plane to the page.

/// A rectangle of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Lower left corner.
    pub low: [f64; 2],
    /// Upper right corner.
    pub high: [f64; 2],
}

impl Window {
    /// The square [−1, 1]² with a margin on all sides.
    pub const fn unit_disk(margin: f64) -> Self {
        let r = 1.0 + margin;
        Self { low: [-r, -r], high: [r, r] }
    }

    /// The smallest window around points; `None` without points. Points that are not finite do not count.
    pub fn around(points: impl IntoIterator<Item = [f64; 2]>) -> Option<Self> {
        points.into_iter().filter(|p| p[0].is_finite() && p[1].is_finite()).fold(None, |window: Option<Self>, p| {
            let Self { low, high } = window.unwrap_or(Self { low: p, high: p });
            Some(Self { low: [low[0].min(p[0]), low[1].min(p[1])], high: [high[0].max(p[0]), high[1].max(p[1])] })
        })
    }

    /// Width and height.
    pub fn size(self) -> [f64; 2] {
        [self.high[0] - self.low[0], self.high[1] - self.low[1]]
    }

    /// Its width or height, whichever is larger.
    pub fn largest(self) -> f64 {
        let [width, height] = self.size();
        width.max(height)
    }

    /// The same, wider on all sides by a fraction of its larger extent; never of size zero.
    #[must_use]
    pub fn padded(self, share: f64) -> Self {
        let largest = if self.largest() > 0.0 {
            self.largest()
        } else {
            // A single point: a window of its own order of magnitude.
            self.low[0].abs().max(self.low[1].abs()).max(f64::MIN_POSITIVE)
        };
        let by = largest * share;
        Self { low: self.low.map(|x| x - by), high: self.high.map(|x| x + by) }
    }

    /// A part of it, as far as possible centred at a point, of which no side is longer than `longest` times the other, but which
    /// contains all of the window `kept`.
    #[must_use]
    pub fn no_longer_than(self, longest: f64, kept: Self, about: [f64; 2]) -> Self {
        let size = self.size();
        let mut cut = self;
        for i in 0..2 {
            let most = (longest * size[1 - i]).max(kept.size()[i]);
            if size[i] > most && most > 0.0 {
                let low = (about[i] - 0.5 * most).max(kept.high[i] - most).min(kept.low[i]);
                let low = low.max(self.low[i]).min(self.high[i] - most);
                (cut.low[i], cut.high[i]) = (low, low + most);
            }
        }
        cut
    }

    /// Whether no side is longer than `longest` times the other.
    pub fn is_no_longer_than(self, longest: f64) -> bool {
        let [width, height] = self.size();
        width <= longest * height && height <= longest * width
    }

    /// The part of the line `point + s direction`, `from ≤ s ≤ to`, inside the window.
    pub fn clip(self, point: [f64; 2], direction: [f64; 2], [from, to]: [f64; 2]) -> Option<[[f64; 2]; 2]> {
        let (mut enter, mut leave) = (from, to);
        for i in 0..2 {
            if direction[i] == 0.0 {
                if point[i] < self.low[i] || point[i] > self.high[i] {
                    return None;
                }
                continue;
            }
            let (a, b) = ((self.low[i] - point[i]) / direction[i], (self.high[i] - point[i]) / direction[i]);
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        let at = |s: f64| [point[0] + s * direction[0], point[1] + s * direction[1]];
        (enter < leave && leave.is_finite()).then(|| [at(enter), at(leave)])
    }
}

/// A window of the plane shown in a rectangle of the page, with equal scales.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    window: Window,
    /// Upper left corner on the page.
    corner: [f64; 2],
    /// Points of the page per unit of the plane.
    scale: f64,
}

impl View {
    /// Fits a window into a width and a greatest height, its upper left corner at a place of the page.
    pub fn fit(window: Window, corner: [f64; 2], width: f64, most_height: f64) -> Self {
        let [w, h] = window.size();
        Self { window, corner, scale: (width / w).min(most_height / h) }
    }

    /// The window shown.
    pub fn window(&self) -> Window {
        self.window
    }

    /// Points of the page per unit of the plane.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Upper left corner on the page.
    pub fn corner(&self) -> [f64; 2] {
        self.corner
    }

    /// Width and height on the page.
    pub fn size(&self) -> [f64; 2] {
        self.window.size().map(|x| x * self.scale)
    }

    /// The place of a point on the page.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            self.corner[0] + (x - self.window.low[0]) * self.scale,
            self.corner[1] + (self.window.high[1] - y) * self.scale,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_cut_at_the_window() {
        let window = Window { low: [0.0, 0.0], high: [2.0, 1.0] };
        let whole = [f64::NEG_INFINITY, f64::INFINITY];
        assert_eq!(window.clip([1.0, 0.5], [1.0, 0.0], whole), Some([[0.0, 0.5], [2.0, 0.5]]));
        assert_eq!(window.clip([1.0, 0.5], [1.0, 0.0], [0.0, f64::INFINITY]), Some([[1.0, 0.5], [2.0, 0.5]]));
        assert_eq!(window.clip([1.0, 0.5], [1.0, 0.0], [0.0, 0.5]), Some([[1.0, 0.5], [1.5, 0.5]]));
        assert_eq!(window.clip([1.0, 2.0], [1.0, 0.0], whole), None);
        assert_eq!(window.clip([0.0, 0.0], [1.0, 1.0], whole), Some([[0.0, 0.0], [1.0, 1.0]]));
    }

    #[test]
    fn a_long_window_is_cut_about_a_point_but_not_into_what_is_kept() {
        let part = |a: f64, b: f64| Window { low: [a, 0.0], high: [b, 1.0] };
        let long = part(0.0, 100.0);
        let cut = |about: f64, [a, b]: [f64; 2]| long.no_longer_than(4.0, part(a, b), [about, 0.5]);
        assert_eq!(cut(50.0, [50.0, 50.0]), part(48.0, 52.0));
        assert_eq!(cut(1.0, [1.0, 1.0]), part(0.0, 4.0));
        assert_eq!(cut(50.0, [50.0, 53.0]), part(49.0, 53.0));
        assert_eq!(cut(50.0, [20.0, 53.0]), part(20.0, 53.0));
        assert_eq!(long.no_longer_than(200.0, part(1.0, 1.0), [1.0, 0.5]), long);
    }

    #[test]
    fn the_plane_keeps_its_proportions() {
        let view = View::fit(Window { low: [-2.0, -1.0], high: [2.0, 1.0] }, [10.0, 20.0], 100.0, 100.0);
        assert_eq!(view.size(), [100.0, 50.0]);
        assert_eq!([view.place([-2.0, 1.0]), view.place([2.0, -1.0])], [[10.0, 20.0], [110.0, 70.0]]);
    }
}
