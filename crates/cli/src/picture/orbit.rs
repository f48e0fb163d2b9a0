//! The table and the orbits in it.

use super::ink::{Colour, ORBITS};
use super::stroke::{Stroke, joined};
use super::svg::{Outline, Style, Svg};
use super::view::{View, Window};
use super::{COLUMN, File, Leaving, Material, Needs, Path, Picture};

/// Width of walls.
const WALL: f64 = 0.8;
/// White around the picture.
const MARGIN: f64 = 3.0;
/// Width of lines that are not walls.
const THIN: f64 = 0.4;
/// Most orbits whose starts and horizons are marked.
const MOST_MARKED: usize = 50;
/// Legs drawn by one element.
const PART: usize = 50;

pub(super) const PICTURE: Picture = Picture {
    name: "orbit",
    needs: Needs::Paths,
    files: &["orbit.svg"],
    draw: |material| vec![File { name: "orbit.svg".into(), content: draw(material).to_string().into_bytes() }],
};

/// How many times longer than high, or higher than long, an infinite table may be shown so that all of every orbit is seen, and how
/// many times as large as without the flights that no wall ends.
const WHOLE: f64 = 30.0;
/// The same where they are longer still, so that a part of them is shown, but larger.
const LONGEST: f64 = 5.0;
/// The same where the starts, the finite walls and the first collisions are that far apart.
const FARTHEST: f64 = 50.0;

/// Draws walls and orbits in true proportions, without axes; each start is marked by a dot, or by the particle itself if
/// it has a radius, and the last collision whose position is known by an open dot.
pub fn draw(material: &Material) -> Svg {
    let window = material.window.unwrap_or_else(|| window(material));
    let inner = COLUMN - 2.0 * MARGIN;
    let view = View::fit(window.padded(1e-3), [MARGIN, MARGIN], inner, 1.2 * inner);
    let [width, height] = view.size();
    let mut svg = Svg::new(width + 2.0 * MARGIN, height + 2.0 * MARGIN);
    let corner = [MARGIN - 0.5 * WALL, MARGIN - 0.5 * WALL];
    svg.clipped(corner, [width + WALL, height + WALL], |svg| {
        for solid in &material.solids {
            let colour = if solid.is_hollow { Colour::WHITE } else { Colour::SOLID };
            svg.path(&joined(&solid.edge, &view), Style::area(colour));
        }
        orbits(svg, &view, material);
        svg.path(&joined(&material.guides, &view), Style::line(Colour::MIDDLE, THIN));
        svg.path(&joined(&material.outline, &view), Style::line(Colour::BLACK, WALL));
    });
    // drawn last, so that a dot on a wall at the edge is seen whole
    ends(&mut svg, &view, material);
    svg
}

/// A window with everything; for an infinite table, with some room beyond the orbits.
fn window(material: &Material) -> Window {
    let walls = || material.outline.iter().chain(&material.guides).flat_map(Stroke::extent);
    let chains = || material.paths.iter().filter_map(|path| path.chains.first());
    let starts = || chains().filter_map(|chain| chain.first().copied());
    // what meets no wall is shown with the walls around it
    let meets_none = material.paths.iter().all(|path| path.chains.iter().all(|chain| chain.len() < 2));
    let around = starts().next().filter(|_| meets_none);
    let distances = around.iter().flat_map(|start| material.outline.iter().filter_map(|wall| wall.distance(*start)));
    let reach = distances.fold(material.radius, f64::max);
    let particle = |[x, y]: [f64; 2]| [-reach, reach].map(|r| [x + r, y + r]);
    let points = || material.paths.iter().flat_map(|path| path.chains.iter().flatten().copied());
    let has_endless_walls = material.outline.iter().any(|s| matches!(s, Stroke::Line(..) | Stroke::Ray(..)));
    let seen = walls().chain(points());
    let seen: Vec<_> = if has_endless_walls {
        // a particle that touches an infinite wall reaches to it
        seen.chain(points().flat_map(particle)).collect()
    } else if is_marked(material) {
        seen.chain(starts().flat_map(particle)).collect()
    } else {
        seen.collect()
    };
    let whole = Window { low: [-1.0, -1.0], high: [1.0, 1.0] };
    let tight = Window::around(seen.iter().copied()).unwrap_or(whole);
    // where the time is over of orbits that meet no wall any more, unless it is too far away
    let rests = material.paths.iter().filter_map(|path| path.rest);
    let rests = rests.flat_map(|at| if has_endless_walls { particle(at) } else { [at; 2] });
    let all = Window::around(seen.into_iter().chain(rests)).unwrap_or(tight);
    let shows_rests = tight.largest() == 0.0 || all.largest() <= WHOLE * tight.largest();
    let tight = if shows_rests { all } else { tight };
    let is_seen = |path: &Path| path.escape.is_empty() || (shows_rests && path.rest.is_some());
    if !has_endless_walls && material.paths.iter().all(is_seen) {
        return tight;
    }
    // show that infinite walls and orbits go on, but do not shrink the picture to a line
    let collisions = chains().filter_map(|chain| chain.get(1).copied());
    let about = starts().next().unwrap_or(tight.low);
    let kept = [
        Window::around(walls().chain(starts().chain(collisions).flat_map(particle))),
        Window::around(walls().chain(starts().flat_map(particle))),
        Window::around(starts().flat_map(particle)),
        Window::around(particle(about)),
    ];
    let cuts = kept.into_iter().flatten().map(|kept| tight.no_longer_than(LONGEST, kept, about));
    let whole = Some(tight).filter(|tight| tight.is_no_longer_than(WHOLE));
    let mut readable = whole.into_iter().chain(cuts.filter(|cut| cut.is_no_longer_than(FARTHEST)));
    readable.next().unwrap_or(tight).padded(0.05)
}

