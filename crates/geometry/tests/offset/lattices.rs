//! Disks on channels and flat tori.
use super::*;
use geometry::shapes::curve::{Interval, ParametricCurve, ParametricFormula};

#[test]
fn disks_on_a_torus_overlap_in_chains_and_cages() {
    let torus = |w: f64, h: f64, r: f64| {
        let lattice = Lattice::new(&[v(w, 0.0), v(0.0, h)]).unwrap();
        Table::periodic(vec![circle(0.3, 0.4, r, false)], Some(lattice)).unwrap()
    };
    assert_eq!(check("torus", &torus(1.0, 2.0, 0.25), 0.2).table.pieces().len(), 1);
    // chains along x₁: two wavy walls
    let wavy = check("torus", &torus(1.0, 2.0, 0.25), 0.3);
    assert_eq!(wavy.table.pieces().len(), 2);
    // cages: the corners between four disks
    let cage = check("torus", &torus(1.0, 1.0, 0.25), 0.3);
    assert_eq!((cage.table.pieces().len(), cage.table.chains().len()), (4, 1));
    assert!(matches!(torus(1.0, 1.0, 0.25).offset(0.5), Err(Error::NothingLeft { .. })));
    let wide = torus(1.0, 1.0, 0.25).largest_disk().radius;
    assert!((wide - (0.5_f64.sqrt() - 0.25)).abs() < 1e-15);
    // as wide as the gap: the corridors are closed
    assert_eq!(check("torus", &torus(1.0, 1.0, 0.25), 0.25).table.chains().len(), 1);
}

#[test]
fn walls_go_on_across_cells() {
    let zigzag = |top: f64| {
        let walls = [[v(0.0, 0.0), v(0.5, 0.25)], [v(0.5, 0.25), v(1.0, 0.0)], [v(1.0, top), v(0.0, top)]];
        let walls = walls.map(|[a, b]| Box::new(Segment::new(a, b).unwrap()) as Box<dyn Piece>);
        let lattice = Lattice::new(&[v(1.0, 0.0)]).unwrap();
        Table::periodic(walls.into(), Some(lattice)).unwrap()
    };
    let offset = check("zigzag", &zigzag(1.0), 0.1);
    // two slopes with an arc over the ridge; the upper wall
    assert_eq!(offset.origins.len(), 4);
    // at 0.4 the ridge closes the channel: a room in every cell
    let rooms = check("zigzag", &zigzag(1.0), 0.4);
    assert_eq!(rooms.table.chains().len(), 1);
    assert!(matches!(zigzag(1.0).offset(0.6), Err(Error::NothingLeft { .. })));
    check("channel", &tables::channel(1.0, 1.0, 0.125).unwrap(), 0.3);
    check("channel", &tables::channel(1.0, 1.0, -0.25).unwrap(), 0.55);
}

#[test]
fn the_area_that_is_left_on_a_torus_shrinks_by_its_boundary() {
    // an ellipse longer than the cell: its parallels cross those of its translates
    let lattice =
        [v(0.832_000_851_369_904_2, -0.078_187_706_861_627_57), v(-0.136_261_655_525_053_1, 0.701_270_105_387_928_9)];
    let lattice = Lattice::new(&lattice).unwrap();
    let center = v(0.061_073_301_209_894_85, 1.474_568_912_899_319_4);
    let ellipse =
        Ellipse::new(center, [0.394_654_244_638_418_25, 0.071_017_471_068_963_75], 2.680_528_289_997_457, false);
    let ellipse = ellipse.unwrap();
    let table = Table::periodic(vec![Box::new(ellipse)], Some(lattice)).unwrap();
    let left = |radius: f64| {
        let offset = table.offset(radius).unwrap().table;
        // two kinks, of which the one across cells is counted on both sides
        assert_eq!(offset.corners().len(), 3, "{radius}");
        (offset.area(), offset.perimeter())
    };
    let step = 0.001;
    for k in 0..70 {
        let radius = 0.15 + step * f64::from(k);
        let [(area, _), (_, middle), (less, _)] = [radius, radius + 0.5 * step, radius + step].map(left);
        assert!((area - less - middle * step).abs() < 1e-7, "{radius}: {area} {less} {middle}");
    }
}

