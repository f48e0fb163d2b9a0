//! Portraits as numbers: how many of their points there are in each cell of a grid, for densities and everything computed from them.

use super::cloud::Cloud;
use super::{File, Material, Needs, Picture};
use crate::npy;

pub(super) const VELOCITIES: Picture = Picture {
    name: "velocity-counts",
    files: &["velocity-counts.npy"],
    summary: "the velocity portrait as numbers: how many points fall into each of its pixels (NPY)",
    needs: Needs::Velocities,
    draw: |material: &Material| file("velocity-counts.npy", material.velocities.as_ref()),
};

pub(super) const REDUCED: Picture = Picture {
    name: "phase-counts",
    files: &["phase-counts.npy"],
    summary: "the phase portrait as numbers: how many points fall into each of its pixels (NPY)",
    needs: Needs::Reduced,
    draw: |material: &Material| file("phase-counts.npy", material.reduced.as_ref().map(super::Reduced::cloud)),
};

/// The counts of a portrait as an array, its first row at the bottom of the picture.
fn file(name: &str, cloud: Option<&Cloud>) -> Vec<File> {
    let Some(cloud) = cloud else { return Vec::new() };
    let grid = cloud.counts();
    let [width, height] = grid.size();
    let mut content = npy::header("'<i8'", &format!("({height}, {width})"));
    for row in grid.counts().chunks_exact(width).rev() {
        row.iter().for_each(|count| content.extend_from_slice(&count.to_le_bytes()));
    }
    vec![File { name: name.into(), content }]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The shape of an array, and its elements.
    fn read(content: &[u8]) -> (String, Vec<i64>) {
        let data = 10 + usize::from(u16::from_le_bytes([content[8], content[9]]));
        assert_eq!(data % 64, 0);
        let header = std::str::from_utf8(&content[10..data]).unwrap();
        let shape = header.split("'shape': ").nth(1).unwrap().trim_end().trim_end_matches(", }");
        (shape.into(), content[data..].as_chunks().0.iter().map(|bytes| i64::from_le_bytes(*bytes)).collect())
    }

    #[test]
    fn counts_of_few_and_of_many_points_stand_row_by_row_from_the_bottom() {
        for times in [1_i64, 20_001] {
            let mut cloud = crate::picture::velocities();
            for i in 0..times {
                cloud.add(i as u64, [0.5, -0.25]);
            }
            cloud.add(0, [-0.5, 0.75]);
            let files = (VELOCITIES.draw)(&Material { velocities: Some(cloud), ..Material::default() });
            let (shape, counts) = read(&files[0].content);
            assert_eq!((files[0].name.as_str(), shape.as_str()), ("velocity-counts.npy", "(1000, 1000)"));
            // cells of width 2.12/1000 from −1.06 on
            let cell = |x: f64, y: f64| ((y + 1.06) / 0.002_12) as usize * 1000 + ((x + 1.06) / 0.002_12) as usize;
            let filled: Vec<_> = counts.iter().enumerate().filter(|of| *of.1 > 0).map(|(i, n)| (i, *n)).collect();
            assert_eq!(filled, [(cell(0.5, -0.25), times), (cell(-0.5, 0.75), 1)]);
        }
    }
}