fn orbits(svg: &mut Svg, view: &View, material: &Material) {
    let chains = material.paths.iter().flat_map(|path| &path.chains);
    let legs: usize = chains.map(|chain| chain.len().saturating_sub(1)).sum();
    // The more lines, the thinner, so that the picture keeps its greys.
    let (width, opacity) = match legs {
        0..=60 => (0.6, 1.0),
        61..=400 => (0.4, 1.0),
        401..=2000 => (0.25, 0.7),
        2001..=8000 => (0.2, 0.35),
        _ => (0.15, 0.2),
    };
    for (path, &colour) in material.paths.iter().zip(ORBITS.iter().cycle()) {
        let style = Style::line(colour, width).with_opacity(opacity);
        let seen = |leg: &Leaving| view.window().clip(leg.from, leg.direction, [0.0, leg.until]);
        let last = parts(path.escape.iter().filter_map(seen), view);
        let legs = path.chains.iter().flat_map(|chain| chain.windows(2)).map(|leg| [leg[0], leg[1]]);
        svg.paths(parts(legs, view).into_iter().chain(last), style);
    }
}

/// Outlines of at most [`PART`] legs each: legs of one element do not darken each other, so often-visited places become dark
/// only if there are several elements.
fn parts(legs: impl Iterator<Item = [[f64; 2]; 2]>, view: &View) -> Vec<Outline> {
    let mut parts: Vec<Outline> = vec![];
    for (number, leg) in legs.enumerate() {
        if number % PART == 0 {
            parts.push(Outline::new());
        }
        if let Some(part) = parts.last_mut() {
            part.chain(leg.map(|p| view.place(p)));
        }
    }
    parts
}

/// Whether starts and horizons are marked.
fn is_marked(material: &Material) -> bool {
    material.paths.len() <= MOST_MARKED
}