#[test]
fn a_parallel_that_touches_its_translates_is_counted_once() {
    // ellipses on a rectangular lattice, and a disk that exactly fills the gaps between them: the parallels touch where their parts meet
    for [a, b] in [[0.75, 0.5], [0.75, 0.75]] {
        let ellipse = Ellipse::new(v(0.0, 0.0), [a, b], 0.0, false).unwrap();
        let lattice = Lattice::new(&[v(2.0, 0.0), v(0.0, 2.0 * b + 0.5)]).unwrap();
        let length = ellipse.length();
        let table = Table::periodic(vec![Box::new(ellipse)], Some(lattice)).unwrap();
        let left = check("touching", &table, 0.25).table;
        let [area, perimeter] = [PI * (a * b + 0.0625) + 0.25 * length, length + 0.5 * PI]; // Steiner
        assert!((left.area() - (2.0 * (2.0 * b + 0.5) - area)).abs() < 1e-13, "{a} {b}: {}", left.area());
        assert!((left.perimeter() - perimeter).abs() < 1e-13, "{a} {b}: {}", left.perimeter());
    }
}

#[test]
fn a_disk_larger_than_the_cells_of_a_torus_fits_nowhere_however_large() {
    let torus = tables::sinai_torus(0.25, 1.0).unwrap();
    let free = 0.5_f64.sqrt() - 0.25;
    for radius in [free + 1e-3, 1.01, 1e4, 1e16, 1e150] {
        let offset = torus.offset(radius).map(|offset| offset.table);
        let Err(Error::NothingLeft { radius: asked, largest }) = offset else { panic!("{radius}: {offset:?}") };
        assert!(asked == radius && (largest - free).abs() < 1e-9, "{radius}: {largest}");
    }
}

#[test]
fn corridors_of_a_torus_exactly_as_wide_as_the_disk_are_closed() {
    // square pillars, all corridors between which go from cell to cell
    let pillars = |x: f64| {
        let lattice = Lattice::new(&[v(1.0, 0.0), v(0.0, 1.0)]).unwrap();
        let pillar = [[x, 0.25], [x, 0.75], [x + 0.5, 0.75], [x + 0.5, 0.25]];
        Table::periodic(polygon(&pillar), Some(lattice)).unwrap()
    };
    for x in [0.25, 0.0, -0.5] {
        let open = check("pillars", &pillars(x), 0.25 - 1e-9).table;
        assert_eq!(open.chains().len(), 1, "{x}");
        // only where corridors cross is room left, between the corners of four pillars
        let closed = check("pillars", &pillars(x), 0.25).table;
        assert_eq!((closed.chains().len(), closed.pieces().len()), (1, 4), "{x}");
        assert!((closed.area() - (0.25 - PI * 0.0625)).abs() < 1e-15, "{x}: {}", closed.area());
    }
}

/// `(t, a t (1 − t))`
#[derive(Clone, Copy, Debug)]
struct Arch(f64);

impl ParametricFormula for Arch {
    fn jet(&self, t: f64) -> [[f64; 2]; 3] {
        [[t, self.0 * t * (1.0 - t)], [1.0, self.0 * (1.0 - 2.0 * t)], [0.0, -2.0 * self.0]]
    }
    fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
        let number = Interval::from;
        let to_end = number(1.0) - t;
        [[t, t * to_end * self.0], [number(1.0), (to_end - t) * self.0], [number(0.0), number(-2.0 * self.0)]]
    }
}

#[test]
fn a_straight_wall_of_a_channel_is_one_also_as_a_formula() {
    let ends = [v(0.0, 0.0), v(1.0, 0.0)];
    let channel = |floor: Box<dyn Piece>, roof: bool| {
        let roof = roof.then(|| Box::new(Segment::new(v(1.0, 1.0), v(0.0, 1.0)).unwrap()) as Box<dyn Piece>);
        let lattice = Lattice::new(&[v(1.0, 0.0)]).unwrap();
        Table::periodic([floor].into_iter().chain(roof).collect(), Some(lattice)).unwrap()
    };
    for height in [0.0, 1e-17, 1e-9, -1e-9] {
        for roof in [false, true] {
            for radius in [1e-3, 0.05, 0.25] {
                let formula = ParametricCurve::along(Arch(height), [0.0, 1.0], ends).unwrap().remove(0);
                let left = channel(Box::new(formula), roof).offset(radius).unwrap().table;
                let drawn = channel(Box::new(Segment::new(ends[0], ends[1]).unwrap()), roof).offset(radius).unwrap();
                assert_eq!(left.pieces().len(), drawn.table.pieces().len(), "{height} {radius}");
                for x in [0.1, 0.5, 0.9, 1.7] {
                    let at = left.closest(&v(x, 0.5 * radius)).1.point;
                    assert!((at - v(x, radius)).amax() <= height.abs() + 1e-15, "{height} {radius} {x}: {at}");
                }
            }
        }
    }
}
