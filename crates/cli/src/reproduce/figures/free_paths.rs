//! Mean free times against 4A/P.
use super::super::motion::no_slip;
use super::super::portrait::{colour, starts};
use super::super::sheet::Sheet;
use super::super::{BEYOND, Drawing, Effort, Figure};
use crate::picture::{Anchor, Colour, Style};
use billiards::geometry::{Table, tables};
use billiards::laws::Specular;
use billiards::observe::{FreePath, Mean};
use billiards::{BallLaw, Collisions, Conserved, Orbit, Planar};

pub(super) const FIGURE: Figure = Figure {
    name: "free-paths",
    title: "Mean free times are 4A/P for both laws",
    place: BEYOND,
    caption: "The mean time from the fifth to the sixth collision, at unit speed in (x₀, x₁, x₂), over starts of the canonical measure, which every strict \
              law preserves. Shown is the deviation from 4A/P (area, perimeter) in percent, with one standard error, for specular (blue) and no-slip \
              (red) collisions: one law as good as the other, on tables where neither is ergodic too.",
    parameters: "Uniform disk, γ² = 1/2; 40 000 orbits each (--quick 4000), seed 13; Lorentz gas with radius 0.45 (finite horizon), the other tables \
                 as above.",
    draw,
};

fn mean<L: BallLaw<2, 1>>(billiard: &Planar<L>, many: u64) -> Result<Mean, billiards::Error> {
    let mut paths = FreePath::new();
    for s in &starts(&billiard.table, 13, many)? {
        let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>, _>::new(s.position, s.velocity, s.spin, ());
        billiard.run(&mut orbit, &Collisions(5), &mut ());
        paths.follow(&orbit);
        billiard.run(&mut orbit, &Collisions(1), &mut paths);
    }
    Ok(paths.time())
}

fn draw(effort: Effort) -> Drawing {
    let many = if effort == Effort::Quick { 4000 } else { 40_000 };
    let all: [(&str, Table); 9] = [
        ("square", tables::square(1.0)?),
        ("equilateral", tables::equilateral(1.0)?),
        ("hexagon", tables::hexagon(1.0)?),
        ("circle", tables::circle(1.0)?),
        ("stadium", tables::stadium(1.0, 1.0)?),
        ("mushroom", tables::mushroom(1.0, 0.5, 0.75)?),
        ("moon", tables::moon(1.0, 0.75, 1.0)?),
        ("pocket", tables::pocket([2.0, 1.0], 0.3125, 0.3125)?),
        ("Lorentz", tables::lorentz(0.45, 1.0)?),
    ];
    let (left, right, top, row) = (54.0, 222.0, 6.0, 14.0);
    let bottom = top + row * all.len() as f64;
    let mut sheet = Sheet::new(227.0, bottom + 24.0);
    let range = if effort == Effort::Quick { 6.0 } else { 2.0 };
    let x = |percent: f64| 0.5 * (left + right) + 0.5 * (right - left) * (percent / range).clamp(-1.0, 1.0);
    let hair = Style::line(Colour::BLACK, 0.4);
    sheet.svg.rectangle([left, top], [right, bottom], hair);
    for tick in [-1.0, -0.5, 0.0, 0.5, 1.0] {
        let at = x(tick * range);
        sheet.svg.line([at, bottom], [at, bottom - 2.5], hair);
        let text = format!("{} %", tick * range).replace('-', "−");
        sheet.label_as([at.min(right - 4.0), bottom + 7.0], 7.0, Anchor::Middle, &text);
    }
    sheet.svg.line([x(0.0), top], [x(0.0), bottom], Style::line(Colour(0xa0, 0xa0, 0xa0), 0.4));
    for (i, (name, table)) in all.into_iter().enumerate() {
        let y = top + row * (i as f64 + 0.5);
        sheet.label_as([left - 4.0, y], 7.5, Anchor::End, &format!("\"{name}\""));
        let exact = 4.0 * table.area() / table.perimeter();
        let specular = mean(&Planar { table: table.clone(), law: Specular }, many)?;
        let rough = mean(&no_slip(table), many)?;
        for (mean, ink, off) in [(specular, colour(0), -2.4), (rough, colour(1), 2.4)] {
            let (value, error) = (100.0 * (mean.mean / exact - 1.0), 100.0 * mean.standard_error / exact);
            sheet.svg.line([x(value - error), y + off], [x(value + error), y + off], Style::line(ink, 0.7));
            sheet.svg.circle([x(value), y + off], 1.5, Style::area(ink));
        }
    }
    sheet.label_as([0.5 * (left + right), bottom + 18.0], 8.0, Anchor::Middle, "\"mean time\" / (4A/P) − 1");
    Ok(sheet.svg)
}