/// Marks where each orbit starts and where its horizon is, unless they are too many to be told apart.
fn ends(svg: &mut Svg, view: &View, material: &Material) {
    if !is_marked(material) {
        return;
    }
    for (path, &colour) in material.paths.iter().zip(ORBITS.iter().cycle()) {
        if let Some(horizon) = path.horizon {
            svg.circle(view.place(horizon), 1.5, Style::line(colour, 0.5).filled(Colour::WHITE));
        }
        let Some(&start) = path.chains.first().and_then(|chain| chain.first()) else { continue };
        if material.radius > 0.0 {
            svg.circle(view.place(start), material.radius * view.scale(), Style::line(colour, 0.6));
        }
        svg.circle(view.place(start), 1.5, Style::line(Colour::WHITE, 0.5).filled(colour));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{Solid, Stroke};

    /// How many paths there are in a picture, how many styles of lines, and how many parts of paths and legs.
    fn counts(material: &Material) -> [usize; 4] {
        let svg = draw(material).to_string();
        let (_, body) = svg.split_once("<rect").unwrap();
        ["<path", "stroke-width", "M", "L"].map(|what| body.matches(what).count())
    }

    #[test]
    fn legs_of_many_short_chains_share_elements_and_their_style() {
        let chains = (0..200).map(|i| vec![[f64::from(i), 0.0], [f64::from(i), 1.0]]).collect();
        let paths = vec![Path { chains, ..Path::default() }];
        // the dot at the start has a style, too
        assert_eq!(counts(&Material { paths, ..Material::default() }), [200 / PART, 2, 200, 200]);
    }

    #[test]
    fn legs_of_one_chain_go_on_from_one_another() {
        let chain = (0..200).map(|i| [f64::from(i), f64::from(i % 2)]).collect();
        let paths = vec![Path { chains: vec![chain, vec![], vec![[1.0, 1.0]]], ..Path::default() }];
        assert_eq!(counts(&Material { paths, ..Material::default() }), [4, 2, 4, 199]);
    }

    #[test]
    fn walls_with_many_sides_are_one_path() {
        let corner = |k: u32| [f64::from(k % 100), f64::from(k % 100).sqrt()];
        let outline = (0..100).map(|k| Stroke::Segment(corner(k), corner(k + 1))).collect();
        assert_eq!(counts(&Material { outline, ..Material::default() }), [1, 1, 1, 100]);
    }

    /// The window around orbits from these starts, two legs up and down each, in a strip.
    fn window_of(starts: &[f64]) -> Window {
        let chain = |x: &f64| vec![[*x, 0.5], [*x + 0.5, 1.0], [*x + 60.0, 0.0]];
        let path = |x| Path { chains: vec![chain(x)], ..Path::default() };
        let outline = [0.0, 1.0].map(|y| Stroke::Line([0.0, y], [1.0, 0.0])).into();
        window(&Material { outline, paths: starts.iter().map(path).collect(), ..Material::default() })
    }

    #[test]
    fn of_a_table_without_end_every_start_is_shown() {
        for starts in [&[0.0, 20.0][..], &[20.0, 0.0], &[-3.0, 0.0, 30.0], &[7.0]] {
            let window = window_of(starts);
            for x in starts {
                assert!(window.low[0] < *x && x + 0.5 < window.high[0], "{x}: {window:?}");
            }
        }
        // where they are so far apart that the picture would be a line, only the first one
        let window = window_of(&[1000.0, 0.0]);
        assert!(window.low[0] < 1000.0 && window.high[0] > 1000.0 && window.is_no_longer_than(6.0), "{window:?}");
    }

    /// A particle of this radius between two lines at its distance from these heights of its centre, which it touches at these points.
    fn touching(radius: f64, [low, high]: [f64; 2], at: &[[f64; 2]]) -> Material {
        let line = |y: f64| Stroke::Line([0.0, y], [1.0, 0.0]);
        let paths = vec![Path { chains: vec![at.to_vec()], ..Path::default() }];
        let (outline, guides) = (vec![line(low - radius), line(high + radius)], vec![line(low), line(high)]);
        Material { outline, guides, radius, paths, ..Material::default() }
    }

    #[test]
    fn of_a_table_without_end_the_particle_and_the_walls_that_it_touches_are_shown() {
        for radius in [0.1, 1.0, 30.0] {
            let window = window(&touching(radius, [-0.5, 0.5], &[[0.0, 0.0], [0.5, 0.5], [1.5, -0.5]]));
            assert!(window.low[0] < -radius && window.high[0] > radius, "{radius}: {window:?}");
            assert!(window.low[1] < -0.5 - radius && window.high[1] > 0.5 + radius, "{radius}: {window:?}");
        }
    }

    #[test]
    fn of_a_table_without_end_a_particle_that_meets_no_wall_is_shown_with_those_around_it() {
        for radius in [0.0, 0.25] {
            let window = window(&touching(radius, [-0.5, 0.5], &[[7.0, 0.0]]));
            assert!(window.low[0] < 7.0 - radius && window.high[0] > 7.0 + radius, "{radius}: {window:?}");
            assert!(window.low[1] < -0.5 - radius && window.high[1] > 0.5 + radius, "{radius}: {window:?}");
            assert!(window.is_no_longer_than(1.5), "{radius}: {window:?}");
        }
        // beside the end of a ray, that end
        let ray = Stroke::Ray([0.0, 0.0], [3.0, 0.0]);
        assert_eq!([[-3.0, 4.0], [2.0, 1.0]].map(|at| ray.distance(at)), [Some(5.0), Some(1.0)]);
    }

    #[test]
    fn beside_obstacles_the_particle_at_the_start_is_shown() {
        let obstacle = Stroke::Circle { center: [0.0, 0.0], radius: 0.25 };
        let path = |x: f64| Path { chains: vec![vec![[x, 0.0], [-1.0, 0.0]]], ..Path::default() };
        let of =
            |paths| window(&Material { radius: 1.0, outline: vec![obstacle.clone()], paths, ..Material::default() });
        let seen = of(vec![path(3.0)]);
        assert_eq!([seen.low, seen.high], [[-1.0, -1.0], [4.0, 1.0]]);
        // where particles are too many to be drawn, no room is left for them
        assert_eq!(of(vec![path(3.0); MOST_MARKED + 1]).high[0], 3.0);
    }

    #[test]
    fn a_bounded_orbit_is_shown_whole_and_of_one_that_drifts_far_a_readable_part() {
        let zigzag = |legs: u32| (0..=legs).map(|k| [f64::from(k), f64::from(k % 2)]).collect::<Vec<_>>();
        for legs in [3, 10, 29] {
            let window = window(&touching(0.0, [0.0, 1.0], &zigzag(legs)));
            assert!(window.low[0] < 0.0 && window.high[0] > f64::from(legs), "{legs}: {window:?}");
        }
        let window = window(&touching(0.0, [0.0, 1.0], &zigzag(1000)));
        assert!(window.low[0] < 0.0 && window.is_no_longer_than(6.0), "{window:?}");
    }

    #[test]
    fn where_the_time_is_over_of_what_meets_no_wall_any_more_is_shown_unless_it_is_far_away() {
        let obstacle = Stroke::Circle { center: [0.0, 0.0], radius: 1.0 };
        for wall in [obstacle, Stroke::Line([0.0, -1.0], [1.0, 0.0])] {
            let of = |rest: Option<[f64; 2]>| {
                let escape = vec![Leaving { from: [1.0, 0.0], direction: [1.0, 1.0], until: f64::INFINITY }];
                let path = Path { chains: vec![vec![[3.0, 0.0], [1.0, 0.0]]], escape, rest, horizon: None };
                window(&Material { outline: vec![wall.clone()], paths: vec![path], ..Material::default() })
            };
            for far in [[1e6, 1e6], [-1e300, 0.0]] {
                assert_eq!(of(Some(far)), of(None));
            }
            for at in [[4.0, 3.0], [-20.0, 5.0]] {
                let Window { low, high } = of(Some(at));
                assert!((0..2).all(|i| low[i] <= at[i] && at[i] <= high[i]), "{at:?}: {low:?} {high:?}");
            }
        }
    }

    #[test]
    fn every_kind_of_wall_and_path_gives_a_finite_picture() {
        let material = Material {
            outline: vec![
                Stroke::Segment([0.0, 0.0], [1.0, 0.0]),
                Stroke::Line([0.0, 1.0], [1.0, 0.0]),
                Stroke::Ray([0.0, 0.0], [1.0, 2.0]),
                Stroke::Arc { center: [0.0, 0.0], radius: 1.0, start: 0.5, sweep: -6.0 },
                Stroke::Circle { center: [3.0, 0.0], radius: 0.5 },
                Stroke::Chain(vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
            ],
            solids: vec![Solid { edge: vec![Stroke::Circle { center: [3.0, 0.0], radius: 0.5 }], is_hollow: false }],
            paths: vec![
                Path {
                    chains: vec![vec![[0.0, 0.0], [2.0, 2.0]], vec![]],
                    escape: vec![Leaving { from: [2.0, 2.0], direction: [1.0, 1.0], until: f64::INFINITY }],
                    rest: Some([1e300, 1e300]),
                    horizon: Some([2.0, 2.0]),
                },
                Path { chains: vec![vec![[f64::NAN, 0.0]]], ..Path::default() },
            ],
            ..Material::default()
        };
        for material in [material, Material::default()] {
            let svg = draw(&material);
            assert!(svg.size().iter().all(|x| x.is_finite() && *x > 0.0));
            roxmltree::Document::parse(&svg.to_string()).unwrap();
        }
    }
}
